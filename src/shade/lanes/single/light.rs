//! One light at sixteen points in f32; see `lanes::light` for the gates.

use super::frame::SingleLight;
use super::power::{lobe, power};
use super::vector::{self, Mask, Reals, Vectors};
use super::{NEAREST, SMALLEST_COSINE, SMALLEST_MEAN, SQUARED_DISTANCES};
use crate::scene::switches::{BacklitSpecular, Rules, SpecularModel};
use fearless_simd::prelude::*;

/// Sixteen points as lights see them.
pub(super) struct Point<S: Simd> {
    /// Relative to the eye.
    pub(super) position: Vectors<S>,
    /// |position|².
    pub(super) squared_distance: Reals<S>,
    pub(super) to_eye: Vectors<S>,
    pub(super) normal: Vectors<S>,
    pub(super) exponent: Reals<S>,
    /// Lanes that hold a pixel and are not in doubt.
    pub(super) live: Mask<S>,
}

/// The directed colours of a light.
#[derive(Clone, Copy)]
pub(super) struct Colors<S: Simd> {
    pub(super) diffuse: Vectors<S>,
    pub(super) specular: Vectors<S>,
    pub(super) has_diffuse: bool,
    pub(super) has_specular: bool,
}

/// Adds the directed part of a light to `radiance`, and says in which lanes f64 must be asked.
/// `hidden` says, for lanes by bits, in which of them something hides the light.
#[inline(always)]
pub(super) fn add_light<S: Simd>(
    simd: S,
    rules: &Rules,
    light: &SingleLight,
    colors: &Colors<S>,
    point: &Point<S>,
    hidden: Option<&dyn Fn(u64) -> u64>,
    radiance: &mut Vectors<S>,
) -> Mask<S> {
    let mut doubtful = Mask::splat(simd, false);
    let (zero, one) = (Reals::splat(simd, 0.0), Reals::splat(simd, 1.0));

    // Find the way to the light.
    let mut weakening = one;
    let to_light = match light.position {
        None => vector::splat(simd, light.to_light),
        Some(position) => {
            let way = vector::sub(vector::splat(simd, position), point.position);
            let squared = vector::squared_length(way);
            let farther = point.squared_distance + light.squared_distance;
            let is_far = (squared * NEAREST).simd_ge(farther)
                & squared.simd_ge(SQUARED_DISTANCES[0])
                & squared.simd_le(SQUARED_DISTANCES[1]);
            doubtful |= !is_far;
            let distance = squared.sqrt();
            // A quotient of its own, so that it need not wait for the cone.
            if let Some([a, b, c]) = light.attenuation {
                weakening = one / (distance * (distance * c + b) + a);
            }
            vector::scaled(way, one / distance)
        }
    };

    // Gate by the sign of N·L.
    let n_dot_l = vector::dot(point.normal, to_light);
    let faces = n_dot_l.simd_gt(0.0);
    let shines = match rules.backlit_specular {
        BacklitSpecular::NeverDark if colors.has_specular => Mask::splat(simd, true),
        _ => faces,
    };
    let is_near = n_dot_l.abs().simd_lt(SMALLEST_COSINE);
    let mut open = (shines | is_near) & point.live;
    if open.all_false() {
        return doubtful;
    }

    // Reach of the light.
    let mut factor = weakening;
    if let Some(cone) = &light.cone {
        let q = vector::one_minus_cosine(to_light, vector::splat(simd, cone.axis));
        if let Some([inside, outside]) = cone.rim {
            open &= q.simd_lt(outside);
            if open.all_false() {
                return doubtful;
            }
            doubtful |= open & q.simd_gt(inside);
        }
        if let Some(exponent) = cone.exponent {
            let fallen = power(simd, q, Reals::splat(simd, exponent));
            factor *= q.simd_lt(1.0).select(fallen, zero);
        }
    }
    doubtful |= open & is_near;
    if let Some(hidden) = hidden {
        let asked = (open & !doubtful).to_bitmask();
        open &= !Mask::from_bitmask(simd, hidden(asked));
    }

    // Reflect.
    let factor = open.select(factor, zero);
    let cosine = n_dot_l.max(zero);
    if colors.has_diffuse {
        *radiance = vector::add(*radiance, vector::scaled(colors.diffuse, factor * cosine));
    }
    if colors.has_specular {
        let q = match rules.specular {
            SpecularModel::Blinn => {
                let sum = vector::add(to_light, point.to_eye);
                let squared = vector::squared_length(sum);
                doubtful |= open & squared.simd_lt(SMALLEST_MEAN);
                vector::one_minus_cosine(point.normal, vector::scaled(sum, one / squared.sqrt()))
            }
            SpecularModel::Phong => {
                let twice = n_dot_l * 2.0;
                let mirror = vector::sub(vector::scaled(point.normal, twice), to_light);
                vector::one_minus_cosine(point.to_eye, mirror)
            }
        };
        let mut strength = factor * lobe(simd, q, point.exponent);
        if rules.specular_cosine {
            strength *= cosine;
        }
        *radiance = vector::add(*radiance, vector::scaled(colors.specular, strength));
    }
    doubtful
}
