//! Lights as the shading equation needs them: checked, complete, without evaluation.

use crate::color::LinearRgb;

/// A light, by kind.
#[derive(Clone, Debug, PartialEq)]
pub enum Light {
    /// The global ambient: adds ka · ambient.
    Ambient(AmbientLight),
    /// Light from infinitely far away.
    Directional(DirectionalLight),
    /// Light from a point, equally in all directions.
    Point(PointLight),
    /// Light from a point, in a cone.
    Spot(SpotLight),
    /// Light from two opposite half spaces.
    Hemisphere(HemisphereLight),
}

impl Light {
    /// The word for its type in scene files.
    pub const fn kind(&self) -> &'static str {
        match self {
            Self::Ambient(_) => "ambient",
            Self::Directional(_) => "directional",
            Self::Point(_) => "point",
            Self::Spot(_) => "spot",
            Self::Hemisphere(_) => "hemisphere",
        }
    }

    /// Whether its diffuse and specular parts stop at opaque surfaces.
    pub const fn casts_shadows(&self) -> bool {
        match self {
            Self::Ambient(_) | Self::Hemisphere(_) => false,
            Self::Directional(light) => light.shadows,
            Self::Point(light) => light.shadows,
            Self::Spot(light) => light.shadows,
        }
    }
}

/// The three colours that a light with a direction sends out; each finite and at least 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightColors {
    /// I_a: its own ambient part; never gated, and attenuated only where a switch says so.
    pub ambient: LinearRgb,
    /// I_d: diffuse part.
    pub diffuse: LinearRgb,
    /// I_s: specular part.
    pub specular: LinearRgb,
}

/// The global ambient light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AmbientLight {
    /// I_a.
    pub ambient: LinearRgb,
}

/// A light at infinity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DirectionalLight {
    /// Unit direction in which the light travels; L = −aim.
    pub aim: [f64; 3],
    /// Colours.
    pub colors: LightColors,
    /// Whether opaque surfaces stop its diffuse and specular parts.
    pub shadows: bool,
}

/// A light at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointLight {
    /// World position.
    pub position: [f64; 3],
    /// a, b, c of 1/(a + b·r + c·r²): finite, at least 0, not all 0.
    pub attenuation: [f64; 3],
    /// Colours.
    pub colors: LightColors,
    /// Whether opaque surfaces stop its diffuse and specular parts.
    pub shadows: bool,
}

/// A spotlight: a point light times (L·S)^e inside its cone, S = −aim.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpotLight {
    /// World position.
    pub position: [f64; 3],
    /// Unit direction in which the light aims.
    pub aim: [f64; 3],
    /// a, b, c of 1/(a + b·r + c·r²): finite, at least 0, not all 0.
    pub attenuation: [f64; 3],
    /// Angle from the axis to the rim of the cone, degrees, 0 < cutoff ≤ 180; 180 is no cone, and
    /// the exponent is ignored then.
    pub cutoff_deg: f64,
    /// e ≥ 0 of (L·S)^e.
    pub exponent: f64,
    /// Colours.
    pub colors: LightColors,
    /// Whether opaque surfaces stop its diffuse and specular parts.
    pub shadows: bool,
}

/// Two-coloured light from all around: kd · (a · top + (1 − a) · bottom), where a falls from 1 for
/// normals towards `up` to 0 for those away from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HemisphereLight {
    /// Unit direction towards the top colour.
    pub up: [f64; 3],
    /// Colour of the half space around `up`.
    pub top: LinearRgb,
    /// Colour of the other half space.
    pub bottom: LinearRgb,
}
