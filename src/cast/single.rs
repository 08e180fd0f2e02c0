//! The f32 filter: signs of the three W_i, where they are clear.
//!
//! It has half the operations of the f64 filter and half their width; in scalar code a covering
//! triangle pays for both, and that uses up what the others save.
//!
//! Axes are permuted cyclically so that d_z is the largest component, and space is sheared along
//! the ray: x = a_x − (d_x/d_z)·a_z, y likewise. The shear has determinant 1 and takes d to
//! (0, 0, d_z), so W_i = d_z·(x_j·y_k − y_j·x_k), without a rounding in this identity. (The shear
//! is that of S. Woop, C. Benthin, I. Wald, *Watertight Ray/Triangle Intersection*, 2013; they
//! take its rounded result for the geometry, here it is bounded.) No sign of V and no
//! depth here.
//!
//! Bound, u = 2^-24, hats for computed values. The eye is ê + ê' + r, two f32 and |r| ≤ u²|ê|.
//! - â = fl(fl(v − ê) − ê'): |â − a| ≤ 2u|â| + 2u²|ê|, as |ê'| ≤ u|ê| (terms in u³ see below).
//! - ŝ = d_x/d_z rounded to f64 and to f32: |ŝ| ≤ 1, relative error u; it is 0 or at least 2^-53.
//! - p̂ = fl(ŝ·â_z): |p̂| ≤ |â_z|, |p̂ − s·a_z| ≤ u|p̂| + 2^-150 + u|â_z| + |â_z − a_z|.
//! - x̂ = fl(â_x − p̂): u|x̂| more, and |â_x| ≤ |x̂| + |â_z| up to a rounding.
//!
//! With X = max(|x̂|, |ŷ|) and Z = max |â_z| over the corners, |x̂ − x| ≤ ε with
//! ε = u(3X + 6Z + 4u|ê|) + 2^-150 ≤ 6.01u·R for R = Z + X + u|ê| + 2^-48.
//! - ŵ = fl(m̂ − m̂'), two rounded products: the last rounding changes no sign, and
//!   |m̂ − m̂' − (x_j·y_k − y_j·x_k)| ≤ 2uX² + 2^-149 + 4Xε + 2ε²
//!   ≤ u·R·(2X + 24.04X + 72.3u·R) + 2^-149 < 27u·R·(X + 3u·R).
//!
//! The filter asks for |ŵ| > 28u·R·(X + 4u·R): 3 % pay for the bound's own seven roundings. 2^-48
//! in R pays for underflow: the bound is then at least 2^-136, and what underflows is at most
//! 2^-149. Where a product overflows, so does R·(X + 4u·R), as R ≥ X and rounding is monotone;
//! the bound is infinite then and nothing is certain. No value is NaN where the bound is finite.

use super::ray::Ray;
use crate::accel::LeafTriangle;

/// u = 2^-24.
const U: f32 = f32::EPSILON / 2.0;
/// The bound of |ŵ| over R·(X + 4u·R): see the module's derivation.
const EDGE: f32 = 28.0 * U;
/// In R: keeps the bound clear of underflow.
const LEAST_REACH: f32 = 1.0 / (1_u64 << 48) as f32;

/// A ray as the f32 filter wants it.
#[derive(Clone, Copy, Debug)]
pub(super) struct ShearedRay {
    /// Axes called x, y and z here.
    axes: [usize; 3],
    /// ê and ê', axes permuted.
    eye: [[f32; 2]; 3],
    /// d_x/d_z and d_y/d_z.
    slope: [f32; 2],
    /// sgn d_z.
    depth_sign: i8,
    /// The part of R that does not depend on the triangle.
    reach: f32,
}

/// What f32 knows of the three W_i.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Edges {
    /// Two have opposite signs: the triangle does not cover the sample.
    Apart,
    /// All have this sign, not 0.
    Agree(i8),
    /// Not certain.
    Open,
}

impl ShearedRay {
    #[inline(always)]
    pub(super) fn new(ray: &Ray) -> Self {
        let d = ray.direction();
        let mut z = if d[1].abs() > d[0].abs() { 1 } else { 0 };
        if d[2].abs() > d[z].abs() {
            z = 2;
        }
        let axes = [(z + 1) % 3, (z + 2) % 3, z];
        let largest_eye = largest(ray.eye.map(|c| c as f32));
        Self {
            axes,
            eye: axes.map(|k| {
                let high = ray.eye[k] as f32;
                [high, (ray.eye[k] - f64::from(high)) as f32]
            }),
            slope: [(d[axes[0]] / d[z]) as f32, (d[axes[1]] / d[z]) as f32],
            depth_sign: if d[z] < 0.0 { -1 } else { 1 },
            reach: U * largest_eye + LEAST_REACH,
        }
    }

    /// sgn d_z: the sign of W_i is this times that of w_i.
    #[cfg(test)]
    pub(super) fn depth_sign(&self) -> i8 {
        self.depth_sign
    }

    /// The three w = W_i/d_z and one bound for their signs.
    #[inline(always)]
    pub(super) fn edge_functions(&self, triangle: &LeafTriangle) -> ([f32; 3], f32) {
        let relative = |axis: usize| -> [f32; 3] {
            let [high, low] = self.eye[axis];
            triangle.vertices.map(|vertex| (vertex[self.axes[axis]] - high) - low)
        };
        let depth = relative(2);
        let sheared = |axis: usize| -> [f32; 3] {
            let a = relative(axis);
            std::array::from_fn(|i| a[i] - self.slope[axis] * depth[i])
        };
        let (x, y) = (sheared(0), sheared(1));
        let w = std::array::from_fn(|i| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            x[j] * y[k] - y[j] * x[k]
        });
        let width = larger(largest(x), largest(y));
        let reach = (largest(depth) + width) + self.reach;
        (w, (reach * (width + 4.0 * U * reach)) * EDGE)
    }

    /// What the filter knows of a triangle's edges.
    #[inline(always)]
    pub(super) fn edges(&self, triangle: &LeafTriangle) -> Edges {
        let (w, bound) = self.edge_functions(triangle);
        let most = larger(larger(w[0], w[1]), w[2]);
        let least = smaller(smaller(w[0], w[1]), w[2]);
        if most > bound && least < -bound {
            Edges::Apart
        } else if least > bound {
            Edges::Agree(self.depth_sign)
        } else if most < -bound {
            Edges::Agree(-self.depth_sign)
        } else {
            Edges::Open
        }
    }
}

#[inline(always)]
fn larger(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

#[inline(always)]
fn smaller(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

#[inline(always)]
fn largest([a, b, c]: [f32; 3]) -> f32 {
    larger(larger(a.abs(), b.abs()), c.abs())
}
