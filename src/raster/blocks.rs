//! A tile's z-buffer: blocks of 4 × 4 pixels, each a vector, with certain bounds of 1/w.
//!
//! Blocks run row by row of blocks, lanes row by row of a block's pixels; sixteen blocks are one
//! vector of the first phase of drawing. Lanes outside the tile's window have 1/w = +∞, behind
//! which everything lies, so that nothing is ever drawn or doubted there.

use super::octet::Lanes;
use crate::mutant::{self, Mutant};
use crate::pixel::{Pixel, Window};
use crate::visibility::Cover;
use fearless_simd::f32x16;
use fearless_simd::prelude::*;

/// Side of a block, in pixels.
pub(super) const BLOCK_SIDE: u32 = 4;

/// Most blocks of a tile: those of a tile of 64 × 64 pixels.
pub(super) const MOST_BLOCKS: usize = 256;

/// Most vectors of sixteen blocks.
pub(super) const MOST_VECTORS: usize = MOST_BLOCKS / 16;

/// Largest side of a tile, in pixels.
pub(super) const MOST_SIDE: u32 = 64;

/// No triangle.
pub(super) const NOTHING: u32 = u32::MAX >> 1;

/// Set beside a lane's winner where another covering triangle has the same depth at the sample:
/// independent of the order of work, because a strictly nearer triangle replaces winner and mark.
pub(super) const SAME_DEPTH: u32 = 1 << 31;

/// How a tile's blocks lie.
pub(super) struct BlockGrid {
    /// Blocks per side of a tile.
    pub(super) per_side: usize,
    /// Vectors of sixteen blocks that hold them all.
    pub(super) vectors: usize,
    /// Per vector, each block's offset from the tile's first pixel, in pixels.
    pub(super) x: [Lanes<f32>; MOST_VECTORS],
    pub(super) y: [Lanes<f32>; MOST_VECTORS],
}

impl BlockGrid {
    /// The blocks of tiles of a side of 1…64 pixels.
    pub(super) fn new(side: u32) -> Self {
        let per_side = side.div_ceil(BLOCK_SIDE) as usize;
        let vectors = (per_side * per_side).div_ceil(16);
        let offset = |offset: fn(usize, usize) -> usize| {
            std::array::from_fn(|vector| {
                Lanes(std::array::from_fn(|lane| {
                    (offset(vector * 16 + lane, per_side) * BLOCK_SIDE as usize) as f32
                }))
            })
        };
        let x = offset(|block, per_side| block % per_side);
        let y = offset(|block, per_side| block / per_side);
        Self { per_side, vectors, x, y }
    }

    /// Number of blocks.
    pub(super) fn len(&self) -> usize {
        self.per_side * self.per_side
    }

    /// Largest offset of a sample from the tile's first, in pixels, along both axes.
    pub(super) fn reach(&self) -> f64 {
        (self.per_side as u32 * BLOCK_SIDE - 1) as f64
    }
}

/// The z-buffer.
pub(super) struct Blocks {
    /// Certain bounds of the winner's 1/w; −∞ where nothing was drawn.
    pub(super) low: Box<[Lanes<f32>; MOST_BLOCKS]>,
    pub(super) high: Box<[Lanes<f32>; MOST_BLOCKS]>,
    /// The winner, by its number among the tile's drawn triangles, or [`NOTHING`]; [`SAME_DEPTH`].
    pub(super) winner: Box<[Lanes<u32>; MOST_BLOCKS]>,
    /// Per block, the least `low` of its lanes: what lies certainly farther is hidden everywhere.
    pub(super) farthest: [Lanes<f32>; MOST_VECTORS],
    /// The least of all `farthest`.
    pub(super) farthest_of_all: f32,
    /// Counts, where they are asked for.
    pub(super) crossed: Vec<Lanes<i32>>,
    pub(super) signed: Vec<Lanes<i32>>,
}

impl Blocks {
    /// A z-buffer that must be cleared before its first tile.
    pub(super) fn new(counting: bool) -> Self {
        let counts = if counting { MOST_BLOCKS } else { 0 };
        Self {
            low: Box::new([Lanes([0.0; 16]); MOST_BLOCKS]),
            high: Box::new([Lanes([0.0; 16]); MOST_BLOCKS]),
            winner: Box::new([Lanes([NOTHING; 16]); MOST_BLOCKS]),
            farthest: [Lanes([f32::INFINITY; 16]); MOST_VECTORS],
            farthest_of_all: f32::NEG_INFINITY,
            crossed: vec![Lanes([0; 16]); counts],
            signed: vec![Lanes([0; 16]); counts],
        }
    }

    /// Nothing is drawn.
    pub(super) fn clear(&mut self, grid: &BlockGrid, window: Window) {
        let (mut width, height) = (window.width() as usize, window.height() as usize);
        if mutant::is(Mutant::TileEdges) {
            width -= 1;
        }
        let side = BLOCK_SIDE as usize;
        self.farthest_of_all = f32::NEG_INFINITY;
        self.crossed.fill(Lanes([0; 16]));
        self.signed.fill(Lanes([0; 16]));
        self.winner[..grid.len()].fill(Lanes([NOTHING; 16]));
        if width.min(height) == grid.per_side * side {
            self.low[..grid.len()].fill(Lanes([f32::NEG_INFINITY; 16]));
            self.high[..grid.len()].fill(Lanes([f32::NEG_INFINITY; 16]));
            for block in 0..grid.len() {
                self.farthest[block / 16].0[block % 16] = f32::NEG_INFINITY;
            }
            return;
        }
        for block in 0..grid.len() {
            let (x, y) = (block % grid.per_side * side, block / grid.per_side * side);
            let whole = x + side <= width && y + side <= height;
            let empty = match whole {
                true => Lanes([f32::NEG_INFINITY; 16]),
                false => Lanes(std::array::from_fn(|lane| {
                    match x + lane % side < width && y + lane / side < height {
                        true => f32::NEG_INFINITY,
                        false => f32::INFINITY,
                    }
                })),
            };
            (self.low[block], self.high[block]) = (empty, empty);
            let any = empty.0.contains(&f32::NEG_INFINITY);
            self.farthest[block / 16].0[block % 16] =
                if any { f32::NEG_INFINITY } else { f32::INFINITY };
        }
    }

    /// Brings `farthest` up to date for blocks in which something was drawn.
    #[inline(always)]
    pub(super) fn update_farthest<S: Simd>(&mut self, simd: S, grid: &BlockGrid, drawn: [u64; 4]) {
        for (word, mut left) in drawn.into_iter().enumerate() {
            while left != 0 {
                let block = (word * 64 + left.trailing_zeros() as usize) & (MOST_BLOCKS - 1);
                left &= left - 1;
                let low = f32x16::from_slice(simd, &self.low[block].0);
                self.farthest[block / 16].0[block % 16] = low.reduce_min();
            }
        }
        let mut least = f32x16::splat(simd, f32::INFINITY);
        for vector in &self.farthest[..grid.vectors] {
            least = least.min(f32x16::from_slice(simd, &vector.0));
        }
        self.farthest_of_all = least.reduce_min();
    }

    /// What was counted at a lane.
    pub(super) fn cover(&self, block: usize, lane: usize) -> Cover {
        Cover { crossed: self.crossed[block].0[lane] as u32, signed: self.signed[block].0[lane] }
    }
}

/// Block and lane of a pixel of a tile's window.
pub(super) fn place(grid: &BlockGrid, window: Window, pixel: Pixel) -> (usize, usize) {
    let (x, y) = ((pixel.x - window.x0()) as usize, (pixel.y - window.y0()) as usize);
    let side = BLOCK_SIDE as usize;
    (y / side * grid.per_side + x / side, y % side * side + x % side)
}

/// The pixel of a block's lane.
pub(super) fn pixel(grid: &BlockGrid, window: Window, block: usize, lane: usize) -> Pixel {
    let (x, y) = (block % grid.per_side, block / grid.per_side);
    let side = BLOCK_SIDE as usize;
    Pixel {
        x: window.x0() + (x * side + lane % side) as u32,
        y: window.y0() + (y * side + lane / side) as u32,
    }
}
