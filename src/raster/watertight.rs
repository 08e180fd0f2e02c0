//! A rasterizer as graphics processors have it: vertices snapped to a fixed-point grid, integer
//! edge functions with the top-left rule, and an interpolated f32 depth.
//!
//! It exists to be compared with the exact answer. What it promises, and what it does not:
//!
//! * Triangles that share an edge (the same two vertices) cover every sample on or near it exactly
//!   once: both see the same snapped numbers, and from there coverage is exact.
//! * A vertex moves by at most 2^-(N+1) pixels along x and y (N sub-pixel bits) and the rounding of
//!   its f64 projection. So coverage can differ from the exact one only where the stability mask of
//!   that half width is not set.
//! * Depth is f32: [`DEPTH_ERROR`] relative to 1/t. Nearer by less, the wrong triangle may win;
//!   equal depths show the triangle drawn first, which is the lowest id. A [`DepthBuffer`] stores
//!   window depths of few bits instead.
//! * A triangle that reaches behind the near plane or beyond the guard band is clipped first
//!   (`clip`); of its clipped copies only the shared edges are promised to have no holes.
//!
//! Where a graphics processor's vertex stage works in f32, this one projects in f64: the mode shows
//! what *rasterizing* costs. Sources: the rasterization rules of Direct3D 11 (3.4.1) and Vulkan.
//! The exact path shares the camera's matrix with it, and nothing behind that.

mod clip;
mod depth_buffer;
mod projection;
mod snapped;
mod tile;

use super::TILE_SIDE;
use super::image_plane::ImagePlane;
use super::strips::{for_each_strip, strips};
use super::tile_lists::{Grid, TileLists};
use crate::pixel::{Window, for_each_tile};
use crate::scene::Scene;
use crate::visibility::{Counting, NearestBuffer, VisibilityBuffer};
pub use depth_buffer::{DepthBuffer, DepthFormat};
use projection::Projector;
use rayon::prelude::*;
use snapped::Piece;
use tile::DepthTest;

/// Largest relative error of an interpolated depth against 1/t in the snapped triangle: one
/// rounding to f32 (2^-24) each for the depth at a corner, the edge function, the doubled area, its
/// inverse, their product, the product with the depth, and two sums: 8, and 2 for what they make of
/// each other and for the f64 projection.
pub const DEPTH_ERROR: f64 = 10.0 * (f32::EPSILON / 2.0) as f64;

/// Bits below the pixel of the fixed-point grid on which vertices are placed: 0…12.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct SubpixelBits(u32);

impl SubpixelBits {
    /// Most bits: with the guard band they keep every edge function inside i64 (`snapped`).
    pub const MOST: u32 = 12;

    /// 8, which Direct3D demands and nearly all hardware has.
    pub const STANDARD: Self = Self(8);

    /// So many bits, or `None` for more than [`Self::MOST`].
    pub const fn new(bits: u32) -> Option<Self> {
        if bits <= Self::MOST { Some(Self(bits)) } else { None }
    }

    /// How many.
    pub const fn get(self) -> u32 {
        self.0
    }
}

impl Default for SubpixelBits {
    /// [`Self::STANDARD`].
    fn default() -> Self {
        Self::STANDARD
    }
}

/// What a graphics processor would show at every pixel of `window`, which must lie inside the
/// camera's frame.
///
/// Weights and t of the answer are the interpolated f32 numbers: `t_lo` and `t_hi` are equal and
/// certain of nothing, and the level is always [`crate::visibility::Level::Single`]. With a depth
/// buffer, other triangles at the same stored depth are a tie; without one ties are not noticed.
/// `done` is called once per finished tile of `window.tiles(TILE_SIDE)`, from any thread.
pub fn rasterize_watertight(
    scene: &Scene,
    window: Window,
    subpixel_bits: SubpixelBits,
    depth_buffer: Option<DepthBuffer>,
    counting: Counting,
    done: &(dyn Fn() + Sync),
) -> VisibilityBuffer {
    let plane = ImagePlane::new(&scene.camera);
    let snapped = Snapped::new(scene, &plane, window, subpixel_bits, depth_buffer);
    let tiles = for_each_tile(&window.tiles(TILE_SIDE), done, |tile| {
        tile::rasterize_tile(&snapped, counting, tile)
    });
    VisibilityBuffer::from_tiles(window, counting, tiles)
}

/// As [`rasterize_watertight`], ids and t alone, into a buffer of that size that there is already.
pub(super) fn rasterize_watertight_into(
    scene: &Scene,
    subpixel_bits: SubpixelBits,
    depth_buffer: Option<DepthBuffer>,
    buffer: &mut NearestBuffer,
) {
    let window = buffer.window;
    let plane = ImagePlane::new(&scene.camera);
    let snapped = Snapped::new(scene, &plane, window, subpixel_bits, depth_buffer);
    let ids = strips(window, TILE_SIDE, &mut buffer.ids);
    let work = ids.into_iter().zip(strips(window, TILE_SIDE, &mut buffer.t)).collect();
    for_each_strip(
        work,
        || (),
        |(), (mut ids, mut t)| {
            for window in ids.tiles.clone() {
                tile::write_nearest(&snapped, window, &mut ids, &mut t);
            }
        },
    );
}

/// A scene on the grid, sorted into tiles.
struct Snapped<'a> {
    projector: Projector<'a>,
    test: DepthTest,
    pieces: Vec<Piece>,
    lists: TileLists,
}

impl<'a> Snapped<'a> {
    /// Projects, clips and snaps in parallel; the pieces keep the order of ids.
    fn new(
        scene: &Scene,
        plane: &'a ImagePlane,
        window: Window,
        subpixel_bits: SubpixelBits,
        depth_buffer: Option<DepthBuffer>,
    ) -> Self {
        let projector = Projector::new(plane, &scene.mesh, subpixel_bits);
        let pieces: Vec<Piece> = scene
            .mesh
            .ids()
            .collect::<Vec<_>>()
            .par_iter()
            .with_min_len(1024)
            .flat_map_iter(|&id| snapped::pieces(&projector, id, scene.mesh.triangle(id)))
            .collect();
        let test = DepthTest { buffer: depth_buffer, z_per_t: scene.camera.z_per_t() };
        let grid = Grid::new(window, TILE_SIDE);
        let placed = pieces.iter().enumerate().filter_map(|(number, piece)| {
            let pixels = piece.pixels(subpixel_bits, window)?;
            Some((number as u32, grid.tiles_of(pixels)))
        });
        let lists = TileLists::new(grid, placed);
        Self { projector, test, pieces, lists }
    }
}
