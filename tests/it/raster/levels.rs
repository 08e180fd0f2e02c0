//! Every instruction set, tile side and number of threads gives the same bits, and the ids and t
//! alone are those of the whole answer.

use super::golden::goldens;
use super::grid_camera;
use crate::support::closed::sphere;
use crate::support::rays::Random;
use truecast::pixel::{Resolution, Window};
use truecast::raster::{RasterOptions, rasterize_nearest, rasterize_with};
use truecast::scene::Scene;
use truecast::scene::camera::PinholeCamera;
use truecast::simd::SimdLevel;
use truecast::visibility::{Counting, NearestBuffer, VisibilityBuffer};

/// Tile sides in the order in which levels take them: odd ones, the usual one, the largest.
const SIDES: [u32; 5] = [7, 32, 16, 64, 33];

fn options() -> impl Iterator<Item = RasterOptions> {
    let levels = SimdLevel::available().into_iter();
    let sides = SIDES.iter().cycle();
    let pairs = levels.flat_map(|simd| [simd; 2]).zip(sides);
    pairs.map(|(simd, &tile_side)| RasterOptions { tile_side, simd })
}

/// A torn sphere and strewn triangles of all sizes, some through the eye's plane, none on a grid.
fn strewn(seed: u64) -> Scene {
    let mut random = Random(seed);
    let mut triangles = sphere(40, 80, 3.0, [0.3, 0.2, 9.0]);
    for number in 0..3000 {
        let size = 2.0_f64.powi(-(number % 11)) * 3.0;
        let mut coordinate = |reach: f64| (random.unit() - 0.5) * reach;
        let center = [coordinate(9.0), coordinate(9.0), coordinate(16.0) + 5.0];
        triangles.push([0; 3].map(|_| center.map(|c| (c + coordinate(size)) as f32)));
    }
    let frame = Resolution::new(203, 131).unwrap();
    let camera =
        PinholeCamera::look_at(frame, [0.1, 0.2, -1.0], [0.0, 0.1, 9.0], [0.0, 1.0, 0.0], 58.0);
    Scene::from_triangles(camera.unwrap(), &triangles)
}

fn scenes() -> Vec<(String, Scene)> {
    let golden = goldens().into_iter().map(|golden| (golden.name, golden.scene));
    let mut scenes: Vec<_> = golden.collect();
    scenes.extend((0..3).map(|seed| (format!("strewn {seed}"), strewn(seed * 77 + 1))));
    // Numbers at the ends of the range of f32.
    let strewn = strewn(5);
    for power in [-120, -70, 60, 100] {
        let scale = 2.0_f32.powi(power);
        let triangles: Vec<_> = strewn
            .mesh
            .ids()
            .map(|id| strewn.mesh.triangle(id).map(|v| v.map(|c| c * scale)))
            .take(400)
            .collect();
        let camera = grid_camera([0.0; 3], 8.0);
        scenes.push((format!("strewn at 2^{power}"), Scene::from_triangles(camera, &triangles)));
    }
    scenes
}

fn same_bits(a: &VisibilityBuffer, b: &VisibilityBuffer) -> bool {
    a.visible == b.visible && a.cover == b.cover
}

#[test]
fn every_level_and_tile_side_gives_the_same_bits() {
    let mut covered = 0;
    for (name, scene) in scenes() {
        let window = scene.camera.resolution().window();
        let mut first: Option<VisibilityBuffer> = None;
        for options in options() {
            let rasterize = |counting| rasterize_with(&scene, window, counting, options, &|| ());
            let all = rasterize(Counting::All);
            let nearest = rasterize(Counting::Nearest);
            assert_eq!(nearest.visible, all.visible, "{name} {options:?}");
            if let Some(first) = &first {
                assert!(same_bits(first, &all), "{name} {options:?}");
            }
            covered += all.covered_pixels();
            first.get_or_insert(all);
        }
    }
    assert!(covered > 100_000, "{covered}");
}

#[test]
fn ids_and_t_alone_are_those_of_the_whole_answer() {
    for (name, scene) in scenes() {
        let frame = scene.camera.resolution();
        let (right, below) = (frame.width() - 2, frame.height() - 3);
        for window in [frame.window(), Window::new(frame, 5, 3, right, below).unwrap()] {
            let mut first: Option<NearestBuffer> = None;
            for options in options() {
                let whole = rasterize_with(&scene, window, Counting::Nearest, options, &|| ());
                let nearest = rasterize_nearest(&scene, window, options, &|| ());
                for (index, visible) in whole.visible.iter().enumerate() {
                    let place = format!("{name} {options:?} {:?}", window.pixel(index));
                    let id = visible.map_or(u32::MAX, |visible| visible.triangle.get());
                    assert_eq!(nearest.ids[index], id, "{place}");
                    let t = visible.map_or(f32::INFINITY, |visible| visible.t() as f32);
                    let found = nearest.t[index];
                    // f64 knows t to 2^-29 of itself, so that rounding may go to a neighbour.
                    let neighbours = [t.next_down(), t, t.next_up()];
                    assert!(neighbours.contains(&found), "{place}: {found:e} for {t:e}");
                }
                if let Some(first) = &first {
                    assert_eq!((&first.ids, &first.t), (&nearest.ids, &nearest.t), "{name}");
                }
                first.get_or_insert(nearest);
            }
        }
    }
}
