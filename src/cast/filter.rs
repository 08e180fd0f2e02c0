//! The f64 filter: signs and bounds of W_i, V and D where rounding cannot matter.
//!
//! Edges are used instead of second vertices: W_i = d·(a_j × E_i) with E_i = v_k − v_j, V = a_0·n,
//! D = n·d, n = E_1 × E_2. The permanents then shrink with the triangle.
//!
//! Constants, u = 2^-53. A monomial of W or D carries two rounded differences, and then mul, sub,
//! mul, add before the last addition, whose rounding cannot change a sign: 6 factors (1 + δ). So
//! |ŵ − W| ≤ (γ₆ + …)·P with P the permanent, and a computed P̂ ≥ P(1 − u)^7 costs a little more:
//! (6 + 80u)·u·P̂ bounds it. V has a third rounded difference: (7 + 104u)·u. For bounds of values
//! the last addition counts: one u more. The permanent of a triple product of vectors is at most
//! 6·A·B·C of their largest components, so the crude bounds below are 6·6 = 36, 6·7 = 42 and
//! 6·8 = 48 times u·A·B·C; each is taken 4u larger for the terms in u² and the bound's own
//! roundings. Nothing under- or overflows: products of three lie within 2^±447.

use super::exact::Vertices;
use super::pair::largest;
use super::ray::Ray;
use crate::mutant::{self, Mutant};

/// u = 2^-53.
pub(super) const U: f64 = f64::EPSILON / 2.0;
/// Bound of the sign of W over A·E·d.
const EDGE_CRUDE: f64 = 40.0 * U;
/// Bound of the sign of W over its permanent.
const EDGE_TIGHT: f64 = (6.0 + 80.0 * U) * U;
/// Bound of the value of D over E²·d.
const SPEED_CRUDE: f64 = 46.0 * U;
/// Bound of the value of V over A·E², which serves for its sign too.
const PLANE_CRUDE: f64 = 52.0 * U;

/// A triangle as the filter of rays from one eye sees it; differences are rounded.
#[derive(Clone, Copy, Debug)]
pub(super) struct Relative {
    /// v_i − e.
    a: [[f64; 3]; 3],
    /// v_k − v_j, the edge opposite corner i.
    edges: [[f64; 3]; 3],
    largest_a: f64,
    largest_edge: f64,
}

/// A value and a bound of its error.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounded {
    pub(super) value: f64,
    pub(super) error: f64,
}

impl Bounded {
    /// The certain sign, or `None`.
    pub(super) fn sign(self) -> Option<i8> {
        if self.value > self.error {
            Some(1)
        } else if self.value < -self.error {
            Some(-1)
        } else {
            None
        }
    }
}

impl Relative {
    #[inline(always)]
    pub(super) fn new(eye: [f64; 3], v: &Vertices) -> Self {
        let difference =
            |p: [f64; 3], q: [f64; 3]| -> [f64; 3] { std::array::from_fn(|k| p[k] - q[k]) };
        let a = v.map(|vertex| difference(vertex, eye));
        let edges = [difference(v[2], v[1]), difference(v[0], v[2]), difference(v[1], v[0])];
        let larger = |a: f64, b: f64| if a > b { a } else { b };
        let largest_of =
            |[p, q, r]: [[f64; 3]; 3]| larger(larger(largest(p), largest(q)), largest(r));
        Self { a, edges, largest_a: largest_of(a), largest_edge: largest_of(edges) }
    }

    /// W_0, W_1, W_2 and one bound for their signs.
    #[inline(always)]
    pub(super) fn edge_functions(&self, ray: &Ray) -> ([f64; 3], f64) {
        let d = ray.direction();
        let values = std::array::from_fn(|i| dot(self.edges[i], cross(d, self.a[(i + 1) % 3])));
        if mutant::is(Mutant::BelievedEdges) {
            return (values, 0.0);
        }
        if mutant::is(Mutant::SingleEdges) {
            let single =
                |i| mutant::single_determinant(self.edges[i], d, self.a[(i + 1) % 3]).into();
            return ([0, 1, 2].map(single), 0.0);
        }
        if mutant::is(Mutant::ContractedEdges) {
            let contracted = |i: usize| contracted(self.edges[i], d, self.a[(i + 1) % 3]);
            return ([0, 1, 2].map(contracted), 0.0);
        }
        (values, EDGE_CRUDE * (self.largest_a * self.largest_edge * largest(d)))
    }

    /// A tighter bound for the sign of one of them.
    pub(super) fn tight_edge_bound(&self, ray: &Ray, i: usize) -> f64 {
        let a = self.a[(i + 1) % 3].map(f64::abs);
        let (d, e) = (ray.direction().map(f64::abs), self.edges[i].map(f64::abs));
        let permanent = e[0] * (d[1] * a[2] + d[2] * a[1])
            + e[1] * (d[2] * a[0] + d[0] * a[2])
            + e[2] * (d[0] * a[1] + d[1] * a[0]);
        EDGE_TIGHT * permanent
    }

    /// V and D with bounds for their values.
    pub(super) fn plane_and_speed(&self, ray: &Ray) -> [Bounded; 2] {
        let plane = self.plane();
        [plane.value, plane.speed(ray)]
    }

    /// What V and D need of the triangle and the eye.
    pub(super) fn plane(&self) -> Plane {
        let n = cross(self.edges[1], self.edges[2]);
        let square = self.largest_edge * self.largest_edge;
        let value =
            Bounded { value: dot(self.a[0], n), error: PLANE_CRUDE * (self.largest_a * square) };
        Plane { value, normal: n, square }
    }
}

/// A triangle's plane as all rays from one eye see it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plane {
    /// V.
    pub(super) value: Bounded,
    normal: [f64; 3],
    /// The largest component of an edge, squared.
    square: f64,
}

impl Plane {
    /// D.
    #[inline(always)]
    pub(super) fn speed(&self, ray: &Ray) -> Bounded {
        Bounded {
            value: dot(ray.direction(), self.normal),
            error: SPEED_CRUDE * (largest(ray.direction()) * self.square),
        }
    }
}

#[inline(always)]
fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// e·(d × a) as a contracting compiler would have it: a planted mistake.
fn contracted(e: [f64; 3], d: [f64; 3], a: [f64; 3]) -> f64 {
    let [x, y, z] = [(1, 2), (2, 0), (0, 1)].map(|(i, j)| d[i].mul_add(a[j], -(d[j] * a[i])));
    e[2].mul_add(z, e[1].mul_add(y, e[0] * x))
}

#[inline(always)]
fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2]
}
