//! Lights made ready for a frame: where they are, how far they reach, and what is left of their
//! colours when only the effects that are on count.
//!
//! Everything that is the same at every pixel is found here once. No surface is lit here.

use super::blinn_phong;
use super::effects::Effects;
use crate::color::LinearRgb;
use crate::scene::light::{HemisphereLight, Light, LightColors};
use crate::scene::switches::Rules;

/// Slack of the cone's rim, as a chord between unit vectors (|L − S|): 10·2^-53, so that a point
/// exactly on the rim is lit. L is off by up to 4.5·2^-53 (the root of the squares 2.5, the
/// reciprocal and the product 1 each), S by 3.5·2^-53, the sine and its argument by 2·2^-53. The cone
/// grows by 2.3e-15 rad at most up to a cutoff of 120°.
const RIM_SLACK: f64 = 10.0 * f64::EPSILON / 2.0;

/// A light whose effects are on; a colour that is off or cannot matter is black.
#[derive(Clone, Debug)]
pub(super) struct PreparedLight {
    /// Position in the scene's lights.
    pub(super) index: usize,
    /// I_a, when there is any.
    pub(super) ambient: Option<LinearRgb>,
    /// Whether f weakens I_a too.
    pub(super) fades_ambient: bool,
    /// Whether shadow rays are asked about its directed part.
    pub(super) shadows: bool,
    /// I_d.
    pub(super) diffuse: LinearRgb,
    /// I_s.
    pub(super) specular: LinearRgb,
    /// Where the directed part comes from.
    pub(super) origin: Origin,
}

/// Where the directed part of a light comes from.
#[derive(Clone, Debug)]
pub(super) enum Origin {
    /// It has none.
    Nowhere,
    /// Infinitely far away.
    Direction {
        /// L, unit.
        to_light: [f64; 3],
    },
    /// A point.
    Position(Position),
    /// All around.
    Hemisphere(HemisphereLight),
}

/// A light at a point.
#[derive(Clone, Debug)]
pub(super) struct Position {
    /// The kind, for counting: [`Effects::POINT`] or [`Effects::SPOT`].
    pub(super) kind: Effects,
    /// World position.
    pub(super) position: [f64; 3],
    /// a, b, c, when attenuation is on.
    pub(super) attenuation: Option<[f64; 3]>,
    /// The cone, when it is on and narrower than everything.
    pub(super) cone: Option<Cone>,
}

/// A spotlight's cone.
#[derive(Clone, Debug)]
pub(super) struct Cone {
    /// S = −aim: from the surface to the light when it is hit in the middle.
    pub(super) axis: [f64; 3],
    /// Sine and cosine of the cutoff, when it is on.
    pub(super) sine_cosine: Option<[f64; 2]>,
    /// Largest |L − S|² inside, when the cutoff is on.
    pub(super) largest_squared_chord: Option<f64>,
    /// e of (L·S)^e, when it is on.
    pub(super) exponent: Option<f64>,
}

/// The scene's lights in file order, without those that `effects` leave black.
pub(super) fn prepare(lights: &[Light], rules: &Rules, effects: Effects) -> Vec<PreparedLight> {
    lights
        .iter()
        .enumerate()
        .map(|(index, light)| prepare_light(index, light, rules, effects))
        .filter(|light| light.ambient.is_some() || !matches!(light.origin, Origin::Nowhere))
        .collect()
}

/// All of the scene's lights with all of their parts, black or not.
pub(super) fn prepare_ungated(lights: &[Light], rules: &Rules) -> Vec<PreparedLight> {
    let origin = |light: &Light| match light {
        Light::Hemisphere(hemisphere) => Origin::Hemisphere(*hemisphere),
        light => origin_of(light, Effects::ALL),
    };
    let lights = lights.iter().enumerate();
    lights
        .map(|(index, light)| PreparedLight {
            origin: origin(light),
            shadows: false,
            ..prepare_light(index, light, rules, Effects::ALL)
        })
        .collect()
}

fn prepare_light(index: usize, light: &Light, rules: &Rules, effects: Effects) -> PreparedLight {
    let (colors, kind) = match light {
        Light::Hemisphere(hemisphere) => {
            let on = effects.has(Effects::HEMISPHERE)
                && !(is_black(hemisphere.top) && is_black(hemisphere.bottom));
            let origin = if on { Origin::Hemisphere(*hemisphere) } else { Origin::Nowhere };
            return PreparedLight { origin, ..PreparedLight::black(index) };
        }
        Light::Ambient(light) => {
            let colors =
                LightColors { ambient: light.ambient, diffuse: [0.0; 3], specular: [0.0; 3] };
            (colors, Effects::AMBIENT)
        }
        Light::Directional(light) => (light.colors, Effects::DIRECTIONAL),
        Light::Point(light) => (light.colors, Effects::POINT),
        Light::Spot(light) => (light.colors, Effects::SPOT),
    };
    let when = |on: bool, color: LinearRgb| if on { color } else { [0.0; 3] };
    let directed = effects.has(kind);
    let diffuse = when(directed && effects.has(Effects::DIFFUSE), colors.diffuse);
    let specular = when(directed && effects.has(Effects::SPECULAR), colors.specular);
    let ambient =
        (effects.has(Effects::AMBIENT) && !is_black(colors.ambient)).then_some(colors.ambient);
    let positional = matches!(light, Light::Point(_) | Light::Spot(_));
    let fades_ambient = rules.attenuate_ambient && positional && directed && ambient.is_some();
    let origin = if is_black(diffuse) && is_black(specular) && !fades_ambient {
        Origin::Nowhere
    } else {
        origin_of(light, effects)
    };
    let shadows = light.casts_shadows() && effects.has(Effects::SHADOWS);
    PreparedLight { index, ambient, fades_ambient, shadows, diffuse, specular, origin }
}

impl PreparedLight {
    fn black(index: usize) -> Self {
        Self {
            index,
            ambient: None,
            fades_ambient: false,
            shadows: false,
            diffuse: [0.0; 3],
            specular: [0.0; 3],
            origin: Origin::Nowhere,
        }
    }
}

fn origin_of(light: &Light, effects: Effects) -> Origin {
    let attenuation = |abc: [f64; 3]| effects.has(Effects::ATTENUATION).then_some(abc);
    match light {
        Light::Ambient(_) | Light::Hemisphere(_) => Origin::Nowhere,
        Light::Directional(light) => Origin::Direction { to_light: light.aim.map(|c| -c) },
        Light::Point(light) => Origin::Position(Position {
            kind: Effects::POINT,
            position: light.position,
            attenuation: attenuation(light.attenuation),
            cone: None,
        }),
        Light::Spot(light) => {
            // A cone of 180° is no cone: the cutoff and the exponent are both ignored.
            let has_cone = light.cutoff_deg < 180.0
                && (effects.has(Effects::CONE) || effects.has(Effects::EXPONENT));
            let cone = has_cone.then(|| Cone {
                axis: light.aim.map(|c| -c),
                sine_cosine: effects.has(Effects::CONE).then(|| {
                    let cutoff = light.cutoff_deg.to_radians();
                    [libm::sin(cutoff), libm::cos(cutoff)]
                }),
                largest_squared_chord: effects
                    .has(Effects::CONE)
                    .then(|| largest_squared_chord(light.cutoff_deg)),
                exponent: effects.has(Effects::EXPONENT).then_some(light.exponent),
            });
            Origin::Position(Position {
                kind: Effects::SPOT,
                position: light.position,
                attenuation: attenuation(light.attenuation),
                cone,
            })
        }
    }
}

/// 4 sin²(cutoff/2), with the slack of the rim.
///
/// Comparing |L − S|² keeps all digits of a narrow cone; comparing cosines in f32 widens a cutoff
/// of 0.001° to 0.014°, and in f64 fails below 1e-8 rad.
fn largest_squared_chord(cutoff_deg: f64) -> f64 {
    let chord = 2.0 * libm::sin(cutoff_deg.to_radians() / 2.0) + RIM_SLACK;
    chord * chord
}

impl Cone {
    /// Whether the unit direction `to_light` lies inside or on the rim.
    #[inline]
    pub(super) fn contains(&self, to_light: [f64; 3]) -> bool {
        match self.largest_squared_chord {
            // 2(1 − L·S) is |L − S|².
            Some(largest) => 2.0 * blinn_phong::one_minus_cosine(to_light, self.axis) <= largest,
            None => true,
        }
    }

    /// (L·S)_+^e; 1 when the exponent is off.
    pub(super) fn falloff(&self, to_light: [f64; 3]) -> f64 {
        match self.exponent {
            Some(e) => blinn_phong::lobe(blinn_phong::one_minus_cosine(to_light, self.axis), e),
            None => 1.0,
        }
    }
}

/// a + b·r + c·r² by Horner's rule, for r > 0: c·r² first would over- or underflow where the sum
/// does not. Never NaN; infinite or 0 only beyond the range of f64.
#[inline]
pub(super) fn attenuation_denominator([a, b, c]: [f64; 3], r: f64) -> f64 {
    a + r * (b + c * r)
}

/// Whether a colour is 0 in every channel.
#[inline]
pub(super) fn is_black(color: LinearRgb) -> bool {
    color == [0.0; 3]
}

#[cfg(test)]
mod tests {
    use super::*;

    // C5 and C6: r² under- or overflows in f32 where the quotient is an ordinary number; the same
    // happens in f64 at 1e-200 and 2e190.
    #[test]
    fn c5_c6_attenuation_keeps_its_range() {
        for (abc, r, right) in [
            ([0.0, 0.0, 1.0], 1e-23, 1e46),
            ([0.0, 0.0, 1e38], 1e-23, 1e8),
            ([0.0, 0.0, 1e-38], 2e19, 0.25),
            ([0.0, 0.0, 1e300], 1e-200, 1e100),
            ([0.0, 0.0, 1e-300], 2e190, 2.5e-81),
            ([1.0, 0.0, 0.0], f64::MAX, 1.0),
        ] {
            let value = 1.0 / attenuation_denominator(abc, r);
            assert!((value / right - 1.0).abs() < 1e-15, "{abc:?} {r:e}: {value:e}");
        }
        assert_eq!(1.0 / attenuation_denominator([0.0, 1.0, 1.0], f64::MAX), 0.0);
    }

    // C8: effective half angles of tiny cones, found by bisection. Cosines in f32 make one cone of
    // 0.01399° of the first three.
    #[test]
    fn c8_tiny_cones_have_their_own_size() {
        for cutoff in [1e-6, 0.001, 0.005, 0.01, 0.02, 30.0, 89.0, 90.0, 120.0, 179.0] {
            let cone = Cone {
                axis: [0.0, 0.0, 1.0],
                sine_cosine: None,
                largest_squared_chord: Some(largest_squared_chord(cutoff)),
                exponent: None,
            };
            let (mut inside, mut outside) = (0.0_f64, 180.0_f64);
            for _ in 0..80 {
                let middle = 0.5 * (inside + outside);
                let angle = middle.to_radians();
                if cone.contains([angle.sin(), 0.0, angle.cos()]) {
                    inside = middle;
                } else {
                    outside = middle;
                }
            }
            // Rounding of the chord: 1.2e-15 against a cutoff of 1.7e-8 rad, and over cos(89.5°).
            assert!((inside / cutoff - 1.0).abs() < 1e-6, "{cutoff}: {inside}");
        }
    }

    // C9: cutoff 120°, e = 2.5, L·S = −0.1: powf gives NaN.
    #[test]
    fn c9_falloff_behind_the_light_is_zero() {
        let axis = [0.0, 0.0, 1.0];
        let behind = [(1.0_f64 - 0.01).sqrt(), 0.0, -0.1];
        let largest_squared_chord = Some(largest_squared_chord(120.0));
        let cone = Cone { axis, sine_cosine: None, largest_squared_chord, exponent: Some(2.5) };
        assert!(cone.contains(behind));
        assert_eq!(cone.falloff(behind), 0.0);
        let disc = Cone { axis, sine_cosine: None, largest_squared_chord, exponent: Some(0.0) };
        assert_eq!(disc.falloff(behind), 1.0);
        assert!((cone.falloff([0.6, 0.0, 0.8]) - 0.8_f64.powf(2.5)).abs() < 1e-15);
    }
}
