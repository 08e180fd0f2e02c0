//! A sphere of latitude rings, its poles on the y axis.

use super::angle::{heading, turn};
use super::grid::{Edge, Grid};
use super::limits::{ShapeError, check_count, check_length, check_triangles};
use crate::scene::part::MeshPart;

pub(super) const NAME: &str = "uv_sphere";

/// Sphere about the origin, poles on the y axis. All vertices lie on the sphere; texture
/// coordinates are longitude (seam at +x, growing counter-clockwise seen from above) and latitude.
#[derive(Clone, Debug, PartialEq)]
pub struct UvSphere {
    /// Radius in object units, 1e-18…1e18; default 1.
    pub radius: f64,
    /// Columns of triangles around the axis, at least 3; default 48.
    pub around: u32,
    /// Rows of triangles from pole to pole, at least 2; default 24. An even number puts vertices
    /// on the equator.
    pub rings: u32,
}

impl Default for UvSphere {
    fn default() -> Self {
        Self { radius: 1.0, around: 48, rings: 24 }
    }
}

impl UvSphere {
    pub(super) fn build(&self) -> Result<MeshPart, ShapeError> {
        check_length(NAME, "radius", self.radius)?;
        check_count(NAME, "around", self.around, 3)?;
        check_count(NAME, "rings", self.rings, 2)?;
        let (top, bottom) = (Edge::Point, Edge::Point);
        let grid = Grid { top, bottom, ..Grid::tube(self.rings, self.around) };
        let counts = format!("{} × {}", self.around, self.rings);
        check_triangles(NAME, "around × rings", counts, grid.triangle_count())?;

        let mut part = MeshPart::default();
        let points = grid.fill_points(&mut part.normals, |ring, column| self.normal(ring, column));
        part.positions = part.normals.iter().map(|n| n.map(|c| c * self.radius)).collect();
        grid.append_cells(&mut part, points);
        part.corner_normals = part.corners.clone();
        let texture = grid.fill_texture_points(&mut part.uvs);
        grid.append_triangles(&mut part.corner_uvs, texture);
        Ok(part)
    }

    /// The unit vector of a vertex. Colatitude is `ring` of twice `rings` of a turn.
    fn normal(&self, ring: u32, column: u32) -> [f64; 3] {
        let [height, distance] = turn(ring, 2 * self.rings);
        let [x, z] = heading(column, self.around);
        [distance * x, height, distance * z]
    }
}
