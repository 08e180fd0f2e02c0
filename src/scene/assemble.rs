//! From mesh parts to the one mesh of the scene: transform, round once, mirror, append.
//!
//! Which material a triangle has is decided by `resolve`; here it is only written down.

use super::part::MeshPart;
use super::transform::Transform;
use super::{Object, Shading, Sides, Source};
use crate::color::LinearRgb;
use crate::mesh::{NO_ATTRIBUTE, TriangleId, TriangleMesh};
use std::ops::Range;

/// Largest magnitude of a position: differences and the predicates' products of such numbers stay
/// finite.
const LARGEST_POSITION: f64 = (1_u128 << 126) as f64;

/// Colour of the vertices of a mesh without colours.
const WHITE: LinearRgb = [1.0; 3];

/// The scene's triangles as they grow.
#[derive(Debug, Default)]
pub(crate) struct Assembly {
    pub(crate) mesh: TriangleMesh,
    pub(crate) objects: Vec<Object>,
    pub(crate) triangle_materials: Vec<u32>,
}

/// A part and what the scene says of it.
pub(crate) struct Piece<'a> {
    pub(crate) part: &'a MeshPart,
    pub(crate) transform: Transform,
    pub(crate) name: String,
    pub(crate) sides: Sides,
    pub(crate) shading: Shading,
    /// Whether normals are transformed like directions.
    pub(crate) naive_normals: bool,
    pub(crate) source: Source,
    /// Per triangle, position in the scene's materials.
    pub(crate) materials: Vec<u32>,
}

/// Why a piece cannot be appended.
#[derive(Debug, PartialEq)]
pub(crate) enum AssemblyFault {
    /// A position is not finite, or too large.
    Position {
        /// Where it is after the transform.
        position: [f64; 3],
        /// The first triangle of the part that uses it.
        triangle: Option<usize>,
    },
    /// More triangles or corners than ids.
    TooMany,
}

impl Assembly {
    /// Appends a piece; nothing of it where it is faulty.
    pub(crate) fn append(&mut self, piece: Piece<'_>) -> Result<(), AssemblyFault> {
        let part = piece.part;
        let first = self.mesh.corners.len();
        let most = [
            self.mesh.positions.len() + part.positions.len(),
            self.mesh.normals.len() + part.normals.len(),
            self.mesh.uvs.len() + part.uvs.len(),
            first + part.corners.len(),
        ];
        if most.iter().any(|&count| count > TriangleId::MAX_COUNT) {
            return Err(AssemblyFault::TooMany);
        }
        let positions = world_positions(part, &piece.transform)?;
        let mirrored = piece.transform.orientation < 0;
        self.append_normals(part, &piece.transform, piece.naive_normals);
        self.append_uvs(part, mirrored);
        self.append_colors(part);
        let offset = self.mesh.positions.len() as u32;
        self.mesh.positions.extend(positions);
        self.mesh.corners.extend(
            part.corners.iter().map(|&corners| wound(corners.map(|c| c + offset), mirrored)),
        );
        self.triangle_materials.extend(piece.materials);
        self.objects.push(Object {
            name: piece.name,
            triangles: id_range(first, self.mesh.corners.len()),
            shading: piece.shading,
            sides: piece.sides,
            source: piece.source,
        });
        Ok(())
    }

    /// Corner normals; one that the transform leaves no direction becomes "no normal". Called
    /// while `corners` still ends before this part.
    fn append_normals(&mut self, part: &MeshPart, transform: &Transform, naive: bool) {
        if part.corner_normals.is_empty() {
            return;
        }
        // Give the triangles before this part their "no normal".
        self.mesh.corner_normals.resize(self.mesh.corners.len(), [NO_ATTRIBUTE; 3]);
        let mut indices = Vec::with_capacity(part.normals.len());
        for &normal in &part.normals {
            let moved =
                if naive { transform.naive_normal(normal) } else { transform.normal(normal) };
            indices.push(match moved {
                Some(unit) => {
                    self.mesh.normals.push(unit);
                    self.mesh.normals.len() as u32 - 1
                }
                None => NO_ATTRIBUTE,
            });
        }
        let mirrored = transform.orientation < 0;
        self.mesh.corner_normals.extend(part.corner_normals.iter().map(|&corners| {
            let moved = corners.map(|c| indices.get(c as usize).copied().unwrap_or(NO_ATTRIBUTE));
            wound(moved, mirrored)
        }));
    }

    /// Corner texture coordinates, likewise.
    fn append_uvs(&mut self, part: &MeshPart, mirrored: bool) {
        if part.corner_uvs.is_empty() {
            return;
        }
        self.mesh.corner_uvs.resize(self.mesh.corners.len(), [NO_ATTRIBUTE; 3]);
        let offset = self.mesh.uvs.len() as u32;
        self.mesh.uvs.extend(&part.uvs);
        self.mesh.corner_uvs.extend(part.corner_uvs.iter().map(|&corners| {
            let moved = corners.map(|c| if c == NO_ATTRIBUTE { c } else { c + offset });
            wound(moved, mirrored)
        }));
    }

    /// Colours of positions. Called while `positions` still ends before this part.
    fn append_colors(&mut self, part: &MeshPart) {
        if !part.colors.is_empty() {
            self.mesh.colors.resize(self.mesh.positions.len(), WHITE);
            self.mesh.colors.extend(&part.colors);
        }
    }

    /// Completes the attribute lists of the triangles after the last part that has any.
    pub(crate) fn finish(mut self) -> Self {
        let count = self.mesh.corners.len();
        for list in [&mut self.mesh.corner_normals, &mut self.mesh.corner_uvs] {
            if !list.is_empty() {
                list.resize(count, [NO_ATTRIBUTE; 3]);
            }
        }
        if !self.mesh.colors.is_empty() {
            self.mesh.colors.resize(self.mesh.positions.len(), WHITE);
        }
        self
    }
}

/// A position in world space, rounded once; `None` where it is not finite or too large.
pub(super) fn world_position(position: [f64; 3], transform: &Transform) -> Option<[f32; 3]> {
    let stored = transform.position(position).map(|c| c as f32);
    // NaN fails the comparison too.
    stored.iter().all(|c| f64::from(c.abs()) <= LARGEST_POSITION).then_some(stored)
}

/// All positions of a part in world space, rounded once.
fn world_positions(part: &MeshPart, transform: &Transform) -> Result<Vec<[f32; 3]>, AssemblyFault> {
    let mut rounded = Vec::with_capacity(part.positions.len());
    for (index, &position) in part.positions.iter().enumerate() {
        let Some(stored) = world_position(position, transform) else {
            let position = transform.position(position);
            let uses = |corners: &[u32; 3]| corners.contains(&(index as u32));
            let triangle = part.corners.iter().position(uses);
            return Err(AssemblyFault::Position { position, triangle });
        };
        rounded.push(stored);
    }
    Ok(rounded)
}

/// A mirroring transform turns every triangle inside out; exchanging corners 1 and 2 turns it back.
fn wound([a, b, c]: [u32; 3], mirrored: bool) -> [u32; 3] {
    if mirrored { [a, c, b] } else { [a, b, c] }
}

fn id_range(start: usize, end: usize) -> Range<u32> {
    start as u32..end as u32
}

#[cfg(test)]
mod tests;
