//! A surface's reflection coefficients, as the shading equation names them.
//!
//! No evaluation lives here; see `shade`.

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
}

impl Material {
    /// The material of surfaces that name none: kd 0.8, ka = kd, no specular, no emission, ns 32.
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
        }
    }
}
