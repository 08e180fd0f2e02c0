//! Hemisphere light: how much of the top colour a normal receives.
//!
//! Source: CS315, "Illumination 2", which gives three different curves: the sine form as "the
//! proper equation", the cosine form "without too much error", and, in words, a linear blend over
//! the angle. The sine and the cosine form differ by up to (√2 − 1)/2 = 0.2071 (at 45° and 135°),
//! the linear one lies between them, at most 0.1053 from each.

use super::vector;
use crate::scene::switches::HemisphereCurve;

/// a: 1 for a normal towards `up`, 0 for one away from it. `up` is unit; so is the normal, or it
/// is shorter where it was interpolated and left so.
///
/// sin θ is |N × up|, which keeps its digits at the poles where √(1 − cos²θ) loses them or is NaN.
pub fn top_share(curve: HemisphereCurve, normal: [f64; 3], up: [f64; 3]) -> f64 {
    let cosine = vector::dot(normal, up);
    let sine = || vector::squared_length(vector::cross(normal, up)).sqrt();
    match curve {
        HemisphereCurve::Cosine => 0.5 + 0.5 * cosine,
        HemisphereCurve::Sine if cosine >= 0.0 => 1.0 - 0.5 * sine(),
        HemisphereCurve::Sine => 0.5 * sine(),
        HemisphereCurve::Linear => 1.0 - libm::atan2(sine(), cosine) / std::f64::consts::PI,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use HemisphereCurve::{Cosine, Linear, Sine};

    const UP: [f64; 3] = [0.0, 1.0, 0.0];

    fn at(curve: HemisphereCurve, degrees: f64) -> f64 {
        let angle = degrees.to_radians();
        top_share(curve, [libm::sin(angle), libm::cos(angle), 0.0], UP)
    }

    // C15: 1 − cos² under the root is NaN for a normal of length 1 + 1e-7, and 0 beside the pole.
    #[test]
    fn c15_the_sine_form_keeps_its_digits_at_the_pole() {
        assert!(top_share(Sine, [0.0, 1.000_000_1, 0.0], UP) == 1.0);
        let near = vector::unit([1e-4, 1.0, 2e-4]).unwrap();
        // 1 − ½·√5·1e-4 to the third power of the angle.
        assert!((top_share(Sine, near, UP) - 0.999_888_196_6).abs() < 1e-10);
        let near = vector::unit([3e-4, 1.0, 0.0]).unwrap();
        assert!((top_share(Sine, near, UP) - 0.999_85).abs() < 1e-10);
    }

    #[test]
    fn the_poles_and_the_equator_are_exact() {
        for curve in [Cosine, Sine, Linear] {
            assert_eq!(top_share(curve, UP, UP), 1.0);
            assert_eq!(top_share(curve, [0.0, -1.0, 0.0], UP), 0.0);
            assert_eq!(top_share(curve, [1.0, 0.0, 0.0], UP), 0.5);
        }
    }

    // C16 and the text's "without too much error": the largest differences by scanning.
    #[test]
    fn c16_the_curves_differ_by_as_much_as_is_said() {
        let worst = |a, b| {
            (0..=1800)
                .map(|i| (at(a, f64::from(i) * 0.1) - at(b, f64::from(i) * 0.1)).abs())
                .fold(0.0, f64::max)
        };
        assert!((worst(Sine, Cosine) - (2.0_f64.sqrt() - 1.0) / 2.0).abs() < 1e-12);
        assert!((worst(Sine, Linear) - 0.1053).abs() < 5e-5);
        assert!((worst(Cosine, Linear) - 0.1053).abs() < 5e-5);
    }
}
