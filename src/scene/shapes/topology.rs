//! What tests ask of a mesh: is it closed, oriented, of the right genus, without empty triangles,
//! with normals on the right side. Points are the same when their bits are.

use super::vector::minus;
pub(super) use super::vector::{cross, dot};
use crate::scene::part::MeshPart;
use std::collections::HashMap;

/// A mesh welded by the bits of its positions.
pub(super) struct Welded {
    /// Vertices − edges + triangles.
    pub(super) euler: i64,
    /// Edges that have a triangle on one side only.
    pub(super) boundary: usize,
}

/// Welds a mesh and counts. Fails where a triangle uses a point twice, or where two triangles run
/// along an edge the same way: the surface is then not oriented or not a manifold.
pub(super) fn weld(part: &MeshPart) -> Welded {
    let mut numbers = HashMap::new();
    let number: Vec<usize> = part
        .positions
        .iter()
        .map(|p| {
            let next = numbers.len();
            *numbers.entry(p.map(f64::to_bits)).or_insert(next)
        })
        .collect();
    let mut directed = HashMap::new();
    let mut used = vec![false; numbers.len()];
    for corners in &part.corners {
        let [a, b, c] = corners.map(|corner| number[corner as usize]);
        assert!(a != b && b != c && c != a, "a triangle uses a point twice");
        for (from, to) in [(a, b), (b, c), (c, a)] {
            used[from] = true;
            let before = directed.insert((from, to), ());
            assert!(before.is_none(), "two triangles run along an edge the same way");
        }
    }
    assert!(used.iter().all(|&u| u), "a position belongs to no triangle");
    let boundary = directed.keys().filter(|(a, b)| !directed.contains_key(&(*b, *a))).count();
    let edges = (directed.len() + boundary) / 2;
    let euler = numbers.len() as i64 - edges as i64 + part.corners.len() as i64;
    Welded { euler, boundary }
}

fn triangles(part: &MeshPart) -> impl Iterator<Item = [[f64; 3]; 3]> + '_ {
    part.corners.iter().map(|corners| corners.map(|corner| part.positions[corner as usize]))
}

/// Volume inside a closed surface, positive when it is oriented outwards.
pub(super) fn volume(part: &MeshPart) -> f64 {
    triangles(part).map(|[a, b, c]| dot(a, cross(b, c)) / 6.0).sum()
}

/// Smallest cosine between a corner normal and its triangle's face normal. Fails where a triangle
/// has no area, or an attribute is missing, not finite or not unit.
pub(super) fn check_attributes(part: &MeshPart) -> f64 {
    // Three squares of components with up to two roundings each, and the square root: at most
    // four units in the last place of 1.
    const UNIT_BOUND: f64 = 4.0 * f64::EPSILON;
    for n in &part.normals {
        assert!((dot(*n, *n).sqrt() - 1.0).abs() <= UNIT_BOUND, "{n:?} is not unit");
    }
    assert!(part.positions.iter().flatten().all(|c| c.is_finite()));
    assert_eq!(part.corner_normals.len(), part.corners.len());
    assert_eq!(part.corner_uvs.len(), part.corners.len());
    let mut least = f64::INFINITY;
    for ([a, b, c], normals) in triangles(part).zip(&part.corner_normals) {
        let face = cross(minus(b, a), minus(c, a));
        let twice_area = dot(face, face).sqrt();
        assert!(twice_area > 0.0, "{a:?} {b:?} {c:?} has no area");
        for &index in normals {
            least = least.min(dot(part.normals[index as usize], face) / twice_area);
        }
    }
    for [a, b, c] in part.corner_uvs.iter().map(|t| t.map(|index| part.uvs[index as usize])) {
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        assert!(area > 0.0, "texture triangle {a:?} {b:?} {c:?} is mirrored or empty");
        assert!([a, b, c].iter().all(|[s, t]| (0.0..=1.5).contains(s) && (0.0..=1.0).contains(t)));
    }
    least
}
