//! One path, ready to be asked about a scene as often as needed: once for a plain frame, once per
//! sub-sample and band for others.

use super::VisibilityPath;
use super::progress::Progress;
use crate::accel::{Accelerator, BuildPreset};
use crate::cast::{self, cast, cast_layers, cast_unproven, surfaces};
use crate::pixel::Window;
use crate::raster::{self, rasterize, rasterize_layers, rasterize_unproven};
use crate::scene::Scene;
use crate::simd::SimdLevel;
use crate::visibility::{Counting, Layers, VisibilityBuffer};

/// A path that is ready to answer for every camera over one mesh.
#[derive(Clone, Debug)]
pub enum Answerer {
    /// Rays through this BVH.
    Cast(Accelerator),
    /// The z-buffer rasterizer.
    Raster,
    /// Rays through this BVH without proof. They know only the nearest surface.
    CastUnproven(Accelerator, cast::Unproven),
    /// A rasterizer without proof. It knows only the nearest surface.
    RasterUnproven(raster::Unproven),
}

impl Answerer {
    /// Makes a path ready to answer about the scene's mesh.
    pub fn new(
        scene: &Scene,
        path: VisibilityPath,
        preset: BuildPreset,
        progress: &dyn Progress,
    ) -> Self {
        match path {
            VisibilityPath::Raster => Self::Raster,
            VisibilityPath::Cast => {
                progress.begin("build", 1);
                let accelerator = Accelerator::build(&scene.mesh, preset);
                progress.step();
                Self::Cast(accelerator)
            }
        }
    }

    /// The BVH, where there is one.
    pub const fn tree(&self) -> Option<&Accelerator> {
        match self {
            Self::Cast(tree) | Self::CastUnproven(tree, _) => Some(tree),
            Self::Raster | Self::RasterUnproven(_) => None,
        }
    }

    /// What it does, as progress calls it, and the side of its tiles in pixels.
    pub(super) const fn stage(&self) -> (&'static str, u32) {
        match self {
            Self::Cast(_) | Self::CastUnproven(..) => ("cast", cast::TILE_SIDE),
            Self::Raster => ("rasterize", raster::TILE_SIDE),
            Self::RasterUnproven(unproven) => ("rasterize", unproven.tile_side()),
        }
    }

    /// What is visible at every pixel of a window.
    pub fn see(
        &self,
        scene: &Scene,
        window: Window,
        counting: Counting,
        progress: &dyn Progress,
    ) -> VisibilityBuffer {
        let (stage, side) = self.stage();
        progress.begin(stage, window.tiles(side).len());
        self.answer(scene, window, counting, &|| progress.step())
    }

    /// [`Self::see`], with `done` called once per finished tile, from any thread.
    pub fn answer(
        &self,
        scene: &Scene,
        window: Window,
        counting: Counting,
        done: &(dyn Fn() + Sync),
    ) -> VisibilityBuffer {
        match self {
            Self::Cast(accelerator) => cast(scene, accelerator, window, counting, done),
            Self::Raster => rasterize(scene, window, counting, done),
            Self::CastUnproven(accelerator, unproven) => {
                let simd = SimdLevel::best();
                let nearest = cast_unproven(scene, accelerator, window, *unproven, simd, done);
                surfaces(scene, &nearest, unproven.level())
            }
            Self::RasterUnproven(unproven) => {
                let simd = SimdLevel::best();
                rasterize_unproven(scene, window, *unproven, simd, counting, done)
            }
        }
    }

    /// What lies behind the see-through surfaces of its own answer.
    pub fn see_through(
        &self,
        scene: &Scene,
        nearest: &VisibilityBuffer,
        progress: &dyn Progress,
    ) -> Layers {
        if has_see_through(scene, nearest) {
            progress.begin("layers", nearest.window.tiles(self.stage().1).len());
        }
        self.layers(scene, nearest, &|| progress.step())
    }

    /// [`Self::see_through`], with `done` called once per finished tile, from any thread. Nothing
    /// is asked where every surface is opaque; a path without proof has no answer to it and shows
    /// none.
    pub fn layers(
        &self,
        scene: &Scene,
        nearest: &VisibilityBuffer,
        done: &(dyn Fn() + Sync),
    ) -> Layers {
        if !has_see_through(scene, nearest) {
            return Layers::none(nearest.window);
        }
        let opaque = |id| scene.is_opaque(id);
        match self {
            Self::Cast(accelerator) => cast_layers(scene, accelerator, nearest, &opaque, done),
            Self::Raster => rasterize_layers(scene, nearest, &opaque, done),
            Self::CastUnproven(..) | Self::RasterUnproven(_) => Layers::none(nearest.window),
        }
    }
}

/// Whether any nearest surface is see-through.
pub(super) fn has_see_through(scene: &Scene, nearest: &VisibilityBuffer) -> bool {
    // Most scenes have no such material, and the buffer is large.
    if scene.materials.iter().all(|material| material.opacity == 1.0) {
        return false;
    }
    // Neighbours mostly see the same triangle.
    let mut last = None;
    nearest.visible.iter().flatten().any(|visible| {
        let is_new = last.replace(visible.triangle) != Some(visible.triangle);
        is_new && !scene.is_opaque(visible.triangle)
    })
}
