//! What accuracy costs: the settings that trade error for time on a scene, each with both.
//!
//! A *knob* is one choice that a user has, such as how visibility is decided; its *settings* take
//! turns on the same scene and are held against what is right: the exact answer, or for
//! tessellations the curved surface that the triangles stand for. `levels` and `tessellation` are the
//! knobs that there are; one more is one more function that lists its candidates. Errors have the
//! scene's units, nothing is condensed into a score: `frontier` marks the settings that no other one
//! beats in both, `reading` says in a sentence what the figures say.
//!
//! Times are of this process on this machine, as those of [`mod@crate::bench`] are.

mod analytic;
mod errors;
mod frontier;
mod levels;
mod reading;
pub mod report;
mod roots;
mod tessellation;
mod turns;

pub use errors::Errors;

use crate::bench::machine::Machine;
use crate::pixel::Resolution;
use crate::render::Progress;
use crate::scene::{Overrides, Scene, SceneErrors};
use crate::statistics::Statistics;
use std::path::{Path, PathBuf};

/// How a scene is priced.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CostOptions {
    /// How often each setting is timed, at least once, after a run that is held against what is right.
    pub rounds: usize,
    /// Another size of the frame than the scene's.
    pub resolution: Option<Resolution>,
}

impl CostOptions {
    /// Rounds unless told otherwise: an odd number, so that the median is one of them.
    pub const STANDARD_ROUNDS: usize = 9;
}

impl Default for CostOptions {
    fn default() -> Self {
        Self { rounds: Self::STANDARD_ROUNDS, resolution: None }
    }
}

/// A scene as written: tessellations are made by writing it anew.
#[derive(Clone, Debug)]
pub struct Written {
    /// Its file, or a name for it.
    pub name: PathBuf,
    /// The TOML.
    pub text: String,
    /// The folder that its paths are relative to.
    pub base: PathBuf,
}

impl Written {
    /// The scene that is meant.
    ///
    /// # Errors
    /// Everything that is wrong with it.
    pub fn scene(&self, options: &CostOptions) -> Result<Scene, SceneErrors> {
        self.read(&self.text, options)
    }

    /// The scene of another text in the same place.
    fn read(&self, text: &str, options: &CostOptions) -> Result<Scene, SceneErrors> {
        let overrides = Overrides { resolution: options.resolution, ..Overrides::default() };
        Scene::from_toml(text, &self.name, &self.base, &overrides)
    }
}

/// Which figure of a setting its knob is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// Pixels with another triangle than the right one.
    WrongPixels,
    /// Root mean square error of radiance.
    Radiance,
}

impl Measure {
    /// The figure, and what it is, in words.
    pub const fn name(self) -> &'static str {
        match self {
            Self::WrongPixels => "wrong pixels",
            Self::Radiance => "RMS radiance error",
        }
    }

    /// The figure of a setting.
    pub const fn of(self, errors: &Errors) -> f64 {
        match self {
            Self::WrongPixels => errors.wrong_pixels as f64,
            Self::Radiance => errors.radiance_rms,
        }
    }
}

/// One setting of a knob, with its price.
#[derive(Clone, Debug)]
pub struct Setting {
    /// Its name, unique in the knob.
    pub name: String,
    /// What distinguishes it, such as the method apart from its fineness.
    pub family: &'static str,
    /// Triangles of its mesh.
    pub triangles: usize,
    /// Its times.
    pub times: Statistics,
    /// The setting that its time is divided by.
    pub baseline: String,
    /// Its median time over that one's.
    pub ratio: f64,
    /// Its errors.
    pub errors: Errors,
    /// Whether no other setting of the knob is as fast and as right, and better in one of both.
    pub is_on_frontier: bool,
}

/// One choice that a user has, with all its settings.
#[derive(Clone, Debug)]
pub struct Knob {
    /// Its name.
    pub name: &'static str,
    /// What is timed.
    pub timed: &'static str,
    /// What is right.
    pub against: &'static str,
    /// What its errors are measured in.
    pub measure: Measure,
    /// Its settings, in the order of a table.
    pub settings: Vec<Setting>,
    /// What the figures say, in a sentence or two.
    pub reading: String,
}

/// The prices on one scene.
#[derive(Clone, Debug)]
pub struct Prices {
    /// The scene's file, or a name for it.
    pub scene: String,
    /// Size of the frame, in pixels.
    pub resolution: Resolution,
    /// Triangles of the scene as written.
    pub triangles: usize,
    /// Pixels at which a triangle is visible.
    pub covered_pixels: usize,
    /// The knobs that the scene has.
    pub knobs: Vec<Knob>,
    /// Knobs that it has not, with the reason, in words.
    pub left_out: Vec<String>,
}

impl Prices {
    /// Whether a setting that promises the exact answer was wrong.
    pub fn has_failed(&self) -> bool {
        let exact = self.knobs.iter().flat_map(|knob| &knob.settings);
        exact.filter(|setting| setting.family == levels::EXACT).any(|s| s.errors.wrong_pixels > 0)
    }
}

/// The prices of any number of scenes.
#[derive(Clone, Debug)]
pub struct Report {
    /// What it ran on.
    pub machine: Machine,
    /// Number of threads.
    pub threads: usize,
    /// Rounds that were asked for.
    pub rounds: usize,
    /// The scenes, in the order they were given.
    pub scenes: Vec<Prices>,
}

/// Why a scene has no prices.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CostError {
    /// Nothing can be wrong.
    #[error(
        "{scene}: no triangle is visible at any pixel, so no setting could err and nothing is timed; measure a scene that shows something"
    )]
    NothingVisible {
        /// The scene.
        scene: String,
    },
    /// The scene or its meshes.
    #[error(transparent)]
    Scene(#[from] SceneErrors),
}

/// Prices every knob on a scene, on the pool of threads it is called from.
///
/// # Errors
/// When the scene is wrong or shows nothing.
pub fn cost(
    written: &Written,
    options: &CostOptions,
    progress: &dyn Progress,
) -> Result<Prices, CostError> {
    let scene = written.scene(options)?;
    let name = written.name.display().to_string();
    let Some((covered_pixels, accuracy)) = levels::knob(&scene, options, progress) else {
        return Err(CostError::NothingVisible { scene: name });
    };
    let mut knobs = vec![accuracy];
    let mut left_out = Vec::new();
    match tessellation::knob(written, &scene, options, progress) {
        Ok(knob) => knobs.push(knob),
        Err(why) => left_out.push(format!("{} is not priced: {why}", tessellation::NAME)),
    }
    Ok(Prices {
        scene: name,
        resolution: scene.camera.resolution(),
        triangles: scene.mesh.len(),
        covered_pixels,
        knobs,
        left_out,
    })
}

/// The embedded scene that is priced where none is named: a torus and a sphere on a floor.
pub fn standard() -> Written {
    Written {
        name: Path::new("cost.toml").to_owned(),
        text: include_str!("../scenes/cost.toml").to_owned(),
        base: Path::new(".").to_owned(),
    }
}
