//! A path that looks through one camera: asked about a frame's bands, one after the other or side by
//! side, with what they share made once.

use super::{Answerer, Progress};
use crate::cast::{CastOptions, CastPicture, cast_into};
use crate::pixel::Window;
use crate::raster::{RasterOptions, RasterPicture, TILE_SIDE, rasterize_into};
use crate::scene::Scene;
use crate::visibility::{Counting, VisibilityBuffer};

/// A frame that is ready to be seen.
pub(super) enum Eye<'a> {
    /// By rays.
    Cast(Box<CastPicture<'a>>, Counting),
    /// By the rasterizer.
    Raster(Box<RasterPicture<'a>>),
    /// By a path whose bands share nothing.
    Other(&'a Scene, &'a Answerer, Counting),
}

impl<'a> Eye<'a> {
    /// Looks at the bands of a window.
    pub(super) fn new(
        scene: &'a Scene,
        answerer: &'a Answerer,
        window: Window,
        counting: Counting,
    ) -> Self {
        match answerer {
            Answerer::Cast(accelerator) => {
                let picture = CastPicture::new(scene, accelerator, CastOptions::default());
                Self::Cast(Box::new(picture), counting)
            }
            Answerer::Raster => {
                let options = RasterOptions { tile_side: TILE_SIDE, ..RasterOptions::default() };
                Self::Raster(Box::new(RasterPicture::new(scene, window, counting, options)))
            }
            other => Self::Other(scene, other, counting),
        }
    }

    /// Finds what is visible in a band.
    pub(super) fn see(&self, band: Window, buffer: &mut VisibilityBuffer, progress: &dyn Progress) {
        let (stage, side) = match self {
            Self::Cast(..) => ("cast", crate::cast::TILE_SIDE),
            Self::Raster(_) => ("rasterize", TILE_SIDE),
            Self::Other(_, answerer, _) => answerer.stage(),
        };
        progress.begin(stage, band.tiles(side).len());
        let done = || progress.step();
        match self {
            Self::Cast(picture, counting) => cast_into(picture, band, *counting, buffer, &done),
            Self::Raster(picture) => rasterize_into(picture, band, buffer, &done),
            Self::Other(scene, answerer, counting) => {
                *buffer = answerer.answer(scene, band, *counting, &done);
            }
        }
    }
}
