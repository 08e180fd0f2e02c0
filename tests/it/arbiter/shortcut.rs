//! The interval test that spares the arbiter most triangles must never change an answer.

use crate::support::golden;
use crate::support::scenes::{Triangle, fan, integer_chaos, rectangle, scaled_camera};
use truecast::exact::Arbiter;
use truecast::mesh::TriangleId;
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
