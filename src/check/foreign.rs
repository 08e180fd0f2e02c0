//! Another program's ids and depths, held against the exact answer pixel by pixel.
//!
//! The caster's answer is the reference. Where theirs differs, two questions decide whether it is
//! wrong: is it right under another tie rule (`exact` knows all of them), and is it right for a
//! sample a little beside the centre (`stability`)? Everything else is an error of theirs. When
//! many pixels differ, `diagnosis` looks for one convention that explains them; it never applies
//! one. Files are not read here, and radiance is not compared.

mod class;
mod csv;
pub mod depth;
pub mod diagnosis;
pub mod ids;
mod picture;
mod sample;
pub mod stability;

pub use class::Class;
pub use csv::to_csv;
pub use depth::{DepthKind, DepthOff, DepthPlane};
pub use diagnosis::Diagnosis;
pub use ids::{Convention, IdPlane, Theirs};
pub use picture::{class_color, class_picture};

use crate::accel::{Accelerator, BuildPreset};
use crate::cast::{TILE_SIDE, cast};
use crate::exact::Arbiter;
use crate::mesh::TriangleId;
use crate::pixel::{Pixel, Window};
use crate::render::Progress;
use crate::scene::Scene;
use crate::visibility::{Counting, VisibilityBuffer};
use rayon::prelude::*;
use sample::Sampler;
use std::cmp::Ordering;

/// What another program saw, in the scene's frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Foreign {
    /// The pixels at hand.
    pub window: Window,
    /// Ids, when there are any.
    pub ids: Option<IdPlane>,
    /// Depths, when there are any.
    pub depth: Option<DepthPlane>,
}

/// A pixel at which theirs is not the exact answer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Finding {
    /// Where.
    pub pixel: Pixel,
    /// What it is.
    pub class: Class,
    /// The exact answer.
    pub ours: Option<TriangleId>,
    /// Their answer; `None` when they gave no ids.
    pub theirs: Option<Theirs>,
    /// t of their triangle's plane over the exact t, less 1: how far behind (positive) or in front
    /// their triangle lies. `None` without two triangles.
    pub gap: Option<f64>,
    /// Their depth, where depth was compared and is not within tolerance.
    pub depth: Option<DepthOff>,
}

/// How the audit of another program's picture ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ForeignOutcome {
    /// No error of theirs.
    Agreement,
    /// At least one error.
    Errors,
    /// Neither sees a triangle anywhere: nothing was checked.
    NothingToCheck,
}

/// Everything that was found about another program's picture.
#[derive(Clone, Debug)]
pub struct ForeignReport {
    /// Which pixels were compared.
    pub window: Window,
    /// Pixels at which they or we see a triangle.
    pub covered_pixels: usize,
    /// Everything but agreement, the worst first.
    pub findings: Vec<Finding>,
    /// The convention that would explain most differences, if there is one.
    pub diagnosis: Option<Diagnosis>,
    /// The exact answer.
    pub reference: VisibilityBuffer,
    /// Their answer per pixel of the window; empty when they gave no ids.
    pub theirs: Vec<Theirs>,
}

impl ForeignReport {
    /// How many pixels are of that class.
    pub fn count(&self, class: Class) -> usize {
        match class {
            Class::Agree => self.window.len() - self.findings.len(),
            _ => self.findings.iter().filter(|finding| finding.class == class).count(),
        }
    }

    /// How the audit ended.
    pub fn outcome(&self) -> ForeignOutcome {
        if self.findings.iter().any(|finding| finding.class.is_error()) {
            ForeignOutcome::Errors
        } else if self.covered_pixels == 0 {
            ForeignOutcome::NothingToCheck
        } else {
            ForeignOutcome::Agreement
        }
    }
}

/// What an audit is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ForeignOptions {
    /// What their ids mean.
    pub convention: Convention,
    /// Largest relative depth error that is no error.
    pub depth_tolerance: f64,
}

impl Default for ForeignOptions {
    fn default() -> Self {
        let depth_tolerance = depth::DEPTH_TOLERANCE_RELATIVE;
        Self { convention: Convention::default(), depth_tolerance }
    }
}

/// Holds another program's picture against the exact answer.
///
/// # Panics
/// When a plane does not have one number per pixel of the window.
pub fn audit_foreign(
    scene: &Scene,
    foreign: &Foreign,
    options: &ForeignOptions,
    progress: &dyn Progress,
) -> ForeignReport {
    let window = foreign.window;
    // The exact answer everywhere.
    progress.begin("build", 1);
    let accelerator = Accelerator::build(&scene.mesh, BuildPreset::Medium);
    progress.step();
    progress.begin("cast", window.tiles(TILE_SIDE).len());
    let reference = cast(scene, &accelerator, window, Counting::Nearest, &|| progress.step());
    let sampler = Sampler { scene, accelerator: &accelerator };
    // Their ids, as the convention reads them.
    let theirs: Vec<Theirs> = match &foreign.ids {
        None => Vec::new(),
        Some(plane) => {
            assert_eq!(plane.words.len(), window.len(), "one id per pixel");
            plane.words.iter().map(|&w| options.convention.read(w, scene.mesh.len())).collect()
        }
    };
    let differs = |index: usize| {
        theirs.get(index).is_some_and(|&t| t != Theirs::of(reference.visible[index].as_ref()))
    };
    let disputed: Vec<usize> = (0..window.len()).filter(|&index| differs(index)).collect();
    let diagnosis = foreign.ids.as_ref().and_then(|plane| {
        diagnosis::diagnose(&sampler, plane, options.convention, &reference, &disputed)
    });
    // Judge every pixel that differs in its id.
    let arbiter = (!disputed.is_empty()).then(|| Arbiter::new(scene));
    progress.begin("arbitrate", disputed.len());
    let mut findings: Vec<Finding> = disputed
        .par_iter()
        .filter_map(|&index| {
            let finding = judge_id(&sampler, arbiter.as_ref()?, &reference, index, theirs[index]);
            progress.step();
            Some(finding)
        })
        .collect();
    // Judge the depth wherever the id is right, or was not given.
    let mut depth_covered = false;
    if let Some(plane) = &foreign.depth {
        assert_eq!(plane.values.len(), window.len(), "one depth per pixel");
        depth_covered = plane.values.iter().any(|&value| !depth::is_nothing(value));
        progress.begin("depth", window.len());
        findings.par_extend((0..window.len()).into_par_iter().filter_map(|index| {
            progress.step();
            let is_comparable = !differs(index);
            let given = theirs.get(index).copied();
            is_comparable
                .then(|| depth::judge(&sampler, &reference, plane, index, given, options))
                .flatten()
        }));
    }
    findings.sort_by(worst_first);
    let covered = |index: usize| {
        reference.visible[index].is_some()
            || theirs.get(index).is_some_and(|&theirs| theirs != Theirs::Nothing)
    };
    let covered_pixels = (0..window.len()).filter(|&index| covered(index)).count();
    let covered_pixels = covered_pixels.max(usize::from(depth_covered));
    ForeignReport { window, covered_pixels, findings, diagnosis, reference, theirs }
}

/// Judges an id that is not the exact one.
fn judge_id(
    sampler: &Sampler<'_>,
    arbiter: &Arbiter<'_>,
    reference: &VisibilityBuffer,
    index: usize,
    theirs: Theirs,
) -> Finding {
    let pixel = reference.window.pixel(index);
    let visible = reference.visible[index].as_ref();
    let ours = visible.map(|visible| visible.triangle);
    let seen = match theirs {
        Theirs::Triangle(triangle) => Some(triangle),
        Theirs::Nothing | Theirs::Unknown(_) => None,
    };
    // Ties exist only where the tie rule decided for us, or where theirs has an edge through the
    // sample: elsewhere the winner covers the sample under every rule, strictly in front.
    let may_tie = visible.is_some_and(|visible| visible.tie)
        || seen.is_some_and(|triangle| {
            stability::may_reach(sampler, pixel, triangle) && arbiter.is_on_edge(triangle, pixel)
        });
    let is_allowed = may_tie && {
        let right = arbiter.tie_answers(pixel);
        match theirs {
            Theirs::Nothing => right.nothing,
            Theirs::Triangle(triangle) => right.triangles.contains(&triangle),
            Theirs::Unknown(_) => false,
        }
    };
    let class = if is_allowed {
        Class::AllowedTie
    } else if stability::is_right_nearby(sampler, pixel, ours, theirs) {
        Class::Unstable
    } else {
        match (ours, theirs) {
            (Some(_), Theirs::Nothing) => Class::Missing,
            (None, _) => Class::Extra,
            (Some(_), _) => Class::Wrong,
        }
    };
    let gap = visible
        .zip(seen)
        .map(|(visible, triangle)| sampler.plane_t(triangle, pixel) / visible.t() - 1.0);
    Finding { pixel, class, ours, theirs: Some(theirs), gap, depth: None }
}

/// By class, then the larger error, then by rows.
fn worst_first(a: &Finding, b: &Finding) -> Ordering {
    let size = |finding: &Finding| {
        finding.depth.map_or(finding.gap.unwrap_or(0.0), |depth| depth.relative).abs()
    };
    a.class
        .cmp(&b.class)
        .then(size(b).total_cmp(&size(a)))
        .then((a.pixel.y, a.pixel.x).cmp(&(b.pixel.y, b.pixel.x)))
}
