//! What is measured on a scene: a list of variants, each a piece of work with an answer to check.
//!
//! Another accuracy, another width of SIMD or another program's kernel is one more variant. A
//! scene of overlapping triangles can take minutes per round with [`BuildPreset::VerySlow`].

use super::peers::Hits;
use crate::accel::{Accelerator, BuildPreset};
use crate::cast::shadow::ShadowCaster;
use crate::film::Film;
use crate::pixel::{Window, for_each_row};
use crate::render::{
    Accuracy, Answerer, Exposure, PlaneGroups, Progress, RenderOptions, Unwatched, VisibilityPath,
    develop, expose, render,
};
use crate::scene::Scene;
use crate::scene::light::Light;
use crate::scene::light_point::LightPoint;
use crate::shade::Effects;
use crate::visibility::{Counting, LevelCounts, VisibilityBuffer};
use std::hint::black_box;
use std::sync::Arc;

/// A kind of work, of which a workload may leave out any.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Work {
    /// Building a tree over the mesh.
    Build,
    /// The nearest triangle along one ray per pixel.
    Closest,
    /// Whether anything stands between each visible point and a light: the first of the scene that
    /// has a place or a direction, whether it casts shadows in its pictures or not.
    Any,
    /// The nearest triangle at every pixel by the rasterizer.
    Raster,
    /// Every triangle at every pixel, counted, by either path.
    Cover,
    /// Colours from what is visible, and the planes of the film.
    Shade,
    /// A whole frame from the scene.
    Frame,
}

impl Work {
    /// Every kind, in the order of a report.
    pub const ALL: [Self; 7] = [
        Self::Build,
        Self::Closest,
        Self::Any,
        Self::Raster,
        Self::Cover,
        Self::Shade,
        Self::Frame,
    ];

    /// Its word.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Build => "build",
            Self::Closest => "closest",
            Self::Any => "any",
            Self::Raster => "raster",
            Self::Cover => "cover",
            Self::Shade => "shade",
            Self::Frame => "frame",
        }
    }

    /// What it works through.
    pub const fn unit(self) -> Unit {
        match self {
            Self::Build => Unit::Triangles,
            Self::Closest | Self::Any => Unit::Rays,
            Self::Raster | Self::Cover | Self::Shade | Self::Frame => Unit::Pixels,
        }
    }

    /// So many of its unit.
    pub const fn of(self, count: usize) -> Amount {
        Amount { count, unit: self.unit() }
    }
}

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
    /// Rays: one per pixel, or one per visible point.
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
    /// Ids alone, row by row, with `u32::MAX` for nothing.
    Nearest {
        /// Of which pixels.
        window: Window,
        /// The ids.
        ids: Vec<u32>,
        /// Decisions per level of arithmetic.
        levels: LevelCounts,
    },
    /// A film with the plane `id.prim`.
    Film(Film),
    /// What another program has written.
    Hits(Arc<Hits>),
    /// Whether something stands before the light at each pixel.
    Shadowed(Vec<bool>),
    /// Nothing that can be right or wrong.
    Unchecked,
}

/// One thing that is measured.
pub struct Variant<'a> {
    /// Its name, unique in the workload: the key by which reports are compared.
    pub name: String,
    /// What kind of work it is.
    pub work: Work,
    /// What it works through.
    pub amount: Amount,
    /// The other program whose work it is; `None` for ours.
    pub program: Option<String>,
    run: Box<dyn Fn() -> Answer + 'a>,
}

impl<'a> Variant<'a> {
    /// Any work, through `count` of its unit.
    pub fn new(
        name: impl Into<String>,
        work: Work,
        count: usize,
        run: impl Fn() -> Answer + 'a,
    ) -> Self {
        Self { name: name.into(), work, amount: work.of(count), program: None, run: Box::new(run) }
    }

    /// Work that answers what is visible.
    pub fn visibility(
        name: impl Into<String>,
        work: Work,
        count: usize,
        run: impl Fn() -> VisibilityBuffer + 'a,
    ) -> Self {
        Self::new(name, work, count, move || Answer::Visibility(run()))
    }

    /// The same as another program's work.
    pub fn of(self, program: &str) -> Self {
        Self { program: Some(program.to_owned()), ..self }
    }

    /// Does the work once.
    pub fn run(&self) -> Answer {
        black_box((self.run)())
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
    /// Builds a tree with every preset of `presets`, and with the standard one.
    pub fn new(scene: &Scene, presets: &[BuildPreset], progress: &dyn Progress) -> Self {
        let build = |preset| Answerer::new(scene, VisibilityPath::Cast, preset, progress);
        let wanted =
            |preset: &BuildPreset| presets.contains(preset) || *preset == BuildPreset::default();
        let all = BuildPreset::ALL.into_iter().filter(wanted);
        Self { casters: all.map(|preset| (preset, build(preset))).collect() }
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

    /// Every variant of ours, from the standard caster's answer. Without its exposure nothing is
    /// developed.
    pub fn variants<'a>(
        &'a self,
        scene: &'a Scene,
        nearest: &'a VisibilityBuffer,
        exposure: Option<&'a Exposure>,
    ) -> Vec<Variant<'a>> {
        let window = nearest.window;
        let (triangles, pixels) = (scene.mesh.len(), window.len());
        let mut variants = Vec::new();
        for (preset, _) in &self.casters {
            let build = move || {
                black_box(Accelerator::build(&scene.mesh, *preset));
                Answer::Unchecked
            };
            let name = format!("build {}", preset_word(*preset));
            variants.push(Variant::new(name, Work::Build, triangles, build));
        }
        let see = move |answerer: &'a Answerer, counting| {
            move || answerer.answer(scene, window, counting, &|| ())
        };
        for (preset, answerer) in &self.casters {
            let name = format!("cast {}", preset_word(*preset));
            let cast = see(answerer, Counting::Nearest);
            variants.push(Variant::visibility(name, Work::Closest, pixels, cast));
        }
        let cast = self.standard_cast();
        variants.extend([
            Variant::visibility(
                "raster",
                Work::Raster,
                pixels,
                see(&Answerer::Raster, Counting::Nearest),
            ),
            Variant::visibility(
                "cast medium, cover",
                Work::Cover,
                pixels,
                see(cast, Counting::All),
            ),
            Variant::visibility(
                "raster, cover",
                Work::Cover,
                pixels,
                see(&Answerer::Raster, Counting::All),
            ),
            Variant::new("shade", Work::Shade, pixels, move || {
                black_box(expose_from(scene, cast, nearest));
                Answer::Unchecked
            }),
            Variant::new("frame", Work::Frame, pixels, || {
                Answer::Film(render(scene, &RenderOptions::default(), &Unwatched).film)
            }),
        ]);
        if let Some((light, Answerer::Cast(tree))) = light_of(scene).zip(Some(cast)) {
            let shadows = move || Answer::Shadowed(shadowed(scene, tree, nearest, light));
            variants.push(Variant::new("shadow", Work::Any, nearest.covered_pixels(), shadows));
        }
        if let Some(Exposure { radiance, alpha, .. }) = exposure {
            variants.push(Variant::new("develop", Work::Shade, pixels, move || {
                let planes = PlaneGroups::standard();
                Answer::Film(develop(scene, nearest, radiance, alpha, &planes, Accuracy::Exact))
            }));
        }
        variants
    }

    /// Figures of every tree over a mesh of `triangles`.
    pub fn trees(&self, triangles: usize) -> Vec<TreeFigures> {
        let figures = |(preset, answerer): &(BuildPreset, Answerer)| match answerer {
            Answerer::Cast(tree) => Some(TreeFigures {
                preset: preset_word(*preset),
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
pub const fn preset_word(preset: BuildPreset) -> &'static str {
    match preset {
        BuildPreset::Fastest => "fastest",
        BuildPreset::Fast => "fast",
        BuildPreset::Medium => "medium",
        BuildPreset::Slow => "slow",
        BuildPreset::VerySlow => "very-slow",
    }
}

/// The first light that has a place or a direction.
pub fn light_of(scene: &Scene) -> Option<LightPoint> {
    scene.lights.iter().find_map(|light| match light {
        Light::Directional(light) => Some(LightPoint::Direction(light.aim.map(|c| -c))),
        Light::Point(light) => Some(LightPoint::Position(light.position)),
        Light::Spot(light) => Some(LightPoint::Position(light.position)),
        Light::Ambient(_) | Light::Hemisphere(_) => None,
    })
}

/// Whether any triangle stands between the light and what is visible, pixel by pixel.
fn shadowed(
    scene: &Scene,
    tree: &Accelerator,
    nearest: &VisibilityBuffer,
    light: LightPoint,
) -> Vec<bool> {
    let window = nearest.window;
    let width = window.width() as usize;
    let mut shadowed = vec![false; window.len()];
    for_each_row(&mut shadowed, width, &|| (), |row, pixels| {
        let mut caster = ShadowCaster::new(scene, tree);
        for (column, shadowed) in pixels.iter_mut().enumerate() {
            let index = row * width + column;
            *shadowed = nearest.visible[index].as_ref().is_some_and(|visible| {
                caster.occluder(window.pixel(index), visible, light, |_| true).is_some()
            });
        }
    });
    shadowed
}

/// Everything between visibility and the film's planes: layers, samples, shadows and lights.
fn expose_from(scene: &Scene, answerer: &Answerer, nearest: &VisibilityBuffer) -> Exposure {
    let layers = answerer.layers(scene, nearest, &|| ());
    expose(scene, answerer, (nearest, &layers), Effects::of(scene), &Unwatched)
}
