//! A run in f32: points and directions relative to the eye, the lights one after the other, and
//! which pixels are left to f64.

use super::frame::SingleFrame;
use super::light::{Point, add_light};
use super::normals::mix_normals;
use super::vector::{self, Mask, Reals, Vectors};
use super::{LANES, SMALLEST_MEAN, SQUARED_DISTANCES, T_WIDTH};
use crate::color::LinearRgb;
use crate::pixel::Pixel;
use crate::shade::effects::Effects;
use crate::shade::frame::{Frame, RowAsker, is_hidden};
use crate::shade::lanes::run::Run;
use crate::shade::lanes::vector::{Reals as Doubles, load};
use crate::shade::lanes::{Stretch, place};
use crate::shade::reach::{Bounds, RUN};
use fearless_simd::prelude::*;

/// Chunks of a run.
const CHUNKS: usize = RUN / LANES;

/// Sixteen points before any light.
#[derive(Clone, Copy)]
struct Place<S: Simd> {
    position: Vectors<S>,
    to_eye: Vectors<S>,
    doubtful: Mask<S>,
}

/// Shades the pixels of a gathered run in f32, and says by bits which of them are done.
#[inline(always)]
pub(in crate::shade::lanes) fn shade<S: Simd>(
    simd: S,
    frame: &Frame<'_>,
    single: &SingleFrame,
    stretch: &Stretch<'_>,
    run: &mut Run,
    asker: &RowAsker<'_>,
    radiance: &mut [LinearRgb],
) -> u32 {
    mix_normals(simd, run);
    let mut places = [place(simd, frame, stretch.first, run, 0); CHUNKS];
    for (chunk, place_of) in places.iter_mut().enumerate().skip(1) {
        if run.live >> (chunk * LANES) != 0 {
            *place_of = place(simd, frame, stretch.first, run, chunk * LANES);
        }
    }
    if frame.selects_lights {
        let bounds = bounds(simd, frame, run, &places);
        frame.cones.mark_with(simd, &bounds, &mut run.reaches);
    }
    let mut done = 0;
    for (chunk, place) in places.iter().enumerate() {
        let start = chunk * LANES;
        let live = run.live >> start & 0xffff;
        if live == 0 {
            continue;
        }
        let (rgb, certain) = shade_chunk(simd, frame, single, stretch, run, asker, place, start);
        let rgb = [rgb[0].to_array(), rgb[1].to_array(), rgb[2].to_array()];
        let out = &mut radiance[start..];
        match out.first_chunk_mut::<LANES>() {
            Some(out) if certain == 0xffff => {
                for (lane, out) in out.iter_mut().enumerate() {
                    *out = [rgb[0][lane].into(), rgb[1][lane].into(), rgb[2][lane].into()];
                }
            }
            _ => {
                for (lane, out) in out.iter_mut().take(LANES).enumerate() {
                    if certain >> lane & 1 != 0 {
                        *out = [rgb[0][lane].into(), rgb[1][lane].into(), rgb[2][lane].into()];
                    }
                }
            }
        }
        done |= certain << start;
    }
    done
}

/// Where the points are as the eye sees them, and in which lanes that is not known well enough.
#[inline(always)]
fn place<S: Simd>(simd: S, frame: &Frame<'_>, first: Pixel, run: &Run, start: usize) -> Place<S> {
    let (t0, known0) = parameters(simd, run, start);
    let (t1, known1) = parameters(simd, run, start + LANES / 2);
    let t = t0.narrow(t1);
    let ray0 = place::ray_directions(simd, frame, first, start);
    let ray1 = place::ray_directions(simd, frame, first, start + LANES / 2);
    let ray = [ray0[0].narrow(ray1[0]), ray0[1].narrow(ray1[1]), ray0[2].narrow(ray1[2])];
    let squared = vector::squared_length(ray);
    let to_eye = if frame.rules.distant_viewer {
        let axis = frame.scene.camera.axis();
        vector::splat(simd, [-axis[0] as f32, -axis[1] as f32, -axis[2] as f32])
    } else {
        vector::scaled(ray, Reals::splat(simd, -1.0) / squared.sqrt())
    };
    let known = Mask::from_bitmask(simd, known0 | known1 << (LANES / 2))
        & squared.simd_ge(SQUARED_DISTANCES[0])
        & squared.simd_le(SQUARED_DISTANCES[1]);
    Place { position: vector::scaled(ray, t), to_eye, doubtful: !known }
}

/// t in the middle of its interval, and in which lanes the interval is narrow enough.
#[inline(always)]
fn parameters<S: Simd>(simd: S, run: &Run, start: usize) -> (Doubles<S>, u64) {
    let low = load(simd, &run.t_low, start);
    let half = (load(simd, &run.t_high, start) - low) * 0.5;
    let t = low + half;
    (t, half.simd_le(t * T_WIDTH).to_bitmask())
}

/// A box around the live points, by more than the 3·2^-24 of the largest by which they are off.
#[inline(always)]
fn bounds<S: Simd>(simd: S, frame: &Frame<'_>, run: &Run, places: &[Place<S>; CHUNKS]) -> Bounds {
    let mut low = vector::splat(simd, [f32::INFINITY; 3]);
    let mut high = vector::splat(simd, [f32::NEG_INFINITY; 3]);
    for (chunk, place) in places.iter().enumerate() {
        let live = Mask::from_bitmask(simd, u64::from(run.live >> (chunk * LANES) & 0xffff));
        let live = live & !place.doubtful;
        for k in 0..3 {
            low[k] = low[k].min(live.select(place.position[k], low[k]));
            high[k] = high[k].max(live.select(place.position[k], high[k]));
        }
    }
    let mut bounds = Bounds::EMPTY;
    for k in 0..3 {
        bounds.low[k] = low[k].to_array().into_iter().fold(f32::INFINITY, f32::min).into();
        bounds.high[k] = high[k].to_array().into_iter().fold(f32::NEG_INFINITY, f32::max).into();
    }
    let corners = bounds.low.into_iter().chain(bounds.high);
    let slack = corners.fold(0.0_f64, |m, c| m.max(c.abs())) * 4.0 / 16_777_216.0;
    for (k, eye) in frame.scene.camera.eye().into_iter().enumerate() {
        bounds.low[k] += eye - slack;
        bounds.high[k] += eye + slack;
    }
    bounds
}

/// The radiance of the pixels from `start` on, and the lanes in which it is good enough.
#[inline(always)]
#[expect(clippy::too_many_arguments, reason = "inlined once; a struct would only name them again")]
fn shade_chunk<S: Simd>(
    simd: S,
    frame: &Frame<'_>,
    single: &SingleFrame,
    stretch: &Stretch<'_>,
    run: &Run,
    asker: &RowAsker<'_>,
    place: &Place<S>,
    start: usize,
) -> (Vectors<S>, u32) {
    let colors = run.products.lanes(start);
    let live = Mask::from_bitmask(simd, u64::from(run.live >> start & 0xffff)) & !place.doubtful;
    let mean = [
        Reals::from_slice(simd, &run.mean_normal[0][start..start + LANES]),
        Reals::from_slice(simd, &run.mean_normal[1][start..start + LANES]),
        Reals::from_slice(simd, &run.mean_normal[2][start..start + LANES]),
    ];
    let squared = vector::squared_length(mean);
    let live = live & squared.simd_ge(SMALLEST_MEAN);
    let point = Point {
        position: place.position,
        squared_distance: vector::squared_length(place.position),
        to_eye: place.to_eye,
        normal: vector::scaled(mean, Reals::splat(simd, 1.0) / squared.sqrt()),
        exponent: colors.exponent_single(simd),
        live,
    };
    let has_emission = frame.effects.has(Effects::EMISSION);
    let mut rgb = colors.base_single(simd, frame, has_emission);
    let mut doubtful = Mask::splat(simd, false);
    for (position, light) in single.lights.iter().enumerate() {
        if !light.is_directed || frame.selects_lights && !run.reaches[position] {
            continue;
        }
        let of_light = colors.of_light_single(simd, position, light);
        if !of_light.has_diffuse && !of_light.has_specular {
            continue;
        }
        let index = frame.lights[position].index;
        let hidden = |asked: u64| {
            (0..LANES).filter(|&lane| asked >> lane & 1 != 0).fold(0, |bits, lane| {
                let pixel = Pixel { x: stretch.first.x + (start + lane) as u32, ..stretch.first };
                let visible = stretch.visible[start + lane].as_ref();
                let is = visible.is_some_and(|visible| is_hidden(asker, pixel, visible, index));
                bits | u64::from(is) << lane
            })
        };
        let hidden: Option<&dyn Fn(u64) -> u64> =
            if frame.lights[position].shadows { Some(&hidden) } else { None };
        let doubts = add_light(simd, frame.rules, light, &of_light, &point, hidden, &mut rgb);
        doubtful |= doubts;
    }
    let is_finite = (rgb[0] + rgb[1] + rgb[2]).simd_lt(f32::INFINITY);
    let certain = is_finite & live & !doubtful;
    (rgb, certain.to_bitmask() as u32)
}
