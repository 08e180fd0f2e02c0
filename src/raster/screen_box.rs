//! The tiles and blocks that eight triangles can meet, by f32 bounding boxes of their images.
//!
//! Only triangles certainly before the eye have a box (`frame::FRONT`); the others get everything.
//! A box drops samples and never accepts one, so that room for rounding costs nothing but time.

use super::frame::Frame;
use super::octet::{Images, Lanes};
use super::tile_lists::Grid;
use crate::mutant::{self, Mutant};
use crate::pixel::Window;
use fearless_simd::prelude::*;
use fearless_simd::{f32x16, i32x16, mask32x16};

/// What a box is widened by, in shares of its coordinates: numerator, denominator and quotient round
/// to f32 (3·2^-24), f64 adds 6u·2^10 (`frame::FRONT`, 2^-40), and widening and moving by ½ round
/// three times.
const SHARE: f32 = 1.0 / (1 << 20) as f32;

/// Columns in lanes 0…7, rows in lanes 8…15.
pub(super) struct ScreenBoxes<S: Simd> {
    /// First and last sample of the window, less ½.
    first: f32x16<S>,
    last: f32x16<S>,
    room: f32,
    /// Tiles per pixel, and the window's first tile.
    tiles: f32,
    first_tile: i32x16<S>,
}

impl<S: Simd> ScreenBoxes<S> {
    #[inline(always)]
    pub(super) fn new(simd: S, frame: &Frame, window: Window, grid: Grid) -> Self {
        let lanes = |x: u32, y: u32| {
            let mut lanes = [x as f32; 16];
            lanes[8..].fill(y as f32);
            f32x16::from_slice(simd, &lanes)
        };
        let mut first_tile = [grid.first_column as i32; 16];
        first_tile[8..].fill(grid.first_row as i32);
        Self {
            first: lanes(window.x0(), window.y0()),
            last: lanes(window.x1() - 1, window.y1() - 1),
            room: frame.box_room as f32,
            tiles: 1.0 / grid.side as f32,
            first_tile: i32x16::from_slice(simd, &first_tile),
        }
    }

    /// First and last pixel that the triangles can cover. `front` tells which have a box.
    #[inline(always)]
    fn pixels(&self, simd: S, images: &Images<S>, front: u64) -> [f32x16<S>; 2] {
        let [a, b, c] = &images.points;
        let (a, b, c) = (
            a[0].narrow(a[1]) / a[2].narrow(a[2]),
            b[0].narrow(b[1]) / b[2].narrow(b[2]),
            c[0].narrow(c[1]) / c[2].narrow(c[2]),
        );
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        // Pixel i has its sample at i + ½.
        let from = (low - (low.abs() * SHARE + self.room) - 0.5).ceil();
        let mut to = (high + (high.abs() * SHARE + self.room) - 0.5).floor();
        if mutant::is(Mutant::ShortBounds) {
            to -= 1.0;
        }
        let front = mask32x16::from_bitmask(simd, front | front << 8);
        [front.select(from.max(self.first), self.first), front.select(to.min(self.last), self.last)]
    }

    /// First and last tile, counted from the window's first, and the triangles that have none.
    #[inline(always)]
    pub(super) fn tiles(&self, simd: S, images: &Images<S>, front: u64) -> ([Lanes<i32>; 2], u64) {
        let [from, to] = self.pixels(simd, images, front);
        let empty = from.simd_gt(to).to_bitmask();
        let mut tiles = [Lanes([0; 16]); 2];
        for (bound, tiles) in [from, to].into_iter().zip(&mut tiles) {
            // (pixel + ½)/side is at least 2^-7 away from an integer and off by less: side ≤ 64, and
            // quotients of pixels below 2^16 round by 2^-24 of themselves, twice.
            let tile: i32x16<S> = ((bound + 0.5) * self.tiles).floor().to_int();
            (tile - self.first_tile).store_slice(&mut tiles.0);
        }
        (tiles, (empty | empty >> 8) & 0xff)
    }

    /// First and last block of 4 × 4 pixels, counted from the window's first pixel.
    #[inline(always)]
    pub(super) fn blocks(
        &self,
        simd: S,
        images: &Images<S>,
        front: u64,
        first: &mut Lanes<i32>,
        last: &mut Lanes<i32>,
    ) -> Met<S> {
        let [from, to] = self.pixels(simd, images, front);
        let empty = from.simd_gt(to).to_bitmask();
        let few = (to - from).simd_le(1.0).to_bitmask();
        let from = from - self.first;
        for (bound, blocks) in [(from, first), (to - self.first, last)] {
            let block: i32x16<S> = (bound * 0.25).to_int();
            block.store_slice(&mut blocks.0);
        }
        let (x, y) = from.split();
        Met {
            none: (empty | empty >> 8) & 0xff,
            few: few & few >> 8 & 0xff,
            x: x.combine(x),
            y: y.combine(y),
        }
    }
}

/// The pixels of a window that eight triangles can meet.
pub(super) struct Met<S: Simd> {
    /// Triangles that meet none.
    pub(super) none: u64,
    /// Triangles that meet at most 2 × 2.
    pub(super) few: u64,
    /// First column and row, from the window's first, in both halves of a vector.
    pub(super) x: f32x16<S>,
    pub(super) y: f32x16<S>,
}
