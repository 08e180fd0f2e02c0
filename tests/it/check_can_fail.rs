//! The cross-check must find deliberately damaged answers, at the right pixels, and blame the right
//! path; and it must not pass where nothing is covered.

use crate::support::scenes::{grid_camera, pixel_grid};
use std::collections::BTreeSet;
use truecast::check::{
    Answered, Blame, BothAnswers, CheckOptions, Kind, Outcome, Report, answer, judge,
};
use truecast::mesh::TriangleId;
use truecast::pixel::Pixel;
use truecast::render::Unwatched;
use truecast::scene::Scene;
use truecast::scene::camera::PinholeCamera;
use truecast::scene::light::{AmbientLight, Light};
use truecast::visibility::Visible;

const CAST: usize = 0;
const RASTER: usize = 1;

/// A grid whose vertices lie on samples, one triangle of it twice, and a tilted sheet through it.
fn scene() -> Scene {
    let mut triangles = pixel_grid(33, 4, 16.0);
    triangles.push(triangles[20]);
    triangles.push([[-14.0, -9.0, 10.0], [12.0, -11.0, 22.0], [3.0, 13.0, 15.0]]);
    let mut scene = Scene::from_triangles(grid_camera(33, 16.0), &triangles);
    scene.lights.push(Light::Ambient(AmbientLight { ambient: [1.0, 0.5, 0.25] }));
    scene
}

fn answers(scene: &Scene) -> BothAnswers {
    answer(scene, &CheckOptions::default(), &Unwatched)
}

fn judged(scene: &Scene, answers: &BothAnswers) -> Report {
    judge(scene, answers, &CheckOptions::default(), &Unwatched)
}

fn pixels(report: &Report) -> BTreeSet<Pixel> {
    report.differences.iter().map(|judged| judged.difference.pixel).collect()
}

/// Where two answers are not the same: triangle, side, counts, or t and weights by more than any
/// rounding (1e-9).
fn changed(a: &Answered, b: &Answered) -> BTreeSet<Pixel> {
    let cover = |answered: &Answered, i: usize| answered.buffer.cover.as_ref().map(|c| c[i]);
    let is_near = |a: f64, b: f64| (a - b).abs() <= 1e-9 * a.abs().max(b.abs());
    let is_same = |a: Option<Visible>, b: Option<Visible>| match (a, b) {
        (None, None) => true,
        (Some(a), Some(b)) => {
            let weights = a.barycentric.0.iter().zip(b.barycentric.0);
            (a.triangle, a.facing) == (b.triangle, b.facing)
                && is_near(a.t(), b.t())
                && weights.into_iter().all(|(&a, b)| is_near(a, b))
        }
        _ => false,
    };
    let window = a.buffer.window;
    window
        .pixels()
        .enumerate()
        .filter(|&(i, _)| {
            !is_same(a.buffer.visible[i], b.buffer.visible[i]) || cover(a, i) != cover(b, i)
        })
        .map(|(_, pixel)| pixel)
        .collect()
}

/// Damages one path's answer, and demands that exactly the damaged pixels are found and that this
/// path is blamed for each of them.
fn assert_found(name: &str, damage: impl Fn(&Scene, &Answered, usize) -> Answered) {
    let scene = scene();
    let right = answers(&scene);
    assert_eq!(judged(&scene, &right).outcome(), Outcome::Agreement, "undamaged");
    for (path, blame) in [(CAST, Blame::Cast), (RASTER, Blame::Raster)] {
        let mut answers = right.clone();
        answers[path] = damage(&scene, &right[path], path);
        let report = judged(&scene, &answers);
        assert_eq!(report.outcome(), Outcome::Differences, "{name}");
        assert_eq!(report.blamed(blame), report.differences.len(), "{name}: blame");
        assert_eq!(pixels(&report), changed(&right[path], &answers[path]), "{name}: pixels");
    }
}

/// The path's answer about another scene, in place of its answer about this one.
fn answer_about(other: &Scene, path: usize) -> Answered {
    answers(other)[path].clone()
}

#[test]
fn a_shift_by_half_a_pixel_is_found() {
    assert_found("half a pixel", |scene, _, path| {
        let camera = &scene.camera;
        let d0 = std::array::from_fn(|k| camera.d0()[k] + 0.5 * camera.dx()[k]);
        let mut shifted = scene.clone();
        shifted.camera =
            PinholeCamera::exact(camera.resolution(), camera.eye(), d0, camera.dx(), camera.dy())
                .unwrap();
        answer_about(&shifted, path)
    });
}

#[test]
fn a_dropped_triangle_is_found() {
    assert_found("dropped triangle", |scene, _, path| {
        let mut dropped = scene.clone();
        let corners = &mut dropped.mesh.corners[45];
        *corners = [corners[0]; 3];
        answer_about(&dropped, path)
    });
}

#[test]
fn a_swapped_vertex_is_found() {
    assert_found("swapped vertex", |scene, _, path| {
        let mut swapped = scene.clone();
        swapped.mesh.corners[45].swap(1, 2);
        answer_about(&swapped, path)
    });
}

#[test]
fn a_flipped_tie_is_found() {
    // The duplicate with the higher id in place of the lower one.
    assert_found("flipped id tie", |scene, answered, _| {
        let duplicate = TriangleId::new(scene.mesh.len() as u32 - 2);
        let mut flipped = answered.clone();
        for visible in flipped.buffer.visible.iter_mut().flatten() {
            if visible.triangle.get() == 20 {
                visible.triangle = duplicate;
            }
        }
        flipped
    });
    // A sample on an edge given to the triangle on its other side.
    assert_found("flipped edge tie", |_, answered, _| {
        let mut flipped = answered.clone();
        let window = answered.buffer.window;
        for pixel in window.pixels().filter(|pixel| pixel.x > 0) {
            let left = Pixel { x: pixel.x - 1, y: pixel.y };
            let here = window.index(pixel);
            if let (Some(visible), Some(other)) =
                (&mut flipped.buffer.visible[here], answered.buffer.at(left))
                && visible.tie
            {
                visible.triangle = other.triangle;
            }
        }
        flipped
    });
}

#[test]
fn depth_off_by_a_millionth_is_found() {
    let scene = scene();
    let right = answers(&scene);
    for (path, blame) in [(CAST, Blame::Cast), (RASTER, Blame::Raster)] {
        let mut answers = right.clone();
        for visible in answers[path].buffer.visible.iter_mut().flatten() {
            visible.t_lo *= 1.0 + 1e-6;
            visible.t_hi *= 1.0 + 1e-6;
        }
        let report = judged(&scene, &answers);
        assert_eq!(report.count(Kind::Depth), right[path].buffer.covered_pixels());
        assert_eq!(report.blamed(blame), report.differences.len());
    }
}

#[test]
fn weights_and_radiance_off_by_little_are_found() {
    let scene = scene();
    let right = answers(&scene);
    let mut answers = right.clone();
    for visible in answers[RASTER].buffer.visible.iter_mut().flatten() {
        visible.barycentric.0[1] *= 1.0 + 1e-12;
    }
    let report = judged(&scene, &answers);
    assert_eq!(report.count(Kind::Weights), report.differences.len());
    assert_eq!(report.blamed(Blame::Raster), report.differences.len());
    assert_eq!(report.outcome(), Outcome::Differences);

    let mut answers = right.clone();
    for radiance in &mut answers[CAST].radiance {
        radiance[1] += 1e-6;
    }
    let report = judged(&scene, &answers);
    assert_eq!(report.count(Kind::Radiance), report.differences.len());
    assert_eq!(report.blamed(Blame::Cast), scene.camera.resolution().window().len());
}

#[test]
fn an_error_common_to_both_paths_is_found_by_the_audit() {
    let scene = scene();
    let mut dropped = scene.clone();
    let corners = &mut dropped.mesh.corners[45];
    *corners = [corners[0]; 3];
    let report = judged(&scene, &answers(&dropped));
    assert_eq!(report.outcome(), Outcome::Differences);
    assert!(report.differences.iter().all(|judged| judged.found_by_audit));
    assert_eq!(report.blamed(Blame::Both), report.differences.len());
}

#[test]
fn nothing_covered_is_not_a_pass() {
    let behind = [[-1.0, -1.0, -8.0], [1.0, -1.0, -8.0], [0.0, 1.0, -8.0]];
    let scene = Scene::from_triangles(grid_camera(17, 8.0), &[behind]);
    assert_eq!(judged(&scene, &answers(&scene)).outcome(), Outcome::NothingToCheck);
    // Both answers emptied: the audit must see it.
    let scene = self::scene();
    let mut answers = answers(&scene);
    for answered in &mut answers {
        answered.buffer.visible.fill(None);
        answered.radiance.fill(scene.background);
    }
    let report = judged(&scene, &answers);
    assert_eq!(report.outcome(), Outcome::Differences);
    assert_eq!(report.blamed(Blame::Both), report.differences.len());
}
