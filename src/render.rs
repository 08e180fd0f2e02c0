//! A frame: scene and options in, film out. The one place that knows both paths and shading.
//!
//! `see` answers which triangle is visible, `expose` gives every pixel its radiance and alpha,
//! `develop` lays both out as the planes that files hold. Nothing is decided here: no predicate, no shading term, no format.

mod accuracy;
mod answerer;
mod bands;
mod choice;
mod describe;
mod develop;
pub mod expose;
mod eye;
mod in_order;
mod measure;
mod plane_rows;
mod planes;
mod progress;
pub mod shadows;
mod subsamples;
mod surface_planes;
mod tree_cache;
pub mod visible;

pub use accuracy::Accuracy;
pub use answerer::Answerer;
pub use choice::{Prediction, predict};
pub use describe::describe;
pub use develop::develop;
pub use expose::{Exposure, expose};
pub use measure::{EffectTime, ShadingTimes, measure};
pub use planes::{PlaneGroup, PlaneGroups, UnknownPlane};
pub use progress::{Progress, Unwatched};
pub use tree_cache::{CachedTree, TreeSource, cached_tree};

use crate::accel::BuildPreset;
use crate::film::Film;
use crate::pixel::Window;
use crate::scene::Scene;
use crate::shade::{Notes, Precision};
use crate::visibility::{Counting, LevelCounts, VisibilityBuffer};
use std::path::PathBuf;
use std::time::{Duration, Instant};
use visible::{Listing, VisibleTriangle};

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
    /// How visibility is decided. Any but [`Accuracy::Exact`] names its path, whatever `path` says,
    /// knows only the nearest surface and shows it as opaque.
    pub accuracy: Accuracy,
    /// Which pixels; the whole frame when `None`.
    pub window: Option<Window>,
    /// Which planes the film gets.
    pub planes: PlaneGroups,
    /// Build preset of the cast path's BVH, or of one for shadows alone. It changes time, never a bit
    /// of the film.
    pub preset: BuildPreset,
    /// Folder in which BVHs are kept between runs; `None` for none.
    pub bvh_cache: Option<PathBuf>,
    /// The numbers that colours are computed with.
    pub shading: Precision,
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
            bvh_cache: None,
            shading: Precision::Double,
            listing: None,
        }
    }
}

/// Where the time of a frame went. Stages of bands that are made side by side count with the time
/// that threads spent on them over the number of threads.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FrameTimes {
    /// Building the BVH (next to nothing on the raster path, unless shadows need one).
    pub build: Duration,
    /// Describing what the picture is made of: a digest of the scene, mostly.
    pub describing: Duration,
    /// Finding what is visible.
    pub visibility: Duration,
    /// Shading it, with all samples and what is seen through surfaces.
    pub shading: Duration,
    /// Laying out the film's planes.
    pub developing: Duration,
    /// Listing the visible triangles.
    pub listing: Duration,
}

/// A rendered frame and what is to be said about it.
#[derive(Clone, Debug)]
pub struct Frame {
    /// The picture.
    pub film: Film,
    /// What is to be said about it.
    pub account: Account,
}

/// What is to be said about a frame beside its picture.
#[derive(Clone, Debug, Default)]
pub struct Account {
    /// Pixels at which a triangle is visible.
    pub covered_pixels: usize,
    /// Decisions per level of arithmetic.
    pub levels: LevelCounts,
    /// What shading has to report.
    pub notes: Notes,
    /// The visible triangles by id, if they were asked for.
    pub visible: Option<Vec<VisibleTriangle>>,
    /// The film's description.
    pub description: String,
    /// Memory of the scene's triangles and their attributes, in bytes.
    pub mesh_bytes: usize,
    /// Memory of the BVH, in bytes; `None` where there was none.
    pub tree_bytes: Option<usize>,
    /// Where the BVH came from.
    pub tree_source: Option<TreeSource>,
    /// What is to be told of the folder of BVHs.
    pub tree_remark: Option<String>,
    /// Where the time went.
    pub times: FrameTimes,
}

impl Account {
    /// Adds what is to be said of a part that was made beside `threads` − 1 others.
    fn add(&mut self, part: &Self, threads: u32) {
        self.covered_pixels += part.covered_pixels;
        self.levels.add(part.levels);
        self.notes.add(part.notes);
        self.times.visibility += part.times.visibility / threads;
        self.times.shading += part.times.shading / threads;
        self.times.developing += part.times.developing / threads;
    }
}

/// Renders a frame.
pub fn render(scene: &Scene, options: &RenderOptions, progress: &dyn Progress) -> Frame {
    let (film, account) = bands::Ready::new(scene, options, progress).whole(progress);
    Frame { film, account }
}

/// Renders a frame in bands of rows, each a film of its own. Put together, they are what [`render`]
/// makes, bit for bit, and a fraction of its memory is held. All but the last have a multiple of 32
/// rows.
///
/// `work` is done on every band, on several threads at once; `take` gets what came of it in the
/// order of the bands, from the top, while others are made.
///
/// # Errors
/// The first from the top that `work` or `take` gives; of what follows nothing is taken then.
pub fn render_bands<T: Send, E: Send>(
    scene: &Scene,
    options: &RenderOptions,
    progress: &dyn Progress,
    work: impl Fn(&Film) -> Result<T, E> + Sync,
    take: impl FnMut(T) -> Result<(), E> + Send,
) -> Result<Account, E> {
    bands::Ready::new(scene, options, progress).in_bands(progress, work, take)
}

/// A visibility buffer, and the time that building and answering took.
#[derive(Clone, Debug)]
pub struct Seen {
    /// The answer.
    pub buffer: VisibilityBuffer,
    /// Time to build the BVH (next to nothing on the raster path).
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
    let started = Instant::now();
    let answerer = Answerer::new(scene, path, preset, progress);
    let build = started.elapsed();
    let started = Instant::now();
    let buffer = answerer.see(scene, window, counting, progress);
    Seen { buffer, build, visibility: started.elapsed() }
}
