//! All that a buffer holds, by tiles: the ids first, then what is known of each surface.

use super::CastOptions;
use super::fill::{self, Table};
use super::memo::{PicturePairs, SamePlane};
use super::strips::strips;
use super::tile::{self, Frame, Memory, SIDE, Work};
use crate::accel::Accelerator;
use crate::pixel::Window;
use crate::scene::Scene;
use crate::visibility::{LevelCounts, VisibilityBuffer};
use rayon::prelude::*;

/// What is visible at every pixel of `window`.
pub(super) fn cast_whole(
    scene: &Scene,
    accelerator: &Accelerator,
    window: Window,
    options: CastOptions,
    done: &(dyn Fn() + Sync),
) -> VisibilityBuffer {
    let frame = Frame::new(scene, accelerator);
    let pairs = PicturePairs::default();
    // Written here first by the threads that fill it, which spreads the cost of fresh memory.
    let mut visible: Vec<_> = (0..window.len()).into_par_iter().map(|_| None).collect();
    let side = options.side.min(SIDE as u32);
    let counts: Vec<LevelCounts> = strips(window, &mut visible)
        .into_par_iter()
        .map_init(
            || (Work::new(), Table::new()),
            |(work, table), (strip, mut rows)| {
                let mut memory =
                    Memory { same_plane: SamePlane::new(&pairs), levels: LevelCounts::default() };
                for window in strip.tiles(side) {
                    let tile =
                        tile::cast_tile::<true>(&frame, window, options.simd, work, &mut memory);
                    if let Some(samples) = tile {
                        samples.count_levels(&mut memory.levels);
                        let top = (window.y0() - strip.y0()) as usize;
                        let rows = &mut rows[top..top + window.height() as usize];
                        let first = (window.x0() - strip.x0()) as usize;
                        fill::fill(&frame, window, options.simd, samples, table, rows, first);
                    }
                    done();
                }
                memory.levels
            },
        )
        .collect();
    let mut levels = LevelCounts::default();
    counts.into_iter().for_each(|of_strip| levels.add(of_strip));
    VisibilityBuffer { window, visible, cover: None, levels }
}
