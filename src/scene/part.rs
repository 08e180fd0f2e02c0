//! One mesh as its source gives it: object space, f64, before transform and rounding.
//!
//! Generators and file readers fill it; `assemble` transforms it, rounds it once and appends it to
//! the scene's mesh.

use crate::color::LinearRgb;

/// A mesh in object space. Index lists have one entry per triangle; an attribute's list is empty
/// when the mesh has none of it, and [`crate::mesh::NO_ATTRIBUTE`] marks a corner without it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshPart {
    /// Positions, finite.
    pub positions: Vec<[f64; 3]>,
    /// Corners: indices into `positions`, counter-clockwise seen from outside.
    pub corners: Vec<[u32; 3]>,
    /// Unit normals.
    pub normals: Vec<[f64; 3]>,
    /// Per triangle, indices into `normals`.
    pub corner_normals: Vec<[u32; 3]>,
    /// Texture coordinates, origin bottom left.
    pub uvs: Vec<[f64; 2]>,
    /// Per triangle, indices into `uvs`.
    pub corner_uvs: Vec<[u32; 3]>,
    /// Colours of the positions, one each: linear RGB as written; empty when the source has none.
    pub colors: Vec<LinearRgb>,
    /// Materials that the source names, in order of first use.
    pub material_names: Vec<String>,
    /// Per triangle, index into `material_names` or `NO_ATTRIBUTE`; empty when none is named.
    pub triangle_materials: Vec<u32>,
    /// Per triangle, 1-based line of its face in the file; empty for generated shapes.
    pub lines: Vec<u32>,
    /// Per triangle, the number of the polygon that it is a part of; a polygon's triangles follow
    /// each other. Empty when every triangle is a polygon of its own.
    pub polygons: Vec<u32>,
    /// Per triangle, its smoothing group, 0 for none; empty when all are in group 1.
    pub smoothing_groups: Vec<u32>,
}
