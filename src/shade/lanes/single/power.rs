//! Powers of sixteen lanes of f32: x^e = 2^(e·log2 x), by polynomials, without a quotient.
//!
//! x = 2^k·(1 + f) with 1 + f in √½ … √2; log2 x = k + f·P(f), P of degree 7. In u = 2^-24: P is off
//! by 3.9u relative, its terms and sums by 6.2u (their sizes add up to 1.55 of it at most), product
//! and sum with k by 1u: 12u of the logarithm. e and e·log2 x are off by 1u each. So the power p is
//! off by p·|ln p|·14u ≤ 5.2u, and by 5.6u for 2^r: [`ERROR`].

use super::vector::Reals;
use fearless_simd::i32x16;
use fearless_simd::prelude::*;

/// Largest error of a power: 12u.
#[cfg(test)]
const ERROR: f64 = 12.0 / 16_777_216.0;

/// √½, rounded down.
const SMALLEST_MANTISSA: i32 = 0x3f35_04f3;
/// P, by least maximum of the relative error.
const LOGARITHM: [f32; 8] = [
    1.442_694_9,
    -0.721_352_8,
    0.480_923_24,
    -0.360_239_62,
    0.287_098_7,
    -0.248_876_88,
    0.234_042_44,
    -0.145_811_69,
];
/// (2^r − 1)/r on −½ … ½.
const POWER: [f32; 5] =
    [std::f32::consts::LN_2, 0.240_223_5, 0.055_503_81, 0.009_666_388, 0.001_338_132_2];
/// Below 2^-125 a power is 2^-125.
const LOWEST: f32 = -125.0;
/// 1.5·2^23.
const ROUNDING: f32 = (3_u32 << 22) as f32;

/// exponent·log2 x for x > 0; any number elsewhere.
#[inline(always)]
pub(super) fn scaled_logarithm<S: Simd>(simd: S, x: Reals<S>, exponent: f32) -> Reals<S> {
    let (whole, f) = parts(simd, x);
    logarithm(whole, f) * exponent
}

/// exponent·log2(1 − q) for 0 ≤ q < 1; any number elsewhere. No digit of a small q is lost.
#[inline(always)]
pub(super) fn scaled_logarithm_of_complement<S: Simd>(
    simd: S,
    q: Reals<S>,
    exponent: f32,
) -> Reals<S> {
    let (whole, f) = parts(simd, Reals::splat(simd, 1.0) - q);
    logarithm(whole, whole.simd_eq(0.0).select(-q, f)) * exponent
}

/// k and f.
#[inline(always)]
fn parts<S: Simd>(simd: S, x: Reals<S>) -> (Reals<S>, Reals<S>) {
    let bits: i32x16<S> = x.bitcast();
    let whole = (bits - i32x16::splat(simd, SMALLEST_MANTISSA)) >> 23_u32;
    let mantissa: Reals<S> = (bits - (whole << 23_u32)).bitcast();
    (whole.to_float(), mantissa - 1.0)
}

#[inline(always)]
fn logarithm<S: Simd>(whole: Reals<S>, f: Reals<S>) -> Reals<S> {
    let c = LOGARITHM;
    let f2 = f * f;
    let low = (f * c[1] + c[0]) + (f * c[3] + c[2]) * f2;
    let high = (f * c[5] + c[4]) + (f * c[7] + c[6]) * f2;
    whole + f * (low + high * (f2 * f2))
}

/// 2^t.
#[inline(always)]
pub(super) fn exp2<S: Simd>(simd: S, t: Reals<S>) -> Reals<S> {
    let t = t.max(Reals::splat(simd, LOWEST));
    let rounded = t + ROUNDING;
    let r = t - (rounded - ROUNDING);
    let c = POWER;
    let r2 = r * r;
    let fraction = r * ((r * c[1] + c[0]) + ((r * c[3] + c[2]) + r2 * c[4]) * r2) + 1.0;
    let bits: i32x16<S> = fraction.bitcast();
    let scale: i32x16<S> = rounded.bitcast();
    (bits + (scale << 23_u32)).bitcast()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::SimdLevel;
    use fearless_simd::dispatch;

    /// (cos θ)_+^exponent from q = 1 − cos θ, as lights take it.
    #[inline(always)]
    fn power<S: Simd>(simd: S, q: Reals<S>, exponent: f32) -> Reals<S> {
        let power = exp2(simd, scaled_logarithm_of_complement(simd, q, exponent));
        let hidden = Reals::splat(simd, if exponent == 0.0 { 1.0 } else { 0.0 });
        q.simd_lt(1.0).select(power, hidden)
    }

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
                        power(simd, Reals::load_array(simd, q), exponent).to_array()
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
                    // From the cosine itself, what it is in f32.
                    let cosine = 1.0 - q;
                    if cosine > 0.0 {
                        let value = dispatch!(SimdLevel::best().dispatched(), simd => {
                            let cosine = Reals::splat(simd, cosine);
                            exp2(simd, scaled_logarithm(simd, cosine, exponent)).to_array()[0]
                        });
                        let right = f64::from(cosine).powf(exponent.into());
                        let error = (f64::from(value) - right).abs();
                        assert!(error <= ERROR, "{cosine:e} ^ {exponent}: {error:e}");
                    }
                }
            }
        }
        assert!(largest > ERROR / 100.0, "the comparison saw rounding: {largest:e}");
    }
}
