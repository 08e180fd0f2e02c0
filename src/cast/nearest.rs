//! Only the nearest triangle and its t at every sample: what is visible, and nothing about it.

use super::CastOptions;
use super::memo::{PicturePairs, SamePlane};
use super::strips::{STRIPS_AT_ONCE, strips};
use super::tile::{self, BLOCK, Frame, Memory, NOTHING, SIDE, Samples, Work, lane_of};
use crate::accel::Accelerator;
use crate::pixel::Window;
use crate::scene::Scene;
use crate::visibility::{LevelCounts, NearestBuffer};
use rayon::prelude::*;

/// The nearest triangle at every pixel of `window`, exactly, and its t to f32, with `accelerator`
/// built over the scene's mesh. `done` is called once per finished tile of 32 × 32 pixels, from any
/// thread.
pub fn cast_nearest(
    scene: &Scene,
    accelerator: &Accelerator,
    window: Window,
    options: CastOptions,
    done: &(dyn Fn() + Sync),
) -> NearestBuffer {
    let mut buffer = NearestBuffer {
        window,
        ids: vec![NOTHING; window.len()],
        t: vec![f32::INFINITY; window.len()],
        levels: LevelCounts::default(),
    };
    cast_nearest_into(scene, accelerator, options, &mut buffer, done);
    buffer
}

/// As [`cast_nearest`], into a buffer that there is already: all of it is written.
pub fn cast_nearest_into(
    scene: &Scene,
    accelerator: &Accelerator,
    options: CastOptions,
    buffer: &mut NearestBuffer,
    done: &(dyn Fn() + Sync),
) {
    let frame = Frame::new(scene, accelerator);
    let pairs = PicturePairs::default();
    let ids = strips(buffer.window, &mut buffer.ids);
    let t = strips(buffer.window, &mut buffer.t);
    let counts: Vec<LevelCounts> = ids
        .into_par_iter()
        .zip(t)
        .with_max_len(STRIPS_AT_ONCE)
        .map_init(Work::new, |work, ((strip, mut ids), (_, mut t))| {
            let mut memory =
                Memory { same_plane: SamePlane::new(&pairs), levels: LevelCounts::default() };
            for window in strip.tiles(SIDE as u32) {
                let samples =
                    tile::cast_tile::<true>(&frame, window, options.simd, work, &mut memory);
                write(window, strip, samples, &mut ids, &mut t);
                done();
            }
            memory.levels
        })
        .collect();
    buffer.levels = LevelCounts::default();
    counts.into_iter().for_each(|levels| buffer.levels.add(levels));
}

/// Writes a tile's answer to its columns of a strip's rows.
pub(super) fn write(
    window: Window,
    strip: Window,
    samples: Option<&Samples>,
    ids: &mut [&mut [u32]],
    t: &mut [&mut [f32]],
) {
    let first = (window.x0() - strip.x0()) as usize;
    let columns = first..first + window.width() as usize;
    match samples {
        None => {
            ids.iter_mut().for_each(|row| row[columns.clone()].fill(NOTHING));
            t.iter_mut().for_each(|row| row[columns.clone()].fill(f32::INFINITY));
        }
        Some(samples) => {
            copy(&samples.ids, ids, columns.clone());
            copy(&samples.t, t, columns);
        }
    }
}

/// Copies a tile's values, kept by blocks, to its columns of a strip's rows.
fn copy<T: Copy>(
    blocks: &[[T; BLOCK * BLOCK]],
    rows: &mut [&mut [T]],
    columns: std::ops::Range<usize>,
) {
    for (y, row) in rows.iter_mut().enumerate() {
        let (quads, rest) = row[columns.clone()].as_chunks_mut::<BLOCK>();
        for (column, quad) in quads.iter_mut().enumerate() {
            let (block, lane) = lane_of(column * BLOCK, y);
            *quad = blocks[block].as_chunks::<BLOCK>().0[lane / BLOCK];
        }
        let done = quads.len() * BLOCK;
        for (x, place) in rest.iter_mut().enumerate() {
            let (block, lane) = lane_of(done + x, y);
            *place = blocks[block][lane];
        }
    }
}
