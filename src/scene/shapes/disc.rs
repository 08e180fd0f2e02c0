//! The flat caps of cylinder and cone: a fan about the axis.

use super::angle::heading;
use super::grid::{Edge, Grid, Numbering};
use crate::scene::part::MeshPart;

/// Which way a disc faces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Facing {
    /// Normal +y.
    Up,
    /// Normal −y.
    Down,
}

/// Appends a disc at a height: `around` triangles about its centre on the y axis. Its rim has the
/// same bits as the ring of [`ring_point`]. The texture square is laid around the disc, +x to the
/// right as seen from outside.
pub(super) fn append_disc(
    part: &mut MeshPart,
    facing: Facing,
    height: f64,
    radius: f64,
    around: u32,
) {
    // Seen from outside, the centre is the upper edge of an upward disc and the lower edge of a
    // downward one: columns keep running counter-clockwise seen from above.
    let tube = Grid::tube(1, around);
    let (grid, centre_row, up) = match facing {
        Facing::Up => (Grid { top: Edge::Point, ..tube }, 0, 1.0),
        Facing::Down => (Grid { bottom: Edge::Point, ..tube }, 1, -1.0),
    };
    let points = grid.fill_points(&mut part.positions, |row, column| {
        if row == centre_row {
            [0.0, height, 0.0]
        } else {
            ring_point(column, around, radius, height)
        }
    });
    grid.append_cells(part, points);

    let normal = Numbering::constant(part.normals.len() as u32);
    part.normals.push([0.0, up, 0.0]);
    grid.append_triangles(&mut part.corner_normals, normal);

    let texture = grid.fill_points(&mut part.uvs, |row, column| {
        let [x, z] = if row == centre_row { [0.0; 2] } else { heading(column, around) };
        [0.5 + 0.5 * x, 0.5 - 0.5 * up * z]
    });
    grid.append_triangles(&mut part.corner_uvs, texture);
}

/// Vertex `column` of a horizontal ring about the y axis.
pub(super) fn ring_point(column: u32, around: u32, radius: f64, height: f64) -> [f64; 3] {
    let [x, z] = heading(column, around);
    [radius * x, height, radius * z]
}
