//! Conservative traversal: every triangle that a ray meets within reach is visited.
//!
//! The slab test runs in f64 on exact inputs: the eye and the direction are f64, boxes are f32.
//! Let u = 2^-53. A slab bound t = (b − e)/d is computed as fl(fl(b − e)·fl(1/d)), three roundings,
//! so |t̂ − t| ≤ γ₃|t| with γ₃ = 3u/(1 − 3u), and t̂ has the sign of t and is 0 exactly with it.
//! Nothing under- or overflows: b − e is 0 or 2^-149…2^127 and d, a multiple of 2^-53 not above 1,
//! has a reciprocal in 1…2^53.
//!
//! If the ray meets the box, then t_near ≤ t_far for the exact bounds, hence, where they are not
//! negative, t̂_near ≤ (1 + γ₃)/(1 − γ₃)·t̂_far. Multiplying t̂_far by κ rounds once more, so κ
//! must be at least (1 + γ₃)/((1 − γ₃)(1 − u)) = 1 + 7u + O(u²): κ = 1 + 8u. (Measured over
//! millions of corner-grazing rays by others: up to 5.75u is needed.) The reach of the ray is
//! compared with t̂_near too and padded by the same κ ≥ (1 + γ₃)/(1 − u).
//!
//! A direction component of ±0 gets the reciprocal +∞: a slab that contains the eye strictly is
//! (−∞, ∞), one that does not is empty, and where the eye lies on a face, 0·∞ = NaN leaves the
//! bound as it is, because `larger` and `smaller` return the other operand then: slabs are closed.
//!
//! All boxes of a node are tested at once, in f64 lanes, and the box of every triangle of a leaf
//! likewise, so that a caller sees the triangles whose own box the line meets and no others.

mod segment;

pub(crate) use segment::Segment;

use super::entries::LeafTriangle;
use super::wide::{GROUP, Leaf, Link, Linked, WIDTH, WideTree};
use crate::mesh::TriangleId;
use crate::mutant::{self, Mutant};
use crate::simd::SimdLevel;
use fearless_simd::{Level, Select, Simd, SimdBase, SimdMask, SimdWiden, dispatch, f32x16, f64x8};
use std::collections::HashMap;

/// κ = 1 + 8u, u = 2^-53: see the module's derivation.
const PADDING: f64 = 1.0 + 4.0 * f64::EPSILON;

/// Planes of eight boxes: `planes[side][axis]`, side 0 the lower faces and 1 the upper ones.
pub(crate) type Planes<S> = [[f64x8<S>; 3]; 2];

/// A line that boxes are tested against.
pub(crate) trait MeetsBoxes {
    /// Bounds of the line's parameter inside each of eight boxes, near and far; near is at least 0,
    /// far is padded. A box is missed if near > far.
    fn meet<S: Simd>(&self, simd: S, planes: &Planes<S>) -> [f64x8<S>; 2];
}

/// A ray as the slab test wants it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slabs {
    eye: [f64; 3],
    reciprocal: [f64; 3],
    /// Per axis, the side of a box that the ray meets first: 0 lower, 1 upper.
    near_side: [usize; 3],
}

impl Slabs {
    /// The ray e + t·d; each component of `direction` is 0 or 2^-53…1 in magnitude.
    pub(crate) fn new(eye: [f64; 3], direction: [f64; 3]) -> Self {
        Self {
            eye,
            reciprocal: direction.map(reciprocal),
            near_side: direction.map(|d| usize::from(d < 0.0)),
        }
    }
}

impl MeetsBoxes for Slabs {
    #[inline(always)]
    fn meet<S: Simd>(&self, simd: S, planes: &Planes<S>) -> [f64x8<S>; 2] {
        let mut near = f64x8::splat(simd, 0.0);
        let mut far = f64x8::splat(simd, f64::INFINITY);
        for axis in 0..3 {
            let side = self.near_side[axis] & 1;
            let (first, last) = (planes[side][axis], planes[1 - side][axis]);
            let eye = f64x8::splat(simd, self.eye[axis]);
            let reciprocal = f64x8::splat(simd, self.reciprocal[axis]);
            near = larger((first - eye) * reciprocal, near);
            far = smaller((last - eye) * reciprocal, far);
        }
        if mutant::is(Mutant::UnpaddedSlabs) {
            return [near, far];
        }
        if mutant::is(Mutant::OpenSlabs) {
            return [near, far * f64x8::splat(simd, 1.0 - 2.0 * f64::EPSILON)];
        }
        [near, far * f64x8::splat(simd, PADDING)]
    }
}

/// 1/d, +∞ for a component of 0.
#[inline(always)]
fn reciprocal(d: f64) -> f64 {
    if mutant::is(Mutant::ClampedReciprocal) && d.abs() < 2.0_f64.powi(-23) {
        return 2.0_f64.powi(23).copysign(d);
    }
    if mutant::is(Mutant::FiniteReciprocal) && d == 0.0 {
        return f64::MAX;
    }
    if d == 0.0 { f64::INFINITY } else { 1.0 / d }
}

/// The larger; `bound` when `value` is NaN.
#[inline(always)]
fn larger<S: Simd>(value: f64x8<S>, bound: f64x8<S>) -> f64x8<S> {
    value.simd_gt(bound).select(value, bound)
}

/// The smaller; `bound` when `value` is NaN.
#[inline(always)]
fn smaller<S: Simd>(value: f64x8<S>, bound: f64x8<S>) -> f64x8<S> {
    value.simd_lt(bound).select(value, bound)
}

/// Subtrees that a ray has met and not entered yet; kept between rays for its memory.
#[derive(Clone, Debug)]
pub(crate) struct Pending {
    waiting: Vec<(Link, f64)>,
    level: Level,
}

impl Pending {
    /// For walks on this instruction set.
    pub(crate) fn new(level: SimdLevel) -> Self {
        Self { waiting: Vec::new(), level: level.dispatched() }
    }
}

impl Default for Pending {
    fn default() -> Self {
        Self::new(SimdLevel::best())
    }
}

/// Sixteen boxes as a line met them.
struct Met {
    near: [f64; WIDTH],
    /// Bit per box that is met within reach.
    boxes: u32,
}

impl WideTree {
    /// Calls `visit` with every triangle whose box the line meets before its reach, nearer nodes
    /// first. `visit` returns the reach from then on: no triangle whose exact parameter is at most
    /// the reach is left out (the comparison is not strict); −∞ ends the walk. `copies` holds the
    /// other ids of triangles that are kept for several.
    pub(super) fn traverse(
        &self,
        copies: &HashMap<TriangleId, Vec<TriangleId>>,
        line: &impl MeetsBoxes,
        pending: &mut Pending,
        mut visit: impl FnMut(&[LeafTriangle]) -> f64,
    ) {
        let Pending { waiting, level } = pending;
        dispatch!(*level, simd => walk(simd, self, copies, line, waiting, &mut visit));
    }
}

/// The walk, compiled for one instruction set; what it visits need not be.
#[inline(always)]
fn walk<S: Simd>(
    simd: S,
    tree: &WideTree,
    copies: &HashMap<TriangleId, Vec<TriangleId>>,
    line: &impl MeetsBoxes,
    waiting: &mut Vec<(Link, f64)>,
    visit: &mut impl FnMut(&[LeafTriangle]) -> f64,
) {
    let mut reach = f64::INFINITY;
    waiting.clear();
    waiting.extend(tree.roots.iter().rev().map(|&root| (root, 0.0)));
    while let Some((link, near)) = waiting.pop() {
        if near > reach {
            continue;
        }
        let leaf = match link.target() {
            Linked::Leaf(leaf) => leaf,
            Linked::Node(index) => {
                let node = &tree.nodes[index];
                let there = (1_u32 << node.count.min(WIDTH as u32)) - 1;
                let met = meet_planes(simd, line, &node.planes, reach);
                push(waiting, &met, met.boxes & there, &node.children);
                continue;
            }
        };
        let mut first = 0;
        while first < leaf.count {
            // A mirror image needs that its box behind the eye is let through too.
            let met = if tree.is_linear || mutant::is(Mutant::MirrorGhost) {
                Met { near: [0.0; WIDTH], boxes: u32::MAX }
            } else {
                meet_triangles(simd, line, tree, leaf, first, reach)
            };
            let lanes = (leaf.count - first).min(WIDTH);
            let mut left = met.boxes & (u32::MAX >> (32 - lanes));
            while left != 0 {
                let lane = left.trailing_zeros() as usize;
                left &= left - 1;
                if met.near[lane] > reach {
                    continue;
                }
                let Some((id, vertices)) = tree.triangle(leaf, first + lane) else { continue };
                let others = if copies.is_empty() { None } else { copies.get(&id) };
                let copies = 1 + others.map_or(0, |others| others.len() as u32);
                let triangle = LeafTriangle { vertices, id, copies };
                reach = visit(std::slice::from_ref(&triangle)) * PADDING;
            }
            first += WIDTH;
        }
    }
}

/// Puts children on the stack, the nearest on top.
#[inline(always)]
fn push(waiting: &mut Vec<(Link, f64)>, met: &Met, boxes: u32, children: &[u32; WIDTH]) {
    let bottom = waiting.len();
    let mut left = boxes;
    while left != 0 {
        let lane = left.trailing_zeros() as usize;
        left &= left - 1;
        let near = met.near[lane];
        waiting.push((Link(children[lane]), near));
        let mut at = waiting.len() - 1;
        while at > bottom && waiting[at - 1].1 < near {
            waiting.swap(at - 1, at);
            at -= 1;
        }
    }
}

/// The boxes of a node.
#[inline(always)]
fn meet_planes<S: Simd>(
    simd: S,
    line: &impl MeetsBoxes,
    planes: &[[[f32; WIDTH]; 3]; 2],
    reach: f64,
) -> Met {
    let mut vectors = [[f32x16::splat(simd, 0.0); 3]; 2];
    for side in 0..2 {
        for axis in 0..3 {
            vectors[side][axis] = f32x16::load_array_ref(simd, &planes[side][axis]);
        }
    }
    meet_sixteen(simd, line, &vectors, reach)
}

/// The boxes of sixteen triangles of a leaf. Minimum and maximum of f32 do not round.
#[inline(always)]
fn meet_triangles<S: Simd>(
    simd: S,
    line: &impl MeetsBoxes,
    tree: &WideTree,
    leaf: Leaf,
    first: usize,
    reach: f64,
) -> Met {
    let rows = &tree.vertices[9 * leaf.first..9 * (leaf.first + leaf.count) + WIDTH];
    let mut vectors = [[f32x16::splat(simd, 0.0); 3]; 2];
    for axis in 0..3 {
        let at = axis * leaf.count + first;
        let mut lo = f32x16::from_slice(simd, &rows[at..at + WIDTH]);
        let mut hi = lo;
        for corner in 1..3 {
            let at = (3 * corner + axis) * leaf.count + first;
            let mut other = f32x16::from_slice(simd, &rows[at..at + WIDTH]);
            if mutant::is(Mutant::EdgeBoxes) {
                let first = f32x16::from_slice(simd, &rows[axis * leaf.count + first..][..WIDTH]);
                other = first - (first - other);
            }
            (lo, hi) = (lo.min(other), hi.max(other));
        }
        (vectors[0][axis], vectors[1][axis]) = (lo, hi);
    }
    meet_sixteen(simd, line, &vectors, reach)
}

#[inline(always)]
fn meet_sixteen<S: Simd>(
    simd: S,
    line: &impl MeetsBoxes,
    vectors: &[[f32x16<S>; 3]; 2],
    reach: f64,
) -> Met {
    let mut halves = [[[f64x8::splat(simd, 0.0); 3]; 2]; 2];
    for side in 0..2 {
        for axis in 0..3 {
            let (low, high) = vectors[side][axis].widen();
            halves[0][side][axis] = low;
            halves[1][side][axis] = high;
        }
    }
    let mut met = Met { near: [0.0; WIDTH], boxes: 0 };
    let reach = f64x8::splat(simd, reach);
    for half in 0..2 {
        let [near, far] = line.meet(simd, &halves[half]);
        let bits = (near.simd_le(far) & near.simd_le(reach)).to_bitmask() as u32;
        met.boxes |= bits << (half * GROUP);
        near.store_slice(&mut met.near[half * GROUP..(half + 1) * GROUP]);
    }
    met
}
