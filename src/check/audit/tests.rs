//! The sample's choice of pixels, against boundaries known in closed form.

use super::edge_distance::edge_distance;
use super::{nearest_to_edges, sample};
use crate::accel::BuildPreset;
use crate::check::Answered;
use crate::pixel::{Pixel, Resolution};
use crate::render::{Unwatched, VisibilityPath, see};
use crate::scene::Scene;
use crate::scene::camera::PinholeCamera;
use crate::visibility::{Counting, Layers, VisibilityBuffer};
use std::collections::HashSet;

/// Largest error of a distance, in pixels: some ten roundings of numbers below 2^6.
const DISTANCE_TOLERANCE_PIXELS: f64 = 1e-12;

/// The ray of the sample (x, y) is (x − 16, y − 16, 8).
fn scene(triangles: &[[[f32; 3]; 3]]) -> (Scene, VisibilityBuffer) {
    let frame = Resolution::new(32, 32).unwrap();
    let [dx, dy] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let camera = PinholeCamera::exact(frame, [0.0; 3], [-16.0, -16.0, 8.0], dx, dy).unwrap();
    let scene = Scene::from_triangles(camera, triangles);
    let window = frame.window();
    let path = VisibilityPath::Raster;
    let seen = see(&scene, path, BuildPreset::Medium, window, Counting::Nearest, &Unwatched);
    (scene, seen.buffer)
}

fn assert_distances(
    triangles: &[[[f32; 3]; 3]],
    wanted: impl Fn(f64, f64) -> f64,
) -> (Scene, VisibilityBuffer) {
    let (scene, buffer) = scene(triangles);
    let mut inside = 0;
    for pixel in buffer.window.pixels().filter(|&pixel| buffer.at(pixel).is_some()) {
        let [x, y] = pixel.sample();
        let wanted = wanted(x - 16.0, y - 16.0);
        let distance = edge_distance(&scene, &buffer, pixel);
        assert!((distance - wanted).abs() <= DISTANCE_TOLERANCE_PIXELS, "{pixel:?}: {distance}");
        inside += 1;
    }
    assert!(inside > 40, "{inside} pixels lie inside");
    (scene, buffer)
}

#[test]
fn the_distance_is_that_to_the_nearest_edge() {
    // Right angle at (-10, -10), legs of 20, at z = 8: image coordinates are x and y.
    let triangle = [[-10.0, -10.0, 8.0], [10.0, -10.0, 8.0], [-10.0, 10.0, 8.0]];
    let (scene, buffer) = assert_distances(&[triangle], |x, y| {
        (x + 10.0).min(y + 10.0).min(-(x + y) / 2.0_f64.sqrt())
    });
    // Left of the left edge lies nothing; what is beside it is half a pixel away, and further on
    // there is nothing to be wrong about.
    assert_eq!(edge_distance(&scene, &buffer, Pixel { x: 5, y: 10 }), 0.5);
    assert_eq!(edge_distance(&scene, &buffer, Pixel { x: 3, y: 10 }), f64::INFINITY);
}

#[test]
fn corners_behind_the_eye_have_no_place_and_need_none() {
    // The floor y = 1 between x = ±2z, from its corner in front to two corners behind the eye:
    // its edges are x = ±2z + ..., straight lines in the image that no projected corner bounds.
    // With the front corner at (0, 1, 24), the edge to (±12, 1, −24) is x = ±(24 − z)/4, y = 1:
    // in the image, with z = 8/y', x' = ±(24 y' − 8)/4 = ±(6 y' − 2).
    let triangle = [[0.0, 1.0, 24.0], [12.0, 1.0, -24.0], [-12.0, 1.0, -24.0]];
    let length = 37.0_f64.sqrt();
    assert_distances(&[triangle], |x, y| (6.0 * y - 2.0 - x.abs()) / length);
}

#[test]
fn the_neighbours_edge_counts_too() {
    // The near triangle's hypotenuse crosses the far square; the far square's own edges are away.
    let near = [[-20.0, -20.0, 8.0], [20.25, -20.0, 8.0], [-20.0, 20.25, 8.0]];
    let far = [[-90.0, -90.0, 16.0], [90.0, -90.0, 16.0], [0.0, 190.0, 16.0]];
    let (scene, buffer) = scene(&[near, far]);
    let pixel = Pixel { x: 16, y: 16 };
    assert_eq!(buffer.at(pixel).unwrap().triangle.get(), 1);
    let distance = edge_distance(&scene, &buffer, pixel);
    assert!((distance - 0.75 * 0.5_f64.sqrt()).abs() <= DISTANCE_TOLERANCE_PIXELS, "{distance}");
}

#[test]
fn half_of_the_sample_is_nearest_and_the_whole_is_repeatable() {
    let triangle = [[-10.25, -10.0, 8.0], [10.0, -10.5, 8.0], [-9.0, 10.0, 8.0]];
    let (scene, buffer) = scene(&[triangle]);
    let disputed = [Pixel { x: 7, y: 7 }];
    let answered = Answered {
        layers: Layers::none(buffer.window),
        radiance: vec![[0.0; 3]; buffer.visible.len()],
        alpha: vec![1.0; buffer.visible.len()],
        buffer: buffer.clone(),
    };
    let chosen = sample(&scene, &answered, &disputed, 100);
    assert_eq!(chosen.len(), 100);
    assert_eq!(chosen, sample(&scene, &answered, &disputed, 100));
    let distinct: HashSet<Pixel> = chosen.iter().copied().collect();
    assert_eq!(distinct.len(), 100);
    assert!(!distinct.contains(&disputed[0]));
    let distance = |pixel: Pixel| edge_distance(&scene, &buffer, pixel);
    let nearest = nearest_to_edges(&scene, &buffer, &disputed.into(), 50);
    assert!(nearest.iter().all(|pixel| distinct.contains(pixel)));
    let farthest = nearest.iter().map(|&pixel| distance(pixel)).fold(0.0, f64::max);
    let left_out =
        buffer.window.pixels().filter(|pixel| !nearest.contains(pixel) && *pixel != disputed[0]);
    assert!(left_out.into_iter().all(|pixel| distance(pixel) >= farthest));
}
