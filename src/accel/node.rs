//! Our own tree: nodes that hold the exact boxes of both children, one cache line each.
//!
//! The layout takes the shape that obvhs found, opens the items that are groups into balanced
//! subtrees, and puts the triangles in leaf order. Boxes are then computed from the triangles
//! upwards, so no number of the builder reaches a ray.

use super::bounds::Bounds;
use super::entries::{Entries, LeafTriangle};
use obvhs::bvh2::Bvh2;
use std::ops::Range;

/// A range of triangles that is not split further by position. Only groups and balanced trees are
/// cut so; everywhere else a leaf is one triangle, whose test costs more than a node's two boxes.
const LEAF_SIZE: usize = 4;

/// Where a child is: an inner node (`count` 0, `first` its index) or a range of triangles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Child {
    pub(super) first: u32,
    pub(super) count: u32,
}

/// An inner node: the two children and their boxes, `planes[side][axis][child]` with side 0 the
/// lower faces and side 1 the upper ones.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(super) struct Node {
    pub(super) planes: [[[f32; 2]; 3]; 2],
    pub(super) children: [Child; 2],
}

/// A tree in preorder.
#[derive(Clone, Debug, Default)]
pub(super) struct Tree {
    pub(super) nodes: Vec<Node>,
    pub(super) triangles: Vec<LeafTriangle>,
    /// The root; `None` for a tree without triangles.
    pub(super) root: Option<Child>,
    /// Nodes on the longest path, leaves included.
    pub(super) depth: usize,
}

/// A part of the tree that is not laid out yet.
enum Part {
    /// A node of the builder's tree.
    Built(u32),
    /// A range of entries.
    Entries(Range<u32>),
}

/// A part, the node and side that it belongs to, and its depth.
struct Waiting {
    part: Part,
    slot: Option<(u32, usize)>,
    depth: usize,
}

/// What a part turns into.
enum Opened {
    Leaf(Child),
    Inner(Part, Part),
}

/// Lays out the builder's tree.
pub(super) fn lay_out(entries: &Entries, shape: &Bvh2) -> Tree {
    lay_out_part(entries, shape, Part::Built(0))
}

/// Lays out a balanced tree over the order of the entries.
pub(super) fn lay_out_balanced(entries: &Entries) -> Tree {
    let whole = Part::Entries(0..entries.triangles.len() as u32);
    lay_out_part(entries, &Bvh2::default(), whole)
}

fn lay_out_part(entries: &Entries, shape: &Bvh2, whole: Part) -> Tree {
    let mut tree =
        Tree { triangles: Vec::with_capacity(entries.triangles.len()), ..Tree::default() };
    // A stack of its own, not recursion: shapes may be deep.
    let mut waiting = vec![Waiting { part: whole, slot: None, depth: 1 }];
    while let Some(Waiting { part, slot, depth }) = waiting.pop() {
        tree.depth = tree.depth.max(depth);
        let child = match open(entries, shape, part, &mut tree.triangles) {
            Opened::Leaf(child) => child,
            Opened::Inner(left, right) => {
                let index = tree.nodes.len() as u32;
                tree.nodes.push(Node { planes: Default::default(), children: Default::default() });
                let below =
                    |part, side| Waiting { part, slot: Some((index, side)), depth: depth + 1 };
                waiting.push(below(right, 1));
                waiting.push(below(left, 0));
                Child { first: index, count: 0 }
            }
        };
        match slot {
            Some((parent, side)) => tree.nodes[parent as usize].children[side] = child,
            None => tree.root = Some(child),
        }
    }
    fit(&mut tree);
    tree
}

/// Opens a part: a leaf's triangles are appended, an inner part becomes two.
fn open(entries: &Entries, shape: &Bvh2, part: Part, triangles: &mut Vec<LeafTriangle>) -> Opened {
    let range = match part {
        Part::Built(index) => {
            let node = &shape.nodes[index as usize];
            if !node.is_leaf() {
                let left = node.first_index;
                return Opened::Inner(Part::Built(left), Part::Built(left + 1));
            }
            // The presets make leaves of one item.
            let item = shape.primitive_indices[node.first_index as usize];
            entries.items[item as usize].clone()
        }
        Part::Entries(range) => range,
    };
    if range.len() > LEAF_SIZE {
        let middle = range.start + (range.end - range.start) / 2;
        return Opened::Inner(Part::Entries(range.start..middle), Part::Entries(middle..range.end));
    }
    let child = Child { first: triangles.len() as u32, count: range.len() as u32 };
    triangles.extend(&entries.triangles[range.start as usize..range.end as usize]);
    Opened::Leaf(child)
}

/// Computes all boxes. Children come after their parents, so one backward pass is enough.
fn fit(tree: &mut Tree) {
    for index in (0..tree.nodes.len()).rev() {
        for side in 0..2 {
            let bounds = bounds_of(tree, tree.nodes[index].children[side]);
            for (planes, face) in tree.nodes[index].planes.iter_mut().zip([bounds.lo, bounds.hi]) {
                for (plane, position) in planes.iter_mut().zip(face) {
                    plane[side] = position;
                }
            }
        }
    }
}

/// The box of a child whose own descendants are fitted.
pub(super) fn bounds_of(tree: &Tree, child: Child) -> Bounds {
    if child.count > 0 {
        let range = child.first as usize..(child.first + child.count) as usize;
        return tree.triangles[range].iter().fold(Bounds::EMPTY, |bounds, triangle| {
            bounds.union(Bounds::of_triangle(&triangle.vertices))
        });
    }
    let planes = &tree.nodes[child.first as usize].planes;
    let of_side = |side: usize| Bounds {
        lo: std::array::from_fn(|axis| planes[0][axis][side]),
        hi: std::array::from_fn(|axis| planes[1][axis][side]),
    };
    of_side(0).union(of_side(1))
}
