//! The specular lobe of Blinn and Phong, in forms that stay right at any exponent.
//!
//! A cosine near 1 loses the angle: cos θ = 1 − θ²/2 keeps nothing of θ below 1e-8 even in f64.
//! So the lobes are functions of q = 1 − cos θ = |a − b|²/2 for unit a and b, which keeps all
//! digits and cannot be negative: the lobe cannot exceed 1. Source: Curless, "Shading", with
//! Blinn, "Models of Light Reflection for Computer Synthesized Pictures" (1977) for H.
//!
//! No gate by N·L lives here; see `equation`.

use super::power;
use super::vector;

/// Below this |L + V|² there is no halfway vector: L and V are unit to 5·2^-53, so L + V has an
/// error of up to 1e-15, and at a length of 1e-12 its direction is still good to a milliradian;
/// no limit exists at L = −V, where the specular term is defined as 0.
pub(super) const OPPOSITE_SQUARED: f64 = 1e-24;

/// 1 − cos of the angle between two unit vectors, with full relative accuracy; never negative.
#[inline]
pub(super) fn one_minus_cosine(a: [f64; 3], b: [f64; 3]) -> f64 {
    0.5 * vector::squared_length(vector::sub(a, b))
}

/// (cos θ)_+^exponent from q = 1 − cos θ; x^0 is 1 for every x, also for 0.
///
/// 1 at q = 0, 0 for q ≥ 1 and a positive exponent, never above 1, and never NaN.
#[inline]
pub(super) fn lobe(q: f64, exponent: f64) -> f64 {
    if exponent == 0.0 {
        1.0
    } else if q >= 1.0 {
        0.0
    } else {
        power::power(q, exponent)
    }
}

/// (|N|·cos θ)_+^exponent for a vector whose length was left below 1: `length` in 0…1.
#[inline]
pub(super) fn shortened_lobe(q: f64, length: f64, exponent: f64) -> f64 {
    if length == 1.0 {
        lobe(q, exponent)
    } else if exponent == 0.0 {
        1.0
    } else if q >= 1.0 || length <= 0.0 {
        0.0
    } else {
        power::exp2(exponent * (power::log2_of_complement(q) + libm::log2(length)))
    }
}

/// H, the unit vector halfway between two unit vectors; `None` where they are opposite.
#[inline]
pub fn halfway(l: [f64; 3], v: [f64; 3]) -> Option<[f64; 3]> {
    let sum = vector::add(l, v);
    let squared = vector::squared_length(sum);
    if squared < OPPOSITE_SQUARED {
        return None;
    }
    let inverse = 1.0 / squared.sqrt();
    Some(sum.map(|c| c * inverse))
}

/// Blinn-Phong's lobe (N·H)_+^ns for unit vectors, ns ≥ 0; 0 where L = −V. Not gated by N·L.
pub fn blinn_specular(n: [f64; 3], l: [f64; 3], v: [f64; 3], ns: f64) -> f64 {
    halfway(l, v).map_or(0.0, |h| lobe(one_minus_cosine(n, h), ns))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at_angle(theta: f64) -> [f64; 3] {
        [theta.sin(), 0.0, theta.cos()]
    }

    // C1: powers of an f32 cosine give 1.0, 0.3036 and 0.6207 for the first three.
    #[test]
    fn c1_sharp_lobes_keep_their_digits() {
        let north = [0.0, 0.0, 1.0];
        for (theta, ns, right) in [
            (1e-4, 1e8, 0.60653),
            (3e-4, 1e7, 0.63763),
            (1e-3, 1e6, 0.60653),
            (1e-7, 1e14, 0.60653),
        ] {
            let value = lobe(one_minus_cosine(north, at_angle(theta)), ns);
            assert!((value - right).abs() < 1e-5, "{theta} {ns}: {value}");
            // cos^ns θ = exp(−ns·(θ²/2 + θ⁴/12 + …)); the next term is ns·θ⁶/45 < 1e-13 here.
            let series = (-ns * (theta * theta / 2.0 + theta.powi(4) / 12.0)).exp();
            // Conditioning: √(ns/e) times the rounding of the angle, 2^-53·θ, and of exp.
            assert!((value / series - 1.0).abs() < 2e-13, "{theta} {ns}: {value} {series}");
        }
    }

    // C2: f32 unit vectors reach n·n = 1.0000002, and ^1e8 makes 2.26e10 of it.
    #[test]
    fn c2_no_lobe_exceeds_one() {
        let f = f64::from(0.577_350_3_f32);
        for n in [[f; 3], [0.6, 0.8, 0.0], [1.0 + 1e-7, 0.0, 0.0]] {
            for ns in [1.0, 1e4, 1e8, 1e300, f64::MAX] {
                let value = lobe(one_minus_cosine(n, n), ns);
                assert!(value <= 1.0 && value > 0.99, "{n:?} {ns}: {value}");
            }
        }
    }

    // C3: powf(0, 0) is left open by shading languages and powf(-0.1, 2.5) is NaN.
    #[test]
    fn c3_zero_exponents_and_hidden_lobes_are_defined() {
        for q in [0.0, 0.5, 1.0, 1.1, 2.0] {
            assert_eq!(lobe(q, 0.0), 1.0);
        }
        assert_eq!(lobe(1.1, 2.5), 0.0);
        assert_eq!(lobe(1.0, 1e-300), 0.0);
        assert_eq!(lobe(0.5, 1.0), 0.5);
        assert_eq!(lobe(1e-3, f64::MAX), 0.0);
    }

    // C4: l = (3, 4+5ε, .1), v = (−3, −4, −.1). In the limit ε → 0, L + V points along the part of
    // (0, 1, 0) that is orthogonal to l. f32 is wrong by 0.1° at 1e-6 and by 8.2° at 1e-7.
    #[test]
    fn c4_halfway_of_nearly_opposite_directions() {
        let l0 = vector::unit([3.0, 4.0, 0.1]).unwrap();
        let along = vector::scaled(l0, l0[1]);
        let limit = vector::unit(vector::sub([0.0, 1.0, 0.0], along)).unwrap();
        let v = vector::unit([-3.0, -4.0, -0.1]).unwrap();
        for epsilon in [1e-6, 1e-7, 1e-8] {
            let l = vector::unit([3.0, 4.0 + 5.0 * epsilon, 0.1]).unwrap();
            let h = halfway(l, v).unwrap();
            let angle = vector::squared_length(vector::sub(h, limit)).sqrt();
            // The curve itself leaves the limit by about ε; rounding adds 4·2^-53/|L + V|.
            assert!(angle < 2.0 * epsilon + 4e-15 / epsilon, "{epsilon:e}: {angle:e} rad");
        }
        assert_eq!(halfway([0.6, 0.8, 0.0], [-0.6, -0.8, 0.0]), None);
        assert_eq!(blinn_specular([0.0, 0.0, 1.0], [0.6, 0.8, 0.0], [-0.6, -0.8, -0.0], 0.0), 0.0);
    }
}
