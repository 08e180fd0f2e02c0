//! The world's triangles: one mesh for the whole scene, in world space, in the order of ids.
//!
//! Positions are f32 triples, rounded once; corner normals are unit f64 vectors. The mesh knows
//! nothing of materials, lights or the camera, and no predicate lives here.

use crate::color::LinearRgb;
use std::num::NonZeroU32;

/// A triangle of the scene: 0-based in file order over all meshes.
/// `Option<TriangleId>` takes four bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct TriangleId(NonZeroU32);

impl TriangleId {
    /// Most triangles that a scene may have: ids are UINT in files, and 0xFFFF_FFFF means nothing.
    pub const MAX_COUNT: usize = u32::MAX as usize - 1;

    /// The id of the triangle at `index` (0-based, below [`Self::MAX_COUNT`]).
    pub const fn new(index: u32) -> Self {
        match NonZeroU32::new(index.wrapping_add(1)) {
            Some(stored) => Self(stored),
            None => panic!("u32::MAX is not a triangle"),
        }
    }

    /// 0-based position in the scene's triangles.
    pub const fn index(self) -> usize {
        self.get() as usize
    }

    /// 0-based id as it is written to files.
    pub const fn get(self) -> u32 {
        self.0.get() - 1
    }
}

/// Weights of the three corners at a point of a triangle, each relative to their sum (1).
/// All three are stored: 1 − u − v has no relative accuracy near the opposite edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Barycentric(pub [f64; 3]);

/// "This corner has no normal" or "no texture coordinate" in [`TriangleMesh`]'s index lists.
pub const NO_ATTRIBUTE: u32 = u32::MAX;

/// All triangles of a scene, world space.
#[derive(Clone, Debug, Default)]
pub struct TriangleMesh {
    /// Positions: finite, each component at most 2^126 in magnitude.
    pub positions: Vec<[f32; 3]>,
    /// Corners of each triangle: indices into `positions`. Counter-clockwise seen from outside.
    pub corners: Vec<[u32; 3]>,
    /// Unit corner normals, world space.
    pub normals: Vec<[f64; 3]>,
    /// Per triangle, indices into `normals` or [`NO_ATTRIBUTE`] (the face normal is used there).
    /// Empty when no triangle of the scene has corner normals.
    pub corner_normals: Vec<[u32; 3]>,
    /// Texture coordinates, origin bottom left.
    pub uvs: Vec<[f64; 2]>,
    /// Per triangle, indices into `uvs` or [`NO_ATTRIBUTE`]. Empty when no triangle has any.
    pub corner_uvs: Vec<[u32; 3]>,
    /// Colours of the positions, one each: linear RGB, finite, at least 0. Empty when no mesh of
    /// the scene has any; beside a mesh that has, the others are white.
    pub colors: Vec<LinearRgb>,
}

impl TriangleMesh {
    /// Number of triangles.
    pub fn len(&self) -> usize {
        self.corners.len()
    }

    /// Whether there is no triangle.
    pub fn is_empty(&self) -> bool {
        self.corners.is_empty()
    }

    /// Memory of all lists, in bytes.
    pub fn bytes(&self) -> usize {
        let corners = [&self.corners, &self.corner_normals, &self.corner_uvs];
        size_of_val(&self.positions[..])
            + corners.map(|list| size_of_val(&list[..])).iter().sum::<usize>()
            + size_of_val(&self.normals[..])
            + size_of_val(&self.uvs[..])
            + size_of_val(&self.colors[..])
    }

    /// The three corner positions of a triangle.
    #[inline]
    pub fn triangle(&self, id: TriangleId) -> [[f32; 3]; 3] {
        self.corners[id.index()].map(|corner| self.positions[corner as usize])
    }

    /// All ids, in order.
    pub fn ids(&self) -> impl ExactSizeIterator<Item = TriangleId> + use<> {
        (0..self.corners.len() as u32).map(TriangleId::new)
    }

    /// The three unit corner normals, or `None` when a corner lacks one.
    #[inline]
    pub fn normals_of(&self, id: TriangleId) -> Option<[[f64; 3]; 3]> {
        let indices = self.corner_normals.get(id.index())?;
        if indices.contains(&NO_ATTRIBUTE) {
            return None;
        }
        Some(indices.map(|index| self.normals[index as usize]))
    }

    /// The three corner texture coordinates, or `None` when a corner lacks one.
    #[inline]
    pub fn uvs_of(&self, id: TriangleId) -> Option<[[f64; 2]; 3]> {
        let indices = self.corner_uvs.get(id.index())?;
        if indices.contains(&NO_ATTRIBUTE) {
            return None;
        }
        Some(indices.map(|index| self.uvs[index as usize]))
    }

    /// The colours of the three corners, or `None` when the mesh has no colours.
    pub fn colors_of(&self, id: TriangleId) -> Option<[LinearRgb; 3]> {
        if self.colors.is_empty() {
            return None;
        }
        Some(self.corners[id.index()].map(|corner| self.colors[corner as usize]))
    }

    /// Unit normal of the face by winding, `(v1 − v0) × (v2 − v0)` in f64, never flipped; the zero
    /// vector for a triangle without area.
    ///
    /// Products of f32 differences stay inside the range of f64 (2^-298 … 2^256), and the vector
    /// is divided by its largest component before it is made unit, so nothing under- or overflows.
    #[inline]
    pub fn face_normal(&self, id: TriangleId) -> [f64; 3] {
        let [a, b, c] = self.triangle(id).map(|v| v.map(f64::from));
        let e1 = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
        let e2 = [c[0] - a[0], c[1] - a[1], c[2] - a[2]];
        let n = [
            e1[1] * e2[2] - e1[2] * e2[1],
            e1[2] * e2[0] - e1[0] * e2[2],
            e1[0] * e2[1] - e1[1] * e2[0],
        ];
        let largest = n.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
        if largest == 0.0 {
            return [0.0; 3];
        }
        let n = n.map(|c| c / largest);
        let length = (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt();
        n.map(|c| c / length)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_optional_id_takes_four_bytes() {
        assert_eq!(size_of::<Option<TriangleId>>(), 4);
        assert_eq!(TriangleId::new(0).get(), 0);
        assert_eq!(TriangleId::new(u32::MAX - 1).get(), u32::MAX - 1);
    }

    #[test]
    fn a_face_normal_survives_tiny_and_huge_triangles() {
        for scale in [1e-30_f32, 1.0, 1e30] {
            let mesh = TriangleMesh {
                positions: vec![[0.0; 3], [scale, 0.0, 0.0], [0.0, scale, 0.0]],
                corners: vec![[0, 1, 2]],
                ..TriangleMesh::default()
            };
            assert_eq!(mesh.face_normal(TriangleId::new(0)), [0.0, 0.0, 1.0]);
        }
    }
}
