//! A cylinder about the y axis that stands on y = 0.

use super::angle::heading;
use super::disc::{Facing, append_disc, ring_point};
use super::grid::Grid;
use super::limits::{ShapeError, check_count, check_length, check_triangles};
use crate::scene::part::MeshPart;

pub(super) const NAME: &str = "cylinder";

/// Cylinder about the y axis from y = 0 to y = `height`. The side is smooth, the rims are sharp.
#[derive(Clone, Debug, PartialEq)]
pub struct Cylinder {
    /// Radius in object units, 1e-18…1e18; default 1.
    pub radius: f64,
    /// Extent along y, in object units, 1e-18…1e18; default 2.
    pub height: f64,
    /// Columns of cells around the axis, at least 3; default 48.
    pub around: u32,
    /// Rows of cells along the axis, at least 1; default 1.
    pub stacks: u32,
    /// Whether both ends are closed by discs; default true.
    pub caps: bool,
}

impl Default for Cylinder {
    fn default() -> Self {
        Self { radius: 1.0, height: 2.0, around: 48, stacks: 1, caps: true }
    }
}

impl Cylinder {
    pub(super) fn build(&self) -> Result<MeshPart, ShapeError> {
        let Self { radius, height, around, stacks, caps } = *self;
        check_length(NAME, "radius", radius)?;
        check_length(NAME, "height", height)?;
        check_count(NAME, "around", around, 3)?;
        check_count(NAME, "stacks", stacks, 1)?;
        let grid = Grid::tube(stacks, around);
        let of_caps = if caps { 2 * u128::from(around) } else { 0 };
        let counts = format!("{around} × {stacks}");
        check_triangles(NAME, "around × stacks", counts, grid.triangle_count() + of_caps)?;

        let mut part = MeshPart::default();
        let points = grid.fill_points(&mut part.positions, |row, column| {
            let y = f64::from(stacks - row) / f64::from(stacks) * height;
            ring_point(column, around, radius, y)
        });
        grid.append_cells(&mut part, points);
        // One normal per column serves all rows.
        let columns = Grid { rows_close: true, ..Grid::tube(1, around) };
        let normals = columns.fill_points(&mut part.normals, |_, column| {
            let [x, z] = heading(column, around);
            [x, 0.0, z]
        });
        grid.append_triangles(&mut part.corner_normals, normals);
        let texture = grid.fill_texture_points(&mut part.uvs);
        grid.append_triangles(&mut part.corner_uvs, texture);
        if caps {
            append_disc(&mut part, Facing::Up, height, radius, around);
            append_disc(&mut part, Facing::Down, 0.0, radius, around);
        }
        Ok(part)
    }
}
