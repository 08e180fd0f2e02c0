//! Where the watertight rasterizer may differ from the exact answer, and where it must not.

use super::{generic_camera, snapped, sphere};
use crate::stability::ids;
use crate::support::closed::integer_chaos;
use crate::support::scenes::{Triangle, scaled};
use std::path::Path;
use truecast::mesh::TriangleId;
use truecast::pixel::{Pixel, Resolution};
use truecast::raster::{DEPTH_ERROR, STANDARD_HALF_WIDTH, rasterize, stability};
use truecast::scene::{Overrides, Scene};
use truecast::visibility::Counting;

/// Half width of the box that covers what snapping to `bits` bits does: vertices move by half a
/// step, and the rounding of an f64 projection moves them by far less than a thousandth of that.
fn half_width(bits: u32) -> f64 {
    0.5_f64.powi(bits as i32 + 1) * (1.0 + 0.001)
}

/// Least and greatest 1/t of a triangle's plane over the box around a sample: both vertices and
/// depth move with the snapping, so the snapped depth at the sample is the true one at another
/// point of the box.
fn inverse_depths(scene: &Scene, id: TriangleId, pixel: Pixel, h: f64) -> [f64; 2] {
    let camera = &scene.camera;
    let [a, b, c] = scene.mesh.triangle(id).map(|v| v.map(f64::from));
    let subtract = |p: [f64; 3], q: [f64; 3]| [p[0] - q[0], p[1] - q[1], p[2] - q[2]];
    let dot = |p: [f64; 3], q: [f64; 3]| p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
    let (u, v) = (subtract(b, a), subtract(c, a));
    let n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    let distance = dot(n, subtract(a, camera.eye()));
    let [x, y] = pixel.sample();
    let corners = [[x - h, y - h], [x + h, y - h], [x - h, y + h], [x + h, y + h]];
    let values = corners.map(|[x, y]| {
        let d = std::array::from_fn(|k| camera.d0()[k] + x * camera.dx()[k] + y * camera.dy()[k]);
        dot(n, d) / distance
    });
    [values.into_iter().fold(f64::MAX, f64::min), values.into_iter().fold(f64::MIN, f64::max)]
}

/// Interval of 1/t that f32 depth can say for a plane over the box. 1e-12: this test's own rounding.
fn stated(range: [f64; 2]) -> [f64; 2] {
    let room = DEPTH_ERROR + 1e-12;
    [range[0] * (1.0 - room), range[1] * (1.0 + room)]
}

fn scenes() -> Vec<(String, Scene)> {
    let mut scenes = Vec::new();
    let camera = generic_camera(160);
    scenes.push((
        "sphere".to_owned(),
        Scene::from_triangles(camera.clone(), &sphere(30, 1.0, [0.0; 3])),
    ));
    // Two spheres that cross each other, and one a little larger than another: near depths.
    let mut crossing = sphere(24, 1.0, [0.0; 3]);
    crossing.extend(sphere(20, 0.9, [0.2, 0.1, 0.1]));
    crossing.extend(sphere(24, 1.000_01, [0.0; 3]));
    scenes.push(("crossing spheres".to_owned(), Scene::from_triangles(camera.clone(), &crossing)));
    for seed in 0..6 {
        let chaos: Vec<Triangle> = scaled(&integer_chaos(seed), 0.3);
        scenes.push((format!("chaos {seed}"), Scene::from_triangles(camera.clone(), &chaos)));
    }
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/default.toml");
    let overrides = Overrides { resolution: Resolution::new(240, 135), ..Overrides::default() };
    scenes.push(("default scene".to_owned(), Scene::load(&path, &overrides).unwrap()));
    scenes
}

/// At every stable pixel the snapped answer is the exact one, unless the two triangles' depths
/// come, over the box, within the stated error of f32 depth.
#[test]
fn differences_lie_where_the_mask_or_the_depth_error_allows_them() {
    let (mut differing, mut by_depth, mut stable_pixels) = ([0; 4], 0, 0);
    for (name, scene) in scenes() {
        let window = scene.camera.resolution().window();
        let exact = rasterize(&scene, window, Counting::Nearest, &|| ());
        for (k, bits) in [0, 4, 8, 12].into_iter().enumerate() {
            let mut widths = vec![half_width(bits)];
            if bits == 8 {
                widths.push(STANDARD_HALF_WIDTH);
            }
            let answer = snapped(&scene, bits);
            for width in widths {
                let stable = stability(&scene, &exact, width, &|| ());
                for (index, (a, b)) in ids(&answer).into_iter().zip(ids(&exact)).enumerate() {
                    let pixel = window.pixel(index);
                    let place = format!("{name}, {bits} bits, {pixel:?}: {a:?}, not {b:?}");
                    stable_pixels += usize::from(stable[index]);
                    differing[k] += usize::from(a != b);
                    if !stable[index] {
                        continue;
                    }
                    assert_eq!(a.is_some(), b.is_some(), "{place}");
                    let (Some(a), Some(b)) = (a, b) else { continue };
                    let [wrong, right] =
                        [a, b].map(|id| stated(inverse_depths(&scene, id, pixel, width)));
                    if a != b {
                        assert!(wrong[1] >= right[0], "{place}");
                        by_depth += 1;
                    }
                    // And the depth itself is what it may be.
                    let t = answer.visible[index].unwrap().t();
                    assert!(wrong[0] <= 1.0 / t && 1.0 / t <= wrong[1], "{place}: t = {t}");
                }
            }
        }
    }
    // The mode does differ, less with every bit, and the mask leaves most of the pictures to it.
    assert!(differing[0] > 500 && differing[2] > 20, "{differing:?}");
    assert!(differing[0] > differing[1] && differing[1] > differing[2], "{differing:?}");
    assert!(stable_pixels > 500_000, "{stable_pixels}");
    assert!(by_depth < 5000, "{by_depth}");
}
