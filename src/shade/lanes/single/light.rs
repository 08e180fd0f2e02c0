//! What one light does at sixteen points in f32; see `lanes::light` for the gates.
//!
//! No colour is known here, and nothing is asked of anybody: the pipeline of one light is a straight
//! line but for one exit, so that several lights are under way at once.

use super::frame::{Rim, SingleLight};
use super::power::{exp2, scaled_logarithm, scaled_logarithm_of_complement};
use super::vector::{self, Mask, Reals, Vectors};
use super::{SMALLEST_COSINE, SMALLEST_MEAN, SOFTEST};
use crate::scene::switches::{BacklitSpecular, Rules, SpecularModel};
use fearless_simd::prelude::*;

/// Sixteen points as lights see them.
#[derive(Clone, Copy)]
pub(super) struct Point<S: Simd> {
    /// Relative to the eye.
    pub(super) position: Vectors<S>,
    /// |position|²/`NEAREST`.
    pub(super) nearness: Reals<S>,
    pub(super) to_eye: Vectors<S>,
    pub(super) normal: Vectors<S>,
    /// Lanes that hold a pixel and are not in doubt.
    pub(super) live: Mask<S>,
}

/// What a surface returns of a light, per kd·Id and per ks·Is; 0 where no light arrives.
#[derive(Clone, Copy)]
pub(super) struct Reflected<S: Simd> {
    pub(super) matte: Reals<S>,
    pub(super) highlight: Reals<S>,
    /// Where light arrives.
    pub(super) open: Mask<S>,
    /// Where f64 must be asked.
    pub(super) doubtful: Mask<S>,
}

/// The way from points to a light; for a light infinitely far away, its direction.
struct Way<S: Simd> {
    way: Vectors<S>,
    /// r² and r.
    squared: Reals<S>,
    distance: Reals<S>,
    /// 1/r.
    inverse: Reals<S>,
    /// 1/(a + b·r + c·r²).
    weakening: Reals<S>,
    /// Where cancellation took too many digits.
    doubtful: Mask<S>,
}

#[inline(always)]
fn way_to<S: Simd>(simd: S, light: &SingleLight, point: &Point<S>) -> Way<S> {
    let one = Reals::splat(simd, 1.0);
    let Some(position) = light.position else {
        return Way {
            way: vector::splat(simd, light.to_light),
            squared: one,
            distance: one,
            inverse: one,
            weakening: one,
            doubtful: Mask::splat(simd, false),
        };
    };
    let way = vector::sub(vector::splat(simd, position), point.position);
    let squared = vector::squared_length(way);
    let doubtful = squared.simd_lt(point.nearness + light.nearness);
    let distance = squared.sqrt();
    let (inverse, weakening) = match light.attenuation {
        None => (one / distance, one),
        Some([a, b, c]) => {
            // One quotient for both.
            let fading = distance * (distance * c + b) + a;
            let quotient = one / (distance * fading);
            (fading * quotient, distance * quotient)
        }
    };
    Way { way, squared, distance, inverse, weakening, doubtful }
}

/// Reflects a light; without `exponent`, ns, there is no highlight.
///
/// Nothing waits for a unit L: powers of a cosine are half powers of its square, and L + V is
/// r times as long. Both powers come last, side by side, since each is a long chain.
#[inline(always)]
pub(super) fn reflect<S: Simd>(
    simd: S,
    rules: &Rules,
    light: &SingleLight,
    exponent: Option<f32>,
    point: &Point<S>,
) -> Reflected<S> {
    let zero = Reals::splat(simd, 0.0);
    let to = way_to(simd, light, point);
    let mut doubtful = to.doubtful;

    // Gate by the sign of N·L and by the cone.
    let n_dot_l = vector::dot(point.normal, to.way) * to.inverse;
    let faces = n_dot_l.simd_gt(-SMALLEST_COSINE);
    let mut open = match rules.backlit_specular {
        BacklitSpecular::NeverDark if exponent.is_some() => point.live,
        _ => faces & point.live,
    };
    let mut falloff = None;
    let mut uncertain = faces & n_dot_l.simd_lt(SMALLEST_COSINE);
    if let Some(cone) = &light.cone {
        let axis = vector::splat(simd, cone.axis);
        match cone.rim {
            Rim::Cosine { inside, outside } => {
                let along = vector::dot(to.way, axis);
                let cosine = along * to.inverse;
                open &= cosine.simd_gt(outside);
                uncertain |= cosine.simd_lt(inside);
                if let Some(exponent) = cone.exponent {
                    let squared = along * along / to.squared;
                    falloff = Some(scaled_logarithm(simd, squared, 0.5 * exponent));
                }
            }
            Rim::Chord { inside, outside } => {
                let q = vector::one_minus_cosine(vector::scaled(to.way, to.inverse), axis);
                open &= q.simd_lt(outside);
                uncertain |= q.simd_gt(inside);
                if let Some(exponent) = cone.exponent {
                    falloff = Some(scaled_logarithm_of_complement(simd, q, exponent));
                }
            }
        }
    }
    if open.all_false() {
        return Reflected { matte: zero, highlight: zero, open, doubtful };
    }
    doubtful |= open & uncertain;
    let Some(exponent) = exponent else {
        let factor = arriving(simd, to.weakening, falloff, open);
        return Reflected { matte: factor * n_dot_l.max(zero), highlight: zero, open, doubtful };
    };
    let (lobe, shows) = match rules.specular {
        SpecularModel::Blinn => {
            let sum = vector::add(to.way, vector::scaled(point.to_eye, to.distance));
            let squared = vector::squared_length(sum);
            doubtful |= open & squared.simd_lt(to.squared * SMALLEST_MEAN);
            if exponent <= SOFTEST {
                let along = vector::dot(point.normal, sum);
                let squared = along * along / squared;
                (scaled_logarithm(simd, squared, 0.5 * exponent), along.simd_gt(0.0))
            } else {
                let half = vector::scaled(sum, Reals::splat(simd, 1.0) / squared.sqrt());
                let q = vector::one_minus_cosine(point.normal, half);
                (scaled_logarithm_of_complement(simd, q, exponent), q.simd_lt(1.0))
            }
        }
        SpecularModel::Phong => {
            let to_light = vector::scaled(to.way, to.inverse);
            let mirror = vector::sub(vector::scaled(point.normal, n_dot_l * 2.0), to_light);
            let q = vector::one_minus_cosine(point.to_eye, mirror);
            (scaled_logarithm_of_complement(simd, q, exponent), q.simd_lt(1.0))
        }
    };
    let factor = arriving(simd, to.weakening, falloff, open);
    // A lobe of exponent 0 is 1 everywhere.
    let lobe = match exponent == 0.0 {
        true => Reals::splat(simd, 1.0),
        false => shows.select(exp2(simd, lobe), zero),
    };
    let matte = factor * n_dot_l.max(zero);
    let strength = if rules.specular_cosine { matte } else { factor };
    Reflected { matte, highlight: strength * lobe, open, doubtful }
}

/// What arrives of a light, from the logarithm of its falloff.
#[inline(always)]
fn arriving<S: Simd>(
    simd: S,
    weakening: Reals<S>,
    falloff: Option<Reals<S>>,
    open: Mask<S>,
) -> Reals<S> {
    let factor = match falloff {
        Some(falloff) => weakening * exp2(simd, falloff),
        None => weakening,
    };
    open.select(factor, Reals::splat(simd, 0.0))
}
