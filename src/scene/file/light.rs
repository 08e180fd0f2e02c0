//! `[[light]]` as written.

use super::keys::Keys;
use super::text::{Faults, Span};
use super::values::{boolean, number, numbers, text};
use toml::Spanned;

/// `[[light]]`: the keys of all types; which type has a use for which is decided later.
#[derive(Clone, Debug)]
pub struct LightFile {
    /// Name by which programs refer to it.
    pub name: Option<Spanned<String>>,
    /// The frame of its points and directions.
    pub parent: Option<Spanned<String>>,
    /// Its type.
    pub kind: Spanned<String>,
    /// Where it is.
    pub position: Option<Spanned<[f64; 3]>>,
    /// What it aims at.
    pub target: Option<Spanned<[f64; 3]>>,
    /// The way its light travels.
    pub aim: Option<Spanned<[f64; 3]>>,
    /// Diffuse and specular colour.
    pub intensity: Option<Spanned<[f64; 3]>>,
    /// Diffuse colour.
    pub diffuse: Option<Spanned<[f64; 3]>>,
    /// Specular colour.
    pub specular: Option<Spanned<[f64; 3]>>,
    /// Ambient colour.
    pub ambient: Option<Spanned<[f64; 3]>>,
    /// a, b, c of 1/(a + b·r + c·r²).
    pub attenuation: Option<Spanned<[f64; 3]>>,
    /// Angle from the axis to the rim of the cone, degrees.
    pub cutoff_deg: Option<Spanned<f64>>,
    /// Exponent of L·S.
    pub exponent: Option<Spanned<f64>>,
    /// Whether the light casts shadows.
    pub shadows: Option<Spanned<bool>>,
    /// Towards the top colour.
    pub direction: Option<Spanned<[f64; 3]>>,
    /// Top colour.
    pub top: Option<Spanned<[f64; 3]>>,
    /// Bottom colour.
    pub bottom: Option<Spanned<[f64; 3]>>,
    /// All keys that are written, and where.
    pub written: Vec<Spanned<String>>,
    /// Bytes of the text at which the light begins.
    pub span: Span,
}

impl LightFile {
    pub(super) fn read(mut keys: Keys<'_, '_>, faults: &mut Faults<'_>) -> Option<Self> {
        let span = keys.header.clone();
        let written = keys.written();
        let kind = keys.require("type", text, faults);
        let name = keys.read("name", text, faults);
        let parent = keys.read("parent", text, faults);
        let position = keys.read("position", numbers, faults);
        let target = keys.read("target", numbers, faults);
        let aim = keys.read("aim", numbers, faults);
        let intensity = keys.read("intensity", numbers, faults);
        let diffuse = keys.read("diffuse", numbers, faults);
        let specular = keys.read("specular", numbers, faults);
        let ambient = keys.read("ambient", numbers, faults);
        let attenuation = keys.read("attenuation", numbers, faults);
        let cutoff_deg = keys.read("cutoff_deg", number, faults);
        let exponent = keys.read("exponent", number, faults);
        let shadows = keys.read("shadows", boolean, faults);
        let direction = keys.read("direction", numbers, faults);
        let top = keys.read("top", numbers, faults);
        let bottom = keys.read("bottom", numbers, faults);
        if !keys.close(faults) {
            return None;
        }
        Some(Self {
            name,
            parent,
            kind: kind?,
            position,
            target,
            aim,
            intensity,
            diffuse,
            specular,
            ambient,
            attenuation,
            cutoff_deg,
            exponent,
            shadows,
            direction,
            top,
            bottom,
            written,
            span,
        })
    }
}
