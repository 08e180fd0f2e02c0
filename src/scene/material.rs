//! A surface's reflection coefficients, as the shading equation names them.
//!
//! No evaluation lives here; see `shade`.

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
            opacity: 1.0,
        }
    }
}
