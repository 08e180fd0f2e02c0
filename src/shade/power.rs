//! (1 − q)^e in f64 from + − × ÷ and the bits of a number alone: the power behind every lobe.
//!
//! By 2^(e·log2(1 − q)). Both functions are polynomials whose sums run in a fixed order without
//! fused operations, so that a vector of lanes computes the bits of a single number (`lanes::power`
//! repeats these steps) and every platform those of any other. The polynomials interpolate at
//! Chebyshev nodes. No case is decided here: what q ≥ 1 or an exponent of 0 means is a lobe's
//! business.
//!
//! Error, with u = 2^-53. Logarithm: 1 − q = 2^k·m with m in √½ … √2, s = (m − 1)/(m + 1) and
//! log2(1 − q) = k + s·P(s²). At k = 0, m − 1 is −q without any rounding; 2 + f, the quotient, P
//! (whose constant term outweighs the rest by 100, two sums) and the product make 5u, and P itself
//! is off by 1.5e-17: 6u relative. At k < 0, |log2| ≥ ½: the rounding of 1 − q (u/2, over ln 2 · ½)
//! makes 1.5u, s·P ≤ ½ another 6u, the sum u: 10u at most. The product with e: u. Power: r =
//! t − round(t) is exact; 2^r = 1 + r·Q(r) with |r| ≤ ½, r·Q < 0.42 good to 5u, makes 3.5u after
//! the sum, and Q is off by 2e-17. So the result p is off by p·|ln p|·11u + p·4u < 8.1u = 9e-16,
//! since p·|ln p| ≤ 1/e. The test holds it.

/// √½ as the smallest mantissa: m lies in √½ … √2, where (m − 1)/(m + 1) is smallest.
pub(super) const SMALLEST_MANTISSA: u64 = 0x3fe6_a09e_667f_3bcd;

/// The bits of sign and exponent.
pub(super) const EXPONENT_BITS: u64 = 0xfff0_0000_0000_0000;

/// 2^52 as a number: its last bits are whole numbers.
pub(super) const WHOLE_BITS: u64 = (1023 + 52) << 52;

/// What is to be taken from 2^52 + (k + 1023) to leave k.
pub(super) const WHOLE_OFFSET: f64 = ((1_u64 << 52) + 1023) as f64;

/// log2((1 + s)/(1 − s))/s as a polynomial in s², for s² ≤ ((√2 − 1)/(√2 + 1))²; relative error
/// 1.5e-17 with these rounded coefficients.
pub(super) const LOGARITHM: [f64; 8] = [
    2.885_390_081_777_926_8,
    0.961_796_693_925_989_8,
    0.577_078_016_345_514,
    0.412_198_585_842_294_2,
    0.320_598_534_765_047_8,
    0.262_334_360_603_295_46,
    0.220_912_867_341_801_57,
    0.213_661_225_027_983_26,
];

/// (2^r − 1)/r as a polynomial in r, for |r| ≤ ½; relative error of 2^r 2e-17 with these rounded
/// coefficients.
pub(super) const POWER: [f64; 11] = [
    std::f64::consts::LN_2,
    0.240_226_506_959_100_97,
    0.055_504_108_664_821_6,
    0.009_618_129_107_606_854,
    0.001_333_355_814_641_691_6,
    0.000_154_035_304_417_941_36,
    1.525_273_382_986_708e-5,
    1.321_544_255_252_229_1e-6,
    1.017_806_242_697_692_4e-7,
    7.072_593_027_878_997e-9,
    4.454_964_371_269_296_7e-10,
];

/// The smallest power of two whose neighbourhood is computed: at −1021, 2^r ≥ √½ still has a whole
/// exponent after it is scaled. Below, a power is 0.
pub(super) const LOWEST: f64 = -1021.0;

/// 1.5·2^52: added and taken away, it rounds to whole numbers, ties to even, and leaves the whole
/// number in the last bits of the sum.
pub(super) const ROUNDING: f64 = (3_u64 << 51) as f64;

/// (1 − q)^exponent for 0 ≤ q < 1 and a finite exponent > 0; never above 1, never NaN, 0 below
/// 2^-1021.
#[inline]
pub(super) fn power(q: f64, exponent: f64) -> f64 {
    exp2(exponent * log2_of_complement(q))
}

/// log2(1 − q) for 0 ≤ q < 1.
#[inline]
pub(super) fn log2_of_complement(q: f64) -> f64 {
    // Split 1 − q into a power of two and a mantissa around 1.
    let complement = 1.0 - q;
    let bits = complement.to_bits();
    let above = bits.wrapping_sub(SMALLEST_MANTISSA);
    let mantissa = f64::from_bits(bits.wrapping_sub(above & EXPONENT_BITS));
    let whole = f64::from_bits((above.wrapping_add(1023 << 52) >> 52) | WHOLE_BITS) - WHOLE_OFFSET;
    // Around 1, q itself has the digits that 1 − q has lost.
    let f = if whole == 0.0 { -q } else { mantissa - 1.0 };
    let s = f / (2.0 + f);
    let z = s * s;
    let z2 = z * z;
    let [c0, c1, c2, c3, c4, c5, c6, c7] = LOGARITHM;
    let low = (c0 + c1 * z) + (c2 + c3 * z) * z2;
    let high = (c4 + c5 * z) + (c6 + c7 * z) * z2;
    whole + s * (low + high * (z2 * z2))
}

/// 2^t for t ≤ 0.
#[inline]
pub(super) fn exp2(t: f64) -> f64 {
    // NaN and −∞ are below too.
    let is_in_range = t >= LOWEST;
    if !is_in_range {
        return 0.0;
    }
    let rounded = t + ROUNDING;
    let r = t - (rounded - ROUNDING);
    let [c0, c1, c2, c3, c4, c5, c6, c7, c8, c9, c10] = POWER;
    let r2 = r * r;
    let r4 = r2 * r2;
    let low = (c0 + c1 * r) + (c2 + c3 * r) * r2;
    let middle = (c4 + c5 * r) + (c6 + c7 * r) * r2;
    let high = (c8 + c9 * r) + c10 * r2;
    let fraction = 1.0 + r * ((low + middle * r4) + high * (r4 * r4));
    f64::from_bits(fraction.to_bits().wrapping_add(rounded.to_bits() << 52))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Largest absolute error of [`power`], whose values lie in 0…1: see the head of the module.
    const ERROR: f64 = 9e-16;

    /// libm's functions are good to 1 unit of the last place: 2u·e·|log|·p + 2u·p, and u more for the
    /// product.
    const ERROR_OF_REFERENCE: f64 = 4e-16;

    fn reference(q: f64, exponent: f64) -> f64 {
        libm::exp(exponent * libm::log1p(-q))
    }

    #[test]
    fn the_error_is_what_is_said() {
        let mut largest = 0.0_f64;
        let exponents = [1e-3, 0.1, 0.5, 1.0, 2.5, 7.0, 27.9, 50.0, 200.0, 1e3, 1e5, 1e8, 1e14];
        for exponent in exponents {
            // 40 000 places on the slope of the lobe, and as many over all of it.
            for i in 1..40_000 {
                let share = f64::from(i) / 40_000.0;
                let on_slope = -libm::expm1(-40.0 * share / exponent);
                for q in [on_slope, share, share * share * share * share] {
                    let error = (power(q.min(1.0 - 1e-16), exponent)
                        - reference(q.min(1.0 - 1e-16), exponent))
                    .abs();
                    largest = largest.max(error);
                    assert!(error < ERROR + ERROR_OF_REFERENCE, "{q:e} ^ {exponent:e}: {error:e}");
                }
            }
        }
        assert!(largest > 1e-16, "the comparison saw rounding: {largest:e}");
    }

    #[test]
    fn ends_are_exact() {
        for exponent in [1e-300, 1.0, 1e300, f64::MAX] {
            assert_eq!(power(0.0, exponent), 1.0);
        }
        assert_eq!(power(0.5, 1.0), 0.5);
        assert_eq!(power(0.75, 3.0), 1.0 / 64.0);
        let nearest_one = 1.0 - f64::EPSILON / 2.0;
        assert_eq!(power(nearest_one, 1.0), f64::EPSILON / 2.0);
        assert_eq!(power(1e-3, f64::MAX), 0.0);
        assert_eq!(exp2(-1021.0), 2.0 * f64::MIN_POSITIVE);
        assert_eq!(exp2(-1_021.000_001), 0.0);
        assert_eq!(exp2(f64::NEG_INFINITY), 0.0);
    }

    // A lobe that rises anywhere as q grows would be a ring around a highlight.
    #[test]
    fn a_power_never_exceeds_one_and_falls_to_within_its_error() {
        let mut before = 1.0;
        for i in 0..200_000 {
            let value = power(f64::from(i) / 200_000.0, 3.7);
            assert!((0.0..=1.0).contains(&value) && value <= before + 2.0 * ERROR, "{i}: {value}");
            before = value;
        }
        for q in [1e-300, 1e-20, 1e-17, 1.2e-16, 1e-10] {
            for exponent in [1e-5, 1.0, 50.0] {
                assert!(power(q, exponent) <= 1.0, "{q:e} {exponent:e}");
            }
        }
    }
}
