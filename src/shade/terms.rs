//! Every term of the shading equation at one point, for people who ask why a pixel has its colour.

use super::surface::SurfacePoint;
use super::watch::Watch;
use crate::color::LinearRgb;

/// How far the evaluation of a light went, and why it stopped there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// The light's diffuse and specular colours meet no coefficient of the material.
    NoColor,
    /// The light lies at the surface point: it has no direction.
    AtSurface,
    /// B = 0: N·L ≤ 0.
    FacesAway,
    /// Outside the spotlight's cone.
    OutsideCone,
    /// The factor f is 0 in f64 (falloff or attenuation).
    Faded,
    /// An opaque surface lies between the surface point and the light.
    Shadowed,
    /// Directions interpolated from the corners cancelled.
    NoDirection,
    /// The face is too thin to have a normal.
    NoNormal,
    /// It reaches the surface.
    Lit,
}

impl Outcome {
    /// One short phrase.
    pub const fn describe(self) -> &'static str {
        match self {
            Self::NoColor => "no directed colour",
            Self::AtSurface => "at the surface point",
            Self::FacesAway => "behind the surface",
            Self::OutsideCone => "outside the cone",
            Self::Faded => "faded to nothing",
            Self::Shadowed => "in shadow",
            Self::NoDirection => "without direction",
            Self::NoNormal => "without a normal to meet",
            Self::Lit => "lit",
        }
    }
}

/// One light's part of a radiance. What was not evaluated is `None`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightTerm {
    /// How far the evaluation went.
    pub outcome: Outcome,
    /// ka·Ia, times f where the switch `attenuate_ambient` says so.
    pub ambient: LinearRgb,
    /// f·B·kd·Id·(N·L); of a hemisphere light kd·(a·top + (1 − a)·bottom).
    pub diffuse: LinearRgb,
    /// f·B·ks·Is·(N·H)_+^ns, or with (V·R)_+, as the switches say.
    pub specular: LinearRgb,
    /// r, world units; for lights at a position.
    pub distance: Option<f64>,
    /// N·L.
    pub n_dot_l: Option<f64>,
    /// f: falloff, cone and attenuation together.
    pub factor: Option<f64>,
    /// N·H, or V·R with Phong's lobe.
    pub n_dot_h: Option<f64>,
}

impl LightTerm {
    /// A light that gives nothing.
    pub(super) const DARK: Self = Self {
        outcome: Outcome::NoColor,
        ambient: [0.0; 3],
        diffuse: [0.0; 3],
        specular: [0.0; 3],
        distance: None,
        n_dot_l: None,
        factor: None,
        n_dot_h: None,
    };

    /// B: 1 where N·L > 0, 0 where N·L ≤ 0, `None` where N·L was not evaluated.
    pub fn gate(&self) -> Option<u8> {
        self.n_dot_l.map(|cosine| u8::from(cosine > 0.0))
    }
}

/// The whole sum at one pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct Terms {
    /// Where it was evaluated.
    pub surface: SurfacePoint,
    /// ke; of a surface that is not lit, its colour.
    pub emission: LinearRgb,
    /// One term per light of the scene, in file order. Where the equation is evaluated elsewhere
    /// than at the pixel, those of the last such point, for their outcomes.
    pub lights: Vec<LightTerm>,
    /// Where colours are those of other points: each point's weight and its lights' terms.
    pub elsewhere: Vec<(f64, Vec<LightTerm>)>,
}

impl Terms {
    /// The radiance, summed as the shading kernel sums it: bit for bit the pixel's value.
    pub fn sum(&self) -> LinearRgb {
        let sum = |lights: &[LightTerm]| {
            let mut radiance = [0.0; 3];
            accumulate(&mut radiance, self.emission);
            for light in lights {
                accumulate_light(&mut radiance, light);
            }
            radiance
        };
        match self.elsewhere.as_slice() {
            [] => sum(&self.lights),
            [(_, lights)] => sum(lights),
            points => {
                let mut radiance = [0.0; 3];
                for (weight, lights) in points.iter().filter(|(weight, _)| *weight > 0.0) {
                    accumulate(&mut radiance, sum(lights).map(|value| weight * value));
                }
                radiance
            }
        }
    }
}

/// The order of summation that every reader of the equation shares.
#[inline(always)]
pub(super) fn accumulate_light(radiance: &mut LinearRgb, term: &LightTerm) {
    accumulate(radiance, term.ambient);
    accumulate(radiance, term.diffuse);
    accumulate(radiance, term.specular);
}

#[inline(always)]
pub(super) fn accumulate(radiance: &mut LinearRgb, part: LinearRgb) {
    for (sum, value) in radiance.iter_mut().zip(part) {
        *sum += value;
    }
}

impl Watch for Vec<LightTerm> {
    fn light(&mut self, index: usize, term: &LightTerm) {
        self[index] = *term;
    }
}
