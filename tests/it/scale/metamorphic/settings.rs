//! H84 and H85: settings that must not matter, and windows of the frame.

use super::scenes_with_ties;
use crate::scale::cover;
use crate::support::closed::sphere;
use crate::support::configurations::{Breadth, FULL, NARROW, agreed_within};
use crate::support::scenes::{grid_camera, pixel_grid, standard_scene};
use truecast::accel::{Accelerator, BuildPreset};
use truecast::cast::{CastOptions, cast_with};
use truecast::pixel::Window;
use truecast::raster::{rasterize, rasterize_in_tiles};
use truecast::scene::Scene;
use truecast::visibility::Counting;

/// Tile sides, threads and build presets, on a frame of many tiles. (The rasterizer's
/// instruction sets are varied in `raster::levels`.)
#[test]
fn h84_settings() {
    let mut triangles = pixel_grid(101, 4, 8.0);
    triangles.extend(sphere(24, 48, 30.0, [0.0, 0.0, 40.0]).iter().map(|t| {
        // Seen in front of and through the grid.
        t.map(|v| v.map(|c| c * 0.2))
    }));
    let scene = Scene::from_triangles(grid_camera(101, 8.0), &triangles);
    let breadth = Breadth { tile_sides: &[1, 2, 3, 8, 16, 31, 32, 33, 64, 200], ..FULL };
    let breadth = Breadth { audited_pixels: 300, ..breadth };
    let buffer = agreed_within(&scene, &breadth, "grid and sphere");
    assert_eq!(buffer.covered_pixels(), 100 * 100);
    assert!(buffer.visible.iter().flatten().filter(|v| v.tie).count() > 2000);
}

/// Every crop is the part of its frame, by both paths and at odd tile sizes.
#[test]
fn h85_crops() {
    for (name, triangles) in scenes_with_ties() {
        let scene = standard_scene(&triangles);
        let whole = agreed_within(&scene, &NARROW, &name);
        let raster = rasterize(&scene, whole.window, Counting::All, &|| ());
        let tree = Accelerator::build(&scene.mesh, BuildPreset::Fast);
        let frame = scene.camera.resolution();
        for [x0, y0, x1, y1] in
            [[3, 5, 14, 11], [0, 0, 1, 1], [16, 16, 17, 17], [8, 0, 9, 17], [0, 8, 17, 9]]
        {
            let window = Window::new(frame, x0, y0, x1, y1).unwrap();
            for side in [4, 32] {
                let options = CastOptions { side, ..CastOptions::default() };
                let crops = [
                    (&whole, cast_with(&scene, &tree, window, Counting::All, options, &|| ())),
                    (&raster, rasterize_in_tiles(&scene, window, Counting::All, side, &|| ())),
                ];
                for (whole, crop) in crops {
                    for (index, pixel) in window.pixels().enumerate() {
                        assert_eq!(whole.at(pixel), crop.at(pixel), "{name} {pixel:?}");
                        let all = cover(whole, whole.window.index(pixel));
                        assert_eq!(all, cover(&crop, index), "{name} {pixel:?}");
                    }
                }
            }
        }
    }
}
