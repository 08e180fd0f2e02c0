//! H82 and H83: quarter turns and mirrors, by exact exchange of coordinates.

use super::scenes_with_ties;
use crate::scale::ids;
use crate::support::configurations::{NARROW, agreed_within};
use crate::support::scenes::{Triangle, standard_camera, standard_scene};
use truecast::pixel::{Pixel, Resolution};
use truecast::scene::Scene;
use truecast::scene::camera::PinholeCamera;
use truecast::visibility::{VisibilityBuffer, Visible};

/// `buffer` is `reference` with its pixels moved, but for samples on which a tie rule that knows
/// right and down decides. Facing is multiplied by `turn`. Returns how many differ.
#[track_caller]
fn assert_moved(
    reference: &VisibilityBuffer,
    buffer: &VisibilityBuffer,
    from: impl Fn(Pixel) -> Pixel,
    turn: i8,
    name: &str,
) -> usize {
    let mut differing = 0;
    for pixel in buffer.window.pixels() {
        let (a, b) = (reference.at(from(pixel)), buffer.at(pixel));
        let key = |v: Option<&Visible>, turn: i8| v.map(|v| (v.triangle, v.facing.sign() * turn));
        if key(a, turn) != key(b, 1) {
            differing += 1;
            assert!(a.is_some_and(|v| v.tie) || b.is_some_and(|v| v.tie), "{name} at {pixel:?}");
        } else if let (Some(a), Some(b)) = (a, b) {
            assert!(a.t_lo <= b.t_hi && b.t_lo <= a.t_hi, "{name} at {pixel:?}");
        }
    }
    differing
}

/// The scene turned by 90° about the view axis, by exact exchange of coordinates.
#[test]
fn h82_quarter_turns() {
    let mut differing = 0;
    for (name, triangles) in scenes_with_ties() {
        let reference = agreed_within(&standard_scene(&triangles), &NARROW, &name);
        let mut turned = triangles;
        for turn in 1..4 {
            turned = turned.iter().map(|t| t.map(|[x, y, z]| [-y, x, z])).collect();
            let buffer = agreed_within(&standard_scene(&turned), &NARROW, &name);
            // (x, y) → (−y, x) each time: where it came from, by as many turns back.
            let back = |mut pixel: Pixel| {
                for _ in 0..turn {
                    pixel = Pixel { x: pixel.y, y: 16 - pixel.x };
                }
                pixel
            };
            differing += assert_moved(&reference, &buffer, back, 1, &name);
        }
    }
    assert!(differing > 50, "ties are in the scenes: {differing}");
    // Away from ties nothing may differ: the same scenes a quarter of a pixel aside.
    for (name, triangles) in scenes_with_ties() {
        let buffer = agreed_within(&aside(&triangles), &NARROW, &name);
        let turned: Vec<Triangle> =
            triangles.iter().map(|t| t.map(|[x, y, z]| [-y, x, z])).collect();
        let frame = Resolution::new(16, 16).unwrap();
        // The frame of `aside` turned with its scene: columns go where rows went.
        let camera = PinholeCamera::exact(
            frame,
            [0.0; 3],
            [8.1875, -8.3125, 8.0],
            [0.0, 1.0, 0.0],
            [-1.0, 0.0, 0.0],
        )
        .unwrap();
        let other = agreed_within(&Scene::from_triangles(camera, &turned), &NARROW, &name);
        // The tie rule turns with the frame, so here not even ties may differ.
        assert_eq!(ids(&buffer), ids(&other), "{name}");
        assert_eq!(buffer.cover, other.cover, "{name}");
    }
}

/// The scene seen on samples 5/16 and 3/16 of a pixel beside the grid of its vertices.
fn aside(triangles: &[Triangle]) -> Scene {
    let frame = Resolution::new(16, 16).unwrap();
    let d0 = [-8.3125, -8.1875, 8.0];
    let camera =
        PinholeCamera::exact(frame, [0.0; 3], d0, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]).unwrap();
    Scene::from_triangles(camera, triangles)
}

/// The scene mirrored in x, in y, and in both.
#[test]
fn h83_mirror() {
    let mut differing = 0;
    for (name, triangles) in scenes_with_ties() {
        let reference = agreed_within(&standard_scene(&triangles), &NARROW, &name);
        for (mx, my) in [(true, false), (false, true), (true, true)] {
            let flip = |c: f32, flips: bool| if flips { -c } else { c };
            let mirrored: Vec<Triangle> = triangles
                .iter()
                .map(|t| t.map(|[x, y, z]| [flip(x, mx), flip(y, my), z]))
                .collect();
            let buffer = agreed_within(&standard_scene(&mirrored), &NARROW, &name);
            let from = |pixel: Pixel| Pixel {
                x: if mx { 16 - pixel.x } else { pixel.x },
                y: if my { 16 - pixel.y } else { pixel.y },
            };
            let turn = if mx == my { 1 } else { -1 };
            differing += assert_moved(&reference, &buffer, from, turn, &name);
        }
        // In depth: seen by a camera that looks the other way.
        let behind: Vec<Triangle> =
            triangles.iter().map(|t| t.map(|[x, y, z]| [x, y, -z])).collect();
        let base = standard_camera(-8.0);
        let buffer = agreed_within(&Scene::from_triangles(base, &behind), &NARROW, &name);
        assert_eq!(assert_moved(&reference, &buffer, |pixel| pixel, -1, &name), 0, "{name}");
    }
    assert!(differing > 50, "ties are in the scenes: {differing}");
}
