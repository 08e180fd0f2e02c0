//! The cross-check: both paths answer, the arbiter decides every doubt, and the blame is named.
//!
//! `check` runs the paths and judges them; `judge` judges answers from anywhere, which is how
//! tests show that it can fail. A check in which nothing is covered is not a pass: see
//! [`Outcome::NothingToCheck`]. Nothing here evaluates a predicate or shades a pixel itself.

mod audit;
mod blame;
mod compare;
pub mod csv;
mod expected;
pub mod foreign;
pub mod picture;
pub mod tolerance;

pub use blame::{Blame, Judged, visible_from, visible_of};
pub use compare::{Answered, Difference, Kind};
pub use expected::exact_terms;

use crate::accel::BuildPreset;
use crate::exact::Arbiter;
use crate::pixel::{Pixel, Window};
use crate::render::{Answerer, Progress, VisibilityPath, expose};
use crate::scene::Scene;
use crate::shade::Effects;
use crate::visibility::{Counting, LevelCounts};

/// What a check is asked for.
#[derive(Clone, Copy, Debug)]
pub struct CheckOptions {
    /// Which pixels; the whole frame when `None`.
    pub window: Option<Window>,
    /// How many agreeing pixels the arbiter audits.
    pub audited_pixels: usize,
    /// BVH build preset of the cast path.
    pub preset: BuildPreset,
}

impl Default for CheckOptions {
    fn default() -> Self {
        Self { window: None, audited_pixels: 1000, preset: BuildPreset::Medium }
    }
}

/// How a check ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Both paths and the arbiter agree everywhere they were compared.
    Agreement,
    /// At least one difference was found.
    Differences,
    /// No sample is covered by any triangle, by either path: nothing was checked.
    NothingToCheck,
}

/// Everything a check found.
#[derive(Clone, Debug)]
pub struct Report {
    /// Which pixels were compared.
    pub window: Window,
    /// Triangles of the scene.
    pub triangles: usize,
    /// Pixels at which a path saw a triangle.
    pub covered_pixels: usize,
    /// Pixels at which the tie rule decided (caster's word).
    pub tied_pixels: usize,
    /// Agreeing pixels that the arbiter looked at as well.
    pub audited_pixels: usize,
    /// Pixels at which something is seen through a surface (caster's word).
    pub layered_pixels: usize,
    /// Those of them that the arbiter looked at, every surface in its order.
    pub audited_layered_pixels: usize,
    /// Differences, by pixel, each with the arbiter's word.
    pub differences: Vec<Judged>,
    /// Largest radiance difference that was within tolerance, absolute, linear.
    pub largest_tolerated_radiance: f64,
    /// Pixels whose radiance differs and may: rounding decides on which side of a light's terminator
    /// they are (|N·L| < 1e-13).
    pub terminator_pixels: usize,
    /// Decisions per level, caster and rasterizer.
    pub levels: [LevelCounts; 2],
}

impl Report {
    /// How the check ended.
    pub fn outcome(&self) -> Outcome {
        if !self.differences.is_empty() {
            Outcome::Differences
        } else if self.covered_pixels == 0 {
            Outcome::NothingToCheck
        } else {
            Outcome::Agreement
        }
    }

    /// How many differences are of that kind.
    pub fn count(&self, kind: Kind) -> usize {
        self.differences.iter().filter(|judged| judged.difference.kind == kind).count()
    }

    /// How many differences carry that blame.
    pub fn blamed(&self, blame: Blame) -> usize {
        self.differences.iter().filter(|judged| judged.blame == blame).count()
    }
}

/// Both paths' answers for the same window: caster first, then rasterizer.
pub type BothAnswers = [Answered; 2];

/// Asks both paths, each with counting, its own layers and samples, and its own shading.
pub fn answer(scene: &Scene, options: &CheckOptions, progress: &dyn Progress) -> BothAnswers {
    let window = options.window.unwrap_or(scene.camera.resolution().window());
    [VisibilityPath::Cast, VisibilityPath::Raster].map(|path| {
        let answerer = Answerer::new(scene, path, options.preset, progress);
        let buffer = answerer.see(scene, window, Counting::All, progress);
        let layers = answerer.see_through(scene, &buffer, progress);
        let effects = Effects::of(scene);
        let exposed = expose(scene, &answerer, (&buffer, &layers), effects, progress);
        Answered { buffer, layers, radiance: exposed.radiance, alpha: exposed.alpha }
    })
}

/// Checks a scene: asks both paths and judges their answers.
pub fn check(
    scene: &Scene,
    options: &CheckOptions,
    progress: &dyn Progress,
) -> (Report, BothAnswers) {
    let answers = answer(scene, options, progress);
    (judge(scene, &answers, options, progress), answers)
}

/// Judges two answers for the same window, wherever they come from: compares them pixel by pixel,
/// asks the arbiter about every difference, and audits a sample of the pixels that agree.
pub fn judge(
    scene: &Scene,
    answers: &BothAnswers,
    options: &CheckOptions,
    progress: &dyn Progress,
) -> Report {
    let [cast, raster] = answers;
    let window = cast.buffer.window;
    assert_eq!(window, raster.buffer.window, "both answers are for the same pixels");
    // Compare the paths with each other.
    let comparison = compare::compare(scene, cast, raster);
    // Ask the arbiter about every difference.
    let arbiter = Arbiter::new(scene);
    let mut differences =
        blame::judge_differences(scene, &arbiter, answers, comparison.differences, progress);
    // Audit agreeing pixels: an error common to both paths shows only here.
    let disputed: Vec<Pixel> = differences.iter().map(|judged| judged.difference.pixel).collect();
    let sample = audit::sample(scene, cast, &disputed, options.audited_pixels);
    differences.extend(audit::audit(scene, &arbiter, answers, &sample, progress));
    let seen = |index: usize| {
        cast.buffer.visible[index].is_some() || raster.buffer.visible[index].is_some()
    };
    Report {
        window,
        triangles: scene.mesh.len(),
        covered_pixels: (0..window.len()).filter(|&index| seen(index)).count(),
        tied_pixels: cast.buffer.visible.iter().flatten().filter(|visible| visible.tie).count(),
        audited_pixels: sample.len(),
        layered_pixels: cast.layers.layered_pixels(),
        audited_layered_pixels: sample.iter().filter(|&&p| cast.is_layered(p)).count(),
        differences,
        largest_tolerated_radiance: comparison.largest_tolerated_radiance,
        terminator_pixels: comparison.terminator_pixels,
        levels: [cast.buffer.levels, raster.buffer.levels],
    }
}
