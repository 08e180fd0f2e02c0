//! Triangles sorted into tiles, in the order of ids: set up once to be placed, and, if they are
//! small, once more in each tile that they meet, which costs less than keeping their rows.

use super::bounds::{Rectangle, Region, pixels_of};
use super::exact::ExactTriangle;
use super::image_plane::ImagePlane;
use super::rows::{Projection, TriangleRows};
use super::tile_lists::{Grid, Listed, TileLists, Tiles};
use crate::mesh::{TriangleId, TriangleMesh};
use crate::mutant::{self, Mutant};
use crate::pixel::Window;
use rayon::prelude::*;
use std::borrow::Cow;

/// Triangles set up per parallel step.
const CHUNK: u32 = 4096;

/// A triangle and the pixels that it can cover.
#[derive(Clone)]
pub(super) struct Candidate {
    pub(super) rows: TriangleRows,
    pub(super) pixels: Rectangle,
}

/// Sets a triangle up; `None` when it certainly covers nothing of the region (V = 0 included).
pub(super) fn set_up(
    plane: &ImagePlane,
    mesh: &TriangleMesh,
    region: Region,
    id: TriangleId,
) -> Option<Candidate> {
    let corners = mesh.triangle(id);
    let mut projection = Projection::new(plane, corners);
    if mutant::is(Mutant::MirrorGhost) && projection.is_behind(plane) {
        projection = Projection::new(plane, corners.map(|v| v.map(|c| -c)));
    }
    let pixels = pixels_of(plane, &projection, region)?;
    let rows = projection.rows(plane, id, || {
        let exact = ExactTriangle::new(plane, corners)?;
        Some((exact.volume_sign, exact.volume(plane)))
    })?;
    Some(Candidate { rows, pixels })
}

/// The triangles of one parallel step: where each goes, and those that meet many tiles.
type Placed = (Vec<(u32, Tiles)>, Vec<Candidate>);

/// Every tile's triangles.
pub(super) struct Bins<'a> {
    plane: &'a ImagePlane,
    mesh: &'a TriangleMesh,
    region: Region,
    lists: TileLists,
    /// Triangles that meet many tiles, ascending by id.
    large: Vec<Candidate>,
}

impl<'a> Bins<'a> {
    /// Sorts all triangles into the tiles of the region's window.
    pub(super) fn new(
        plane: &'a ImagePlane,
        mesh: &'a TriangleMesh,
        region: Region,
        side: u32,
    ) -> Self {
        let grid = Grid::new(region.window, side);
        let place = |index: u32| -> Option<(u32, Tiles, Option<Candidate>)> {
            let candidate = set_up(plane, mesh, region, TriangleId::new(index))?;
            let tiles = grid.tiles_of(candidate.pixels);
            Some((index, tiles, tiles.are_many().then_some(candidate)))
        };
        // Place every triangle in parallel; the lists keep the order of ids.
        let count = mesh.len() as u32;
        let mut placed: Vec<Placed> = (0..count.div_ceil(CHUNK))
            .into_par_iter()
            .map(|chunk| {
                let (mut tiles, mut large) = (Vec::new(), Vec::new());
                for index in chunk * CHUNK..count.min((chunk + 1).saturating_mul(CHUNK)) {
                    if let Some((index, met, candidate)) = place(index) {
                        tiles.push((index, met));
                        large.extend(candidate);
                    }
                }
                (tiles, large)
            })
            .collect();
        let large = placed.iter_mut().flat_map(|(_, large)| large.drain(..)).collect();
        let lists = TileLists::new(grid, placed.iter().flat_map(|(tiles, _)| tiles).copied());
        Self { plane, mesh, region, lists, large }
    }

    /// The triangles that may cover something in a tile, in the order of ids.
    pub(super) fn candidates(&self, tile: Window) -> impl Iterator<Item = Cow<'_, Candidate>> {
        self.lists.of(tile).filter_map(|listed| match listed {
            Listed::Small(index) => {
                set_up(self.plane, self.mesh, self.region, TriangleId::new(index)).map(Cow::Owned)
            }
            Listed::Large(_, position) => Some(Cow::Borrowed(&self.large[position])),
        })
    }
}
