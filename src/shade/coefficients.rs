//! The coefficients of a surface at a pixel: those of its material, after textures and switches.
//!
//! Textures are looked up here and nowhere else. Nothing is lit.

use super::effects::Effects;
use super::footprint::footprint;
use super::frame::Frame;
use super::texture::sample;
use super::watch::Watch;
use super::weights::{mix, weights};
use crate::color::LinearRgb;
use crate::pixel::Pixel;
use crate::scene::material::Material;
use crate::scene::switches::Rules;
use crate::scene::texture::{Filter, TextureRef};
use crate::visibility::Visible;

/// The coefficients at a point.
#[derive(Clone, Copy)]
pub(super) struct Coefficients {
    pub(super) emission: LinearRgb,
    pub(super) ambient: LinearRgb,
    pub(super) diffuse: LinearRgb,
    pub(super) specular: LinearRgb,
    pub(super) exponent: f64,
    /// Whether a texture had a part in them, so that they are those of one pixel only.
    pub(super) textured: bool,
}

impl Coefficients {
    /// Those of a material without its textures.
    pub(super) fn of(material: &Material, rules: &Rules) -> Self {
        let ambient = if rules.ambient_by_diffuse { material.kd } else { material.ka };
        Self {
            emission: material.ke,
            ambient,
            diffuse: material.kd,
            specular: material.ks,
            exponent: material.ns,
            textured: false,
        }
    }
}

/// The coefficients of the surface that is visible at a pixel.
pub(super) fn at_pixel<W: Watch>(
    frame: &Frame<'_>,
    pixel: Pixel,
    visible: &Visible,
    material: &Material,
    watch: &mut W,
) -> Coefficients {
    let mut coefficients = Coefficients::of(material, frame.rules);
    let maps = [&material.kd_map, &material.ks_map];
    if maps.iter().all(|map| map.is_none()) || !frame.effects.has(Effects::TEXTURES) {
        return coefficients;
    }
    let Some(uvs) = frame.scene.mesh.uvs_of(visible.triangle) else { return coefficients };
    watch.evaluated(Effects::TEXTURES);
    let uv = mix(weights(frame.scene, visible, watch), uvs);
    let step = maps
        .iter()
        .any(|map| map.as_ref().is_some_and(|map| map.filter == Filter::Mip))
        .then(|| footprint(frame.scene, pixel, visible))
        .flatten();
    let texel =
        |map: &TextureRef| sample(&frame.scene.textures[map.texture as usize], map, uv, step);
    if let Some(map) = &material.kd_map {
        let texel = texel(map);
        coefficients.diffuse = product(coefficients.diffuse, texel);
        if frame.rules.ambient_by_diffuse {
            coefficients.ambient = coefficients.diffuse;
        }
    }
    if let Some(map) = &material.ks_map {
        coefficients.specular = product(coefficients.specular, texel(map));
    }
    coefficients.textured = true;
    coefficients
}

/// The product, channel by channel.
pub(super) fn product(a: LinearRgb, b: LinearRgb) -> LinearRgb {
    [a[0] * b[0], a[1] * b[1], a[2] * b[2]]
}
