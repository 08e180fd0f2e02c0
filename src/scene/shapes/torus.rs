//! A ring torus about the y axis.

use super::angle::{heading, turn};
use super::grid::Grid;
use super::limits::{ShapeError, check_count, check_length, check_triangles};
use crate::scene::part::MeshPart;

pub(super) const NAME: &str = "torus";

/// Least of `minor / major`, and of 1 − `minor / major`. At 1e-6, rounding `major + minor · cos`
/// moves a vertex by at most 1.2e-10 of `minor`, and the hole stays open.
const RATIO_MARGIN: f64 = 1e-6;

/// Torus about the origin whose axis is y. Texture coordinate s goes around the axis, t across the
/// tube; both seams meet at +x on the outer equator.
#[derive(Clone, Debug, PartialEq)]
pub struct Torus {
    /// Distance of the tube's centre line from the axis, in object units, 1e-18…1e18; default 1.
    pub major: f64,
    /// Radius of the tube, in object units: 0.000001…0.999999 of `major` and at least 1e-18;
    /// default 0.35.
    pub minor: f64,
    /// Columns of cells around the axis, at least 3; default 96.
    pub around: u32,
    /// Rows of cells across the tube, at least 3; default 64.
    pub across: u32,
}

impl Default for Torus {
    fn default() -> Self {
        Self { major: 1.0, minor: 0.35, around: 96, across: 64 }
    }
}

impl Torus {
    pub(super) fn build(&self) -> Result<MeshPart, ShapeError> {
        self.check()?;
        let grid = Grid { rows_close: true, ..Grid::tube(self.across, self.around) };
        let counts = format!("{} × {}", self.around, self.across);
        check_triangles(NAME, "around × across", counts, grid.triangle_count())?;

        let mut part = MeshPart::default();
        let points = grid.fill_points(&mut part.positions, |row, column| {
            // Rows run downwards on the outer side: the tube's angle falls.
            let [outwards, down] = turn(row, self.across);
            let [x, z] = heading(column, self.around);
            let distance = self.major + self.minor * outwards;
            [distance * x, 0.0 - self.minor * down, distance * z]
        });
        grid.append_cells(&mut part, points);
        grid.fill_points(&mut part.normals, |row, column| {
            let [outwards, down] = turn(row, self.across);
            let [x, z] = heading(column, self.around);
            [outwards * x, 0.0 - down, outwards * z]
        });
        part.corner_normals = part.corners.clone();
        let texture = grid.fill_texture_points(&mut part.uvs);
        grid.append_triangles(&mut part.corner_uvs, texture);
        Ok(part)
    }

    fn check(&self) -> Result<(), ShapeError> {
        check_length(NAME, "major", self.major)?;
        check_length(NAME, "minor", self.minor)?;
        let (least, most) = (RATIO_MARGIN * self.major, (1.0 - RATIO_MARGIN) * self.major);
        if !(least..=most).contains(&self.minor) {
            return Err(ShapeError {
                shape: NAME,
                parameter: "minor",
                value: self.minor.to_string(),
                range: format!("from {least:e} to {most:e} where major is {}", self.major),
            });
        }
        check_count(NAME, "around", self.around, 3)?;
        check_count(NAME, "across", self.across, 3)
    }
}
