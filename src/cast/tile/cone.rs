//! The cone of a tile's rays against boxes, 16 at a time: conservative.
//!
//! The cone is bounded by the planes through the eye and the outermost samples; the fifth function
//! is t' itself, which is linear in the point: t'(p) = w·(p − e)/σ.
//!
//! Bound, u = 2^-24. A function f(p) = n·(p − e) is taken at a corner of a box as
//! ĝ = ((n̂_x·p_x + ô) + n̂_y·p_y) + n̂_z·p_z with n̂ and ô rounded from f64. Let
//! M = Σ|n_k|·(|p_k| + |e_k|). The rounding of n̂ costs uM, that of ô u·M, the three products uM,
//! the three sums 3uM: 6uM, with or without fused operations; terms in u² are below uM. The f64
//! normal is a cross product of exact vectors a and b, wrong by at most 3·2^-53·|a|₁|b|₁ per
//! component; that of t' is wrong by a relative u within the cone (`frame::inverse`), for which the
//! comparison with the reach has room. ô is moved by 8uM and the cross product's error to the side
//! on which a box is kept. The normals are scaled to |n|₁ = 1/σ, so that nothing overflows and M is at least 2^-50 wherever f32
//! coordinates are not all below 2^-149: what underflows, at most 2^-148, is within the last uM.

use super::frame::{Frame, Lattice};
use crate::accel::{WIDTH, WideNode};
use crate::mutant::{self, Mutant};
use fearless_simd::{Simd, SimdBase, SimdFloat, SimdMask, f32x16};

/// Slack of a function over M: 8u = 2^-21, see the module's derivation.
const SLACK: f64 = 1.0 / (1 << 21) as f64;

/// A linear function of a point.
#[derive(Clone, Copy, Debug)]
struct Plane {
    normal: [f32; 3],
    offset: f32,
    /// Per axis the side of a box where the function is largest (smallest for t').
    side: [usize; 3],
}

/// The five functions of a tile.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cone {
    sides: [Plane; 4],
    depth: Plane,
}

impl Cone {
    pub(super) fn new(frame: &Frame<'_>, lattice: &Lattice) -> Self {
        let [d, dx, dy] = lattice.directions;
        let moved =
            |x: f64, y: f64| -> [f64; 3] { std::array::from_fn(|k| d[k] + x * dx[k] + y * dy[k]) };
        let [right, bottom] = lattice.extent;
        let up = dot(cross(dx, dy), d).signum();
        let side = |a: [f64; 3], b: [f64; 3], sign: f64| {
            let normal = cross(a, b).map(|c| c * sign * up);
            let error = 2.0 * f64::EPSILON * norm(a) * norm(b);
            plane(frame, lattice, normal, error, 1.0)
        };
        // det(DX, DY, d) = d·(DX × DY): (DY × d)·DX has its sign, and so on.
        let sides = [
            side(dy, d, 1.0),
            side(dy, moved(right, 0.0), -1.0),
            side(d, dx, 1.0),
            side(moved(0.0, bottom), dx, -1.0),
        ];
        // Where the inverse is no good, every key is 0.
        let w = frame.inverse[2].map(|c| if frame.orders { c } else { 0.0 });
        Self { sides, depth: plane(frame, lattice, w, 0.0, -1.0) }
    }

    /// Which children the cone may meet, and for each a lower bound of t' in its box, at least 0.
    #[inline(always)]
    pub(super) fn meet<S: Simd>(&self, simd: S, node: &WideNode) -> (u32, f32x16<S>) {
        let mut least = f32x16::splat(simd, f32::MAX);
        for plane in &self.sides {
            least = least.min(value(simd, plane, node));
        }
        let zero = f32x16::splat(simd, 0.0);
        let least_allowed =
            if mutant::is(Mutant::TightCone) { f32x16::splat(simd, 1.0 / 1024.0) } else { zero };
        let outside = least.simd_lt(least_allowed).to_bitmask() as u32;
        let there = (1_u32 << node.count.min(WIDTH as u32)) - 1;
        (there & !outside, value(simd, &self.depth, node).max(zero))
    }
}

#[inline(always)]
fn value<S: Simd>(simd: S, plane: &Plane, node: &WideNode) -> f32x16<S> {
    let mut value = f32x16::splat(simd, plane.offset);
    for axis in 0..3 {
        let face = &node.planes[plane.side[axis] & 1][axis];
        let normal = f32x16::splat(simd, plane.normal[axis]);
        value = normal.mul_add(f32x16::load_array_ref(simd, face), value);
    }
    value
}

/// The function with this normal, whose components are wrong by at most `error`; `bound` 1 for one
/// that is bounded from above, −1 from below.
fn plane(frame: &Frame<'_>, lattice: &Lattice, normal: [f64; 3], error: f64, bound: f64) -> Plane {
    let is_depth = bound < 0.0;
    let scale = if is_depth { 1.0 } else { norm(normal) };
    let scale = 1.0 / (scale * frame.sigma);
    let normal = normal.map(|c| c * scale);
    let reach: f64 = (0..3).map(|k| normal[k].abs() * frame.reach[k]).sum();
    let slack = SLACK * reach + error * scale * frame.reach.iter().sum::<f64>();
    let offset = -dot(normal, lattice.eye) + bound * slack;
    let upper = normal.map(|c| usize::from(c > 0.0));
    Plane {
        normal: normal.map(|c| c as f32),
        offset: offset as f32,
        side: upper.map(|side| if is_depth { 1 - side } else { side }),
    }
}

fn norm(v: [f64; 3]) -> f64 {
    v[0].abs() + v[1].abs() + v[2].abs()
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
