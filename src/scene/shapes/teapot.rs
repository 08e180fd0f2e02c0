//! The Utah teapot: its patches put together into body, lid, handle and spout.
//!
//! The parts pass through each other as Newell made them; their intersections are not cut.

use super::bezier::{self, Patch};
use super::grid::{Edge, Grid};
use super::limits::{ShapeError, check_count, check_triangles};
use super::teapot_patches::{BODY, BOTTOM, HANDLE, LID, Loop, Ring, SPOUT};
use crate::scene::part::MeshPart;

pub(super) const NAME: &str = "teapot";

/// The Utah teapot in the size of its data: standing on y = 0, y up, axis of the body at the
/// origin, 3.15 high, spout towards +x (to x = 3.43), handle towards −x (to x = −3). These are the
/// usual proportions; `scale = [1, 1.3, 1]` gives Newell's original, taller one.
///
/// The parts are four surfaces that pass through each other, not one closed surface: edges of
/// handle and spout end inside the body, and between lid and rim is a gap of 0.1. Every patch has
/// the whole texture square, s to the right and t up as seen from outside (along handle and spout,
/// t runs from the end back to the start).
#[derive(Clone, Debug, PartialEq)]
pub struct Teapot {
    /// Cells along each edge of a patch, 2…790: 64 · segments² − 8 · segments triangles in all;
    /// default 10. Below 6, some normals at the spout's lip lie behind their coarse triangles.
    pub segments: u32,
    /// Whether the lid is there; default true.
    pub lid: bool,
    /// Whether the bottom is there, which closes the body from below; default true.
    pub bottom: bool,
}

impl Default for Teapot {
    fn default() -> Self {
        Self { segments: 10, lid: true, bottom: true }
    }
}

/// A part of the teapot: bands of patches, each band closed around.
pub(super) struct Surface {
    /// Patches, `[band from above][patch to the right]`; bands have the same number of patches.
    pub(super) bands: Vec<Vec<Patch>>,
    top: Edge,
    bottom: Edge,
}

impl Teapot {
    pub(super) fn build(&self) -> Result<MeshPart, ShapeError> {
        check_count(NAME, "segments", self.segments, 2)?;
        let surfaces = self.surfaces();
        let triangles = surfaces.iter().map(|s| s.grid(self.segments).triangle_count()).sum();
        check_triangles(NAME, "segments", self.segments, triangles)?;
        let mut part = MeshPart::default();
        for surface in &surfaces {
            surface.append(&mut part, self.segments);
        }
        Ok(part)
    }

    /// The parts that are there: body, lid, handle, spout.
    pub(super) fn surfaces(&self) -> Vec<Surface> {
        let mut body: Vec<[Ring; 4]> = BODY.to_vec();
        if self.bottom {
            body.push(BOTTOM);
        }
        let end = if self.bottom { Edge::Point } else { Edge::Row };
        let mut surfaces = vec![Surface::revolved(&body, Edge::Row, end)];
        if self.lid {
            surfaces.push(Surface::revolved(&LID, Edge::Point, Edge::Row));
        }
        surfaces.push(Surface::tube(&HANDLE));
        surfaces.push(Surface::tube(&SPOUT));
        surfaces
    }
}

impl Surface {
    fn revolved(bands: &[[Ring; 4]], top: Edge, bottom: Edge) -> Self {
        let patches = |rings: &[Ring; 4]| {
            let first: Patch =
                rings.map(|[r, k, z]| [[r, 0., z], [r, k, z], [k, r, z], [0., r, z]]);
            let second = first.map(|row| row.map(|[x, y, z]| [-y, x, z]));
            let opposite = |patch: Patch| patch.map(|row| row.map(|[x, y, z]| [-x, -y, z]));
            [first, second, opposite(first), opposite(second)].map(upright).to_vec()
        };
        Self { bands: bands.iter().map(patches).collect(), top, bottom }
    }

    fn tube(bands: &[[Loop; 4]]) -> Self {
        let patches = |loops: &[Loop; 4]| {
            let first: Patch =
                loops.map(|[x, z, x2, z2, w]| [[x, 0., z], [x, w, z], [x2, w, z2], [x2, 0., z2]]);
            let second = first.map(|[a, b, c, d]| [d, c, b, a].map(|[x, y, z]| [x, -y, z]));
            [first, second].map(upright).to_vec()
        };
        let (top, bottom) = (Edge::Row, Edge::Row);
        Self { bands: bands.iter().map(patches).collect(), top, bottom }
    }

    /// The cells at `segments` per patch edge.
    fn grid(&self, segments: u32) -> Grid {
        // No part has more than 4 × 4 patches; saturation only meets counts that are refused.
        let rows = segments.saturating_mul(self.bands.len() as u32);
        let columns = segments.saturating_mul(self.bands[0].len() as u32);
        Grid { top: self.top, bottom: self.bottom, ..Grid::tube(rows, columns) }
    }

    /// Appends the triangles at `segments` per patch edge.
    pub(super) fn append(&self, part: &mut MeshPart, segments: u32) {
        let grid = self.grid(segments);
        let at = |row: u32, column: u32| {
            let band = ((row / segments) as usize).min(self.bands.len() - 1);
            let u = f64::from(row - band as u32 * segments) / f64::from(segments);
            let v = f64::from(column % segments) / f64::from(segments);
            (&self.bands[band][(column / segments) as usize], u, v)
        };
        let points = grid.fill_points(&mut part.positions, |row, column| {
            let (patch, u, v) = at(row, column);
            bezier::point(patch, u, v)
        });
        grid.append_cells(part, points);
        let normals = grid.fill_points(&mut part.normals, |row, column| {
            let (patch, u, v) = at(row, column);
            bezier::normal(patch, u, v)
        });
        grid.append_triangles(&mut part.corner_normals, normals);
        append_texture(part, &grid, segments);
    }
}

/// Gives every patch of a grid the whole texture square, with one set of points for all patches.
fn append_texture(part: &mut MeshPart, grid: &Grid, segments: u32) {
    let square = Grid::open(segments, segments);
    let first = part.uvs.len() as u32;
    square.fill_texture_points(&mut part.uvs);
    grid.append_triangles_by_place(&mut part.corner_uvs, |[row, column], [down, right]| {
        first + (row % segments + down) * (segments + 1) + column % segments + right
    });
}

/// A patch turned from z up to y up.
fn upright(patch: Patch) -> Patch {
    patch.map(|row| row.map(|[x, y, z]| [x, z, -y]))
}
