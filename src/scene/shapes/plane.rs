//! A rectangle in the xz plane.

use super::angle::centred;
use super::grid::{Grid, Numbering};
use super::limits::{ShapeError, check_count, check_length, check_triangles};
use crate::scene::part::MeshPart;

pub(super) const NAME: &str = "plane";

/// Rectangle in the plane y = 0 about the origin, normal +y. Texture coordinate s grows with x,
/// t with −z: seen from above with +x to the right, the origin is bottom left.
#[derive(Clone, Debug, PartialEq)]
pub struct Plane {
    /// Extent along x, in object units, 1e-18…1e18; default 2.
    pub width: f64,
    /// Extent along z, in object units, 1e-18…1e18; default 2.
    pub depth: f64,
    /// Cells along x, at least 1; default 1.
    pub columns: u32,
    /// Cells along z, at least 1; default 1.
    pub rows: u32,
}

impl Default for Plane {
    fn default() -> Self {
        Self { width: 2.0, depth: 2.0, columns: 1, rows: 1 }
    }
}

impl Plane {
    pub(super) fn build(&self) -> Result<MeshPart, ShapeError> {
        check_length(NAME, "width", self.width)?;
        check_length(NAME, "depth", self.depth)?;
        check_count(NAME, "columns", self.columns, 1)?;
        check_count(NAME, "rows", self.rows, 1)?;
        let counts = format!("{} × {}", self.columns, self.rows);
        let triangles = 2 * u128::from(self.columns) * u128::from(self.rows);
        check_triangles(NAME, "columns × rows", counts, triangles)?;

        let grid = Grid::open(self.rows, self.columns);
        let mut part = MeshPart { normals: vec![[0.0, 1.0, 0.0]], ..MeshPart::default() };
        let points = grid.fill_points(&mut part.positions, |row, column| {
            let x = centred(column, self.columns, self.width);
            [x, 0.0, centred(row, self.rows, self.depth)]
        });
        grid.append_cells(&mut part, points);
        grid.append_triangles(&mut part.corner_normals, Numbering::constant(0));
        let texture = grid.fill_texture_points(&mut part.uvs);
        grid.append_triangles(&mut part.corner_uvs, texture);
        Ok(part)
    }
}
