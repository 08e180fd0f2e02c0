//! All that a buffer holds, by tiles: the ids first, then what is known of each surface.
//!
//! What the tiles of a picture share is made once, so that the picture can be cast in bands.

use super::CastOptions;
use super::fill::{self, Table};
use super::memo::{PicturePairs, SamePlane};
use super::strips::strips;
use super::tile::{self, Frame, Memory, SIDE, Work};
use crate::accel::Accelerator;
use crate::pixel::Window;
use crate::scene::Scene;
use crate::visibility::{LevelCounts, VisibilityBuffer, Visible};
use rayon::prelude::*;
use std::sync::{Mutex, PoisonError};

/// A thread's memory for its strips.
type Room = (Box<Work>, Table);

/// What all tiles of a picture share, and memory that waits for the next of them.
pub(super) struct Whole<'a> {
    frame: Frame<'a>,
    pairs: PicturePairs,
    rooms: Mutex<Vec<Room>>,
}

impl<'a> Whole<'a> {
    pub(super) fn new(scene: &'a Scene, accelerator: &'a Accelerator) -> Self {
        let frame = Frame::new(scene, accelerator);
        Self { frame, pairs: PicturePairs::default(), rooms: Mutex::default() }
    }
}

/// Finds what is visible at every pixel of `window`.
pub(super) fn cast_whole(
    whole: &Whole<'_>,
    window: Window,
    options: CastOptions,
    buffer: &mut VisibilityBuffer,
    done: &(dyn Fn() + Sync),
) {
    buffer.turn_to(window);
    let counts: Vec<LevelCounts> = strips(window, &mut buffer.visible)
        .into_par_iter()
        .map(|(strip, rows)| {
            // Nothing can fail while the lock is held.
            let rooms = || whole.rooms.lock().unwrap_or_else(PoisonError::into_inner);
            let room = rooms().pop();
            let mut room = room.unwrap_or_else(|| (Work::new(), Table::new()));
            let levels = cast_strip(whole, strip, rows, options, &mut room, done);
            rooms().push(room);
            levels
        })
        .collect();
    counts.into_iter().for_each(|of_strip| buffer.levels.add(of_strip));
}

fn cast_strip(
    whole: &Whole<'_>,
    strip: Window,
    mut rows: Vec<&mut [Option<Visible>]>,
    options: CastOptions,
    (work, table): &mut Room,
    done: &(dyn Fn() + Sync),
) -> LevelCounts {
    let frame = &whole.frame;
    let side = options.side.min(SIDE as u32);
    let same_plane = SamePlane::new(&whole.pairs);
    let mut memory = Memory { same_plane, levels: LevelCounts::default() };
    for window in strip.tiles(side) {
        let tile = tile::cast_tile::<true>(frame, window, options.simd, work, &mut memory);
        let top = (window.y0() - strip.y0()) as usize;
        let rows = &mut rows[top..top + window.height() as usize];
        let first = (window.x0() - strip.x0()) as usize;
        match tile {
            Some(samples) => {
                samples.count_levels(&mut memory.levels);
                fill::fill(frame, window, options.simd, samples, table, rows, first);
            }
            None => {
                let columns = first..first + window.width() as usize;
                rows.iter_mut().for_each(|row| row[columns.clone()].fill(None));
            }
        }
        done();
    }
    memory.levels
}
