//! The accelerator: a bounding volume hierarchy that loses no hit.
//!
//! obvhs finds the shape of the tree; boxes are the exact bounds of the triangles, and the walk is
//! our own and conservative (`traverse`), because obvhs' loses hits: it clamps 1/d and does not pad
//! rounding. What a triangle is tested for is the caster's business.

mod bounds;
mod cost;
mod entries;
mod node;
mod preset;
mod stored;
mod topology;
mod traverse;
mod wide;

pub(crate) use entries::LeafTriangle;
pub use preset::BuildPreset;
pub use stored::{StoredFault, TreeKey};
pub(crate) use traverse::{Pending, Segment, Slabs};
pub(crate) use wide::{GROUP, Leaf, Link, Linked, NO_TRIANGLE, WIDTH, WideNode, WideTree};

use crate::mesh::{TriangleId, TriangleMesh};
use node::Tree;
use std::collections::HashMap;

/// Deepest tree that is kept as obvhs made it. Meshes and soups of 10⁵ triangles measure 24 to 40;
/// one deeper than this is a chain, and a balanced tree over the spatial order is better.
const DEEPEST: usize = 96;

/// A hierarchy over the triangles of one mesh.
#[derive(Clone, Debug)]
pub struct Accelerator {
    tree: WideTree,
    /// The other ids of each triangle that is kept for several, under the lowest.
    copies: HashMap<TriangleId, Vec<TriangleId>>,
}

impl Accelerator {
    /// Builds the hierarchy. Triangles that no eye can see, points and segments along an axis, are
    /// left out; bitwise equal ones are kept once, with their number.
    pub fn build(mesh: &TriangleMesh, preset: BuildPreset) -> Self {
        let mut entries = entries::collect(mesh);
        let copies = std::mem::take(&mut entries.copies);
        // What is no longer needed is let go at once: a scene of 16 million triangles is built in
        // less than 6 GiB.
        let tree = match entries.items.len() {
            0 => Tree::default(),
            1 => node::lay_out_balanced(&entries),
            _ => {
                let bounds = std::mem::take(&mut entries.bounds);
                let boxes: Vec<_> = entries
                    .items
                    .iter()
                    .map(|item| {
                        bounds[item.start as usize..item.end as usize]
                            .iter()
                            .fold(bounds::Bounds::EMPTY, |all, one| all.union(*one))
                    })
                    .collect();
                drop(bounds);
                let tree = node::lay_out(&entries, &topology::cluster(boxes, preset));
                if tree.depth > DEEPEST { node::lay_out_balanced(&entries) } else { tree }
            }
        };
        drop(entries);
        Self { tree: wide::widen(&tree), copies }
    }

    /// No hierarchy: every triangle of the mesh in a line, nothing left out or folded. The
    /// reference that a hierarchy's answers are compared with.
    pub fn linear(mesh: &TriangleMesh) -> Self {
        Self { tree: wide::line_up(entries::unordered(mesh)), copies: HashMap::new() }
    }

    /// The tree, for walks by tiles.
    pub(crate) fn tree(&self) -> &WideTree {
        &self.tree
    }

    /// The triangles that are bitwise equal to one of a leaf and kept with it: their ids are higher.
    pub(crate) fn copies_of(&self, id: TriangleId) -> &[TriangleId] {
        self.copies.get(&id).map_or(&[], Vec::as_slice)
    }

    /// Nodes on the longest path from the root, leaves included; 0 for an empty hierarchy.
    pub fn depth(&self) -> usize {
        self.tree.depth
    }

    /// Number of inner nodes.
    pub fn node_count(&self) -> usize {
        self.tree.nodes.len()
    }

    /// Memory of nodes and leaf triangles, in bytes.
    pub fn bytes(&self) -> usize {
        self.tree.bytes()
    }

    /// Expected number of tests, nodes of 16 boxes and groups of 8 triangles, of a random line that
    /// meets the root's box, by the surface area heuristic; `None` for a hierarchy of one leaf or
    /// none, and for one in a line.
    pub fn surface_area_cost(&self) -> Option<f64> {
        self.tree.surface_area_cost()
    }

    /// Visits every triangle that the ray meets within the reach that `visit` returns.
    pub(crate) fn traverse(
        &self,
        slabs: &Slabs,
        pending: &mut Pending,
        visit: impl FnMut(&[LeafTriangle]) -> f64,
    ) {
        self.tree.traverse(&self.copies, slabs, pending, visit);
    }

    /// Visits triangles until `found` says so, among them every one that the segment meets.
    pub(crate) fn search(
        &self,
        segment: &Segment,
        pending: &mut Pending,
        mut found: impl FnMut(&[LeafTriangle]) -> bool,
    ) {
        let ends = |is_found| if is_found { f64::NEG_INFINITY } else { f64::INFINITY };
        self.tree.traverse(&self.copies, segment, pending, |triangles| ends(found(triangles)));
    }
}

#[cfg(test)]
mod tests;
