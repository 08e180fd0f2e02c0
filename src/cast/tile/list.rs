//! Which blocks a triangle of a batch may show in: pairs of the two, without a branch per block.
//!
//! A triangle that touches few blocks is held against these; any other against all 64, 16 at a time.
//! What is listed is drawn by [`super::draw`]. Bounds are those of [`super::rows`].

use super::rows::Batch;
use super::state::{ACROSS, BLOCK, BLOCKS, Samples};
use crate::accel::{GROUP, WIDTH};
use crate::mutant::{self, Mutant};
use fearless_simd::{Simd, SimdBase, SimdFloat, SimdMask, f32x8, f32x16, u32x16};

/// Steps to a block's corner, over blocks; and to a sample inside a block, over lanes: x and y.
const CORNERS: [[f32; BLOCKS]; 2] = steps(ACROSS, BLOCK as f32);
const INSIDE: [[f32; WIDTH]; 2] = steps(BLOCK, 1.0);

const fn steps<const COUNT: usize>(across: usize, size: f32) -> [[f32; COUNT]; 2] {
    let mut steps = [[0.0; COUNT]; 2];
    let mut i = 0;
    while i < COUNT {
        steps[0][i] = (i % across) as f32 * size;
        steps[1][i] = (i / across) as f32 * size;
        i += 1;
    }
    steps
}

/// The lanes of a vector.
const NUMBERS: [u32; WIDTH] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15];

/// Pairs of a batch at most, and room for one vector more.
const PAIRS: usize = GROUP * BLOCKS + WIDTH;

/// The drawing's own memory.
#[repr(align(64))]
pub(super) struct Scratch {
    /// Per triangle, edge functions and z at the corners of the blocks.
    pub(super) corners: [[[f32; BLOCKS]; 4]; GROUP],
    /// Per triangle, their steps inside a block.
    pub(super) inside: [[[f32; WIDTH]; 4]; GROUP],
    /// Triangle·64 + block.
    pub(super) pairs: [u32; PAIRS],
}

impl Scratch {
    pub(super) const EMPTY: Self = Self {
        corners: [[[0.0; BLOCKS]; 4]; GROUP],
        inside: [[[0.0; WIDTH]; 4]; GROUP],
        pairs: [0; PAIRS],
    };
}

/// The lanes whose triangles may cover at most 2 × 2 samples, and those that touch at most 2 × 2
/// blocks.
#[inline(always)]
pub(super) fn sizes<S: Simd>(simd: S, batch: &Batch) -> [u32; 2] {
    let one = f32x8::splat(simd, 1.0);
    let per_block = f32x8::splat(simd, 1.0 / BLOCK as f32);
    let mut small = u32::MAX;
    let mut near = u32::MAX;
    for axis in 0..2 {
        let from = f32x8::load_array_ref(simd, &batch.spans[2 * axis]);
        let to = f32x8::load_array_ref(simd, &batch.spans[2 * axis + 1]);
        small &= (to - from).simd_le(one).to_bitmask() as u32;
        let blocks = (to * per_block).floor() - (from * per_block).floor();
        near &= blocks.simd_le(one).to_bitmask() as u32;
    }
    [small, near]
}

/// Lists the pairs of triangles that touch few blocks, block by block.
#[inline(always)]
pub(super) fn list_near<S: Simd>(
    simd: S,
    batch: &Batch,
    lanes: u32,
    scratch: &mut Scratch,
    samples: &Samples,
) -> usize {
    let inside_x = f32x16::load_array_ref(simd, &INSIDE[0]);
    let inside_y = f32x16::load_array_ref(simd, &INSIDE[1]);
    let mut count = 0;
    let mut left = lanes;
    while left != 0 {
        let lane = left.trailing_zeros() as usize;
        left &= left - 1;
        for i in 0..4 {
            let a = f32x16::splat(simd, batch.rows[i][0][lane]);
            let b = f32x16::splat(simd, batch.rows[i][1][lane]);
            b.mul_add(inside_y, a * inside_x).store_array(&mut scratch.inside[lane][i]);
        }
        let mut blocks = [0; 4];
        for (i, block) in blocks.iter_mut().enumerate() {
            *block = batch.spans[i][lane] as u32 as usize / BLOCK;
        }
        let [left, right, top, bottom] = blocks;
        for row in top..=bottom {
            for column in left..=right {
                let block = row * ACROSS + column;
                let (x, y) = ((column * BLOCK) as f32, (row * BLOCK) as f32);
                let mut shows = true;
                for i in 0..4 {
                    let [a, b, c] = batch.rows[i];
                    let corner = b[lane] * y + (a[lane] * x + c[lane]);
                    scratch.corners[lane][i][block] = corner;
                    let reach = batch.reach[i][lane];
                    shows &= match i {
                        3 if mutant::is(Mutant::NearerBlocks) => {
                            corner - reach > samples.block_z[block]
                        }
                        3 => corner + reach >= samples.block_z[block],
                        _ => corner >= reach,
                    };
                }
                scratch.pairs[count] = (lane * BLOCKS + block) as u32;
                count += usize::from(shows);
            }
        }
    }
    count
}

/// Lists the pairs of a triangle and a block in which it may show, after the first `count`.
#[inline(always)]
pub(super) fn list_pairs<S: Simd>(
    simd: S,
    batch: &Batch,
    lanes: u32,
    scratch: &mut Scratch,
    count: usize,
    samples: &Samples,
) -> usize {
    let inside_x = f32x16::load_array_ref(simd, &INSIDE[0]);
    let inside_y = f32x16::load_array_ref(simd, &INSIDE[1]);
    let across = f32x16::from_slice(simd, &CORNERS[0][..WIDTH]);
    let mut down = [across; 4];
    let mut depths = [across; 4];
    for q in 0..4 {
        let of_q = q * WIDTH..(q + 1) * WIDTH;
        down[q] = f32x16::from_slice(simd, &CORNERS[1][of_q.clone()]);
        depths[q] = f32x16::from_slice(simd, &samples.block_z[of_q]);
    }
    let numbers = u32x16::load_array_ref(simd, &NUMBERS);
    let mut count = count;
    let mut left = lanes;
    while left != 0 {
        let lane = left.trailing_zeros() as usize;
        left &= left - 1;
        let mut may = [u64::MAX; 4];
        for i in 0..4 {
            let rows = &batch.rows[i];
            let a = f32x16::splat(simd, rows[0][lane]);
            let b = f32x16::splat(simd, rows[1][lane]);
            let c = f32x16::splat(simd, rows[2][lane]);
            let reach = f32x16::splat(simd, batch.reach[i][lane]);
            b.mul_add(inside_y, a * inside_x).store_array(&mut scratch.inside[lane][i]);
            let at_column = a.mul_add(across, c);
            for q in 0..4 {
                let corner = b.mul_add(down[q], at_column);
                let to = &mut scratch.corners[lane][i][q * WIDTH..(q + 1) * WIDTH];
                corner.store_slice(to);
                let reached = match i {
                    3 if mutant::is(Mutant::NearerBlocks) => (corner - reach).simd_gt(depths[q]),
                    3 => (corner + reach).simd_ge(depths[q]),
                    _ => corner.simd_ge(reach),
                };
                may[q] &= reached.to_bitmask();
            }
        }
        for q in 0..4 {
            let first = u32x16::splat(simd, (lane * BLOCKS + q * WIDTH) as u32);
            let mask = simd.from_bitmask_mask32x16(may[q]);
            simd.compress_u32x16(numbers + first, mask)
                .store_slice(&mut scratch.pairs[count..count + WIDTH]);
            count += may[q].count_ones() as usize;
        }
    }
    count
}
