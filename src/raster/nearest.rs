//! A tile's ids and ray parameters: what a z-buffer holds.
//!
//! t = (|V|·t/w⁻¹)/(N·(x, y, 1)) in f64, from rows over the whole frame and without fused operations,
//! then rounded: the same bits in every tile and at every instruction set. Where f64's bounds do
//! not reach f32's accuracy, the exact stage gives t.

use super::blocks::{self, BLOCK_SIDE, BlockGrid, NOTHING, SAME_DEPTH};
use super::doubt::Doubt;
use super::octet::Lanes;
use super::strips::Strip;
use super::tile::{Tile, Tiling};
use crate::mesh::TriangleId;
use crate::pixel::{Pixel, Window};
use fearless_simd::prelude::*;
use fearless_simd::{dispatch, f64x8, mask64x8, u32x16};

/// Writes a tile's ids and t.
pub(super) fn write(
    tiling: &Tiling<'_>,
    tile: &Tile,
    doubt: &mut Doubt<'_>,
    ids: &mut Strip<'_, u32>,
    t: &mut Strip<'_, f32>,
) {
    let (grid, window) = (&tiling.blocks, doubt.window);
    for block in 0..grid.len() {
        let first = blocks::pixel(grid, window, block, 0);
        if first.x >= window.x1() || first.y >= window.y1() {
            continue;
        }
        let (block_ids, mut block_t, doubtful) =
            dispatch!(tiling.simd.dispatched(), simd => block_answer(simd, tile, block, first));
        let mut left = doubtful;
        while left != 0 {
            let lane = left.trailing_zeros() as usize;
            left &= left - 1;
            let pixel = blocks::pixel(grid, window, block, lane);
            if window.contains(pixel) {
                block_t.0[lane] = exact_t(doubt, block_ids.0[lane], pixel);
            }
        }
        copy_rows(grid, window, first, &block_ids, ids);
        copy_rows(grid, window, first, &block_t, t);
    }
}

/// Ids and t of a block, and the lanes whose t f64 does not know well enough.
#[inline(always)]
fn block_answer<S: Simd>(
    simd: S,
    tile: &Tile,
    block: usize,
    first: Pixel,
) -> (Lanes<u32>, Lanes<f32>, u16) {
    let mut ids = Lanes([u32::MAX; 16]);
    let mut t = Lanes([f32::INFINITY; 16]);
    let winners = u32x16::from_slice(simd, &tile.blocks.winner[block].0);
    let winners = winners & u32x16::splat(simd, !SAME_DEPTH);
    let mut left = !winners.simd_eq(u32x16::splat(simd, NOTHING)).to_bitmask() & 0xffff;
    if left == 0 {
        return (ids, t, 0);
    }
    let [x, y] = first.sample();
    let x_lanes = f64x8::from_slice(simd, &[0.0, 1.0, 2.0, 3.0, 0.0, 1.0, 2.0, 3.0]) + x;
    let y_lanes = [0.0, 2.0]
        .map(|row| f64x8::from_slice(simd, &[0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0]) + (y + row));
    let one = f64x8::splat(simd, 1.0);
    let mut over = [one * f64::INFINITY; 2];
    let mut under = [one; 2];
    let mut id_lanes = u32x16::splat(simd, u32::MAX);
    let mut doubtful = 0;
    while left != 0 {
        // All lanes of one winner together.
        let winner = winners.as_array()[left.trailing_zeros() as usize & 15];
        let same = winners.simd_eq(u32x16::splat(simd, winner));
        let bits = same.to_bitmask();
        left &= !bits;
        let drawn = &tile.drawn[winner as usize];
        id_lanes = same.select(u32x16::splat(simd, drawn.id), id_lanes);
        for half in 0..2 {
            let same = mask64x8::from_bitmask(simd, bits >> (8 * half) & 0xff);
            let [a, b, c] = drawn.plane;
            let plane = (x_lanes * a + y_lanes[half] * b) + c;
            over[half] = same.select(one * drawn.volume, over[half]);
            under[half] = same.select(plane, under[half]);
            let known = plane.simd_gt(f64x8::splat(simd, drawn.least_plane)) | !same;
            doubtful |= (!known.to_bitmask() & 0xff) << (8 * half);
        }
    }
    (over[0] / under[0]).narrow(over[1] / under[1]).store_slice(&mut t.0);
    id_lanes.store_slice(&mut ids.0);
    (ids, t, doubtful as u16)
}

#[cold]
fn exact_t(doubt: &mut Doubt<'_>, id: u32, pixel: Pixel) -> f32 {
    match doubt.exact.triangle(TriangleId::new(id)) {
        Some(triangle) => triangle.t_at(pixel) as f32,
        None => f32::INFINITY,
    }
}

/// Copies a block's pixels that lie in the tile.
#[inline]
fn copy_rows<T: Copy>(
    _grid: &BlockGrid,
    window: Window,
    first: Pixel,
    lanes: &Lanes<T>,
    strip: &mut Strip<'_, T>,
) {
    let side = BLOCK_SIDE as usize;
    let width = side.min((window.x1() - first.x) as usize);
    for row in 0..side.min((window.y1() - first.y) as usize) {
        let pixel = Pixel { x: first.x, y: first.y + row as u32 };
        let to = strip.row_from(pixel);
        match width == side {
            true => to[..side].copy_from_slice(&lanes.0[row * side..row * side + side]),
            false => to[..width].copy_from_slice(&lanes.0[row * side..row * side + width]),
        }
    }
}
