//! Vertex normals made anew from the faces of a mesh, whatever normals it came with.
//!
//! n = Σ w·n_i / |Σ w·n_i| over the polygons around a vertex, n_i their unit normals. The weight is
//! 1 (Angel, "Interactive Computer Graphics"; Curless, "Shading"), the polygon's area, or its angle
//! at the vertex (Thürmer and Wüthrich, "Computing Vertex Normals from Polygonal Facets", 1998).
//! Every polygon counts once, however it is cut: its vector area and its angle at a vertex are the
//! sums over its triangles. A quad of a generated shape is one polygon.
//!
//! A vertex is a place: corners at equal coordinates meet there even where the file has the point
//! twice. All is in object space, so a transform of the mesh changes neither weights nor angles.
//! Polygons without area do not count; where nothing is left, or the sum cancels, the corner has
//! no normal, and its triangle is shaded by the face normal.

mod faces;

use super::part::MeshPart;
use crate::mesh::NO_ATTRIBUTE;
use faces::{Entry, Faces};
use std::collections::HashMap;

/// A sum below this part of its largest weight has no direction worth using: each unit normal is
/// off by less than 16 units of roundoff, so that a sum of k has its direction to better than
/// k · 2^-49 · 2^20.
const CANCELLED: f64 = 1.0 / (1 << 20) as f64;

/// What the square of the crease's chord is enlarged by, relatively. Two unit normals an angle of
/// at least 1° apart (chord 0.017) have the square of their distance off by less than 2^-43, as
/// each is off by less than 8 units of roundoff; so an angle of exactly the crease is inside.
const CHORD_SLACK: f64 = 1.0 + 1.0 / (1_u64 << 40) as f64;

/// Most polygons around one vertex with a crease angle: every two are compared, and this many
/// take about a second.
pub(crate) const MAX_CREASED: usize = 16_384;

/// How much a polygon counts at a vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Weight {
    /// 1.
    Uniform,
    /// Its area.
    Area,
    /// Its angle at the vertex.
    Angle,
}

/// Which polygons make a corner's normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Together {
    /// Those of the corner's smoothing group; group 0 has no vertex normals.
    Groups,
    /// Those whose normals differ from that of the corner's polygon by at most so many degrees,
    /// 0…180; groups are ignored.
    Crease(f64),
}

/// More than [`MAX_CREASED`] polygons with a crease angle meet in one vertex; their number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct TooCrowded(pub(crate) usize);

/// Replaces the normals of a part; how many corners of polygons with area got none although they
/// are to be smooth.
///
/// # Errors
/// [`TooCrowded`].
pub(crate) fn remake(
    part: &mut MeshPart,
    weight: Weight,
    together: Together,
) -> Result<usize, TooCrowded> {
    let faces = Faces::of(part, weight);
    let crowd = faces.largest_crowd();
    if matches!(together, Together::Crease(_)) && crowd > MAX_CREASED {
        return Err(TooCrowded(crowd));
    }
    let limit = match together {
        Together::Groups => None,
        Together::Crease(degrees) => Some(chord_squared(degrees)),
    };
    let mut normals = Vec::new();
    // By vertex and group, or by vertex and polygon.
    let mut made: HashMap<(u32, u32), u32> = HashMap::new();
    let mut missing = 0;
    let mut corner_normals = Vec::with_capacity(part.corners.len());
    for (corners, &polygon) in part.corners.iter().zip(&faces.polygon_of) {
        let (own, group) = (faces.normals[polygon as usize], faces.group_of(polygon));
        corner_normals.push(corners.map(|position| {
            let vertex = faces.vertex_of[position as usize];
            let index = match (limit, own) {
                (None, _) if group == 0 => return NO_ATTRIBUTE,
                (None, _) => *made.entry((vertex, group)).or_insert_with(|| {
                    let same = |entry: &&Entry| faces.group_of(entry.polygon) == group;
                    keep(mean(&faces, faces.around(vertex).iter().filter(same)), &mut normals)
                }),
                (Some(_), None) => return NO_ATTRIBUTE,
                (Some(limit), Some(own)) => *made.entry((vertex, polygon)).or_insert_with(|| {
                    let near = |entry: &&Entry| {
                        faces.normals[entry.polygon as usize]
                            .is_some_and(|other| distance_squared(own, other) <= limit)
                    };
                    keep(mean(&faces, faces.around(vertex).iter().filter(near)), &mut normals)
                }),
            };
            missing += usize::from(index == NO_ATTRIBUTE && own.is_some());
            index
        }));
    }
    // An empty list says that no triangle has the attribute.
    if normals.is_empty() {
        corner_normals.clear();
    }
    part.normals = normals;
    part.corner_normals = corner_normals;
    Ok(missing)
}

/// The unit weighted mean of the normals of entries.
fn mean<'a>(faces: &Faces, entries: impl Iterator<Item = &'a Entry> + Clone) -> Option<[f64; 3]> {
    let weighted =
        entries.filter_map(|entry| Some((faces.normals[entry.polygon as usize]?, entry.weight)));
    // Weights relative to the largest one: no square of the sum underflows.
    let largest = weighted.clone().fold(0.0_f64, |m, (_, weight)| m.max(weight));
    if largest == 0.0 {
        return None;
    }
    let mut sum = [0.0; 3];
    for (normal, weight) in weighted {
        let share = weight / largest;
        sum = [0, 1, 2].map(|k| sum[k] + share * normal[k]);
    }
    let length = sum.iter().map(|c| c * c).sum::<f64>().sqrt();
    (length >= CANCELLED).then(|| sum.map(|c| c / length))
}

/// Puts a normal into the list and gives its index.
fn keep(normal: Option<[f64; 3]>, normals: &mut Vec<[f64; 3]>) -> u32 {
    let Some(normal) = normal else { return NO_ATTRIBUTE };
    normals.push(normal);
    normals.len() as u32 - 1
}

/// Largest squared distance of unit vectors that are at most so many degrees apart: 4 sin²(A/2).
/// Unlike the cosine, it is well conditioned for small angles.
fn chord_squared(degrees: f64) -> f64 {
    let half = libm::sin(degrees.to_radians() / 2.0);
    4.0 * half * half * CHORD_SLACK
}

fn distance_squared(a: [f64; 3], b: [f64; 3]) -> f64 {
    [0, 1, 2].map(|k| (a[k] - b[k]) * (a[k] - b[k])).iter().sum()
}
