//! A box about the origin, its faces aligned with the axes.

use super::angle::centred;
use super::grid::{Grid, Numbering};
use super::limits::{ShapeError, check_count, check_length, check_triangles};
use crate::scene::part::MeshPart;

pub(super) const NAME: &str = "box";

/// Box about the origin. Each face has its own normal and its own texture square, so edges are
/// sharp; positions on edges are the same bits in both faces.
#[derive(Clone, Debug, PartialEq)]
pub struct Cuboid {
    /// Extents along x, y, z, in object units, each 1e-18…1e18; default 2, 2, 2.
    pub size: [f64; 3],
    /// Cells along every edge, at least 1; default 1.
    pub segments: u32,
}

impl Default for Cuboid {
    fn default() -> Self {
        Self { size: [2.0; 3], segments: 1 }
    }
}

/// A face: the axis and sign of its normal, and of "right" and "down" as seen from outside with
/// +y up (top and bottom: −z up and +z up). Right × (−down) is the normal.
struct Face {
    normal: (usize, f64),
    right: (usize, f64),
    down: (usize, f64),
}

/// In the order +x, −x, +y, −y, +z, −z.
const FACES: [Face; 6] = [
    Face { normal: (0, 1.0), right: (2, -1.0), down: (1, -1.0) },
    Face { normal: (0, -1.0), right: (2, 1.0), down: (1, -1.0) },
    Face { normal: (1, 1.0), right: (0, 1.0), down: (2, 1.0) },
    Face { normal: (1, -1.0), right: (0, 1.0), down: (2, -1.0) },
    Face { normal: (2, 1.0), right: (0, 1.0), down: (1, -1.0) },
    Face { normal: (2, -1.0), right: (0, -1.0), down: (1, -1.0) },
];

impl Cuboid {
    pub(super) fn build(&self) -> Result<MeshPart, ShapeError> {
        for (parameter, length) in ["size x", "size y", "size z"].into_iter().zip(self.size) {
            check_length(NAME, parameter, length)?;
        }
        check_count(NAME, "segments", self.segments, 1)?;
        let triangles = 12 * u128::from(self.segments) * u128::from(self.segments);
        check_triangles(NAME, "segments", self.segments, triangles)?;

        let grid = Grid::open(self.segments, self.segments);
        let mut part = MeshPart::default();
        let texture = grid.fill_texture_points(&mut part.uvs);
        for (number, face) in FACES.iter().enumerate() {
            let points = grid
                .fill_points(&mut part.positions, |row, column| self.position(face, row, column));
            grid.append_cells(&mut part, points);
            grid.append_triangles(&mut part.corner_normals, Numbering::constant(number as u32));
            grid.append_triangles(&mut part.corner_uvs, texture);
            let mut normal = [0.0; 3];
            normal[face.normal.0] = face.normal.1;
            part.normals.push(normal);
        }
        Ok(part)
    }

    /// A vertex of a face. Mirrored coordinates have the same digits, so both faces at an edge
    /// find the same bits; adding 0 makes every zero positive.
    fn position(&self, face: &Face, row: u32, column: u32) -> [f64; 3] {
        let mut position = [0.0; 3];
        let Face { normal, right, down } = face;
        position[normal.0] = normal.1 * 0.5 * self.size[normal.0];
        for ((axis, sign), index) in [(*right, column), (*down, row)] {
            position[axis] = sign * centred(index, self.segments, self.size[axis]) + 0.0;
        }
        position
    }
}
