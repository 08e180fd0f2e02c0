//! Closed meshes: the terminator is watertight, and crossings are as many as winding numbers say.

use super::{accelerators, agreed, generic_and_whole};
use crate::support::closed::{integer_chaos, sphere};
use crate::support::rays::{closed_box, torus};
use crate::support::scenes::{Triangle, standard_scene, triangles_of};
use truecast::cast::cast;
use truecast::cast::shadow::ShadowCaster;
use truecast::exact::Shadows;
use truecast::scene::light_point::LightPoint;
use truecast::visibility::Counting;

/// n·(l − v_0), or n·l. Exact for the whole numbers of these meshes and lights; elsewhere its
/// callers ask for more than rounding.
fn facing(triangle: &Triangle, light: LightPoint) -> f64 {
    let v = triangle.map(|v| v.map(f64::from));
    let minus = |a: [f64; 3], b: [f64; 3]| [0, 1, 2].map(|k| a[k] - b[k]);
    let (p, q) = (minus(v[1], v[0]), minus(v[2], v[0]));
    let l = match light {
        LightPoint::Position(l) => minus(l, v[0]),
        LightPoint::Direction(l) => l,
    };
    (0..3)
        .map(|k| {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            (p[i] * q[j] - p[j] * q[i]) * l[k]
        })
        .sum()
}

/// A double pyramid around (0, 0, 8) whose corners are on whole numbers, some on pixel centres, turned
/// outwards: right-handed around the axis from `tip` to `tail`.
fn double_pyramid() -> Vec<Triangle> {
    let ring =
        [[4.0, 0.0, 8.0], [3.0, 3.0, 9.0], [-1.0, 4.0, 8.0], [-4.0, 0.0, 8.0], [0.0, -4.0, 7.0]];
    let (tip, tail) = ([0.0, 0.0, 5.0], [0.0, 0.0, 13.0]);
    let sides = (0..5).flat_map(|k| {
        let (a, b) = (ring[k], ring[(k + 1) % 5]);
        [[tip, b, a], [tail, a, b]]
    });
    sides.collect()
}

/// Convex, from every corner's point of view: no corner is in front of a face.
fn assert_convex(triangles: &[Triangle]) {
    for triangle in triangles {
        for corner in triangles.iter().flatten() {
            let side = facing(triangle, LightPoint::Position(corner.map(f64::from)));
            assert!(side <= 0.0, "{triangle:?} and {corner:?}");
        }
    }
}

#[test]
fn the_terminator_of_a_convex_mesh_is_watertight() {
    let meshes = [closed_box([-4.0, -3.0, 8.0], [2.0, 4.0, 12.0]), double_pyramid()];
    let (mut lit, mut dark) = (0, 0);
    for triangles in meshes {
        assert_convex(&triangles);
        let scene = standard_scene(&triangles);
        let window = scene.camera.resolution().window();
        let trees = accelerators(&scene);
        let buffer = cast(&scene, &trees[0], window, Counting::Nearest, &|| ());
        for light in generic_and_whole() {
            let outside = triangles.iter().any(|triangle| facing(triangle, light) > 0.0);
            for tree in &trees {
                let mut caster = ShadowCaster::new(&scene, tree);
                for pixel in window.pixels() {
                    let Some(visible) = buffer.at(pixel) else { continue };
                    let side = facing(&scene.mesh.triangle(visible.triangle), light);
                    let occluder = caster.occluder(pixel, visible, light, |_| true);
                    if side > 0.0 || !outside {
                        assert_eq!(occluder, None, "{light:?} at {pixel:?}");
                        lit += 1;
                    } else if side < 0.0 {
                        assert!(occluder.is_some(), "{light:?} at {pixel:?}");
                        dark += 1;
                    }
                }
            }
        }
    }
    assert!(lit > 2000 && dark > 1000, "{lit} lit, {dark} dark");
}

/// From the eye to the visible point nothing is crossed, so just off S on the eye's side the winding
/// number is the eye's. A light on that side sees an even number of occluders if both are outside
/// or inside, and one more or less through S.
#[test]
fn crossings_have_the_parity_of_winding_numbers() {
    let moved = |t: Triangle| t.map(|v| [v[0], v[1], v[2] + 9.0]);
    let meshes = [
        sphere(8, 16, 3.0, [0.0, 0.0, 9.0]),
        torus(12, 8, 3.0, 1.0).into_iter().map(moved).collect(),
        closed_box([-4.0, -3.0, 8.0], [2.0, 4.0, 12.0]),
    ];
    let (mut even, mut odd) = (0, 0);
    for triangles in meshes {
        let scene = standard_scene(&triangles);
        let window = scene.camera.resolution().window();
        let buffer = cast(&scene, &accelerators(&scene)[0], window, Counting::Nearest, &|| ());
        for light in generic_and_whole() {
            // Winding numbers of places in the mesh are not counted here: only lights outside.
            let (LightPoint::Position(l) | LightPoint::Direction(l)) = light;
            if matches!(light, LightPoint::Position(_)) && l[2] > 4.5 {
                continue;
            }
            let shadows = Shadows::new(&scene, light);
            for pixel in window.pixels() {
                let Some(visible) = buffer.at(pixel) else { continue };
                let side = facing(&scene.mesh.triangle(visible.triangle), light);
                let eye = LightPoint::Position(scene.camera.eye());
                let eye_side = facing(&scene.mesh.triangle(visible.triangle), eye);
                // Below this a side in f64 may be rounding.
                if side.abs() < 1e-9 {
                    continue;
                }
                let through = usize::from(side.signum() != eye_side.signum());
                let crossed = shadows.occluders(pixel, visible.triangle, |_| true).len();
                assert_eq!(crossed % 2, through, "{light:?} at {pixel:?}");
                even += 1 - through;
                odd += through;
            }
        }
    }
    assert!(even > 500 && odd > 150, "{even} even, {odd} odd");
}

#[test]
fn folded_closed_meshes_agree() {
    for seed in 0..3 {
        let triangles: Vec<Triangle> = integer_chaos(seed)
            .into_iter()
            .map(|t| t.map(|v| [v[0] * 2.0, v[1] * 2.0, v[2] + 8.0]))
            .collect();
        let scene = standard_scene(&triangles);
        let mut lights = generic_and_whole();
        lights.extend(super::lights::aimed(&scene, triangles_of(&scene)[seed as usize * 3]));
        agreed(&format!("chaos {seed}"), &scene, &lights);
    }
}
