//! The polygons of a part and who meets whom at which vertex.

use super::Weight;
use crate::scene::part::MeshPart;
use std::collections::HashMap;
use std::ops::Range;

/// Unit roundoff of f64.
const UNIT_ROUNDOFF: f64 = f64::EPSILON / 2.0;

/// A polygon at a vertex.
#[derive(Clone, Copy)]
pub(super) struct Entry {
    pub(super) polygon: u32,
    pub(super) weight: f64,
}

/// The polygons of a part, numbered anew from 0, and their vertices.
pub(super) struct Faces {
    /// Per triangle of the part.
    pub(super) polygon_of: Vec<u32>,
    /// Per polygon; `None` where it has no area beyond rounding.
    pub(super) normals: Vec<Option<[f64; 3]>>,
    /// Per position of the part: which vertex it is.
    pub(super) vertex_of: Vec<u32>,
    groups: Vec<u32>,
    /// The polygons around each vertex, in file order, vertex after vertex.
    entries: Vec<Entry>,
    ends: Vec<Range<usize>>,
}

impl Faces {
    pub(super) fn of(part: &MeshPart, weight: Weight) -> Self {
        let (vertex_of, vertex_count) = join(&part.positions);
        let positions = scaled_to_one(&part.positions);
        let mut faces = Self {
            polygon_of: Vec::with_capacity(part.corners.len()),
            normals: Vec::new(),
            vertex_of,
            groups: Vec::new(),
            entries: Vec::new(),
            ends: Vec::new(),
        };

        // Give every polygon its normal and area.
        let mut areas = Vec::new();
        let mut start = 0;
        while start < part.corners.len() {
            let number = |triangle: usize| part.polygons.get(triangle);
            let same =
                |triangle: &usize| number(start).is_some() && number(*triangle) == number(start);
            let end = start + 1 + (start + 1..part.corners.len()).take_while(same).count();
            let triangles = part.corners[start..end].iter();
            let (normal, area) =
                normal_and_area(triangles.map(|t| t.map(|corner| positions[corner as usize])));
            faces.polygon_of.resize(end, faces.normals.len() as u32);
            faces.normals.push(normal);
            faces.groups.push(part.smoothing_groups.get(start).copied().unwrap_or(1));
            areas.push(area);
            start = end;
        }

        // Reserve each vertex as many entries as it has corners.
        let mut counts = vec![0; vertex_count];
        for &corner in part.corners.iter().flatten() {
            counts[faces.vertex_of[corner as usize] as usize] += 1;
        }
        let mut next = 0;
        faces.ends = counts
            .iter()
            .map(|count| {
                next += count;
                next - count..next - count
            })
            .collect();
        faces.entries = vec![Entry { polygon: 0, weight: 0.0 }; next];

        // Enter the polygons; one that has several corners at a vertex has one entry there.
        for (corners, &polygon) in part.corners.iter().zip(&faces.polygon_of) {
            for k in 0..3 {
                let vertex = faces.vertex_of[corners[k] as usize];
                let range = &mut faces.ends[vertex as usize];
                let last = faces.entries[range.clone()].last().map(|entry| entry.polygon);
                let is_new = last != Some(polygon);
                if is_new {
                    faces.entries[range.end] = Entry { polygon, weight: 0.0 };
                    range.end += 1;
                }
                let entry = &mut faces.entries[range.end - 1];
                match weight {
                    Weight::Uniform => entry.weight = 1.0,
                    Weight::Area => entry.weight = areas[polygon as usize],
                    Weight::Angle => {
                        let at = |k: usize| positions[corners[k % 3] as usize];
                        entry.weight += angle(at(k), at(k + 1), at(k + 2));
                    }
                }
            }
        }
        faces
    }

    /// The polygons around a vertex, in file order.
    pub(super) fn around(&self, vertex: u32) -> &[Entry] {
        &self.entries[self.ends[vertex as usize].clone()]
    }

    /// The smoothing group of a polygon, 0 for none.
    pub(super) fn group_of(&self, polygon: u32) -> u32 {
        self.groups[polygon as usize]
    }

    /// The most polygons around one vertex.
    pub(super) fn largest_crowd(&self) -> usize {
        self.ends.iter().map(ExactSizeIterator::len).max().unwrap_or(0)
    }
}

/// The vertex of each position, and how many there are; equal positions are one vertex.
fn join(positions: &[[f64; 3]]) -> (Vec<u32>, usize) {
    let mut numbers: HashMap<[u64; 3], u32> = HashMap::with_capacity(positions.len());
    let vertex_of = positions.iter().map(|position| {
        let next = numbers.len() as u32;
        // + 0.0 turns -0 into 0.
        *numbers.entry(position.map(|c| (c + 0.0).to_bits())).or_insert(next)
    });
    let vertex_of = vertex_of.collect();
    (vertex_of, numbers.len())
}

/// The positions times the power of two that brings the largest coordinate into [¼, ½), so that no
/// difference exceeds 1. Areas are relative to that: one below 1e-308 of the mesh's extent squared
/// weighs nothing.
fn scaled_to_one(positions: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let largest = positions.iter().flatten().fold(0.0_f64, |m, c| m.max(c.abs()));
    let (_, exponent) = libm::frexp(largest);
    positions.iter().map(|p| p.map(|c| libm::scalbn(c, -exponent - 1))).collect()
}

/// Unit normal and area of a polygon of triangles, by the sum of their vector areas.
///
/// With differences divided by the largest one, each component of a cross product is off by less
/// than 12 units of roundoff, and each addition of k by at most 2k.
fn normal_and_area(
    triangles: impl Iterator<Item = [[f64; 3]; 3]> + Clone,
) -> (Option<[f64; 3]>, f64) {
    let edges = triangles.map(|[a, b, c]| [sub(b, a), sub(c, a)]);
    let largest = edges.clone().flatten().flatten().fold(0.0_f64, |m, c| m.max(c.abs()));
    if largest == 0.0 {
        return (None, 0.0);
    }
    let (mut sum, mut count) = ([0.0; 3], 0.0);
    for [e1, e2] in edges {
        let product = cross(e1.map(|c| c / largest), e2.map(|c| c / largest));
        sum = [0, 1, 2].map(|k| sum[k] + product[k]);
        count += 1.0;
    }
    let bound = count * (12.0 + 2.0 * count) * UNIT_ROUNDOFF;
    let longest = sum.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
    if longest <= bound {
        return (None, 0.0);
    }
    let length = length(sum);
    (Some(sum.map(|c| c / length)), 0.5 * length * largest * largest)
}

/// The angle at `a` between the ways to `b` and `c`, radians; 0 where it has none.
fn angle(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> f64 {
    let unit = |v: [f64; 3]| {
        let largest = v.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
        (largest > 0.0).then(|| v.map(|c| c / largest))
    };
    match (unit(sub(b, a)), unit(sub(c, a))) {
        (Some(u), Some(v)) => libm::atan2(length(cross(u, v)), dot(u, v)),
        _ => 0.0,
    }
}

fn sub(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn length(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}
