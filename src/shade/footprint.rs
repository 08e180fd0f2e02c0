//! How far texture coordinates move from one pixel to the next, on the visible triangle's plane.
//!
//! The ray of the image point (x, y) meets the plane n·(p − v0) = 0 of the triangle at
//! p = e + t·d, t = n·(v0 − e)/(n·d), with d(x, y) linear in x and y. By the quotient rule
//!
//! ```text
//! ∂p/∂x = t·(DX − d·(n·DX)/(n·d))
//! ```
//!
//! which lies in the plane, and the weight of the corner i is linear in p with the gradient
//! n × (v_k − v_j)/|n|². So ∂uv/∂x = Σ uv_i·(∂b_i/∂x), exactly, without a second sample. It is the
//! derivative of Σ W_i·uv_i / Σ W_i, W_i = det(a_j, a_k, d), in a form that keeps its digits where a
//! triangle is much larger than its distance.

use super::vector;
use crate::pixel::Pixel;
use crate::scene::Scene;
use crate::visibility::Visible;

/// Derivatives of texture coordinates by the image point. Never NaN; what is beyond the range, as
/// on a triangle that is edge-on, ends at ±f64::MAX.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Footprint {
    /// ∂(u, v)/∂x: change per pixel to the right.
    pub per_column: [f64; 2],
    /// ∂(u, v)/∂y: change per pixel downwards.
    pub per_row: [f64; 2],
}

/// The footprint of a visible pixel, or `None` where its triangle lacks texture coordinates.
pub fn footprint(scene: &Scene, pixel: Pixel, visible: &Visible) -> Option<Footprint> {
    let uvs = scene.mesh.uvs_of(visible.triangle)?;
    let corners = scene.mesh.triangle(visible.triangle).map(|v| v.map(f64::from));
    let camera = &scene.camera;
    let [x, y] = pixel.sample();
    let (d0, dx, dy) = (camera.d0(), camera.dx(), camera.dy());
    let ray = std::array::from_fn(|k| d0[k] + x * dx[k] + y * dy[k]);
    let plane = Plane::of(corners, uvs);
    let per_step = |step| plane.uv_change(plane.point_change(ray, visible.t(), step));
    Some(Footprint { per_column: per_step(dx), per_row: per_step(dy) })
}

/// A triangle's plane with texture coordinates on it.
struct Plane {
    /// (v1 − v0) × (v2 − v0): from 2^-298 to 2^256, so no product below leaves the range.
    normal: [f64; 3],
    /// Gradients of u and v by the point, times |normal|².
    gradients: [[f64; 3]; 2],
}

impl Plane {
    fn of([v0, v1, v2]: [[f64; 3]; 3], uvs: [[f64; 2]; 3]) -> Self {
        let (e1, e2) = (vector::sub(v1, v0), vector::sub(v2, v0));
        let normal = cross(e1, e2);
        // With e1 and e2 from corner 0, b1 has the gradient e2 × n and b2 the gradient n × e1,
        // both over |n|²; b0 is what is left, so only differences of uv matter.
        let (along1, along2) = (cross(e2, normal), cross(normal, e1));
        let gradients = std::array::from_fn(|k| {
            let (uv1, uv2) = (uvs[1][k] - uvs[0][k], uvs[2][k] - uvs[0][k]);
            vector::add(vector::scaled(along1, uv1), vector::scaled(along2, uv2))
        });
        Self { normal, gradients }
    }

    /// How the plane's point moves when the ray's direction moves by `step`.
    fn point_change(&self, ray: [f64; 3], t: f64, step: [f64; 3]) -> [f64; 3] {
        let along_ray = vector::dot(self.normal, step) / vector::dot(self.normal, ray);
        std::array::from_fn(|k| t * (step[k] - ray[k] * along_ray))
    }

    /// How texture coordinates move when the point does.
    fn uv_change(&self, point_change: [f64; 3]) -> [f64; 2] {
        let squared = vector::squared_length(self.normal);
        self.gradients.map(|gradient| bounded(vector::dot(gradient, point_change) / squared))
    }
}

/// A change beyond the range, or one that is not defined, is the largest.
fn bounded(change: f64) -> f64 {
    if change.is_nan() { f64::MAX } else { change.clamp(f64::MIN, f64::MAX) }
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_edge_on_plane_has_the_largest_footprint() {
        let corners = [[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 0.0, 2.0]];
        let plane = Plane::of(corners, [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]);
        // A ray inside the plane: its n·d is 0.
        let change = plane.point_change([0.0, 0.0, 1.0], 1.0, [0.0, 1.0, 0.0]);
        let [du, dv] = plane.uv_change(change);
        assert!(du == f64::MAX && dv.abs() == f64::MAX, "{du} {dv}");
        // A triangle without area.
        let plane = Plane::of([[0.0; 3], [1.0; 3], [2.0; 3]], [[0.0; 2]; 3]);
        assert_eq!(plane.uv_change([1.0; 3]), [f64::MAX; 2]);
    }

    #[test]
    fn tiny_and_huge_triangles_stay_in_range() {
        for size in [2.0_f64.powi(-149), 1.0, 2.0_f64.powi(126)] {
            let corners = [[0.0, 0.0, size], [size, 0.0, size], [0.0, size, size]];
            let plane = Plane::of(corners, [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]);
            // Straight ahead: a step of the ray by 1 moves the point by the size.
            let change = plane.point_change([0.0, 0.0, 1.0], size, [1.0, 0.0, 0.0]);
            assert_eq!(plane.uv_change(change), [1.0, 0.0], "{size:e}");
        }
    }
}
