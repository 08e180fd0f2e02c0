//! A window seen at several samples per pixel, by cameras that are shifted on their lattice, in
//! bands of rows so that no second full buffer is held.
//!
//! What is made of the answers is the caller's business.

use super::answerer::Answerer;
use super::progress::Progress;
use crate::pixel::Window;
use crate::scene::Scene;
use crate::visibility::{Counting, VisibilityBuffer};

/// Rows that are answered at once.
const BAND_ROWS: u32 = 256;

/// Asks about `window` at every offset, in 1/256 pixel from the pixels' centres, and hands on each
/// band's answer with the scene under the shifted camera: all bands of the first offset, then
/// those of the second, and so on. One step of the progress stage `stage` per band and offset.
pub(super) fn for_each_subsample(
    scene: &Scene,
    answerer: &Answerer,
    window: Window,
    offsets: impl Iterator<Item = [i32; 2]>,
    (stage, progress): (&str, &dyn Progress),
    mut each: impl FnMut(&Scene, &VisibilityBuffer),
) {
    let offsets: Vec<_> = offsets.collect();
    let bands = bands(scene, window, BAND_ROWS);
    progress.begin(stage, offsets.len() * bands.len());
    let mut shifted = scene.clone();
    for offset in offsets {
        shifted.camera = scene.camera.shifted(offset);
        for &band in &bands {
            let answer = answerer.answer(&shifted, band, Counting::Nearest, &|| ());
            each(&shifted, &answer);
            progress.step();
        }
    }
}

/// The window cut into bands of at most `rows` rows.
pub(super) fn bands(scene: &Scene, window: Window, rows: u32) -> Vec<Window> {
    let frame = scene.camera.resolution();
    (window.y0()..window.y1())
        .step_by(rows as usize)
        .filter_map(|y| {
            let end = y.saturating_add(rows).min(window.y1());
            Window::new(frame, window.x0(), y, window.x1(), end)
        })
        .collect()
}
