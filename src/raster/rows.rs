//! A triangle's homogeneous rows in f64, each with a proven bound of its error over the frame.
//!
//! With X_i = adj(P)·(v_i − e) and S_ij = adj(P)·(v_j − v_i), the edge row opposite corner k is
//! X_i × X_j = X_i × S_ij (taken from the vertices' difference, which keeps small far triangles
//! well conditioned) and the plane's row is S_01 × S_02. Source: Olano & Greer (1997).
//! No vertex is divided by its w, and none is clipped.
//!
//! **Bounds.** u = 2^-53. A computed polynomial of which each monomial went through m roundings is
//! off by at most γ_m·Q, γ_m = m·u/(1 − m·u), with Q the same polynomial of magnitudes (every
//! subtraction an addition). Q is itself computed in f64, from rounded factors, and may fall short
//! by a relative (m + 1)·u; with m ≤ 20, (m + 1)·u ≥ γ_m·(1 + (m + 2)·u) covers both. No operation
//! over- or underflows (`image_plane`); were one to, NaN and ∞ fail every certifying comparison.

use super::image_plane::ImagePlane;
use crate::mesh::TriangleId;
use crate::mutant::{self, Mutant};

/// Half an ulp of 1: the relative error of one rounding.
pub(super) const U: f64 = f64::EPSILON / 2.0;

/// Roundings per monomial of X or S, component by component: v − e or v_j − v_i (1), the adjugate's
/// entry (1), their product (1), two sums (2): m = 5.
pub(super) const POINT_ERROR: f64 = 6.0 * U;

/// Roundings per monomial of a row's value: X (5), S (5), product and difference of the cross
/// product (2), product with x or y (1), two sums (2): m = 15.
const ROW_ERROR: f64 = 16.0 * U;

/// Roundings per monomial of X_0·(S_01 × S_02): X (5), the row (12), product (1), two sums (2): m = 20.
const VOLUME_ERROR: f64 = 21.0 * U;

/// A homogeneous point and, per component, the sum of the magnitudes of its monomials.
#[derive(Clone, Copy)]
pub(super) struct Homogeneous {
    /// X or S.
    pub(super) value: [f64; 3],
    /// Its Q: the error of `value` is at most `POINT_ERROR` times this.
    pub(super) magnitude: [f64; 3],
}

impl Homogeneous {
    /// adj(P)·v.
    pub(super) fn new(plane: &ImagePlane, v: [f64; 3]) -> Self {
        let m = &plane.adjugate;
        Self {
            value: [0, 1, 2].map(|k| m[k][0] * v[0] + m[k][1] * v[1] + m[k][2] * v[2]),
            magnitude: [0, 1, 2]
                .map(|k| (m[k][0] * v[0]).abs() + (m[k][1] * v[1]).abs() + (m[k][2] * v[2]).abs()),
        }
    }

    fn cross(&self, other: &Self) -> Self {
        let (a, b) = (&self.value, &other.value);
        let (p, q) = (&self.magnitude, &other.magnitude);
        Self {
            value: [
                a[1] * b[2] - a[2] * b[1],
                a[2] * b[0] - a[0] * b[2],
                a[0] * b[1] - a[1] * b[0],
            ],
            magnitude: [
                p[1] * q[2] + p[2] * q[1],
                p[2] * q[0] + p[0] * q[2],
                p[0] * q[1] + p[1] * q[0],
            ],
        }
    }
}

/// A row a·x + b·y + c and how far a computed value can be from the true one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row {
    pub(super) a: f64,
    pub(super) b: f64,
    pub(super) c: f64,
    /// Bound over the whole frame, not over a tile: what a filter certifies must not depend on the
    /// order of the work.
    pub(super) bound: f64,
}

impl Row {
    fn new(row: &Homogeneous, factor: f64, extent: [f64; 2]) -> Self {
        let [a, b, c] = row.value.map(|v| v * factor);
        let q = row.magnitude;
        if mutant::is(Mutant::BelievedEdges) || mutant::is(Mutant::ContractedEdges) {
            return Self { a, b, c, bound: 0.0 };
        }
        Self { a, b, c, bound: ROW_ERROR * (q[0] * extent[0] + q[1] * extent[1] + q[2]) }
    }

    /// The value at a sample, always from the frame's origin: the same bits in every tile.
    #[inline]
    pub(super) fn at(&self, x: f64, y: f64) -> f64 {
        if mutant::is(Mutant::ContractedEdges) {
            return self.a.mul_add(x, self.b.mul_add(y, self.c));
        }
        (self.a * x + self.b * y) + self.c
    }
}

/// A triangle with V ≠ 0, ready to be scanned; all rows are positive inside.
#[derive(Clone, Debug)]
pub(super) struct TriangleRows {
    pub(super) id: TriangleId,
    /// sgn V, ±1.
    pub(super) volume_sign: i32,
    /// Edge rows opposite corners 0, 1, 2.
    pub(super) edges: [Row; 3],
    /// The plane's row; divided by |V| it is 1/t times one factor that all triangles share.
    pub(super) plane: Row,
    /// Certain bounds of 1/|V|, each with room for the roundings of `inverse_depth`.
    inverse_volume: [f64; 2],
}

/// The vertices' images, as far as the bounding box and the rows need them.
pub(super) struct Projection {
    /// v_i.
    vertices: [[f64; 3]; 3],
    /// X_i.
    pub(super) points: [Homogeneous; 3],
}

impl Projection {
    /// Moves the corners of a triangle into homogeneous image coordinates.
    pub(super) fn new(plane: &ImagePlane, corners: [[f32; 3]; 3]) -> Self {
        let vertices = corners.map(|v| v.map(f64::from));
        let points = vertices.map(|v| Homogeneous::new(plane, difference(v, plane.eye)));
        Self { vertices, points }
    }

    /// Whether all corners lie behind the eye's plane, for a planted mistake.
    pub(super) fn is_behind(&self, plane: &ImagePlane) -> bool {
        self.points.iter().all(|point| point.value[2] * plane.orientation < 0.0)
    }

    /// The rows, or `None` when V = 0: such a triangle is never visible.
    ///
    /// `exact_volume` gives sgn V and |V| (relative error 2^-52) where f64 cannot certify the sign,
    /// or `None` when V = 0.
    pub(super) fn rows(
        &self,
        plane: &ImagePlane,
        id: TriangleId,
        exact_volume: impl FnOnce() -> Option<(i32, f64)>,
    ) -> Option<TriangleRows> {
        // Differences S_ij along the three edges.
        let [v0, v1, v2] = self.vertices;
        let [s01, s12, s20] = [(v0, v1), (v1, v2), (v2, v0)]
            .map(|(from, to)| Homogeneous::new(plane, difference(to, from)));
        // The plane's row S_01 × S_02 and V = X_0·(S_01 × S_02); S_02 = −S_20.
        let [x0, x1, x2] = &self.points;
        let normal = s20.cross(&s01);
        let n = &normal.value;
        let volume = x0.value[0] * n[0] + x0.value[1] * n[1] + x0.value[2] * n[2];
        let (p, q) = (&x0.magnitude, &normal.magnitude);
        let error = VOLUME_ERROR * (p[0] * q[0] + p[1] * q[1] + p[2] * q[2]);
        if mutant::is(Mutant::DeterminantEpsilon) && volume.abs() < 1e-6 {
            return None;
        }
        // Certify sgn V, or ask for it. 2^-51 is twice the relative error of an exact volume.
        let (volume_sign, size, error) = if volume.abs() > error {
            (if volume < 0.0 { -1 } else { 1 }, volume.abs(), error)
        } else {
            let (sign, size) = exact_volume()?;
            (sign, size, size * 4.0 * U)
        };
        // Bound 1/|V|: here a sum, a quotient and a product round, in `inverse_depth` two
        // more operations: 5u in all.
        let inverse_volume =
            [(1.0 / (size + error)) * (1.0 - 8.0 * U), (1.0 / (size - error)) * (1.0 + 8.0 * U)];
        // Turn the rows so that inside is positive; a factor ±1 is exact.
        let factor = f64::from(volume_sign) * plane.orientation;
        let row = |h: &Homogeneous| Row::new(h, factor, plane.extent);
        Some(TriangleRows {
            id,
            volume_sign,
            edges: [row(&x1.cross(&s12)), row(&x2.cross(&s20)), row(&x0.cross(&s01))],
            plane: row(&normal),
            inverse_volume,
        })
    }
}

impl TriangleRows {
    /// Certain bounds of (plane row)/|V|: at a covered sample 1/t up to a factor that is the same
    /// for all triangles of the frame, elsewhere the row continued, which may be negative.
    #[inline]
    pub(super) fn inverse_depth(&self, x: f64, y: f64) -> [f64; 2] {
        let value = self.plane.at(x, y);
        if mutant::is(Mutant::InwardInterval) {
            return [value * self.inverse_volume[0]; 2];
        }
        let (low, high) = (value - self.plane.bound, value + self.plane.bound);
        // A numerator's sign tells which end of 1/|V| makes the quotient extreme.
        let [least, greatest] = self.inverse_volume;
        [
            low * if low >= 0.0 { least } else { greatest },
            high * if high >= 0.0 { greatest } else { least },
        ]
    }
}

/// a − b, one rounding per component.
fn difference(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}
