//! The tree that whole tiles and single rays walk: 16 children a node, leaves of a few dozen
//! triangles in lanes.
//!
//! Made from the binary tree by opening, again and again, the child with the largest area until a
//! node has 16 (I. Wald, C. Benthin, S. Boulos, *Getting rid of packets*, 2008, widen so); a
//! subtree of at most [`LEAF_TRIANGLES`] is a leaf. A node's boxes lie side by side per plane and
//! axis, a leaf's vertices per corner and axis, so that one load fills a vector. Boxes are the
//! exact bounds of what they hold. Nothing is decided here.

use super::bounds::Bounds;
use super::entries::LeafTriangle;
use super::node::{Child, Tree, bounds_of};
use crate::mesh::TriangleId;
use crate::simd::prefetch;

/// Children of a node at most: the lanes of the widest f32 vector.
pub(crate) const WIDTH: usize = 16;

/// Most triangles of a leaf that the tree is cut into. With larger leaves fewer nodes are visited
/// and vectors are fuller, but more triangles are turned away one by one; from 16 to 64 times
/// change by less than a tenth.
const LEAF_TRIANGLES: u32 = 32;

/// Lanes that a leaf is padded to.
pub(crate) const GROUP: usize = 8;

/// Most groups of a leaf: what [`Link`] can say.
const MOST_GROUPS: usize = 16;

/// Cache lines of a node, and of a leaf of three groups, that are asked for ahead.
const NODE_LINES: usize = 8;
const LEAF_LINES: usize = 19;
const ID_LINES: usize = 2;

/// The id of a lane without a triangle.
pub(crate) const NO_TRIANGLE: u32 = u32::MAX;

/// Where a child is. A leaf: bit 31, its number of groups less 1 in bits 27 to 30, its first group
/// below. A node: its index.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Link(pub(crate) u32);

/// What a [`Link`] leads to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Linked {
    Node(usize),
    Leaf(Leaf),
}

/// The triangles of a leaf: lanes `first .. first + count` of the tree, `count` a multiple of
/// [`GROUP`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Leaf {
    pub(crate) first: usize,
    pub(crate) count: usize,
}

impl Link {
    const LEAF: u32 = 1 << 31;
    const GROUP_BITS: u32 = 27;

    fn leaf(first_group: usize, groups: usize) -> Self {
        debug_assert!((1..=MOST_GROUPS).contains(&groups) && first_group < 1 << Self::GROUP_BITS);
        Self(Self::LEAF | (groups as u32 - 1) << Self::GROUP_BITS | first_group as u32)
    }

    /// What it leads to.
    #[inline(always)]
    pub(crate) fn target(self) -> Linked {
        if self.0 & Self::LEAF == 0 {
            return Linked::Node(self.0 as usize);
        }
        let groups = (self.0 >> Self::GROUP_BITS & (MOST_GROUPS as u32 - 1)) as usize + 1;
        let first = (self.0 & ((1 << Self::GROUP_BITS) - 1)) as usize;
        Linked::Leaf(Leaf { first: first * GROUP, count: groups * GROUP })
    }
}

/// A node: `planes[side][axis][child]`, side 0 the lower faces and 1 the upper ones. Lanes from
/// `count` on hold zeros.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub(crate) struct WideNode {
    pub(crate) planes: [[[f32; WIDTH]; 3]; 2],
    pub(crate) children: [u32; WIDTH],
    pub(crate) count: u32,
}

/// The tree.
#[derive(Clone, Debug, Default)]
pub(crate) struct WideTree {
    pub(crate) nodes: Vec<WideNode>,
    /// Per leaf nine rows of `count` lanes: x, y, z of corner 0, of corner 1, of corner 2. A leaf's
    /// rows begin at nine times its first lane; [`WIDTH`] zeros end the array, so that a vector can
    /// be loaded from any lane.
    pub(crate) vertices: Vec<f32>,
    /// Per lane the triangle's id, [`NO_TRIANGLE`] where padded; ends as `vertices` does.
    pub(crate) ids: Vec<u32>,
    /// Where a walk begins: the root, or every leaf of a tree without a hierarchy.
    pub(crate) roots: Vec<Link>,
    /// Largest magnitude of a coordinate per axis.
    pub(crate) reach: [f32; 3],
    /// Nodes on the longest path, leaves included; 0 for an empty tree.
    pub(super) depth: usize,
    /// Whether the leaves stand for no hierarchy: nothing in them is left out.
    pub(super) is_linear: bool,
}

/// A node that waits to be filled.
struct Waiting {
    node: usize,
    depth: usize,
    children: Vec<Child>,
}

/// Widens a binary tree.
pub(super) fn widen(tree: &Tree) -> WideTree {
    let mut wide = WideTree::default();
    let Some(root) = tree.root else { return wide };
    let spans = spans(tree);
    let span_of = |child: Child| match child.count {
        0 => spans[child.first as usize],
        count => [child.first, child.first + count],
    };
    // Room for padding, so that nothing is copied in growing; memory that is not written costs none.
    let lanes = tree.triangles.len() * 3 / 2 + WIDTH;
    wide.vertices.reserve(9 * lanes);
    wide.ids.reserve(lanes);
    let whole = bounds_of(tree, root);
    wide.reach = std::array::from_fn(|k| whole.lo[k].abs().max(whole.hi[k].abs()));
    let [first, end] = span_of(root);
    if end - first <= LEAF_TRIANGLES || root.count > 0 {
        wide.depth = 1;
        wide.roots = push_leaves(&mut wide, tree, [first, end]);
        pad(&mut wide);
        return wide;
    }
    let is_leaf = |child: Child| {
        let [first, end] = span_of(child);
        child.count > 0 || end - first <= LEAF_TRIANGLES
    };
    wide.roots = vec![Link(0)];
    wide.nodes.push(EMPTY_NODE);
    let mut waiting = vec![Waiting { node: 0, depth: 1, children: opened(tree, root, is_leaf) }];
    while let Some(Waiting { node, depth, children }) = waiting.pop() {
        wide.depth = wide.depth.max(depth + 1);
        for (lane, &child) in children.iter().enumerate() {
            let bounds = bounds_of(tree, child);
            let link = if is_leaf(child) {
                push_leaf(&mut wide, tree, span_of(child))
            } else {
                let below = wide.nodes.len();
                wide.nodes.push(EMPTY_NODE);
                let children = opened(tree, child, is_leaf);
                waiting.push(Waiting { node: below, depth: depth + 1, children });
                Link(below as u32)
            };
            let filled = &mut wide.nodes[node];
            for axis in 0..3 {
                filled.planes[0][axis][lane] = bounds.lo[axis];
                filled.planes[1][axis][lane] = bounds.hi[axis];
            }
            filled.children[lane] = link.0;
            filled.count = lane as u32 + 1;
        }
    }
    pad(&mut wide);
    wide
}

/// A node without children.
pub(super) const EMPTY_NODE: WideNode =
    WideNode { planes: [[[0.0; WIDTH]; 3]; 2], children: [0; WIDTH], count: 0 };

/// The range of triangles below each node. Children come after their parents.
fn spans(tree: &Tree) -> Vec<[u32; 2]> {
    let mut spans = vec![[0; 2]; tree.nodes.len()];
    for index in (0..tree.nodes.len()).rev() {
        let [left, right] = tree.nodes[index].children.map(|child| match child.count {
            0 => spans[child.first as usize],
            count => [child.first, child.first + count],
        });
        spans[index] = [left[0].min(right[0]), left[1].max(right[1])];
    }
    spans
}

/// The children of the wide node that stands for an inner node of the binary tree.
fn opened(tree: &Tree, node: Child, is_leaf: impl Fn(Child) -> bool) -> Vec<Child> {
    let mut children: Vec<(Child, f64)> = Vec::with_capacity(WIDTH);
    let mut open = node;
    loop {
        for child in tree.nodes[open.first as usize].children {
            let area = if is_leaf(child) { -1.0 } else { half_area(bounds_of(tree, child)) };
            children.push((child, area));
        }
        let largest = (0..children.len()).max_by(|&a, &b| children[a].1.total_cmp(&children[b].1));
        match largest.filter(|&i| children[i].1 >= 0.0 && children.len() < WIDTH) {
            Some(i) => open = children.swap_remove(i).0,
            None => return children.into_iter().map(|(child, _)| child).collect(),
        }
    }
}

fn half_area(bounds: Bounds) -> f64 {
    let [x, y, z] = bounds.sides();
    x * y + y * z + z * x
}

/// A range of triangles as leaves of at most [`MOST_GROUPS`] groups.
fn push_leaves(wide: &mut WideTree, tree: &Tree, [first, end]: [u32; 2]) -> Vec<Link> {
    let most = (MOST_GROUPS * GROUP) as u32;
    (first..end)
        .step_by(most as usize)
        .map(|from| push_leaf(wide, tree, [from, end.min(from + most)]))
        .collect()
}

fn push_leaf(wide: &mut WideTree, tree: &Tree, [first, end]: [u32; 2]) -> Link {
    let triangles: &[LeafTriangle] = &tree.triangles[first as usize..end as usize];
    let groups = triangles.len().div_ceil(GROUP);
    let link = Link::leaf(wide.ids.len() / GROUP, groups);
    let padding = groups * GROUP - triangles.len();
    for corner in 0..3 {
        for axis in 0..3 {
            wide.vertices.extend(triangles.iter().map(|t| t.vertices[corner][axis]));
            wide.vertices.extend(std::iter::repeat_n(0.0, padding));
        }
    }
    wide.ids.extend(triangles.iter().map(|t| t.id.get()));
    wide.ids.extend(std::iter::repeat_n(NO_TRIANGLE, padding));
    link
}

/// Appends the lanes of a leaf by their ids, [`NO_TRIANGLE`] where padded.
pub(super) fn push_lanes(
    wide: &mut WideTree,
    ids: &[u32],
    vertices_of: impl Fn(u32) -> [[f32; 3]; 3],
) {
    for corner in 0..3 {
        for axis in 0..3 {
            let position = |&id: &u32| match id {
                NO_TRIANGLE => 0.0,
                id => vertices_of(id)[corner][axis],
            };
            wide.vertices.extend(ids.iter().map(position));
        }
    }
    wide.ids.extend_from_slice(ids);
}

/// Ends the arrays of lanes.
pub(super) fn pad(wide: &mut WideTree) {
    wide.vertices.extend([0.0; WIDTH]);
    wide.ids.extend([NO_TRIANGLE; WIDTH]);
    wide.vertices.shrink_to_fit();
    wide.ids.shrink_to_fit();
    wide.nodes.shrink_to_fit();
}

/// No hierarchy: leaves over all triangles, in their order.
pub(super) fn line_up(triangles: Vec<LeafTriangle>) -> WideTree {
    let count = triangles.len() as u32;
    let root = (count > 0).then_some(Child { first: 0, count });
    let tree = Tree { root, depth: 1, nodes: Vec::new(), triangles };
    WideTree { is_linear: true, ..widen(&tree) }
}

impl WideTree {
    /// Memory of nodes and lanes, in bytes.
    pub(super) fn bytes(&self) -> usize {
        size_of_val(&self.nodes[..]) + size_of_val(&self.vertices[..]) + size_of_val(&self.ids[..])
    }

    /// Asks for what a link leads to, before it is needed. Between pushing a child and entering it a
    /// walk by tiles does some hundred nanoseconds of other work, and scenes are larger than caches.
    #[inline(always)]
    pub(crate) fn prefetch(&self, link: Link) {
        match link.target() {
            Linked::Node(index) => prefetch(&self.nodes[index..index + 1], NODE_LINES),
            Linked::Leaf(leaf) => {
                prefetch(&self.vertices[9 * leaf.first..9 * (leaf.first + leaf.count)], LEAF_LINES);
                prefetch(&self.ids[leaf.first..leaf.first + leaf.count], ID_LINES);
            }
        }
    }

    /// The triangle in a lane of a leaf.
    #[inline(always)]
    pub(crate) fn triangle(&self, leaf: Leaf, lane: usize) -> Option<(TriangleId, [[f32; 3]; 3])> {
        let id = self.ids[leaf.first + lane];
        let row = |r: usize| self.vertices[9 * leaf.first + r * leaf.count + lane];
        (id != NO_TRIANGLE).then(|| {
            let vertices =
                std::array::from_fn(|corner| std::array::from_fn(|axis| row(3 * corner + axis)));
            (TriangleId::new(id), vertices)
        })
    }
}
