//! What is measured on a scene: a list of variants, each a piece of work with an answer to check.
//!
//! Another accuracy, another width of SIMD or another program's kernel is one more variant. A
//! scene of overlapping triangles can take minutes per round with [`BuildPreset::VerySlow`].

use crate::accel::{Accelerator, BuildPreset};
use crate::film::Film;
use crate::pixel::Window;
use crate::render::{
    Accuracy, Answerer, Exposure, PlaneGroups, Progress, RenderOptions, Unwatched, VisibilityPath,
    develop, expose, render,
};
use crate::scene::Scene;
use crate::shade::Effects;
use crate::visibility::{Counting, VisibilityBuffer};
use std::hint::black_box;

/// How much a variant works through.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Amount {
    /// How many.
    pub count: usize,
    /// Of what.
    pub unit: Unit,
}

/// What a variant works through.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// Triangles of the mesh.
    Triangles,
    /// Rays, one per pixel.
    Rays,
    /// Pixels of the frame.
    Pixels,
}

impl Unit {
    /// The unit of its rate.
    pub const fn rate(self) -> &'static str {
        match self {
            Self::Triangles => "Mtriangle/s",
            Self::Rays => "Mray/s",
            Self::Pixels => "Mpixel/s",
        }
    }
}

/// What a variant hands back to be checked.
#[derive(Debug)]
pub enum Answer {
    /// Which triangle is visible at each pixel.
    Visibility(VisibilityBuffer),
    /// A film with the plane `id.prim`.
    Film(Film),
    /// Nothing that names triangles.
    Unchecked,
}

/// One thing that is measured.
pub struct Variant<'a> {
    /// Its name, unique in the workload: the key by which reports are compared.
    pub name: String,
    /// What it works through.
    pub amount: Amount,
    work: Box<dyn Fn() -> Answer + 'a>,
}

impl<'a> Variant<'a> {
    /// Any work.
    pub fn new(name: impl Into<String>, amount: Amount, work: impl Fn() -> Answer + 'a) -> Self {
        Self { name: name.into(), amount, work: Box::new(work) }
    }

    /// Work that answers what is visible.
    pub fn visibility(
        name: impl Into<String>,
        amount: Amount,
        work: impl Fn() -> VisibilityBuffer + 'a,
    ) -> Self {
        Self::new(name, amount, move || Answer::Visibility(work()))
    }

    /// Does the work once.
    pub fn run(&self) -> Answer {
        black_box((self.work)())
    }
}

/// Figures of a tree, the same on every machine.
#[derive(Clone, Debug, PartialEq)]
pub struct TreeFigures {
    /// Word for the build preset.
    pub preset: &'static str,
    /// Nodes on the longest path, leaves included.
    pub depth: usize,
    /// Inner nodes.
    pub nodes: usize,
    /// Memory of nodes and leaf triangles, in bytes.
    pub bytes: usize,
    /// The same per triangle of the mesh.
    pub bytes_per_triangle: f64,
    /// [`Accelerator::surface_area_cost`]: expected box pairs and triangles that a ray tests.
    pub surface_area_cost: Option<f64>,
}

/// The scene's trees, built once, for the variants to share.
#[derive(Debug)]
pub struct Kernels {
    casters: Vec<(BuildPreset, Answerer)>,
}

impl Kernels {
    /// Builds a tree with every preset.
    pub fn new(scene: &Scene, progress: &dyn Progress) -> Self {
        let build = |preset| Answerer::new(scene, VisibilityPath::Cast, preset, progress);
        Self { casters: BuildPreset::ALL.map(|preset| (preset, build(preset))).into() }
    }

    /// The caster with the standard preset.
    pub fn standard_cast(&self) -> &Answerer {
        let standard = self.casters.iter().find(|(preset, _)| *preset == BuildPreset::default());
        standard.map_or(&self.casters[0].1, |(_, answerer)| answerer)
    }

    /// The exposure of the standard caster's answer, for developing to begin with.
    pub fn exposure(&self, scene: &Scene, nearest: &VisibilityBuffer) -> Exposure {
        expose_from(scene, self.standard_cast(), nearest)
    }

    /// Every standard variant. `seen` is the standard caster's answer and its exposure.
    pub fn variants<'a>(
        &'a self,
        scene: &'a Scene,
        (nearest, exposure): (&'a VisibilityBuffer, &'a Exposure),
    ) -> Vec<Variant<'a>> {
        let window = nearest.window;
        let amount = |unit| Amount {
            count: if unit == Unit::Triangles { scene.mesh.len() } else { window.len() },
            unit,
        };
        let mut variants = Vec::new();
        for (preset, _) in &self.casters {
            variants.push(Variant::new(
                format!("build {}", word(*preset)),
                amount(Unit::Triangles),
                move || {
                    black_box(Accelerator::build(&scene.mesh, *preset));
                    Answer::Unchecked
                },
            ));
        }
        for (preset, answerer) in &self.casters {
            variants.push(Variant::visibility(
                format!("cast {}", word(*preset)),
                amount(Unit::Rays),
                move || answer(scene, answerer, window, Counting::Nearest),
            ));
        }
        let cast = self.standard_cast();
        variants.push(Variant::visibility("cast medium, cover", amount(Unit::Rays), move || {
            answer(scene, cast, window, Counting::All)
        }));
        variants.push(Variant::visibility("raster", amount(Unit::Pixels), move || {
            answer(scene, &Answerer::Raster, window, Counting::Nearest)
        }));
        variants.push(Variant::visibility("raster, cover", amount(Unit::Pixels), move || {
            answer(scene, &Answerer::Raster, window, Counting::All)
        }));
        variants.push(Variant::new("shade", amount(Unit::Pixels), move || {
            black_box(expose_from(scene, cast, nearest));
            Answer::Unchecked
        }));
        variants.push(Variant::new("develop", amount(Unit::Pixels), move || {
            let planes = PlaneGroups::standard();
            let Exposure { radiance, alpha, .. } = exposure;
            Answer::Film(develop(scene, nearest, radiance, alpha, &planes, Accuracy::Exact))
        }));
        variants.push(Variant::new("frame", amount(Unit::Pixels), || {
            Answer::Film(render(scene, &RenderOptions::default(), &Unwatched).film)
        }));
        variants
    }

    /// Figures of every tree over a mesh of `triangles`.
    pub fn trees(&self, triangles: usize) -> Vec<TreeFigures> {
        let figures = |(preset, answerer): &(BuildPreset, Answerer)| match answerer {
            Answerer::Cast(tree) => Some(TreeFigures {
                preset: word(*preset),
                depth: tree.depth(),
                nodes: tree.node_count(),
                bytes: tree.bytes(),
                bytes_per_triangle: tree.bytes() as f64 / triangles.max(1) as f64,
                surface_area_cost: tree.surface_area_cost(),
            }),
            Answerer::Raster | Answerer::Watertight(..) => None,
        };
        self.casters.iter().filter_map(figures).collect()
    }
}

/// The word for a preset.
const fn word(preset: BuildPreset) -> &'static str {
    match preset {
        BuildPreset::Fastest => "fastest",
        BuildPreset::Fast => "fast",
        BuildPreset::Medium => "medium",
        BuildPreset::Slow => "slow",
        BuildPreset::VerySlow => "very-slow",
    }
}

fn answer(
    scene: &Scene,
    answerer: &Answerer,
    window: Window,
    counting: Counting,
) -> VisibilityBuffer {
    answerer.answer(scene, window, counting, &|| ())
}

/// Everything between visibility and the film's planes: layers, samples, shadows and lights.
fn expose_from(scene: &Scene, answerer: &Answerer, nearest: &VisibilityBuffer) -> Exposure {
    let layers = answerer.layers(scene, nearest, &|| ());
    expose(scene, answerer, (nearest, &layers), Effects::of(scene), &Unwatched)
}
