//! Coefficients times the lights' colours in f32, for sixteen pixels: `lanes::products`, rounded.

use super::frame::SingleLight;
use super::light::Colors;
use super::vector::{self, Reals, Vectors};
use crate::shade::frame::Frame;
use crate::shade::lanes::products::{AMBIENT, DIFFUSE, EMISSION, EXPONENT, LaneProducts, SPECULAR};
use crate::shade::lights::is_black;
use fearless_simd::prelude::*;

impl LaneProducts<'_> {
    #[inline(always)]
    fn varying_single<S: Simd>(self, simd: S, at: usize) -> Vectors<S> {
        let rows = &self.of.varying;
        [
            vector::narrowed(simd, &rows[at], self.start),
            vector::narrowed(simd, &rows[at + 1], self.start),
            vector::narrowed(simd, &rows[at + 2], self.start),
        ]
    }

    #[inline(always)]
    pub(super) fn exponent_single<S: Simd>(self, simd: S) -> Reals<S> {
        match self.of.is_uniform {
            true => Reals::splat(simd, self.of.exponent as f32),
            false => vector::narrowed(simd, &self.of.varying[EXPONENT], self.start),
        }
    }

    /// ke + Σ ka·Ia.
    #[inline(always)]
    pub(super) fn base_single<S: Simd>(
        self,
        simd: S,
        frame: &Frame<'_>,
        has_emission: bool,
    ) -> Vectors<S> {
        if self.of.is_uniform {
            let of = self.of;
            let emission = if has_emission { of.emission } else { [0.0; 3] };
            let sum = [
                (emission[0] + of.ambient[0]) as f32,
                (emission[1] + of.ambient[1]) as f32,
                (emission[2] + of.ambient[2]) as f32,
            ];
            return vector::splat(simd, sum);
        }
        let mut ambient = [0.0_f64; 3];
        for light in frame.lights.iter().filter_map(|light| light.ambient) {
            ambient = [ambient[0] + light[0], ambient[1] + light[1], ambient[2] + light[2]];
        }
        let ambient = [ambient[0] as f32, ambient[1] as f32, ambient[2] as f32];
        let ambient =
            vector::product(self.varying_single(simd, AMBIENT), vector::splat(simd, ambient));
        match has_emission {
            true => vector::add(self.varying_single(simd, EMISSION), ambient),
            false => ambient,
        }
    }

    /// kd·Id and ks·Is of the frame's light at `position`.
    #[inline(always)]
    pub(super) fn of_light_single<S: Simd>(
        self,
        simd: S,
        position: usize,
        light: &SingleLight,
    ) -> Colors<S> {
        if self.of.is_uniform {
            let colors = &self.of.uniform[position];
            return Colors {
                diffuse: vector::splat(simd, colors.single[0]),
                specular: vector::splat(simd, colors.single[1]),
                has_diffuse: !is_black(colors.diffuse),
                has_specular: !is_black(colors.specular),
            };
        }
        let (diffuse, specular) = (light.diffuse, light.specular);
        Colors {
            diffuse: vector::product(
                self.varying_single(simd, DIFFUSE),
                vector::splat(simd, diffuse),
            ),
            specular: vector::product(
                self.varying_single(simd, SPECULAR),
                vector::splat(simd, specular),
            ),
            has_diffuse: diffuse != [0.0; 3],
            has_specular: specular != [0.0; 3],
        }
    }
}
