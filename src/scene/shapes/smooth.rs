//! Pieces of a mesh that know no analytic normals: a smooth grid of points and a flat quadrilateral.

use super::grid::{Grid, Numbering};
use super::vector::{cross, made_unit, minus};
use crate::scene::part::MeshPart;

/// Appends a surface through the points of a grid. A vertex's normal is the sum of the normals of
/// its triangles weighted by area, made unit; every triangle must have an area.
pub(super) fn append_smooth(
    part: &mut MeshPart,
    grid: &Grid,
    point: impl Fn(u32, u32) -> [f64; 3],
) {
    let (first_triangle, first_normal) = (part.corners.len(), part.normals.len());
    let points = grid.fill_points(&mut part.positions, point);
    grid.append_cells(part, points);
    let normals = grid.fill_points(&mut part.normals, |_, _| [0.0; 3]);
    grid.append_triangles(&mut part.corner_normals, normals);
    for triangle in first_triangle..part.corners.len() {
        let [a, b, c] = part.corners[triangle].map(|corner| part.positions[corner as usize]);
        let face = cross(minus(b, a), minus(c, a));
        for index in part.corner_normals[triangle] {
            let sum = &mut part.normals[index as usize];
            *sum = [0, 1, 2].map(|k: usize| sum[k] + face[k]);
        }
    }
    part.normals[first_normal..].iter_mut().for_each(|normal| *normal = made_unit(*normal));
    let texture = grid.fill_texture_points(&mut part.uvs);
    grid.append_triangles(&mut part.corner_uvs, texture);
}

/// Appends the quadrilateral with these corners, counter-clockwise from the bottom left as seen
/// from its front. It is flat up to rounding and has the whole texture square.
pub(super) fn append_quad(part: &mut MeshPart, corners: [[f64; 3]; 4]) {
    let grid = Grid::open(1, 1);
    let [bottom_left, bottom_right, top_right, top_left] = corners;
    let points = grid.fill_points(&mut part.positions, |row, column| match (row, column) {
        (0, 0) => top_left,
        (0, _) => top_right,
        (_, 0) => bottom_left,
        _ => bottom_right,
    });
    grid.append_cells(part, points);
    let normal = Numbering::constant(part.normals.len() as u32);
    // The diagonals span the plane however unequal the sides are.
    let face = cross(minus(top_right, bottom_left), minus(top_left, bottom_right));
    part.normals.push(made_unit(face));
    grid.append_triangles(&mut part.corner_normals, normal);
    let texture = grid.fill_texture_points(&mut part.uvs);
    grid.append_triangles(&mut part.corner_uvs, texture);
}
