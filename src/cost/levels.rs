//! The knob *accuracy*: how visibility is decided, on both paths.
//!
//! One entry of [`LEVELS`] is one setting; what it does is up to [`Answerer`]. Finding what is
//! visible is timed, with the tree built before. Colours are compared too, for they show what a wrong
//! pixel does, but shading is not timed: it is the same for all.

use super::errors::{Counted, Errors, Picture, Seen};
use super::turns::{Candidate, Output, take_turns};
use super::{CostOptions, Knob, Measure, reading};
use crate::accel::BuildPreset;
use crate::bench::reference::Reference;
use crate::mesh::TriangleId;
use crate::pixel::Window;
use crate::raster::{DepthBuffer, DepthFormat, SubpixelBits};
use crate::render::{Accuracy, Answerer, Progress, Unwatched, VisibilityPath, expose};
use crate::scene::Scene;
use crate::shade::Effects;
use crate::visibility::{Counting, VisibilityBuffer};

pub(super) const NAME: &str = "accuracy";

/// The family of settings that promise the exact answer.
pub(super) const EXACT: &str = "exact";

/// Pixels at which exact arithmetic is asked, whether both paths agree there or not.
const AUDITED_PIXELS: usize = 200;

/// One level on one path.
struct Level {
    name: &'static str,
    path: VisibilityPath,
    accuracy: fn() -> Accuracy,
}

/// A rasterizer of graphics processors, with so many bits below the pixel and a depth buffer of so
/// many bits; 0 keeps its interpolated f32 depth.
fn watertight<const SUBPIXEL: u32, const DEPTH: u32>() -> Accuracy {
    let (near, far) = (DepthBuffer::STANDARD_NEAR, DepthBuffer::STANDARD_FAR);
    let format = DepthFormat::of_bits(DEPTH);
    Accuracy::Watertight {
        subpixel_bits: SubpixelBits::new(SUBPIXEL).unwrap_or_default(),
        depth_buffer: format.and_then(|format| DepthBuffer::new(format, near, far)),
    }
}

/// Every level that there is. The first of a path is what the others of it are divided by.
const LEVELS: &[Level] = &[
    Level { name: "cast exact", path: VisibilityPath::Cast, accuracy: || Accuracy::Exact },
    Level { name: "raster exact", path: VisibilityPath::Raster, accuracy: || Accuracy::Exact },
    Level {
        name: "raster watertight, 12 bits below the pixel",
        path: VisibilityPath::Raster,
        accuracy: watertight::<12, 0>,
    },
    Level {
        name: "raster watertight, 8 bits",
        path: VisibilityPath::Raster,
        accuracy: watertight::<8, 0>,
    },
    Level {
        name: "raster watertight, 4 bits",
        path: VisibilityPath::Raster,
        accuracy: watertight::<4, 0>,
    },
    Level {
        name: "raster watertight, 8 bits, 24-bit depth",
        path: VisibilityPath::Raster,
        accuracy: watertight::<8, 24>,
    },
    Level {
        name: "raster watertight, 8 bits, 16-bit depth",
        path: VisibilityPath::Raster,
        accuracy: watertight::<8, 16>,
    },
];

/// Prices the levels, and says at how many pixels something is visible; `None` where nothing is.
pub(super) fn knob(
    scene: &Scene,
    options: &CostOptions,
    progress: &dyn Progress,
) -> Option<(usize, Knob)> {
    let window = scene.camera.resolution().window();
    let caster = Answerer::new(scene, VisibilityPath::Cast, BuildPreset::default(), progress);
    let both = [&caster, &Answerer::Raster]
        .map(|answerer| answerer.see(scene, window, Counting::Nearest, progress));
    let reference = Reference::of(scene, &both, AUDITED_PIXELS, progress);
    if reference.covered_pixels() == 0 {
        return None;
    }
    let right = picture(scene, &caster, &both[0]);
    let answerers: Vec<Answerer> = LEVELS
        .iter()
        .map(|level| match ((level.accuracy)(), level.path) {
            (Accuracy::Exact, VisibilityPath::Cast) => caster.clone(),
            (Accuracy::Exact, VisibilityPath::Raster) => Answerer::Raster,
            (Accuracy::Watertight { subpixel_bits, depth_buffer }, _) => {
                Answerer::Watertight(subpixel_bits, depth_buffer)
            }
        })
        .collect();
    let candidates: Vec<Candidate<'_>> = LEVELS
        .iter()
        .zip(&answerers)
        .map(|(level, answerer)| {
            let first = LEVELS.iter().find(|other| other.path == level.path).unwrap_or(level);
            let (right, reference) = (&right, &reference);
            Candidate {
                name: level.name.to_owned(),
                family: (level.accuracy)().name(),
                triangles: scene.mesh.len(),
                baseline: first.name.to_owned(),
                run: Box::new(move || see(scene, answerer, window)),
                judge: Box::new(move |output| {
                    let wrong_pixels = reference.wrong_pixels(&output.buffer);
                    let found = picture(scene, answerer, &output.buffer);
                    Errors { wrong_pixels, ..Errors::of(&found, right, Counted::All) }
                }),
            }
        })
        .collect();
    let measure = Measure::WrongPixels;
    let settings = take_turns(&candidates, measure, options.rounds, (NAME, progress));
    let knob = Knob {
        name: NAME,
        timed: "finding what is visible",
        against: "the exact answer; depth where both see something, radiance at every pixel",
        measure,
        reading: reading::levels(&settings, reference.covered_pixels()),
        settings,
    };
    Some((reference.covered_pixels(), knob))
}

fn see(scene: &Scene, answerer: &Answerer, window: Window) -> Output {
    let buffer = answerer.answer(scene, window, Counting::Nearest, &|| ());
    Output { buffer, radiance: None }
}

/// What a user of the picture gets of it: layers, samples, shadows and lights are the path's own.
fn picture(scene: &Scene, answerer: &Answerer, buffer: &VisibilityBuffer) -> Picture {
    let layers = answerer.layers(scene, buffer, &|| ());
    let exposure = expose(scene, answerer, (buffer, &layers), Effects::of(scene), &Unwatched);
    Picture { seen: seen(scene, buffer, TriangleId::get), radiance: exposure.radiance }
}

/// Each pixel's depth, and the thing that its triangle belongs to.
pub(super) fn seen(
    scene: &Scene,
    buffer: &VisibilityBuffer,
    thing: impl Fn(TriangleId) -> u32,
) -> Vec<Option<Seen>> {
    let z_per_t = scene.camera.z_per_t();
    buffer
        .visible
        .iter()
        .map(|visible| visible.map(|v| Seen { id: thing(v.triangle), depth: z_per_t * v.t() }))
        .collect()
}
