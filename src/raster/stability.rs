//! The stability mask: at which pixels is the answer the same for every sample in a box around
//! the pixel's centre?
//!
//! It tells where another renderer, which moves samples or vertices by a fraction of a pixel, must
//! give the same id, and where it may differ. A pixel is stable only if that is certain: rows are
//! linear in (x, y), so over the closed box [x ± h, y ± h] an edge function changes by at most
//! h·(|A| + |B|), and a comparison of depths is extreme at a corner. With f64 rows and bounds over
//! the whole box (`boxed_rows`):
//!
//! * the visible triangle is certainly positive in all edges: it covers the whole box;
//! * every other triangle is certainly negative in one edge: it covers nothing of the box; or it
//!   lies certainly behind the visible one at all four corners; or it lies in exactly the same
//!   plane and has the higher id;
//! * where nothing is visible, every triangle is certainly negative in one edge.
//!
//! All these are strict inequalities, so the tie rule's infinitely small move changes none.
//! **Vertices that move** by at most h along x and y, instead of the sample, change no more than
//! that: every point of a moved triangle's outline stays within h of the same point of the
//! outline before, so an outline that does not touch the box cannot pass over the sample on its
//! way. (Depths are then compared at different points of the box, which the mask does not cover.)
//!
//! Nothing is decided exactly here but "the same plane?": what f64 leaves open is not stable.

mod boxed_rows;

use super::TILE_SIDE;
use super::bins::{Bins, Candidate, set_up};
use super::bounds::{Rectangle, Region};
use super::exact::ExactStage;
use super::image_plane::ImagePlane;
use super::rows::TriangleRows;
use super::span::{range_over, span};
use crate::mesh::TriangleId;
use crate::pixel::{MAX_SIDE, Pixel, Window, for_each_tile};
use crate::scene::Scene;
use crate::visibility::VisibilityBuffer;
use boxed_rows::{boxed, covers_all, covers_nothing, is_behind};
use std::cmp::Ordering;
use std::collections::HashMap;
use std::rc::Rc;

/// Half width of the box that pictures tell about, in pixels: the step of the sub-pixel grid on
/// which graphics processors place vertices, and twice what rounding to it moves one.
pub const STANDARD_HALF_WIDTH: f64 = 1.0 / 256.0;

/// Per pixel of the buffer, row by row: whether what the buffer holds there is certainly the
/// answer at every point of the closed box of half width `half_width_pixels` around the centre.
///
/// A half width that is negative, not a number or above 65 536 makes nothing certain. `done` is
/// called once per finished tile of `buffer.window.tiles(TILE_SIDE)`, from any thread.
pub fn stability(
    scene: &Scene,
    buffer: &VisibilityBuffer,
    half_width_pixels: f64,
    done: &(dyn Fn() + Sync),
) -> Vec<bool> {
    stability_in_tiles(scene, buffer, half_width_pixels, TILE_SIDE, done)
}

/// [`stability`] with tiles of `side` × `side` pixels (at least 1), on which only the time depends.
pub fn stability_in_tiles(
    scene: &Scene,
    buffer: &VisibilityBuffer,
    half_width_pixels: f64,
    side: u32,
    done: &(dyn Fn() + Sync),
) -> Vec<bool> {
    let window = buffer.window;
    if !(0.0..=f64::from(MAX_SIDE)).contains(&half_width_pixels) {
        return vec![false; window.len()];
    }
    let plane = ImagePlane::new(&scene.camera);
    let region = Region::boxes(window, half_width_pixels);
    let bins = Bins::new(&plane, &scene.mesh, region, side);
    let tiles = window.tiles(side);
    let parts = for_each_tile(&tiles, done, |tile| {
        let mut exact = ExactStage::new(&plane, &scene.mesh);
        let winners = Winners::new(tile, buffer, |id| {
            let candidate = set_up(&plane, &scene.mesh, region, id)?;
            Some(boxed(&candidate.rows, half_width_pixels))
        });
        winners.stable(&bins, &mut exact, half_width_pixels)
    });
    // Put the tiles' rows together.
    let mut stable = vec![false; window.len()];
    for (tile, part) in tiles.iter().zip(&parts) {
        for (row, part) in (tile.y0()..tile.y1()).zip(part.chunks_exact(tile.width() as usize)) {
            let first = window.index(Pixel { x: tile.x0(), y: row });
            stable[first..first + part.len()].copy_from_slice(part);
        }
    }
    stable
}

/// What is visible in a tile, with the rows of the visible triangles widened to boxes.
struct Winners {
    tile: Window,
    rows: Vec<Option<Rc<TriangleRows>>>,
    stable: Vec<bool>,
}

impl Winners {
    /// Reads a tile of the buffer; its triangles must cover the whole box.
    fn new(
        tile: Window,
        buffer: &VisibilityBuffer,
        rows_of: impl Fn(TriangleId) -> Option<TriangleRows>,
    ) -> Self {
        let mut known: HashMap<TriangleId, Option<Rc<TriangleRows>>> = HashMap::new();
        let (mut rows, mut stable) = (Vec::new(), Vec::new());
        for pixel in tile.pixels() {
            let visible = buffer.at(pixel).map(|visible| visible.triangle);
            let winner = visible
                .and_then(|id| known.entry(id).or_insert_with(|| rows_of(id).map(Rc::new)).clone());
            let holds = match &winner {
                Some(winner) => covers_all(winner, pixel),
                None => visible.is_none(),
            };
            rows.push(winner);
            stable.push(holds);
        }
        Self { tile, rows, stable }
    }

    /// Holds every triangle against every box that it may meet.
    fn stable(mut self, bins: &Bins<'_>, exact: &mut ExactStage<'_>, half_width: f64) -> Vec<bool> {
        for candidate in bins.candidates(self.tile) {
            self.hold_against(&candidate, exact, half_width);
        }
        self.stable
    }

    fn hold_against(&mut self, candidate: &Candidate, exact: &mut ExactStage<'_>, half_width: f64) {
        let Some(pixels) = candidate.pixels.intersection(Rectangle::of(self.tile)) else {
            return;
        };
        let other = boxed(&candidate.rows, half_width);
        if other.edges.iter().any(|edge| range_over(edge, pixels)[1] < -edge.bound) {
            return;
        }
        for y in pixels.y0..pixels.y1 {
            let (x0, x1) = span(&other, [true; 3], pixels, f64::from(y) + 0.5);
            for x in x0..x1 {
                let pixel = Pixel { x, y };
                let index = self.tile.index(pixel);
                if !self.stable[index] || covers_nothing(&other, pixel) {
                    continue;
                }
                self.stable[index] = self.rows[index].as_ref().is_some_and(|winner| {
                    winner.id == other.id
                        || is_behind(&other, winner, pixel, half_width)
                        || yields_in_the_same_plane(exact, other.id, winner.id, pixel)
                });
            }
        }
    }
}

/// Whether the other triangle has the winner's plane and the higher id. The stage keeps the answer
/// for a pair while the other triangle is held against its tile.
fn yields_in_the_same_plane(
    exact: &mut ExactStage<'_>,
    other: TriangleId,
    winner: TriangleId,
    pixel: Pixel,
) -> bool {
    winner < other
        && exact
            .depth_order(other, winner, pixel)
            .is_some_and(|order| order.moved == Ordering::Equal)
}
