//! (1 − q)^e of sixteen lanes of f32: the steps of `shade::power` with shorter polynomials.
//!
//! The logarithm's polynomial is off by 1.4e-8, that of 2^r by 2.1e-7 = 3.5u (u = 2^-24). By the sums
//! of `shade::power` a power p is off by p·|ln p|·11u + p·5.6u < 10u.

use super::vector::Reals;
use fearless_simd::prelude::*;
use fearless_simd::u32x16;

/// √½; see `shade::power`.
const SMALLEST_MANTISSA: u32 = 0x3f35_04f3;
const EXPONENT_BITS: u32 = 0xff80_0000;
/// 2^23, and what leaves k.
const WHOLE_BITS: u32 = (127 + 23) << 23;
const WHOLE_OFFSET: f32 = ((1_u32 << 23) + 127) as f32;
const LOGARITHM: [f32; 4] = [2.885_39, 0.961_798_84, 0.576_715_1, 0.431_719_72];
const POWER: [f32; 5] =
    [std::f32::consts::LN_2, 0.240_223_5, 0.055_503_81, 0.009_666_388, 0.001_338_132_2];
/// Below 2^-125 a power is 0.
const LOWEST: f32 = -125.0;
/// 1.5·2^23.
const ROUNDING: f32 = (3_u32 << 22) as f32;

/// (cos θ)_+^exponent from q = 1 − cos θ ≥ 0, for exponents that are 0 or at least 1.
#[inline(always)]
pub(super) fn lobe<S: Simd>(simd: S, q: Reals<S>, exponent: Reals<S>) -> Reals<S> {
    let (zero, one) = (Reals::splat(simd, 0.0), Reals::splat(simd, 1.0));
    let hidden = exponent.simd_eq(0.0).select(one, zero);
    q.simd_lt(1.0).select(power(simd, q, exponent), hidden)
}

/// (1 − q)^exponent for 0 ≤ q < 1; any number elsewhere.
#[inline(always)]
pub(super) fn power<S: Simd>(simd: S, q: Reals<S>, exponent: Reals<S>) -> Reals<S> {
    let one = Reals::splat(simd, 1.0);
    let bits: u32x16<S> = (one - q).bitcast();
    let above = bits - u32x16::splat(simd, SMALLEST_MANTISSA);
    let mantissa: Reals<S> = (bits - (above & EXPONENT_BITS)).bitcast();
    let whole: Reals<S> =
        (((above + u32x16::splat(simd, 127 << 23)) >> 23_u32) | WHOLE_BITS).bitcast();
    let whole = whole - WHOLE_OFFSET;
    let f = whole.simd_eq(0.0).select(-q, mantissa - one);
    let s = f / (f + 2.0);
    let z = s * s;
    let c = LOGARITHM;
    let log = whole + s * ((z * c[1] + c[0]) + (z * c[3] + c[2]) * (z * z));

    let t = exponent * log;
    let rounded = t + ROUNDING;
    let r = t - (rounded - ROUNDING);
    let c = POWER;
    let r2 = r * r;
    let fraction = one + r * ((r * c[1] + c[0]) + ((r * c[3] + c[2]) + r2 * c[4]) * r2);
    let bits: u32x16<S> = fraction.bitcast();
    let scale: u32x16<S> = rounded.bitcast();
    let power: Reals<S> = (bits + (scale << 23_u32)).bitcast();
    t.simd_ge(LOWEST).select(power, Reals::splat(simd, 0.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::SimdLevel;
    use fearless_simd::dispatch;

    /// The bound of the head.
    const ERROR: f64 = 10.0 / 16_777_216.0;

    #[test]
    fn the_error_is_what_is_said_and_the_bits_are_those_of_every_level() {
        let mut largest = 0.0_f64;
        for exponent in [0.0_f32, 1.0, 2.5, 27.9, 200.0, 1e4, 1e6] {
            for i in 0..5_000 {
                let q: [f32; 16] = std::array::from_fn(|lane| {
                    let share = (i * 16 + lane as i32) as f32 / 80_000.0;
                    // On the slope of the lobe, and over all of it.
                    if lane % 2 == 0 { (share * 25.0 / exponent.max(1.0)).min(2.0) } else { share }
                });
                let of = |level: SimdLevel| -> [f32; 16] {
                    dispatch!(level.dispatched(), simd => {
                        let exponent = Reals::splat(simd, exponent);
                        lobe(simd, Reals::load_array(simd, q), exponent).to_array()
                    })
                };
                let first = of(SimdLevel::Baseline);
                for level in SimdLevel::available() {
                    assert_eq!(of(level).map(f32::to_bits), first.map(f32::to_bits), "{level}");
                }
                for (q, value) in q.into_iter().zip(first) {
                    let right = crate::shade::blinn_phong::lobe(q.into(), exponent.into());
                    let error = (f64::from(value) - right).abs();
                    largest = largest.max(error);
                    assert!(error <= ERROR && value <= 1.0, "{q:e} ^ {exponent}: {error:e}");
                }
            }
        }
        assert!(largest > ERROR / 100.0, "the comparison saw rounding: {largest:e}");
    }
}
