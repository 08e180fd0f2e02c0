//! Hard scenes, each with generic, aimed and extreme lights.

use super::lights::{aimed, extreme, generic};
use super::{Met, agreed};
use crate::support::closed::sphere;
use crate::support::golden;
use crate::support::rays::closed_box;
use crate::support::scenes::{
    Triangle, fan, pixel_grid, rectangle, scaled, standard_scene, triangles_of,
};
use truecast::scene::Scene;
use truecast::scene::light_point::LightPoint;

/// Generic lights, and lights aimed at the triangles of these numbers.
fn hard(name: &str, scene: &Scene, reach: f64, aims: &[usize]) -> Met {
    let triangles = triangles_of(scene);
    let mut lights = generic(reach);
    lights.extend(aims.iter().flat_map(|&number| aimed(scene, triangles[number])));
    agreed(name, scene, &lights)
}

/// Both answers occur, and so does the exact stage.
fn assert_told(name: &str, met: Met) {
    assert!(met.lit > 200 && met.shadowed > 200 && met.counts.exact > 50, "{name}: {met:?}");
}

#[test]
fn h01_a_needle_fan_before_a_wall() {
    let mut triangles = fan(120);
    triangles.extend(rectangle([-9.0, -9.0], [9.0, 9.0], 8.0));
    triangles.extend(rectangle([-9.0, -9.0], [9.0, 9.0], -6.0));
    assert_told("fan", hard("fan", &standard_scene(&triangles), 5.0, &[77]));
}

/// A chequered layer whose corners are on pixel centres at depth 8, before a wall at depth 16 that is
/// made of such squares too: with lights on whole numbers every ray passes through edges.
#[test]
fn h03_grids_on_pixel_centres() {
    let layer = pixel_grid(17, 4, 8.0);
    let mut triangles: Vec<Triangle> = layer.chunks(2).step_by(3).flatten().copied().collect();
    triangles.extend(scaled(&layer, 2.0));
    let scene = standard_scene(&triangles);
    let mut met = hard("grid", &scene, 6.0, &[3]);
    // From each of these places the layer's edges fall on the wall's pixel centres.
    let whole = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [-4.0, 8.0, 0.0], [2.0, 2.0, 4.0]];
    met.add(agreed("grid", &scene, &whole.map(LightPoint::Position)));
    assert_told("grid", met);
}

#[test]
fn h40_triangles_that_cross_the_plane_of_the_eye() {
    let mut triangles = vec![
        [[-3.0, 4.0, -9.0], [5.0, 4.0, 12.0], [-6.0, 4.0, 14.0]],
        [[0.0, -2.0, 8.0], [3.0, -1.0, -8.0], [-3.0, 3.0, 8.0]],
        [[-2.0, -5.0, -1.0], [-1.0, 2.0, 6.0], [-4.0, 1.0, 7.0]],
    ];
    triangles.extend(rectangle([-30.0, -30.0], [30.0, 30.0], 20.0));
    assert_told("eye plane", hard("eye plane", &standard_scene(&triangles), 8.0, &[0, 1, 2]));
}

#[test]
fn h74_a_huge_floor_with_a_small_box() {
    let mut triangles = triangles_of(&golden::scene("huge_floor_1e8").scene);
    triangles.extend(closed_box([-2.0, 0.25, 6.0], [1.0, 0.75, 9.0]));
    let scene = standard_scene(&triangles);
    let met = hard("floor", &scene, 6.0, &[0, 2, 5]);
    assert!(met.lit > 200 && met.shadowed > 200, "{met:?}");
}

#[test]
fn a_closed_box_from_inside_with_a_smaller_one() {
    let mut triangles = closed_box([-9.0, -9.0, -4.0], [9.0, 9.0, 16.0]);
    triangles.extend(closed_box([-3.0, -3.0, 8.0], [2.0, 4.0, 12.0]));
    assert_told("box", hard("box", &standard_scene(&triangles), 6.0, &[5, 14]));
}

#[test]
fn a_sphere_on_a_plane() {
    let mut triangles = sphere(8, 16, 3.0, [0.0, 0.0, 9.0]);
    let corner = |x: f32, z: f32| [x, 3.0, z];
    triangles.push([corner(-20.0, 0.0), corner(20.0, 0.0), corner(20.0, 40.0)]);
    triangles.push([corner(-20.0, 0.0), corner(20.0, 40.0), corner(-20.0, 40.0)]);
    assert_told("sphere", hard("sphere", &standard_scene(&triangles), 7.0, &[100, 225]));
}

#[test]
fn golden_scenes_of_every_scale() {
    for (number, golden) in golden::scenes().into_iter().enumerate() {
        let triangles = triangles_of(&golden.scene);
        let mut lights = generic(9.0);
        // The aimed ones in turn: each scene gets every fifth.
        let aimed = aimed(&golden.scene, triangles[triangles.len() / 2]);
        lights.extend(aimed.into_iter().skip(number % 5).step_by(5));
        agreed(&golden.name, &golden.scene, &lights);
    }
}

/// The same scene at 2^±100, lights and all: the same shadows.
#[test]
fn a_scene_of_any_scale_has_the_same_shadows() {
    let mut triangles = closed_box([-1.0, -1.0, 5.0], [2.0, 1.0, 6.0]);
    triangles.extend(rectangle([-9.0, -9.0], [9.0, 9.0], 8.0));
    let place = [3.0, -2.0, 2.0];
    let mut shadowed = Vec::new();
    for power in [-100, 0, 100] {
        let scene = standard_scene(&scaled(&triangles, 2.0_f32.powi(power)));
        let at = LightPoint::Position(place.map(|c| c * 2.0_f64.powi(power)));
        shadowed.push(agreed("scaled", &scene, &[at]).shadowed);
    }
    assert_eq!(shadowed, [shadowed[0]; 3]);
    assert!(shadowed[0] > 20, "{shadowed:?}");
}

/// Lights at the ends of the range of numbers, where nothing in f64 is certain.
#[test]
fn lights_of_extreme_numbers_agree() {
    let mut triangles = closed_box([-1.0, -1.0, 5.0], [2.0, 1.0, 6.0]);
    triangles.extend(rectangle([-9.0, -9.0], [9.0, 9.0], 8.0));
    let met = agreed("extremes", &standard_scene(&triangles), &extreme());
    assert!(met.lit > 100 && met.shadowed > 20, "{met:?}");
    assert!(met.counts.exact * 4 > met.counts.rays, "{met:?}");
}

/// What the eye sees, a light at the eye reaches.
#[test]
fn a_light_at_the_eye_sees_no_shadow() {
    for golden in golden::scenes() {
        let at_eye = LightPoint::Position(golden.scene.camera.eye());
        assert_eq!(agreed(&golden.name, &golden.scene, &[at_eye]).shadowed, 0, "{}", golden.name);
    }
}

/// Copies that the tree folds may differ in what they let through: the opaque one counts.
#[test]
fn an_opaque_copy_of_a_clear_triangle_casts_a_shadow() {
    let blade = [[-2.0, -2.0, 4.0], [2.0, -2.0, 4.0], [0.0, 3.0, 4.0]];
    let [a, b, c] = blade;
    let mut triangles = vec![blade, [b, c, a], [c, a, b]];
    triangles.extend(rectangle([-9.0, -9.0], [9.0, 9.0], 8.0));
    let scene = standard_scene(&triangles);
    let light = LightPoint::Position([5.0, 0.5, 1.0]);
    assert!(agreed("copies", &scene, &[light]).shadowed > 20);
}
