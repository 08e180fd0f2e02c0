//! Who is wrong: the arbiter is asked about every pixel at which the paths differ.

use super::compare::{
    Answered, Difference, Kind, cover_at, largest_exponent, layers_differ, visibility_difference,
};
use super::expected;
use super::tolerance::compare_radiance;
use crate::color::LinearRgb;
use crate::exact::{Answer, Arbiter, Surface};
use crate::pixel::Pixel;
use crate::render::Progress;
use crate::scene::Scene;
use crate::visibility::{Cover, Level, Visible};
use rayon::prelude::*;
use std::collections::HashMap;

/// Who is wrong at a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Blame {
    /// The caster.
    Cast,
    /// The rasterizer.
    Raster,
    /// Both.
    Both,
    /// Neither by itself: each is within tolerance of the exact answer, but not of the other.
    Neither,
}

impl Blame {
    /// Every blame.
    pub const ALL: [Self; 4] = [Self::Cast, Self::Raster, Self::Both, Self::Neither];

    /// The word in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Cast => "cast",
            Self::Raster => "raster",
            Self::Both => "both",
            Self::Neither => "neither",
        }
    }

    /// From whether the caster and the rasterizer are wrong.
    pub(super) const fn of(cast_is_wrong: bool, raster_is_wrong: bool) -> Self {
        match (cast_is_wrong, raster_is_wrong) {
            (true, true) => Self::Both,
            (true, false) => Self::Cast,
            (false, true) => Self::Raster,
            (false, false) => Self::Neither,
        }
    }
}

/// A difference with the arbiter's word.
#[derive(Clone, Debug)]
pub struct Judged {
    /// Where and in what.
    pub difference: Difference,
    /// Who is wrong.
    pub blame: Blame,
    /// The exact answer.
    pub exact: Answer,
    /// Whether both paths agreed with each other and only the audit found the error.
    pub found_by_audit: bool,
}

/// The arbiter's answer in the shape of a path's answer, so that both are compared alike.
pub fn visible_of(answer: &Answer) -> (Option<Visible>, Cover) {
    (answer.visible.as_ref().map(visible_from), answer.cover)
}

/// A surface of the arbiter in the shape of a path's.
pub fn visible_from(surface: &Surface) -> Visible {
    Visible {
        triangle: surface.triangle,
        facing: surface.facing,
        level: Level::Exact,
        tie: surface.tie,
        barycentric: surface.barycentric,
        t_lo: surface.t_lo,
        t_hi: surface.t_hi,
    }
}

/// In what an answer differs from the exact one at a pixel, if it does.
pub(super) fn visibility_error(answered: &Answered, pixel: Pixel, exact: &Answer) -> Option<Kind> {
    let index = answered.buffer.window.index(pixel);
    let (visible, cover) = visible_of(exact);
    visibility_difference(
        (answered.buffer.visible[index].as_ref(), cover_at(&answered.buffer, index)),
        (visible.as_ref(), cover),
    )
}

/// Asks the arbiter about every difference.
pub(super) fn judge_differences(
    scene: &Scene,
    arbiter: &Arbiter<'_>,
    answers: &[Answered; 2],
    differences: Vec<Difference>,
    progress: &dyn Progress,
) -> Vec<Judged> {
    progress.begin("arbitrate", differences.len());
    // Radiance and alpha hang on every sample of a pixel; they are shaded anew together.
    let of_light =
        |difference: &&Difference| matches!(difference.kind, Kind::Alpha | Kind::Radiance);
    let pixels: Vec<Pixel> = differences.iter().filter(of_light).map(|d| d.pixel).collect();
    let exposures = expected::exposures(scene, arbiter, &pixels);
    let exposures: HashMap<Pixel, Exposed> = pixels.into_iter().zip(exposures).collect();
    differences
        .into_par_iter()
        .map(|difference| {
            let exact = arbiter.answer(difference.pixel);
            let truth = Truth {
                exact: &exact,
                layers: match difference.kind {
                    Kind::Layers => expected::layers(scene, arbiter, difference.pixel),
                    _ => Vec::new(),
                },
                exposed: exposures.get(&difference.pixel).copied(),
            };
            let wrong = [0, 1].map(|i| is_wrong(scene, &answers[i], difference, &truth));
            progress.step();
            let blame = Blame::of(wrong[0], wrong[1]);
            Judged { difference, blame, exact, found_by_audit: false }
        })
        .collect()
}

/// Radiance and alpha.
type Exposed = (LinearRgb, f64);

/// The exact answer at a disputed pixel, as far as the dispute needs it.
struct Truth<'a> {
    exact: &'a Answer,
    layers: Vec<Visible>,
    exposed: Option<Exposed>,
}

/// Whether an answer is wrong at a disputed pixel. A dispute about radiance or alpha alone is
/// settled by shading the exact surfaces.
fn is_wrong(scene: &Scene, answered: &Answered, difference: Difference, truth: &Truth<'_>) -> bool {
    if visibility_error(answered, difference.pixel, truth.exact).is_some() {
        return true;
    }
    let index = answered.buffer.window.index(difference.pixel);
    match (difference.kind, truth.exposed) {
        (Kind::Layers, _) => layers_differ(answered.layers.of(index), &truth.layers),
        (Kind::Alpha, Some((_, alpha))) => answered.alpha[index] != alpha,
        (Kind::Radiance, Some((radiance, _))) => {
            let ns = largest_exponent(scene, answered, index);
            !compare_radiance(answered.radiance[index], radiance, ns).1
        }
        _ => false,
    }
}
