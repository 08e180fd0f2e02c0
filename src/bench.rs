//! The benchmark: what building, casting, rasterizing, shading and a whole frame cost on a scene,
//! and no time for a kernel whose answers are wrong.
//!
//! `workload` says what a variant is, `kernels` lists ours and `peers` those of other programs, `reference` says what is right,
//! `rounds` lets the variants take turns, [`crate::statistics`] condenses their times, `rivalry`
//! puts ours beside the others', `baseline` holds them against an earlier report.
//! Nothing here decides what is visible. Times are wall-clock times of this process on this machine;
//! no mean over scenes is given, for it would weigh them by their size.

pub mod baseline;
pub mod counters;
pub mod kernels;
pub mod machine;
pub mod peers;
pub mod reference;
pub mod report;
pub mod rivalry;
pub mod rounds;
pub mod workload;

use crate::accel::BuildPreset;
use crate::pixel::Resolution;
use crate::render::{Answerer, Progress};
use crate::scene::Scene;
use crate::scene::hash::content_hash;
use crate::simd::SimdLevel;
use crate::visibility::Counting;
use baseline::Compared;
use counters::{Counters, counters};
use kernels::{Kernels, TreeFigures, light_of};
use machine::Machine;
use peers::{PeerError, PeerOptions, Peers, ShadowRays};
use reference::Reference;
use rounds::{Row, take_turns};
use std::path::PathBuf;
use workload::Work;

/// How a scene is measured.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BenchOptions {
    /// How often each variant is timed, at least once. A run that checks its answer comes before.
    pub rounds: usize,
    /// How many pixels exact arithmetic looks at, whether both paths agree there or not.
    pub audited_pixels: usize,
    /// Which kinds of work.
    pub works: Vec<Work>,
    /// Only variants whose name contains one of these texts, in any case; empty: all.
    pub only: Vec<String>,
    /// With which presets trees are built and cast at.
    pub presets: Vec<BuildPreset>,
    /// Whether Embree is held to the subject's instruction set; else it chooses for itself.
    pub holds_simd: bool,
    /// The shared library of Embree; without it, whichever version the system finds.
    pub embree: Option<PathBuf>,
}

impl BenchOptions {
    /// Rounds unless told otherwise: an odd number, so that the median is one of them.
    pub const STANDARD_ROUNDS: usize = 9;
}

impl BenchOptions {
    /// Whether a variant is asked for.
    pub fn admits(&self, name: &str, work: Work) -> bool {
        let name = name.to_lowercase();
        let is_named = |text: &String| name.contains(&text.to_lowercase());
        self.works.contains(&work) && (self.only.is_empty() || self.only.iter().any(is_named))
    }
}

impl Default for BenchOptions {
    fn default() -> Self {
        Self {
            rounds: Self::STANDARD_ROUNDS,
            audited_pixels: 200,
            works: Work::ALL.into(),
            only: Vec::new(),
            presets: BuildPreset::ALL.into(),
            holds_simd: false,
            embree: None,
        }
    }
}

/// What was measured: all that must be equal for times to be comparable.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Subject {
    /// The scene's file, or a name for it.
    pub name: String,
    /// [`content_hash`]; it depends on the size too.
    pub digest: String,
    /// Size of the frame, in pixels.
    pub resolution: Resolution,
    /// Number of threads.
    pub threads: usize,
    /// The instruction set of vector kernels.
    pub simd: SimdLevel,
}

impl Subject {
    /// The subject of a scene.
    pub fn new(name: String, scene: &Scene, threads: usize, simd: SimdLevel) -> Self {
        let resolution = scene.camera.resolution();
        Self { name, digest: content_hash(scene), resolution, threads, simd }
    }
}

/// Everything that was measured on one scene.
#[derive(Clone, Debug)]
pub struct Measured {
    /// Which scene, and how.
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
    /// What kernels do for a frame.
    pub counters: Vec<Counters>,
    /// What was not measured though it might have been, with the reason, in words.
    pub left_out: Vec<String>,
}

/// A benchmark of any number of scenes.
#[derive(Clone, Debug)]
pub struct Report {
    /// What it ran on.
    pub machine: Machine,
    /// Rounds that were asked for.
    pub rounds: usize,
    /// The scenes, in the order they were given, each on every number of threads.
    pub scenes: Vec<Measured>,
    /// The comparison with an earlier report, if one was asked for.
    pub comparison: Option<Vec<Compared>>,
}

impl Report {
    /// Whether some answer of ours was wrong or some row is slower than the baseline beyond noise.
    pub fn has_failed(&self) -> bool {
        self.scenes.iter().flat_map(|scene| &scene.rows).any(Row::has_failed)
            || self.comparison.iter().flatten().any(Compared::is_regression)
    }
}

/// Why a scene was not measured.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum BenchError {
    /// No answer could be found wrong.
    #[error(
        "{name}: no triangle is visible at any pixel, so no answer could be found wrong and nothing is timed; measure a scene that shows something"
    )]
    NothingVisible {
        /// The scene.
        name: String,
    },
    /// Nothing that was asked for is there.
    #[error(
        "{name}: no variant is asked for; name others with --only and --work, or a scene with a light for `any`"
    )]
    NothingToMeasure {
        /// The scene.
        name: String,
    },
    /// A peer that was asked for.
    #[error(transparent)]
    Peer(#[from] PeerError),
}

/// Measures the variants that the options ask for on a scene, on the pool of threads it is called
/// from: `subject` says how many.
///
/// # Errors
/// When no triangle is visible, and when a peer that was named cannot be measured.
pub fn bench(
    scene: &Scene,
    subject: Subject,
    options: &BenchOptions,
    progress: &dyn Progress,
) -> Result<Measured, BenchError> {
    let window = scene.camera.resolution().window();
    let wants = |work| options.works.contains(&work);
    let asked = PeerOptions {
        embree: options.embree.clone(),
        simd: options.holds_simd.then_some(subject.simd),
        admits: &|name| {
            let work = if name.starts_with("shadow") { Work::Any } else { Work::Closest };
            options.admits(name, work)
        },
    };
    let peers = Peers::new(scene, window, &asked)?;
    let kernels = Kernels::new(scene, &options.presets, subject.simd, progress);
    let counting = if wants(Work::Cover) { Counting::All } else { Counting::Nearest };
    let both = [kernels.standard_cast(), &Answerer::Raster]
        .map(|answerer| answerer.see(scene, window, counting, progress));
    let reference = Reference::of(scene, &both, options.audited_pixels, progress);
    if reference.covered_pixels() == 0 {
        return Err(BenchError::NothingVisible { name: subject.name });
    }
    let reference = match light_of(scene).filter(|_| wants(Work::Any)) {
        Some(light) => reference.with_shadows(scene, light, options.audited_pixels),
        None => reference,
    };
    let exposure = match wants(Work::Shade) {
        true => Some(kernels.exposure(scene, &both[0])),
        false => None,
    };
    let shadows = light_of(scene)
        .filter(|_| cfg!(feature = "embree") && wants(Work::Any))
        .map(|light| ShadowRays::new(scene, &both[0], light));
    let mut variants = kernels.variants(scene, &both[0], exposure.as_ref());
    variants.extend(peers.variants(shadows.as_ref()));
    variants.retain(|variant| options.admits(&variant.name, variant.work));
    if variants.is_empty() {
        return Err(BenchError::NothingToMeasure { name: subject.name });
    }
    variants.sort_by_key(|variant| Work::ALL.iter().position(|&work| work == variant.work));
    let rows = take_turns(&variants, &reference, options.rounds, progress);
    let admits = |name: &str, work| options.admits(name, work);
    let counters = counters(&kernels, scene, window, &admits);
    Ok(Measured {
        subject,
        triangles: scene.mesh.len(),
        covered_pixels: reference.covered_pixels(),
        disputed_pixels: reference.disputed_pixels(),
        audited_pixels: reference.audited_pixels(),
        trees: kernels.trees(scene.mesh.len()),
        rows,
        counters,
        left_out: peers.left_out.clone(),
    })
}
