//! The exact stage: a triangle's homogeneous rows in big integers.
//!
//! With integers a = v − e, X_i = adj(P)·a_i and R_0 = X_1 × X_2 (and cyclically),
//! R_i·(x, y, 1) = det(P)·W_i and X_0·R_0 = det(P)²·V, so every sign of the definition is the sign
//! of one of these polynomials. Nothing is rounded and no size is assumed. Which samples need it is
//! decided elsewhere; the f64 filters of `rows` share nothing with it but adj(P).

mod short;

use super::dyadic::{Dyadic, Scaled, sign};
use super::exact_row::{DepthOrder, ExactRow};
use super::image_plane::ImagePlane;
use crate::mesh::{TriangleId, TriangleMesh};
use crate::mutant::{self, Mutant};
use crate::pixel::Pixel;
use dashu_int::IBig;
use std::cmp::Ordering;
use std::collections::HashMap;
use std::rc::Rc;

/// A triangle with V ≠ 0, in integers; its rows are positive inside the triangle.
pub(super) struct ExactTriangle {
    /// sgn V, ±1.
    pub(super) volume_sign: i32,
    /// Edge rows: R_i·sgn V·sgn det(P).
    pub(super) edges: [ExactRow; 3],
    /// The plane's row: the sum of the edge rows, positive wherever the triangle covers.
    pub(super) plane: ExactRow,
    /// The same row as big integers, for depth comparisons.
    plane_wide: [IBig; 3],
    /// |X_0·R_0| = det(P)²·|V|.
    volume: IBig,
    /// The vertices are integers in units of 2^`unit`.
    pub(super) unit: i64,
    /// t = `ray_parameter` / plane row.
    ray_parameter: Scaled,
}

impl ExactTriangle {
    /// The rows of a triangle, or `None` when V = 0: such a triangle is never visible.
    pub(super) fn new(plane: &ImagePlane, corners: [[f32; 3]; 3]) -> Option<Self> {
        let exact = &plane.exact;
        // Put the vertices and the eye on one integer grid, the coarsest that holds them all.
        let corners = corners.map(|v| v.map(|c| Dyadic::new(f64::from(c))));
        let unit = corners
            .iter()
            .flatten()
            .chain(&exact.eye)
            .map(|c| c.exponent)
            .min()
            .filter(|&exponent| exponent != i64::MAX)?;
        if let Some(triangle) = short::triangle(plane, &corners, unit) {
            return triangle;
        }
        let eye = exact.eye.map(|c| c.in_units(unit));
        let points = corners.map(|v| {
            let a: [IBig; 3] = std::array::from_fn(|k| v[k].in_units(unit) - &eye[k]);
            [0, 1, 2].map(|row| dot(&exact.adjugate[row], &a))
        });
        // Edge rows R_0 = X_1 × X_2, …, and det(P)²·V = X_0·R_0.
        let [x0, x1, x2] = &points;
        let edges = [cross(x1, x2), cross(x2, x0), cross(x0, x1)];
        let volume = dot(x0, &edges[0]);
        let volume_sign = match sign(&volume) {
            0 if mutant::is(Mutant::VolumeZeroHits) => 1,
            sign => sign,
        };
        if volume_sign == 0 {
            return None;
        }
        // Turn the rows so that inside is positive.
        let flip = volume_sign * sign(&exact.determinant) < 0;
        let edges = edges.map(|row| if flip { row.map(|c| -c) } else { row });
        let plane_wide: [IBig; 3] =
            std::array::from_fn(|k| &edges[0][k] + &edges[1][k] + &edges[2][k]);
        let row = ExactRow::new(plane_wide.clone());
        let volume = if volume_sign < 0 { -volume } else { volume };
        Some(Self {
            volume_sign,
            edges: edges.map(ExactRow::new),
            plane: row,
            plane_wide,
            ray_parameter: ray_parameter(plane, &volume, unit),
            volume,
            unit,
        })
    }

    /// det(P_lattice)²·|V| as an f64 in world units: the quantity that `rows` bounds. Relative
    /// error at most 2^-52.
    pub(super) fn volume(&self, plane: &ImagePlane) -> f64 {
        // Three factors X, each an adjugate entry times a coordinate.
        let mut volume = Scaled::from_integer(&self.volume);
        volume.exponent += 3 * (plane.exact.adjugate_exponent + self.unit);
        volume.value()
    }

    /// The ray parameter t at a sample that the triangle covers; relative error at most 6u,
    /// u = 2^-53: 3u in `ray_parameter`, less than 2u in the row's value, and u for the division.
    pub(super) fn t_at(&self, pixel: Pixel) -> f64 {
        let depth = self.plane.value_at(pixel);
        Scaled {
            mantissa: self.ray_parameter.mantissa / depth.mantissa,
            exponent: self.ray_parameter.exponent - depth.exponent,
        }
        .value()
    }

    /// Weights W_i/ΣW of the corners at a sample; relative error at most 2^-50 each: two row
    /// values of 2^-52 each, and the division's 2^-53.
    pub(super) fn weights_at(&self, pixel: Pixel) -> [f64; 3] {
        let sum = self.plane.value_at(pixel);
        mutant::shifted([0, 1, 2]).map(|k| {
            let edge = self.edges[k].value_at(pixel);
            Scaled {
                mantissa: edge.mantissa / sum.mantissa,
                exponent: edge.exponent - sum.exponent,
            }
            .value()
        })
    }

    /// The row of F = (V'_A n'_B − V'_B n'_A)·d for this triangle as A: negative where A is nearer.
    ///
    /// Rows are quadratic and volumes cubic in the vertices, so with units 2^a and 2^b the two
    /// products carry 2^(3a+2b) and 2^(2a+3b): they differ by 2^(a−b).
    pub(super) fn depth_row(&self, other: &Self) -> ExactRow {
        let mine = (self.unit - other.unit).max(0) as usize;
        let theirs = (other.unit - self.unit).max(0) as usize;
        let (a, b) = (&self.volume << mine, &other.volume << theirs);
        ExactRow::new([0, 1, 2].map(|k| &a * &other.plane_wide[k] - &b * &self.plane_wide[k]))
    }
}

/// |t·(plane row)|, from t = V/D: in the integers used here det(P)²·V = 2^(3z)·`volume` and
/// det(P)·D = 2^(2z)·row, so t = 2^z·`volume`/(det(P)·row) in units of vertices (2^`unit`) per unit
/// of directions (the lattice's). Two conversions and a division round: 3u (and cuts of 2^-126).
fn ray_parameter(plane: &ImagePlane, volume: &IBig, unit: i64) -> Scaled {
    let exact = &plane.exact;
    let volume = Scaled::from_integer(volume);
    let determinant = Scaled::from_integer(&exact.determinant);
    Scaled {
        mantissa: volume.mantissa / determinant.mantissa.abs(),
        exponent: volume.exponent - determinant.exponent + exact.adjugate_exponent + unit
            - exact.lattice_exponent,
    }
}

fn dot(a: &[IBig; 3], b: &[IBig; 3]) -> IBig {
    &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
}

fn cross(a: &[IBig; 3], b: &[IBig; 3]) -> [IBig; 3] {
    [&a[1] * &b[2] - &a[2] * &b[1], &a[2] * &b[0] - &a[0] * &b[2], &a[0] * &b[1] - &a[1] * &b[0]]
}

/// Most bits of a coordinate for which [`same_plane`] works in i128. Differences have 56 bits then,
/// a normal's components 113, and the determinant is below 2^171.
const SHORT_BITS: i64 = 55;

/// Below this a computed determinant is one below 2^128: each of its three products rounds three
/// times, and two sums round, in all by less than 3·2^169·6·2^-53 < 2^121.
const BELOW_MODULUS: f64 = (1_u128 << 127) as f64;

/// Whether two triangles certainly lie in one plane: the corners of the one have determinant 0 with
/// those of the other. `false` also where the corners' numbers are too long for i128.
///
/// Triangles with V ≠ 0 have corners that are not on one line, so that planes are what is compared.
fn same_plane(mesh: &TriangleMesh, a: TriangleId, b: TriangleId) -> bool {
    let corners = [mesh.triangle(a), mesh.triangle(b)];
    // Walls and panels in one plane mostly stand across an axis.
    let first = corners[0][0];
    if (0..3).any(|k| corners.as_flattened().iter().all(|corner| corner[k] == first[k])) {
        return true;
    }
    let corners = corners.map(|corners| corners.map(|v| v.map(|c| Dyadic::new(f64::from(c)))));
    let numbers = corners.as_flattened().as_flattened();
    let unit = numbers.iter().map(|c| c.exponent).min().unwrap_or(i64::MAX);
    let short =
        |c: &Dyadic| c.in_short_units(unit).filter(|value| value.unsigned_abs() >> SHORT_BITS == 0);
    let mut short_corners = [[0_i128; 3]; 6];
    for (number, short_number) in numbers.iter().zip(short_corners.as_flattened_mut()) {
        match short(number) {
            Some(value) => *short_number = value,
            None => return false,
        }
    }
    let [a0, a1, a2, others @ ..] = short_corners;
    let minus = |p: [i128; 3]| [p[0] - a0[0], p[1] - a0[1], p[2] - a0[2]];
    let (p, q) = (minus(a1), minus(a2));
    let normal = [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];
    others.into_iter().map(minus).all(|r| {
        // 0 modulo 2^128, and below 2^128.
        let product = |k: usize| normal[k].wrapping_mul(r[k]);
        let rounded = |k: usize| normal[k] as f64 * r[k] as f64;
        product(0).wrapping_add(product(1)).wrapping_add(product(2)) == 0
            && (rounded(0) + rounded(1) + rounded(2)).abs() < BELOW_MODULUS
    })
}

/// Exact triangles that one tile has asked for, and the depth rows of its present candidate.
pub(super) struct ExactStage<'a> {
    plane: &'a ImagePlane,
    mesh: &'a TriangleMesh,
    triangles: HashMap<TriangleId, Option<Rc<ExactTriangle>>>,
    /// Rows of `candidate` against each triangle it was compared with: "same plane?" is decided
    /// once per pair, because a tile sees its triangles one after the other.
    depth_rows: HashMap<TriangleId, ExactRow>,
    candidate: Option<TriangleId>,
}

/// Triangles kept per tile before the store starts anew: about 1 kB each, and a tile of the usual
/// side 32 has at most 1024 winners.
const KEPT_TRIANGLES: usize = 4096;

impl<'a> ExactStage<'a> {
    /// A stage that has computed nothing yet.
    pub(super) fn new(plane: &'a ImagePlane, mesh: &'a TriangleMesh) -> Self {
        Self { plane, mesh, triangles: HashMap::new(), depth_rows: HashMap::new(), candidate: None }
    }

    /// The exact rows of a triangle; `None` when V = 0.
    pub(super) fn triangle(&mut self, id: TriangleId) -> Option<Rc<ExactTriangle>> {
        if self.triangles.len() >= KEPT_TRIANGLES && !self.triangles.contains_key(&id) {
            self.triangles.clear();
        }
        self.triangles
            .entry(id)
            .or_insert_with(|| ExactTriangle::new(self.plane, self.mesh.triangle(id)).map(Rc::new))
            .clone()
    }

    /// Order of two triangles with V ≠ 0 at a sample. `None` would mean that one has V = 0.
    pub(super) fn depth_order(
        &mut self,
        candidate: TriangleId,
        nearest: TriangleId,
        pixel: Pixel,
    ) -> Option<DepthOrder> {
        if self.candidate != Some(candidate) {
            self.candidate = Some(candidate);
            self.depth_rows.clear();
        }
        if !self.depth_rows.contains_key(&nearest) {
            if same_plane(self.mesh, candidate, nearest) {
                return Some(DepthOrder { at_sample: Ordering::Equal, moved: Ordering::Equal });
            }
            let row = self.triangle(candidate)?.depth_row(self.triangle(nearest)?.as_ref());
            self.depth_rows.insert(nearest, row);
        }
        self.depth_rows.get(&nearest).map(|row| DepthOrder::from_row(row, pixel))
    }
}
