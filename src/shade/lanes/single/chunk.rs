//! A run in f32: points and directions relative to the eye, the lights one after the other, and
//! which pixels are left to f64.

use super::frame::SingleFrame;
use super::light::{Point, reflect};
use super::normals::mix_normals;
use super::products::add;
use super::vector::{self, Mask, Reals, Vectors};
use super::{LANES, NEAREST, SMALLEST_MEAN, SQUARED_DISTANCES, T_WIDTH};
use crate::color::LinearRgb;
use crate::pixel::Pixel;
use crate::shade::frame::{Frame, RowAsker, is_hidden};
use crate::shade::lanes::face::Face;
use crate::shade::lanes::run::Run;
use crate::shade::lanes::vector::{Reals as Doubles, load};
use crate::shade::lanes::{Stretch, place};
use crate::shade::reach::{Bounds, RUN};
use fearless_simd::prelude::*;

/// Chunks of a run.
const CHUNKS: usize = RUN / LANES;

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
    let mut points = [point(simd, frame, stretch.first, run, 0); CHUNKS];
    for (chunk, point_of) in points.iter_mut().enumerate().skip(1) {
        if run.live >> (chunk * LANES) != 0 {
            *point_of = point(simd, frame, stretch.first, run, chunk * LANES);
        }
    }
    if single.selects_lights {
        let bounds = bounds(simd, frame, &points);
        frame.cones.mark_with(simd, &bounds, &mut run.reaches);
    }
    // One material after the other, so that no pixel's bits depend on what its neighbours wear.
    let (mut left, mut done) = (run.live, 0);
    while let Some((pixels, face)) = run.wearing_one(left) {
        left &= !pixels;
        let Face { material, is_textured, .. } = *face;
        if is_textured {
            run.color_pixels(frame, stretch, pixels);
        }
        run.single_products.wear(frame, material);
        for (chunk, point) in points.iter().enumerate() {
            let start = chunk * LANES;
            let wanted = pixels >> start & 0xffff;
            if wanted == 0 {
                continue;
            }
            let live = point.live & Mask::from_bitmask(simd, u64::from(wanted));
            let point = Point { live, ..*point };
            let (rgb, certain) =
                shade_chunk(simd, frame, single, stretch, run, is_textured, asker, &point, start);
            write(rgb, certain, &mut radiance[start..]);
            done |= certain << start;
        }
    }
    done
}

/// Writes the lanes in `certain`.
#[inline(always)]
fn write<S: Simd>(rgb: Vectors<S>, certain: u32, out: &mut [LinearRgb]) {
    let rgb = [rgb[0].to_array(), rgb[1].to_array(), rgb[2].to_array()];
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
}

/// Points as the eye sees them, without those that are not known well enough.
#[inline(always)]
fn point<S: Simd>(simd: S, frame: &Frame<'_>, first: Pixel, run: &Run, start: usize) -> Point<S> {
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
    let mean = [
        Reals::from_slice(simd, &run.mean_normal[0][start..start + LANES]),
        Reals::from_slice(simd, &run.mean_normal[1][start..start + LANES]),
        Reals::from_slice(simd, &run.mean_normal[2][start..start + LANES]),
    ];
    let squared_mean = vector::squared_length(mean);
    let distance = t * t * squared;
    let live = u64::from(run.live >> start & 0xffff) & (known0 | known1 << (LANES / 2));
    Point {
        position: vector::scaled(ray, t),
        nearness: distance / NEAREST,
        to_eye,
        normal: vector::scaled(mean, Reals::splat(simd, 1.0) / squared_mean.sqrt()),
        live: Mask::from_bitmask(simd, live)
            & squared.simd_ge(SQUARED_DISTANCES[0])
            & squared.simd_le(SQUARED_DISTANCES[1])
            & distance.simd_le(SQUARED_DISTANCES[1])
            & squared_mean.simd_ge(SMALLEST_MEAN),
    }
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
fn bounds<S: Simd>(simd: S, frame: &Frame<'_>, points: &[Point<S>; CHUNKS]) -> Bounds {
    let mut low = vector::splat(simd, [f32::INFINITY; 3]);
    let mut high = vector::splat(simd, [f32::NEG_INFINITY; 3]);
    for point in points {
        for k in 0..3 {
            low[k] = low[k].min(point.live.select(point.position[k], low[k]));
            high[k] = high[k].max(point.live.select(point.position[k], high[k]));
        }
    }
    let mut bounds = Bounds::EMPTY;
    for k in 0..3 {
        bounds.low[k] = (-largest(-low[k])).into();
        bounds.high[k] = largest(high[k]).into();
    }
    let corners = bounds.low.into_iter().chain(bounds.high);
    let slack = corners.fold(0.0_f64, |m, c| m.max(c.abs())) * 4.0 / 16_777_216.0;
    for (k, eye) in frame.scene.camera.eye().into_iter().enumerate() {
        bounds.low[k] += eye - slack;
        bounds.high[k] += eye + slack;
    }
    bounds
}

/// The largest lane.
#[inline(always)]
fn largest<S: Simd>(lanes: Reals<S>) -> f32 {
    let (low, high) = lanes.split();
    let (low, high) = low.max(high).split();
    let [a, b, c, d] = low.max(high).to_array();
    a.max(b).max(c.max(d))
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
    is_textured: bool,
    asker: &RowAsker<'_>,
    point: &Point<S>,
    start: usize,
) -> (Vectors<S>, u32) {
    let products = &run.single_products;
    let varying = if is_textured { Some(&*run.products.varying) } else { None };
    let mut rgb = products.base(simd, varying, start);
    let mut doubtful = Mask::splat(simd, false);
    for ((light, directed), &reaches) in
        single.lights.iter().zip(&products.directed).zip(&run.reaches)
    {
        if !light.is_directed || single.selects_lights && !reaches || directed.is_black() {
            continue;
        }
        let mut reflected = reflect(simd, frame.rules, light, directed.exponent, point);
        doubtful |= reflected.doubtful;
        if reflected.open.all_false() {
            continue;
        }
        if light.shadows {
            let asked = (reflected.open & !doubtful).to_bitmask();
            let hidden = hidden(stretch, asker, start, light.index, asked);
            let open = !Mask::from_bitmask(simd, hidden);
            reflected.matte = open.select(reflected.matte, Reals::splat(simd, 0.0));
            reflected.highlight = open.select(reflected.highlight, Reals::splat(simd, 0.0));
        }
        let varying = varying.map(|rows| (rows, light));
        add(simd, directed, varying, start, &reflected, &mut rgb);
    }
    let is_finite = (rgb[0] + rgb[1] + rgb[2]).simd_lt(f32::INFINITY);
    let certain = is_finite & point.live & !doubtful;
    (rgb, certain.to_bitmask() as u32)
}

/// From which of the pixels in `asked`, counted from `start` on, something hides a light.
#[cold]
#[inline(never)]
fn hidden(
    stretch: &Stretch<'_>,
    asker: &RowAsker<'_>,
    start: usize,
    light: usize,
    asked: u64,
) -> u64 {
    (0..LANES).filter(|&lane| asked >> lane & 1 != 0).fold(0, |bits, lane| {
        let pixel = Pixel { x: stretch.first.x + (start + lane) as u32, ..stretch.first };
        let visible = stretch.visible[start + lane].as_ref();
        let is = visible.is_some_and(|visible| is_hidden(asker, pixel, visible, light));
        bits | u64::from(is) << lane
    })
}
