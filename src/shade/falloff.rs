//! f of a light at a point: its cone, the falloff inside it, and attenuation by distance.
//!
//! No surface and no colour here. Source: Curless, "Shading", the spotlight.

use super::effects::Effects;
use super::kernel_effects::KernelEffects;
use super::lights::{Position, attenuation_denominator};
use super::watch::Watch;

/// f of a light, 0…f64::MAX; 1 at infinity, `None` outside its cone.
pub(super) fn factor_of<const E: u8, W: Watch>(
    reach: Option<(&Position, f64)>,
    to_light: [f64; 3],
    watch: &mut W,
) -> Option<f64> {
    match reach {
        Some((at, distance)) => reach_factor::<E, W>(at, to_light, distance, watch),
        None => Some(1.0),
    }
}

/// f of a light at a position.
fn reach_factor<const E: u8, W: Watch>(
    at: &Position,
    to_light: [f64; 3],
    distance: f64,
    watch: &mut W,
) -> Option<f64> {
    let effects = const { KernelEffects(E) };
    let mut factor = 1.0;
    if effects.has(KernelEffects::CONE)
        && let Some(cone) = &at.cone
    {
        if cone.largest_squared_chord.is_some() {
            watch.evaluated(Effects::CONE);
        }
        if !cone.contains(to_light) {
            return None;
        }
        if cone.exponent.is_some() {
            watch.evaluated(Effects::EXPONENT);
        }
        factor = cone.falloff(to_light);
    }
    // A falloff of 0 is not divided: the denominator may underflow to 0 too.
    if let Some(abc) = at.attenuation
        && factor > 0.0
    {
        watch.evaluated(Effects::ATTENUATION);
        // The equation's pole (r → 0 with a = 0) may lie beyond the range: the end of the range.
        factor = (factor / attenuation_denominator(abc, distance)).min(f64::MAX);
    }
    Some(factor)
}
