//! The rasterizer: which triangle is visible at each pixel, by homogeneous edge rows and a z-buffer.
//!
//! Every triangle becomes three edge rows and a plane row of its homogeneous image (Olano & Greer,
//! "Triangle scan conversion using 2D homogeneous coordinates", 1997). No vertex is divided by its
//! w, none is clipped, and there is no near plane, so triangles through the eye's plane need no
//! case of their own. f64 filters with proven bounds decide nearly all samples (`rows`); integers
//! of any size decide the rest (`exact`), by the tie rule: every sign is taken at the sample moved
//! by (+ε, +ε²). It works tile by tile, triangles in the order of ids, and no result depends on the
//! tiles or the threads.
//!
//! It does not shade, and it shares no predicate with the ray caster: only the scene, the camera's
//! numbers and the shape of the answer.

mod bins;
mod bounds;
mod dyadic;
mod exact;
mod exact_row;
mod image_plane;
mod layers;
mod resolve;
mod rows;
mod span;
mod stability;
mod tile;
mod tile_lists;
mod watertight;

use crate::pixel::{Window, for_each_tile};
use crate::scene::Scene;
use crate::visibility::{Counting, VisibilityBuffer};
use bins::Bins;
use bounds::Region;
use image_plane::ImagePlane;

pub use layers::rasterize_layers;
pub use stability::{STANDARD_HALF_WIDTH, stability, stability_in_tiles};
pub use watertight::{DEPTH_ERROR, DepthBuffer, DepthFormat, SubpixelBits, rasterize_watertight};

/// Side of a tile, in pixels: its z-buffer (1024 fragments of 32 bytes) fits a first-level cache.
pub const TILE_SIDE: u32 = 32;

/// What is visible at every pixel of `window`, which must lie inside the camera's frame.
///
/// `done` is called once per finished tile of `window.tiles(TILE_SIDE)`, from any thread.
pub fn rasterize(
    scene: &Scene,
    window: Window,
    counting: Counting,
    done: &(dyn Fn() + Sync),
) -> VisibilityBuffer {
    rasterize_in_tiles(scene, window, counting, TILE_SIDE, done)
}

/// [`rasterize`] with tiles of `side` × `side` pixels (at least 1). Only `levels` and the time
/// taken depend on it.
pub fn rasterize_in_tiles(
    scene: &Scene,
    window: Window,
    counting: Counting,
    side: u32,
    done: &(dyn Fn() + Sync),
) -> VisibilityBuffer {
    let plane = ImagePlane::new(&scene.camera);
    let bins = Bins::new(&plane, &scene.mesh, Region::samples(window), side);
    let tiles = for_each_tile(&window.tiles(side), done, |tile| {
        tile::rasterize_tile(&plane, &scene.mesh, &bins, counting, tile)
    });
    VisibilityBuffer::from_tiles(window, counting, tiles)
}

#[cfg(test)]
mod tests;
