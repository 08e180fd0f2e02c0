//! A visible triangle's integer rows, cut to 128 bits: what the answer's weights and t are computed
//! from.
//!
//! The numbers are those of `exact`, bit for bit (`ExactRow::value_at`, `ExactTriangle::t_at`); only
//! the way to them is shorter: integers of fixed width, and rows split into digits of 34 bits, whose
//! products with doubled sample coordinates (below 2^17) and sums are exact in f64. Where the cut
//! matters, or numbers are too long, there is no such value, and the exact stage is asked.

use super::dyadic::{Dyadic, Scaled, sign};
use super::exact_row::{OFFSET_BITS, SLOPE_BITS};
use super::image_plane::ImagePlane;
use super::limbs::Wide;
use fearless_simd::f64x8;
use fearless_simd::prelude::*;

/// Digits of a row's coefficients, lowest first, in units of their own powers of two.
struct Digits {
    a: [f64; 4],
    b: [f64; 4],
    c: [f64; 4],
    /// Values below this may not be what the uncut row gives to f64's accuracy.
    least: f64,
}

/// Bits of a digit.
const DIGIT: i64 = 34;

/// The units of the digits.
const UNITS: [f64; 4] = [1.0, (1_u128 << 34) as f64, (1_u128 << 68) as f64, (1_u128 << 102) as f64];

/// As in `ExactRow::value_at`: cut rows are off by less than 2^18, 2^-54 of this.
const LEAST_OF_CUT: f64 = (1_u128 << 72) as f64;

/// Powers of two beyond which f64 would need more than one step.
const MOST_EXPONENT: i64 = 900;

/// The rows of a triangle for its visible samples.
pub(super) struct Shown {
    /// sgn V, ±1.
    pub(super) volume_sign: i32,
    /// Edge rows 0, 1, 2 and the plane's row.
    rows: [Digits; 4],
    /// Weight k is row k over the plane's row, times this.
    weight_units: [f64; 3],
    /// t is this over the plane's row, times `t_unit`.
    ray_parameter: f64,
    t_unit: f64,
}

impl Shown {
    /// `None` where V = 0 or numbers are too long.
    pub(super) fn new(plane: &ImagePlane, corners: [[f32; 3]; 3]) -> Option<Self> {
        let exact = &plane.exact;
        let corners = corners.map(|v| v.map(|c| Dyadic::new(f64::from(c))));
        let numbers = corners.as_flattened().iter().chain(&exact.eye);
        let unit = numbers.map(|c| c.exponent).min().filter(|&unit| unit != i64::MAX)?;
        // X_i = adj(P)·(v_i − e): |v − e| below 2^63, adj(P) below 2^107, X below 2^172.
        let mut points = [[Wide::<3>::ZERO; 3]; 3];
        for (corner, point) in corners.iter().zip(&mut points) {
            let mut a = [Wide::<2>::ZERO; 3];
            for k in 0..3 {
                let value = corner[k].in_short_units(unit)? - exact.eye[k].in_short_units(unit)?;
                if value.unsigned_abs() >> 63 != 0 {
                    return None;
                }
                a[k] = Wide::from_i128(value);
            }
            for (row, x) in exact.adjugate_short.iter().zip(point) {
                let term = |k: usize| -> Wide<3> { Wide::<2>::from_i128(row[k]).times(&a[k]) };
                *x = term(0).plus(&term(1)).plus(&term(2));
            }
        }
        // Rows below 2^346, V below 2^520.
        let [x0, x1, x2] = &points;
        let edges = [cross(x1, x2), cross(x2, x0), cross(x0, x1)];
        let term = |k: usize| -> Wide<9> { x0[k].times(&edges[0][k]) };
        let volume = term(0).plus(&term(1)).plus(&term(2));
        let volume_sign = volume.sign();
        if volume_sign == 0 {
            return None;
        }
        let determinant = Scaled::from_integer(&exact.determinant);
        let flip = volume_sign * sign(&exact.determinant) < 0;
        let edges = edges.map(|row| row.map(|c| c.negated_if(flip)));
        let sum = [0, 1, 2].map(|k| edges[0][k].plus(&edges[1][k]).plus(&edges[2][k]));
        let [e0, e1, e2] = &edges;
        let [(r0, p0), (r1, p1), (r2, p2), (r3, p3)] = [e0, e1, e2, &sum].map(digits);
        // As `exact::ray_parameter`.
        let drop = volume.bits().saturating_sub(127);
        let mantissa = volume.truncated(drop).unsigned_abs() as f64;
        let exponent = drop as i64 - determinant.exponent + exact.adjugate_exponent + unit
            - exact.lattice_exponent;
        Some(Self {
            volume_sign,
            rows: [r0, r1, r2, r3],
            weight_units: [power(p0 - p3)?, power(p1 - p3)?, power(p2 - p3)?],
            ray_parameter: mantissa / determinant.mantissa.abs(),
            t_unit: power(exponent - p3)?,
        })
    }

    /// Weights and t at eight samples, and the lanes at which they are known; `x2` and `y2` are the
    /// samples' doubled coordinates.
    #[inline(always)]
    pub(super) fn at<S: Simd>(
        &self,
        simd: S,
        x2: f64x8<S>,
        y2: f64x8<S>,
    ) -> ([f64x8<S>; 3], f64x8<S>, u64) {
        let [r0, r1, r2, r3] = &self.rows;
        let (v0, known0) = r0.at(simd, x2, y2);
        let (v1, known1) = r1.at(simd, x2, y2);
        let (v2, known2) = r2.at(simd, x2, y2);
        let (sum, known3) = r3.at(simd, x2, y2);
        let [u0, u1, u2] = self.weight_units;
        let weights = [v0 / sum * u0, v1 / sum * u1, v2 / sum * u2];
        let t = f64x8::splat(simd, self.ray_parameter) / sum * self.t_unit;
        (weights, t, known0 & known1 & known2 & known3)
    }
}

impl Digits {
    /// Values, rounded once, and the lanes at which the cut does not matter.
    #[inline(always)]
    fn at<S: Simd>(&self, simd: S, x2: f64x8<S>, y2: f64x8<S>) -> (f64x8<S>, u64) {
        // Exact: two products below 2^51, a digit, in the digit's unit.
        let p0 = x2 * self.a[0] + y2 * self.b[0] + self.c[0];
        let p1 = x2 * self.a[1] + y2 * self.b[1] + self.c[1];
        let p2 = x2 * self.a[2] + y2 * self.b[2] + self.c[2];
        let p3 = x2 * self.a[3] + y2 * self.b[3] + self.c[3];
        // Nothing is lost in the first pass; in the second the parts of what it left are added.
        let (s, e0) = two_sum(p1, p0);
        let (s, e1) = two_sum(p2, s);
        let (s, e2) = two_sum(p3, s);
        let (e, f0) = two_sum(e1, e0);
        let (e, f1) = two_sum(e2, e);
        let (s, f2) = two_sum(s, e);
        let value = s + (f2 + (f1 + f0));
        (value, value.abs().simd_ge(f64x8::splat(simd, self.least)).to_bitmask())
    }
}

/// a + b rounded, and what the rounding took away, exactly (Knuth).
#[inline(always)]
fn two_sum<S: Simd>(a: f64x8<S>, b: f64x8<S>) -> (f64x8<S>, f64x8<S>) {
    let sum = a + b;
    let other = sum - a;
    (sum, (a - (sum - other)) + (b - other))
}

/// (A, B, 2C) of a row without its common power of two, cut as `ExactRow::new` cuts it, and the
/// exponent of its unit.
fn digits(row: &[Wide<6>; 3]) -> (Digits, i64) {
    let two = Wide::<2>::from_i128(2);
    let row = [row[0], row[1], row[2].times(&two)];
    let common = row.iter().filter_map(Wide::trailing_zeros).min().unwrap_or(0);
    let bits = |k: usize| row[k].bits().saturating_sub(common);
    let drop =
        bits(0).max(bits(1)).saturating_sub(SLOPE_BITS).max(bits(2).saturating_sub(OFFSET_BITS));
    let [a, b, c] = [0, 1, 2].map(|k| split(row[k].truncated(common + drop)));
    let least = if drop > 0 { LEAST_OF_CUT } else { 0.0 };
    (Digits { a, b, c, least }, (common + drop) as i64 - 1)
}

/// The digits of a number: lower ones 0…2^34 − 1, the highest with its sign, each times its unit.
fn split(value: i128) -> [f64; 4] {
    std::array::from_fn(|place| {
        let rest = value >> (place as i64 * DIGIT);
        let digit = if place < 3 { rest & ((1 << DIGIT) - 1) } else { rest };
        // Of 34 bits, the highest of 26: i64 holds it, and its conversion is one instruction.
        digit as i64 as f64 * UNITS[place]
    })
}

/// 2^exponent, or `None` where it is no usual number.
fn power(exponent: i64) -> Option<f64> {
    (exponent.abs() <= MOST_EXPONENT).then(|| f64::from_bits(((1023 + exponent) as u64) << 52))
}

fn cross(a: &[Wide<3>; 3], b: &[Wide<3>; 3]) -> [Wide<6>; 3] {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| {
        let (first, second): (Wide<6>, Wide<6>) = (a[i].times(&b[j]), a[j].times(&b[i]));
        first.plus(&second.negated_if(true))
    })
}
