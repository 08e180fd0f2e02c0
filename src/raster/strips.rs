//! A row-major buffer cut into strips of tiles, each of which a thread can fill.
//!
//! Tiles side by side share a strip, so that there are few of them and no thread copies what
//! another wrote.

use crate::pixel::{Pixel, Window};
use rayon::prelude::*;

/// Tiles per strip.
const TILES: usize = 8;

/// Neighbouring tiles and their part of a buffer.
pub(super) struct Strip<'a, T> {
    /// The tiles, from left to right.
    pub(super) tiles: Vec<Window>,
    /// Rows of pixels, from top to bottom, from the first tile's first column on.
    pub(super) rows: Vec<&'a mut [T]>,
}

impl<T> Strip<'_, T> {
    /// The row of pixels that starts at a pixel of the strip.
    pub(super) fn row_from(&mut self, pixel: Pixel) -> &mut [T] {
        let first = self.tiles[0];
        let row = &mut self.rows[(pixel.y - first.y0()) as usize];
        &mut row[(pixel.x - first.x0()) as usize..]
    }
}

/// Cuts a buffer of a window's pixels into strips of tiles of `side` × `side` pixels.
pub(super) fn strips<T>(window: Window, side: u32, buffer: &mut [T]) -> Vec<Strip<'_, T>> {
    let columns = (window.x1().div_ceil(side) - window.x0() / side) as usize;
    let mut strips: Vec<Strip<'_, T>> = Vec::new();
    let tiles = window.tiles(side);
    let mut rows = buffer.chunks_mut(window.width() as usize);
    for tiles in tiles.chunks(columns) {
        let first = strips.len();
        for tiles in tiles.chunks(TILES) {
            strips.push(Strip { tiles: tiles.to_vec(), rows: Vec::new() });
        }
        for mut row in rows.by_ref().take(tiles[0].height() as usize) {
            for strip in &mut strips[first..] {
                let width = strip.tiles.iter().map(|tile| tile.width() as usize).sum();
                let (part, rest) = row.split_at_mut(width);
                strip.rows.push(part);
                row = rest;
            }
        }
    }
    strips
}

/// Works on strips in parallel, `work(room, strip)`, with room to work in per thread, and adds up
/// what it hands back.
pub(super) fn for_each_strip<I, R, O>(
    strips: Vec<I>,
    room: impl Fn() -> R + Sync + Send,
    work: impl Fn(&mut R, I) -> O + Sync + Send,
) -> Vec<O>
where
    I: Send,
    R: Send,
    O: Send,
{
    strips.into_par_iter().map_init(room, work).collect()
}
