//! One light at eight points: `equation`'s directed part, gate by gate, with masks.
//!
//! A lane that a gate closes goes on with a factor of 0, and adds 0 at the end. The function leaves
//! as soon as every lane is closed.

use super::power::lobe;
use super::products::Colors;
use super::vector::{self, Mask, Reals, Vectors};
use crate::scene::light::HemisphereLight;
use crate::scene::switches::{BacklitSpecular, HemisphereCurve, Rules, SpecularModel};
use crate::shade::blinn_phong::OPPOSITE_SQUARED;
use crate::shade::equation::TERMINATOR;
use crate::shade::lights::{Origin, Position, PreparedLight};
use fearless_simd::prelude::*;

/// Eight points as lights see them.
pub(super) struct Point<S: Simd> {
    pub(super) position: Vectors<S>,
    /// V, unit.
    pub(super) to_eye: Vectors<S>,
    /// N, unit.
    pub(super) normal: Vectors<S>,
    /// ns.
    pub(super) exponent: Reals<S>,
    /// Lanes that hold a pixel.
    pub(super) live: Mask<S>,
}

/// Adds the directed part of a light to `radiance`, and says in which lanes the scalar kernel must
/// look again. `is_hidden` answers for a lane and a light of the scene.
#[inline(always)]
pub(super) fn add_light<S: Simd>(
    simd: S,
    rules: &Rules,
    light: &PreparedLight,
    colors: &Colors<S>,
    point: &Point<S>,
    is_hidden: &dyn Fn(usize, usize) -> bool,
    radiance: &mut Vectors<S>,
) -> Mask<S> {
    let mut doubtful = Mask::splat(simd, false);
    if let Origin::Hemisphere(hemisphere) = &light.origin {
        *radiance = vector::add(*radiance, from_all_around(simd, rules, hemisphere, colors, point));
        return doubtful;
    }
    if !colors.has_diffuse && !colors.has_specular {
        return doubtful;
    }

    // Find the way to the light, and N·L from the vector as it is.
    let (to_light, n_dot_l, reach) = match &light.origin {
        Origin::Direction { to_light } => {
            let to_light = vector::splat(simd, *to_light);
            (to_light, vector::dot(point.normal, to_light), None)
        }
        Origin::Position(at) => {
            let way = vector::sub(vector::splat(simd, at.position), point.position);
            let squared = vector::squared_length(way);
            doubtful |= !vector::is_unscaled(squared);
            let distance = squared.sqrt();
            let inverse = Reals::splat(simd, 1.0) / distance;
            let n_dot_l = vector::dot(point.normal, way) * inverse;
            (vector::scaled(way, inverse), n_dot_l, Some((at, distance)))
        }
        Origin::Hemisphere(_) | Origin::Nowhere => return doubtful,
    };

    // Gate by the sign of N·L.
    let faces = n_dot_l.simd_gt(0.0);
    let shines = match rules.backlit_specular {
        _ if !colors.has_specular => Mask::splat(simd, false),
        BacklitSpecular::DarkUpTo => faces,
        BacklitSpecular::DarkBelow => n_dot_l.simd_ge(0.0),
        BacklitSpecular::NeverDark => Mask::splat(simd, true),
    };
    let is_near = n_dot_l.abs().simd_lt(TERMINATOR);
    let mut open = (faces | shines | is_near) & point.live;
    if open.all_false() {
        return doubtful;
    }

    // Reach of the light.
    let mut factor = Reals::splat(simd, 1.0);
    if let Some((at, distance)) = reach {
        open &= is_inside(simd, at, to_light, &mut factor);
        if open.all_false() {
            return doubtful;
        }
        attenuate(simd, at, distance, &mut factor);
        open &= factor.simd_gt(0.0);
    }

    // A light that reaches the point leaves its side in doubt here.
    doubtful |= open & is_near;
    open &= faces | shines;

    // Ask for a shadow last: it costs most.
    if light.shadows {
        let asked = (open & !doubtful).to_bitmask();
        let hidden = (0..super::LANES)
            .filter(|&lane| asked >> lane & 1 != 0 && is_hidden(lane, light.index))
            .fold(0, |bits, lane| bits | 1 << lane);
        open &= !Mask::from_bitmask(simd, hidden);
    }

    // Reflect.
    let zero = Reals::splat(simd, 0.0);
    let factor = open.select(factor, zero);
    let cosine = n_dot_l.max(zero);
    if colors.has_diffuse {
        let diffuse = vector::scaled(vector::scaled(colors.diffuse, factor), cosine);
        *radiance = vector::add(*radiance, diffuse);
    }
    if colors.has_specular {
        let q = match rules.specular {
            SpecularModel::Blinn => {
                let sum = vector::add(to_light, point.to_eye);
                let squared = vector::squared_length(sum);
                doubtful |= open & shines & squared.simd_lt(OPPOSITE_SQUARED);
                let half = vector::scaled(sum, Reals::splat(simd, 1.0) / squared.sqrt());
                vector::one_minus_cosine(point.normal, half)
            }
            SpecularModel::Phong => {
                let twice = vector::dot(to_light, point.normal) * 2.0;
                let mirror = vector::sub(vector::scaled(point.normal, twice), to_light);
                vector::one_minus_cosine(point.to_eye, mirror)
            }
        };
        let power = lobe(simd, q, point.exponent);
        let factor = shines.select(factor, zero);
        let mut specular = vector::scaled(vector::scaled(colors.specular, factor), power);
        if rules.specular_cosine {
            specular = vector::scaled(specular, cosine);
        }
        *radiance = vector::add(*radiance, specular);
    }
    doubtful
}

/// Where the light's cone has the points inside or on its rim; `factor` becomes its falloff there.
#[inline(always)]
fn is_inside<S: Simd>(
    simd: S,
    at: &Position,
    to_light: Vectors<S>,
    factor: &mut Reals<S>,
) -> Mask<S> {
    let Some(cone) = &at.cone else { return Mask::splat(simd, true) };
    let q = vector::one_minus_cosine(to_light, vector::splat(simd, cone.axis));
    if let Some(exponent) = cone.exponent {
        *factor = if exponent == 0.0 {
            Reals::splat(simd, 1.0)
        } else {
            lobe(simd, q, Reals::splat(simd, exponent))
        };
    }
    match cone.largest_squared_chord {
        Some(largest) => (q * 2.0).simd_le(largest),
        None => Mask::splat(simd, true),
    }
}

/// f over the attenuation by distance; what is 0 before stays 0.
#[inline(always)]
fn attenuate<S: Simd>(simd: S, at: &Position, distance: Reals<S>, factor: &mut Reals<S>) {
    let Some([a, b, c]) = at.attenuation else { return };
    let quotient = *factor / (distance * (distance * c + b) + a);
    // The end of the range, as in `falloff`; NaN can only stand where the factor is 0.
    let bounded = quotient.simd_lt(f64::MAX).select(quotient, Reals::splat(simd, f64::MAX));
    *factor = factor.simd_gt(0.0).select(bounded, *factor);
}

/// kd·(a·top + (1 − a)·bottom): no gate, no distance.
#[inline(always)]
fn from_all_around<S: Simd>(
    simd: S,
    rules: &Rules,
    light: &HemisphereLight,
    colors: &Colors<S>,
    point: &Point<S>,
) -> Vectors<S> {
    let up = vector::splat(simd, light.up);
    let cosine = vector::dot(point.normal, up);
    let half = Reals::splat(simd, 0.5);
    let a = match rules.hemisphere {
        HemisphereCurve::Sine => {
            let sine = vector::squared_length(vector::cross(point.normal, up)).sqrt();
            let share = sine * half;
            cosine.simd_ge(0.0).select(Reals::splat(simd, 1.0) - share, share)
        }
        HemisphereCurve::Cosine | HemisphereCurve::Linear => half + cosine * half,
    };
    let (top, bottom) = (vector::splat(simd, light.top), vector::splat(simd, light.bottom));
    let rest = Reals::splat(simd, 1.0) - a;
    vector::product(
        colors.coefficient,
        vector::add(vector::scaled(top, a), vector::scaled(bottom, rest)),
    )
}
