//! Three-vectors of lanes: the functions of `shade::vector`, the same operations in their order.

use super::LANES;
use fearless_simd::prelude::*;
use fearless_simd::{f64x8, mask64x8};

/// One number per lane.
pub(super) type Reals<S> = f64x8<S>;

/// One vector per lane.
pub(super) type Vectors<S> = [f64x8<S>; 3];

/// One yes or no per lane.
pub(super) type Mask<S> = mask64x8<S>;

/// The numbers of eight neighbouring pixels.
#[inline(always)]
pub(super) fn load<S: Simd>(simd: S, numbers: &[f64], start: usize) -> Reals<S> {
    Reals::from_slice(simd, &numbers[start..start + LANES])
}

/// Writes the numbers of eight neighbouring pixels.
#[inline(always)]
pub(super) fn store<S: Simd>(value: Reals<S>, numbers: &mut [f64], start: usize) {
    value.store_slice(&mut numbers[start..start + LANES]);
}

/// The vectors of eight neighbouring pixels. (A `map` over an array of lanes is a call where it is
/// not inlined; none is used in the lanes' kernels.)
#[inline(always)]
pub(super) fn load3<S: Simd, const N: usize>(
    simd: S,
    [x, y, z]: &[[f64; N]; 3],
    start: usize,
) -> Vectors<S> {
    [load(simd, x, start), load(simd, y, start), load(simd, z, start)]
}

/// −a.
#[inline(always)]
pub(super) fn negated<S: Simd>([x, y, z]: Vectors<S>) -> Vectors<S> {
    [-x, -y, -z]
}

/// The same vector in every lane.
#[inline(always)]
pub(super) fn splat<S: Simd>(simd: S, [x, y, z]: [f64; 3]) -> Vectors<S> {
    [Reals::splat(simd, x), Reals::splat(simd, y), Reals::splat(simd, z)]
}

/// a − b.
#[inline(always)]
pub(super) fn sub<S: Simd>(a: Vectors<S>, b: Vectors<S>) -> Vectors<S> {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// a + b.
#[inline(always)]
pub(super) fn add<S: Simd>(a: Vectors<S>, b: Vectors<S>) -> Vectors<S> {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// k·a.
#[inline(always)]
pub(super) fn scaled<S: Simd>(a: Vectors<S>, k: Reals<S>) -> Vectors<S> {
    [a[0] * k, a[1] * k, a[2] * k]
}

/// a·b, channel by channel.
#[inline(always)]
pub(super) fn product<S: Simd>(a: Vectors<S>, b: Vectors<S>) -> Vectors<S> {
    [a[0] * b[0], a[1] * b[1], a[2] * b[2]]
}

/// a · b, summed from x to z.
#[inline(always)]
pub(super) fn dot<S: Simd>(a: Vectors<S>, b: Vectors<S>) -> Reals<S> {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// a × b.
#[inline(always)]
pub(super) fn cross<S: Simd>(a: Vectors<S>, b: Vectors<S>) -> Vectors<S> {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// |a|².
#[inline(always)]
pub(super) fn squared_length<S: Simd>(a: Vectors<S>) -> Reals<S> {
    dot(a, a)
}

/// max |a_i|.
#[inline(always)]
pub(super) fn largest_component<S: Simd>(a: Vectors<S>) -> Reals<S> {
    a[0].abs().max(a[1].abs()).max(a[2].abs())
}

/// 1 − cos of the angle between two unit vectors.
#[inline(always)]
pub(super) fn one_minus_cosine<S: Simd>(a: Vectors<S>, b: Vectors<S>) -> Reals<S> {
    squared_length(sub(a, b)) * 0.5
}

/// Squared lengths for which `shade::vector::measure` needs no scaling: its largest component is
/// then between 2^-351 and 2^495, inside the bounds there.
const UNSCALED: [f64; 2] = [f64::from_bits((1023 - 700) << 52), f64::from_bits((1023 + 990) << 52)];

/// Where a vector of this squared length is measured without scaling.
#[inline(always)]
pub(super) fn is_unscaled<S: Simd>(squared_length: Reals<S>) -> Mask<S> {
    squared_length.simd_ge(UNSCALED[0]) & squared_length.simd_le(UNSCALED[1])
}
