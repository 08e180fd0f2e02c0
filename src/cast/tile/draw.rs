//! A batch of triangles drawn into a tile, in two phases without branches per triangle or block.
//!
//! First the pairs of a triangle and a block in which it may show go to a list ([`super::list`]); then
//! each pair is drawn, 16 samples at a time. Triangles of a few samples are drawn without
//! ([`super::small`]). Only what f32 leaves open is branched on, and it goes to [`super::settle`].
//! Bounds are those of [`super::rows`].

use super::frame::Frame;
use super::list::{self, Scratch};
use super::rows::Batch;
use super::settle::{self, Memory, Open};
use super::small;
use super::state::{BLOCKS, Samples};
use crate::accel::{GROUP, WIDTH};
use crate::mutant::{self, Mutant};
use crate::pixel::Window;
use fearless_simd::{Select, Simd, SimdBase, SimdMask, f32x16, u32x16};

/// Draws the batch. Without `CERTAIN` what f32 says is believed, and the bounds of z are one number.
#[inline(always)]
pub(super) fn draw<S: Simd, const CERTAIN: bool>(
    simd: S,
    frame: &Frame<'_>,
    window: Window,
    batch: &Batch,
    scratch: &mut Scratch,
    samples: &mut Samples,
    memory: &mut Memory<'_>,
) {
    let sizes = list::sizes(simd, batch);
    let small = sizes[0] & batch.live;
    let near = sizes[1] & batch.live & !small;
    let large = batch.live & !small & !near;
    let mut dirty = 0;
    if small != 0 {
        dirty = small::draw_small::<S, CERTAIN>(simd, frame, window, batch, small, samples, memory);
    }
    let mut pairs = 0;
    if near != 0 {
        pairs = list::list_near(simd, batch, near, scratch, samples);
    }
    if large != 0 {
        pairs = list::list_pairs(simd, batch, large, scratch, pairs, samples);
    }
    dirty |= draw_pairs::<S, CERTAIN>(simd, frame, window, batch, scratch, pairs, samples, memory);
    memory.levels.single += (pairs * WIDTH) as u64;
    let mut left = dirty;
    while left != 0 {
        let block = left.trailing_zeros() as usize;
        left &= left - 1;
        samples.block_z[block] = f32x16::load_array_ref(simd, &samples.z_lo[block]).reduce_min();
    }
    if dirty != 0 {
        samples.narrow(simd);
    }
}

/// Draws the listed pairs; a bit for every block that has changed.
#[inline(always)]
#[allow(clippy::too_many_arguments, reason = "one loop over everything that a tile has")]
fn draw_pairs<S: Simd, const CERTAIN: bool>(
    simd: S,
    frame: &Frame<'_>,
    window: Window,
    batch: &Batch,
    scratch: &Scratch,
    pairs: usize,
    samples: &mut Samples,
    memory: &mut Memory<'_>,
) -> u64 {
    let (one, minus_one) = (f32x16::splat(simd, 1.0), f32x16::splat(simd, -1.0));
    let mut dirty = 0_u64;
    for &pair in &scratch.pairs[..pairs] {
        let (lane, block) = (pair as usize / BLOCKS % GROUP, pair as usize % BLOCKS);
        let corners = &scratch.corners[lane];
        let inside = &scratch.inside[lane];
        // Evaluate the edge functions and z at the 16 samples.
        let mut values = [one; 4];
        for i in 0..4 {
            let corner = f32x16::splat(simd, corners[i][block]);
            values[i] = f32x16::load_array_ref(simd, &inside[i]) + corner;
        }
        let least = values[0].min(values[1]).min(values[2]);
        let z = values[3];
        if !CERTAIN {
            let nearest = f32x16::load_array_ref(simd, &samples.z_lo[block]);
            let seen = least.simd_ge(f32x16::splat(simd, 0.0)) & z.simd_gt(nearest);
            seen.select(z, nearest).store_array(&mut samples.z_lo[block]);
            let ids = u32x16::load_array_ref(simd, &samples.ids[block]);
            seen.select(u32x16::splat(simd, batch.ids[lane]), ids)
                .store_array(&mut samples.ids[block]);
            dirty |= u64::from(seen.to_bitmask() != 0) << block;
            continue;
        }
        let error = f32x16::splat(simd, batch.depth_error[lane]);
        let (lo, hi) = (z - error, z + error);
        let z_lo = f32x16::load_array_ref(simd, &samples.z_lo[block]);
        let z_hi = f32x16::load_array_ref(simd, &samples.z_hi[block]);
        // Decide what is certain.
        let may = !(least.simd_lt(minus_one) | hi.simd_lt(z_lo));
        let sure = if mutant::is(Mutant::BelievedRows) {
            least.simd_ge(f32x16::splat(simd, 0.0)) & hi.simd_gt(z_hi)
        } else {
            may & least.simd_gt(one) & lo.simd_gt(z_hi)
        };
        sure.select(lo, z_lo).store_array(&mut samples.z_lo[block]);
        sure.select(hi, z_hi).store_array(&mut samples.z_hi[block]);
        let ids = u32x16::load_array_ref(simd, &samples.ids[block]);
        sure.select(u32x16::splat(simd, batch.ids[lane]), ids).store_array(&mut samples.ids[block]);
        let sure_bits = sure.to_bitmask() as u16;
        let may_bits = may.to_bitmask() as u16;
        if !mutant::is(Mutant::StaleTies) {
            samples.ties[block] &= !sure_bits;
        }
        dirty |= u64::from(may_bits != 0) << block;
        // Hand on what is not.
        let open = may_bits & !sure_bits;
        let open = if mutant::is(Mutant::BelievedRows) { 0 } else { open };
        if open != 0 {
            let covered = least.simd_gt(one).to_bitmask() as u16;
            let open = Open { triangle: batch.ids[lane], block, lanes: open, covered };
            settle::settle(frame, window, samples, memory, open);
        }
    }
    dirty
}
