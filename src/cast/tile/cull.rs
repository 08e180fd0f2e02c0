//! Triangles that cannot show in a tile, turned away in f32 before anything is set up for them.
//!
//! A vertex v has the pixel coordinates x = X/w, y = Y/w relative to the tile's first sample, where
//! (X, Y, w) are linear in a = v − e (the inverse camera matrix). A triangle whose vertices all lie
//! in front of the eye covers no sample outside the bounding rectangle of the three points.
//!
//! Bound, u = 2^-24. The eye is ê + ê' + r, |r| ≤ u²|ê|; â = fl(fl(v − ê) − ê') is wrong by at most
//! 2u|â| + 2u²|ê|; with s the largest |â_k| of the triangle plus u·(the largest |ê_k|), which
//! `reach` holds, that is 2us per component (terms in u² see below). A row n̂, rounded from f64,
//! times â in three products and two sums: 2us + u + 3u + 2u roundings, |n|₁·s·8u in all. The row
//! itself is good to 2^-24 of t'·(1 + |x| + |y|), `Frame::orders`. So with N the largest |n|₁ of the
//! rows X and Y, N_w that of w, and q = s/w_min:
//!
//! - |x̂ − x| ≤ 8uq·(N + |x|·N_w) + u·(1 + |x| + |y|) + 2u|x|, the last for dividing. With m the
//!   largest |x̂|, |ŷ| of the triangle: at most 9uq·(N + m·N_w) + 5u·(1 + m).
//! - the points are used only where w_min > 2^-10·N_w·s, where w_min is good to 2^-10.
//! - behind the eye: all ŵ < −9u·N_w·s.
//! - beyond the reach: w_min − 9u·N_w·s > reach·(1 + 4u).
//!
//! The constants 9 and 5 leave room for terms in u² and for the bound's own roundings, because s is
//! at least 2^-100 in the units that `Frame::culls` demands and nothing overflows.

use super::frame::{Frame, Lattice};
use crate::accel::{GROUP, Leaf, NO_TRIANGLE, WIDTH, WideTree};
use crate::mutant::{self, Mutant};
use fearless_simd::{Select, Simd, SimdBase, SimdFloat, SimdMask, f32x16, u32x16};

/// u = 2^-24.
const U: f32 = f32::EPSILON / 2.0;
/// A linear function's error over |n|₁·s.
const LINEAR: f32 = 9.0 * U;
/// The error of a pixel coordinate over 1 + m, besides that of its linear functions.
const QUOTIENT: f32 = 5.0 * U;
/// w_min over N_w·s from which a triangle's points are used: 2^-10.
const LEAST_DEPTH: f32 = 1.0 / 1024.0;
/// Smallest w_min that is divided by: products of rows and vertices then keep a relative u.
const LEAST_W: f32 = 1.0 / (1_u128 << 100) as f32;

/// Triangles that wait for their set-up: room for a leaf's and a vector's more.
pub(super) const ROOM: usize = 16 * GROUP + WIDTH;

/// What survives of a leaf, in lanes.
pub(super) struct Live {
    /// Nine rows: x, y, z of corner 0, of corner 1, of corner 2.
    pub(super) vertices: [[f32; ROOM]; 9],
    /// First and last column, first and last row of the tile's samples that a triangle may cover.
    pub(super) spans: [[f32; ROOM]; 4],
    pub(super) ids: [u32; ROOM],
    pub(super) count: usize,
}

impl Live {
    pub(super) const EMPTY: Self = Self {
        vertices: [[0.0; ROOM]; 9],
        spans: [[0.0; ROOM]; 4],
        ids: [NO_TRIANGLE; ROOM],
        count: 0,
    };
}

/// A tile as the cull wants it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cull {
    eye: [[f32; 2]; 3],
    /// Rows X, Y, w over σ, X and Y relative to the tile's first sample.
    rows: [[f32; 3]; 3],
    /// N and N_w.
    norms: [f32; 2],
    /// In s: u·(the largest |e_k|).
    reach: f32,
    /// Largest coordinate of a sample.
    extent: [f32; 2],
    /// Whether there is anything to be had.
    culls: bool,
}

impl Cull {
    pub(super) fn new(frame: &Frame<'_>, lattice: &Lattice) -> Self {
        let [x, y, w] = frame.inverse.map(|row| row.map(|c| c / frame.sigma));
        let [left, top] = lattice.window.pixel(0).sample();
        let relative = |row: [f64; 3], start: f64| -> [f64; 3] {
            std::array::from_fn(|k| row[k] - start * w[k])
        };
        let rows = [relative(x, left), relative(y, top), w];
        let [nx, ny, nw] = rows.map(|row| row.iter().map(|c| c.abs()).sum::<f64>());
        let largest_eye = lattice.eye.iter().fold(0.0, |m: f64, c| m.max(c.abs()));
        Self {
            eye: lattice.eye.map(|c| [c as f32, (c - f64::from(c as f32)) as f32]),
            rows: rows.map(|row| row.map(|c| c as f32)),
            norms: [nx.max(ny) as f32, nw as f32],
            reach: U * largest_eye as f32,
            extent: lattice.extent.map(|c| c as f32),
            culls: frame.culls,
        }
    }
}

/// Appends the triangles of a leaf that may show in the tile in front of `reach` (a t').
#[inline(always)]
pub(super) fn survivors<S: Simd>(
    simd: S,
    cull: &Cull,
    tree: &WideTree,
    leaf: Leaf,
    reach: f32,
    live: &mut Live,
) {
    let rows = &tree.vertices[9 * leaf.first..9 * (leaf.first + leaf.count) + WIDTH];
    let ids = &tree.ids[leaf.first..leaf.first + leaf.count + WIDTH];
    let mut lane = 0;
    while lane < leaf.count {
        let of_lanes = u32x16::from_slice(simd, &ids[lane..lane + WIDTH]);
        let here = (1_u32 << (leaf.count - lane).min(WIDTH)) - 1;
        let there =
            !(of_lanes.simd_eq(u32x16::splat(simd, NO_TRIANGLE)).to_bitmask() as u32) & here;
        let mut vertices = [f32x16::splat(simd, 0.0); 9];
        for (row, values) in vertices.iter_mut().enumerate() {
            let from = row * leaf.count + lane;
            *values = f32x16::from_slice(simd, &rows[from..from + WIDTH]);
        }
        let (absent, spans) = if cull.culls {
            look(simd, cull, &vertices, reach)
        } else {
            (0, whole_tile(simd, cull))
        };
        let kept = there & !absent;
        lane += WIDTH;
        if kept == 0 {
            continue;
        }
        let mask = simd.from_bitmask_mask32x16(u64::from(kept));
        let to = live.count;
        for (row, values) in spans.iter().enumerate() {
            let to = &mut live.spans[row][to..to + WIDTH];
            simd.compress_f32x16(*values, mask).store_slice(to);
        }
        for (row, values) in vertices.iter().enumerate() {
            let to = &mut live.vertices[row][to..to + WIDTH];
            simd.compress_f32x16(*values, mask).store_slice(to);
        }
        simd.compress_u32x16(of_lanes, mask).store_slice(&mut live.ids[to..to + WIDTH]);
        live.count += kept.count_ones() as usize;
    }
}

/// First and last column and row of a tile.
#[inline(always)]
fn whole_tile<S: Simd>(simd: S, cull: &Cull) -> [f32x16<S>; 4] {
    let zero = f32x16::splat(simd, 0.0);
    [zero, f32x16::splat(simd, cull.extent[0]), zero, f32x16::splat(simd, cull.extent[1])]
}

/// The lanes whose triangles certainly cover no sample of the tile in front of `reach`, and the
/// columns and rows in which the others may cover any.
#[inline(always)]
fn look<S: Simd>(
    simd: S,
    cull: &Cull,
    vertices: &[f32x16<S>; 9],
    reach: f32,
) -> (u32, [f32x16<S>; 4]) {
    // Move the vertices to the eye.
    let mut a = [[f32x16::splat(simd, 0.0); 3]; 3];
    let mut s = f32x16::splat(simd, 0.0);
    for corner in 0..3 {
        for axis in 0..3 {
            let [high, low] = cull.eye[axis];
            let (high, low) = (f32x16::splat(simd, high), f32x16::splat(simd, low));
            a[corner][axis] = vertices[3 * corner + axis] - high - low;
            s = s.max(a[corner][axis].abs());
        }
    }
    let s = s + f32x16::splat(simd, cull.reach);
    // Find where the triangle lies in depth.
    let w = apply(simd, cull.rows[2], &a);
    let nearest = w[0].min(w[1]).min(w[2]);
    let farthest = w[0].max(w[1]).max(w[2]);
    let depth_error = s * f32x16::splat(simd, LINEAR * cull.norms[1]);
    let behind = farthest.simd_lt(-depth_error);
    let reach = f32x16::splat(simd, reach * (1.0 + 4.0 * U));
    let beyond = (nearest - depth_error).simd_gt(reach);
    // Find the rectangle around its points, and their largest coordinate.
    let in_front = nearest.simd_gt(s * f32x16::splat(simd, LEAST_DEPTH * cull.norms[1]))
        & nearest.simd_gt(f32x16::splat(simd, LEAST_W));
    let one = f32x16::splat(simd, 1.0);
    let inverse = [one / w[0], one / w[1], one / w[2]];
    let [x_lo, x_hi] = range(apply(simd, cull.rows[0], &a), &inverse);
    let [y_lo, y_hi] = range(apply(simd, cull.rows[1], &a), &inverse);
    let m = x_hi.abs().max(x_lo.abs()).max(y_hi.abs()).max(y_lo.abs());
    let q = s * inverse[0].max(inverse[1]).max(inverse[2]);
    let [norm, depth_norm] = cull.norms;
    let linear = m.mul_add(f32x16::splat(simd, depth_norm), f32x16::splat(simd, norm));
    let margin =
        q * f32x16::splat(simd, LINEAR) * linear + f32x16::splat(simd, QUOTIENT) * (one + m);
    let whole = whole_tile(simd, cull);
    let last_row = (y_hi + margin).floor();
    let last_row = if mutant::is(Mutant::ShortSamples) { last_row - one } else { last_row };
    let spans = [
        in_front.select((x_lo - margin).ceil().max(whole[0]), whole[0]),
        in_front.select((x_hi + margin).floor().min(whole[1]), whole[1]),
        in_front.select((y_lo - margin).ceil().max(whole[2]), whole[2]),
        in_front.select(last_row.min(whole[3]), whole[3]),
    ];
    let missed = spans[0].simd_gt(spans[1]) | spans[2].simd_gt(spans[3]);
    let absent = missed | (in_front & beyond) | behind;
    (absent.to_bitmask() as u32, spans)
}

/// A row of the inverse camera matrix times three vectors.
#[inline(always)]
fn apply<S: Simd>(simd: S, row: [f32; 3], a: &[[f32x16<S>; 3]; 3]) -> [f32x16<S>; 3] {
    let x = f32x16::splat(simd, row[0]);
    let y = f32x16::splat(simd, row[1]);
    let z = f32x16::splat(simd, row[2]);
    let mut values = [x; 3];
    for i in 0..3 {
        values[i] = z.mul_add(a[i][2], y.mul_add(a[i][1], x * a[i][0]));
    }
    values
}

/// The least and the largest of three quotients.
#[inline(always)]
fn range<S: Simd>(values: [f32x16<S>; 3], inverse: &[f32x16<S>; 3]) -> [f32x16<S>; 2] {
    let (a, b, c) = (values[0] * inverse[0], values[1] * inverse[1], values[2] * inverse[2]);
    [a.min(b).min(c), a.max(b).max(c)]
}
