//! Our own tree: nodes that hold the exact boxes of both children, one cache line each.
//!
//! The layout takes the shape that obvhs found, opens the items that are groups into balanced
//! subtrees, and puts the triangles in leaf order. Boxes are then computed from the triangles
//! upwards, so no number of the builder reaches a ray.

use super::bounds::Bounds;
use super::entries::{Entries, LeafTriangle};
use obvhs::bvh2::Bvh2;
use std::ops::Range;

/// A range of triangles that is not split further by position: four leaf tests cost about what
/// one more level of boxes would.
const LEAF_SIZE: usize = 4;
/// Most triangles that a leaf made of several items may hold.
const MERGED_LEAF_SIZE: usize = 8;

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
    /// A range of the builder's list of items.
    Items(Range<u32>),
    /// A range of entries.
    Entries(Range<u32>),
}

/// What a part turns into.
enum Opened {
    Leaf(Child),
    Inner(Part, Part),
}

/// Lays out the builder's tree.
pub(super) fn lay_out(entries: &Entries, shape: &Bvh2) -> Tree {
    lay_out_part(entries, Some(shape), Part::Built(0))
}

/// Lays out a balanced tree over the order of the entries.
pub(super) fn lay_out_balanced(entries: &Entries) -> Tree {
    lay_out_part(entries, None, Part::Entries(0..entries.triangles.len() as u32))
}

fn lay_out_part(entries: &Entries, shape: Option<&Bvh2>, whole: Part) -> Tree {
    let mut tree =
        Tree { triangles: Vec::with_capacity(entries.triangles.len()), ..Tree::default() };
    // A stack of its own, not recursion: shapes may be deep. `slot` is where the child belongs.
    let mut waiting: Vec<(Part, Option<(u32, usize)>, usize)> = vec![(whole, None, 1)];
    while let Some((part, slot, depth)) = waiting.pop() {
        tree.depth = tree.depth.max(depth);
        let child = match open(entries, shape, part, &mut tree.triangles) {
            Opened::Leaf(child) => child,
            Opened::Inner(left, right) => {
                let index = tree.nodes.len() as u32;
                tree.nodes.push(Node { planes: Default::default(), children: Default::default() });
                waiting.push((right, Some((index, 1)), depth + 1));
                waiting.push((left, Some((index, 0)), depth + 1));
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
fn open(
    entries: &Entries,
    shape: Option<&Bvh2>,
    part: Part,
    triangles: &mut Vec<LeafTriangle>,
) -> Opened {
    let mut part = part;
    loop {
        part = match (part, shape) {
            (Part::Built(index), Some(shape)) => {
                let node = &shape.nodes[index as usize];
                if !node.is_leaf() {
                    return Opened::Inner(
                        Part::Built(node.first_index),
                        Part::Built(node.first_index + 1),
                    );
                }
                Part::Items(node.first_index..node.first_index + node.prim_count)
            }
            (Part::Items(range), Some(shape)) => {
                let indices = &shape.primitive_indices[range.start as usize..range.end as usize];
                let items = indices.iter().map(|&item| entries.items[item as usize].clone());
                if let [single] = indices {
                    Part::Entries(entries.items[*single as usize].clone())
                } else if items.clone().map(|item| item.len()).sum::<usize>() <= MERGED_LEAF_SIZE {
                    return Opened::Leaf(append(entries, items, triangles));
                } else {
                    let (left, right) = halves(range);
                    return Opened::Inner(Part::Items(left), Part::Items(right));
                }
            }
            (Part::Entries(range), _) if range.len() > LEAF_SIZE => {
                let (left, right) = halves(range);
                return Opened::Inner(Part::Entries(left), Part::Entries(right));
            }
            (Part::Entries(range), _) => {
                return Opened::Leaf(append(entries, std::iter::once(range), triangles));
            }
            (Part::Built(_) | Part::Items(_), None) => unreachable!("balanced trees have no shape"),
        };
    }
}

fn halves(range: Range<u32>) -> (Range<u32>, Range<u32>) {
    let middle = range.start + (range.end - range.start) / 2;
    (range.start..middle, middle..range.end)
}

fn append(
    entries: &Entries,
    ranges: impl Iterator<Item = Range<u32>>,
    triangles: &mut Vec<LeafTriangle>,
) -> Child {
    let first = triangles.len() as u32;
    for range in ranges {
        triangles.extend(&entries.triangles[range.start as usize..range.end as usize]);
    }
    Child { first, count: triangles.len() as u32 - first }
}

/// Computes all boxes. Children come after their parents, so one backward pass is enough.
fn fit(tree: &mut Tree) {
    for index in (0..tree.nodes.len()).rev() {
        for side in 0..2 {
            let bounds = bounds_of(tree, tree.nodes[index].children[side]);
            let planes = &mut tree.nodes[index].planes;
            for axis in 0..3 {
                planes[0][axis][side] = bounds.lo[axis];
                planes[1][axis][side] = bounds.hi[axis];
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
