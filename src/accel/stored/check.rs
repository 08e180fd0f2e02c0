//! Whether what was read is a tree over exactly the triangles of a mesh.

use super::super::bounds::Bounds;
use super::super::entries::canonical_bits;
use super::super::wide::{GROUP, Link, Linked, NO_TRIANGLE, WideTree};
use super::{StoredFault, leaf_links};
use crate::mesh::{TriangleId, TriangleMesh};
use std::collections::HashMap;

/// Checks links and lanes before anything is made of them.
pub(super) fn check(
    tree: &WideTree,
    lanes: &[u32],
    copies: &HashMap<TriangleId, Vec<TriangleId>>,
    mesh: &TriangleMesh,
) -> Result<(), StoredFault> {
    check_nodes(tree)?;
    check_leaves(tree, lanes)?;
    check_triangles(lanes, copies, mesh)
}

/// Every node but the first is the child of exactly one that stands before it; the first is the
/// root, and without nodes all roots are leaves.
fn check_nodes(tree: &WideTree) -> Result<(), StoredFault> {
    const FAULT: StoredFault = StoredFault("its nodes are no tree");
    let mut is_child = vec![false; tree.nodes.len()];
    for (index, node) in tree.nodes.iter().enumerate() {
        if node.count == 0 {
            return Err(FAULT);
        }
        for &link in &node.children[..node.count as usize] {
            if let Linked::Node(below) = Link(link).target() {
                let is_taken = is_child.get_mut(below).ok_or(FAULT)?;
                if below <= index || std::mem::replace(is_taken, true) {
                    return Err(FAULT);
                }
            }
        }
    }
    let has_root = match tree.nodes.len() {
        0 => tree.roots.iter().all(|root| matches!(root.target(), Linked::Leaf(_))),
        _ => tree.roots == [Link(0)],
    };
    if has_root && is_child.iter().skip(1).all(|&is_child| is_child) { Ok(()) } else { Err(FAULT) }
}

/// Every group of lanes belongs to exactly one leaf, and no leaf is empty.
fn check_leaves(tree: &WideTree, lanes: &[u32]) -> Result<(), StoredFault> {
    const FAULT: StoredFault = StoredFault("its leaves do not share out its triangles");
    let mut is_taken = vec![false; lanes.len() / GROUP];
    for leaf in leaf_links(tree) {
        let groups = leaf.first / GROUP..(leaf.first + leaf.count) / GROUP;
        let groups = is_taken.get_mut(groups).ok_or(FAULT)?;
        if groups.contains(&true) {
            return Err(FAULT);
        }
        groups.fill(true);
        let ids = &lanes[leaf.first..leaf.first + leaf.count];
        if ids.iter().all(|&id| id == NO_TRIANGLE) {
            return Err(FAULT);
        }
    }
    if is_taken.contains(&false) { Err(FAULT) } else { Ok(()) }
}

/// Every triangle of the mesh is in one lane, or a copy of one that is, or too thin to be seen.
fn check_triangles(
    lanes: &[u32],
    copies: &HashMap<TriangleId, Vec<TriangleId>>,
    mesh: &TriangleMesh,
) -> Result<(), StoredFault> {
    let mut is_kept = vec![false; mesh.len()];
    let mut keep = |id: u32| match is_kept.get_mut(id as usize) {
        None => Err(StoredFault("it names a triangle that the mesh does not have")),
        Some(true) => Err(StoredFault("a triangle is there twice")),
        Some(is_kept) => {
            *is_kept = true;
            Ok(())
        }
    };
    lanes.iter().filter(|&&id| id != NO_TRIANGLE).try_for_each(|&id| keep(id))?;
    for &other in copies.values().flatten() {
        keep(other.get())?;
    }
    let is_in_a_lane: std::collections::HashSet<u32> = match copies.is_empty() {
        true => std::collections::HashSet::new(),
        false => lanes.iter().copied().collect(),
    };
    for (lowest, others) in copies {
        // Its others were found to be triangles of the mesh; it must be one too.
        if !is_in_a_lane.contains(&lowest.get()) {
            return Err(StoredFault("a copy's triangle is missing"));
        }
        let corners = canonical_bits(&mesh.triangle(*lowest));
        let is_copy =
            |id: &TriangleId| id > lowest && canonical_bits(&mesh.triangle(*id)) == corners;
        if !others.iter().all(is_copy) || !others.is_sorted() {
            return Err(StoredFault("a copy is not one"));
        }
    }
    let is_left_out =
        |id: TriangleId| Bounds::of_triangle(&mesh.triangle(id)).is_thinner_than_a_face();
    let all = mesh.ids().zip(is_kept).all(|(id, is_kept)| is_kept || is_left_out(id));
    if all { Ok(()) } else { Err(StoredFault("a triangle is missing")) }
}
