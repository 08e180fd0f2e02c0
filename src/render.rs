//! A frame: scene and options in, film out. The one place that knows both paths and shading.
//!
//! `see` answers which triangle is visible, `shade` gives it radiance, `develop` lays both out as
//! the planes that files hold. Nothing is decided here: no predicate, no shading term, no format.

mod accuracy;
mod describe;
mod develop;
mod planes;
pub mod visible;

pub use accuracy::Accuracy;
pub use describe::describe;
pub use develop::develop;
pub use planes::{PlaneGroup, PlaneGroups, UnknownPlane};

use crate::accel::{Accelerator, BuildPreset};
use crate::cast::cast;
use crate::film::Film;
use crate::pixel::Window;
use crate::raster::{rasterize, rasterize_watertight};
use crate::scene::Scene;
use crate::shade::{Effects, Notes, shade};
use crate::visibility::{Counting, LevelCounts, VisibilityBuffer};
use std::time::{Duration, Instant};
use visible::{Listing, VisibleTriangle, list_visible};

/// Which of the two independent paths answers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum VisibilityPath {
    /// Rays through a BVH.
    #[default]
    Cast,
    /// The z-buffer rasterizer.
    Raster,
}

/// What a frame is asked for.
#[derive(Clone, Debug)]
pub struct RenderOptions {
    /// Which path.
    pub path: VisibilityPath,
    /// How visibility is decided. Only [`Accuracy::Exact`] exists on both paths: any other is
    /// answered by the path that has it, whatever `path` says.
    pub accuracy: Accuracy,
    /// Which pixels; the whole frame when `None`.
    pub window: Option<Window>,
    /// Which planes the film gets.
    pub planes: PlaneGroups,
    /// BVH build preset of the cast path. It changes time, never a bit of the film.
    pub preset: BuildPreset,
    /// Whether the visible triangles are listed, and how finely they are looked for.
    pub listing: Option<Listing>,
}

impl Default for RenderOptions {
    fn default() -> Self {
        Self {
            path: VisibilityPath::default(),
            accuracy: Accuracy::default(),
            window: None,
            planes: PlaneGroups::standard(),
            preset: BuildPreset::Medium,
            listing: None,
        }
    }
}

/// Where the time of a frame went.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FrameTimes {
    /// Building the BVH (zero on the raster path).
    pub build: Duration,
    /// Finding what is visible.
    pub visibility: Duration,
    /// Shading it.
    pub shading: Duration,
    /// Laying out the film's planes.
    pub developing: Duration,
}

/// A rendered frame and what is to be said about it.
#[derive(Clone, Debug)]
pub struct Frame {
    /// The picture.
    pub film: Film,
    /// Pixels at which a triangle is visible.
    pub covered_pixels: usize,
    /// Decisions per level of arithmetic.
    pub levels: LevelCounts,
    /// What shading has to report.
    pub notes: Notes,
    /// The visible triangles by id, if they were asked for.
    pub visible: Option<Vec<VisibleTriangle>>,
    /// Where the time went.
    pub times: FrameTimes,
}

/// Receives the progress of a frame's stages: a stage begins with its number of steps, then each
/// step is announced from any thread.
pub trait Progress: Sync {
    /// A stage of `steps` steps begins.
    fn begin(&self, stage: &str, steps: usize);
    /// One step of the current stage is done.
    fn step(&self);
}

/// Progress that nobody watches.
#[derive(Clone, Copy, Debug, Default)]
pub struct Unwatched;

impl Progress for Unwatched {
    fn begin(&self, _stage: &str, _steps: usize) {}
    fn step(&self) {}
}

/// Renders a frame.
pub fn render(scene: &Scene, options: &RenderOptions, progress: &dyn Progress) -> Frame {
    let window = options.window.unwrap_or(scene.camera.resolution().window());
    let counting =
        if options.planes.has(PlaneGroup::Cover) { Counting::All } else { Counting::Nearest };
    let seen = match options.accuracy {
        Accuracy::Exact => see(scene, options.path, options.preset, window, counting, progress),
        Accuracy::Watertight { subpixel_bits, depth_buffer } => {
            let started = Instant::now();
            progress.begin("rasterize", window.tiles(crate::raster::TILE_SIDE).len());
            let done = || progress.step();
            let buffer =
                rasterize_watertight(scene, window, subpixel_bits, depth_buffer, counting, &done);
            Seen { buffer, build: Duration::ZERO, visibility: started.elapsed() }
        }
    };
    let started = Instant::now();
    progress.begin("shade", window.height() as usize);
    let shaded = shade(scene, &seen.buffer, Effects::of(scene), &|| progress.step());
    let shading = started.elapsed();
    let started = Instant::now();
    let film = develop(scene, &seen.buffer, &shaded.radiance, &options.planes, options.accuracy);
    let developing = started.elapsed();
    let visible = options.listing.map(|listing| {
        list_visible(scene, &seen.buffer, listing, options.path, options.preset, progress)
    });
    Frame {
        film,
        visible,
        covered_pixels: seen.buffer.covered_pixels(),
        levels: seen.buffer.levels,
        notes: shaded.notes,
        times: FrameTimes { build: seen.build, visibility: seen.visibility, shading, developing },
    }
}

/// A visibility buffer, and the time that building and answering took.
#[derive(Clone, Debug)]
pub struct Seen {
    /// The answer.
    pub buffer: VisibilityBuffer,
    /// Time to build the BVH (zero on the raster path).
    pub build: Duration,
    /// Time to find what is visible.
    pub visibility: Duration,
}

/// Asks one path what is visible, exactly.
pub fn see(
    scene: &Scene,
    path: VisibilityPath,
    preset: BuildPreset,
    window: Window,
    counting: Counting,
    progress: &dyn Progress,
) -> Seen {
    match path {
        VisibilityPath::Cast => {
            let started = Instant::now();
            progress.begin("build", 1);
            let accelerator = Accelerator::build(&scene.mesh, preset);
            progress.step();
            let build = started.elapsed();
            let started = Instant::now();
            progress.begin("cast", window.tiles(crate::cast::TILE_SIDE).len());
            let buffer = cast(scene, &accelerator, window, counting, &|| progress.step());
            Seen { buffer, build, visibility: started.elapsed() }
        }
        VisibilityPath::Raster => {
            let started = Instant::now();
            progress.begin("rasterize", window.tiles(crate::raster::TILE_SIDE).len());
            let buffer = rasterize(scene, window, counting, &|| progress.step());
            Seen { buffer, build: Duration::ZERO, visibility: started.elapsed() }
        }
    }
}
