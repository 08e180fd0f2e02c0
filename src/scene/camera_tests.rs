//! Exactness of directions, the four forms against each other, and what is refused.

use super::*;

/// How far the lattice may move a direction anywhere in the frame, per component: half a step of
/// D0 and W + H half steps of DX and DY (2^(E−45) each).
fn lattice_bound(camera: &PinholeCamera) -> f64 {
    let sides = camera.resolution().width() + camera.resolution().height() + 1;
    f64::from(sides) * 2.0_f64.powi(camera.exponent() - 46)
}

fn frame(width: u32, height: u32) -> Resolution {
    Resolution::new(width, height).unwrap()
}

/// Every product and sum of d(x, y), in several orders, has a zero rounding error.
fn assert_exact(camera: &PinholeCamera, x: f64, y: f64) {
    let two_sum = |a: f64, b: f64| {
        let s = a + b;
        let bb = s - a;
        (s, (a - (s - bb)) + (b - bb))
    };
    for k in 0..3 {
        let (d0, dx, dy) = (camera.d0()[k], camera.dx()[k], camera.dy()[k]);
        let (px, py) = (x * dx, y * dy);
        assert_eq!(x.mul_add(dx, -px), 0.0, "x·DX rounds at ({x}, {y})");
        assert_eq!(y.mul_add(dy, -py), 0.0, "y·DY rounds at ({x}, {y})");
        let (a, ea) = two_sum(d0, px);
        let (b, eb) = two_sum(a, py);
        let (c, ec) = two_sum(px, py);
        let (d, ed) = two_sum(c, d0);
        assert_eq!([ea, eb, ec, ed], [0.0; 4], "a sum rounds at ({x}, {y})");
        assert_eq!(b, d);
    }
}

#[test]
fn directions_are_exact_on_the_subpixel_grid() {
    for (width, height) in [(17, 17), (1920, 1080), (16_384, 16_384), (1, 65_536)] {
        for fov in [0.001, 0.5, 20.0, 60.0, 120.0, 179.0] {
            let camera = PinholeCamera::look_at(
                frame(width, height),
                [0.3, -7.1, 2.9],
                [1.7, 0.2, -0.4],
                [0.1, 1.0, 0.03],
                fov,
            )
            .unwrap();
            let (w, h) = (f64::from(width), f64::from(height));
            for i in 0..40 {
                let snap = |v: f64| (v * 256.0).floor() / 256.0;
                let x = snap(w * f64::from(i * 37 % 40) / 39.0);
                let y = snap(h * f64::from(i) / 39.0);
                assert_exact(&camera, x, y);
            }
            assert_exact(&camera, w, h);
        }
    }
}

#[test]
fn numbers_on_the_lattice_are_kept() {
    let camera = PinholeCamera::exact(
        frame(17, 17),
        [0.0, -0.0, 4_194_304.0],
        [-8.5, -8.5, 8.0],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
    )
    .unwrap();
    assert_eq!(camera.d0(), [-8.5, -8.5, 8.0]);
    assert_eq!(camera.deviation_pixels(), 0.0);
    assert_eq!(camera.axis(), [0.0, 0.0, 1.0]);
    assert_eq!(camera.z_per_t(), 8.0);
    let again =
        PinholeCamera::exact(frame(17, 17), camera.eye(), camera.d0(), camera.dx(), camera.dy())
            .unwrap();
    assert_eq!(again, camera);
}

#[test]
fn a_look_at_camera_is_a_fixed_point_of_its_own_numbers() {
    let camera = PinholeCamera::look_at(
        frame(1920, 1080),
        [0.0, 1.2, 4.0],
        [0.0, 0.4, 0.0],
        [0.0, 1.0, 0.0],
        40.0,
    )
    .unwrap();
    let again = PinholeCamera::exact(
        camera.resolution(),
        camera.eye(),
        camera.d0(),
        camera.dx(),
        camera.dy(),
    )
    .unwrap();
    assert_eq!((again.d0(), again.dx(), again.dy()), (camera.d0(), camera.dx(), camera.dy()));
    assert!(camera.deviation_pixels() < 1e-6, "{}", camera.deviation_pixels());
    assert_eq!(camera.z_per_t(), 1.0);
}

#[test]
fn the_axis_of_an_odd_image_runs_through_its_centre_pixel() {
    let camera = PinholeCamera::look_at(
        frame(17, 17),
        [0.0, 0.0, 5.0],
        [0.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        45.0,
    )
    .unwrap();
    let centre: [f64; 3] =
        std::array::from_fn(|k| camera.d0()[k] + 8.5 * camera.dx()[k] + 8.5 * camera.dy()[k]);
    assert!(centre[0].abs().max(centre[1].abs()) <= lattice_bound(&camera));
    assert!((centre[2] + 1.0).abs() < 1e-12);
    assert!(camera.dx()[0] > 0.0 && camera.dy()[1] < 0.0, "x to the right, y downwards");
}

#[test]
fn opencv_and_gl_agree_with_the_look_at_camera() {
    let (w, h, fov) = (640.0, 480.0, 50.0_f64);
    let look = PinholeCamera::look_at(
        frame(640, 480),
        [1.0, 2.0, 5.0],
        [0.0, 0.5, -1.0],
        [0.0, 1.0, 0.0],
        fov,
    )
    .unwrap();
    let f = unit(sub([0.0, 0.5, -1.0], [1.0, 2.0, 5.0])).unwrap();
    let r = unit(cross(f, [0.0, 1.0, 0.0])).unwrap();
    let u = cross(r, f);
    let focal = h / 2.0 / (fov.to_radians() / 2.0).tan();
    let down = u.map(|c| -c);
    let eye = [1.0, 2.0, 5.0];
    let cv = PinholeCamera::opencv(
        frame(640, 480),
        [[focal, 0.0, w / 2.0], [0.0, focal, h / 2.0], [0.0, 0.0, 1.0]],
        [r, down, f],
        [-dot(r, eye), -dot(down, eye), -dot(f, eye)],
    )
    .unwrap();
    let (near, far) = (0.1, 100.0);
    let back = f.map(|c| -c);
    let view = [
        [r[0], r[1], r[2], -dot(r, eye)],
        [u[0], u[1], u[2], -dot(u, eye)],
        [back[0], back[1], back[2], -dot(back, eye)],
        [0.0, 0.0, 0.0, 1.0],
    ];
    let cot = 1.0 / (fov.to_radians() / 2.0).tan();
    let projection = [
        [cot * h / w, 0.0, 0.0, 0.0],
        [0.0, cot, 0.0, 0.0],
        [0.0, 0.0, (far + near) / (near - far), 2.0 * far * near / (near - far)],
        [0.0, 0.0, -1.0, 0.0],
    ];
    let gl = PinholeCamera::gl(frame(640, 480), view, projection).unwrap();
    for other in [cv, gl] {
        for (a, b) in [
            (other.d0(), look.d0()),
            (other.dx(), look.dx()),
            (other.dy(), look.dy()),
            (other.eye(), look.eye()),
        ] {
            for k in 0..3 {
                // The lattice, and a handful of f64 roundings of numbers below 8.
                let bound = lattice_bound(&look) + 8.0 * 64.0 * f64::EPSILON;
                assert!((a[k] - b[k]).abs() < bound, "{a:?} {b:?}");
            }
        }
        assert!((other.z_per_t() - 1.0).abs() < lattice_bound(&look));
    }
}

#[test]
fn a_shifted_camera_looks_through_the_subpixel_grid() {
    // A frame whose extent is just below a power of two: putting the shifted numbers on a lattice
    // of their own would take the next one and move the image.
    let d0 = [-1000.0 + 1.0 / 4096.0, -3.0, 7.0 + 1.0 / 1024.0];
    let camera =
        PinholeCamera::exact(frame(24, 24), [0.0; 3], d0, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0])
            .unwrap();
    let own =
        lattice::put_on_lattice(frame(24, 24), [[-1000.5, -3.5, 7.0], camera.dx(), camera.dy()]);
    assert!(own.unwrap().exponent > camera.exponent(), "the case is the hard one");
    let look = PinholeCamera::look_at(
        frame(31, 17),
        [1.0, 2.0, 5.0],
        [0.3, 0.5, -1.0],
        [0.0, 1.0, 0.0],
        50.0,
    );
    for camera in [camera, look.unwrap()] {
        for steps in [[0, 0], [-128, -128], [128, 128], [1, -1], [-128, 57]] {
            let shifted = camera.shifted(steps);
            let at = [8.5 + f64::from(steps[0]) / 256.0, 11.5 + f64::from(steps[1]) / 256.0];
            let along = |camera: &PinholeCamera, [x, y]: [f64; 2]| -> [f64; 3] {
                std::array::from_fn(|k| camera.d0()[k] + x * camera.dx()[k] + y * camera.dy()[k])
            };
            assert_eq!(along(&shifted, [8.5, 11.5]), along(&camera, at), "{steps:?}");
            assert_eq!(shifted.exponent(), camera.exponent());
        }
    }
}

#[test]
fn numbers_that_are_no_camera_are_refused() {
    let f = frame(8, 8);
    let (o, z, y) = ([0.0; 3], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]);
    let look = PinholeCamera::look_at;
    assert_eq!(look(f, o, o, y, 45.0), Err(CameraError::NoViewDirection));
    assert_eq!(look(f, o, z, z, 45.0), Err(CameraError::UpParallel));
    assert_eq!(look(f, o, z, o, 45.0), Err(CameraError::UpParallel));
    assert!(matches!(look(f, o, z, y, 180.0), Err(CameraError::FieldOfView(_))));
    assert!(matches!(look(f, o, z, y, f64::NAN), Err(CameraError::FieldOfView(_))));
    assert!(matches!(look(f, [f64::NAN, 0.0, 0.0], z, y, 45.0), Err(CameraError::NotFinite(_))));
    assert!(matches!(look(f, [1e-40, 0.0, 0.0], z, y, 45.0), Err(CameraError::EyeRange(_))));
    assert!(matches!(look(f, [1e39, 0.0, 0.0], z, y, 45.0), Err(CameraError::EyeRange(_))));
    let flat = PinholeCamera::exact(f, o, [1.0, 1.0, 0.0], [1.0, 0.0, 0.0], y);
    assert!(matches!(flat, Err(CameraError::Degenerate(_))));
    let ortho =
        [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, -1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];
    assert!(matches!(PinholeCamera::gl(f, ortho, ortho), Err(CameraError::Degenerate(_))));
}
