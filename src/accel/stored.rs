//! A tree as bytes, to be kept, and back.
//!
//! Only what the builder decided is kept: which triangles share a leaf and which children a node
//! has. Vertices come from the mesh and boxes from the vertices, as after a build, so that no number
//! of a file reaches a ray; what is read is checked to be a tree over exactly the triangles of the
//! mesh ([`check`]). A file that a build did not write can make rays slow, never wrong.
//!
//! Layout, little endian: 8 bytes of magic, the key, four u32 (nodes, groups of lanes, roots, words
//! of copies), then as u32 the nodes (number of children, and their links), the roots, the ids of
//! all lanes, the copies (lowest id, number of others, the others); at last the SHA-256 of all that.

mod check;

use super::bounds::Bounds;
use super::wide::{
    EMPTY_NODE, GROUP, Leaf, Link, Linked, NO_TRIANGLE, WIDTH, WideNode, WideTree, pad, push_lanes,
};
use super::{Accelerator, BuildPreset};
use crate::mesh::{TriangleId, TriangleMesh};
use sha2::{Digest as _, Sha256};
use std::collections::HashMap;

/// What files begin with; the last byte counts changes of the layout or of what builds make.
const MAGIC: [u8; 8] = *b"tcbvh\0\0\x01";

/// Bytes before the words: magic, key, four numbers.
const HEAD: usize = 8 + 32 + 16;

/// Bytes after them.
const DIGEST: usize = 32;

/// Names the tree that a preset makes of a mesh: a digest of positions, corners, preset and layout.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TreeKey([u8; 32]);

impl TreeKey {
    /// The key of a mesh's tree.
    pub fn new(mesh: &TriangleMesh, preset: BuildPreset) -> Self {
        /// Numbers that are hashed at a time, so that no second mesh is held.
        const AT_ONCE: usize = 4096;
        let mut digest = Sha256::new();
        digest.update(MAGIC);
        digest.update([preset as u8]);
        digest.update((mesh.positions.len() as u64).to_le_bytes());
        let mut hash = |words: &mut dyn Iterator<Item = u32>| {
            let mut bytes = Vec::with_capacity(4 * AT_ONCE);
            for word in words {
                bytes.extend(word.to_le_bytes());
                if bytes.len() == 4 * AT_ONCE {
                    digest.update(&bytes);
                    bytes.clear();
                }
            }
            digest.update(&bytes);
        };
        hash(&mut mesh.positions.as_flattened().iter().map(|number| number.to_bits()));
        hash(&mut mesh.corners.as_flattened().iter().copied());
        Self(digest.finalize().into())
    }

    /// As 64 hexadecimal digits.
    pub fn to_hex(self) -> String {
        self.0.iter().map(|byte| format!("{byte:02x}")).collect()
    }
}

/// Why bytes are not the tree that was asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct StoredFault(&'static str);

impl Accelerator {
    /// Most bytes that [`Self::to_bytes`] makes of a tree over so many triangles: 8 lanes and a node
    /// of its own for each, and its copy.
    pub const fn most_bytes(triangles: usize) -> usize {
        HEAD + DIGEST + 4 * (triangles + 1) * (GROUP + WIDTH + 1 + 3)
    }

    /// The tree as bytes.
    pub fn to_bytes(&self, key: TreeKey) -> Vec<u8> {
        let tree = &self.tree;
        let mut words = Vec::new();
        for node in &tree.nodes {
            words.push(node.count);
            words.extend_from_slice(&node.children[..node.count as usize]);
        }
        words.extend(tree.roots.iter().map(|root| root.0));
        let lanes = lanes(tree);
        words.extend_from_slice(lanes);
        // The map's own order differs between runs.
        let mut copies: Vec<_> = self.copies.iter().collect();
        copies.sort_unstable_by_key(|(lowest, _)| **lowest);
        let before = words.len();
        for (lowest, others) in copies {
            words.extend([lowest.get(), others.len() as u32]);
            words.extend(others.iter().map(|id| id.get()));
        }
        let numbers =
            [tree.nodes.len(), lanes.len() / GROUP, tree.roots.len(), words.len() - before];
        let mut bytes = Vec::with_capacity(HEAD + 4 * words.len() + DIGEST);
        bytes.extend(MAGIC);
        bytes.extend(key.0);
        bytes.extend(numbers.iter().flat_map(|&number| (number as u32).to_le_bytes()));
        bytes.extend(words.iter().flat_map(|word| word.to_le_bytes()));
        let digest = Sha256::digest(&bytes);
        bytes.extend(digest);
        bytes
    }

    /// The tree of a mesh from bytes that [`Self::to_bytes`] made for this key.
    ///
    /// # Errors
    /// What is wrong with the bytes, if anything is.
    pub fn from_bytes(
        bytes: &[u8],
        key: TreeKey,
        mesh: &TriangleMesh,
    ) -> Result<Self, StoredFault> {
        let mut words = open(bytes, key)?;
        let [nodes, groups, roots, copies] = words.numbers::<4>()?;
        let mut tree = WideTree::default();
        for _ in 0..nodes {
            let [count] = words.numbers()?;
            let links = words.take(count)?;
            let mut node = EMPTY_NODE;
            let children = node.children.get_mut(..count);
            children.ok_or(StoredFault("a node has too many children"))?.copy_from_slice(&links);
            node.count = count as u32;
            tree.nodes.push(node);
        }
        tree.roots = words.take(roots)?.into_iter().map(Link).collect();
        let lanes = words.take(groups.checked_mul(GROUP).ok_or(SHORT)?)?;
        let copies = read_copies(&words.take(copies)?)?;
        if !words.0.is_empty() {
            return Err(StoredFault("bytes are left over"));
        }
        check::check(&tree, &lanes, &copies, mesh)?;
        fill(&mut tree, &lanes, mesh)?;
        Ok(Self { tree, copies })
    }
}

const SHORT: StoredFault = StoredFault("it is cut short");

/// The ids of all lanes, without the end of the array.
fn lanes(tree: &WideTree) -> &[u32] {
    &tree.ids[..tree.ids.len().saturating_sub(WIDTH)]
}

/// Checks magic, key and digest; what is left are the numbers and words.
fn open(bytes: &[u8], key: TreeKey) -> Result<Words<'_>, StoredFault> {
    let (content, digest) = bytes.split_last_chunk::<DIGEST>().ok_or(SHORT)?;
    if content.len() < HEAD {
        return Err(SHORT);
    }
    if content[..8] != MAGIC {
        return Err(StoredFault("it is no tree of this version"));
    }
    if content[8..40] != key.0 {
        return Err(StoredFault("it is the tree of another mesh or preset"));
    }
    if Sha256::digest(content)[..] != digest[..] {
        return Err(StoredFault("its digest is not that of its bytes"));
    }
    Ok(Words(&content[40..]))
}

/// Words that are still to be read.
struct Words<'a>(&'a [u8]);

impl Words<'_> {
    fn take(&mut self, count: usize) -> Result<Vec<u32>, StoredFault> {
        let length = count.checked_mul(4).ok_or(SHORT)?;
        let (taken, rest) = self.0.split_at_checked(length).ok_or(SHORT)?;
        self.0 = rest;
        let (words, _) = taken.as_chunks();
        Ok(words.iter().map(|&word| u32::from_le_bytes(word)).collect())
    }

    fn numbers<const N: usize>(&mut self) -> Result<[usize; N], StoredFault> {
        let words = self.take(N)?;
        Ok(std::array::from_fn(|k| words[k] as usize))
    }
}

fn read_copies(mut words: &[u32]) -> Result<HashMap<TriangleId, Vec<TriangleId>>, StoredFault> {
    const FAULT: StoredFault = StoredFault("its list of equal triangles is torn");
    let id = |word: u32| if word == NO_TRIANGLE { Err(FAULT) } else { Ok(TriangleId::new(word)) };
    let mut copies = HashMap::new();
    while let [lowest, count, rest @ ..] = words {
        let (others, rest) = rest.split_at_checked(*count as usize).ok_or(FAULT)?;
        let others = others.iter().map(|&other| id(other)).collect::<Result<Vec<_>, _>>()?;
        if others.is_empty() || copies.insert(id(*lowest)?, others).is_some() {
            return Err(FAULT);
        }
        words = rest;
    }
    if words.is_empty() { Ok(copies) } else { Err(FAULT) }
}

/// Gives lanes their vertices and nodes their boxes, as a build does.
fn fill(tree: &mut WideTree, lanes: &[u32], mesh: &TriangleMesh) -> Result<(), StoredFault> {
    // Leaves stand in any order; each fills its own rows.
    let mut leaves: Vec<Leaf> = leaf_links(tree).collect();
    leaves.sort_unstable_by_key(|leaf| leaf.first);
    for leaf in leaves {
        let ids = &lanes[leaf.first..leaf.first + leaf.count];
        push_lanes(tree, ids, |id| mesh.triangle(TriangleId::new(id)));
    }
    if !tree.roots.is_empty() {
        pad(tree);
    }
    // Children come after their parents: boxes from the end, depths from the front.
    let mut boxes = vec![Bounds::EMPTY; tree.nodes.len()];
    let box_of = |link: Link, boxes: &[Bounds]| match link.target() {
        Linked::Node(below) => boxes[below],
        Linked::Leaf(leaf) => lanes[leaf.first..leaf.first + leaf.count]
            .iter()
            .filter(|&&id| id != NO_TRIANGLE)
            .map(|&id| Bounds::of_triangle(&mesh.triangle(TriangleId::new(id))))
            .fold(Bounds::EMPTY, Bounds::union),
    };
    for index in (0..tree.nodes.len()).rev() {
        let node = &mut tree.nodes[index];
        for lane in 0..node.count as usize {
            let bounds = box_of(Link(node.children[lane]), &boxes);
            set_box(node, lane, bounds);
            boxes[index] = boxes[index].union(bounds);
        }
    }
    let whole = tree.roots.iter().map(|&root| box_of(root, &boxes));
    let whole = whole.fold(Bounds::EMPTY, Bounds::union);
    if !tree.roots.is_empty() {
        tree.reach = std::array::from_fn(|k| whole.lo[k].abs().max(whole.hi[k].abs()));
    }
    tree.depth = usize::from(!tree.roots.is_empty());
    let mut depths = vec![1; tree.nodes.len()];
    for index in 0..tree.nodes.len() {
        tree.depth = tree.depth.max(depths[index] + 1);
        let node = &tree.nodes[index];
        for &link in &node.children[..node.count as usize] {
            if let Linked::Node(below) = Link(link).target() {
                depths[below] = depths[index] + 1;
            }
        }
    }
    if tree.depth > super::DEEPEST + 1 {
        return Err(StoredFault("it is deeper than any tree that is built"));
    }
    Ok(())
}

/// All leaves below roots and nodes.
fn leaf_links(tree: &WideTree) -> impl Iterator<Item = Leaf> {
    let children =
        tree.nodes.iter().flat_map(|node| &node.children[..node.count as usize]).copied();
    let links = tree.roots.iter().map(|root| root.0).chain(children);
    links.filter_map(|link| match Link(link).target() {
        Linked::Leaf(leaf) => Some(leaf),
        Linked::Node(_) => None,
    })
}

fn set_box(node: &mut WideNode, lane: usize, bounds: Bounds) {
    for axis in 0..3 {
        node.planes[0][axis][lane] = bounds.lo[axis];
        node.planes[1][axis][lane] = bounds.hi[axis];
    }
}

#[cfg(test)]
mod tests;
