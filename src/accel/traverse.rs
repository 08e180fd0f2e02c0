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

mod segment;

pub(crate) use segment::Segment;

use super::entries::LeafTriangle;
use super::node::{Child, Tree};
use crate::mutant::{self, Mutant};

/// κ = 1 + 8u, u = 2^-53: see the module's derivation.
const PADDING: f64 = 1.0 + 4.0 * f64::EPSILON;

/// A line that boxes are tested against.
pub(crate) trait MeetsBoxes {
    /// Bounds of the line's parameter inside each of two boxes, `[near, far]` per box; near is at
    /// least 0, far is padded. A box is missed if near > far.
    fn meet(&self, planes: &[[[f32; 2]; 3]; 2]) -> [[f64; 2]; 2];
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
    fn meet(&self, planes: &[[[f32; 2]; 3]; 2]) -> [[f64; 2]; 2] {
        let mut near = [0.0; 2];
        let mut far = [f64::INFINITY; 2];
        let rays = self.eye.iter().zip(&self.reciprocal).zip(&self.near_side);
        for (axis, ((eye, reciprocal), side)) in rays.enumerate() {
            let (first, last) = (planes[side & 1][axis], planes[1 - (side & 1)][axis]);
            for child in 0..2 {
                near[child] = larger((f64::from(first[child]) - eye) * reciprocal, near[child]);
                far[child] = smaller((f64::from(last[child]) - eye) * reciprocal, far[child]);
            }
        }
        if mutant::is(Mutant::UnpaddedSlabs) {
            return [near, far];
        }
        if mutant::is(Mutant::OpenSlabs) {
            return [near, far.map(f64::next_down)];
        }
        [[near[0], near[1]], [far[0] * PADDING, far[1] * PADDING]]
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
fn larger(value: f64, bound: f64) -> f64 {
    if value > bound { value } else { bound }
}

/// The smaller; `bound` when `value` is NaN.
#[inline(always)]
fn smaller(value: f64, bound: f64) -> f64 {
    if value < bound { value } else { bound }
}

/// Subtrees that a ray has met and not entered yet; kept between rays for its memory.
#[derive(Clone, Debug, Default)]
pub(crate) struct Pending(Vec<(Child, f64)>);

impl Tree {
    /// Calls `visit` with the triangles of every leaf that the line meets before its reach, nearer
    /// boxes first where that is cheap to know. `visit` returns the reach from then on: no
    /// triangle whose exact parameter is at most the reach is left out (the comparison is not
    /// strict); −∞ ends the walk.
    pub(super) fn traverse(
        &self,
        boxes: &impl MeetsBoxes,
        pending: &mut Pending,
        mut visit: impl FnMut(&[LeafTriangle]) -> f64,
    ) {
        let Some(mut child) = self.root else { return };
        let mut reach = f64::INFINITY;
        let waiting = &mut pending.0;
        waiting.clear();
        loop {
            if child.count > 0 {
                let range = child.first as usize..(child.first + child.count) as usize;
                reach = visit(&self.triangles[range]) * PADDING;
            } else {
                let node = &self.nodes[child.first as usize];
                let [near, far] = boxes.meet(&node.planes);
                let met: [bool; 2] = std::array::from_fn(|i| near[i] <= far[i] && near[i] <= reach);
                let first = usize::from(near[1] < near[0]);
                match met {
                    [true, true] => {
                        waiting.push((node.children[1 - first], near[1 - first]));
                        child = node.children[first];
                        continue;
                    }
                    [true, false] => {
                        child = node.children[0];
                        continue;
                    }
                    [false, true] => {
                        child = node.children[1];
                        continue;
                    }
                    [false, false] => {}
                }
            }
            child = loop {
                match waiting.pop() {
                    Some((next, near)) if near <= reach => break next,
                    Some(_) => {}
                    None => return,
                }
            };
        }
    }
}
