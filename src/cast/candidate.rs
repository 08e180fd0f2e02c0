//! Covering triangles in depth order, and the numbers of the nearest.
//!
//! Depth is compared in three steps: intervals of t from the f64 filter, intervals that are a few
//! ulps wide, and the exact sign of the depth polynomial F. All t here are those of the scaled ray.

use super::coverage::Covering;
use super::exact::{self, Signed, Vertices};
use super::filter::{Bounded, Plane, U};
use super::memo::SamePlane;
use super::pair::{PairVector, triple_product};
use super::ray::Ray;
use super::unrounded;
use crate::accel::LeafTriangle;
use crate::mesh::Barycentric;
use crate::mutant::{self, Mutant};
use crate::visibility::Level;

/// A covering triangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Candidate {
    pub(super) triangle: LeafTriangle,
    pub(super) covering: Covering,
    /// Certain bounds of t, crude or narrow.
    t: [f64; 2],
    narrow: Option<Surface>,
    /// Whether another covering triangle is known to have exactly the same t.
    pub(super) shared: bool,
}

/// An f32 filter of W_i = (a_j × E_i)·d that knows no more than the vectors' largest components, A·E·d,
/// has a bound of 40·2^-24 of it, by the derivation of `filter` with u = 2^-24. What is beyond is
/// clear to f32, whoever computes it.
pub(super) const CLEAR_EDGE: f64 = 40.0 / (1 << 24) as f64;

/// t to its certain bounds: see [`surface`].
pub(super) const T_PADDING: [f64; 2] = [1.0 - 12.0 * U, 1.0 + 12.0 * U];

/// Where and how a ray meets its triangle; a function of the two and nothing else.
#[derive(Clone, Copy, Debug)]
pub(super) struct Surface {
    /// Certain bounds of t.
    pub(super) t: [f64; 2],
    /// W_i/ΣW.
    pub(super) barycentric: Barycentric,
    /// Whether all W_i are beyond [`CLEAR_EDGE`].
    pub(super) is_clear: bool,
}

impl Candidate {
    pub(super) fn new(ray: &Ray, triangle: &LeafTriangle, covering: Covering) -> Self {
        let t = crude_interval(covering);
        let shared = triangle.copies > 1;
        let mut candidate = Self { triangle: *triangle, covering, t, narrow: None, shared };
        // An interval wider than 2^-20 is no use for culling the rest of the scene.
        if candidate.t[1] > candidate.t[0] * (1.0 + 1.0 / f64::from(1 << 20)) {
            candidate.narrow(ray);
        }
        candidate
    }

    /// Certain upper bound of t.
    pub(super) fn reach(&self) -> f64 {
        self.t[usize::from(!mutant::is(Mutant::PruneEqual))]
    }

    /// Certain lower bound of t.
    pub(super) fn nearest_t(&self) -> f64 {
        self.t[0]
    }

    /// The surface, computed once.
    pub(super) fn narrow(&mut self, ray: &Ray) -> Surface {
        *self.narrow.get_or_insert_with(|| {
            let surface = surface(ray, &vertices(&self.triangle));
            self.t = surface.t;
            surface
        })
    }

    /// Whether `self` is nearer than `other` at the sample, and the level that decided. A tie
    /// marks both as shared. The relation is a strict order of the triangles that cover a sample,
    /// so the nearest does not depend on the order of comparisons; and `shared` does not either,
    /// because two triangles of equal t are compared with each other or with a third of that t:
    /// traversal prunes only strictly beyond t.
    pub(super) fn precedes(
        &mut self,
        other: &mut Self,
        ray: &Ray,
        same_plane: &mut SamePlane<'_>,
    ) -> (bool, Level) {
        if let Some(nearer) = self.planted_order(other, ray) {
            return (nearer, Level::Double);
        }
        if let Some(nearer) = separated(self.t, other.t) {
            return (nearer, Level::Double);
        }
        let ids = [self.triangle.id, other.triangle.id];
        let lower_id = (ids[0] < ids[1]) != mutant::is(Mutant::LastIdInPlane);
        // Known to lie in one plane: no arithmetic beyond the bounds above.
        if same_plane.knows(ids[0], ids[1]) {
            self.shared = true;
            other.shared = true;
            return (lower_id, Level::Double);
        }
        self.narrow(ray);
        other.narrow(ray);
        if let Some(nearer) = separated(self.t, other.t) {
            return (nearer, Level::Double);
        }
        let [a, b] = [vertices(&self.triangle), vertices(&other.triangle)];
        let (a, b) = ((&a, self.covering.sign), (&b, other.covering.sign));
        let (f, level) = match unrounded::depth_sign(ray, a, b) {
            Some(f) => (f, Level::Double),
            None if same_plane.learns(ids, [&self.triangle.vertices, &other.triangle.vertices]) => {
                (Signed { sign: 0, zero: true }, Level::Double)
            }
            None => (exact::depth_sign(ray, a, b), Level::Exact),
        };
        self.shared |= f.zero;
        other.shared |= f.zero;
        if f.sign == 0 {
            same_plane.remember(ids[0], ids[1]);
        }
        let by_id = f.sign == 0 || (f.zero && mutant::is(Mutant::LowestIdFirst));
        (if by_id { lower_id } else { f.sign < 0 }, level)
    }

    /// How a planted mistake orders the two.
    #[inline(always)]
    fn planted_order(&mut self, other: &mut Self, ray: &Ray) -> Option<bool> {
        if mutant::is(Mutant::SingleDepth) {
            let [own, others] = [&*self, &*other].map(|candidate| {
                mutant::single_t(ray.eye, ray.direction(), &vertices(&candidate.triangle))
            });
            return Some(own < others);
        }
        if mutant::is(Mutant::DoubleDepth) {
            return Some(self.narrow(ray).t[0] < other.narrow(ray).t[0]);
        }
        let near_tie = (self.t[0] - other.t[0]).abs() < 1e-6 * self.t[1];
        (mutant::is(Mutant::DepthEpsilon) && near_tie)
            .then_some(self.triangle.id < other.triangle.id)
    }
}

/// A triangle's vertices in f64.
#[inline(always)]
pub(super) fn vertices(triangle: &LeafTriangle) -> Vertices {
    triangle.vertices.map(|vertex| vertex.map(f64::from))
}

/// Whether a lies wholly before b; `None` where they meet.
pub(super) fn separated(a: [f64; 2], b: [f64; 2]) -> Option<bool> {
    if a[1] < b[0] {
        Some(true)
    } else if b[1] < a[0] {
        Some(false)
    } else {
        None
    }
}

/// Bounds of V/D from the filter's values. Numerator and denominator are rounded once each, the
/// quotient once and the padding once: 4u on each side covers them.
fn crude_interval(covering: Covering) -> [f64; 2] {
    interval(f64::from(covering.sign), covering.plane_and_speed)
}

/// Bounds of t where a ray meets the plane of a triangle that it is known to meet, from the filter's
/// values alone; `None` where they leave sgn V open.
#[inline(always)]
pub(super) fn plane_interval(ray: &Ray, plane: &Plane) -> Option<[f64; 2]> {
    let sign = plane.value.sign()?;
    Some(interval(f64::from(sign), [plane.value, plane.speed(ray)]))
}

fn interval(sign: f64, plane_and_speed: [Bounded; 2]) -> [f64; 2] {
    let [v, d] = plane_and_speed.map(|b| Bounded { value: b.value * sign, ..b });
    let lo = if v.value > v.error {
        (v.value - v.error) / (d.value.abs() + d.error) * (1.0 - 4.0 * U)
    } else {
        0.0
    };
    let hi = if d.value > d.error {
        (v.value + v.error) / (d.value - d.error) * (1.0 + 4.0 * U)
    } else {
        f64::INFINITY
    };
    if mutant::is(Mutant::InwardInterval) { [v.value / d.value; 2] } else { [lo, hi] }
}

/// The surface of a covering triangle.
///
/// |W_i| and |V| have relative errors of at most 3u, by pairs or expansions. All W_i have the sign
/// of V, so D = ΣW loses nothing: 5u. Hence weights W_i/D are good to 9u, a little over 2^-50, and
/// t = V/D to 3u + 5u + u, u more for multiplying by the padding: 12u on each side with room for
/// terms in u², a relative width of 24u < 2^-48.
pub(super) fn surface(ray: &Ray, v: &Vertices) -> Surface {
    let edges = edge_pairs(ray.eye, v);
    let d = PairVector::exact(ray.direction());
    let w: [f64; 3] = std::array::from_fn(|i| {
        let [a, e] = &edges[i];
        match triple_product(a, e, &d) {
            Some(value) => value.abs(),
            None => unrounded::edge_value(ray, v, i)
                .map_or_else(|| exact::edge_magnitude(ray, v, i), f64::abs),
        }
    });
    let is_clear = |i: usize| {
        let [a, e] = &edges[i];
        w[i] > CLEAR_EDGE * (a.largest() * e.largest()) * d.largest()
    };
    let speed = (w[0] + w[1]) + w[2];
    let t = plane_magnitude(ray, v, &edges) / speed;
    Surface {
        t: [t * T_PADDING[0], t * T_PADDING[1]],
        barycentric: Barycentric(mutant::shifted(w).map(|w| w / speed)),
        is_clear: (0..3).all(is_clear),
    }
}

/// Per corner i, a_j and E_i, of which W_i = (a_j × E_i)·d.
pub(super) fn edge_pairs(eye: [f64; 3], v: &Vertices) -> [[PairVector; 2]; 3] {
    std::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        [PairVector::difference(v[j], eye), PairVector::difference(v[k], v[j])]
    })
}

/// |V|, relative error at most 3u.
pub(super) fn plane_magnitude(ray: &Ray, v: &Vertices, edges: &[[PairVector; 2]; 3]) -> f64 {
    // a_0 is that of edge 2.
    match triple_product(&edges[1][1], &edges[2][1], &edges[2][0]) {
        Some(value) => value.abs(),
        None => exact::plane_magnitude(ray, v),
    }
}
