//! The shading equation, written once, compiled for sets of effects:
//!
//! `ke + Σ_j [ ka·Ia_j + f_j·B_j·( kd·Id_j·(N·L_j) + ks·Is_j·(N·H_j)_+^ns ) ]` with
//! `f_j = (L_j·S_j)_+^e_j · cone_j / (a_j + r_j(b_j + c_j·r_j))`, per channel, f64, in the order of
//! the file; B is 0 iff N·L ≤ 0. Source: Curless, "Shading", iteration four.
//!
//! A term is gated before it is evaluated: what has no colour, no reach or the wrong side is never
//! computed, so no 0·∞ exists. No clamping, no shadows, no visibility here.

use super::blinn_phong::{halfway, lobe, one_minus_cosine};
use super::effects::Effects;
use super::kernel::Frame;
use super::lights::{Origin, Position, PreparedLight, attenuation_denominator, is_black};
use super::terms::{LightTerm, Outcome, accumulate, accumulate_light};
use super::vector;
use super::watch::{Note, Watch};
use crate::color::LinearRgb;
use crate::scene::material::Material;

/// Below this |N·L| the side of the terminator is in doubt: N and L are each unit and right to a
/// few 2^-52 when their inputs are, and two paths' weights differ by 2^-48 = 4e-15; 1e-13 leaves
/// room for corner normals that turn quickly.
const TERMINATOR: f64 = 1e-13;

/// Effects that are worth a kernel of their own: each saves per-pixel set-up or transcendental
/// functions. The others are decided once per light, when lights are prepared.
#[derive(Clone, Copy)]
pub(super) struct KernelEffects(pub(super) u8);

impl KernelEffects {
    /// A light at a point: the world position is needed.
    pub(super) const POSITIONAL: Self = Self(1);
    /// Cone or falloff of a spotlight.
    pub(super) const CONE: Self = Self(2);
    /// Specular terms: the eye direction is needed.
    pub(super) const SPECULAR: Self = Self(4);
    /// Interpolated normals.
    pub(super) const NORMALS: Self = Self(8);
    /// Everything, for single points.
    pub(super) const ALL: u8 = 15;

    pub(super) const fn has(self, effect: Self) -> bool {
        self.0 & effect.0 != 0
    }

    pub(super) fn of(effects: Effects) -> Self {
        let pairs = [
            (Effects::POINT.with(Effects::SPOT), Self::POSITIONAL),
            (Effects::CONE.with(Effects::EXPONENT), Self::CONE),
            (Effects::SPECULAR, Self::SPECULAR),
            (Effects::INTERPOLATED_NORMALS, Self::NORMALS),
        ];
        Self(pairs.iter().filter(|(set, _)| effects.has(*set)).map(|(_, bit)| bit.0).sum())
    }

    /// Position in a table over all sets.
    pub(super) fn index(self) -> usize {
        usize::from(self.0)
    }
}

/// The part of a surface point that lights see; what the kernel has no use for is zero.
#[derive(Clone, Copy)]
pub(super) struct Geometry {
    pub(super) position: [f64; 3],
    pub(super) to_eye: [f64; 3],
    pub(super) normal: [f64; 3],
}

/// The equation at one point. Without `geometry` no light has a direction.
pub(super) fn radiance_of<const E: u8, W: Watch>(
    frame: &Frame<'_>,
    material: &Material,
    geometry: Option<&Geometry>,
    watch: &mut W,
) -> LinearRgb {
    let mut radiance = [0.0; 3];
    if frame.effects.has(Effects::EMISSION) {
        watch.evaluated(Effects::EMISSION);
        accumulate(&mut radiance, material.ke);
    }
    for light in &frame.lights {
        let mut term = LightTerm::DARK;
        if let Some(ambient) = light.ambient {
            watch.evaluated(Effects::AMBIENT);
            term.ambient = product(material.ka, ambient);
        }
        if let Some(geometry) = geometry {
            light_up::<E, W>(light, material, geometry, &mut term, watch);
        }
        accumulate_light(&mut radiance, &term);
        watch.light(light.index, &term);
    }
    radiance
}

/// Evaluates the directed part of one light into `term`.
fn light_up<const E: u8, W: Watch>(
    light: &PreparedLight,
    material: &Material,
    geometry: &Geometry,
    term: &mut LightTerm,
    watch: &mut W,
) {
    let effects = const { KernelEffects(E) };
    // Gate by colour: a light that meets no coefficient is not evaluated.
    let diffuse = product(material.kd, light.diffuse);
    let specular = if effects.has(KernelEffects::SPECULAR) {
        product(material.ks, light.specular)
    } else {
        [0.0; 3]
    };
    if is_black(diffuse) && is_black(specular) {
        return;
    }

    // Find the way to the light, and gate by the sign of N·L before anything is divided.
    let (to_light, n_dot_l, reach) = match &light.origin {
        Origin::Direction { to_light } => {
            watch.evaluated(Effects::DIRECTIONAL);
            (*to_light, vector::dot(geometry.normal, *to_light), None)
        }
        Origin::Position(at) if effects.has(KernelEffects::POSITIONAL) => {
            watch.evaluated(at.kind);
            let Some(way) = vector::measure(vector::sub(at.position, geometry.position)) else {
                term.outcome = Outcome::AtSurface;
                watch.note(Note::LightAtSurface);
                return;
            };
            term.distance = Some(way.length);
            let n_dot_l = vector::dot(geometry.normal, way.scaled) / way.scaled_length;
            (way.unit(), n_dot_l, Some((at, way.length)))
        }
        Origin::Position(_) | Origin::Nowhere => return,
    };
    term.n_dot_l = Some(n_dot_l);
    if n_dot_l.abs() < TERMINATOR {
        watch.note(Note::NearTerminator);
    }
    if n_dot_l <= 0.0 {
        term.outcome = Outcome::FacesAway;
        return;
    }

    // Reach of the light: cone, falloff, attenuation.
    let factor = match reach {
        Some((at, distance)) => match reach_factor::<E, W>(at, to_light, distance, watch) {
            Some(factor) => factor,
            None => {
                term.outcome = Outcome::OutsideCone;
                return;
            }
        },
        None => 1.0,
    };
    term.factor = Some(factor);
    if factor == 0.0 {
        term.outcome = Outcome::Faded;
        return;
    }
    term.outcome = Outcome::Lit;

    // Reflect: every number is positive from here on, or a colour channel's 0 times a finite one.
    if !is_black(diffuse) {
        watch.evaluated(Effects::DIFFUSE);
        term.diffuse = diffuse.map(|color| factor * color * n_dot_l);
    }
    if effects.has(KernelEffects::SPECULAR) && !is_black(specular) {
        watch.evaluated(Effects::SPECULAR);
        let Some(half) = halfway(to_light, geometry.to_eye) else {
            watch.note(Note::OppositeView);
            return;
        };
        let q = one_minus_cosine(geometry.normal, half);
        term.n_dot_h = Some(1.0 - q);
        let power = lobe(q, material.ns);
        if power > 0.0 {
            term.specular = specular.map(|color| factor * color * power);
        }
    }
}

/// f of a light at a position, 0…f64::MAX; `None` outside its cone.
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

fn product(a: LinearRgb, b: LinearRgb) -> LinearRgb {
    [a[0] * b[0], a[1] * b[1], a[2] * b[2]]
}
