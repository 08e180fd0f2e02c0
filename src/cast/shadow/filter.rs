//! The f64 filter of shadows: which side a triangle is on, as far as bounds are certain.
//!
//! Seen from the surface point x, with r_i = v_i − x, λ = l − x (or l, for a direction) and
//! e_i = v_k − v_j: the side of x against the plane of edge i and the light has the sign of −W_i,
//! W_i = det(r_j, r_k, λ) = (λ × r_j)·e_i, and the side of T's plane that of −P, P = r_0·n_T. So T
//! crosses iff sgn W_0 = sgn W_1 = sgn W_2 = sgn P = τ ≠ 0. It is the question that a camera ray
//! asks, and τ puts the end to it.
//!
//! x is not a f64. It is x̂ + η with |η_k| ≤ δ, x̂ = fl(e + t̂·d) for a t̂ in the certain bounds of
//! t: |t − t̂| ≤ t_hi − t_lo, the product rounds by u·t_hi·|d| and the sum by u·|x̂|, u = 2^-53.
//!
//! Bounds, with R, B, Λ the largest components of r, e and λ, each product of a determinant at most
//! RBΛ and six of them:
//! - rounding: three inputs that rounded once, and mul, sub, mul, add, add: 8 factors (1 + u), so
//!   8u·6RBΛ and terms in u²;
//! - x: η changes W by −det(η, e, λ) − det(r, e, η), for edges do not move and det(η, e, η) = 0: at
//!   most 6·δBΛ + 6·RBδ_λ, δ_λ = δ for a position and 0 for a direction. P changes by 6·B²δ.
//!
//! The code has 9u for 8u and 6.1 for 6, which leaves room for terms of second order and for the
//! rounding of the bounds themselves (below 20u). Underflow: e is 0 or at least 2^-149, and R ≥ B/2, so
//! products of r and e lose nothing that counts beside u·RB; products with λ or l − v_0 lose at most
//! 2^-1074 each, for which 2^-1000 is added. Overflow: with Λ below 2^600 there is none (R and B
//! are below 2^129). Where Λ is larger, or something is not finite, every bound is ∞ and nothing is
//! certain.

use super::super::filter::U;
use super::super::pair::largest;
use super::super::ray::Ray;
use crate::accel::{LeafTriangle, Segment};
use crate::mutant::{self, Mutant};
use crate::scene::light_point::LightPoint;

/// 9u: see the module's derivation.
const ROUNDING: f64 = 9.0 * U;

/// Six products, and room for second order.
const PRODUCTS: f64 = 6.1;

/// 2^-1000: more than products lose by underflow.
const UNDERFLOW: f64 = f64::MIN_POSITIVE * (1_u64 << 22) as f64;

/// 2^600: largest component of λ for which nothing overflows.
const FAR: f64 = f64::from_bits((1023 + 600) << 52);

/// What the filter knows of a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    /// It does not cross the segment.
    Beside,
    /// It crosses.
    Crossed,
    /// Not certain.
    Open,
}

/// The segment from a surface point to a light.
#[derive(Clone, Copy, Debug)]
pub(super) struct ShadowRay {
    /// x̂.
    start: [f64; 3],
    /// δ.
    error: f64,
    /// λ.
    toward: [f64; 3],
    light: LightPoint,
    /// A bound of W is B·(R·`per_distance` + `fixed`).
    per_distance: f64,
    fixed: f64,
}

impl ShadowRay {
    /// From the sample's ray and certain bounds of its t at the surface.
    pub(super) fn new(ray: &Ray, [t_lo, t_hi]: [f64; 2], light: LightPoint) -> Self {
        let (eye, d) = (ray.eye, ray.direction());
        let middle = t_lo + (t_hi - t_lo) * 0.5;
        let mut start: [f64; 3] = std::array::from_fn(|k| eye[k] + middle * d[k]);
        let speed = largest(d);
        let mut error =
            1.01 * ((t_hi - t_lo) * speed + U * (t_hi * speed) + U * largest(start)) + UNDERFLOW;
        let mut light = light;
        if let LightPoint::Position(l) = light {
            if mutant::is(Mutant::ShadowBeyondLight) {
                light = LightPoint::Direction(std::array::from_fn(|k| l[k] - start[k]));
            }
            if mutant::is(Mutant::ShadowOffset) {
                start = std::array::from_fn(|k| start[k] + (l[k] - start[k]) * 1e-3);
            }
        }
        let (toward, toward_error) = match light {
            LightPoint::Position(l) => (std::array::from_fn(|k| l[k] - start[k]), error),
            LightPoint::Direction(l) => (l, 0.0),
        };
        if mutant::is(Mutant::ShadowAcne) {
            error = 0.0;
        }
        let length = largest(toward);
        let certain =
            length < FAR && error.is_finite() && start.iter().chain(&toward).all(|c| c.is_finite());
        let (per_distance, fixed) = if certain {
            (PRODUCTS * (ROUNDING * length + toward_error), PRODUCTS * error * length)
        } else {
            (f64::INFINITY, f64::INFINITY)
        };
        Self { start, error, toward, light, per_distance, fixed }
    }

    /// The light that the shadow is of.
    pub(super) fn light(&self) -> LightPoint {
        self.light
    }

    /// What the accelerator walks along.
    pub(super) fn segment(&self) -> Segment {
        let reach = match self.light {
            LightPoint::Position(_) => 1.0,
            LightPoint::Direction(_) => f64::INFINITY,
        };
        Segment::new(self.start, self.error, self.toward, reach)
    }

    /// Where the triangle is, as far as f64 can tell.
    #[inline(always)]
    pub(super) fn side(&self, triangle: &LeafTriangle) -> Side {
        let v = triangle.vertices.map(|vertex| vertex.map(f64::from));
        let r = v.map(|vertex| minus(vertex, self.start));
        let e = [minus(v[2], v[1]), minus(v[0], v[2]), minus(v[1], v[0])];
        let width = larger(largest(e[0]), larger(largest(e[1]), largest(e[2])));
        let reach = larger(largest(r[0]), larger(largest(r[1]), largest(r[2])));

        // Hold the light's rays against the three edges.
        let m = r.map(|r| cross(self.toward, r));
        let w = [dot(m[1], e[0]), dot(m[2], e[1]), dot(m[0], e[2])];
        let bound = self.believed(width * (reach * self.per_distance + self.fixed) + UNDERFLOW);
        let positive = (w[0] > bound) | (w[1] > bound) | (w[2] > bound);
        let negative = (w[0] < -bound) | (w[1] < -bound) | (w[2] < -bound);
        if positive & negative {
            return Side::Beside;
        }

        // Hold the surface point and the light against the plane.
        let n = cross(e[1], e[2]);
        let plane = dot(r[0], n);
        let scale = PRODUCTS * width * width;
        let plane_bound = self.believed(scale * (ROUNDING * reach + self.error) + UNDERFLOW);
        let light = match self.light {
            LightPoint::Position(l) => minus(l, v[0]),
            LightPoint::Direction(l) => l,
        };
        let end = dot(light, n);
        // Where W is never certain, neither is this: |l − v_0| may then be anything.
        let end_bound = scale * ROUNDING * largest(light) + UNDERFLOW + 0.0 * self.fixed;
        let above = positive | (plane > plane_bound) | (end > end_bound);
        let below = negative | (plane < -plane_bound) | (end < -end_bound);
        if above & below {
            return Side::Beside;
        }
        let all = |certain: [bool; 5]| certain == [true; 5];
        let [w0, w1, w2] = w;
        if all([w0 > bound, w1 > bound, w2 > bound, plane > plane_bound, end > end_bound])
            || all([w0 < -bound, w1 < -bound, w2 < -bound, plane < -plane_bound, end < -end_bound])
        {
            Side::Crossed
        } else if self.light_is_evidently_in_plane(&v) {
            Side::Beside
        } else {
            Side::Open
        }
    }

    /// Whether τ = 0 at first sight: the light is at a corner, or in a plane across an axis with all
    /// of them. Lights at vertices and in floors would otherwise send every ray to the integers.
    fn light_is_evidently_in_plane(&self, v: &[[f64; 3]; 3]) -> bool {
        match self.light {
            LightPoint::Position(l) => {
                v.contains(&l) || (0..3).any(|k| v.iter().all(|corner| corner[k] == l[k]))
            }
            LightPoint::Direction(l) => {
                (0..3).any(|k| l[k] == 0.0 && v.iter().all(|corner| corner[k] == v[0][k]))
            }
        }
    }

    /// The bound, but for a planted mistake.
    #[inline(always)]
    fn believed(&self, bound: f64) -> f64 {
        if mutant::is(Mutant::ShadowAcne) { 0.0 } else { bound }
    }
}

#[inline(always)]
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

#[inline(always)]
fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline(always)]
fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[inline(always)]
fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2]
}
