//! Any-hit traversal along a segment whose start is only known to lie in a small cube.
//!
//! The start is x = x̂ + η with |η_k| ≤ δ. Towards a point l the segment is x + s·(l − x) =
//! x̂ + s·(l − x̂) + (1 − s)·η, 0 ≤ s ≤ 1; along a direction it is x̂ + s·l + η, s ≥ 0. Either way
//! it stays within δ of the segment from x̂, so what it meets, the segment from x̂ meets when
//! every box is blown up by δ. A slab bound is then (b − (x̂ ± δ))/λ, and x̂ ± δ is rounded
//! outwards once per segment.
//!
//! The slab test: with u = 2^-53, b − (x̂ ± δ) rounds once, λ = l − x̂ has rounded once before it
//! came here, its reciprocal rounds and the product rounds: a relative error of at most γ₄ on each
//! bound, and signs and zeros are right. As in the parent module κ must be at least
//! (1 + γ₄)/((1 − γ₄)(1 − u)) = 1 + 9u + O(u²); κ = 1 + 16u. The reach 1 is compared with the
//! same κ.
//!
//! Range: a component of λ of magnitude 2^-400…2^400 is taken as it is, so that reciprocals and
//! products are finite (numerators are below 2^129) and only the lowest products underflow, by at
//! most 2^-1074 each, for which 2^-960 is added to the far bound. A component of 0 gets +∞ and is
//! handled as in the parent module. Any other gets NaN, for which `larger` and `smaller` leave the
//! bound as it is: the axis constrains nothing, and the worst that happens is that all is visited.

use super::{MeetsBoxes, Planes, larger, smaller};
use fearless_simd::{Simd, SimdBase, f64x8};

/// κ = 1 + 16u, u = 2^-53: see the module's derivation.
const PADDING: f64 = 1.0 + 8.0 * f64::EPSILON;

/// 2^-960: more than products lose by underflow.
const UNDERFLOW: f64 = f64::MIN_POSITIVE * (1_u64 << 62) as f64;

/// Smallest and largest magnitude of a component of λ that constrains the walk: 2^±400.
const RANGE: [f64; 2] = [f64::from_bits((1023 - 400) << 52), f64::from_bits((1023 + 400) << 52)];

/// A segment as the slab test wants it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Segment {
    /// Per axis, x̂ moved by δ so that a box is entered earlier, and so that it is left later.
    origin: [[f64; 3]; 2],
    reciprocal: [f64; 3],
    /// Per axis, the side of a box that the segment meets first: 0 lower, 1 upper.
    near_side: [usize; 3],
    /// Largest s, padded.
    reach: f64,
}

impl Segment {
    /// The segment from within `error` (per axis) of `start`; `toward` is good to a relative u per
    /// component. It ends at s = `reach`, 1 or infinity. Numbers that are not finite make a segment
    /// that meets everything.
    pub(crate) fn new(start: [f64; 3], error: f64, toward: [f64; 3], reach: f64) -> Self {
        let known = error.is_finite() && start.iter().all(|c| c.is_finite());
        let near_side = toward.map(|d| usize::from(d < 0.0));
        let [above, below] =
            [start.map(|c| (c + error).next_up()), start.map(|c| (c - error).next_down())];
        let pick = |side: usize| {
            std::array::from_fn(|k| if near_side[k] == side { above[k] } else { below[k] })
        };
        let reciprocal = toward.map(|d| {
            if !known {
                f64::NAN
            } else if d == 0.0 {
                f64::INFINITY
            } else if (RANGE[0]..=RANGE[1]).contains(&d.abs()) {
                1.0 / d
            } else {
                f64::NAN
            }
        });
        Self { origin: [pick(0), pick(1)], reciprocal, near_side, reach: reach * PADDING }
    }
}

impl MeetsBoxes for Segment {
    /// Far is at most the reach of the segment.
    #[inline(always)]
    fn meet<S: Simd>(&self, simd: S, planes: &Planes<S>) -> [f64x8<S>; 2] {
        let mut near = f64x8::splat(simd, 0.0);
        let mut far = f64x8::splat(simd, f64::INFINITY);
        for axis in 0..3 {
            let side = self.near_side[axis] & 1;
            let (first, last) = (planes[side][axis], planes[1 - side][axis]);
            let enter = f64x8::splat(simd, self.origin[0][axis]);
            let leave = f64x8::splat(simd, self.origin[1][axis]);
            let reciprocal = f64x8::splat(simd, self.reciprocal[axis]);
            near = larger((first - enter) * reciprocal, near);
            far = smaller((last - leave) * reciprocal, far);
        }
        let far = far * f64x8::splat(simd, PADDING) + f64x8::splat(simd, UNDERFLOW);
        [near, smaller(far, f64x8::splat(simd, self.reach))]
    }
}
