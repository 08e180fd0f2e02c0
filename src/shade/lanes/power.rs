//! (1 − q)^e of lanes: the steps of `shade::power`, which has their derivation, and the lobe of
//! `shade::blinn_phong` made of them.

use super::vector::Reals;
use crate::shade::power::{
    EXPONENT_BITS, LOGARITHM, LOWEST, POWER, ROUNDING, SMALLEST_MANTISSA, WHOLE_BITS, WHOLE_OFFSET,
};
use fearless_simd::prelude::*;
use fearless_simd::u64x8;

/// (cos θ)_+^exponent from q = 1 − cos θ ≥ 0; for finite exponents ≥ 0 what `blinn_phong::lobe` is.
#[inline(always)]
pub(super) fn lobe<S: Simd>(simd: S, q: Reals<S>, exponent: Reals<S>) -> Reals<S> {
    let (zero, one) = (Reals::splat(simd, 0.0), Reals::splat(simd, 1.0));
    let hidden = exponent.simd_eq(0.0).select(one, zero);
    // An exponent of 0 makes 2^(0·log2) = 1 below q = 1 too.
    q.simd_lt(1.0).select(power(simd, q, exponent), hidden)
}

/// (1 − q)^exponent for 0 ≤ q < 1; any number elsewhere.
#[inline(always)]
fn power<S: Simd>(simd: S, q: Reals<S>, exponent: Reals<S>) -> Reals<S> {
    exp2(simd, exponent * log2_of_complement(simd, q))
}

#[inline(always)]
fn log2_of_complement<S: Simd>(simd: S, q: Reals<S>) -> Reals<S> {
    let one = Reals::splat(simd, 1.0);
    let bits: u64x8<S> = (one - q).bitcast();
    let above = bits - u64x8::splat(simd, SMALLEST_MANTISSA);
    let mantissa: Reals<S> = (bits - (above & EXPONENT_BITS)).bitcast();
    let whole: Reals<S> =
        (((above + u64x8::splat(simd, 1023 << 52)) >> 52_u32) | WHOLE_BITS).bitcast();
    let whole = whole - WHOLE_OFFSET;
    let f = whole.simd_eq(0.0).select(-q, mantissa - one);
    let s = f / (one + one + f);
    let z = s * s;
    let z2 = z * z;
    let c = LOGARITHM;
    let low = (z * c[1] + c[0]) + (z * c[3] + c[2]) * z2;
    let high = (z * c[5] + c[4]) + (z * c[7] + c[6]) * z2;
    whole + s * (low + high * (z2 * z2))
}

#[inline(always)]
fn exp2<S: Simd>(simd: S, t: Reals<S>) -> Reals<S> {
    let rounded = t + ROUNDING;
    let r = t - (rounded - ROUNDING);
    let c = POWER;
    let r2 = r * r;
    let r4 = r2 * r2;
    let low = (r * c[1] + c[0]) + (r * c[3] + c[2]) * r2;
    let middle = (r * c[5] + c[4]) + (r * c[7] + c[6]) * r2;
    let high = (r * c[9] + c[8]) + r2 * c[10];
    let fraction = Reals::splat(simd, 1.0) + r * ((low + middle * r4) + high * (r4 * r4));
    let bits: u64x8<S> = fraction.bitcast();
    let whole: u64x8<S> = rounded.bitcast();
    let power: Reals<S> = (bits + (whole << 52_u32)).bitcast();
    t.simd_ge(LOWEST).select(power, Reals::splat(simd, 0.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shade::blinn_phong;
    use crate::simd::SimdLevel;
    use fearless_simd::dispatch;

    #[test]
    fn lanes_have_the_bits_of_single_numbers_at_every_level() {
        let mut q =
            vec![0.0, 0.5, 1.0, 1.5, 2.0, 0.292_893_218_813_452_4, 1.0 - f64::EPSILON / 2.0];
        q.extend((0..4_000).map(|i| f64::from(i) * 2.6e-4));
        q.extend((1..1_000).map(|i| 0.97_f64.powi(i)));
        q.extend([1e-300, 5e-324, 1e-16, 0.1, 0.2]);
        q.resize(q.len().next_multiple_of(8), 0.25);
        for level in SimdLevel::available() {
            for exponent in [0.0, 1e-300, 0.3, 1.0, 27.9, 400.0, 1e6, 1e300, f64::MAX] {
                for chunk in q.chunks_exact(8) {
                    let lanes = dispatch!(level.dispatched(), simd => {
                        let q = Reals::from_slice(simd, chunk);
                        lobe(simd, q, Reals::splat(simd, exponent)).to_array()
                    });
                    for (&q, value) in chunk.iter().zip(lanes) {
                        let right = blinn_phong::lobe(q, exponent);
                        assert_eq!(value.to_bits(), right.to_bits(), "{level} {q:e} {exponent:e}");
                    }
                }
            }
        }
    }
}
