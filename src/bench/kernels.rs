//! Our own variants: trees by every preset, both paths, shading, and a whole frame.
//!
//! The caster and the rasterizer are timed by their nearest triangles alone, ids and t, into memory
//! that is there already, which is what other programs are asked for; and once with all that
//! a picture needs of a surface. A scene of overlapping triangles can take minutes per round with
//! [`BuildPreset::VerySlow`].

use super::workload::{Answer, Variant, Work};
use crate::accel::{Accelerator, BuildPreset};
use crate::cast::shadow::ShadowCaster;
use crate::cast::{CastOptions, Unproven, cast_nearest_into, cast_unproven_into, cast_with};
use crate::pixel::{Window, for_each_row};
use crate::raster::{
    self, RasterOptions, rasterize_nearest_into, rasterize_unproven_into, rasterize_with,
};
use crate::render::{
    Accuracy, Answerer, Exposure, PlaneGroups, Progress, RenderOptions, Unwatched, VisibilityPath,
    develop, expose, render,
};
use crate::scene::Scene;
use crate::scene::light::Light;
use crate::scene::light_point::LightPoint;
use crate::shade::{Effects, ShadeOptions, shade_with};
use crate::simd::SimdLevel;
use crate::visibility::{Counting, LevelCounts, NearestBuffer, VisibilityBuffer};
use std::cell::RefCell;
use std::hint::black_box;
use std::rc::Rc;

/// The caster as it is used, and the same kernel without proof: their times are compared.
pub const PROVEN: &str = "cast medium";
/// See [`PROVEN`].
pub const UNPROVEN: &str = "cast medium, fast";

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
    simd: SimdLevel,
}

impl Kernels {
    /// Builds a tree with every preset of `presets`, and with the standard one. Vector kernels run
    /// on `simd`, but for those of whole frames and what surrounds shading, which know no choice.
    pub fn new(
        scene: &Scene,
        presets: &[BuildPreset],
        simd: SimdLevel,
        progress: &dyn Progress,
    ) -> Self {
        let build = |preset| Answerer::new(scene, VisibilityPath::Cast, preset, progress);
        let wanted =
            |preset: &BuildPreset| presets.contains(preset) || *preset == BuildPreset::default();
        let all = BuildPreset::ALL.into_iter().filter(wanted);
        Self { casters: all.map(|preset| (preset, build(preset))).collect(), simd }
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
        let mut variants = Vec::new();
        for (preset, answerer) in &self.casters {
            let Answerer::Cast(tree) = answerer else { continue };
            let build = move || {
                black_box(Accelerator::build(&scene.mesh, *preset));
                Answer::Unchecked
            };
            let name = format!("build {}", preset_word(*preset));
            variants.push(Variant::new(name, Work::Build, scene.mesh.len(), build));
            let options = CastOptions { simd: self.simd, ..CastOptions::default() };
            let buffer = empty(window);
            let cast = move || {
                cast_nearest_into(scene, tree, options, &mut buffer.borrow_mut(), &|| ());
                Answer::Nearest(Rc::clone(&buffer))
            };
            let name = format!("cast {}", preset_word(*preset));
            variants.push(Variant::new(name, Work::Closest, window.len(), cast));
            if *preset == BuildPreset::default() {
                variants.extend(self.standard_casts(scene, tree, nearest));
            }
        }
        variants.extend(self.rasters(scene, window));
        variants.extend(self.pictures(scene, nearest, exposure));
        variants
    }

    /// What is asked of the standard tree beside the nearest triangles.
    fn standard_casts<'a>(
        &self,
        scene: &'a Scene,
        tree: &'a Accelerator,
        nearest: &'a VisibilityBuffer,
    ) -> Vec<Variant<'a>> {
        let window = nearest.window;
        let together = CastOptions { simd: self.simd, ..CastOptions::default() };
        let single = CastOptions { tiles: false, ..together };
        let cast = |name, work, counting, options| {
            Variant::visibility(name, work, window.len(), move || {
                cast_with(scene, tree, window, counting, options, &|| ())
            })
        };
        let unproven = Unproven::ALL.map(|unproven| {
            let simd = self.simd;
            let name = format!("cast medium, {}", unproven.name());
            let buffer = empty(window);
            Variant::new(name, Work::Closest, window.len(), move || {
                let into = &mut buffer.borrow_mut();
                cast_unproven_into(scene, tree, unproven, simd, into, &|| ());
                Answer::Nearest(Rc::clone(&buffer))
            })
            .unproven()
        });
        let mut variants = vec![
            cast("cast medium, surfaces", Work::Closest, Counting::Nearest, together),
            cast("cast medium, one by one", Work::Closest, Counting::Nearest, single),
            cast("cast medium, cover", Work::Cover, Counting::All, together),
        ];
        variants.extend(unproven);
        if let Some(light) = light_of(scene) {
            let shadows = move || Answer::Shadowed(shadowed(scene, tree, nearest, light));
            variants.push(Variant::new("shadow", Work::Any, nearest.covered_pixels(), shadows));
        }
        variants
    }

    fn rasters<'a>(&self, scene: &'a Scene, window: Window) -> Vec<Variant<'a>> {
        let options = RasterOptions { simd: self.simd, ..RasterOptions::default() };
        let raster = |name, work, counting| {
            Variant::visibility(name, work, window.len(), move || {
                rasterize_with(scene, window, counting, options, &|| ())
            })
        };
        let buffer = empty(window);
        let nearest = move || {
            rasterize_nearest_into(scene, &mut buffer.borrow_mut(), options, &|| ());
            Answer::Nearest(Rc::clone(&buffer))
        };
        let unproven = raster::Unproven::ALL.map(|unproven| {
            let simd = self.simd;
            let name = format!("raster, {}", unproven.name());
            let buffer = empty(window);
            Variant::new(name, Work::Raster, window.len(), move || {
                rasterize_unproven_into(scene, unproven, simd, &mut buffer.borrow_mut());
                Answer::Nearest(Rc::clone(&buffer))
            })
            .unproven()
        });
        let mut variants = vec![
            Variant::new("raster", Work::Raster, window.len(), nearest),
            raster("raster, surfaces", Work::Raster, Counting::Nearest),
            raster("raster, cover", Work::Cover, Counting::All),
        ];
        variants.extend(unproven);
        variants
    }

    fn pictures<'a>(
        &'a self,
        scene: &'a Scene,
        nearest: &'a VisibilityBuffer,
        exposure: Option<&'a Exposure>,
    ) -> Vec<Variant<'a>> {
        let pixels = nearest.window.len();
        let simd = Some(self.simd);
        let mut variants = vec![
            Variant::new("light", Work::Shade, pixels, move || {
                let options = ShadeOptions { simd, ..ShadeOptions::new(Effects::of(scene)) };
                black_box(shade_with(scene, nearest, &options, None, &|| ()));
                Answer::Unchecked
            }),
            Variant::new("shade", Work::Shade, pixels, move || {
                black_box(expose_from(scene, self.standard_cast(), nearest));
                Answer::Unchecked
            }),
            Variant::new("frame", Work::Frame, pixels, || {
                Answer::Film(render(scene, &RenderOptions::default(), &Unwatched).film)
            }),
        ];
        if let Some(Exposure { radiance, alpha, .. }) = exposure {
            variants.push(Variant::new("develop", Work::Shade, pixels, move || {
                let planes = PlaneGroups::standard();
                Answer::Film(develop(scene, nearest, radiance, alpha, &planes, Accuracy::Exact))
            }));
        }
        variants
    }

    /// Every tree, by the word for its preset.
    pub fn trees_by_preset(&self) -> impl Iterator<Item = (&'static str, &Accelerator)> {
        let casters = self.casters.iter();
        casters.filter_map(|(preset, answerer)| Some((preset_word(*preset), answerer.tree()?)))
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
            _ => None,
        };
        self.casters.iter().filter_map(figures).collect()
    }
}

/// Memory for the nearest triangles, before anything is known.
fn empty(window: Window) -> Rc<RefCell<NearestBuffer>> {
    let (ids, t) = (vec![u32::MAX; window.len()], vec![f32::INFINITY; window.len()]);
    Rc::new(RefCell::new(NearestBuffer { window, ids, t, levels: LevelCounts::default() }))
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
