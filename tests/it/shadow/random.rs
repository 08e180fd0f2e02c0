//! Structured random scenes: whole numbers, where everything ties, and lights that stand where the
//! segment grazes an edge or a corner up to rounding.

use super::agreed;
use crate::support::rays::Random;
use crate::support::scenes::{Sequence, Triangle, rectangle, standard_scene};
use proptest::prelude::*;
use truecast::accel::{Accelerator, BuildPreset};
use truecast::cast::cast;
use truecast::cast::shadow::ShadowCaster;
use truecast::exact::Shadows;
use truecast::scene::light_point::LightPoint;
use truecast::visibility::Counting;

fn corner() -> impl Strategy<Value = [f32; 3]> {
    (-5_i32..=5, -5_i32..=5, 2_i32..=10).prop_map(|(x, y, z)| [x, y, z].map(|c| c as f32))
}

fn light() -> impl Strategy<Value = LightPoint> {
    let whole = [-6_i32..=6, -6..=6, -6..=12];
    (whole, any::<bool>()).prop_map(|(l, is_position)| {
        let l = l.map(f64::from);
        if is_position || l == [0.0; 3] {
            LightPoint::Position(l)
        } else {
            LightPoint::Direction(l)
        }
    })
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(60) })]

    /// Twelve triangles with corners on whole numbers before a wall, one light.
    #[test]
    fn whole_numbers_agree(
        soup in prop::collection::vec([corner(), corner(), corner()], 12),
        light in light(),
    ) {
        let mut triangles: Vec<Triangle> = soup;
        triangles.extend(rectangle([-10.0, -10.0], [10.0, 10.0], 10.0));
        agreed("soup", &standard_scene(&triangles), &[light]);
    }
}

/// For each pixel a light of its own, so that the segment to it passes a point of an occluder's edge, or
/// its corner, or the corner of a box, within the rounding of f64 numbers: every decision is close.
#[test]
fn lights_that_graze_edges_and_corners_agree() {
    let mut random = Sequence(23);
    let (mut shadowed, mut lit, mut exact, mut rays) = (0, 0, 0, 0);
    for round in 0..8 {
        let mut corner = |depth: f64| -> [f32; 3] {
            let [x, y, z] = [random.next(), random.next(), random.next()];
            [8.0 * x - 4.0, 8.0 * y - 4.0, depth + z].map(|c| c as f32)
        };
        let mut triangles: Vec<Triangle> =
            (0..24).map(|_| [corner(4.0), corner(4.0), corner(5.0)]).collect();
        // A wall that is not flat on an axis.
        triangles.push([[-40.0, -40.0, 11.0], [40.0, -40.0, 9.3], [0.0, 60.0, 10.1]]);
        let scene = standard_scene(&triangles);
        let window = scene.camera.resolution().window();
        let tree = Accelerator::build(&scene.mesh, BuildPreset::Medium);
        let buffer = cast(&scene, &tree, window, Counting::Nearest, &|| ());
        let mut caster = ShadowCaster::new(&scene, &tree);
        for (number, pixel) in window.pixels().enumerate() {
            let Some(visible) = buffer.at(pixel) else { continue };
            let d = [f64::from(pixel.x) - 8.0, f64::from(pixel.y) - 8.0, 8.0];
            let x = d.map(|c| c * visible.t());
            let target = triangles[(number * 7 + round) % 24].map(|v| v.map(f64::from));
            let along = if number % 3 == 0 { 0.0 } else { random.next() };
            let edge = number % 3;
            let (p, q) = (target[edge], target[(edge + 1) % 3]);
            let past = 1.0 + 2.0 * random.next();
            let toward: [f64; 3] = std::array::from_fn(|k| p[k] + (q[k] - p[k]) * along - x[k]);
            let light = if number % 2 == 0 {
                LightPoint::Position(std::array::from_fn(|k| x[k] + toward[k] * past))
            } else {
                LightPoint::Direction(toward)
            };
            let found = caster.occluder(pixel, visible, light, |_| true);
            let right = Shadows::new(&scene, light).occluders(pixel, visible.triangle, |_| true);
            super::assert_found("grazing", light, pixel, found, &right);
            lit += usize::from(right.is_empty());
            shadowed += usize::from(!right.is_empty());
        }
        exact += caster.counts().exact;
        rays += caster.counts().rays;
    }
    assert!(lit > 100 && shadowed > 100, "{lit} lit, {shadowed} shadowed");
    assert!(exact * 8 > rays, "close decisions are few: {exact} of {rays}");
}

/// Thousands of triangles, lights among them: the walk loses nothing.
#[test]
fn large_soups_agree_with_the_linear_scan() {
    let mut random = Random(77);
    let mut triangles: Vec<Triangle> = Vec::new();
    for _ in 0..3000 {
        let middle = [0; 3].map(|_| random.integer(12));
        triangles.push([0; 3].map(|_| {
            let [x, y, z] = middle.map(|c| c + random.integer(1));
            [x, y, z + 14.0]
        }));
    }
    let scene = standard_scene(&triangles);
    let window = scene.camera.resolution().window();
    let trees = super::accelerators(&scene);
    let buffer = cast(&scene, &trees[0], window, Counting::Nearest, &|| ());
    let mut casters: Vec<_> = trees.iter().map(|tree| ShadowCaster::new(&scene, tree)).collect();
    let mut shadowed = 0;
    for light in super::generic_and_whole() {
        for pixel in window.pixels() {
            let Some(visible) = buffer.at(pixel) else { continue };
            let mut ask = |caster: &mut ShadowCaster<'_>| {
                caster.occluder(pixel, visible, light, |_| true).is_some()
            };
            let answers: Vec<bool> = casters.iter_mut().map(&mut ask).collect();
            assert!(answers.iter().all(|&answer| answer == answers[0]), "{light:?} at {pixel:?}");
            shadowed += usize::from(answers[0]);
        }
    }
    assert!(shadowed > 500, "{shadowed}");
}
