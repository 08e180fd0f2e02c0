//! Drawing eight triangles in f64: the certain f32 bounds discard blocks, f64 without bounds decides
//! their samples.
//!
//! Rows start at the tile's first sample, as those in f32 do; nothing is fused. Of the z-buffer in f64
//! the f32 one keeps a bound from below, which only discards.

use crate::raster::arithmetic::Double;
use crate::raster::blocks::{BlockGrid, Blocks, MOST_BLOCKS};
use crate::raster::draw::{Drawing, Octet};
use fearless_simd::prelude::*;
use fearless_simd::{f32x16, f64x8, mask32x16, mask64x8, u32x16};

/// More than half an ulp of f32: what rounding to it may add, relatively.
const ROUNDED: f64 = 1.0 / (1 << 23) as f64;

/// Lanes of the upper half of a block, in pixels from its first.
const WITHIN_X: [f64; 8] = [0.0, 1.0, 2.0, 3.0, 0.0, 1.0, 2.0, 3.0];
const WITHIN_Y: [f64; 8] = [0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0];

impl Drawing {
    /// Draws an octet's lanes; `depths` are the winners' 1/w, per block.
    #[inline(always)]
    pub(in crate::raster) fn draw_double<S: Simd>(
        &mut self,
        simd: S,
        grid: &BlockGrid,
        blocks: &mut Blocks,
        depths: &mut [[f64; 16]],
        octet: &Octet<'_>,
    ) {
        let count = self.list::<S, Double>(simd, grid, blocks, octet);
        let x_lanes = f64x8::from_slice(simd, &WITHIN_X);
        let y_lanes = f64x8::from_slice(simd, &WITHIN_Y);
        let mut changed = [0_u64; 4];
        for index in 0..count {
            let item = self.items[index] as usize;
            let (lane, block) = (item >> 8 & 7, item & (MOST_BLOCKS - 1));
            let x = x_lanes + f64::from(grid.x[block >> 4].0[block & 15]);
            let y = y_lanes + f64::from(grid.y[block >> 4].0[block & 15]);
            let (upper, lower) = depths[block].split_at_mut(8);
            let (nearer, depth) = decide(simd, octet, lane, x, y, upper);
            let (nearer_below, depth_below) = decide(simd, octet, lane, x, y + 2.0, lower);
            let bits = nearer.to_bitmask() | nearer_below.to_bitmask() << 8;
            if bits == 0 {
                continue;
            }
            let winner = u32x16::from_slice(simd, &blocks.winner[block].0);
            let number = u32x16::splat(simd, octet.numbers[lane]);
            let drawn = mask32x16::from_bitmask(simd, bits);
            drawn.select(number, winner).store_slice(&mut blocks.winner[block].0);
            let low = depth * (1.0 - ROUNDED);
            let low = low.narrow(depth_below * (1.0 - ROUNDED));
            let nearest = f32x16::from_slice(simd, &blocks.low[block].0);
            drawn.select(low, nearest).store_slice(&mut blocks.low[block].0);
            changed[block >> 6] |= 1 << (block & 63);
        }
        if changed != [0; 4] {
            blocks.update_farthest(simd, grid, changed);
        }
    }
}

/// The lanes at which a triangle covers and is nearer, and its 1/w.
#[inline(always)]
fn decide<S: Simd>(
    simd: S,
    octet: &Octet<'_>,
    lane: usize,
    x: f64x8<S>,
    y: f64x8<S>,
    depths: &mut [f64],
) -> (mask64x8<S>, f64x8<S>) {
    let rows = &octet.rows.wide;
    let edges = value(&rows[0], lane, x, y)
        .min(value(&rows[1], lane, x, y))
        .min(value(&rows[2], lane, x, y));
    let depth = value(&rows[3], lane, x, y);
    let nearest = f64x8::from_slice(simd, depths);
    let nearer = edges.simd_ge(0.0) & depth.simd_gt(nearest);
    nearer.select(depth, nearest).store_slice(depths);
    (nearer, depth)
}

/// A lane's row at samples.
#[inline(always)]
fn value<S: Simd>(row: &[[f64; 8]; 3], lane: usize, x: f64x8<S>, y: f64x8<S>) -> f64x8<S> {
    (x * row[0][lane] + y * row[1][lane]) + row[2][lane]
}
