//! H70–H7A: scales, translations and the ends of the range of numbers.

use super::{assert_covered_once, cover, ids, times_power_of_two, triangles_of};
use crate::support::configurations::{Breadth, FULL, NARROW, agreed, agreed_within};
use crate::support::golden;
use crate::support::rays::Random;
use crate::support::scenes::{
    Triangle, rectangle, scaled, single_ray, standard_camera, standard_scene,
};
use crate::support::sizes;
use dashu_ratio::RBig;
use truecast::accel::BuildPreset;
use truecast::exact::Arbiter;
use truecast::pixel::{Pixel, Resolution};
use truecast::scene::Scene;
use truecast::scene::camera::PinholeCamera;
use truecast::visibility::VisibilityBuffer;

/// META: ids, counts, weights and ties are the same bits, t is 2^k times as long.
#[track_caller]
fn assert_scaled(reference: &VisibilityBuffer, buffer: &VisibilityBuffer, k: i32) {
    assert_eq!(ids(reference), ids(buffer), "2^{k}");
    assert_eq!(reference.cover, buffer.cover, "2^{k}");
    for (a, b) in reference.visible.iter().flatten().zip(buffer.visible.iter().flatten()) {
        let factor = 2.0_f64.powi(k);
        assert_eq!((a.barycentric, a.tie, a.facing), (b.barycentric, b.tie, b.facing), "2^{k}");
        assert_eq!((a.t_lo * factor, a.t_hi * factor), (b.t_lo, b.t_hi), "2^{k}");
    }
}

/// Every power of two from 2^-120 to 2^110; and in the golden files, whose numbers another
/// program scaled.
#[test]
fn h70_scale_sweep() {
    let golden = golden::scene("grid_exact");
    let triangles = triangles_of(&golden.scene);
    let reference = agreed(&golden.scene);
    assert_eq!(ids(&reference), golden.ids);
    for k in -120..=110 {
        let scene = standard_scene(&times_power_of_two(&triangles, k));
        // All trees and the arbiter at every tenth power.
        let buffer = match k % 10 {
            0 => agreed(&scene),
            _ => agreed_within(&scene, &Breadth { audited_pixels: 2, ..NARROW }, "grid"),
        };
        assert_scaled(&reference, &buffer, k);
    }
    for (name, k) in [("2^-60", -60), ("2^60", 60), ("2^110", 110)] {
        let written = golden::scene(&format!("grid_exact_scaled_{name}"));
        assert_scaled(&reference, &agreed(&written.scene), k);
    }
}

/// Powers of ten round every vertex, shared ones alike: no seam opens.
#[test]
fn h71_powers_of_ten() {
    let triangles = triangles_of(&golden::scene("grid_exact").scene);
    for k in -43..=36 {
        let factor = 10.0_f64.powi(k);
        let rounded: Vec<Triangle> = triangles
            .iter()
            .map(|t| t.map(|v| v.map(|c| (f64::from(c) * factor) as f32)))
            .collect();
        let breadth = Breadth { audited_pixels: 12, ..NARROW };
        let buffer = agreed_within(&standard_scene(&rounded), &breadth, &format!("10^{k}"));
        assert_covered_once(&buffer);
        // All but what rounding moves across the frame's border.
        assert!(buffer.covered_pixels() >= 256, "10^{k}: {}", buffer.covered_pixels());
    }
}

#[test]
fn h72_exact_translation() {
    let still = golden::scene("grid_exact");
    let moved = golden::scene("grid_exact_translated_2^22");
    let reference = agreed(&still.scene);
    assert_scaled(&reference, &agreed(&moved.scene), 0);
    // And of a scene in the small integers, by other powers, towards other sides.
    let triangles = triangles_of(&golden::scene("coplanar_tilted").scene);
    let reference = agreed(&standard_scene(&triangles));
    for shift in [[65536.0, -65536.0, 0.0], [-1048576.0, 2097152.0, 524288.0_f32]] {
        let shifted: Vec<Triangle> =
            triangles.iter().map(|t| t.map(|v| std::array::from_fn(|k| v[k] + shift[k]))).collect();
        let base = standard_camera(8.0);
        let eye = shift.map(f64::from);
        let camera =
            PinholeCamera::exact(base.resolution(), eye, base.d0(), base.dx(), base.dy()).unwrap();
        assert_scaled(&reference, &agreed(&Scene::from_triangles(camera, &shifted)), 0);
    }
}

/// A unit triangle at 10⁸ and 10⁹ is a point after rounding, and a point is not seen; at 10⁷,
/// where a step is 1, it is all there.
#[test]
fn h73_lossy_translation() {
    for (shift, is_seen) in [(1e7, true), (1e8, false), (1e9, false)] {
        let corner = |x: f64, y: f64| [x + shift, y + shift, shift].map(|c| c as f32);
        let triangle = [corner(0.0, 0.0), corner(1.0, 0.0), corner(0.0, 1.0)];
        let eye = [shift + 0.25, shift + 0.25, shift - 5.0];
        let camera = single_ray(eye, [0.0, 0.0, 1.0]);
        let buffer = agreed(&Scene::from_triangles(camera, &[triangle]));
        assert_eq!(ids(&buffer), [is_seen.then_some(0)], "{shift:e}");
        if let Some(visible) = buffer.visible[0] {
            assert!(visible.t_lo <= 5.0 && 5.0 <= visible.t_hi, "{visible:?}");
            assert!(!visible.tie);
        }
    }
}

/// A floor 10⁸ wide, level and tilted.
#[test]
fn h74_huge_floor() {
    let level = golden::scene("huge_floor_1e8");
    let buffer = agreed(&level.scene);
    assert_eq!(ids(&buffer), level.ids);
    assert_eq!(buffer.covered_pixels(), 136);
    assert_covered_once(&buffer);
    let far = 1e8_f32;
    // y = z/4 + 2 at the corners, as f32 rounds it; whatever they are, the halves share an edge.
    let corner = |x: f32, z: f32| [x, z * 0.25 + 2.0, z];
    let tilted = [
        [corner(-far, -far), corner(far, -far), corner(far, far)],
        [corner(-far, -far), corner(far, far), corner(-far, far)],
    ];
    let buffer = agreed(&standard_scene(&tilted));
    assert_covered_once(&buffer);
    assert!(buffer.covered_pixels() > 60, "{}", buffer.covered_pixels());
}

#[test]
fn h75_dust_before_a_planet() {
    let golden = golden::scene("tiny_in_front_of_huge");
    let buffer = agreed(&golden.scene);
    assert_eq!(ids(&buffer), golden.ids);
    assert_eq!(buffer.covered_pixels(), 166);
}

/// Weights of a triangle of 10⁻³ at a distance of 10³ against exact ones, relative to 10⁻⁹ and
/// far beyond: `agreed` itself holds them to 2^-46.
#[test]
fn h76_tiny_far() {
    let corner = [100.0, 200.0, 1000.0_f32];
    let triangle = [
        corner,
        [corner[0] + 1e-3, corner[1], corner[2]],
        [corner[0], corner[1] + 1e-3, corner[2]],
    ];
    let mut interior = 0;
    for number in 0..100 {
        let [u, v] = [number % 10, number / 10].map(|n| f64::from(n) * 1e-4 + 0.5e-4);
        // Directions on multiples of 2^-43, so that a camera of size 1 keeps them; the targets lie
        // between the steps of f32.
        let on = |c: f64| (c * 2.0_f64.powi(43)).round() * 2.0_f64.powi(-43);
        let direction = [on((100.0 + u) / 1024.0), on((200.0 + v) / 1024.0), 1000.0 / 1024.0];
        let scene = Scene::from_triangles(single_ray([0.0; 3], direction), &[triangle]);
        let buffer = agreed(&scene);
        let Some(visible) = buffer.visible[0] else { continue };
        let exact = Arbiter::new(&scene).answer(Pixel { x: 0, y: 0 }).visible.unwrap();
        for (weight, truth) in visible.barycentric.0.iter().zip(exact.barycentric.0) {
            assert!((weight - truth).abs() <= 1e-9 * truth, "{weight} {truth}");
        }
        interior += 1;
    }
    assert!((40..=60).contains(&interior), "half of the square: {interior}");
}

/// The least numbers: coordinates of ±4 steps of 2^-149 and of the smallest normal numbers.
#[test]
fn h77_denormals() {
    for name in ["topleft_both", "grid_exact"] {
        let golden = golden::scene(name);
        let triangles = triangles_of(&golden.scene);
        let reference = agreed(&golden.scene);
        for k in [-149, -148, -140, -130, -126] {
            let small = times_power_of_two(&triangles, k);
            let back = times_power_of_two(&small, -k);
            assert_eq!(back, triangles, "nothing is rounded at 2^{k}");
            assert_scaled(&reference, &agreed(&standard_scene(&small)), k);
        }
    }
}

/// The largest triangle that a scene may have: f32::MAX/4 and its neighbour 2^126.
#[test]
fn h78_largest() {
    for largest in [f32::MAX / 4.0, 2.0_f32.powi(126)] {
        let m = largest;
        let triangles = [
            [[-m, -m, m], [m, -m, m], [-m, m, m]],
            [[m, -m, m], [m, m, m], [-m, m, m]],
            [[-m, -m, -m], [m, -m, -m], [0.0, m, m / 2.0]],
        ];
        for f in [8.0, 1.0, 64.0] {
            let scene = Scene::from_triangles(standard_camera(f), &triangles);
            let buffer = agreed(&scene);
            assert!(buffer.covered_pixels() > 3, "{f}: {}", buffer.covered_pixels());
        }
        // From an eye at the other end of the range: differences of 2^127.
        let base = standard_camera(8.0);
        let eye = [f64::from(m), -f64::from(m), -f64::from(m)];
        let camera =
            PinholeCamera::exact(base.resolution(), eye, base.d0(), base.dx(), base.dy()).unwrap();
        agreed(&Scene::from_triangles(camera, &triangles));
    }
}

/// Angles of view of 0.001° and 179°: no sample's direction is rounded, in any order of the sum.
#[test]
fn h79_extreme_fov() {
    let ball = crate::support::closed::sphere(12, 24, 2.0, [0.5, 0.25, 0.0]);
    let floor = rectangle([-1e8, -1e8], [1e8, 1e8], 3.0);
    for fov in [0.001, 0.5, 120.0, 179.0, 179.999] {
        let resolution = Resolution::new(33, 17).unwrap();
        let camera = PinholeCamera::look_at(
            resolution,
            [0.1, -9.0, -20.0],
            [0.5, 0.25, 0.0],
            [0.0, 1.0, 0.0],
            fov,
        )
        .unwrap();
        for pixel in resolution.window().pixels() {
            let [x, y] = pixel.sample();
            for k in 0..3 {
                let [d0, dx, dy] = [camera.d0()[k], camera.dx()[k], camera.dy()[k]];
                let exact = rational(d0) + rational(x) * rational(dx) + rational(y) * rational(dy);
                for sum in [(d0 + x * dx) + y * dy, (d0 + y * dy) + x * dx, d0 + (x * dx + y * dy)]
                {
                    assert_eq!(rational(sum), exact, "{fov}° at {pixel:?}");
                }
            }
        }
        let mut triangles = ball.clone();
        triangles.extend(floor);
        let scene = Scene::from_triangles(camera, &triangles);
        let breadth = Breadth { audited_pixels: 100, ..FULL };
        let buffer = agreed_within(&scene, &breadth, &format!("{fov}°"));
        assert!(buffer.covered_pixels() > 100, "{fov}°: {}", buffer.covered_pixels());
    }
}

fn rational(value: f64) -> RBig {
    RBig::try_from(value).unwrap()
}

/// 10⁴ triangles with every coordinate ±2^U(−100, 100).
#[test]
fn h7a_mixed() {
    let mut random = Random(0x7a);
    let mut coordinate = || {
        let sign = if random.below(2) == 0 { 1.0 } else { -1.0 };
        (sign * 2.0_f64.powf(200.0 * random.unit() - 100.0)) as f32
    };
    let triangles: Vec<Triangle> =
        (0..10_000).map(|_| [0; 3].map(|_| [0; 3].map(|_| coordinate()))).collect();
    let configurations = if sizes::is_full() { FULL } else { NARROW };
    let breadth = Breadth { audited_pixels: sizes::H7A.running(), ..configurations };
    let buffer = agreed_within(&standard_scene(&triangles), &breadth, "mixed");
    assert!(buffer.covered_pixels() > 200, "{}", buffer.covered_pixels());
    assert!((0..289).any(|index| cover(&buffer, index).crossed > 100));
    // Unit scales of the same mixture through another direction: the exponents' signs mirrored.
    let mirrored = scaled(&triangles, -1.0);
    agreed_within(&standard_scene(&mirrored[..300]), &FULL_BUT_SLOW, "mirrored");
}

/// Everything, with few audits of a scene in which each costs a thousand exact candidates.
const FULL_BUT_SLOW: Breadth =
    Breadth { presets: &BuildPreset::ALL, linear: true, tile_sides: &[32], audited_pixels: 16 };
