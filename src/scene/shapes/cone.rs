//! A cone about the y axis that stands on y = 0.

use super::angle::heading;
use super::disc::{Facing, append_disc, ring_point};
use super::grid::{Edge, Grid};
use super::limits::{ShapeError, check_count, check_length, check_triangles};
use crate::scene::part::MeshPart;

pub(super) const NAME: &str = "cone";

/// Cone about the y axis from its base at y = 0 to its apex at y = `height`. The side's normals
/// stand square on its straight lines. The apex has no normal: each triangle that touches it takes
/// the one halfway between its two columns.
#[derive(Clone, Debug, PartialEq)]
pub struct Cone {
    /// Radius of the base in object units, 1e-18…1e18; default 1.
    pub radius: f64,
    /// Extent along y, in object units, 1e-18…1e18; default 2.
    pub height: f64,
    /// Columns of cells around the axis, at least 3; default 48.
    pub around: u32,
    /// Rows of cells from apex to base, at least 1; default 1.
    pub stacks: u32,
    /// Whether the base is closed by a disc; default true.
    pub caps: bool,
}

impl Default for Cone {
    fn default() -> Self {
        Self { radius: 1.0, height: 2.0, around: 48, stacks: 1, caps: true }
    }
}

impl Cone {
    pub(super) fn build(&self) -> Result<MeshPart, ShapeError> {
        let Self { radius, height, around, stacks, caps } = *self;
        check_length(NAME, "radius", radius)?;
        check_length(NAME, "height", height)?;
        check_count(NAME, "around", around, 3)?;
        check_count(NAME, "stacks", stacks, 1)?;
        let grid = Grid { top: Edge::Point, ..Grid::tube(stacks, around) };
        let of_caps = if caps { u128::from(around) } else { 0 };
        let counts = format!("{around} × {stacks}");
        check_triangles(NAME, "around × stacks", counts, grid.triangle_count() + of_caps)?;

        let mut part = MeshPart::default();
        let points = grid.fill_points(&mut part.positions, |row, column| {
            let below = f64::from(row) / f64::from(stacks);
            let above = f64::from(stacks - row) / f64::from(stacks);
            ring_point(column, around, below * radius, above * height)
        });
        grid.append_cells(&mut part, points);
        // Normals lie on the columns, at the apex between them.
        let slant = libm::hypot(radius, height);
        let [outwards, up] = [height / slant, radius / slant];
        let normal_at = |half_column| {
            let [x, z] = heading(half_column, 2 * around);
            [outwards * x, up, outwards * z]
        };
        let normals = grid.fill_per_column(&mut part.normals, |row, column| {
            normal_at(2 * column + u32::from(row == 0))
        });
        grid.append_triangles(&mut part.corner_normals, normals);
        let texture = grid.fill_texture_points(&mut part.uvs);
        grid.append_triangles(&mut part.corner_uvs, texture);
        if caps {
            append_disc(&mut part, Facing::Down, 0.0, radius, around);
        }
        Ok(part)
    }
}
