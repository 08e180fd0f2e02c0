//! The answer's numbers for the visible triangle of each pixel.
//!
//! They depend on (triangle, pixel) alone, never on the order of the work: weights and t come from
//! the triangle's integer rows, the level from its f64 rows over the whole frame. Pixels of one
//! triangle in a block are answered eight at a time, without fused operations; where that leaves a
//! doubt, one by one.

use super::blocks::{self, BLOCK_SIDE, NOTHING, SAME_DEPTH};
use super::coverage::{Coverage, coverage};
use super::doubt::Doubt;
use super::exact::ExactTriangle;
use super::exact_row::doubled;
use super::rows::{TriangleRows, U};
use super::shown::Shown;
use super::strips::Strip;
use super::tile::{Tile, Tiling};
use crate::mesh::{Barycentric, TriangleId};
use crate::mutant::{self, Mutant};
use crate::pixel::Pixel;
use crate::visibility::{Cover, Facing, Level, LevelCounts, Visible};
use fearless_simd::prelude::*;
use fearless_simd::{dispatch, f64x8, u32x16};

/// What a tile's visible triangles have in common for all their pixels, by number; the inner `None`
/// where only the exact stage answers.
type Known = Vec<Option<Option<Box<(TriangleRows, Shown)>>>>;

/// Turns a tile's z-buffer into visible triangles, and writes what was counted.
pub(super) fn write(
    tiling: &Tiling<'_>,
    tile: &Tile,
    doubt: &mut Doubt<'_>,
    visible: &mut Strip<'_, Option<Visible>>,
    cover: Option<&mut Strip<'_, Cover>>,
) {
    let simd = tiling.simd.dispatched();
    dispatch!(simd, simd => write_blocks(simd, tiling, tile, doubt, visible));
    if let Some(cover) = cover {
        for pixel in doubt.window.pixels() {
            let (block, lane) = blocks::place(&tiling.blocks, doubt.window, pixel);
            cover.row_from(pixel)[0] = tile.blocks.cover(block, lane);
        }
    }
}

#[inline(always)]
fn write_blocks<S: Simd>(
    simd: S,
    tiling: &Tiling<'_>,
    tile: &Tile,
    doubt: &mut Doubt<'_>,
    visible: &mut Strip<'_, Option<Visible>>,
) {
    let (grid, window, side) = (&tiling.blocks, doubt.window, BLOCK_SIDE as usize);
    let mut known: Known = std::iter::repeat_with(|| None).take(tile.drawn.len()).collect();
    let left = (window.x0() - visible.tiles[0].x0()) as usize;
    let right = left + window.width() as usize;
    for row in 0..(window.height() as usize).div_ceil(side) {
        let rows = row * side..(row * side + side).min(window.height() as usize);
        for column in 0..(window.width() as usize).div_ceil(side) {
            let block = row * grid.per_side + column;
            let from = left + column * side;
            let columns = from..right.min(from + side);
            let winners = u32x16::from_slice(simd, &tile.blocks.winner[block].0);
            let winners = winners & u32x16::splat(simd, !SAME_DEPTH);
            let nothing = winners.simd_eq(u32x16::splat(simd, NOTHING)).to_bitmask() & 0xffff;
            if nothing != 0 {
                for row in &mut visible.rows[rows.clone()] {
                    row[columns.clone()].fill(None);
                }
            }
            let mut waiting = !nothing & 0xffff;
            while waiting != 0 {
                // All lanes of one winner together.
                let first = waiting.trailing_zeros() as usize & 15;
                let number = tile.blocks.winner[block].0[first] & !SAME_DEPTH;
                let lanes = winners.simd_eq(u32x16::splat(simd, number)).to_bitmask() & 0xffff;
                waiting &= !lanes;
                let known = &mut known[number as usize];
                let place = [block, number as usize];
                let mut put = |lane: usize, answer: Option<Visible>| {
                    visible.rows[rows.start + lane / side][from + lane % side] = answer;
                };
                write_lanes(simd, tiling, tile, doubt, known, place, lanes as u32, &mut put);
            }
        }
    }
}

/// Weights, t and whether both and the coverage are known without the exact stage, of eight lanes.
#[derive(Default)]
struct Eight {
    weights: [[f64; 8]; 3],
    t: [f64; 8],
    known: u64,
}

/// Answers one triangle's lanes of a block.
#[inline(always)]
#[allow(clippy::too_many_arguments, reason = "one loop over everything that a tile has")]
fn write_lanes<S: Simd>(
    simd: S,
    tiling: &Tiling<'_>,
    tile: &Tile,
    doubt: &mut Doubt<'_>,
    known: &mut Option<Option<Box<(TriangleRows, Shown)>>>,
    [block, number]: [usize; 2],
    lanes: u32,
    put: &mut impl FnMut(usize, Option<Visible>),
) {
    let id = TriangleId::new(tile.drawn[number].id);
    let triangle = known.get_or_insert_with(|| {
        let shown = Shown::new(&tiling.plane, tiling.mesh.triangle(id))?;
        let rows = doubt.rows_of(&tile.drawn, number as u32)?;
        Some(Box::new((rows.as_ref().clone(), shown)))
    });
    for half in 0..2 {
        let mut left = lanes >> (8 * half) & 0xff;
        if left == 0 {
            continue;
        }
        let eight = match triangle.as_deref() {
            Some((rows, shown)) => {
                let first = blocks::pixel(&tiling.blocks, doubt.window, block, 8 * half);
                eight(simd, rows, shown, first)
            }
            None => Eight::default(),
        };
        while left != 0 {
            let lane = left.trailing_zeros() as usize & 7;
            left &= left - 1;
            let same_depth = tile.blocks.winner[block].0[8 * half + lane] & SAME_DEPTH != 0;
            let answer = match triangle.as_deref() {
                Some((_, shown)) if eight.known >> lane & 1 == 1 => {
                    let covered = Coverage { exact: false, on_edge: false };
                    let weights = [0, 1, 2].map(|k| eight.weights[k][lane]);
                    let numbers = (shown.volume_sign, mutant::shifted(weights), eight.t[lane]);
                    Some(assembled(id, covered, same_depth, numbers))
                }
                _ => {
                    let pixel = blocks::pixel(&tiling.blocks, doubt.window, block, 8 * half + lane);
                    one(doubt, tile, number, pixel, same_depth)
                }
            };
            put(8 * half + lane, answer);
        }
    }
}

/// The lanes from a pixel on: four of its row and four of the next.
#[inline(always)]
fn eight<S: Simd>(simd: S, rows: &TriangleRows, shown: &Shown, first: Pixel) -> Eight {
    let [x, y] = first.sample();
    let steps_x = f64x8::from_slice(simd, &[0.0, 1.0, 2.0, 3.0, 0.0, 1.0, 2.0, 3.0]);
    let steps_y = f64x8::from_slice(simd, &[0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0]);
    let [x2, y2] = doubled(first).map(|c| c as f64);
    let (weights, t, mut known) = shown.at(simd, steps_x * 2.0 + x2, steps_y * 2.0 + y2);
    let (x, y) = (steps_x + x, steps_y + y);
    for edge in &rows.edges {
        let value = (x * edge.a + y * edge.b) + edge.c;
        known &= value.simd_gt(f64x8::splat(simd, edge.bound)).to_bitmask();
    }
    let mut eight = Eight { known, ..Eight::default() };
    for (weights, lanes) in weights.iter().zip(&mut eight.weights) {
        weights.store_slice(lanes);
    }
    t.store_slice(&mut eight.t);
    eight
}

/// The answer for one pixel by the exact stage.
#[cold]
fn one(
    doubt: &mut Doubt<'_>,
    tile: &Tile,
    number: usize,
    pixel: Pixel,
    same_depth: bool,
) -> Option<Visible> {
    let id = TriangleId::new(tile.drawn[number].id);
    let rows = doubt.rows_of(&tile.drawn, number as u32)?;
    // What the visible triangle's own coverage takes; counted when it was decided.
    let mut counted = LevelCounts::default();
    let covered = coverage(&mut doubt.exact, &mut counted, &rows, [true; 3], pixel);
    let covered = covered.unwrap_or(Coverage { exact: true, on_edge: true });
    let triangle = doubt.exact.triangle(id)?;
    Some(answer(pixel, id, covered, same_depth, &triangle))
}

/// The answer for one triangle at one pixel.
pub(super) fn answer(
    pixel: Pixel,
    id: TriangleId,
    covered: Coverage,
    same_depth: bool,
    triangle: &ExactTriangle,
) -> Visible {
    let numbers = (triangle.volume_sign, triangle.weights_at(pixel), triangle.t_at(pixel));
    assembled(id, covered, same_depth, numbers)
}

/// Puts sgn V, weights and t into the answer's shape.
fn assembled(
    id: TriangleId,
    covered: Coverage,
    same_depth: bool,
    (volume_sign, weights, t): (i32, [f64; 3], f64),
) -> Visible {
    let on_edge = covered.on_edge && !mutant::is(Mutant::UnmarkedTies);
    let tie = on_edge || same_depth;
    let front = (volume_sign < 0) != mutant::is(Mutant::FacingFlipped);
    Visible {
        triangle: id,
        facing: if front { Facing::Front } else { Facing::Back },
        level: if covered.exact || tie { Level::Exact } else { Level::Double },
        tie,
        barycentric: Barycentric(weights),
        // t is off by at most 6u; the factors' own roundings and products take 2u more.
        t_lo: t * (1.0 - 12.0 * U),
        t_hi: t * (1.0 + 12.0 * U),
    }
}
