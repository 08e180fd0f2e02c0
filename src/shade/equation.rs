//! The shading equation, written once, compiled for sets of effects:
//!
//! `ke + Σ_j [ ka·Ia_j + f_j·B_j·( kd·Id_j·(N·L_j) + ks·Is_j·(N·H_j)_+^ns ) ]` with
//! `f_j = (L_j·S_j)_+^e_j · cone_j / (a_j + r_j(b_j + c_j·r_j))`, per channel, f64, in the order of
//! the file; B is 0 iff N·L ≤ 0. Source: Curless, "Shading", iteration four. The switches of a scene
//! put V·R in place of N·H, move the gate of the specular part, weight it by N·L, let f weaken the
//! ambient part, or mix L from the corners. Hemisphere lights add kd·(a·top + (1 − a)·bottom).
//!
//! A term is gated before it is evaluated: what has no colour, no reach or the wrong side is never
//! computed, so no 0·∞ exists. No clamping and no visibility here; whether a light is hidden is asked.

use super::coefficients::{Coefficients, product};
use super::effects::Effects;
use super::falloff::factor_of;
use super::frame::Frame;
use super::geometry::Geometry;
use super::hemisphere::top_share;
use super::kernel_effects::KernelEffects;
use super::lights::{Origin, PreparedLight, is_black};
use super::specular::specular_lobe;
use super::terms::{LightTerm, Outcome, accumulate, accumulate_light};
use super::vector;
use super::watch::{Note, Watch};
use crate::color::LinearRgb;
use crate::scene::light::HemisphereLight;
use crate::scene::switches::{BacklitSpecular, Rules};

/// Below this |N·L| the side of the terminator is in doubt: N and L are each unit and right to a
/// few 2^-52 when their inputs are, and two paths' weights differ by 2^-48 = 4e-15; 1e-13 leaves
/// room for corner normals that turn quickly.
pub(super) const TERMINATOR: f64 = 1e-13;

/// What is known beforehand of the lights at a point.
#[derive(Clone, Copy)]
pub(super) struct Lighting<'a> {
    /// Per prepared light, whether it may reach the point; all do where the list is shorter.
    pub(super) reaches: &'a [bool],
    /// Whether the light at a position of the scene's list is hidden from the point.
    pub(super) is_hidden: &'a dyn Fn(usize) -> bool,
}

impl Lighting<'static> {
    /// Every light may reach the point, and nothing hides one.
    pub(super) const OPEN: Self = Self { reaches: &[], is_hidden: &|_| false };
}

/// The equation at one point. Without `geometry` no light has a direction.
pub(super) fn radiance_of<const E: u8, W: Watch>(
    frame: &Frame<'_>,
    coefficients: &Coefficients,
    geometry: Option<&Geometry>,
    lighting: Lighting<'_>,
    watch: &mut W,
) -> LinearRgb {
    let mut radiance = [0.0; 3];
    if frame.effects.has(Effects::EMISSION) {
        watch.evaluated(Effects::EMISSION);
        accumulate(&mut radiance, coefficients.emission);
    }
    for (position, light) in frame.lights.iter().enumerate() {
        let mut term = LightTerm::DARK;
        if let Some(ambient) = light.ambient {
            watch.evaluated(Effects::AMBIENT);
            term.ambient = product(coefficients.ambient, ambient);
        }
        if lighting.reaches.get(position) == Some(&false) {
            term.outcome = Outcome::OutsideCone;
            if light.fades_ambient {
                term.ambient = [0.0; 3];
            }
        } else if let Some(geometry) = geometry {
            let (rules, is_hidden) = (frame.rules, lighting.is_hidden);
            light_up::<E, W>(light, rules, coefficients, geometry, is_hidden, &mut term, watch);
        }
        accumulate_light(&mut radiance, &term);
        watch.light(light.index, &term);
    }
    radiance
}

/// Evaluates the directed part of one light into `term`.
fn light_up<const E: u8, W: Watch>(
    light: &PreparedLight,
    rules: &Rules,
    coefficients: &Coefficients,
    geometry: &Geometry,
    is_hidden: &dyn Fn(usize) -> bool,
    term: &mut LightTerm,
    watch: &mut W,
) {
    let effects = const { KernelEffects(E) };
    if let Origin::Hemisphere(hemisphere) = &light.origin {
        return light_up_from_all_around(hemisphere, rules, coefficients, geometry, term, watch);
    }

    // Gate by colour: a light that meets no coefficient is not evaluated.
    let diffuse = product(coefficients.diffuse, light.diffuse);
    let specular = if effects.has(KernelEffects::SPECULAR) {
        product(coefficients.specular, light.specular)
    } else {
        [0.0; 3]
    };
    let is_directed = W::UNGATED || !is_black(diffuse) || !is_black(specular);
    let fades_ambient = light.fades_ambient && !is_black(term.ambient);
    if !is_directed && !fades_ambient {
        return;
    }

    // Find the way to the light, and N·L before anything is divided.
    let (mut to_light, mut n_dot_l, reach) = match &light.origin {
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
            let n_dot_l = vector::dot(geometry.normal, way.scaled) * way.inverse();
            (way.unit(), n_dot_l, Some((at, way.length)))
        }
        Origin::Position(_) | Origin::Hemisphere(_) | Origin::Nowhere => return,
    };

    // Reach of the light, where its ambient part asks for it: cone, falloff, attenuation.
    let true_to_light = to_light;
    let mut known_factor = None;
    if fades_ambient {
        let factor = factor_of::<E, W>(reach, true_to_light, watch);
        term.ambient = match factor {
            Some(share) if share > 0.0 => term.ambient.map(|value| value * share),
            _ => [0.0; 3],
        };
        known_factor = Some(factor);
        if !is_directed {
            return;
        }
    }

    // Gate by the normal: a face too thin to have one has no side, whatever the switches say.
    if geometry.normal == [0.0; 3] {
        term.outcome = Outcome::NoNormal;
        return;
    }

    // Gate by the sign of N·L.
    if let (Some(mixture), Some((at, _))) = (&geometry.mixture, reach) {
        let Some(mixed) = mixture.direction_to(at.position) else {
            term.outcome = Outcome::NoDirection;
            watch.note(Note::CancelledVectors);
            return;
        };
        to_light = mixed;
        n_dot_l = vector::dot(geometry.normal, mixed);
    }
    n_dot_l *= geometry.normal_length;
    term.n_dot_l = Some(n_dot_l);
    let shines = effects.has(KernelEffects::SPECULAR)
        && (W::UNGATED || !is_black(specular))
        && match rules.backlit_specular {
            BacklitSpecular::DarkUpTo => n_dot_l > 0.0,
            BacklitSpecular::DarkBelow => n_dot_l >= 0.0,
            BacklitSpecular::NeverDark => true,
        };
    let is_doubtful = n_dot_l.abs() < TERMINATOR;
    if n_dot_l <= 0.0 && !shines && !is_doubtful {
        term.outcome = Outcome::FacesAway;
        return;
    }

    // Reach of the light.
    let factor = match known_factor {
        Some(factor) => factor,
        None => factor_of::<E, W>(reach, true_to_light, watch),
    };
    let Some(factor) = factor else {
        term.outcome = Outcome::OutsideCone;
        return;
    };
    term.factor = Some(factor);
    if factor == 0.0 {
        term.outcome = Outcome::Faded;
        return;
    }

    // A light that reaches the point leaves its side in doubt here.
    if is_doubtful {
        watch.note(Note::NearTerminator);
        if n_dot_l <= 0.0 && !shines {
            term.outcome = Outcome::FacesAway;
            return;
        }
    }

    // Ask for a shadow last: it costs most.
    if light.shadows {
        watch.evaluated(Effects::SHADOWS);
        if is_hidden(light.index) {
            term.outcome = Outcome::Shadowed;
            return;
        }
    }
    term.outcome = Outcome::Lit;

    // Reflect: every number is positive from here on, or a colour channel's 0 times a finite one.
    if (W::UNGATED || !is_black(diffuse)) && n_dot_l > 0.0 {
        watch.evaluated(Effects::DIFFUSE);
        term.diffuse = diffuse.map(|color| factor * color * n_dot_l);
    }
    if shines {
        // The corners' directions to the eye may cancel as those to a light do.
        if geometry.to_eye == [0.0; 3] {
            watch.note(Note::CancelledVectors);
            return;
        }
        watch.evaluated(Effects::SPECULAR);
        let Some((cosine, power)) = specular_lobe(rules, geometry, to_light, coefficients.exponent)
        else {
            watch.note(Note::OppositeView);
            return;
        };
        term.n_dot_h = Some(cosine);
        let weight = if rules.specular_cosine { n_dot_l.max(0.0) } else { 1.0 };
        if power > 0.0 && weight > 0.0 {
            term.specular = specular.map(|color| factor * color * power * weight);
        }
    }
}

/// kd·(a·top + (1 − a)·bottom): no gate, no distance.
fn light_up_from_all_around<W: Watch>(
    light: &HemisphereLight,
    rules: &Rules,
    coefficients: &Coefficients,
    geometry: &Geometry,
    term: &mut LightTerm,
    watch: &mut W,
) {
    if !W::UNGATED && is_black(coefficients.diffuse) {
        return;
    }
    if geometry.normal == [0.0; 3] {
        term.outcome = Outcome::NoNormal;
        return;
    }
    watch.evaluated(Effects::HEMISPHERE);
    term.outcome = Outcome::Lit;
    let normal = vector::scaled(geometry.normal, geometry.normal_length);
    let a = top_share(rules.hemisphere, normal, light.up);
    term.diffuse = std::array::from_fn(|k| match coefficients.diffuse[k] {
        0.0 => 0.0,
        kd => kd * (a * light.top[k] + (1.0 - a) * light.bottom[k]),
    });
}
