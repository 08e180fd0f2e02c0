//! Cameras, loops and depth (A50–A55): what the texts call ray casting, rasterization and the
//! z-buffer, each against the other.

use super::stage::{V3, answer, bits, camera, program_picture, unit};
use crate::support::scenes::triangles_of;
use truecast::accel::{Accelerator, BuildPreset};
use truecast::cast::cast;
use truecast::mesh::TriangleId;
use truecast::pixel::{Pixel, Resolution};
use truecast::render::VisibilityPath;
use truecast::scene::Scene;
use truecast::scene::camera::PinholeCamera;
use truecast::shade;
use truecast::visibility::{Counting, Level, Visible};

/// What is visible but for the level of arithmetic that decided it.
fn regardless_of_level(visible: &Option<Visible>) -> Option<Visible> {
    visible.as_ref().map(|visible| Visible { level: Level::Double, ..*visible })
}

/// Thirty triangles through each other.
fn crowd() -> Scene {
    let mut random = crate::support::rays::Random(50);
    let triangles: Vec<_> = (0..30)
        .map(|_| {
            let centre = [random.integer(6), random.integer(6), random.integer(5)];
            [0; 3].map(|_| centre.map(|c| c + random.integer(5)))
        })
        .collect();
    let mut scene = Scene::from_triangles(camera(), &triangles);
    let busy = super::neutrality::busy_scene();
    scene.lights = busy.lights;
    scene.materials = busy.materials;
    scene.triangle_materials = (0..30).map(|i| i % 2).collect();
    scene
}

#[test]
fn a50_the_middle_pixel_looks_along_the_axis_through_the_centre_of_projection() {
    for (eye, target, up) in [
        ([0.0, 0.0, 5.0], [0.0; 3], [0.0, 1.0, 0.0]),
        ([3.0, -2.0, 7.0], [0.5, 0.25, -1.0], [0.1, 1.0, 0.3]),
        ([-1e3, 20.0, 1e-3], [1.0, 2.0, 3.0], [0.0, 0.0, 1.0]),
    ] {
        let frame = Resolution::new(33, 17).unwrap();
        let camera = PinholeCamera::look_at(frame, eye, target, up, 40.0).unwrap();
        assert_eq!(camera.eye(), eye);
        let way: V3 = unit(std::array::from_fn(|k| target[k] - eye[k]));
        let ray = |pixel: Pixel| -> V3 {
            let [x, y] = pixel.sample();
            std::array::from_fn(|k| camera.d0()[k] + x * camera.dx()[k] + y * camera.dy()[k])
        };
        // The sample of pixel (i, j) is (i + 0.5, j + 0.5), so the middle one is (16, 8); the
        // lattice moves the picture by 1e-10 pixels at most, of 0.04 units each.
        let middle = unit(ray(Pixel { x: 16, y: 8 }));
        for k in 0..3 {
            assert!((middle[k] - way[k]).abs() < 1e-11, "{middle:?} {way:?}");
            assert!((middle[k] - camera.axis()[k]).abs() < 1e-11);
        }
        assert!(camera.deviation_pixels() <= 1e-10);
    }
}

#[test]
fn a51_for_each_pixel_the_nearest_of_all_triangles() {
    for scene in [crowd(), super::neutrality::busy_scene()] {
        let window = scene.camera.resolution().window();
        let cast = |accelerator: &Accelerator| {
            cast(&scene, accelerator, window, Counting::Nearest, &|| ())
        };
        let brute_force = cast(&Accelerator::linear(&scene.mesh));
        assert!(brute_force.covered_pixels() > 50);
        for preset in BuildPreset::ALL {
            let hierarchy = cast(&Accelerator::build(&scene.mesh, preset));
            for (a, b) in brute_force.visible.iter().zip(&hierarchy.visible) {
                assert_eq!(regardless_of_level(a), regardless_of_level(b), "{preset:?}");
            }
        }
    }
}

#[test]
fn a52_for_each_triangle_its_pixels_is_the_same_answer() {
    for scene in [crowd(), super::neutrality::busy_scene()] {
        let [by_rays, by_triangles] =
            [VisibilityPath::Cast, VisibilityPath::Raster].map(|path| answer(&scene, path));
        assert_eq!(by_rays.cover, by_triangles.cover);
        for (a, b) in by_rays.visible.iter().zip(&by_triangles.visible) {
            let what = |v: &Option<Visible>| v.as_ref().map(|v| (v.triangle, v.facing, v.tie));
            assert_eq!(what(a), what(b));
        }
    }
}

#[test]
fn a53_triangles_through_the_eye_plane_need_no_clipping() {
    // A floor 2 below the eye at (0, 0, 8), from before it to behind it.
    let floor = [[-500.0, -2.0, 40.0], [500.0, -2.0, 40.0], [0.0, -2.0, -400.0]];
    let scene = Scene::from_triangles(camera(), &[floor]);
    for path in [VisibilityPath::Cast, VisibilityPath::Raster] {
        let buffer = answer(&scene, path);
        let mut pixels = 0;
        for (pixel, visible) in buffer.window.pixels().zip(&buffer.visible) {
            // The ray (x − 8, 8 − y, −8) meets y = −2 at t = 2/(y − 8), inside the triangle's sides.
            let [dx, dy] = [f64::from(pixel.x) - 8.0, 8.0 - f64::from(pixel.y)];
            let t = -2.0 / dy;
            let (x, z) = (t * dx, 8.0 - 8.0 * t);
            let half_width = 500.0 * (z + 400.0) / 440.0;
            let expected = dy < 0.0 && x.abs() < half_width && z < 40.0;
            assert_eq!(visible.is_some(), expected, "{path:?} {pixel:?}");
            if let Some(visible) = visible {
                assert!((visible.t() / t - 1.0).abs() < 1e-12);
                pixels += 1;
            }
        }
        assert!(pixels > 100);
    }
}

#[test]
fn a54_the_z_buffer_that_shades_first_draws_the_same_picture() {
    let scene = crowd();
    let deferred = program_picture(&scene);
    let buffer = answer(&scene, VisibilityPath::Cast);
    // FAR, looking down −z: bigger z is closer.
    let mut z_buffer = vec![f64::NEG_INFINITY; deferred.len()];
    let mut frame_buffer = vec![scene.background; deferred.len()];
    let mut shader_calls = 0;
    for (index, triangle) in triangles_of(&scene).into_iter().enumerate() {
        let alone = answer(&Scene::from_triangles(camera(), &[triangle]), VisibilityPath::Cast);
        for (place, visible) in alone.visible.iter().enumerate() {
            let Some(visible) = visible else { continue };
            let fragment = Visible { triangle: TriangleId::new(index as u32), ..*visible };
            let z = -8.0 * fragment.t();
            let pixel = alone.window.pixel(place);
            let color = shade::shade_visible(&scene, pixel, &fragment, None);
            shader_calls += 1;
            if z > z_buffer[place] {
                z_buffer[place] = z;
                frame_buffer[place] = color;
            }
        }
    }
    // Strict: of equal depths the first drawn stays, which is the lowest id here as well.
    assert_eq!(bits(&frame_buffer), bits(&deferred));
    // What it costs: one call for each triangle that covers a pixel.
    let crossed: u32 = buffer.cover.as_ref().unwrap().iter().map(|cover| cover.crossed).sum();
    assert_eq!(shader_calls, crossed);
    assert!(crossed as usize > buffer.covered_pixels() * 3 / 2);
}

#[test]
fn a55_incremental_depth_drifts_and_never_decides() {
    // Two slanted planes seen by one row; along it 1/depth is linear: (f − m·x)/(f·c).
    const WIDTH: u32 = 4096;
    let frame = Resolution::new(WIDTH, 1).unwrap();
    let f = f64::from(WIDTH) / 2.0;
    let eye_row =
        PinholeCamera::exact(frame, [0.0; 3], [-f, -0.5, f], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0])
            .unwrap();
    // Depths c + m·x. The slopes are such that a step of 1/depth is 512 + 9/16 and 512 + 7/16
    // units of 2^-23, which addition near 1 rounds up and down.
    let (near, far) = ((1.0_f32, 8201.0 / 65536.0), (1.0 + 2.0_f32.powi(-14), 8199.0 / 65536.0));
    let plane = |(c, m): (f32, f32)| {
        let at = |x: f32, y: f32| [x, y, c + m * x];
        [at(-4.0, -2.0), at(4.0, -2.0), at(0.0, 8.0)]
    };
    let scene = Scene::from_triangles(eye_row, &[plane(far), plane(near)]);
    // 1/depth at pixel x by the formula, and by one f32 addition per pixel (bigger is nearer).
    let direct = |(c, m): (f32, f32), x: u32| {
        let across = f64::from(x) + 0.5 - f;
        (f - f64::from(m) * across) / (f * f64::from(c))
    };
    let incremental = |plane: (f32, f32)| -> Vec<f32> {
        let step = (direct(plane, 1) - direct(plane, 0)) as f32;
        let first = direct(plane, 0) as f32;
        std::iter::successors(Some(first), |w| Some(w + step)).take(WIDTH as usize).collect()
    };
    assert!((0..WIDTH).all(|x| direct(near, x) > direct(far, x)));
    let (nearer, farther) = (incremental(near), incremental(far));
    let drift = |x: u32| (f64::from(nearer[x as usize]) - direct(near, x)).abs();
    // Rounding once costs 2^-24; here it has grown by two digits and more.
    assert!(drift(0) <= 2.0_f64.powi(-24));
    let largest = (0..WIDTH).map(drift).fold(0.0, f64::max);
    assert!(largest > 100.0 * 2.0_f64.powi(-24), "{largest:e}");
    let wrong = nearer.iter().zip(&farther).filter(|(near, far)| near <= far).count();
    assert!(wrong > 100, "incremental depth takes the wrong plane at {wrong} pixels");
    // Both paths see the nearer plane everywhere.
    for path in [VisibilityPath::Cast, VisibilityPath::Raster] {
        let buffer = answer(&scene, path);
        let right = |visible: &Option<Visible>| {
            visible.as_ref().is_some_and(|visible| visible.triangle == TriangleId::new(1))
        };
        assert!(buffer.visible.iter().all(right), "{path:?}");
    }
}
