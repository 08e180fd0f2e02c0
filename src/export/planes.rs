//! The planes of the bundle, answered and written in bands of rows.
//!
//! A pixel's full answer takes 80 bytes in memory and 27 in the files; a band of about a million
//! pixels keeps the first below 100 MB for any picture.

use super::PixelCounts;
use super::spool::Spool;
use crate::accel::Accelerator;
use crate::cast::{TILE_SIDE, cast};
use crate::pixel::Window;
use crate::raster::{STANDARD_HALF_WIDTH, stability};
use crate::render::Progress;
use crate::scene::Scene;
use crate::visibility::{Counting, VisibilityBuffer};
use std::io;

/// The planes, in the order in which [`write`] takes their files.
pub(super) const NAMES: [&str; 7] =
    ["prim.npy", "t_lo.npy", "t_hi.npy", "cover.npy", "facing.npy", "tie.npy", "stable.npy"];

/// Nothing is visible, in `prim.npy`.
const NOTHING: u32 = u32::MAX;

/// Pixels of a band, about.
const BAND_PIXELS: u32 = 1 << 20;

/// Writes the planes to `spools`, which are [`NAMES`] in this order.
pub(super) fn write(
    scene: &Scene,
    accelerator: &Accelerator,
    spools: &mut [Spool],
    progress: &dyn Progress,
) -> io::Result<PixelCounts> {
    let [prim, t_lo, t_hi, cover, facing, tie, stable] = spools else {
        return Err(io::Error::other("one file per plane"));
    };
    let frame = scene.camera.resolution();
    let shape = [u64::from(frame.height()), u64::from(frame.width())];
    let mut prim = prim.begin_array::<u32>(&shape, "<u4")?;
    let mut t_lo = t_lo.begin_array::<f64>(&shape, "<f8")?;
    let mut t_hi = t_hi.begin_array::<f64>(&shape, "<f8")?;
    let mut cover = cover.begin_array::<u32>(&shape, "<u4")?;
    let mut facing = facing.begin_array::<i8>(&shape, "|i1")?;
    let mut tie = tie.begin_array::<u8>(&shape, "|u1")?;
    let mut stable = stable.begin_array::<u8>(&shape, "|u1")?;
    let mut counts = PixelCounts::default();
    let bands = bands(frame.window(), BAND_PIXELS, scene);
    let tiles: usize = bands.iter().map(|band| band.tiles(TILE_SIDE).len()).sum();
    progress.begin("export", 2 * tiles);
    for band in bands {
        let answer = cast(scene, accelerator, band, Counting::All, &|| progress.step());
        let is_stable = stability(scene, &answer, STANDARD_HALF_WIDTH, &|| progress.step());
        count(&mut counts, &answer, &is_stable);
        let visible = || answer.visible.iter().map(Option::as_ref);
        prim.extend(visible().map(|v| v.map_or(NOTHING, |v| v.triangle.get())))?;
        t_lo.extend(visible().map(|v| v.map_or(0.0, |v| v.t_lo)))?;
        t_hi.extend(visible().map(|v| v.map_or(0.0, |v| v.t_hi)))?;
        facing.extend(visible().map(|v| v.map_or(0, |v| v.facing.sign())))?;
        tie.extend(visible().map(|v| v.map_or(0, |v| u8::from(v.tie))))?;
        stable.extend(is_stable.into_iter().map(u8::from))?;
        cover.extend(answer.cover.iter().flatten().map(|cover| cover.crossed))?;
    }
    prim.finish()?;
    t_lo.finish()?;
    t_hi.finish()?;
    cover.finish()?;
    facing.finish()?;
    tie.finish()?;
    stable.finish()?;
    Ok(counts)
}

fn count(counts: &mut PixelCounts, answer: &VisibilityBuffer, is_stable: &[bool]) {
    counts.covered += answer.covered_pixels() as u64;
    counts.tied += answer.visible.iter().flatten().filter(|visible| visible.tie).count() as u64;
    counts.unstable += is_stable.iter().filter(|stable| !**stable).count() as u64;
}

/// The window cut into bands of whole rows, about `pixels` pixels each. A band begins where a row
/// of tiles does.
fn bands(window: Window, pixels: u32, scene: &Scene) -> Vec<Window> {
    let rows = (pixels / window.width()).max(TILE_SIDE) / TILE_SIDE * TILE_SIDE;
    (window.y0()..window.y1())
        .step_by(rows as usize)
        .filter_map(|y| {
            let end = y.saturating_add(rows).min(window.y1());
            Window::new(scene.camera.resolution(), window.x0(), y, window.x1(), end)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pixel::Resolution;
    use crate::scene::camera::PinholeCamera;

    #[test]
    fn bands_are_the_frame_from_top_to_bottom() {
        let frame = Resolution::new(70, 170).unwrap();
        let (dx, dy) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
        let camera = PinholeCamera::exact(frame, [0.0; 3], [0.0, 0.0, 9.0], dx, dy).unwrap();
        let scene = Scene::from_triangles(camera, &[]);
        for (pixels, rows) in [(1, 32), (70 * 64, 64), (70 * 95, 64), (u32::MAX, 170)] {
            let bands = bands(frame.window(), pixels, &scene);
            assert_eq!(bands[0].height(), rows);
            let in_order: Vec<_> = bands.iter().flat_map(|band| band.pixels()).collect();
            assert!(in_order.into_iter().eq(frame.window().pixels()));
        }
    }
}
