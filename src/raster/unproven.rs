//! The rasterizer without proof: as others build it, to be compared with the exact one.
//!
//! - `Double`: edge rows and 1/w in f64, believed.
//! - `Watertight`: as graphics processors have it (`watertight`).
//! - `Fast`: edge rows and 1/w in f32, believed; on request with a depth buffer of few bits.
//!
//! `Double` and `Fast` are the exact rasterizer's own kernels without what makes them certain: no
//! bound, no exact stage, no tie rule. Edges are inclusive. Of equal depths the first that is drawn
//! stays: in a depth buffer that is the lowest id, else any. Which triangles meet which tile is found
//! with certainty, so that what is missed, a test of a sample missed. Rows start at a tile's corner:
//! another window may cut other tiles and believe otherwise; threads and instruction sets do not.
//! Covers are not counted.

mod double;
mod stored;
mod write;

use super::arithmetic::Kernel;
use super::strips::{for_each_strip, strips};
use super::tile::{Tile, Tiling};
use super::watertight::{
    DepthBuffer, SubpixelBits, rasterize_watertight, rasterize_watertight_into,
};
use super::{NEAREST_TILE_SIDE, TILE_SIDE};
use crate::pixel::Window;
use crate::scene::Scene;
use crate::simd::SimdLevel;
use crate::visibility::{Counting, LevelCounts, NearestBuffer, VisibilityBuffer};
pub(super) use stored::StoredDepth;

/// A rasterizer without proof.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Unproven {
    /// f64 without bounds.
    Double,
    /// Fixed-point edges without holes between neighbours.
    Watertight {
        /// Bits of the vertices' grid below the pixel.
        subpixel_bits: SubpixelBits,
        /// How depths are stored; `None` keeps the interpolated f32 1/w.
        depth_buffer: Option<DepthBuffer>,
    },
    /// f32 without bounds.
    Fast {
        /// How depths are stored; `None` keeps the f32 1/w.
        depth_buffer: Option<DepthBuffer>,
    },
}

impl Unproven {
    /// All of them as they come without options, the slowest first.
    pub const ALL: [Self; 3] = [
        Self::Watertight { subpixel_bits: SubpixelBits::STANDARD, depth_buffer: None },
        Self::Double,
        Self::Fast { depth_buffer: None },
    ];

    /// The name: `double`, `watertight` or `fast`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Double => "double",
            Self::Watertight { .. } => "watertight",
            Self::Fast { .. } => "fast",
        }
    }

    /// Side of its tiles, in pixels. Rounded rows are of a tile, so that ids without proof may depend on
    /// it.
    pub const fn tile_side(self) -> u32 {
        match self {
            Self::Watertight { .. } => TILE_SIDE,
            Self::Double | Self::Fast { .. } => NEAREST_TILE_SIDE,
        }
    }

    /// The depth buffer, where there is one.
    pub const fn depth_buffer(self) -> Option<DepthBuffer> {
        match self {
            Self::Double => None,
            Self::Watertight { depth_buffer, .. } | Self::Fast { depth_buffer } => depth_buffer,
        }
    }
}

/// What an unproven rasterizer takes for visible at every pixel of `window`, which must lie inside
/// the camera's frame. Nothing is promised.
///
/// t is the depth that was compared (with a depth buffer, the one that was stored), `t_lo` and `t_hi`
/// alike. `Double` and `Fast` take weights from f64 rows, cut off at 0 where the sample lies outside,
/// and never count cover. The level is that of the arithmetic, and certain of nothing. With a depth
/// buffer, another triangle at the same stored depth is a tie. `done` is called once per finished
/// tile of `window.tiles(unproven.tile_side())`, from any thread.
pub fn rasterize_unproven(
    scene: &Scene,
    window: Window,
    unproven: Unproven,
    simd: SimdLevel,
    counting: Counting,
    done: &(dyn Fn() + Sync),
) -> VisibilityBuffer {
    let kernel = match kernel(scene, unproven) {
        Ok(kernel) => kernel,
        Err((bits, buffer)) => {
            return rasterize_watertight(scene, window, bits, buffer, counting, done);
        }
    };
    let tiling = Tiling::new(&scene.camera, &scene.mesh, window, NEAREST_TILE_SIDE, simd, kernel);
    let mut visible = vec![None; window.len()];
    for_each_strip(
        strips(window, NEAREST_TILE_SIDE, &mut visible),
        || Tile::new(false),
        |tile, mut visible| {
            for window in visible.tiles.clone() {
                tile.draw(&tiling, window);
                write::surfaces(&tiling, tile, window, &mut visible);
                done();
            }
        },
    );
    VisibilityBuffer { window, visible, cover: None, levels: LevelCounts::default() }
}

/// As [`rasterize_unproven`], ids and t alone, into a buffer that there is already: all of it is
/// written.
pub fn rasterize_unproven_into(
    scene: &Scene,
    unproven: Unproven,
    simd: SimdLevel,
    buffer: &mut NearestBuffer,
) {
    let window = buffer.window;
    buffer.ids.resize(window.len(), u32::MAX);
    buffer.t.resize(window.len(), f32::INFINITY);
    buffer.levels = LevelCounts::default();
    let kernel = match kernel(scene, unproven) {
        Ok(kernel) => kernel,
        Err((bits, depths)) => return rasterize_watertight_into(scene, bits, depths, buffer),
    };
    let tiling = Tiling::new(&scene.camera, &scene.mesh, window, NEAREST_TILE_SIDE, simd, kernel);
    let ids = strips(window, NEAREST_TILE_SIDE, &mut buffer.ids);
    let work = ids.into_iter().zip(strips(window, NEAREST_TILE_SIDE, &mut buffer.t)).collect();
    for_each_strip(
        work,
        || Tile::new(false),
        |tile, (mut ids, mut t)| {
            for window in ids.tiles.clone() {
                tile.draw(&tiling, window);
                write::nearest(&tiling, tile, window, &mut ids, &mut t);
            }
        },
    );
}

/// The tiles' kernel, or the options of the watertight rasterizer, which has its own.
fn kernel(
    scene: &Scene,
    unproven: Unproven,
) -> Result<Kernel, (SubpixelBits, Option<DepthBuffer>)> {
    match unproven {
        Unproven::Double => Ok(Kernel::Double),
        Unproven::Fast { depth_buffer: None } => Ok(Kernel::Single),
        Unproven::Fast { depth_buffer: Some(buffer) } => {
            Ok(Kernel::Stored(buffer, scene.camera.z_per_t()))
        }
        Unproven::Watertight { subpixel_bits, depth_buffer } => Err((subpixel_bits, depth_buffer)),
    }
}
