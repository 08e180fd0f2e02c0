//! How much the exact rasterizer does for a window, in numbers without noise.

use super::NEAREST_TILE_SIDE;
use super::arithmetic::Kernel;
use super::tile::{Tile, Tiling};
use crate::pixel::Window;
use crate::scene::Scene;
use crate::simd::SimdLevel;
use crate::visibility::LevelCounts;
use rayon::prelude::*;

/// What was done for all tiles of a window together.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RasterCounts {
    /// Pairs of a tile and a triangle that may meet in it.
    pub listed: u64,
    /// Those that were drawn, block by block; the others lie behind what was drawn, or between samples.
    pub drawn: u64,
    /// Samples that were drawn, as decisions of f32, and what these handed on.
    pub levels: LevelCounts,
}

/// Counts what [`super::rasterize_nearest`] does for a window, on the lowest instruction set, so that
/// every machine of an architecture counts the same.
pub fn count_raster(scene: &Scene, window: Window) -> RasterCounts {
    let simd = SimdLevel::Baseline;
    let tiling =
        Tiling::new(&scene.camera, &scene.mesh, window, NEAREST_TILE_SIDE, simd, Kernel::Certain);
    let counts: Vec<RasterCounts> = window
        .tiles(NEAREST_TILE_SIDE)
        .into_par_iter()
        .map_init(
            || Tile::new(false),
            |tile, window| {
                let levels = tile.draw(&tiling, window).levels;
                RasterCounts { listed: tile.listed(), drawn: tile.drawn.len() as u64, levels }
            },
        )
        .collect();
    let mut total = RasterCounts::default();
    for counts in counts {
        total.listed += counts.listed;
        total.drawn += counts.drawn;
        total.levels.add(counts.levels);
    }
    total
}
