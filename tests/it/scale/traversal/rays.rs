//! H50 to H54, H56 and H57: rays that slip between boxes, or past them.

use crate::scale::{cover, ids};
use crate::support::closed::sphere;
use crate::support::configurations::{Breadth, NARROW, agreed, agreed_within, assert_same};
use crate::support::golden;
use crate::support::rays::{Random, on_lattice};
use crate::support::scenes::{Triangle, rectangle, scaled_camera, single_ray, standard_camera};
use crate::support::sizes;
use truecast::accel::{Accelerator, BuildPreset};
use truecast::cast::cast;
use truecast::pixel::Resolution;
use truecast::raster::rasterize;
use truecast::scene::Scene;
use truecast::visibility::Counting;

/// Quads seen by one ray from (0, ¼, 0), with enough bystanders for a tree.
fn quads_and_ray(quads: &[[Triangle; 2]], direction: [f64; 3]) -> Scene {
    let mut triangles = quads.concat();
    for k in 0..40 {
        let away = 100.0 + 3.0 * k as f32;
        triangles.extend(rectangle([away; 2], [away + 1.0, away + 2.0], 70.0 + away));
    }
    Scene::from_triangles(single_ray([0.0, 0.25, 0.0], direction), &triangles)
}

/// A ray in the plane of a box's face. Four layouts: the quad to the left of the ray or to its
/// right, and +0 or −0 in the direction. x = 0 is the right edge of the left quad, which is
/// exclusive, and the left edge of the right quad, which is not. That the box is met in all four
/// is the accelerator's own test of the same number.
#[test]
fn h50_box_face_ray() {
    let left =
        [rectangle([-1.0, -1.0], [0.0, 1.0], 5.0), rectangle([-9.0, -1.0], [-8.0, 1.0], 50.0)];
    let right = [rectangle([0.0, -1.0], [1.0, 1.0], 5.0), rectangle([8.0, -1.0], [9.0, 1.0], 50.0)];
    for direction in [[0.0, 0.0, 1.0], [-0.0, 0.0, 1.0], [-0.0, -0.0, 1.0], [0.0, -0.0, 1.0]] {
        let none = agreed(&quads_and_ray(&left, direction));
        assert_eq!((none.visible[0], cover(&none, 0).crossed), (None, 0));
        let some = agreed(&quads_and_ray(&right, direction));
        let visible = some.visible[0].expect("the left edge is inclusive");
        assert_eq!((visible.tie, cover(&some, 0).crossed), (true, 1));
        assert!(visible.t_lo <= 5.0 && 5.0 <= visible.t_hi);
    }
}

const MICRO: f32 = 1e-6;

/// Two quads whose common edge passes 10⁻⁶ beside the ray, at depth 50.
fn quads_beside_the_axis() -> [[Triangle; 2]; 2] {
    [rectangle([-1.0, -1.0], [MICRO, 1.0], 50.0), rectangle([MICRO, -1.0], [1.0, 1.0], 50.0)]
}

#[test]
fn h51_clamped_reciprocal() {
    let buffer = agreed(&quads_and_ray(&quads_beside_the_axis(), [0.0, 0.0, 1.0]));
    assert!(ids(&buffer)[0].is_some_and(|id| id < 2), "the left quad");
}

#[test]
fn h52_clamped_reciprocal_of_a_tiny_component() {
    // The edge is at x = 10⁻⁶, the ray at 50·10⁻⁹ there; with 10⁻⁷ it is at 5·10⁻⁶, beyond it.
    for (x, is_left) in [(1e-9, true), (-1e-9, true), (1e-7, false)] {
        let direction = [on_lattice(x), 0.0, 1.0];
        let buffer = agreed(&quads_and_ray(&quads_beside_the_axis(), direction));
        assert_eq!(ids(&buffer)[0].map(|id| id < 2), Some(is_left), "x = {x:e}");
    }
}

/// The camera's own scale changes t and nothing else.
#[test]
fn h53_short_and_long_d() {
    for name in ["grid_exact", "interpenetrating_2^-20", "fan64"] {
        let mut scene = golden::scene(name).scene;
        let reference = agreed(&scene);
        // 2^-27 is the |d| = 10⁻⁸ and 2^20 the 10⁶ at which others render nothing.
        for k in [-290, -27, 20, 290] {
            let factor = 2.0_f64.powi(k);
            scene.camera = scaled_camera(8.0, factor);
            let buffer = agreed(&scene);
            assert_eq!(ids(&reference), ids(&buffer), "{name}, 2^{k}");
            assert_eq!(reference.cover, buffer.cover, "{name}, 2^{k}");
            for (a, b) in reference.visible.iter().flatten().zip(buffer.visible.iter().flatten()) {
                assert_eq!(a.barycentric, b.barycentric, "{name}, 2^{k}");
                assert_eq!((a.t_lo / factor, a.t_hi / factor), (b.t_lo, b.t_hi), "{name}, 2^{k}");
            }
        }
    }
}

/// 10³ quads, each in a plane x = k/2 of its own: boxes without thickness.
#[test]
fn h54_flat_boxes() {
    let quads: Vec<Triangle> = (0..1000)
        .flat_map(|k| {
            let x = k as f32 * 0.5;
            let corner = |y: f32, z: f32| [x, y, z];
            [
                [corner(-1.0, 4.0), corner(1.0, 4.0), corner(1.0, 6.0)],
                [corner(-1.0, 4.0), corner(1.0, 6.0), corner(-1.0, 6.0)],
            ]
        })
        .collect();
    // In the plane of quad 0: edge-on, never visible.
    let ahead = single_ray([0.0, 0.25, 0.0], [0.0, 0.0, 1.0]);
    let mut scene = Scene::from_triangles(ahead, &quads);
    assert_eq!(ids(&agreed(&scene)), [None]);
    // From 5 leans to its left, leaning to it: plane 0 is crossed at t = 5. The least lean that
    // the lattice of a camera of size 1 holds is 2^-52 or so; 2^-149 is not a direction.
    for lean in [2.0_f64.powi(-42), 2.0_f64.powi(-48)] {
        scene.camera = single_ray([-5.0 * lean, 0.25, 0.0], [lean, 0.0, 1.0]);
        let buffer = agreed(&scene);
        assert!(ids(&buffer)[0].is_some_and(|id| id < 2));
        assert_eq!(cover(&buffer, 0).crossed, 1);
        let visible = buffer.visible[0].unwrap();
        assert!(visible.t_lo <= 5.0 && 5.0 <= visible.t_hi);
    }
}

/// Two triangles on either side of the segment x = `at[0]`, y = `at[1]`, z = −1…1, that meet the
/// ray nowhere else: one box ends in x and begins in y there, the other the other way round.
/// `lean` is the sign of d_x·d_y: the boxes lie in the quadrants that the ray does not visit.
fn leaves_of_an_edge(at: [f32; 2], lean: f32) -> [Triangle; 2] {
    let [x, y] = at;
    let (low, high) = ([x, y, -1.0], [x, y, 1.0]);
    [[low, high, [x - 1.0, y + lean, 0.25]], [high, low, [x + 1.0, y - lean, 0.25]]]
}

/// Rays exactly through an edge of two boxes: the computed near and far bounds cross by roundings
/// unless they are padded. Exactly one triangle owns the sample, so one of the boxes must be met.
#[test]
fn h56_two_ulp_padding() {
    let bystanders: Vec<Triangle> =
        (0..6).flat_map(|k| rectangle([50.0 + k as f32; 2], [60.0; 2], 40.0)).collect();
    let mut random = Random(56);
    let mut seen = 0;
    for number in 0..3000 {
        let eye = [0; 3].map(|_| random.step() - 0.5);
        let at = [0; 2].map(|_| (random.step() * 2.0 - 1.0) as f32);
        let to = [f64::from(at[0]) - eye[0], f64::from(at[1]) - eye[1]];
        if to.iter().any(|c| c.abs() < 0.01) {
            continue;
        }
        // An odd multiple, so that reciprocals are of all kinds; t at the edge is its inverse.
        let times = f64::from(2 * random.below(60) as u32 + 1);
        let rise = (random.step() - 0.5) * 0.25;
        let direction = [to[0] * times, to[1] * times, rise * times];
        let lean = if (to[0] < 0.0) == (to[1] < 0.0) { 1.0 } else { -1.0 };
        let mut triangles = leaves_of_an_edge(at, lean).to_vec();
        triangles.extend(&bystanders);
        let scene = Scene::from_triangles(single_ray(eye, direction), &triangles);
        let breadth = Breadth { presets: &[BuildPreset::Fastest], ..NARROW };
        let buffer = agreed_within(&scene, &breadth, &format!("ray {number}"));
        assert_eq!(cover(&buffer, 0).crossed, 1, "ray {number}");
        assert!(buffer.visible[0].unwrap().tie);
        seen += 1;
    }
    assert!(seen > 2500, "{seen} rays");
    // The measured slab that is lost with a padding of 2 ulp in f32: exactly t_near < t_far.
    // e and d as printed, with a triangle that reaches the ray between the two bounds only.
    let scaled = |digits: i32, power: i32| f64::from(digits) * 2.0_f64.powi(power);
    let eye = [scaled(-0x0016_a66c, -20), scaled(-0x0102_3876, -26), 0.0];
    let direction = [scaled(0x01fb_6b58, -24), scaled(0x0169_212e, -26), scaled(1, -10)];
    let (lo_x, hi_y) = (scaled(0x01af_ad2a, -34) as f32, scaled(0x01db_846c, -51) as f32);
    // In the box x ≥ lo_x, y ≤ hi_y, along the diagonal that the ray crosses in its corner.
    let slab = [[lo_x, hi_y, -1.0], [lo_x, hi_y, 1.0], [lo_x + 1.0, hi_y - 1.0, 0.0]];
    let mut triangles = vec![slab];
    triangles.extend(&bystanders);
    let buffer = agreed(&Scene::from_triangles(single_ray(eye, direction), &triangles));
    assert_eq!(ids(&buffer), [Some(0)]);
}

/// Rays from inside a sphere of 39 600 triangles at its vertices, through every kind of tree: no
/// hole, one crossing, the ids of the linear scan.
#[test]
fn h57_aimed_sphere() {
    let triangles = sphere(100, 200, 2.0, [0.0; 3]);
    let mut scene = Scene::from_triangles(standard_camera(8.0), &triangles);
    let window = Resolution::new(1, 1).unwrap().window();
    let trees = [BuildPreset::Fastest, BuildPreset::Medium]
        .map(|preset| Accelerator::build(&scene.mesh, preset));
    let linear = Accelerator::linear(&scene.mesh);
    let mut random = Random(57);
    for number in 0..sizes::H57.running() {
        let target = triangles[(number * 7919) % triangles.len()][number % 3].map(f64::from);
        let eye: [f64; 3] = std::array::from_fn(|_| random.step() - 0.5);
        let direction = std::array::from_fn(|k| f64::from((target[k] - eye[k]) as f32));
        scene.camera = single_ray(eye, direction);
        let ask = |tree: &Accelerator| cast(&scene, tree, window, Counting::All, &|| ());
        let answers = [ask(&trees[0]), ask(&trees[1])];
        assert_eq!(cover(&answers[0], 0).signed, 1, "ray {number}");
        assert!(answers[0].visible[0].is_some(), "ray {number}");
        assert_eq!(answers[0].cover, answers[1].cover, "ray {number}");
        assert_same(&answers[0], &answers[1], "trees");
        if number % 300 == 0 {
            assert_same(&answers[0], &ask(&linear), "the linear scan");
            let raster = rasterize(&scene, window, Counting::All, &|| ());
            assert_eq!((ids(&raster), &raster.cover), (ids(&answers[0]), &answers[0].cover));
        }
    }
}
