//! Surface points: which normal is used, and where the point is.

use super::stage::{
    directional, floor, look_at, pixel_at, radiance_at, seen, smooth_octahedron, unit, white,
};
use super::{NORTH, ULP, matte};
use truecast::scene::{Scene, Sides};
use truecast::shade;

#[test]
fn corner_normals_that_cancel_give_way_to_the_face() {
    // C10: half of (1, 0, 0) and half of (−1, 0, 0).
    let mut scene = floor();
    scene.materials[0] = matte([1.0; 3]);
    scene.lights = vec![directional([0.0, 0.0, -1.0], white())];
    for tilt in [0.0, 1e-7] {
        scene.mesh.normals = vec![unit([1.0, 0.0, tilt]), unit([-1.0, 0.0, tilt]), NORTH];
        scene.mesh.corner_normals = vec![[0, 1, 2]; 2];
        let visible = seen(0, [0.5, 0.5, 0.0]);
        let (point, notes) = shade::surface_point(&scene, pixel_at(0, 0), &visible);
        assert_eq!(point.shading_normal, NORTH, "{tilt:e}");
        assert_eq!(notes.cancelled_normals, 1);
        let (_, none) = shade::surface_point(&scene, pixel_at(0, 0), &seen(0, [0.25; 3]));
        assert_eq!(none.cancelled_normals, 0);
    }
}

#[test]
fn double_sides_turn_the_normal_single_sides_do_not() {
    let mut scene = smooth_octahedron();
    for corners in &mut scene.mesh.corners {
        corners.swap(1, 2);
    }
    scene.mesh.corner_normals = scene.mesh.corners.clone();
    scene.mesh.normals.iter_mut().for_each(|n| *n = n.map(|c| -c));
    scene.lights = vec![directional([0.0, 0.0, -1.0], white())];
    scene.materials[0] = matte([1.0; 3]);
    let inside_out = radiance_at(&scene, 1, 1);
    scene.objects[0].sides = Sides::Double;
    let turned = radiance_at(&scene, 1, 1);
    let mut right = smooth_octahedron();
    right.lights = scene.lights.clone();
    right.materials = scene.materials.clone();
    assert_eq!(inside_out, [0.0; 3]);
    let expected = radiance_at(&right, 1, 1)[0];
    assert!(expected > 0.5 && (turned[0] - expected).abs() <= 4.0 * ULP);
    let visible = look_at(&scene, pixel_at(1, 1)).unwrap();
    let (point, _) = shade::surface_point(&scene, pixel_at(1, 1), &visible);
    assert!(point.face_normal[2] < 0.0 && point.shading_normal[2] > 0.0, "N itself never turns");
}

#[test]
fn a_point_on_a_huge_floor_is_as_exact_as_its_ray() {
    // Like the floor of H74, larger still: seen from its corners, f64 places a point to 2^-23 only,
    // and these points lie on multiples of 2^-25.
    let s = 1e9_f32;
    let mut scene = Scene::from_triangles(
        super::stage::camera(),
        &[[[-s, -s, -2.7], [s, -s, -2.7], [0.0, s, -2.7]]],
    );
    scene.lights = vec![directional([0.0, 0.0, -1.0], white())];
    for (x, y) in [(0, 0), (3, -7), (-8, 8)] {
        let visible = look_at(&scene, pixel_at(x, y)).unwrap();
        let (point, _) = shade::surface_point(&scene, pixel_at(x, y), &visible);
        // The ray (x, y, −8)·t reaches the floor at t = (8 − z)/8.
        let z = f64::from(-2.7_f32);
        let right = [f64::from(x) * (8.0 - z) / 8.0, f64::from(y) * (8.0 - z) / 8.0, z];
        for (value, right) in point.position.iter().zip(right) {
            // An ulp of the eye's distance and of t.
            assert!((value - right).abs() <= 16.0 * ULP, "{value} {right}");
        }
    }
}

#[test]
fn a_coarse_ray_parameter_does_not_move_the_point() {
    let scene = floor();
    let mut visible = look_at(&scene, pixel_at(5, -3)).unwrap();
    visible.t_lo -= 1e-6;
    visible.t_hi += 3e-6;
    let (point, _) = shade::surface_point(&scene, pixel_at(5, -3), &visible);
    // 2^-48 of the floor's 128 units.
    let bound = 128.0 * 16.0 * ULP;
    for (value, right) in point.position.iter().zip([5.0, -3.0, 0.0]) {
        assert!((value - right).abs() <= bound, "{value} {right}");
    }
}
