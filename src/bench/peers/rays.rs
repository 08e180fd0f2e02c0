//! The rays of a window as peers want them, and the loop over tiles that hands them out.

use super::Hits;
use crate::pixel::{Pixel, Window, for_each_tile};
use crate::scene::camera::PinholeCamera;
use std::sync::Arc;

/// Side of a tile, in pixels: that of both our paths.
const TILE_SIDE: u32 = 32;

/// One ray per pixel.
pub(super) struct Rays {
    window: Window,
    /// The eye, rounded to f32.
    pub(super) origin: [f32; 3],
    /// Unit vectors, row by row.
    directions: Vec<[f32; 3]>,
}

impl Rays {
    /// Through the centres of the pixels of `window`.
    pub(super) fn new(camera: &PinholeCamera, window: Window) -> Self {
        let (d0, dx, dy) = (camera.d0(), camera.dx(), camera.dy());
        let direction = |[x, y]: [f64; 2]| {
            let d: [f64; 3] = std::array::from_fn(|k| d0[k] + x * dx[k] + y * dy[k]);
            // Lattice vectors reach 2^±300: divided by the largest component first.
            let largest = d.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
            let d = d.map(|c| c / largest);
            let length = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt();
            d.map(|c| (c / length) as f32)
        };
        let directions = window.pixels().map(|pixel| direction(pixel.sample())).collect();
        Self { window, origin: camera.eye().map(|c| c as f32), directions }
    }

    /// Where their answers go.
    pub(super) fn hits(&self) -> Arc<Hits> {
        Arc::new(Hits::new(self.window))
    }

    /// Number of rays.
    pub(super) fn len(&self) -> usize {
        self.directions.len()
    }

    /// Hands out tiles to all threads.
    pub(super) fn for_each_tile(&self, work: impl Fn(Window) + Sync) {
        for_each_tile(&self.window.tiles(TILE_SIDE), &|| (), work);
    }

    /// Row-major position and direction of a pixel's ray.
    #[inline(always)]
    pub(super) fn at(&self, pixel: Pixel) -> (usize, [f32; 3]) {
        let index = self.window.index(pixel);
        (index, self.directions[index])
    }

    /// Casts every ray on its own: `closest` says which triangle a direction meets first, and at
    /// which t.
    #[cfg(feature = "peers")]
    #[inline(always)]
    pub(super) fn cast_each(
        &self,
        hits: &Hits,
        closest: impl Fn([f32; 3]) -> Option<(u32, f32)> + Sync,
    ) {
        self.for_each_tile(|tile| {
            for pixel in tile.pixels() {
                let (index, direction) = self.at(pixel);
                let (id, t) = closest(direction).unwrap_or((Hits::NOTHING, f32::INFINITY));
                hits.store(index, id, t);
            }
        });
    }
}
