//! Intervals of f64 with outward rounding: three operations, no more.
//!
//! Each bound is computed to nearest and then moved one float outwards. Rounding to nearest is off
//! by at most half a step, in the subnormal range too, so the true result lies inside. Bounds stay
//! finite here: |v − e| < 2^128, hence products of two stay below 2^256, triple products with a
//! direction (|d| ≤ 2^300) below 2^560.

use crate::mutant::{self, Mutant};

/// All numbers from `lower` to `upper`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Interval {
    pub(super) lower: f64,
    pub(super) upper: f64,
}

impl Interval {
    /// What the rounded result of one operation can stand for.
    fn around(lower: f64, upper: f64) -> Self {
        Self { lower: lower.next_down(), upper: upper.next_up() }
    }

    /// The difference of two floats.
    pub(super) fn difference(a: f64, b: f64) -> Self {
        Self::around(a - b, a - b)
    }

    pub(super) fn plus(self, other: Self) -> Self {
        Self::around(self.lower + other.lower, self.upper + other.upper)
    }

    pub(super) fn minus(self, other: Self) -> Self {
        self.plus(other.negated())
    }

    pub(super) fn negated(self) -> Self {
        Self { lower: -self.upper, upper: -self.lower }
    }

    pub(super) fn times(self, other: Self) -> Self {
        let products = [
            self.lower * other.lower,
            self.lower * other.upper,
            self.upper * other.lower,
            self.upper * other.upper,
        ];
        let lower = products.into_iter().fold(f64::INFINITY, f64::min);
        let upper = products.into_iter().fold(f64::NEG_INFINITY, f64::max);
        Self::around(lower, upper)
    }

    /// An upper bound of the product with a float.
    pub(super) fn upper_times(self, factor: f64) -> f64 {
        let upper = (factor >= 0.0) != mutant::is(Mutant::DiscardDoubt);
        let bound = if upper { self.upper } else { self.lower };
        (bound * factor).next_up()
    }

    /// The sign of every number in it, or `None` when it holds 0.
    pub(super) fn sign(self) -> Option<i8> {
        if self.lower > 0.0 {
            Some(1)
        } else if self.upper < 0.0 {
            Some(-1)
        } else {
            None
        }
    }
}

pub(super) fn dot(a: [Interval; 3], b: [Interval; 3]) -> Interval {
    a[0].times(b[0]).plus(a[1].times(b[1])).plus(a[2].times(b[2]))
}

pub(super) fn cross(a: [Interval; 3], b: [Interval; 3]) -> [Interval; 3] {
    [
        a[1].times(b[2]).minus(a[2].times(b[1])),
        a[2].times(b[0]).minus(a[0].times(b[2])),
        a[0].times(b[1]).minus(a[1].times(b[0])),
    ]
}

#[cfg(test)]
mod tests {
    use super::super::rational::{self, exact};
    use super::*;

    fn contains(interval: Interval, value: &dashu_ratio::Relaxed) -> bool {
        exact(interval.lower) <= *value && *value <= exact(interval.upper)
    }

    /// Numbers whose products and differences round, cancel, underflow or vanish.
    const VALUES: [f64; 8] =
        [0.0, 1.0, -0.1, 1.000_000_000_000_000_2, 5e-324, -1e-170, 8.5e37, -8.5e37];

    #[test]
    fn every_operation_encloses_the_exact_result() {
        for a in VALUES {
            for b in VALUES {
                let (left, right) = (Interval::difference(a, b), Interval::difference(b, 0.3));
                let (x, y) = (exact(a) - exact(b), exact(b) - exact(0.3));
                assert!(contains(left, &x));
                assert!(contains(left.plus(right), &(&x + &y)));
                assert!(contains(left.minus(right), &(&x - &y)));
                assert!(contains(left.times(right), &(&x * &y)));
                for factor in VALUES {
                    assert!(exact(left.upper_times(factor)) >= &x * exact(factor));
                }
            }
        }
    }

    #[test]
    fn a_determinant_of_dependent_vectors_has_no_sign() {
        let corner = |v: [f64; 3]| v.map(|c| Interval::difference(c, 0.1));
        let (a, b, c) = (corner([1.1, 2.1, 3.1]), corner([2.1, 4.1, 6.1]), corner([5.1, 0.1, 0.3]));
        let determinant = dot(a, cross(b, c));
        let x = [[1.1, 2.1, 3.1], [2.1, 4.1, 6.1], [5.1, 0.1, 0.3]]
            .map(|v| rational::subtract(&rational::exact_vector(v), &[0.1; 3].map(exact)));
        assert!(contains(determinant, &rational::dot(&x[0], &rational::cross(&x[1], &x[2]))));
        assert_eq!(determinant.sign(), None);
        assert_eq!(dot(a, a).sign(), Some(1));
        assert_eq!(dot(a, a.map(Interval::negated)).sign(), Some(-1));
    }
}
