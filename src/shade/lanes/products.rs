//! Coefficients times the lights' colours: found once for a run of one material, else lane by lane.

use super::LANES;
use super::vector::{self, Reals, Vectors};
use crate::color::LinearRgb;
use crate::shade::coefficients::{Coefficients, product};
use crate::shade::frame::Frame;
use crate::shade::lights::{PreparedLight, is_black};
use crate::shade::reach::RUN;
use fearless_simd::prelude::*;

/// Colours of one light as a surface returns them.
#[derive(Clone, Copy, Debug)]
struct Uniform {
    ambient: LinearRgb,
    diffuse: LinearRgb,
    specular: LinearRgb,
    /// kd, which hemisphere lights mix their two colours by.
    coefficient: LinearRgb,
}

/// Coefficients pixel by pixel, channel by channel: emission, ambient, diffuse, specular; the exponent
/// last. Empty until a run needs them.
pub(super) type Varying = [[f64; RUN]];

/// The coefficients of a run.
#[derive(Default)]
pub(super) struct Products {
    /// The material that `uniform` is of.
    material: Option<u32>,
    is_uniform: bool,
    emission: LinearRgb,
    exponent: f64,
    uniform: Vec<Uniform>,
    /// [`Varying`].
    pub(super) varying: Vec<[f64; RUN]>,
}

/// Where the coefficients of [`Coefficients`] stand in [`Products::varying`].
const EMISSION: usize = 0;
pub(super) const AMBIENT: usize = 3;
pub(super) const DIFFUSE: usize = 6;
pub(super) const SPECULAR: usize = 9;
const EXPONENT: usize = 12;

/// The directed colours of a light in eight lanes.
#[derive(Clone, Copy)]
pub(super) struct Colors<S: Simd> {
    pub(super) diffuse: Vectors<S>,
    pub(super) specular: Vectors<S>,
    pub(super) coefficient: Vectors<S>,
    /// Whether any lane has a diffuse colour: without one nothing is evaluated.
    pub(super) has_diffuse: bool,
    pub(super) has_specular: bool,
}

impl Products {
    /// Takes one material for the whole run.
    pub(super) fn be_uniform(&mut self, frame: &Frame<'_>, material: u32) {
        self.is_uniform = true;
        if self.material == Some(material) {
            return;
        }
        self.material = Some(material);
        let of = Coefficients::of(&frame.scene.materials[material as usize], frame.rules);
        (self.emission, self.exponent) = (of.emission, of.exponent);
        self.uniform.clear();
        self.uniform.extend(frame.lights.iter().map(|light| Uniform {
            ambient: product(of.ambient, light.ambient.unwrap_or([0.0; 3])),
            diffuse: product(of.diffuse, light.diffuse),
            specular: product(of.specular, light.specular),
            coefficient: of.diffuse,
        }));
    }

    /// Takes the coefficients that were [`set`](Self::set) pixel by pixel.
    pub(super) fn be_varying(&mut self) {
        self.is_uniform = false;
    }

    /// Sets the coefficients of one pixel.
    pub(super) fn set(&mut self, pixel: usize, of: &Coefficients) {
        self.varying.resize(EXPONENT + 1, [0.0; RUN]);
        for (at, color) in [
            (EMISSION, of.emission),
            (AMBIENT, of.ambient),
            (DIFFUSE, of.diffuse),
            (SPECULAR, of.specular),
        ] {
            for (row, value) in self.varying[at..at + 3].iter_mut().zip(color) {
                row[pixel] = value;
            }
        }
        self.varying[EXPONENT][pixel] = of.exponent;
    }

    /// Those of eight pixels.
    pub(super) fn lanes(&self, start: usize) -> LaneProducts<'_> {
        LaneProducts { of: self, start }
    }
}

/// The coefficients of eight pixels of a run.
#[derive(Clone, Copy)]
pub(super) struct LaneProducts<'a> {
    of: &'a Products,
    start: usize,
}

impl LaneProducts<'_> {
    #[inline(always)]
    fn varying<S: Simd>(self, simd: S, at: usize) -> Vectors<S> {
        let rows = &self.of.varying;
        [
            vector::load(simd, &rows[at], self.start),
            vector::load(simd, &rows[at + 1], self.start),
            vector::load(simd, &rows[at + 2], self.start),
        ]
    }

    #[inline(always)]
    pub(super) fn exponent<S: Simd>(self, simd: S) -> Reals<S> {
        match self.of.is_uniform {
            true => Reals::splat(simd, self.of.exponent),
            false => vector::load(simd, &self.of.varying[EXPONENT], self.start),
        }
    }

    #[inline(always)]
    pub(super) fn emission<S: Simd>(self, simd: S) -> Vectors<S> {
        match self.of.is_uniform {
            true => vector::splat(simd, self.of.emission),
            false => self.varying(simd, EMISSION),
        }
    }

    /// ka·Ia of the frame's light at `position`.
    #[inline(always)]
    pub(super) fn ambient<S: Simd>(
        self,
        simd: S,
        position: usize,
        ambient: LinearRgb,
    ) -> Vectors<S> {
        match self.of.is_uniform {
            true => vector::splat(simd, self.of.uniform[position].ambient),
            false => vector::product(self.varying(simd, AMBIENT), vector::splat(simd, ambient)),
        }
    }

    /// kd·Id and ks·Is of the frame's light at `position`.
    #[inline(always)]
    pub(super) fn of_light<S: Simd>(
        self,
        simd: S,
        position: usize,
        light: &PreparedLight,
    ) -> Colors<S> {
        if self.of.is_uniform {
            let colors = &self.of.uniform[position];
            return Colors {
                diffuse: vector::splat(simd, colors.diffuse),
                specular: vector::splat(simd, colors.specular),
                coefficient: vector::splat(simd, colors.coefficient),
                has_diffuse: !is_black(colors.diffuse),
                has_specular: !is_black(colors.specular),
            };
        }
        let coefficient = self.varying(simd, DIFFUSE);
        Colors {
            diffuse: vector::product(coefficient, vector::splat(simd, light.diffuse)),
            specular: vector::product(
                self.varying(simd, SPECULAR),
                vector::splat(simd, light.specular),
            ),
            coefficient,
            has_diffuse: !is_black(light.diffuse),
            has_specular: !is_black(light.specular),
        }
    }
}

const _: () = assert!(RUN.is_multiple_of(LANES), "a run is whole lanes");
