//! Cameras written as OpenCV and OpenGL write them, against pixel positions computed here.
//!
//! The projections below are the textbook's, in plain f64, and know nothing of this crate: OpenCV's
//! documentation of the pinhole model (`s·(u, v, 1) = K·(R·X + t)`) and the OpenGL specification
//! (clip = projection · view · (X, 1), NDC = clip/w, viewport). Convention: the centre of pixel
//! (i, j) is the point (i + ½, j + ½) of K's image plane; NDC y points upwards, rows downwards.
//!
//! For many pixels of every camera, three points are searched by the forward projection alone that
//! land around the pixel's centre, and the triangle between them must be seen by exactly that pixel.

use crate::support::closed::integer_chaos;
use crate::support::scenes::Triangle;
use truecast::accel::{Accelerator, BuildPreset};
use truecast::cast::cast;
use truecast::pixel::{Pixel, Resolution};
use truecast::raster::rasterize;
use truecast::scene::Scene;
use truecast::scene::camera::PinholeCamera;
use truecast::visibility::Counting;

type Vector = [f64; 3];
type Matrix3 = [[f64; 3]; 3];
type Matrix4 = [[f64; 4]; 4];

/// A projection by the textbook: where in the image, in pixels from its top left corner, and a
/// number that is positive exactly before the camera.
struct Textbook<'a> {
    project: &'a dyn Fn(Vector) -> ([f64; 2], f64),
    /// The point of that camera-space position (x right, y, z as the convention has them).
    world: &'a dyn Fn(Vector) -> Vector,
    /// A unit of camera space before the camera.
    forward: Vector,
}

fn rows(matrix: &Matrix3, v: Vector) -> Vector {
    matrix.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

fn transposed(m: &Matrix3) -> Matrix3 {
    std::array::from_fn(|i| std::array::from_fn(|j| m[j][i]))
}

fn product4(a: &Matrix4, b: &Matrix4) -> Matrix4 {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..4).map(|k| a[i][k] * b[k][j]).sum::<f64>()))
}

/// Rotation about an axis (Rodrigues' formula), angle in degrees.
fn rotation(axis: Vector, degrees: f64) -> Matrix3 {
    let length = axis.iter().map(|c| c * c).sum::<f64>().sqrt();
    let [x, y, z] = axis.map(|c| c / length);
    let (sin, cos) = degrees.to_radians().sin_cos();
    let k = 1.0 - cos;
    [
        [cos + x * x * k, x * y * k - z * sin, x * z * k + y * sin],
        [y * x * k + z * sin, cos + y * y * k, y * z * k - x * sin],
        [z * x * k - y * sin, z * y * k + x * sin, cos + z * z * k],
    ]
}

/// The rotations of all cases: none, about each axis, a half turn, and some in between.
fn rotations() -> Vec<Matrix3> {
    vec![
        rotation([0.0, 0.0, 1.0], 0.0),
        rotation([1.0, 0.0, 0.0], 90.0),
        rotation([0.0, 1.0, 0.0], 180.0),
        rotation([0.0, 0.0, 1.0], -37.0),
        rotation([1.0, 2.0, -0.5], 113.0),
        rotation([-3.0, 0.2, 1.0], 271.5),
    ]
}

/// The rotation seen in a mirror: x is negated.
fn mirrored(r: &Matrix3) -> Matrix3 {
    [r[0].map(|c| -c), r[1], r[2]]
}

impl Textbook<'_> {
    /// A world point that lands at `target`, by Newton's method on the projection from `start`.
    fn point_at(&self, start: Vector, target: [f64; 2]) -> Vector {
        let mut point = start;
        let (from, _) = (self.project)(start);
        // Move the target from where the start lands, so that no step passes behind the camera.
        for part in 1..=24 {
            let share = (f64::from(part) / 16.0).min(1.0);
            let to: [f64; 2] = std::array::from_fn(|k| from[k] + (target[k] - from[k]) * share);
            let (at, _) = (self.project)(point);
            let size = point.iter().zip(start).map(|(p, s)| (p - s).abs()).fold(1e-3, f64::max);
            let h = size * 1e-5;
            let columns: [[f64; 2]; 3] = std::array::from_fn(|k| {
                let mut moved = point;
                moved[k] += h;
                let (there, _) = (self.project)(moved);
                [(there[0] - at[0]) / h, (there[1] - at[1]) / h]
            });
            // The smallest step that does it: Jᵀ·(J·Jᵀ)⁻¹·r.
            let square = |a: usize, b: usize| columns.iter().map(|c| c[a] * c[b]).sum::<f64>();
            let (aa, ab, bb) = (square(0, 0), square(0, 1), square(1, 1));
            let determinant = aa * bb - ab * ab;
            let r = [to[0] - at[0], to[1] - at[1]];
            let weights =
                [(bb * r[0] - ab * r[1]) / determinant, (aa * r[1] - ab * r[0]) / determinant];
            for k in 0..3 {
                point[k] += columns[k][0] * weights[0] + columns[k][1] * weights[1];
            }
        }
        point
    }
}

/// What both paths see, by pixel.
fn seen(camera: &PinholeCamera, triangles: &[Triangle]) -> Vec<Option<u32>> {
    let scene = Scene::from_triangles(camera.clone(), triangles);
    let window = camera.resolution().window();
    let accelerator = Accelerator::build(&scene.mesh, BuildPreset::Medium);
    let cast = cast(&scene, &accelerator, window, Counting::Nearest, &|| ());
    let raster = rasterize(&scene, window, Counting::Nearest, &|| ());
    let ids = |buffer: &truecast::visibility::VisibilityBuffer| -> Vec<Option<u32>> {
        buffer.visible.iter().map(|v| v.map(|v| v.triangle.get())).collect()
    };
    assert_eq!(ids(&cast), ids(&raster));
    ids(&cast)
}

/// Corners of the aimed triangles, from the pixel's centre: well around it, well inside the pixel.
const AROUND: [[f64; 2]; 3] = [[-0.3, -0.2], [0.3, -0.2], [0.0, 0.35]];

/// How far the rounding of a corner to f32 may move it, in pixels: the corners miss the centre and
/// the pixel's border by 0.1 at least.
const ROUNDING_PIXELS: f64 = 0.05;

/// Puts a triangle around the centre of every fifth pixel and of the corners, at several depths,
/// and one behind the camera for each; exactly the aimed pixels must see exactly their own.
fn assert_sees(name: &str, camera: &PinholeCamera, textbook: &Textbook<'_>, depths: &[f64]) {
    let frame = camera.resolution();
    let window = frame.window();
    let mut triangles: Vec<Triangle> = Vec::new();
    let mut expected = vec![None; window.len()];
    let (right, bottom) = (frame.width() - 1, frame.height() - 1);
    let is_aimed = |p: &Pixel| {
        (p.x + 3 * p.y).is_multiple_of(23)
            || ([0, right].contains(&p.x) && [0, bottom].contains(&p.y))
    };
    for (number, pixel) in window.pixels().filter(is_aimed).enumerate() {
        let depth = depths[number % depths.len()];
        let start = (textbook.world)(textbook.forward.map(|c| c * depth));
        let centre = [f64::from(pixel.x) + 0.5, f64::from(pixel.y) + 0.5];
        let triangle: Triangle = AROUND.map(|[du, dv]| {
            let target = [centre[0] + du, centre[1] + dv];
            let corner = textbook.point_at(start, target).map(|c| c as f32);
            let (landed, w) = (textbook.project)(corner.map(f64::from));
            let missed = (landed[0] - target[0]).abs().max((landed[1] - target[1]).abs());
            assert!(w > 0.0 && missed < ROUNDING_PIXELS, "{name}: {target:?} {landed:?}");
            corner
        });
        expected[window.index(pixel)] = Some(triangles.len() as u32);
        triangles.push(triangle);
        // The same directions, backwards through the eye.
        let eye = (textbook.world)([0.0; 3]);
        triangles.push(triangle.map(|corner| {
            let behind: Vector = std::array::from_fn(|k| 2.0 * eye[k] - f64::from(corner[k]));
            assert!((textbook.project)(behind).1 < 0.0);
            behind.map(|c| c as f32)
        }));
    }
    assert!(triangles.len() > 30, "{name}");
    assert!(seen(camera, &triangles) == expected, "{name}: another pixel sees a triangle");
}

fn assert_opencv(name: &str, [width, height]: [u32; 2], k: Matrix3, r: Matrix3, t: Vector) {
    let frame = Resolution::new(width, height).unwrap();
    let camera = PinholeCamera::opencv(frame, k, r, t).unwrap();
    let project = |x: Vector| {
        let in_camera = rows(&r, x);
        let [x, y, z] = std::array::from_fn(|i| in_camera[i] + t[i]);
        let (x, y) = (x / z, y / z);
        ([k[0][0] * x + k[0][1] * y + k[0][2], k[1][1] * y + k[1][2]], z)
    };
    let inverse = transposed(&r);
    let world = |p: Vector| rows(&inverse, std::array::from_fn(|i| p[i] - t[i]));
    let textbook = Textbook { project: &project, world: &world, forward: [0.0, 0.0, 1.0] };
    assert_sees(name, &camera, &textbook, &[1.0, 0.4, 3.0, 50.0]);
}

#[test]
fn opencv_cameras_see_where_the_textbook_projects() {
    let t = [0.3, -1.2, 4.5];
    let intrinsics: [(&str, [u32; 2], Matrix3); 7] = [
        ("centred", [64, 48], [[60.0, 0.0, 32.0], [0.0, 60.0, 24.0], [0.0, 0.0, 1.0]]),
        ("odd size", [33, 17], [[40.0, 0.0, 16.5], [0.0, 40.0, 8.5], [0.0, 0.0, 1.0]]),
        ("off centre", [40, 31], [[51.3, 0.0, 7.81], [0.0, 51.3, 26.4], [0.0, 0.0, 1.0]]),
        ("outside", [32, 31], [[70.0, 0.0, -9.25], [0.0, 70.0, 55.5], [0.0, 0.0, 1.0]]),
        ("oblong pixels", [48, 40], [[30.0, 0.0, 24.3], [0.0, 75.0, 19.6], [0.0, 0.0, 1.0]]),
        ("skew", [41, 32], [[55.0, 9.7, 20.1], [0.0, 47.0, 15.9], [0.0, 0.0, 1.0]]),
        ("mirrored K", [32, 24], [[-45.0, 0.0, 16.2], [0.0, 45.0, 11.7], [0.0, 0.0, 1.0]]),
    ];
    for (name, size, k) in intrinsics {
        for (number, r) in rotations().iter().enumerate() {
            assert_opencv(&format!("{name}, rotation {number}"), size, k, *r, t);
        }
        assert_opencv(&format!("{name}, mirrored R"), size, k, mirrored(&rotations()[4]), t);
    }
}

fn assert_gl(name: &str, [width, height]: [u32; 2], view: Matrix4, projection: Matrix4) {
    let frame = Resolution::new(width, height).unwrap();
    let camera = PinholeCamera::gl(frame, view, projection).unwrap();
    let both = product4(&projection, &view);
    let project = |x: Vector| {
        let clip = both.map(|row| row[0] * x[0] + row[1] * x[1] + row[2] * x[2] + row[3]);
        let ndc = [clip[0] / clip[3], clip[1] / clip[3]];
        let column = (ndc[0] + 1.0) / 2.0 * f64::from(width);
        let row = (1.0 - ndc[1]) / 2.0 * f64::from(height);
        ([column, row], clip[3])
    };
    let inverse: Matrix3 = std::array::from_fn(|i| std::array::from_fn(|j| view[j][i]));
    let world = |p: Vector| rows(&inverse, std::array::from_fn(|i| p[i] - view[i][3]));
    // clip.w = ∓z in camera space.
    let forward = [0.0, 0.0, projection[3][2].signum()];
    let textbook = Textbook { project: &project, world: &world, forward };
    // Depths before the near plane, between the planes and beyond the far one: none is a limit here.
    assert_sees(name, &camera, &textbook, &[0.05, 1.0, 7.0, 2000.0]);
}

/// glFrustum of the classic API.
fn frustum(l: f64, r: f64, b: f64, t: f64, near: f64, far: f64) -> Matrix4 {
    [
        [2.0 * near / (r - l), 0.0, (r + l) / (r - l), 0.0],
        [0.0, 2.0 * near / (t - b), (t + b) / (t - b), 0.0],
        [0.0, 0.0, -(far + near) / (far - near), -2.0 * far * near / (far - near)],
        [0.0, 0.0, -1.0, 0.0],
    ]
}

/// The same for a camera that looks along +z, y upwards: a left-handed space.
fn left_handed(projection: Matrix4) -> Matrix4 {
    projection.map(|row| [row[0], row[1], -row[2], row[3]])
}

#[test]
fn gl_cameras_see_where_the_specification_projects() {
    let wide = frustum(-0.1, 0.1, -0.075, 0.075, 0.1, 100.0);
    let off_centre = frustum(-0.03, 0.11, -0.09, 0.02, 0.1, 100.0);
    let deep = frustum(-1.0, 1.0, -1.0, 1.0, 1.5, 1e9);
    let shallow = frustum(-0.5, 0.5, -0.4, 0.4, 0.6, 0.600_001);
    let mut infinite = wide;
    infinite[2] = [0.0, 0.0, -1.0, -0.2];
    let mut flipped = wide;
    flipped[1] = flipped[1].map(|c| -c);
    let projections = [
        ("wide", [64, 48], wide),
        ("off centre", [41, 33], off_centre),
        ("far off", [32, 32], deep),
        ("near and far alike", [33, 32], shallow),
        ("infinitely far", [40, 31], infinite),
        ("y flipped", [36, 27], flipped),
        ("left-handed", [37, 28], left_handed(off_centre)),
    ];
    let t = [-0.7, 2.5, -3.0];
    let view = |r: &Matrix3| -> Matrix4 {
        let row = |i: usize| [r[i][0], r[i][1], r[i][2], t[i]];
        [row(0), row(1), row(2), [0.0, 0.0, 0.0, 1.0]]
    };
    for (name, size, projection) in projections {
        for (number, r) in rotations().iter().enumerate() {
            assert_gl(&format!("{name}, rotation {number}"), size, view(r), projection);
        }
        let mirrored = view(&mirrored(&rotations()[4]));
        assert_gl(&format!("{name}, mirrored view"), size, mirrored, projection);
    }
}

/// K of focal length 64 and principal point (cx, cy): every number of the camera is exact.
fn camera_at([cx, cy]: [f64; 2]) -> PinholeCamera {
    let identity = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let k = [[64.0, 0.0, cx], [0.0, 64.0, cy], [0.0, 0.0, 1.0]];
    PinholeCamera::opencv(Resolution::new(48, 40).unwrap(), k, identity, [0.0, 0.0, 8.0]).unwrap()
}

#[test]
fn half_a_pixel_in_k_is_half_a_pixel_in_the_picture() {
    let triangles: Vec<Triangle> = (0..6).flat_map(integer_chaos).collect();
    let middle = camera_at([24.0, 20.0]);
    let picture = seen(&middle, &triangles);
    assert!(picture.iter().flatten().count() > 500, "something is in the picture");
    // Half a pixel: the same directions as samples that are moved the other way.
    let half = camera_at([24.5, 20.5]);
    let picture_by_half = seen(&half, &triangles);
    assert_eq!(half.d0(), middle.shifted([-128, -128]).d0());
    assert_eq!(picture_by_half, seen(&middle.shifted([-128, -128]), &triangles));
    assert_ne!(picture_by_half, picture);
    // Twice that is a pixel to the right and a pixel down.
    let whole = seen(&camera_at([25.0, 21.0]), &triangles);
    for y in 1..40 {
        for x in 1..48 {
            assert_eq!(whole[y * 48 + x], picture[(y - 1) * 48 + x - 1], "({x}, {y})");
        }
    }
}

#[test]
fn integer_centres_are_converted_by_half_a_pixel() {
    // A calibration that puts the centre of pixel (i, j) at (i, j) and its principal point at the
    // centre of pixel (20, 10): the point on the optical axis is seen by that pixel alone.
    let tiny: Triangle = [[-0.01, -0.01, 0.0], [0.02, -0.01, 0.0], [-0.01, 0.02, 0.0]];
    let seen_by = |camera: &PinholeCamera| -> Vec<usize> {
        let picture = seen(camera, &[tiny]);
        picture.iter().enumerate().filter(|(_, id)| id.is_some()).map(|(at, _)| at).collect()
    };
    let converted = camera_at([20.0 + 0.5, 10.0 + 0.5]);
    assert_eq!(seen_by(&converted), [10 * 48 + 20]);
    // Unconverted, the axis meets the corner between four pixels and no centre is near.
    assert_eq!(seen_by(&camera_at([20.0, 10.0])), [0_usize; 0]);
}
