//! A tile's ids and ray parameters: what a z-buffer holds.
//!
//! t = (|V|·t/w⁻¹)/(N·(x, y, 1)) in f64, from rows over the whole frame and without fused operations,
//! then rounded: the same bits in every tile and at every instruction set. Where f64's bounds do
//! not reach f32's accuracy, the exact stage gives t.

use super::blocks::{self, BLOCK_SIDE, MOST_SIDE, NOTHING, SAME_DEPTH};
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
    let columns = (window.width() as usize).div_ceil(side);
    let mut answer = BlockRow::new();
    for row in 0..(window.height() as usize).div_ceil(side) {
        for column in 0..columns {
            let block = row * per_side + column;
            let first = blocks::pixel(&tiling.blocks, window, block, 0);
            let (ids, t) = (&mut answer.ids[column], &mut answer.t[column]);
            let doubtful = block_answer(simd, tile, block, first, ids, t);
            if doubtful != 0 {
                settle(tiling, doubt, block, doubtful, ids, t);
            }
        }
        answer.store(window, row, ids, t);
    }
}

/// Most blocks in a row of a tile.
const MOST_PER_SIDE: usize = (MOST_SIDE / BLOCK_SIDE) as usize;

/// The answers of a row of blocks.
pub(super) struct BlockRow {
    pub(super) ids: [Lanes<u32>; MOST_PER_SIDE],
    pub(super) t: [Lanes<f32>; MOST_PER_SIDE],
}

impl BlockRow {
    #[inline(always)]
    pub(super) fn new() -> Self {
        Self { ids: [Lanes([0; 16]); MOST_PER_SIDE], t: [Lanes([0.0; 16]); MOST_PER_SIDE] }
    }

    /// Copies the pixels that lie in the tile, for a row of blocks of it.
    #[inline(always)]
    pub(super) fn store(
        &self,
        window: Window,
        row: usize,
        ids: &mut Strip<'_, u32>,
        t: &mut Strip<'_, f32>,
    ) {
        let left = (window.x0() - ids.tiles[0].x0()) as usize;
        let right = left + window.width() as usize;
        let side = BLOCK_SIDE as usize;
        let rows = row * side..(row * side + side).min(window.height() as usize);
        for (line, row) in rows.enumerate() {
            put(&mut ids.rows[row][left..right], line, &self.ids);
            put(&mut t.rows[row][left..right], line, &self.t);
        }
    }
}

/// Copies a line of pixels from a row of blocks.
#[inline(always)]
fn put<T: Copy>(to: &mut [T], line: usize, blocks: &[Lanes<T>; MOST_PER_SIDE]) {
    let (quads, rest) = to.as_chunks_mut::<{ BLOCK_SIDE as usize }>();
    let done = quads.len();
    for (quad, lanes) in quads.iter_mut().zip(blocks) {
        *quad = lanes.0.as_chunks().0[line & 3];
    }
    if let Some(lanes) = blocks.get(done) {
        let last: &[T; BLOCK_SIDE as usize] = &lanes.0.as_chunks().0[line & 3];
        rest.iter_mut().zip(last).for_each(|(to, value)| *to = *value);
    }
}

/// Writes ids and t of a block, and hands back the lanes whose t f64 does not know well enough.
#[inline(always)]
fn block_answer<S: Simd>(
    simd: S,
    tile: &Tile,
    block: usize,
    first: Pixel,
    ids: &mut Lanes<u32>,
    t: &mut Lanes<f32>,
) -> u64 {
    let winners = u32x16::from_slice(simd, &tile.blocks.winner[block].0);
    let winners = winners & u32x16::splat(simd, !SAME_DEPTH);
    let mut left = !winners.simd_eq(u32x16::splat(simd, NOTHING)).to_bitmask() & 0xffff;
    if left == 0 {
        *ids = Lanes([u32::MAX; 16]);
        *t = Lanes([f32::INFINITY; 16]);
        return 0;
    }
    let [x, y] = first.sample();
    let x_lanes = f64x8::from_slice(simd, &[0.0, 1.0, 2.0, 3.0, 0.0, 1.0, 2.0, 3.0]) + x;
    let y_lanes = f64x8::from_slice(simd, &[0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0]) + y;
    let y_lanes = [y_lanes, y_lanes + 2.0];
    // Most blocks show one triangle and nothing else.
    let winner = tile.blocks.winner[block].0[0] & !SAME_DEPTH;
    if left == 0xffff && winners.simd_eq(u32x16::splat(simd, winner)).to_bitmask() & 0xffff == left
    {
        let drawn = &tile.drawn[winner as usize];
        let [a, b, c] = drawn.plane;
        let across = x_lanes * a;
        let volume = f64x8::splat(simd, drawn.volume);
        let least = f64x8::splat(simd, drawn.least_plane);
        let under = [(across + y_lanes[0] * b) + c, (across + y_lanes[1] * b) + c];
        let known = [under[0].simd_gt(least).to_bitmask(), under[1].simd_gt(least).to_bitmask()];
        (volume / under[0]).narrow(volume / under[1]).store_slice(&mut t.0);
        *ids = Lanes([drawn.id; 16]);
        return !(known[0] & 0xff | (known[1] & 0xff) << 8) & 0xffff;
    }
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
    doubtful
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
