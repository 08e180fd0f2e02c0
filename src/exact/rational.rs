//! Exact numbers: rationals, vectors of them, their signs, and the way back to f64.
//!
//! Every f64 is a fraction whose denominator is a power of two. Sums and products of such fractions
//! are again of that kind, so [`Relaxed`], which cancels only powers of two, holds them in lowest
//! terms without ever looking for a common divisor. Only t and the corner weights are true
//! quotients; they are formed last and leave as f64.

use dashu_int::Sign;
use dashu_ratio::Relaxed;

/// A vector of exact numbers.
pub(super) type Vector = [Relaxed; 3];

/// The exact value of a finite f64.
pub(super) fn exact(value: f64) -> Relaxed {
    Relaxed::try_from(value).expect("scenes and cameras hold finite numbers")
}

/// The exact values of three finite f64.
pub(super) fn exact_vector(values: [f64; 3]) -> Vector {
    values.map(exact)
}

pub(super) fn subtract(a: &Vector, b: &Vector) -> Vector {
    std::array::from_fn(|k| &a[k] - &b[k])
}

pub(super) fn scale(a: &Vector, factor: &Relaxed) -> Vector {
    std::array::from_fn(|k| &a[k] * factor)
}

pub(super) fn add(a: &Vector, b: &Vector) -> Vector {
    std::array::from_fn(|k| &a[k] + &b[k])
}

pub(super) fn dot(a: &Vector, b: &Vector) -> Relaxed {
    &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
}

pub(super) fn cross(a: &Vector, b: &Vector) -> Vector {
    [&a[1] * &b[2] - &a[2] * &b[1], &a[2] * &b[0] - &a[0] * &b[2], &a[0] * &b[1] - &a[1] * &b[0]]
}

/// −1, 0 or +1.
pub(super) fn sign(value: &Relaxed) -> i8 {
    match value.sign() {
        Sign::Negative => -1,
        Sign::Positive => i8::from(!value.is_zero()),
    }
}

/// The f64 nearest to an exact number.
pub(super) fn nearest_f64(value: &Relaxed) -> f64 {
    value.to_f64().value()
}

/// The largest f64 at or below and the smallest f64 at or above an exact number in the range of
/// f64: equal when it is an f64, neighbours otherwise. The rounding is not trusted but compared
/// with the number itself.
pub(super) fn bounds_f64(value: &Relaxed) -> (f64, f64) {
    let mut lower = nearest_f64(value);
    // Step down to the last float at or below the number, then up as long as that stays so.
    while exact(lower) > *value {
        lower = lower.next_down();
    }
    while exact(lower.next_up()) <= *value {
        lower = lower.next_up();
    }
    let upper = if exact(lower) == *value { lower } else { lower.next_up() };
    (lower, upper)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_are_equal_for_floats_and_neighbours_otherwise() {
        for float in [0.1, -0.1, 1.0, 5e-324, -5e-324, 2.0_f64.powi(-1022), 1e300] {
            assert_eq!(bounds_f64(&exact(float)), (float, float));
        }
        for (numerator, denominator) in [(1.0, 3.0), (-1.0, 3.0), (2.0, 3.0), (1e20, 7.0)] {
            let value = exact(numerator) / exact(denominator);
            let (lower, upper) = bounds_f64(&value);
            assert_eq!(upper, lower.next_up());
            assert!(exact(lower) < value && value < exact(upper));
        }
        // Just beside a float, far below its last bit.
        let value = exact(1.0) - exact(2.0_f64.powi(-900));
        assert_eq!(bounds_f64(&value), (1.0_f64.next_down(), 1.0));
        let value = exact(1.0) + exact(2.0_f64.powi(-900));
        assert_eq!(bounds_f64(&value), (1.0, 1.0_f64.next_up()));
    }

    #[test]
    fn signs_know_zero() {
        assert_eq!([-0.0, 0.0, 1e-300, -1e-300].map(|v| sign(&exact(v))), [0, 0, 1, -1]);
        assert_eq!(sign(&(exact(0.1) + exact(0.2) - exact(0.3))), 1, "0.1 + 0.2 > 0.3 in binary");
    }
}
