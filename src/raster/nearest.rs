//! A tile's ids and ray parameters: what a z-buffer holds.
//!
//! t = (|V|·t/w⁻¹)/(N·(x, y, 1)) in f64, from rows over the whole frame and without fused operations,
//! then rounded: the same bits in every tile and at every instruction set. Where f64's bounds do
//! not reach f32's accuracy, the exact stage gives t.

use super::blocks::{self, BLOCK_SIDE, NOTHING, SAME_DEPTH};
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
    let simd = tiling.simd.dispatched();
    dispatch!(simd, simd => write_blocks(simd, tiling, tile, doubt, ids, t));
}

#[inline(always)]
fn write_blocks<S: Simd>(
    simd: S,
    tiling: &Tiling<'_>,
    tile: &Tile,
    doubt: &mut Doubt<'_>,
    ids: &mut Strip<'_, u32>,
    t: &mut Strip<'_, f32>,
) {
    let (per_side, window, side) = (tiling.blocks.per_side, doubt.window, BLOCK_SIDE as usize);
    for row in 0..(window.height() as usize).div_ceil(side) {
        for column in 0..(window.width() as usize).div_ceil(side) {
            let block = row * per_side + column;
            let first = blocks::pixel(&tiling.blocks, window, block, 0);
            let (block_ids, mut block_t, doubtful) = block_answer(simd, tile, block, first);
            if doubtful != 0 {
                settle(tiling, doubt, block, doubtful, &block_ids, &mut block_t);
            }
            store_block(window, [row, column], (&block_ids, ids), (&block_t, t));
        }
    }
}

/// Copies the pixels of a block that lie in the tile.
#[inline(always)]
pub(super) fn store_block(
    window: Window,
    [row, column]: [usize; 2],
    (block_ids, ids): (&Lanes<u32>, &mut Strip<'_, u32>),
    (block_t, t): (&Lanes<f32>, &mut Strip<'_, f32>),
) {
    let side = BLOCK_SIDE as usize;
    let left = (window.x0() - ids.tiles[0].x0()) as usize;
    let from = left + column * side;
    let width = side.min(left + window.width() as usize - from);
    let rows = row * side..(row * side + side).min(window.height() as usize);
    for (line, row) in rows.enumerate() {
        put(&mut ids.rows[row][from..], line, block_ids, width);
        put(&mut t.rows[row][from..], line, block_t, width);
    }
}

/// Copies a line of a block, or its first pixels.
#[inline(always)]
fn put<T: Copy>(to: &mut [T], line: usize, lanes: &Lanes<T>, width: usize) {
    let first = (line * BLOCK_SIDE as usize) & 12;
    let line = [lanes.0[first], lanes.0[first + 1], lanes.0[first + 2], lanes.0[first + 3]];
    match to.first_chunk_mut() {
        Some(whole) if width == line.len() => *whole = line,
        _ => to.iter_mut().zip(line).take(width).for_each(|(to, value)| *to = value),
    }
}

/// Ids and t of a block, and the lanes whose t f64 does not know well enough.
#[inline(always)]
fn block_answer<S: Simd>(
    simd: S,
    tile: &Tile,
    block: usize,
    first: Pixel,
) -> (Lanes<u32>, Lanes<f32>, u64) {
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
    let y_lanes = f64x8::from_slice(simd, &[0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0]) + y;
    let y_lanes = [y_lanes, y_lanes + 2.0];
    let infinite = f64x8::splat(simd, f64::INFINITY);
    let (mut over, mut under) = ([infinite; 2], [f64x8::splat(simd, 1.0); 2]);
    let mut id_lanes = u32x16::splat(simd, u32::MAX);
    let mut doubtful = 0;
    while left != 0 {
        // All lanes of one winner together.
        let winner = tile.blocks.winner[block].0[left.trailing_zeros() as usize & 15] & !SAME_DEPTH;
        let same = winners.simd_eq(u32x16::splat(simd, winner));
        let bits = same.to_bitmask();
        left &= !bits;
        let drawn = &tile.drawn[winner as usize];
        id_lanes = same.select(u32x16::splat(simd, drawn.id), id_lanes);
        let [a, b, c] = drawn.plane;
        let volume = f64x8::splat(simd, drawn.volume);
        for half in 0..2 {
            let same = mask64x8::from_bitmask(simd, bits >> (8 * half) & 0xff);
            let plane = (x_lanes * a + y_lanes[half] * b) + c;
            over[half] = same.select(volume, over[half]);
            under[half] = same.select(plane, under[half]);
            let known = plane.simd_gt(f64x8::splat(simd, drawn.least_plane)) | !same;
            doubtful |= (!known.to_bitmask() & 0xff) << (8 * half);
        }
    }
    (over[0] / under[0]).narrow(over[1] / under[1]).store_slice(&mut t.0);
    id_lanes.store_slice(&mut ids.0);
    (ids, t, doubtful)
}

/// t of doubtful lanes.
#[cold]
#[inline(never)]
fn settle(
    tiling: &Tiling<'_>,
    doubt: &mut Doubt<'_>,
    block: usize,
    doubtful: u64,
    ids: &Lanes<u32>,
    t: &mut Lanes<f32>,
) {
    for lane in (0..16).filter(|lane| doubtful >> lane & 1 == 1) {
        let pixel = blocks::pixel(&tiling.blocks, doubt.window, block, lane);
        if doubt.window.contains(pixel)
            && let Some(triangle) = doubt.exact.triangle(TriangleId::new(ids.0[lane]))
        {
            t.0[lane] = triangle.t_at(pixel) as f32;
        }
    }
}
