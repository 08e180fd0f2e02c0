//! The triangles as the tree holds them: in spatial order, bitwise duplicates folded together.
//!
//! Two degenerate inputs make a bottom-up clustering builder quadratic and its tree a linked list,
//! because every union cost ties: boxes with one centre, and boxes nested in each other. Runs of
//! more than [`LONGEST_RUN`] such boxes become one item for the builder, and the tree inside an
//! item is ours: halves by position in the run. So do the boxes of one cell of the Morton curve: a
//! scene whose sizes spread over many powers of two has nearly all of its boxes in one, where their
//! unions cost nothing beside the scene's. There the curve begins anew, cell within cell.

use super::bounds::Bounds;
use crate::mesh::{TriangleId, TriangleMesh};
use crate::mutant::{self, Mutant};
use rayon::prelude::*;
use std::cmp::Ordering;
use std::collections::HashMap;
use std::ops::Range;

/// Longest run of concentric or nested boxes that the builder is given one by one.
const LONGEST_RUN: usize = 8;

/// A triangle in a leaf. The vertices are copied so that a leaf test reads one place in memory.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LeafTriangle {
    /// Positions, in the corner order of `id`.
    pub(crate) vertices: [[f32; 3]; 3],
    /// The triangle, the lowest id among its copies.
    pub(crate) id: TriangleId,
    /// How many triangles of the scene have exactly these corners in this cyclic order.
    pub(crate) copies: u32,
}

/// All triangles that can be seen from somewhere, in spatial order, and the builder's items.
pub(super) struct Entries {
    pub(super) triangles: Vec<LeafTriangle>,
    pub(super) bounds: Vec<Bounds>,
    /// Ranges of `triangles`, without gaps.
    pub(super) items: Vec<Range<u32>>,
    /// The other ids of each folded triangle, ascending, under its lowest.
    pub(super) copies: HashMap<TriangleId, Vec<TriangleId>>,
}

/// Orders, folds and groups the mesh's triangles.
pub(super) fn collect(mesh: &TriangleMesh) -> Entries {
    let ids: Vec<(TriangleId, Bounds)> = mesh
        .ids()
        .map(|id| (id, Bounds::of_triangle(&mesh.triangle(id))))
        .filter(|(_, bounds)| !bounds.is_thinner_than_a_face())
        .collect();
    let scene = ids.iter().fold(Bounds::EMPTY, |scene, (_, bounds)| scene.union(*bounds));

    // Sort by cell along the Morton curve; inside a cell by size, so that nested boxes follow
    // each other, then by box and corners, so that duplicates do.
    let mut order: Vec<(u64, u32)> = ids
        .par_iter()
        .enumerate()
        .map(|(i, (_, bounds))| (morton_code(scene, *bounds), i as u32))
        .collect();
    order.par_sort_unstable_by(|a, b| {
        a.0.cmp(&b.0).then_with(|| {
            let (ida, bounds_a) = &ids[a.1 as usize];
            let (idb, bounds_b) = &ids[b.1 as usize];
            compare_boxes(bounds_a, bounds_b)
                .then_with(|| {
                    let a = canonical_bits(&mesh.triangle(*ida));
                    a.cmp(&canonical_bits(&mesh.triangle(*idb)))
                })
                .then(ida.cmp(idb))
        })
    });

    // Where a cell holds many boxes, order them along a curve of its own.
    let cells: Vec<usize> = order.chunk_by(|a, b| a.0 == b.0).map(<[_]>::len).collect();
    let mut rest = order.as_mut_slice();
    for length in cells {
        let (cell, others) = rest.split_at_mut(length);
        refine(cell, &ids);
        rest = others;
    }

    // Fold duplicates: the first of a run has the lowest id.
    let mut triangles: Vec<LeafTriangle> = Vec::with_capacity(order.len());
    let mut bounds: Vec<Bounds> = Vec::with_capacity(order.len());
    let mut copies: HashMap<TriangleId, Vec<TriangleId>> = HashMap::new();
    let mut codes: Vec<u64> = Vec::with_capacity(order.len());
    for (code, index) in order {
        let (id, triangle_bounds) = ids[index as usize];
        let vertices = mesh.triangle(id);
        if let Some(last) = triangles.last_mut()
            && bounds.last() == Some(&triangle_bounds)
            && canonical_bits(&last.vertices) == canonical_bits(&vertices)
        {
            if !mutant::is(Mutant::LostCopies) {
                copies.entry(last.id).or_default().push(id);
            }
            if mutant::is(Mutant::LastCopyKept) {
                last.id = id;
            }
            last.copies += 1;
            continue;
        }
        triangles.push(LeafTriangle { vertices, id, copies: 1 });
        bounds.push(triangle_bounds);
        codes.push(code);
    }
    let items = group(&bounds, &codes);
    Entries { triangles, bounds, items, copies }
}

/// Every triangle of the mesh in the order of ids, nothing folded: for the linear scan.
pub(super) fn unordered(mesh: &TriangleMesh) -> Vec<LeafTriangle> {
    mesh.ids().map(|id| LeafTriangle { vertices: mesh.triangle(id), id, copies: 1 }).collect()
}

/// Orders the boxes of one cell, given by code and position in `ids` and sorted by size, along the
/// Morton curve of their own centres, and so on inside its cells. The codes stay those of the
/// scene. A cell of mostly nested boxes keeps its order by size, which parts them better.
fn refine(cell: &mut [(u64, u32)], ids: &[(TriangleId, Bounds)]) {
    if cell.len() <= LONGEST_RUN {
        return;
    }
    let bounds_of = |entry: &(u64, u32)| ids[entry.1 as usize].1;
    let nested = cell.windows(2).filter(|pair| {
        let [a, b] = [bounds_of(&pair[0]), bounds_of(&pair[1])];
        degenerate_pair(a, b)
    });
    if 2 * nested.count() >= cell.len() {
        return;
    }
    let (mut lo, mut hi) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for entry in &*cell {
        let center = bounds_of(entry).center2();
        lo = std::array::from_fn(|k| lo[k].min(center[k]));
        hi = std::array::from_fn(|k| hi[k].max(center[k]));
    }
    if lo == hi {
        return;
    }
    let sides = std::array::from_fn(|k| hi[k] - lo[k]);
    let mut coded: Vec<(u64, (u64, u32))> =
        cell.iter().map(|entry| (code_of(bounds_of(entry).center2(), lo, sides), *entry)).collect();
    // Stable, so that inside a finer cell the order by size remains. Not all codes are equal: the
    // first and the last cell along some axis are taken.
    coded.sort_by_key(|(code, _)| *code);
    for (to, (_, entry)) in cell.iter_mut().zip(&coded) {
        *to = *entry;
    }
    let mut rest = cell;
    for finer in coded.chunk_by(|a, b| a.0 == b.0) {
        let (first, others) = rest.split_at_mut(finer.len());
        refine(first, ids);
        rest = others;
    }
}

/// Cuts the order into items: long concentric or nested runs, crowded cells, and single boxes.
fn group(bounds: &[Bounds], codes: &[u64]) -> Vec<Range<u32>> {
    let mut items = Vec::with_capacity(bounds.len());
    let mut start = 0;
    while start < bounds.len() {
        let mut end = start + 1;
        while end < bounds.len()
            && (codes[end - 1] == codes[end] || degenerate_pair(bounds[end - 1], bounds[end]))
        {
            end += 1;
        }
        if end - start > LONGEST_RUN {
            items.push(start as u32..end as u32);
        } else {
            items.extend((start..end).map(|i| i as u32..i as u32 + 1));
        }
        start = end;
    }
    items
}

/// Whether the union cost of the two boxes cannot tell them from their neighbours in the run.
fn degenerate_pair(a: Bounds, b: Bounds) -> bool {
    a.center2() == b.center2() || a.contains(b) || b.contains(a)
}

/// By half area, then by bounds. Total: all numbers are finite.
fn compare_boxes(a: &Bounds, b: &Bounds) -> Ordering {
    let half_area = |bounds: &Bounds| {
        let [x, y, z] = bounds.sides();
        x * y + y * z + z * x
    };
    half_area(a).total_cmp(&half_area(b)).then_with(|| {
        let key = |bounds: &Bounds| [bounds.lo, bounds.hi].map(|corner| corner.map(|c| c + 0.0));
        key(a).partial_cmp(&key(b)).unwrap_or(Ordering::Equal)
    })
}

/// The corners' bits, −0 as +0, rotated so that the smallest corner comes first: equal exactly
/// for triangles that cover the same samples with the same sign of V at the same t.
pub(super) fn canonical_bits(vertices: &[[f32; 3]; 3]) -> [[u32; 3]; 3] {
    let [a, b, c] = vertices.map(|vertex| vertex.map(|component| (component + 0.0).to_bits()));
    if mutant::is(Mutant::FoldedReversed) {
        let mut corners = [a, b, c];
        corners.sort_unstable();
        return corners;
    }
    [[a, b, c], [b, c, a], [c, a, b]].into_iter().min().unwrap_or([a, b, c])
}

/// Position of the box's centre along the Morton curve of the scene, 21 bits per axis.
fn morton_code(scene: Bounds, bounds: Bounds) -> u64 {
    let lo = scene.lo.map(|c| 2.0 * f64::from(c));
    code_of(bounds.center2(), lo, scene.sides().map(|side| 2.0 * side))
}

/// Position of a point along the Morton curve of a box with lowest corner `lo`.
fn code_of(point: [f64; 3], lo: [f64; 3], sides: [f64; 3]) -> u64 {
    (0..3).fold(0, |code, k| {
        // A flat box divides 0 by 0; the cast makes 0 of NaN.
        let cell = ((point[k] - lo[k]) / sides[k] * f64::from(1 << 21)) as u64;
        code | spread(cell.min((1 << 21) - 1)) << k
    })
}

/// Spreads 21 bits to every third position.
fn spread(bits: u64) -> u64 {
    let mut x = bits;
    for (shift, mask) in [
        (32, 0x1f_0000_0000_ffff),
        (16, 0x1f_0000_ff00_00ff),
        (8, 0x100f_00f0_0f00_f00f),
        (4, 0x10c3_0c30_c30c_30c3),
        (2, 0x1249_2492_4924_9249),
    ] {
        x = (x | x << shift) & mask;
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spread_bits_do_not_meet() {
        assert_eq!(spread(0b111), 0b1_001_001);
        assert_eq!(spread(1 << 20), 1 << 60);
    }

    #[test]
    fn copies_keep_the_lowest_id_and_reversed_copies_stay_apart() {
        let (a, b, c) = ([0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [-0.0, 1.0, 1.0]);
        let mesh = TriangleMesh {
            positions: vec![a, b, c],
            corners: vec![[2, 1, 0], [1, 2, 0], [0, 1, 2], [2, 0, 1]],
            ..TriangleMesh::default()
        };
        let entries = collect(&mesh);
        let mut found: Vec<_> = entries.triangles.iter().map(|t| (t.id.get(), t.copies)).collect();
        found.sort_unstable();
        assert_eq!(found, [(0, 1), (1, 3)]);
    }
}
