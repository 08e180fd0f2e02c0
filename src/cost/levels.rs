//! The knob *accuracy*: how visibility is decided, on both paths.
//!
//! One entry of [`LEVELS`] is one setting; what it does is up to the caster and to [`Answerer`]. Finding
//! what is visible is timed, with the tree built before: ids and t alone by the caster, which is what
//! its levels differ in, and whole surfaces by the rasterizer. Colours are compared too, for they show what a wrong
//! pixel does, but shading is not timed: it is the same for all.

use super::errors::{Counted, Errors, Picture, Seen};
use super::turns::{Candidate, Output, take_turns};
use super::{CostOptions, Knob, Measure, reading};
use crate::accel::BuildPreset;
use crate::bench::reference::Reference;
use crate::cast::{self, CastOptions, Unproven};
use crate::mesh::TriangleId;
use crate::pixel::Window;
use crate::raster::{
    self, DepthBuffer, DepthFormat, RasterOptions, SubpixelBits, rasterize_nearest,
    rasterize_unproven_into,
};
use crate::render::{Answerer, Progress, Unwatched, VisibilityPath, expose};
use crate::scene::Scene;
use crate::shade::Effects;
use crate::simd::SimdLevel;
use crate::visibility::{self, Counting, LevelCounts, NearestBuffer, VisibilityBuffer};

pub(super) const NAME: &str = "accuracy";

/// The family of settings that promise the exact answer.
pub(super) const EXACT: &str = "exact";

/// Pixels at which exact arithmetic is asked, whether both paths agree there or not.
const AUDITED_PIXELS: usize = 200;

/// One level on one path.
struct Level {
    name: &'static str,
    way: fn() -> Way,
}

/// How a level finds what is visible.
enum Way {
    /// Rays, exactly.
    Cast,
    /// Rays, without proof.
    CastUnproven(Unproven),
    /// The rasterizer, exactly.
    Raster,
    /// A rasterizer without proof.
    RasterUnproven(raster::Unproven),
}

impl Way {
    /// The promise, by its name.
    fn family(&self) -> &'static str {
        match self {
            Self::Cast | Self::Raster => EXACT,
            Self::CastUnproven(unproven) => unproven.name(),
            Self::RasterUnproven(unproven) => unproven.name(),
        }
    }

    /// The name of the level that its time is divided by.
    fn baseline(&self) -> &'static str {
        match self {
            Self::Cast | Self::CastUnproven(_) => "cast exact",
            Self::Raster | Self::RasterUnproven(_) => "raster exact",
        }
    }
}

/// A rasterizer of graphics processors, with so many bits below the pixel and a depth buffer of so
/// many bits.
fn watertight<const SUBPIXEL: u32, const DEPTH: u32>() -> Way {
    Way::RasterUnproven(raster::Unproven::Watertight {
        subpixel_bits: SubpixelBits::new(SUBPIXEL).unwrap_or_default(),
        depth_buffer: depth_buffer(DEPTH),
    })
}

/// The f32 rasterizer with a depth buffer of so many bits.
fn fast<const DEPTH: u32>() -> Way {
    Way::RasterUnproven(raster::Unproven::Fast { depth_buffer: depth_buffer(DEPTH) })
}

/// A depth buffer of so many bits; 0 keeps the f32 1/w.
fn depth_buffer(bits: u32) -> Option<DepthBuffer> {
    let (near, far) = (DepthBuffer::STANDARD_NEAR, DepthBuffer::STANDARD_FAR);
    DepthBuffer::new(DepthFormat::of_bits(bits)?, near, far)
}

/// Every level that there is.
const LEVELS: &[Level] = &[
    Level { name: "cast exact", way: || Way::Cast },
    Level { name: "cast double", way: || Way::CastUnproven(Unproven::Double) },
    Level { name: "cast watertight", way: || Way::CastUnproven(Unproven::Watertight) },
    Level { name: "cast fast", way: || Way::CastUnproven(Unproven::Fast) },
    Level { name: "raster exact", way: || Way::Raster },
    Level { name: "raster double", way: || Way::RasterUnproven(raster::Unproven::Double) },
    Level { name: "raster watertight, 12 bits below the pixel", way: watertight::<12, 0> },
    Level { name: "raster watertight, 8 bits", way: watertight::<8, 0> },
    Level { name: "raster watertight, 4 bits", way: watertight::<4, 0> },
    Level { name: "raster watertight, 8 bits, 24-bit depth", way: watertight::<8, 24> },
    Level { name: "raster watertight, 8 bits, 16-bit depth", way: watertight::<8, 16> },
    Level { name: "raster fast", way: fast::<0> },
    Level { name: "raster fast, 24-bit depth", way: fast::<24> },
    Level { name: "raster fast, 16-bit depth", way: fast::<16> },
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
    let ways: Vec<Way> = LEVELS.iter().map(|level| (level.way)()).collect();
    let candidates: Vec<Candidate<'_>> = LEVELS
        .iter()
        .zip(&ways)
        .map(|(level, way)| {
            let (right, reference, caster) = (&right, &reference, &caster);
            Candidate {
                name: level.name.to_owned(),
                family: way.family(),
                triangles: scene.mesh.len(),
                baseline: way.baseline().to_owned(),
                run: Box::new(move || see(scene, caster, way, window)),
                judge: Box::new(move |output| {
                    let (wrong_pixels, buffer) = match output {
                        Output::Picture(buffer, _) => (reference.wrong_pixels(&buffer), buffer),
                        Output::Nearest(nearest) => {
                            let ids = nearest.ids.iter().copied();
                            let wrong_pixels = reference.wrong_ids(window, ids);
                            (wrong_pixels, surfaces(scene, caster, way, &nearest))
                        }
                    };
                    let found = picture(scene, &answerer(caster, way), &buffer);
                    Errors { wrong_pixels, ..Errors::of(&found, right, Counted::All) }
                }),
            }
        })
        .collect();
    let measure = Measure::WrongPixels;
    let settings = take_turns(&candidates, measure, options.rounds, (NAME, progress));
    let knob = Knob {
        name: NAME,
        timed: "finding what is visible: ids and t",
        against: "the exact answer; depth where both see something, radiance at every pixel",
        measure,
        reading: reading::levels(&settings, reference.covered_pixels()),
        settings,
    };
    Some((reference.covered_pixels(), knob))
}

fn see(scene: &Scene, caster: &Answerer, way: &Way, window: Window) -> Output {
    let best = SimdLevel::best();
    Output::Nearest(match (way, caster) {
        (Way::Cast, Answerer::Cast(tree)) => {
            cast::cast_nearest(scene, tree, window, CastOptions::default(), &|| ())
        }
        (Way::CastUnproven(unproven), Answerer::Cast(tree)) => {
            cast::cast_unproven(scene, tree, window, *unproven, best, &|| ())
        }
        (Way::RasterUnproven(unproven), _) => {
            let levels = LevelCounts::default();
            let mut buffer = NearestBuffer { window, ids: Vec::new(), t: Vec::new(), levels };
            rasterize_unproven_into(scene, *unproven, best, &mut buffer);
            buffer
        }
        _ => rasterize_nearest(scene, window, RasterOptions::default(), &|| ()),
    })
}

/// What was seen, with all that a picture needs of it. The rasterizer's levels differ in depths too
/// and are asked for them.
fn surfaces(
    scene: &Scene,
    caster: &Answerer,
    way: &Way,
    nearest: &NearestBuffer,
) -> VisibilityBuffer {
    match way {
        Way::Cast => cast::surfaces(scene, nearest, visibility::Level::Double),
        Way::CastUnproven(unproven) => cast::surfaces(scene, nearest, unproven.level()),
        _ => answerer(caster, way).answer(scene, nearest.window, Counting::Nearest, &|| ()),
    }
}

/// Who answers what the level itself does not: layers, and shadows.
fn answerer(caster: &Answerer, way: &Way) -> Answerer {
    match way {
        Way::Cast | Way::CastUnproven(_) => caster.clone(),
        Way::Raster => Answerer::Raster,
        Way::RasterUnproven(unproven) => Answerer::RasterUnproven(*unproven),
    }
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
