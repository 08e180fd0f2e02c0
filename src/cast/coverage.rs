//! Whether a triangle covers a sample: V ≠ 0 and sgn*(W_i) = sgn V for i = 0, 1, 2.
//!
//! Three levels, each for what the one before leaves open: the f32 filter, which turns most
//! triangles away; f64, by its filter or because nothing rounded; expansions. The answer, its
//! level and the edge flag depend on the triangle and the sample only.

use super::candidate;
use super::exact::{self, Vertices};
use super::filter::{Bounded, Relative};
use super::ray::Ray;
use super::single::{self, ShearedRay};
use super::unrounded;
use crate::accel::LeafTriangle;
use crate::mutant::{self, Mutant};
use crate::visibility::Level;

/// A triangle that covers the sample.
#[derive(Clone, Copy, Debug)]
pub(super) struct Covering {
    /// sgn V.
    pub(super) sign: i8,
    /// Highest level that a sign of W_i needed.
    pub(super) level: Level,
    /// Some W_i is exactly 0.
    pub(super) on_edge: bool,
    /// V and D with bounds, in f64.
    pub(super) plane_and_speed: [Bounded; 2],
}

/// The decision, and the level of arithmetic that it took.
pub(super) type Decision = (Option<Covering>, Level);

/// Whether the triangle covers the ray's sample.
#[inline(always)]
pub(super) fn decide(ray: &Ray, sheared: &ShearedRay, triangle: &LeafTriangle) -> Decision {
    match sheared.edges(triangle) {
        single::Edges::Apart => (None, Level::Single),
        single::Edges::Agree(sign) => {
            let edges = Edges { sign, level: Level::Single, on_edge: false };
            let vertices = candidate::vertices(triangle);
            with_plane(ray, &vertices, &Relative::new(ray.eye, &vertices), edges)
        }
        single::Edges::Open => decide_in_double(ray, &candidate::vertices(triangle)),
    }
}

/// The decision without the f32 filter.
fn decide_in_double(ray: &Ray, vertices: &Vertices) -> Decision {
    let relative = Relative::new(ray.eye, vertices);
    let (w, bound) = relative.edge_functions(ray);
    let positive = w.map(|w| w > bound);
    let negative = w.map(|w| w < -bound);
    // Two certain opposite signs: outside, whatever V is.
    if (positive[0] | positive[1] | positive[2]) && (negative[0] | negative[1] | negative[2]) {
        return (None, Level::Double);
    }
    if positive == [true; 3] || negative == [true; 3] {
        let sign = if positive[0] { 1 } else { -1 };
        let edges = Edges { sign, level: Level::Double, on_edge: false };
        return with_plane(ray, vertices, &relative, edges);
    }
    decide_near_edges(ray, vertices, &relative, w)
}

/// The common sign of the three edge functions.
struct Edges {
    sign: i8,
    level: Level,
    on_edge: bool,
}

/// Some edge function is within its crude bound of 0: tight bound, then its sign in f64 if nothing
/// rounds, then in expansions, edge by edge.
#[cold]
fn decide_near_edges(ray: &Ray, vertices: &Vertices, relative: &Relative, w: [f64; 3]) -> Decision {
    let signs: [Option<i8>; 3] = std::array::from_fn(|i| {
        Bounded { value: w[i], error: relative.tight_edge_bound(ray, i) }.sign()
    });
    if signs.contains(&Some(1)) && signs.contains(&Some(-1)) {
        return (None, Level::Double);
    }
    let mut edges = Edges { sign: 0, level: Level::Double, on_edge: false };
    for (i, certain) in signs.into_iter().enumerate() {
        let sign = certain.unwrap_or_else(|| {
            if mutant::is(Mutant::SignBit) && w[i] == 0.0 {
                return if w[i].is_sign_negative() { -1 } else { 1 };
            }
            let signed = unrounded::edge_sign(ray, vertices, i).unwrap_or_else(|| {
                edges.level = Level::Exact;
                exact::edge_sign(ray, vertices, i)
            });
            edges.on_edge |= signed.zero;
            if signed.zero && mutant::is(Mutant::InclusiveEdges) {
                return exact::plane_sign(ray, vertices);
            }
            if signed.zero && mutant::is(Mutant::ExclusiveEdges) {
                return 0;
            }
            signed.sign
        });
        // c_i = 0 implies V = 0; opposite signs are outside.
        if sign == 0 || sign == -edges.sign {
            return (None, edges.level);
        }
        edges.sign = sign;
    }
    with_plane(ray, vertices, relative, edges)
}

/// The three signs agree; the sign of V must too. It is opposite for a triangle behind the eye and
/// 0 for one that the eye lies on. No level below f64 has it, because depth needs it in f64.
fn with_plane(ray: &Ray, vertices: &Vertices, relative: &Relative, edges: Edges) -> Decision {
    let plane_and_speed = relative.plane_and_speed(ray);
    let (sign, level) = match plane_and_speed[0].sign() {
        Some(sign) => (sign, edges.level.max(Level::Double)),
        None => match unrounded::plane_sign(ray, vertices) {
            Some(sign) => (sign, edges.level.max(Level::Double)),
            None => (exact::plane_sign(ray, vertices), Level::Exact),
        },
    };
    if sign != edges.sign && !planted_agreement(sign) || planted_epsilon(plane_and_speed[1]) {
        return (None, level);
    }
    let Edges { level: edge_level, on_edge, .. } = edges;
    (Some(Covering { sign, level: edge_level, on_edge, plane_and_speed }), level)
}

/// Whether a planted mistake takes a sgn V that is not that of the edges.
#[inline(always)]
fn planted_agreement(sign: i8) -> bool {
    mutant::is(if sign == 0 { Mutant::VolumeZeroHits } else { Mutant::MirrorGhost })
}

/// Whether a planted mistake takes D for 0.
#[inline(always)]
fn planted_epsilon(speed: Bounded) -> bool {
    mutant::is(Mutant::DeterminantEpsilon) && speed.value.abs() < 1e-6
}
