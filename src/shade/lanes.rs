//! Eight pixels at once: the kernel of `kernel` over lanes of f64, bit for bit.
//!
//! Every lane repeats the operations of the scalar kernel in their order, with masks in place of
//! branches and nothing fused, so that no bit depends on whether a pixel was shaded here, nor on the
//! instruction set. Only the plain case is known here: the equation at the pixel, with vectors as
//! they are. What is doubtful in a lane (a light at the surface, a side of the terminator that
//! rounding decides, L = −V, a number beyond the range …) is left to the scalar kernel, which
//! notes it; so are colours that are lit elsewhere, and frames whose switches ask for more.

mod cones;
mod face;
mod light;
mod place;
mod power;
mod products;
mod run;
pub(super) mod single;
mod vector;

pub(super) use cones::Cones;
pub(super) use run::Run;

use super::effects::Effects;
use super::frame::{Frame, RowAsker, is_hidden};
use super::lights::{Origin, PreparedLight};
use super::options::Precision;
use super::vector::largest_component;
use crate::color::LinearRgb;
use crate::pixel::Pixel;
use crate::scene::Scene;
use crate::scene::switches::{HemisphereCurve, Rules};
use crate::visibility::Visible;
use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch};
use light::{Point, add_light};
use single::SingleFrame;
use vector::{Mask, Reals};

/// Pixels at once.
const LANES: usize = 8;

/// What lanes ask of a frame, found once.
#[derive(Clone, Debug)]
pub(super) struct Lanes {
    level: Level,
    /// Whether any light is at a point.
    positional: bool,
    /// Whether any light has a specular part.
    specular: bool,
    /// max |e_k| of the eye.
    largest_eye: f64,
    /// Whether the background is nothing to be noted.
    background_is_finite: bool,
    /// The lights in f32, where f32 is allowed and takes the scene's numbers.
    single: Option<SingleFrame>,
}

impl Lanes {
    /// `None` where the switches or a light ask for what only the scalar kernel knows.
    pub(super) fn of(
        scene: &Scene,
        rules: &Rules,
        lights: &[PreparedLight],
        selects_lights: bool,
        level: Level,
        precision: Precision,
    ) -> Option<Self> {
        let is_plain = rules.renormalize
            && !rules.screen_interpolation
            && !rules.interpolate_vectors
            && lights.iter().all(|light| !light.fades_ambient)
            && (rules.hemisphere != HemisphereCurve::Linear
                || lights.iter().all(|light| !matches!(light.origin, Origin::Hemisphere(_))));
        is_plain.then(|| Self {
            level,
            positional: lights.iter().any(|light| matches!(light.origin, Origin::Position(_))),
            specular: lights.iter().any(|light| light.specular != [0.0; 3]),
            largest_eye: largest_component(scene.camera.eye()),
            background_is_finite: scene.background.iter().all(|value| value.is_finite()),
            single: match precision {
                Precision::Double => None,
                Precision::Single => SingleFrame::of(scene, lights, selects_lights),
            },
        })
    }
}

/// A run of neighbouring pixels of one row: at most `reach::RUN`.
pub(super) struct Stretch<'a> {
    /// Its first pixel.
    pub(super) first: Pixel,
    pub(super) visible: &'a [Option<Visible>],
}

/// Shades those pixels of a run that the lanes know, and those at which nothing is visible, and says
/// by bits which.
pub(super) fn shade_run(
    frame: &Frame<'_>,
    lanes: &Lanes,
    stretch: &Stretch<'_>,
    run: &mut Run,
    asker: &RowAsker<'_>,
    radiance: &mut [LinearRgb],
) -> u32 {
    run.gather(frame, stretch);
    let mut done = 0;
    if lanes.background_is_finite && run.empty != 0 {
        let empty = radiance.iter_mut().zip(stretch.visible).filter(|(_, seen)| seen.is_none());
        empty.for_each(|(out, _)| *out = frame.scene.background);
        done = run.empty;
    }
    if run.live == 0 {
        return done;
    }
    done | dispatch!(lanes.level, simd =>
        shade_gathered(simd, frame, lanes, stretch, run, asker, radiance))
}

#[inline(always)]
fn shade_gathered<S: Simd>(
    simd: S,
    frame: &Frame<'_>,
    lanes: &Lanes,
    stretch: &Stretch<'_>,
    run: &mut Run,
    asker: &RowAsker<'_>,
    radiance: &mut [LinearRgb],
) -> u32 {
    let mut done = 0;
    if let Some(single) = lanes.single.as_ref().filter(|_| frame.directed) {
        done = single::shade(simd, frame, single, stretch, run, asker, radiance);
        run.live &= !done;
        if run.live == 0 {
            return done;
        }
    }
    run.color(frame, stretch);
    if frame.directed {
        place::place(simd, frame, lanes, stretch.first, run);
    }
    if frame.selects_lights {
        let bounds = run.bounds(simd);
        frame.cones.mark_with(simd, &bounds, &mut run.reaches);
    }
    for start in (0..stretch.visible.len()).step_by(LANES) {
        let live = run.live >> start & 0xff;
        if live == 0 {
            continue;
        }
        let (rgb, certain) = shade_chunk(simd, frame, lanes, stretch, run, asker, start, live);
        let rgb = [rgb[0].to_array(), rgb[1].to_array(), rgb[2].to_array()];
        for (lane, out) in radiance[start..].iter_mut().take(LANES).enumerate() {
            if certain >> lane & 1 != 0 {
                *out = [rgb[0][lane], rgb[1][lane], rgb[2][lane]];
            }
        }
        done |= certain << start;
    }
    done
}

/// The radiance of the pixels from `start` on, and the lanes in which it is that of the scalar kernel.
#[inline(always)]
#[expect(clippy::too_many_arguments, reason = "inlined once; a struct would only name them again")]
fn shade_chunk<S: Simd>(
    simd: S,
    frame: &Frame<'_>,
    lanes: &Lanes,
    stretch: &Stretch<'_>,
    run: &Run,
    asker: &RowAsker<'_>,
    start: usize,
    live: u32,
) -> ([Reals<S>; 3], u32) {
    let colors = run.products.lanes(start);
    let live_lanes = Mask::from_bitmask(simd, u64::from(live));
    let (to_eye, mut doubtful) = place::to_eye(simd, frame, lanes, stretch.first, start);
    let point = Point {
        position: vector::load3(simd, &run.position, start),
        normal: vector::load3(simd, &run.normal, start),
        to_eye,
        exponent: colors.exponent(simd),
        live: live_lanes,
    };
    let mut rgb = [Reals::splat(simd, 0.0); 3];
    if frame.effects.has(Effects::EMISSION) {
        rgb = vector::add(rgb, colors.emission(simd));
    }
    let is_hidden = |lane: usize, light: usize| {
        let pixel = Pixel { x: stretch.first.x + (start + lane) as u32, ..stretch.first };
        stretch.visible[start + lane]
            .as_ref()
            .is_some_and(|visible| is_hidden(asker, pixel, visible, light))
    };
    for (position, light) in frame.lights.iter().enumerate() {
        if let Some(ambient) = light.ambient {
            rgb = vector::add(rgb, colors.ambient(simd, position, ambient));
        }
        if frame.selects_lights && !run.reaches[position] {
            continue;
        }
        let products = colors.of_light(simd, position, light);
        let doubts = add_light(simd, frame.rules, light, &products, &point, &is_hidden, &mut rgb);
        doubtful |= doubts;
    }
    // What left the range is not below infinity, nor is NaN.
    let is_finite = (rgb[0] + rgb[1] + rgb[2]).simd_lt(f64::INFINITY);
    let certain = is_finite & live_lanes & !doubtful;
    (rgb, certain.to_bitmask() as u32 & !(run.doubtful >> start))
}
