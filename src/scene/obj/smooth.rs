//! Normals for corners without one: the mean of the face normals around the vertex.
//!
//! n = Σ n_i / |Σ n_i| over the faces of the smoothing group at that position, unweighted, as
//! Angel, "Interactive Computer Graphics", and Curless, "Shading" define it. Every polygon counts
//! once, however it is cut into triangles.

use crate::mesh::NO_ATTRIBUTE;
use crate::scene::obj::polygon::{scale_corners, unit_normal};
use crate::scene::obj::scanned::Face;
use std::collections::HashMap;

/// A shorter sum of unit normals has no direction worth using: each is off by less than 16 units
/// of roundoff, so that a sum of k has its direction to better than k · 2^-49 · 2^20.
const CANCELLED: f64 = 1.0 / (1 << 20) as f64;

/// The sum over one smoothing group around one vertex.
struct Around {
    sum: [f64; 3],
    /// Face that was added last; a polygon that comes by twice counts once.
    last_face: usize,
    /// Position in the list of normals, once a corner asked for it.
    normal: Option<u32>,
}

/// Numbers the pairs of position and smoothing group in order of first use.
enum Slots {
    /// One group besides 0, as in most files: by position, without hashing.
    OneGroup(Vec<u32>),
    /// By position and group.
    Groups(HashMap<(u32, u32), u32>),
}

impl Slots {
    fn new(faces: &[Face], position_count: usize) -> Self {
        let mut groups = faces.iter().map(|face| face.group).filter(|&group| group != 0);
        let first = groups.next();
        match groups.all(|group| Some(group) == first) {
            true => Self::OneGroup(vec![NO_ATTRIBUTE; position_count]),
            false => Self::Groups(HashMap::with_capacity(position_count)),
        }
    }

    /// The number of a pair, which is `next` when it is new.
    fn find(&mut self, position: u32, group: u32, next: u32) -> u32 {
        match self {
            Self::Groups(numbers) => *numbers.entry((position, group)).or_insert(next),
            Self::OneGroup(numbers) => {
                let number = &mut numbers[position as usize];
                if *number == NO_ATTRIBUTE {
                    *number = next;
                }
                *number
            }
        }
    }
}

/// Fills `corner_normals`, one entry per corner, where it holds `NO_ATTRIBUTE` and the face has a
/// smoothing group; appends to `normals`. Corners where all faces are degenerate or cancel out
/// stay as they are.
pub(super) fn generate(
    faces: &[Face],
    positions: &[[f64; 3]],
    corner_positions: &[u32],
    normals: &mut Vec<[f64; 3]>,
    corner_normals: &mut [u32],
) {
    // Add each face's normal to its vertices.
    let mut slots = Slots::new(faces, positions.len());
    let mut sums: Vec<Around> = Vec::with_capacity(positions.len());
    let mut corner_slots = vec![NO_ATTRIBUTE; corner_positions.len()];
    let mut scaled = Vec::new();
    let mut start = 0;
    for (number, face) in faces.iter().enumerate() {
        let range = start..face.corners_end;
        start = face.corners_end;
        if face.group == 0 {
            continue;
        }
        let corners = corner_positions[range.clone()].iter();
        scale_corners(corners.map(|&position| positions[position as usize]), &mut scaled);
        let normal = unit_normal(&scaled);
        for corner in range {
            let slot = slots.find(corner_positions[corner], face.group, sums.len() as u32);
            if slot as usize == sums.len() {
                sums.push(Around { sum: [0.0; 3], last_face: usize::MAX, normal: None });
            }
            corner_slots[corner] = slot;
            let around = &mut sums[slot as usize];
            if let (Some(normal), true) = (normal, around.last_face != number) {
                around.sum = [0, 1, 2].map(|k| around.sum[k] + normal[k]);
                around.last_face = number;
            }
        }
    }

    // Give the corners without a normal theirs, in file order.
    for (corner, index) in corner_normals.iter_mut().enumerate() {
        if *index != NO_ATTRIBUTE || corner_slots[corner] == NO_ATTRIBUTE {
            continue;
        }
        let around = &mut sums[corner_slots[corner] as usize];
        if around.normal.is_none() {
            let length = around.sum.iter().map(|c| c * c).sum::<f64>().sqrt();
            if length >= CANCELLED {
                around.normal = Some(normals.len() as u32);
                normals.push(around.sum.map(|c| c / length));
            }
        }
        *index = around.normal.unwrap_or(NO_ATTRIBUTE);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Triangles over the corners 0, 1, 2 … with the groups given.
    fn generated(positions: &[[f64; 3]], corners: &[u32], groups: &[u32]) -> Vec<Option<[f64; 3]>> {
        let face = |(i, &group): (usize, &u32)| Face {
            line: 1,
            corners_end: 3 * i + 3,
            group,
            material: NO_ATTRIBUTE,
        };
        let faces: Vec<Face> = groups.iter().enumerate().map(face).collect();
        let mut normals = Vec::new();
        let mut indices = vec![NO_ATTRIBUTE; corners.len()];
        generate(&faces, positions, corners, &mut normals, &mut indices);
        indices.iter().map(|&index| normals.get(index as usize).copied()).collect()
    }

    /// Two faces at a right angle along the x axis, the second 100 times as large.
    const ROOF: [[f64; 3]; 4] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -100.0]];

    #[test]
    fn one_group_takes_the_unweighted_mean() {
        let normals = generated(&ROOF, &[0, 1, 2, 0, 3, 1], &[1, 1]);
        let half = 0.5_f64.sqrt();
        for corner in [0, 1, 3, 5] {
            let [x, y, z] = normals[corner].unwrap();
            assert_eq!(x, 0.0);
            // Two roundings: the division and the root.
            assert!((y + half).abs() <= 2.0 * f64::EPSILON, "{y}");
            assert!((z - half).abs() <= 2.0 * f64::EPSILON, "{z}");
        }
        assert_eq!(normals[2], Some([0.0, 0.0, 1.0]));
        assert_eq!(normals[4], Some([0.0, -1.0, 0.0]));
    }

    #[test]
    fn groups_keep_apart_and_group_0_gets_none() {
        let normals = generated(&ROOF, &[0, 1, 2, 0, 3, 1], &[1, 2]);
        assert_eq!(normals[..3], [Some([0.0, 0.0, 1.0]); 3]);
        assert_eq!(normals[3..], [Some([0.0, -1.0, 0.0]); 3]);
        let normals = generated(&ROOF, &[0, 1, 2, 0, 3, 1], &[0, 2]);
        assert_eq!(normals[..3], [None; 3]);
        assert_eq!(normals[3..], [Some([0.0, -1.0, 0.0]); 3]);
    }

    #[test]
    fn degenerate_faces_do_not_count_and_opposite_ones_cancel() {
        // The second face is a line: only the first gives a direction, and the line's own corner
        // gets none.
        let positions = [ROOF[0], ROOF[1], ROOF[2], [2.0, 0.0, 0.0]];
        let normals = generated(&positions, &[0, 1, 2, 0, 1, 3], &[1, 1]);
        assert_eq!(normals[3], Some([0.0, 0.0, 1.0]));
        assert_eq!(normals[5], None);
        let normals = generated(&ROOF, &[0, 1, 2, 0, 2, 1], &[1, 1]);
        assert_eq!(normals, [None; 6]);
    }
}
