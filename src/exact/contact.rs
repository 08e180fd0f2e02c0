//! One triangle at one sample, in rationals: the definition, written down.
//!
//! With a_i = v_i − e: c_0 = a_1 × a_2 and cyclic, W_i = c_i·d, V = a_0·c_0, n = c_0 + c_1 + c_2,
//! D = n·d = W_0 + W_1 + W_2. By Cramer's rule Σ W_i a_i = V d, so the ray meets the triangle at
//! t = V/D with corner weights W_i/D. All of them are kept multiplied by sgn V, so that inside
//! means positive.

use super::rational::{
    Vector, add, bounds_f64, cross, dot, exact, exact_vector, nearest_f64, scale, sign, subtract,
};
use crate::mesh::{Barycentric, TriangleId, TriangleMesh};
use crate::mutant::{self, Mutant};
use crate::scene::camera::PinholeCamera;
use crate::visibility::Facing;
use dashu_ratio::Relaxed;
use std::cmp::Ordering;

/// A sample's ray and the two directions in which the tie rule moves the sample.
pub(super) struct Ray {
    eye: Vector,
    direction: Vector,
    dx: Vector,
    dy: Vector,
}

impl Ray {
    /// The ray through the point (x, y) of the image plane, in pixels: d = D0 + x·DX + y·DY.
    pub(super) fn through(camera: &PinholeCamera, [x, y]: [f64; 2]) -> Self {
        let (dx, dy) = (exact_vector(camera.dx()), exact_vector(camera.dy()));
        let in_row = add(&exact_vector(camera.d0()), &scale(&dx, &exact(x)));
        let direction = add(&in_row, &scale(&dy, &exact(y)));
        Self { eye: exact_vector(camera.eye()), direction, dx, dy }
    }

    /// The direction in f64, if it has no rounding there (which the lattice promises).
    pub(super) fn direction_f64(&self) -> Option<[f64; 3]> {
        let rounded = [0, 1, 2].map(|k| nearest_f64(&self.direction[k]));
        let is_exact = rounded.iter().all(|c| c.is_finite())
            && exact_vector(rounded).iter().eq(self.direction.iter());
        is_exact.then_some(rounded)
    }

    /// e.
    pub(super) fn eye(&self) -> &Vector {
        &self.eye
    }

    /// d.
    pub(super) fn direction(&self) -> &Vector {
        &self.direction
    }

    /// sgn*(c·d): the sign with the sample moved by (+ε, +ε²), the first that is not 0 of c·d,
    /// c·DX and c·DY.
    pub(super) fn moved_sign(&self, c: &Vector) -> i8 {
        mutant::moves([&self.direction, &self.dx, &self.dy])
            .into_iter()
            .map(|direction| sign(&dot(c, direction)))
            .find(|&sign| sign != 0)
            .unwrap_or(0)
    }
}

/// A triangle that covers a sample, or has the sample on its boundary.
pub(super) struct Contact {
    pub(super) triangle: TriangleId,
    pub(super) facing: Facing,
    /// sgn W_i · sgn V: 1 or 0.
    pub(super) edge_signs: [i8; 3],
    /// sgn*(W_i) · sgn V.
    pub(super) moved_signs: [i8; 3],
    /// sgn V · c_i.
    planes: [Vector; 3],
    /// |V|.
    volume: Relaxed,
    /// sgn V · n.
    normal: Vector,
    /// sgn V · W_i; at least one is positive, because V·d ≠ 0.
    weights: [Relaxed; 3],
    /// sgn V · D, positive.
    divisor: Relaxed,
}

impl Contact {
    /// `None` when V = 0 or the sample is outside.
    pub(super) fn at(ray: &Ray, mesh: &TriangleMesh, triangle: TriangleId) -> Option<Self> {
        // Move the corners into the eye and span the edge planes.
        let corners = mesh.triangle(triangle).map(|v| exact_vector(v.map(f64::from)));
        let a = corners.map(|v| subtract(&v, &ray.eye));
        let planes = [cross(&a[1], &a[2]), cross(&a[2], &a[0]), cross(&a[0], &a[1])];
        // Turn everything so that the volume is positive.
        let volume = dot(&a[0], &planes[0]);
        let (facing, volume, planes) = match sign(&volume) {
            0 if !mutant::is(Mutant::VolumeZeroHits) => return None,
            1 => (Facing::Back, volume, planes),
            _ => (Facing::Front, -volume, planes.map(|plane| plane.map(|c| -c))),
        };
        if mutant::is(Mutant::DeterminantEpsilon) && volume < exact(1e-6) {
            return None;
        }
        // Hold the sample against the three edges.
        let weights = planes.each_ref().map(|plane| dot(plane, &ray.direction));
        let edge_signs = weights.each_ref().map(sign);
        if edge_signs.contains(&-1) {
            return None;
        }
        let moved_signs = planes.each_ref().map(|plane| ray.moved_sign(plane));
        let normal = add(&add(&planes[0], &planes[1]), &planes[2]);
        let divisor = &weights[0] + &weights[1] + &weights[2];
        Some(Self {
            triangle,
            facing,
            edge_signs,
            moved_signs,
            planes,
            volume,
            normal,
            weights,
            divisor,
        })
    }

    /// Whether the triangle covers the sample: the moved sample is inside all three edges.
    pub(super) fn covers(&self) -> bool {
        if mutant::is(Mutant::ExclusiveEdges) && self.edge_signs.contains(&0) {
            return false;
        }
        self.moved_signs == [1; 3] || mutant::is(Mutant::InclusiveEdges)
    }

    /// Which of two is nearer: by V_A·(n_B·d) − V_B·(n_A·d), which has the sign of t_A − t_B, at
    /// the moved sample; in one plane the lower id.
    pub(super) fn order(&self, other: &Self, ray: &Ray) -> Ordering {
        let difference =
            subtract(&scale(&other.normal, &self.volume), &scale(&self.normal, &other.volume));
        let by_id = match mutant::is(Mutant::LastIdInPlane) {
            true => other.triangle.cmp(&self.triangle),
            false => self.triangle.cmp(&other.triangle),
        };
        if mutant::is(Mutant::LowestIdFirst) && self.is_as_deep_as(other) {
            return by_id;
        }
        ray.moved_sign(&difference).cmp(&0).then(by_id)
    }

    /// For each edge through the sample, the derivative of sgn V · W_i to the right and down: which
    /// moves go inside. Never (0, 0), which would take c_i = 0 and V = 0.
    pub(super) fn boundary(&self, ray: &Ray) -> Vec<[Relaxed; 2]> {
        (0..3)
            .filter(|&i| self.edge_signs[i] == 0)
            .map(|i| [dot(&self.planes[i], &ray.dx), dot(&self.planes[i], &ray.dy)])
            .collect()
    }

    /// Which t is smaller at the sample itself.
    pub(super) fn depth_order(&self, other: &Self) -> Ordering {
        (&self.volume * &other.divisor).cmp(&(&other.volume * &self.divisor))
    }

    /// Whether t is exactly the same.
    pub(super) fn is_as_deep_as(&self, other: &Self) -> bool {
        &self.volume * &other.divisor == &other.volume * &self.divisor
    }

    /// The neighbouring floats around t = V/D; equal when t is a float. For vertices below 2^126
    /// and lattices within 2^±300, 2^-1022 < t < 2^1023.
    pub(super) fn t_bounds(&self) -> (f64, f64) {
        bounds_f64(&(&self.volume / &self.divisor))
    }

    /// W_i/D, each rounded once.
    pub(super) fn barycentric(&self) -> Barycentric {
        Barycentric(
            mutant::shifted(self.weights.each_ref())
                .map(|weight| nearest_f64(&(weight / &self.divisor))),
        )
    }
}
