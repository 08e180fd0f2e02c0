//! Three-vectors of sixteen lanes of f32.

use fearless_simd::prelude::*;
use fearless_simd::{f32x16, f64x8, mask32x16};

/// One number per lane.
pub(super) type Reals<S> = f32x16<S>;

/// One vector per lane.
pub(super) type Vectors<S> = [f32x16<S>; 3];

/// One yes or no per lane.
pub(super) type Mask<S> = mask32x16<S>;

/// The numbers of sixteen neighbouring pixels, rounded.
#[inline(always)]
pub(super) fn narrowed<S: Simd>(simd: S, numbers: &[f64], start: usize) -> Reals<S> {
    let low = f64x8::from_slice(simd, &numbers[start..start + 8]);
    low.narrow(f64x8::from_slice(simd, &numbers[start + 8..start + 16]))
}

/// The same vector in every lane.
#[inline(always)]
pub(super) fn splat<S: Simd>(simd: S, [x, y, z]: [f32; 3]) -> Vectors<S> {
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

/// a · b.
#[inline(always)]
pub(super) fn dot<S: Simd>(a: Vectors<S>, b: Vectors<S>) -> Reals<S> {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// |a|².
#[inline(always)]
pub(super) fn squared_length<S: Simd>(a: Vectors<S>) -> Reals<S> {
    dot(a, a)
}

/// 1 − cos of the angle between two unit vectors.
#[inline(always)]
pub(super) fn one_minus_cosine<S: Simd>(a: Vectors<S>, b: Vectors<S>) -> Reals<S> {
    squared_length(sub(a, b)) * 0.5
}
