//! Triangles sorted into tiles, in the order of ids.
//!
//! A counting sort: linear in triangles and (triangle, tile) pairs. Triangles that meet many tiles
//! are not copied into each of them: every tile looks at their common list, which takes no more
//! time and keeps memory below a fixed number of bytes per triangle.

use super::bounds::{Rectangle, pixels_of};
use super::exact::ExactTriangle;
use super::image_plane::ImagePlane;
use super::rows::{Projection, TriangleRows};
use crate::mesh::{TriangleId, TriangleMesh};
use crate::mutant::{self, Mutant};
use crate::pixel::Window;
use rayon::prelude::*;

/// A triangle that meets more tiles than this goes to the common list: a bin entry takes 4 bytes,
/// so that bins take at most 256 bytes per triangle.
const MOST_TILES: u64 = 64;

/// Triangles set up per parallel step.
const CHUNK: u32 = 4096;

/// A triangle and the pixels that it can cover.
#[derive(Clone)]
pub(super) struct Candidate {
    pub(super) rows: TriangleRows,
    pub(super) pixels: Rectangle,
}

/// Sets a triangle up; `None` when it certainly covers no pixel of the window (V = 0 included).
pub(super) fn set_up(
    plane: &ImagePlane,
    mesh: &TriangleMesh,
    window: Window,
    id: TriangleId,
) -> Option<Candidate> {
    let corners = mesh.triangle(id);
    let mut projection = Projection::new(plane, corners);
    if mutant::is(Mutant::MirrorGhost) && projection.is_behind(plane) {
        projection = Projection::new(plane, corners.map(|v| v.map(|c| -c)));
    }
    let pixels = pixels_of(plane, &projection, window)?;
    let rows = projection.rows(plane, id, || {
        let exact = ExactTriangle::new(plane, corners)?;
        Some((exact.volume_sign, exact.volume(plane)))
    })?;
    Some(Candidate { rows, pixels })
}

/// The tiles of a window, as `Window::tiles` cuts it: aligned to multiples of the side.
#[derive(Clone, Copy)]
struct Grid {
    side: u32,
    first_column: u32,
    first_row: u32,
    columns: u32,
    rows: u32,
}

impl Grid {
    fn new(window: Window, side: u32) -> Self {
        let (first_column, first_row) = (window.x0() / side, window.y0() / side);
        Self {
            side,
            first_column,
            first_row,
            columns: window.x1().div_ceil(side) - first_column,
            rows: window.y1().div_ceil(side) - first_row,
        }
    }

    fn index(self, tile: Window) -> usize {
        let column = tile.x0() / self.side - self.first_column;
        let row = tile.y0() / self.side - self.first_row;
        row as usize * self.columns as usize + column as usize
    }

    /// The rectangle of tiles that a rectangle of pixels meets, counted from the window's first.
    fn tiles_of(self, pixels: Rectangle) -> Rectangle {
        let more = u32::from(!mutant::is(Mutant::ShortBins));
        Rectangle {
            x0: pixels.x0 / self.side - self.first_column,
            y0: pixels.y0 / self.side - self.first_row,
            x1: (pixels.x1 - 1) / self.side + more - self.first_column,
            y1: (pixels.y1 - 1) / self.side + 1 - self.first_row,
        }
    }

    fn indices(self, tiles: Rectangle) -> impl Iterator<Item = usize> {
        (tiles.y0..tiles.y1).flat_map(move |row| {
            let first = row as usize * self.columns as usize;
            (tiles.x0..tiles.x1).map(move |column| first + column as usize)
        })
    }
}

/// Every tile's triangles.
pub(super) struct Bins {
    grid: Grid,
    /// Ids of tile i, ascending: `ids[starts[i]..starts[i + 1]]`.
    starts: Vec<usize>,
    ids: Vec<TriangleId>,
    /// Triangles that meet many tiles, ascending by id.
    large: Vec<Candidate>,
}

/// Where a triangle goes.
enum Place {
    Tiles(TriangleId, Rectangle),
    Everywhere(Box<Candidate>),
}

impl Bins {
    /// Sorts all triangles into the window's tiles.
    pub(super) fn new(plane: &ImagePlane, mesh: &TriangleMesh, window: Window, side: u32) -> Self {
        let grid = Grid::new(window, side);
        // Place every triangle in parallel; the lists keep the order of ids.
        let count = mesh.len() as u32;
        let placed: Vec<Vec<Place>> = (0..count.div_ceil(CHUNK))
            .into_par_iter()
            .map(|chunk| {
                let ids = chunk * CHUNK..count.min((chunk + 1).saturating_mul(CHUNK));
                ids.filter_map(|index| place(plane, mesh, window, grid, TriangleId::new(index)))
                    .collect()
            })
            .collect();
        // Count the triangles of each tile, one slot late, and turn counts into starts.
        let mut starts = vec![0_usize; grid.columns as usize * grid.rows as usize + 1];
        for place in placed.iter().flatten() {
            if let Place::Tiles(_, tiles) = place {
                grid.indices(*tiles).for_each(|tile| starts[tile + 1] += 1);
            }
        }
        for tile in 1..starts.len() {
            starts[tile] += starts[tile - 1];
        }
        // Put each id into its tiles' next free places, in the order of ids.
        let mut next = starts.clone();
        let mut ids = vec![TriangleId::new(0); starts.last().copied().unwrap_or(0)];
        let mut large = Vec::new();
        for place in placed.into_iter().flatten() {
            match place {
                Place::Tiles(id, tiles) => grid.indices(tiles).for_each(|tile| {
                    ids[next[tile]] = id;
                    next[tile] += 1;
                }),
                Place::Everywhere(candidate) => large.push(*candidate),
            }
        }
        Self { grid, starts, ids, large }
    }

    /// The triangles of a tile: ids of the small ones, and all large ones; both ascending.
    pub(super) fn of(&self, tile: Window) -> (&[TriangleId], &[Candidate]) {
        let index = self.grid.index(tile);
        (&self.ids[self.starts[index]..self.starts[index + 1]], &self.large)
    }
}

fn place(
    plane: &ImagePlane,
    mesh: &TriangleMesh,
    window: Window,
    grid: Grid,
    id: TriangleId,
) -> Option<Place> {
    let candidate = set_up(plane, mesh, window, id)?;
    let tiles = grid.tiles_of(candidate.pixels);
    let count = u64::from(tiles.x1 - tiles.x0) * u64::from(tiles.y1 - tiles.y0);
    Some(if count > MOST_TILES {
        Place::Everywhere(Box::new(candidate))
    } else {
        Place::Tiles(id, tiles)
    })
}
