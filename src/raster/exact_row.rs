//! An integer row (A, B, C) and the exact sign and value of A·x + B·y + C at a sample.
//!
//! Wide rows carry a copy cut to what i128 holds, which decides almost always; the wide integers
//! decide the rest. What a row means (an edge, a plane, a depth comparison) is its caller's matter.

use super::dyadic::{Scaled, sign, truncated};
use crate::mutant::{self, Mutant};
use crate::pixel::Pixel;
use dashu_int::IBig;
use dashu_int::ops::BitTest;
use std::cmp::Ordering;

/// Most bits of A and B, and of 2C, in the i128 copy. The doubled sample coordinates 2x and 2y are
/// below 2^17 (`pixel::MAX_SIDE` is 2^16), so |A·2x| + |B·2y| + |2C| < 3·2^125 < 2^127.
pub(super) const SLOPE_BITS: usize = 108;
pub(super) const OFFSET_BITS: usize = 125;

/// A row A·x + B·y + C with integer coefficients.
pub(super) struct ExactRow {
    /// (A, B, 2C)·2^-`drop`, cut towards zero.
    short: [i128; 3],
    /// Bits cut off `short`; 0 where `short` is the row itself.
    drop: usize,
    /// (A, B, 2C), kept only where `drop` is not 0.
    wide: Option<Box<[IBig; 3]>>,
    /// The caller's row is this one times 2^`exponent`.
    exponent: i64,
}

impl ExactRow {
    /// Takes a row over; its common power of two is kept aside.
    pub(super) fn new([a, b, c]: [IBig; 3]) -> Self {
        // Strip the common power of two of A, B and 2C, then double coordinates instead of halves:
        // A·x + B·y + C = (A·2x + B·2y + 2C)/2.
        let c = c << 1;
        let zeros = |v: &IBig| v.trailing_zeros().unwrap_or(usize::MAX);
        let common = zeros(&a).min(zeros(&b)).min(zeros(&c));
        let common = if common == usize::MAX { 0 } else { common };
        let wide = if common == 0 { [a, b, c] } else { [a, b, c].map(|v| v >> common) };
        let drop = wide[0]
            .bit_len()
            .max(wide[1].bit_len())
            .saturating_sub(SLOPE_BITS)
            .max(wide[2].bit_len().saturating_sub(OFFSET_BITS));
        let short = [0, 1, 2].map(|k| truncated(&wide[k], drop));
        Self { short, drop, wide: (drop > 0).then(|| Box::new(wide)), exponent: common as i64 - 1 }
    }

    /// [`Self::new`] for coefficients below 2^126 in magnitude.
    pub(super) fn from_short([a, b, c]: [i128; 3]) -> Self {
        let c = c << 1;
        let common = (a | b | c).trailing_zeros() & 127;
        let short = [a, b, c].map(|v| v >> common);
        let bits = |v: i128| (128 - v.unsigned_abs().leading_zeros()) as usize;
        if bits(short[0]).max(bits(short[1])) > SLOPE_BITS || bits(short[2]) > OFFSET_BITS {
            return Self::new([IBig::from(a), IBig::from(b), IBig::from(c >> 1)]);
        }
        Self { short, drop: 0, wide: None, exponent: i64::from(common) - 1 }
    }

    /// Exact sign at the sample itself: −1, 0 or 1.
    pub(super) fn sign_at(&self, pixel: Pixel) -> i32 {
        let (value, error) = self.short_at(pixel);
        match &self.wide {
            Some(wide) if value.abs() <= error => sign(&evaluate(wide, pixel)),
            _ => value.signum() as i32,
        }
    }

    /// The tie rule: the first nonzero of `sign_at` (given), sgn A and sgn B, which is the sign at
    /// the sample moved by (+ε, +ε²), because a move by ε in x adds ε·A. 0 only for the zero row.
    pub(super) fn moved_sign(&self, sign_at: i32) -> i32 {
        let slope = |k: usize| match &self.wide {
            Some(wide) => sign(&wide[k]),
            None => self.short[k].signum() as i32,
        };
        mutant::moves([sign_at, slope(0), slope(1)]).into_iter().find(|&s| s != 0).unwrap_or(0)
    }

    /// The value at the sample; relative error at most 2^-52.
    pub(super) fn value_at(&self, pixel: Pixel) -> Scaled {
        let (value, error) = self.short_at(pixel);
        // The cut error is below 2^18 units: relative to 2^72 units at most 2^-54, and rounding to
        // f64 adds 2^-53. Nearer to 0 the wide row is evaluated (2^-53 + 2^-126).
        let mut scaled = match &self.wide {
            Some(wide) if value.unsigned_abs().leading_zeros() > 128 - 73 => {
                debug_assert!(error < 1 << 18);
                Scaled::from_integer(&evaluate(wide, pixel))
            }
            _ => Scaled { mantissa: value as f64, exponent: self.drop as i64 },
        };
        scaled.exponent += self.exponent;
        scaled
    }

    /// The i128 row at the sample and a bound of what cutting its coefficients changed: each is
    /// off by less than 1, so the value by less than 2x + 2y + 1. The bound is 0 where nothing was cut.
    fn short_at(&self, pixel: Pixel) -> (i128, i128) {
        let [x2, y2] = doubled(pixel);
        let value = self.short[0] * x2 + self.short[1] * y2 + self.short[2];
        (value, if self.drop == 0 { 0 } else { x2 + y2 + 1 })
    }
}

/// Twice the sample's coordinates: 2i + 1 and 2j + 1.
pub(super) fn doubled(pixel: Pixel) -> [i128; 2] {
    let half = i128::from(!mutant::is(Mutant::CornerSamples));
    [i128::from(pixel.x) * 2 + half, i128::from(pixel.y) * 2 + half]
}

fn evaluate(wide: &[IBig; 3], pixel: Pixel) -> IBig {
    let [x2, y2] = doubled(pixel);
    &wide[0] * x2 + &wide[1] * y2 + &wide[2]
}

/// How a candidate and the triangle that was nearest so far lie at a sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct DepthOrder {
    /// `Less`: the candidate is nearer at the sample itself; `Equal`: exactly the same depth.
    pub(super) at_sample: Ordering,
    /// `Less`: the candidate wins under the tie rule; `Equal`: the planes are the same.
    pub(super) moved: Ordering,
}

impl DepthOrder {
    /// Reads the row of F, whose negative sign puts the candidate first.
    pub(super) fn from_row(row: &ExactRow, pixel: Pixel) -> Self {
        let at_sample = row.sign_at(pixel);
        Self { at_sample: at_sample.cmp(&0), moved: row.moved_sign(at_sample).cmp(&0) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_short_row_never_contradicts_the_wide_one() {
        // Rows through (or 2^-k units beside) samples, with coefficients of 40 to 700 bits.
        let mut wide_decisions = 0;
        for bits in [0, 60, 90, 100, 130, 300, 660] {
            let a = (IBig::from(0x1234_5678_9abc_i64) << bits) + IBig::from(bits as i64);
            let b = IBig::from(-0x0fed_cba9_8765_i64) << (bits + 3);
            for pixel in [Pixel { x: 0, y: 0 }, Pixel { x: 13, y: 7 }, Pixel { x: 65_535, y: 1 }] {
                let [x2, y2] = doubled(pixel);
                let minus_c2 = &a * x2 + &b * y2;
                // 2C is even: shift the whole row by one.
                for offset in [-1_i64, 0, 1] {
                    let row = [&a << 1, &b << 1, -&minus_c2 + IBig::from(offset)];
                    let row = ExactRow::new(row);
                    assert_eq!(row.sign_at(pixel), offset as i32, "{bits} {pixel:?}");
                    assert_eq!(row.value_at(pixel).value(), offset as f64);
                    wide_decisions += usize::from(row.wide.is_some());
                }
            }
        }
        assert!(wide_decisions > 20);
    }

    #[test]
    fn short_coefficients_give_the_same_row() {
        let mut wide = 0;
        for shift in [0, 3, 40, 70, 92] {
            for row in [[0, 0, 0], [12, -8, 20], [-1, 0, 1], [0x1_2345_6789, -77, 1 << 33]] {
                let row: [i128; 3] = row.map(|c: i128| (c << shift) - (c & 1) * i128::from(shift));
                let (a, b) = (ExactRow::from_short(row), ExactRow::new(row.map(IBig::from)));
                assert_eq!((a.short, a.drop, a.exponent), (b.short, b.drop, b.exponent));
                assert_eq!(a.wide, b.wide);
                wide += usize::from(a.wide.is_some());
            }
        }
        assert!(wide > 0);
    }
}
