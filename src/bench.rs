//! The benchmark: what building, casting, rasterizing, shading and a whole frame cost on a scene,
//! and no time for a kernel whose answers are wrong.
//!
//! `workload` lists the variants, `reference` says what is right, `rounds` lets the variants take
//! turns, [`crate::statistics`] condenses their times, `baseline` holds them against an earlier report.
//! Nothing here decides what is visible. Times are wall-clock times of this process on this machine;
//! no mean over scenes is given, for it would weigh them by their size.

pub mod baseline;
pub mod machine;
pub mod reference;
pub mod report;
pub mod rounds;
pub mod workload;

use crate::pixel::Resolution;
use crate::render::{Answerer, Progress};
use crate::scene::Scene;
use crate::scene::hash::content_hash;
use crate::visibility::Counting;
use baseline::Compared;
use machine::Machine;
use reference::Reference;
use rounds::{Row, take_turns};
use workload::{Kernels, TreeFigures};

/// How a scene is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BenchOptions {
    /// How often each variant is timed, at least once. A run that checks its answer comes before.
    pub rounds: usize,
    /// How many pixels exact arithmetic looks at, whether both paths agree there or not.
    pub audited_pixels: usize,
}

impl BenchOptions {
    /// Rounds unless told otherwise: an odd number, so that the median is one of them.
    pub const STANDARD_ROUNDS: usize = 9;
}

impl Default for BenchOptions {
    fn default() -> Self {
        Self { rounds: Self::STANDARD_ROUNDS, audited_pixels: 200 }
    }
}

/// Which scene was measured, at which size: what must be equal for times to be comparable.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Subject {
    /// Its file, or a name for it.
    pub name: String,
    /// [`content_hash`]; it depends on the size too.
    pub digest: String,
    /// Size of the frame, in pixels.
    pub resolution: Resolution,
}

impl Subject {
    /// The subject of a scene.
    pub fn new(name: String, scene: &Scene) -> Self {
        Self { name, digest: content_hash(scene), resolution: scene.camera.resolution() }
    }
}

/// Everything that was measured on one scene.
#[derive(Clone, Debug)]
pub struct Measured {
    /// Which scene.
    pub subject: Subject,
    /// Its triangles.
    pub triangles: usize,
    /// Pixels at which a triangle is visible.
    pub covered_pixels: usize,
    /// Pixels at which the two paths differed, so that exact arithmetic said what is right.
    pub disputed_pixels: usize,
    /// Pixels that exact arithmetic looked at, those among them.
    pub audited_pixels: usize,
    /// The tree of each build preset.
    pub trees: Vec<TreeFigures>,
    /// One row per variant.
    pub rows: Vec<Row>,
}

impl Measured {
    /// Whether some variant's answer was wrong.
    pub fn has_wrong_answers(&self) -> bool {
        self.rows.iter().any(|row| row.wrong_pixels.is_some_and(|wrong| wrong > 0))
    }
}

/// A benchmark of any number of scenes.
#[derive(Clone, Debug)]
pub struct Report {
    /// What it ran on.
    pub machine: Machine,
    /// Number of threads.
    pub threads: usize,
    /// Rounds that were asked for.
    pub rounds: usize,
    /// The scenes, in the order they were given.
    pub scenes: Vec<Measured>,
    /// The comparison with an earlier report, if one was asked for.
    pub comparison: Option<Vec<Compared>>,
}

impl Report {
    /// Whether some answer was wrong or some row is slower than the baseline beyond noise.
    pub fn has_failed(&self) -> bool {
        self.scenes.iter().any(Measured::has_wrong_answers)
            || self.comparison.iter().flatten().any(Compared::is_regression)
    }
}

/// Why a scene was not measured.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "{name}: no triangle is visible at any pixel, so no answer could be found wrong and nothing is timed; measure a scene that shows something"
)]
pub struct NothingVisible {
    /// The scene.
    pub name: String,
}

/// Measures the standard variants on a scene, on the pool of threads it is called from.
///
/// # Errors
/// When no triangle is visible.
pub fn bench(
    scene: &Scene,
    subject: Subject,
    options: BenchOptions,
    progress: &dyn Progress,
) -> Result<Measured, NothingVisible> {
    let window = scene.camera.resolution().window();
    let kernels = Kernels::new(scene, progress);
    let both = [kernels.standard_cast(), &Answerer::Raster]
        .map(|answerer| answerer.see(scene, window, Counting::All, progress));
    let reference = Reference::of(scene, &both, options.audited_pixels, progress);
    if reference.covered_pixels() == 0 {
        return Err(NothingVisible { name: subject.name });
    }
    let exposure = kernels.exposure(scene, &both[0]);
    let variants = kernels.variants(scene, (&both[0], &exposure));
    let rows = take_turns(&variants, &reference, options.rounds, progress);
    Ok(Measured {
        subject,
        triangles: scene.mesh.len(),
        covered_pixels: reference.covered_pixels(),
        disputed_pixels: reference.disputed_pixels(),
        audited_pixels: reference.audited_pixels(),
        trees: kernels.trees(scene.mesh.len()),
        rows,
    })
}
