//! H01 to H09: samples exactly on vertices and edges, ways of writing the same triangles, and the
//! two zeros.

use super::{agree_with_golden, assert_covered_once, assert_same_picture, cover, ids, samples};
use crate::support::configurations::agree_everywhere;
use crate::support::golden;
use crate::support::scenes::{
    Triangle, fan, grid_camera, pixel_grid, rectangle, standard_camera, standard_scene,
    triangles_of,
};
use std::time::{Duration, Instant};
use truecast::accel::{Accelerator, BuildPreset};
use truecast::scene::Scene;
use truecast::scene::camera::PinholeCamera;
use truecast::visibility::Facing;

/// The sample of pixel (8, 8).
const CENTRE: usize = 8 * 17 + 8;

/// Golden scenes that between them hold every kind of tie.
const TIED: [&str; 7] = [
    "topleft_both",
    "fan64",
    "grid_exact",
    "coplanar_tilted",
    "interpenetrating_2^-20",
    "box_inside",
    "needle_1e8x1e-3",
];

#[test]
fn h01_needle_fan() {
    agree_with_golden("fan8");
    agree_with_golden("fan64");
    for (count, pixels) in [(8, 177), (64, 193), (1000, 193)] {
        let name = format!("fan of {count}");
        let buffer = agree_everywhere(&name, &standard_scene(&fan(count)));
        assert_covered_once(&name, &buffer);
        assert_eq!(buffer.covered_pixels(), pixels, "{name}");
        let hub = buffer.visible[CENTRE].expect("one triangle owns the hub");
        assert!(hub.tie && hub.barycentric.0 == [1.0, 0.0, 0.0], "{name}: {hub:?}");
    }
}

/// Generous for a build of n log n steps. One that is quadratic, as obvhs is on coincident centroids
/// (1.5 s for 8000), would take 1.5 s · (100/8)² = 230 s.
const FAN_BUILD: Duration = Duration::from_secs(20);

#[test]
fn h02_fan_of_100_000() {
    let scene = standard_scene(&fan(100_000));
    let start = Instant::now();
    let accelerator = Accelerator::build(&scene.mesh, BuildPreset::Medium);
    assert!(start.elapsed() < FAN_BUILD, "{:?}", start.elapsed());
    assert!(accelerator.depth() <= 96, "no chain: {}", accelerator.depth());
    let buffer = agree_everywhere("fan of 100 000", &scene);
    assert_covered_once("fan of 100 000", &buffer);
    assert_eq!(buffer.covered_pixels(), 195);
}

#[test]
fn h03_grid_on_pixel_centres() {
    let buffer = agree_with_golden("grid_exact");
    assert_covered_once("grid_exact", &buffer);
    assert_eq!(buffer.covered_pixels(), 289);
    // 16 × 16 cells of 4 pixels: the last row and column lie on right and bottom edges only.
    let scene = Scene::from_triangles(grid_camera(65, 10.0), &pixel_grid(65, 4, 10.0));
    let buffer = agree_everywhere("grid of 16 × 16", &scene);
    assert_covered_once("grid of 16 × 16", &buffer);
    assert_eq!(buffer.covered_pixels(), 64 * 64);
}

#[test]
fn h04_mixed_winding() {
    let golden = golden::scene("grid_exact");
    let plain = agree_everywhere("grid", &golden.scene);
    let mut triangles = triangles_of(&golden.scene);
    triangles.iter_mut().step_by(3).for_each(|triangle| triangle.swap(1, 2));
    let mixed = agree_everywhere("mixed winding", &standard_scene(&triangles));
    assert_eq!(ids(&plain), ids(&mixed));
    for (index, (before, after)) in plain.visible.iter().zip(&mixed.visible).enumerate() {
        let (before, after) = (before.unwrap(), after.unwrap());
        let reversed = after.triangle.get() % 3 == 0;
        assert_eq!(before.facing == after.facing, !reversed, "{after:?}");
        let expected = if after.facing == Facing::Front { -1 } else { 1 };
        assert_eq!((cover(&mixed)[index].crossed, cover(&mixed)[index].signed), (1, expected));
    }
}

#[test]
fn h05_vertex_rotation() {
    for name in TIED {
        let golden = golden::scene(name);
        let reference = agree_everywhere(name, &golden.scene);
        for turn in 1..3 {
            let mut triangles = triangles_of(&golden.scene);
            triangles.iter_mut().for_each(|triangle| triangle.rotate_left(turn));
            let scene = Scene::from_triangles(golden.scene.camera.clone(), &triangles);
            assert_same_picture(&format!("{name} turned by {turn}"), &reference, &scene);
        }
    }
}

#[test]
fn h06_top_left_literal() {
    let upper = agree_with_golden("topleft_upper");
    let lower = agree_with_golden("topleft_lower");
    let both = agree_with_golden("topleft_both");
    for (index, [x, y]) in samples().enumerate() {
        let square = (-4..4).contains(&x) && (-4..4).contains(&y);
        // The hypotenuse is a right edge of the upper triangle, a left one of the lower.
        let expected = [square && x + y < 0, square && x + y >= 0, square];
        let found = [&upper, &lower, &both].map(|buffer| buffer.visible[index].is_some());
        assert_eq!(found, expected, "sample ({x}, {y})");
    }
    assert_eq!([&upper, &lower, &both].map(|b| b.covered_pixels()), [36, 28, 64]);
    assert_covered_once("both halves", &both);
}

#[test]
fn h07_right_and_bottom_only() {
    let square = rectangle([-4.0, -4.0], [4.0, 4.0], 8.0);
    let buffer = agree_everywhere("square", &standard_scene(&square));
    for (visible, [x, y]) in buffer.visible.iter().zip(samples()) {
        let inside = (-4..4).contains(&x) && (-4..4).contains(&y);
        assert_eq!(visible.is_some(), inside, "sample ({x}, {y})");
    }
}

/// Every zero with the other sign, or every second one.
fn other_zeros(triangles: &mut [Triangle], step: usize) {
    let zeros = triangles.iter_mut().flatten().flatten().filter(|c| **c == 0.0);
    zeros.step_by(step).for_each(|zero| *zero = -*zero);
}

/// A standard camera whose zeros are all −0.
fn negative_zero_camera() -> PinholeCamera {
    let zero = -0.0;
    let resolution = standard_camera(8.0).resolution();
    let (dx, dy) = ([1.0, zero, zero], [zero, 1.0, zero]);
    PinholeCamera::exact(resolution, [zero; 3], [-8.5, -8.5, 8.0], dx, dy).unwrap()
}

#[test]
fn h08_signed_zeros() {
    for name in TIED {
        let golden = golden::scene(name);
        assert_eq!(golden.scene.camera, standard_camera(8.0), "{name} is seen by G(8)");
        let reference = agree_everywhere(name, &golden.scene);
        for step in [1, 2] {
            let mut triangles = triangles_of(&golden.scene);
            other_zeros(&mut triangles, step);
            let scene = Scene::from_triangles(negative_zero_camera(), &triangles);
            assert_same_picture(&format!("{name} with -0"), &reference, &scene);
        }
    }
}

/// The column d.x = 0, reached from the left (−8 + 8) and, by the mirrored camera, from the right
/// (8 − 8), beside boxes that end at x = 0 and flat ones inside x = 0. The mirrored world in the
/// mirrored camera is the same picture, ties included, seen from its other side.
#[test]
fn h09_negative_zero_direction() {
    let mut triangles = rectangle([-6.0, -20.0], [0.0, 20.0], 16.0).to_vec();
    triangles.extend(rectangle([0.0, -20.0], [6.0, 20.0], 12.0));
    for k in 0..6_u8 {
        // Edge-on, in the plane x = 0: flat boxes that every ray of the column runs in.
        let z = 4.0 + f32::from(k);
        triangles.push([[0.0, -9.0, z], [0.0, 9.0, z], [0.0, 0.0, z + 0.5]]);
    }
    let reference = agree_everywhere("faces at x = 0", &standard_scene(&triangles));
    assert!((0..17).all(|row| reference.visible[row * 17 + 8].is_some()), "the column is covered");
    other_zeros(&mut triangles, 1);
    let scene = Scene::from_triangles(negative_zero_camera(), &triangles);
    assert_same_picture("faces at x = -0", &reference, &scene);

    let mirrored: Vec<Triangle> =
        triangles.iter().map(|triangle| triangle.map(|[x, y, z]| [-x, y, z])).collect();
    let resolution = standard_camera(8.0).resolution();
    let (dx, dy) = ([-1.0, -0.0, 0.0], [-0.0, 1.0, 0.0]);
    let camera = PinholeCamera::exact(resolution, [0.0; 3], [8.5, -8.5, 8.0], dx, dy).unwrap();
    let scene = Scene::from_triangles(camera, &mirrored);
    assert_same_picture("mirrored", &reference, &scene);
}
