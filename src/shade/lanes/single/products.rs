//! Coefficients times the lights' colours in f32: those of one material, found once for all
//! neighbouring pixels that wear it. Which other materials a run holds changes no bit.

use super::frame::SingleLight;
use super::light::Reflected;
use super::vector::{self, Vectors};
use crate::shade::coefficients::{Coefficients, product};
use crate::shade::effects::Effects;
use crate::shade::frame::Frame;
use crate::shade::lanes::products::{AMBIENT, DIFFUSE, SPECULAR, Varying};
use crate::shade::lights::is_black;
use fearless_simd::prelude::*;

/// kd·Id and ks·Is of a light, and whether there are any.
#[derive(Clone, Copy, Debug)]
pub(super) struct Directed {
    diffuse: [f32; 3],
    specular: [f32; 3],
    has_diffuse: bool,
    /// ns, where there is a highlight.
    pub(super) exponent: Option<f32>,
}

impl Directed {
    /// Whether it is black.
    pub(super) fn is_black(&self) -> bool {
        !self.has_diffuse && self.exponent.is_none()
    }
}

/// The products of a material without its textures.
#[derive(Default)]
pub(in crate::shade::lanes) struct SingleProducts {
    material: Option<u32>,
    /// ke + Σ ka·Ia.
    base: [f32; 3],
    /// ke and Σ Ia, for a ka of each pixel.
    emission: [f32; 3],
    ambient: [f32; 3],
    /// Per light of the frame.
    pub(super) directed: Vec<Directed>,
}

impl SingleProducts {
    /// Takes a material.
    pub(super) fn wear(&mut self, frame: &Frame<'_>, material: u32) {
        if self.material == Some(material) {
            return;
        }
        self.material = Some(material);
        let of = Coefficients::of(&frame.scene.materials[material as usize], frame.rules);
        let narrowed = |v: [f64; 3]| v.map(|c| c as f32);
        let emission = if frame.effects.has(Effects::EMISSION) { of.emission } else { [0.0; 3] };
        let (mut base, mut ambient) = (emission, [0.0; 3]);
        for light in frame.lights.iter().filter_map(|light| light.ambient) {
            let returned = product(of.ambient, light);
            for k in 0..3 {
                base[k] += returned[k];
                ambient[k] += light[k];
            }
        }
        self.base = narrowed(base);
        self.emission = narrowed(emission);
        self.ambient = narrowed(ambient);
        self.directed.clear();
        self.directed.extend(frame.lights.iter().map(|light| {
            let (diffuse, specular) =
                (product(of.diffuse, light.diffuse), product(of.specular, light.specular));
            Directed {
                diffuse: narrowed(diffuse),
                specular: narrowed(specular),
                has_diffuse: !is_black(diffuse),
                exponent: (!is_black(specular)).then_some(of.exponent as f32),
            }
        }));
    }

    /// ke + Σ ka·Ia. `varying` holds the coefficients of textured pixels.
    #[inline(always)]
    pub(super) fn base<S: Simd>(
        &self,
        simd: S,
        varying: Option<&Varying>,
        start: usize,
    ) -> Vectors<S> {
        match varying {
            None => vector::splat(simd, self.base),
            Some(rows) => {
                let ambient = rows_at(simd, rows, AMBIENT, start);
                let ambient = vector::product(ambient, vector::splat(simd, self.ambient));
                vector::add(vector::splat(simd, self.emission), ambient)
            }
        }
    }
}

/// Adds what is returned of a light.
#[inline(always)]
pub(super) fn add<S: Simd>(
    simd: S,
    directed: &Directed,
    varying: Option<(&Varying, &SingleLight)>,
    start: usize,
    reflected: &Reflected<S>,
    rgb: &mut Vectors<S>,
) {
    if directed.has_diffuse {
        let color = match varying {
            None => vector::splat(simd, directed.diffuse),
            Some((rows, light)) => {
                let color = vector::splat(simd, light.diffuse);
                vector::product(rows_at(simd, rows, DIFFUSE, start), color)
            }
        };
        *rgb = vector::add(*rgb, vector::scaled(color, reflected.matte));
    }
    if directed.exponent.is_some() {
        let color = match varying {
            None => vector::splat(simd, directed.specular),
            Some((rows, light)) => {
                let color = vector::splat(simd, light.specular);
                vector::product(rows_at(simd, rows, SPECULAR, start), color)
            }
        };
        *rgb = vector::add(*rgb, vector::scaled(color, reflected.highlight));
    }
}

#[inline(always)]
fn rows_at<S: Simd>(simd: S, rows: &Varying, at: usize, start: usize) -> Vectors<S> {
    [
        vector::narrowed(simd, &rows[at], start),
        vector::narrowed(simd, &rows[at + 1], start),
        vector::narrowed(simd, &rows[at + 2], start),
    ]
}
