//! The f64 filters against the integers, on inputs made to be nearly zero.

mod lanes;
mod shown;

use super::bins::set_up;
use super::bounds::{Rectangle, Region, pixels_of};
use super::dyadic::Scaled;
use super::exact::ExactTriangle;
use super::image_plane::ImagePlane;
use super::rows::{Projection, U};
use crate::mesh::TriangleId;
use crate::pixel::{Pixel, Resolution};
use crate::scene::Scene;
use crate::scene::camera::PinholeCamera;

fn frame() -> Resolution {
    Resolution::new(640, 360).unwrap()
}

fn cameras() -> Vec<PinholeCamera> {
    let look = |eye, fov| {
        PinholeCamera::look_at(frame(), eye, [0.3, 0.1, -0.2], [0.1, 1.0, 0.0], fov).unwrap()
    };
    vec![
        look([1.3, 0.9, 4.1], 40.0),
        look([1e-3, 2e5, 7.7], 0.5),
        look([-0.7, 0.2, 0.5], 150.0),
        PinholeCamera::exact(
            frame(),
            [0.0, 0.0, -5.0],
            [-320.0, -180.0, 300.0],
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
        )
        .unwrap(),
    ]
}

/// A point of the ray through `pixel`, nearly: the f32 nearest to e + t·d.
fn on_ray(camera: &PinholeCamera, pixel: [f64; 2], t: f64) -> [f32; 3] {
    std::array::from_fn(|k| {
        let d = camera.d0()[k] + pixel[0] * camera.dx()[k] + pixel[1] * camera.dy()[k];
        (camera.eye()[k] + t * d) as f32
    })
}

/// Triangles whose edges pass within a few f32 ulps of the sample of `AIM`, in many sizes; the
/// middle one has corners exactly opposite of each other around it.
const AIM: Pixel = Pixel { x: 401, y: 77 };

fn aimed_triangles(camera: &PinholeCamera) -> Vec<[[f32; 3]; 3]> {
    let [x, y] = AIM.sample();
    let mut triangles = Vec::new();
    for step in 0..120_i32 {
        let size = 2.0_f64.powi(step % 24 - 12);
        let angle = f64::from(step) * 0.7;
        let (c, s) = (size * angle.cos(), size * angle.sin());
        let t = 0.5 + f64::from(step % 7);
        let a = on_ray(camera, [x + c, y + s], t);
        let b = on_ray(camera, [x - c, y - s], t * (1.0 + f64::from(step % 3)));
        let third = on_ray(camera, [x - s, y + 2.0 * c], t * 1.5);
        let hub = on_ray(camera, [x, y], t);
        // Edges near the sample, a corner near it, and triangles nearly edge-on: their third corner
        // lies almost on the line through two others.
        let middle = std::array::from_fn(|k| (a[k] + third[k]) * 0.5);
        triangles.extend([[a, b, third], [hub, a, third], [b, third, a], [a, middle, third]]);
    }
    triangles
}

/// The camera moved so that the ray of `AIM` passes an edge (or a corner) within the rounding of an
/// f64: f32 corners alone cannot come that near.
fn moved_onto_an_edge(
    camera: &PinholeCamera,
    corners: [[f32; 3]; 3],
    index: usize,
) -> PinholeCamera {
    let [x, y] = AIM.sample();
    let (from, to) = (corners[index % 3], corners[(index + 1) % 3]);
    let (share, t) = ((index / 3 % 8) as f64 / 7.0, 0.3 + (index % 5) as f64);
    let eye = std::array::from_fn(|k| {
        let d = camera.d0()[k] + x * camera.dx()[k] + y * camera.dy()[k];
        let (from, to) = (f64::from(from[k]), f64::from(to[k]));
        from + share * (to - from) - t * d
    });
    let (d0, dx, dy) = (camera.d0(), camera.dx(), camera.dy());
    PinholeCamera::exact(frame(), eye, d0, dx, dy).unwrap()
}

#[test]
fn a_certified_sign_is_never_wrong() {
    let (mut certified, mut naive_errors) = (0, 0);
    for camera in cameras() {
        for (index, &corners) in aimed_triangles(&camera).iter().enumerate() {
            let id = TriangleId::new(index as u32);
            let plane = ImagePlane::new(&moved_onto_an_edge(&camera, corners, index));
            let exact = ExactTriangle::new(&plane, corners);
            // V: certified by f64 or handed over; either way its sign is the exact one.
            let rows = Projection::new(&plane, corners).rows(&plane, id, || {
                exact.as_ref().map(|exact| (exact.volume_sign, exact.volume(&plane)))
            });
            let (Some(rows), Some(exact)) = (&rows, &exact) else {
                assert!(rows.is_none() && exact.is_none());
                continue;
            };
            assert_eq!(rows.volume_sign, exact.volume_sign);
            // Edges, at the aimed sample and around it.
            for pixel in [AIM, Pixel { x: AIM.x + 1, y: AIM.y - 1 }, Pixel { x: 0, y: 359 }] {
                let [x, y] = pixel.sample();
                for (row, truth) in rows.edges.iter().zip(&exact.edges) {
                    let (value, sign) = (row.at(x, y), truth.sign_at(pixel));
                    naive_errors += i32::from(value != 0.0 && (value < 0.0) != (sign < 0));
                    if value > row.bound {
                        assert_eq!(sign, 1, "{index} {pixel:?}");
                        certified += 1;
                    } else if value < -row.bound {
                        assert_eq!(sign, -1, "{index} {pixel:?}");
                        certified += 1;
                    }
                    // The bound holds for the value too, not only for the sign; 2^-52 is the
                    // rounding of the integer on its way to f64.
                    let scale = 2 * plane.exact.adjugate_exponent;
                    let mut exact_value = truth.value_at(pixel);
                    exact_value.exponent += scale + 2 * exact.unit;
                    let exact_value = exact_value.value();
                    assert!(
                        (value - exact_value).abs() <= row.bound + exact_value.abs() * f64::EPSILON,
                        "{index} {pixel:?}: {value:e} {exact_value:e} {:e}",
                        row.bound
                    );
                }
            }
        }
    }
    assert!(certified > 5000, "{certified}");
    assert!(naive_errors > 20, "the inputs are too easy: {naive_errors}");
}

#[test]
fn depth_intervals_hold_the_exact_depth() {
    for camera in cameras() {
        let triangles = aimed_triangles(&camera);
        let scene = Scene::from_triangles(camera, &triangles);
        let plane = ImagePlane::new(&scene.camera);
        let mut depths = 0;
        for (index, &corners) in triangles.iter().enumerate() {
            let id = TriangleId::new(index as u32);
            let region = Region::samples(frame().window());
            let Some(candidate) = set_up(&plane, &scene.mesh, region, id) else { continue };
            let exact = ExactTriangle::new(&plane, corners).unwrap();
            if exact.edges.iter().any(|edge| edge.sign_at(AIM) <= 0) {
                continue;
            }
            let [x, y] = AIM.sample();
            let [low, high] = candidate.rows.inverse_depth(x, y);
            // The interval bounds (plane row)/|V| = |det P|⁻¹·2^-lattice_exponent / t, because t is
            // in units of the lattice's directions. `t_at` is off by at most 6u and the
            // factor and quotient by 3u: 12u.
            let factor = Scaled {
                mantissa: 1.0 / Scaled::from_integer(&plane.exact.determinant).mantissa.abs(),
                exponent: -Scaled::from_integer(&plane.exact.determinant).exponent
                    - plane.exact.lattice_exponent,
            };
            let truth = factor.value() / exact.t_at(AIM);
            assert!(low <= truth * (1.0 + 12.0 * U), "{index}: {low:e} {truth:e}");
            assert!(high >= truth * (1.0 - 12.0 * U), "{index}: {high:e} {truth:e}");
            depths += 1;
        }
        assert!(depths > 20, "{depths}");
    }
}

#[test]
fn nothing_covered_lies_outside_the_bounds() {
    let window = frame().window();
    let (mut boxes, mut checked) = (0, 0);
    for camera in cameras() {
        let triangles = aimed_triangles(&camera);
        let plane = ImagePlane::new(&camera);
        for &corners in &triangles {
            let pixels =
                pixels_of(&plane, &Projection::new(&plane, corners), Region::samples(window));
            let Some(exact) = ExactTriangle::new(&plane, corners) else { continue };
            boxes += usize::from(pixels.is_some_and(|p| p != Rectangle::of(window)));
            for pixel in window.pixels().filter(|p| (p.x ^ p.y) % 37 == 0 || *p == AIM) {
                let inside = exact.edges.iter().all(|row| row.moved_sign(row.sign_at(pixel)) > 0);
                if inside {
                    let held = pixels.is_some_and(|p| {
                        (p.x0..p.x1).contains(&pixel.x) && (p.y0..p.y1).contains(&pixel.y)
                    });
                    assert!(held, "{pixel:?} of {corners:?} is outside {pixels:?}");
                    checked += 1;
                }
            }
        }
    }
    assert!(boxes > 500 && checked > 5000, "{boxes} {checked}");
}
