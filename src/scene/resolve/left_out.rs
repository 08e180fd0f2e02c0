//! What is left of a mesh file where bad faces are skipped.
//!
//! The reader has left out faces with positions that are not finite in the file (`scene::obj`);
//! here go the faces with one that is out of range after the transform, whole, whatever
//! triangles they were cut into.

use crate::scene::assemble::world_position;
use crate::scene::error::Place;
use crate::scene::file::text::Faults;
use crate::scene::part::MeshPart;
use crate::scene::transform::Transform;
use std::path::Path;

/// The part without the faces that have a position out of range, and a warning that counts them
/// and names the first; `None` where there are none.
pub(super) fn without_bad_faces(
    part: &MeshPart,
    transform: &Transform,
    path: &Path,
    faults: &mut Faults<'_>,
) -> Option<MeshPart> {
    let good: Vec<bool> = part
        .positions
        .iter()
        .map(|&position| world_position(position, transform).is_some())
        .collect();
    if good.iter().all(|&is_good| is_good) {
        return None;
    }
    let is_bad = |triangle: usize| part.corners[triangle].iter().any(|&c| !good[c as usize]);
    let mut kept = Vec::with_capacity(part.corners.len());
    let (mut left_out, mut first_line) = (0, 0);
    // A face's triangles follow one another and have its line, which is no other face's.
    let mut start = 0;
    for face in part.lines.chunk_by(|a, b| a == b) {
        let triangles = start..start + face.len();
        start = triangles.end;
        if triangles.clone().any(is_bad) {
            first_line = if left_out == 0 { face[0] } else { first_line };
            left_out += 1;
        } else {
            kept.extend(triangles);
        }
    }
    let place = Place::at(path, first_line, 0);
    let sentence = "a face with a corner out of range after the transform is left out";
    faults.warnings.push(match left_out {
        1 => format!("{place}: {sentence}"),
        count => format!("{place}: {sentence} ({count} times; this is the first)"),
    });
    // Bad positions go with their colours, and the others move up.
    let mut positions = Vec::with_capacity(part.positions.len());
    let colors =
        good.iter().zip(&part.colors).filter(|(good, _)| **good).map(|(_, &color)| color).collect();
    let numbers: Vec<u32> = good
        .iter()
        .zip(&part.positions)
        .map(|(&is_good, &position)| {
            let number = positions.len() as u32;
            if is_good {
                positions.push(position);
            }
            number
        })
        .collect();
    Some(MeshPart {
        positions,
        colors,
        corners: kept.iter().map(|&t| part.corners[t].map(|c| numbers[c as usize])).collect(),
        normals: part.normals.clone(),
        corner_normals: picked(&part.corner_normals, &kept),
        uvs: part.uvs.clone(),
        corner_uvs: picked(&part.corner_uvs, &kept),
        material_names: part.material_names.clone(),
        triangle_materials: picked(&part.triangle_materials, &kept),
        polygons: picked(&part.polygons, &kept),
        smoothing_groups: picked(&part.smoothing_groups, &kept),
        lines: picked(&part.lines, &kept),
    })
}

/// The entries of the triangles that stay; a list that has none stays empty.
fn picked<T: Copy>(list: &[T], kept: &[usize]) -> Vec<T> {
    kept.iter().filter_map(|&triangle| list.get(triangle)).copied().collect()
}
