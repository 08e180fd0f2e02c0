//! The interval test that spares the arbiter most triangles must never change an answer.

use crate::support::closed::integer_chaos;
use crate::support::golden;
use crate::support::scenes::{Triangle, fan, rectangle, scaled_camera, single_ray_camera};
use truecast::exact::Arbiter;
use truecast::mesh::TriangleId;
use truecast::pixel::Pixel;
use truecast::scene::Scene;

/// Answers with and without the interval test, at every `step`-th pixel.
fn assert_same(name: &str, scene: &Scene, step: usize) {
    let arbiter = Arbiter::new(scene);
    let all: Vec<TriangleId> = scene.mesh.ids().collect();
    for pixel in scene.camera.resolution().window().pixels().step_by(step) {
        assert_eq!(arbiter.answer(pixel), arbiter.answer_among(&all, pixel), "{name} {pixel:?}");
    }
}

#[test]
fn the_interval_test_changes_no_answer_of_the_golden_scenes() {
    for golden in golden::scenes() {
        assert_same(&golden.name, &golden.scene, 1);
    }
}

#[test]
fn nor_of_scenes_full_of_ties_at_any_scale() {
    let mut needles = fan(300);
    needles.extend(rectangle([-3.0, -3.0], [5.0, 5.0], 8.0));
    let shapes: [(&str, Vec<Triangle>); 3] =
        [("chaos", integer_chaos(7)), ("chaos", integer_chaos(8)), ("needles", needles)];
    for (name, triangles) in shapes {
        for power in [-140, -70, 0, 70, 120] {
            // Two steps, because 2^-140 alone is no normal f32.
            let (half, rest) = (2.0_f32.powi(power / 2), 2.0_f32.powi(power - power / 2));
            let triangles: Vec<Triangle> =
                triangles.iter().map(|t| t.map(|v| v.map(|c| c * half * rest))).collect();
            for camera_power in [-300, 295] {
                let camera = scaled_camera(8.0, 2.0_f64.powi(camera_power));
                assert_same(name, &Scene::from_triangles(camera, &triangles), 7);
            }
        }
    }
}

/// Thin triangles whose long edges pass one float beside a sample: intervals cannot tell.
#[test]
fn nor_where_edges_pass_one_float_beside_samples() {
    let mut triangles = Vec::new();
    for k in 0..17_u8 {
        let x = f32::from(k) - 8.0;
        for x in [x.next_down(), x, x.next_up()] {
            triangles.push([[x, -9.0, 8.0], [x + 1e-3, 9.0, 8.0], [x, 9.0, 8.0]]);
            triangles.push([[-9.0, x, 8.0], [9.0, x, 8.0], [9.0, x + 1e-3, 16.0]]);
        }
    }
    assert_same("edges", &Scene::from_triangles(scaled_camera(8.0, 1.0), &triangles), 3);
}

/// Triangles with a corner exactly on the ray: two of their three determinants are exactly 0, but
/// every product and sum on the way to them rounds. Each decides by the sign of noise unless the
/// intervals are kept wide.
#[test]
fn nor_where_rays_pass_exactly_through_corners() {
    let mut state = 1_u64;
    // 24 random bits in [½, 1), then a random sign and a random power of two down to `smallest`.
    let mut number = |smallest: i32| {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let bits = (state >> 41) as f32 / (1_u32 << 24) as f32 + 0.5;
        let power = (state >> 33 & 0xff) as i32 % (smallest - 1);
        let sign = if state >> 40 & 1 == 0 { 1.0 } else { -1.0 };
        bits * sign * 2.0_f32.powi(-power.abs())
    };
    let (mut covering, mut touching) = (0, 0);
    for round in 0..40 {
        let hub = [number(0).abs(), number(0).abs(), number(0).abs()];
        let direction = [number(0), number(0), number(0)].map(f64::from);
        // The ray reaches the hub at t = 1/8; both terms are multiples of 2^-27, so e is exact.
        let eye = match round % 2 {
            0 => [0, 1, 2].map(|k| f64::from(hub[k]) - direction[k] / 8.0),
            _ => [0.0; 3],
        };
        let direction = if round % 2 == 0 { direction } else { hub.map(f64::from) };
        let triangles: Vec<Triangle> = (0..30)
            .map(|_| [hub, [0; 3].map(|_| number(-60)), [0; 3].map(|_| number(-60))])
            .collect();
        let scene = Scene::from_triangles(single_ray_camera(eye, direction), &triangles);
        assert_same(&format!("round {round}"), &scene, 1);
        let arbiter = Arbiter::new(&scene);
        let candidates = arbiter.candidates(Pixel { x: 0, y: 0 });
        touching += candidates.iter().filter(|c| c.edge_signs == [1, 0, 0]).count();
        covering += candidates.iter().filter(|c| c.covers).count();
    }
    assert!(touching > 400, "half of 1200 triangles or so touch the ray: {touching}");
    assert!(covering > 100, "and half of these or so cover it: {covering}");
}
