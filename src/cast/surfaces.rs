//! From ids to surfaces in plain f64, believed as they are: for answers without proof, which may name
//! a triangle that does not cover the sample at all.

use super::ray::View;
use crate::mesh::{Barycentric, TriangleId};
use crate::scene::Scene;
use crate::visibility::{Facing, Level, NearestBuffer, VisibilityBuffer, Visible};
use rayon::prelude::*;

/// The surfaces of a buffer's triangles at its pixels: weights and t of the triangle's plane there,
/// weights cut off at 0 where the sample lies outside. A triangle whose plane the ray does not meet
/// in front of the eye is taken for nothing. Ties are not known and say no; `level` is what is said of
/// the ids' arithmetic.
pub fn surfaces(scene: &Scene, nearest: &NearestBuffer, level: Level) -> VisibilityBuffer {
    let view = View::new(&scene.camera);
    let window = nearest.window;
    let visible = (0..window.len()).into_par_iter().map(|index| {
        let id = nearest.ids[index];
        (id != u32::MAX).then(|| TriangleId::new(id)).and_then(|id| {
            let ray = view.ray(window.pixel(index));
            let d = ray.direction();
            let vertices = scene.mesh.triangle(id);
            let a = vertices
                .map(|v| -> [f64; 3] { std::array::from_fn(|k| f64::from(v[k]) - ray.eye[k]) });
            let w: [f64; 3] =
                std::array::from_fn(|i| dot(cross(a[(i + 1) % 3], a[(i + 2) % 3]), d));
            let plane = dot(a[0], cross(a[1], a[2]));
            let sum = (w[0] + w[1]) + w[2];
            let t = view.camera_t(plane / sum);
            let weights = w.map(|w| if w / sum > 0.0 { w / sum } else { 0.0 });
            let total = (weights[0] + weights[1]) + weights[2];
            let is_there = t > 0.0 && t.is_finite() && total > 0.0 && total.is_finite();
            is_there.then(|| Visible {
                triangle: id,
                facing: if plane < 0.0 { Facing::Front } else { Facing::Back },
                level,
                tie: false,
                barycentric: Barycentric(weights.map(|weight| weight / total)),
                t_lo: t,
                t_hi: t,
            })
        })
    });
    let visible = visible.collect();
    VisibilityBuffer { window, visible, cover: None, levels: nearest.levels }
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2]
}
