//! Numbers m·2^e: how f64 become integers for the exact stage, and how integers come back.
//!
//! Nothing geometric lives here.

use dashu_int::ops::{BitTest, UnsignedAbs};
use dashu_int::{IBig, Sign};

/// A finite f64 as `mantissa · 2^exponent`; the mantissa is odd, or 0 with exponent `i64::MAX`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Dyadic {
    mantissa: i64,
    /// Power of two.
    pub(super) exponent: i64,
}

impl Dyadic {
    /// Takes a finite number apart.
    pub(super) fn new(value: f64) -> Self {
        let bits = value.to_bits();
        let biased = (bits >> 52) & 0x7ff;
        let fraction = (bits & ((1 << 52) - 1)) as i64;
        // Subnormal numbers have the exponent of biased 1 and no hidden bit.
        let (magnitude, exponent) = match biased {
            0 => (fraction, -1074),
            _ => (fraction | 1 << 52, biased as i64 - 1075),
        };
        if magnitude == 0 {
            return Self { mantissa: 0, exponent: i64::MAX };
        }
        let zeros = magnitude.trailing_zeros();
        let mantissa = magnitude >> zeros;
        Self {
            mantissa: if value < 0.0 { -mantissa } else { mantissa },
            exponent: exponent + i64::from(zeros),
        }
    }

    /// The value in units of 2^`unit`, which must not be above the exponent of a nonzero number.
    pub(super) fn in_units(self, unit: i64) -> IBig {
        if self.mantissa == 0 {
            return IBig::ZERO;
        }
        debug_assert!(self.exponent >= unit);
        IBig::from(self.mantissa) << (self.exponent - unit) as usize
    }

    /// The same, or `None` when it may need more than 64 bits.
    pub(super) fn in_short_units(self, unit: i64) -> Option<i128> {
        if self.mantissa == 0 {
            return Some(0);
        }
        debug_assert!(self.exponent >= unit);
        let shift = self.exponent - unit;
        let bits = 64 - i64::from(self.mantissa.unsigned_abs().leading_zeros());
        (bits + shift <= 64).then(|| i128::from(self.mantissa) << shift)
    }
}

/// A real number as `mantissa · 2^exponent`, for magnitudes outside the range of f64.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scaled {
    /// An f64 of moderate size.
    pub(super) mantissa: f64,
    /// Power of two.
    pub(super) exponent: i64,
}

impl Scaled {
    /// A wide integer, rounded: relative error at most u + 2^-126 (u = 2^-53). The top 128 bits
    /// are kept, which drops less than 2^-127 of the value, and then rounded to nearest.
    pub(super) fn from_integer(value: &IBig) -> Self {
        let drop = value.bit_len().saturating_sub(127);
        let top = truncated(value, drop);
        Self { mantissa: top as f64, exponent: drop as i64 }
    }

    /// As an f64: exact while the result is a normal number.
    pub(super) fn value(self) -> f64 {
        // A power of two per step, each inside the range of normal numbers.
        let (mut value, mut left) = (self.mantissa, self.exponent);
        while left != 0 && value != 0.0 && value.is_finite() {
            let step = left.clamp(-1000, 1000);
            value *= f64::from_bits(((1023 + step) as u64) << 52);
            left -= step;
        }
        value
    }
}

/// `value / 2^drop`, cut towards zero; what is left must have at most 127 bits.
pub(super) fn truncated(value: &IBig, drop: usize) -> i128 {
    let magnitude = value.unsigned_abs() >> drop;
    let magnitude = u128::try_from(magnitude).map_or(i128::MAX, |m| m as i128);
    if value.sign() == Sign::Negative { -magnitude } else { magnitude }
}

/// −1, 0 or 1.
pub(super) fn sign(value: &IBig) -> i32 {
    if value.is_zero() {
        0
    } else if value.sign() == Sign::Negative {
        -1
    } else {
        1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_survive_the_way_to_integers_and_back() {
        for value in [1.0, -1.5, 3e38, -1.4e-45, 5e-324, 1.2, -0.1, 2.0_f64.powi(-96)] {
            let dyadic = Dyadic::new(value);
            let integer = dyadic.in_units(dyadic.exponent - 200);
            let mut back = Scaled::from_integer(&integer);
            back.exponent += dyadic.exponent - 200;
            assert_eq!(back.value(), value);
        }
        assert_eq!(Dyadic::new(-0.0).in_units(-1074), IBig::ZERO);
    }

    #[test]
    fn truncation_goes_towards_zero() {
        for value in [-1029_i64, -1024, -5, 0, 5, 1023, 1029] {
            assert_eq!(truncated(&IBig::from(value), 3), i128::from(value / 8));
        }
    }
}
