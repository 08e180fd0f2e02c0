//! A surface's reflection coefficients, as the shading equation names them.
//!
//! No evaluation lives here; see `shade`.
//!
//! # Presets
//!
//! Starting points by the advice of Curless, "Shading": a small ka (about 0.1 of the colour), and
//! the sum of ka, kd and ks below 1 in every channel. A metal has a large exponent (Angel: 100 to
//! 200), little diffuse and much specular reflection, both in its colour; a plastic has a medium
//! exponent, medium diffuse reflection in its colour and medium specular reflection in white; a
//! planet has no highlight. The numbers are ours.
//!
//! | word | ka | kd | ks | ns | why |
//! |---|---|---|---|---|---|
//! | `metal` | 0.1, 0.08, 0.04 | 0.2, 0.16, 0.08 | 0.6, 0.48, 0.24 | 150 | brass: one colour (1, 0.8, 0.4) times 0.1, 0.2 and 0.6; ns in the middle of 100…200 |
//! | `plastic` | 0.02, 0.05, 0.1 | 0.1, 0.25, 0.5 | 0.35 | 20 | blue (0.2, 0.5, 1) times 0.1 and 0.5, white highlight; ns between Angel's 5…10 and a metal's |
//! | `planet` | 0.1 | 0.8 | 0 | 0 | grey for a map or another `kd`; no highlight |
//! | `clay` | 0.1, 0.06, 0.045 | 0.8, 0.48, 0.36 | 0 | 0 | matte terracotta (1, 0.6, 0.45) times 0.1 and 0.8 |
//! | `red-plastic` | 0.1, 0.005, 0.005 | 0.6, 0.03, 0.03 | 0.25 | 30 | red (1, 0.05, 0.05) times 0.1 and 0.6, small white highlight that shows on a dark red |

use super::texture::TextureRef;
use crate::color::LinearRgb;

/// Blinn-Phong coefficients. Every value is finite and at least 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Name in the scene file or MTL library; "default" for the material of bare meshes.
    pub name: String,
    /// k_a: reflection of ambient light.
    pub ka: LinearRgb,
    /// k_d: diffuse reflection.
    pub kd: LinearRgb,
    /// k_s: specular reflection.
    pub ks: LinearRgb,
    /// k_e: emission.
    pub ke: LinearRgb,
    /// n_s: specular exponent.
    pub ns: f64,
    /// Multiplies `kd`, on triangles with texture coordinates. `ka` is not textured. `None` too
    /// where no triangle wears the material: its textures are not read.
    pub kd_map: Option<TextureRef>,
    /// Multiplies `ks`, likewise.
    pub ks_map: Option<TextureRef>,
    /// Radiance is kd (times its map), whatever the lights.
    pub unlit: bool,
    /// How much of the surface there is for the eye, 0…1: below 1 what lies behind is seen through
    /// it.
    pub opacity: f64,
}

impl Material {
    /// The material of surfaces that name none: kd 0.8, ka = kd, no specular, no emission, ns 32,
    /// opaque.
    pub fn default_named(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            ka: [0.8; 3],
            kd: [0.8; 3],
            ks: [0.0; 3],
            ke: [0.0; 3],
            ns: 32.0,
            kd_map: None,
            ks_map: None,
            unlit: false,
            opacity: 1.0,
        }
    }

    /// The names of the presets.
    pub const PRESETS: [&str; 5] = ["metal", "plastic", "planet", "clay", "red-plastic"];

    /// The coefficients of a preset under a name of its own; `None` when there is no such preset.
    pub fn preset(word: &str, name: &str) -> Option<Self> {
        let (ka, kd, ks, ns) = match word {
            "metal" => ([0.1, 0.08, 0.04], [0.2, 0.16, 0.08], [0.6, 0.48, 0.24], 150.0),
            "plastic" => ([0.02, 0.05, 0.1], [0.1, 0.25, 0.5], [0.35; 3], 20.0),
            "planet" => ([0.1; 3], [0.8; 3], [0.0; 3], 0.0),
            "clay" => ([0.1, 0.06, 0.045], [0.8, 0.48, 0.36], [0.0; 3], 0.0),
            "red-plastic" => ([0.1, 0.005, 0.005], [0.6, 0.03, 0.03], [0.25; 3], 30.0),
            _ => return None,
        };
        Some(Self { ka, kd, ks, ns, ..Self::default_named(name) })
    }

    /// The largest kd + ks of a channel where it exceeds 1: more light may then leave the surface
    /// than arrives. (ka is left out, since the usual ka = kd stands for light from elsewhere.)
    pub fn excess(&self) -> Option<f64> {
        let sums = [0, 1, 2].map(|k| self.kd[k] + self.ks[k]);
        let largest = sums.into_iter().fold(0.0, f64::max);
        (largest > 1.0).then_some(largest)
    }
}
