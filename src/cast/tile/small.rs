//! Triangles of a batch that may cover at most 2 × 2 samples, drawn eight at a time: the lanes are
//! triangles, not samples.
//!
//! Where triangles are as small as pixels, a vector over the samples of a block does a sixteenth of
//! useful work, and most triangles cover no sample at all. Values and bounds are those of
//! [`super::rows`]: a value here is a row at the sample itself, two products and two sums, of the
//! eight roundings that are allowed for there.

use super::frame::Frame;
use super::rows::Batch;
use super::settle::{self, Memory, Open};
use super::state::{self, Samples};
use crate::accel::{GROUP, WIDTH};
use crate::mutant::{self, Mutant};
use crate::pixel::Window;
use fearless_simd::{Simd, SimdBase, SimdCombine, SimdFloat, SimdMask, f32x8, f32x16};

/// Draws the triangles of these lanes; a bit for every block that has changed, and the number of
/// samples that were held against a triangle.
#[inline(always)]
#[allow(clippy::too_many_arguments, reason = "one loop over everything that a tile has")]
pub(super) fn draw_small<S: Simd, const CERTAIN: bool>(
    simd: S,
    frame: &Frame<'_>,
    window: Window,
    batch: &Batch,
    lanes: u32,
    samples: &mut Samples,
    memory: &mut Memory<'_>,
) -> u64 {
    let one = f32x8::splat(simd, 1.0);
    let [left, right, top, bottom] = [
        f32x8::load_array_ref(simd, &batch.spans[0]),
        f32x8::load_array_ref(simd, &batch.spans[1]),
        f32x8::load_array_ref(simd, &batch.spans[2]),
        f32x8::load_array_ref(simd, &batch.spans[3]),
    ];
    // A column of samples in the lower, the next in the upper half.
    let x = left.combine(left + one);
    let beside = x.simd_le(right.combine(right));
    let mut rows = [[x; 3]; 4];
    for i in 0..4 {
        for k in 0..3 {
            let row = f32x8::load_array_ref(simd, &batch.rows[i][k]);
            rows[i][k] = row.combine(row);
        }
    }
    let error = f32x8::load_array_ref(simd, &batch.depth_error);
    let error = error.combine(error);
    let lanes = lanes | lanes << GROUP;
    let believed = mutant::is(Mutant::BelievedRows);
    let outside = f32x16::splat(simd, if CERTAIN && !believed { -1.0 } else { 0.0 });
    let mut dirty = 0;
    for below in 0..2 {
        let y = if below == 0 { top } else { top + one };
        let within = y.simd_le(bottom).to_bitmask() as u32;
        let within = (within | within << GROUP) & beside.to_bitmask() as u32 & lanes;
        if within == 0 {
            continue;
        }
        memory.levels.single += u64::from(within.count_ones());
        // Evaluate the edge functions and z.
        let y = y.combine(y);
        let mut values = [x; 4];
        for i in 0..4 {
            let [a, b, c] = rows[i];
            values[i] = b.mul_add(y, a.mul_add(x, c));
        }
        let least = values[0].min(values[1]).min(values[2]);
        let mut left = !(least.simd_lt(outside).to_bitmask() as u32) & within;
        if left == 0 {
            continue;
        }
        let covered = least.simd_gt(f32x16::splat(simd, 1.0)).to_bitmask() as u32;
        let z = values[3];
        let (lo, hi) = if CERTAIN { (z - error, z + error) } else { (z, z) };
        // Hold each sample that may be covered against what it knows.
        while left != 0 {
            let at = left.trailing_zeros() as usize;
            left &= left - 1;
            let (lo, hi) = (lo.as_slice()[at], hi.as_slice()[at]);
            let column = x.as_slice()[at] as u32 as usize;
            let row = y.as_slice()[at] as u32 as usize;
            let (block, lane) = state::lane_of(column, row);
            let known = block * WIDTH + lane;
            let z_lo = &mut samples.z_lo.as_flattened_mut()[known];
            let z_hi = &mut samples.z_hi.as_flattened_mut()[known];
            let id = batch.ids[at % GROUP];
            if !CERTAIN {
                if lo > *z_lo {
                    *z_lo = lo;
                    samples.ids.as_flattened_mut()[known] = id;
                    dirty |= 1 << block;
                }
                continue;
            }
            if hi < *z_lo || believed && hi <= *z_hi {
                continue;
            }
            dirty |= 1 << block;
            let covered = (covered >> at & 1) as u16;
            if covered != 0 && lo > *z_hi || believed {
                *z_lo = lo;
                *z_hi = hi;
                samples.ids.as_flattened_mut()[known] = id;
                if !mutant::is(Mutant::StaleTies) {
                    samples.ties[block] &= !(1 << lane);
                }
            } else {
                let (lanes, covered) = (1 << lane, covered << lane);
                let open = Open { triangle: id, block, lanes, covered };
                settle::settle(frame, window, samples, memory, open);
            }
        }
    }
    dirty
}
