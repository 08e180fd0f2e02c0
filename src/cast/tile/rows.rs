//! Eight triangles set up for a tile: edge functions and z as affine functions of the pixel, in f64,
//! then rounded to f32 rows whose error is known.
//!
//! With a_i = v_i − e, c_i = a_j × a_k: W_i = c_i·d, and d = d_0 + i·DX + j·DY for the pixel i, j
//! steps from the tile's first sample, so W_i = C + i·A + j·B with C = c_i·d_0 and so on. With the
//! edges E_1 = v_0 − v_2, E_2 = v_1 − v_0 and n = E_1 × E_2: V = a_0·n, D = ΣW_i = n·d, t = V/D, and
//! z = σ·D/V is affine too.
//!
//! # Bounds of the f64 part, u = 2^-53, with or without fused operations
//!
//! s is the largest |a| of a component, ε the largest |E|, ω ≥ |d|₁ on a full tile.
//! - a_i and E_i are rounded once: u·s, u·ε. Nothing underflows: coordinates are multiples of
//!   2^-149, eyes of 2^-148, directions of 2^-53.
//! - A component of c_i has two products of two such: each wrong by 2u·s² and u·s² more for its own
//!   rounding, and the difference, at most 2s², rounds: 8u·s² and |c| ≤ 2s².
//! - A product with a vector g: 8u·s²|g|₁ + (1 + 2)·2u·s²|g|₁ = 14u·s²|g|₁ for three products and two
//!   sums. Summed over a row, for every pixel of the tile: |W| is wrong by at most 14u·s²·ω.
//!   [`EDGE`] = 15u has room for terms in u². So D: 14u·ε²·ω.
//! - V: n is wrong by 8u·ε², which costs 24u·s·ε², a_0's rounding 6u·s·ε², products and sums
//!   (1 + 2)·6u·s·ε²: 48u·s·ε², [`PLANE`] = 50u. Where |V| ≤ 8·50u·s·ε² its sign is asked for exactly,
//!   once per triangle and frame, and nothing is claimed of z. Elsewhere V is good to δ ≤ 1/7.
//!
//! # The f32 rows
//!
//! Row i is multiplied by sgn V/m_i, m_i the power of two above max(S·2^-20, 60u·s²·ω), S = |C| +
//! 31·(|A| + |B|). A common
//! positive factor changes no sign, so W_i > 0 now means inside. On the tile every partial sum is at
//! most 2^20, one rounding of f32 costs at most 2^-24·2^20 = 1/16, and: the row's own rounding 1/16;
//! the value at a block's corner ([`super::draw`]) two products and two sums, 4/16; the step inside
//! the block two products and a sum, 3/16; their sum 1/16; the f64 part 15u·s²·ω/m ≤ 1/4. In all
//! 13/16 < 1: **W > 1 is certainly inside, W < −1 certainly outside.** Rows below 2^-126 may lose
//! 2^-149 each, which is nothing beside 3/16.
//!
//! z is wrong by at most E: with S_z as S, u' = 2^-24: rounding of the row, eight operations and the
//! padding itself, 10u'·S_z; dividing by V̂, S_z·δ·8/7 and u·S_z; D's part 14u·ε²ω·σ/|V|·8/7. So
//! E = S_z·(13u' + 60u·s·ε²/|V|) + 18u·ε²ω·σ/|V| + 2^-120, the last for underflow. Where z does
//! not stay below 2^100 nothing is claimed of it either.

use super::cull::Live;
use super::frame::{Frame, Lattice, SIDE};
use crate::accel::{GROUP, WIDTH};
use crate::cast::exact::Vertices;
use crate::mesh::TriangleId;
use fearless_simd::{
    Bytes, Select, Simd, SimdBase, SimdFloat, SimdMask, SimdNarrow, SimdSplit, SimdWiden, f32x16,
    f64x8, mask64x8, u64x8,
};

/// u = 2^-53.
const U: f64 = f64::EPSILON / 2.0;
/// Error of W over s²·ω, and of D over ε²·ω.
pub(super) const EDGE: f64 = 15.0 * U;
/// Error of V over s·ε².
const PLANE: f64 = 50.0 * U;
/// Largest S/m: 2^20, a little less because m itself is rounded.
const ROW_SIZE: f64 = 1.0 / ((1 << 20) as f64 * (1.0 - 1.0 / 4096.0));
/// Pixel steps across a full tile.
const STEPS: f64 = (SIDE - 1) as f64;
/// Pixel steps across a block.
const BLOCK_STEPS: f64 = 3.0;
/// Roundings of z in f32 over S_z: 13·2^-24.
const DEPTH: f64 = 13.0 / (1 << 24) as f64;
/// Added to the error of z: more than f32 loses by underflow.
const DEPTH_UNDERFLOW: f64 = 1.0 / (1_u128 << 120) as f64;
/// z and its error are below this, or nothing is claimed: 2^100.
const DEPTH_RANGE: f64 = (1_u128 << 100) as f64;

/// A batch of triangles, ready to be drawn; lanes `0..8`.
#[repr(align(64))]
pub(super) struct Batch {
    /// Per edge and for z the row A, B, C, scaled, over lanes.
    pub(super) rows: [[[f32; GROUP]; 3]; 4],
    /// Per edge: a block whose corner value is below it is certainly outside. For z: what to add to
    /// a block's corner value to get a certain upper bound in the block.
    pub(super) reach: [[f32; GROUP]; 4],
    /// As `Live::spans`.
    pub(super) spans: [[f32; GROUP]; 4],
    /// Certain error of z.
    pub(super) depth_error: [f32; GROUP],
    pub(super) ids: [u32; GROUP],
    /// Bit per lane.
    pub(super) live: u32,
}

impl Batch {
    pub(super) const EMPTY: Self = Self {
        rows: [[[0.0; GROUP]; 3]; 4],
        reach: [[0.0; GROUP]; 4],
        spans: [[0.0; GROUP]; 4],
        depth_error: [0.0; GROUP],
        ids: [0; GROUP],
        live: 0,
    };
}

type Vector<S> = [f64x8<S>; 3];

/// Sets up the triangles `first..` of `live`, at most 8, for the tile. Those that certainly cover no
/// sample of it in front of `least_z` are left out. Without `CERTAIN` the rows are neither scaled nor
/// bounded: what a rasterizer in f32 would draw.
#[inline(always)]
pub(super) fn set_up<S: Simd, const CERTAIN: bool>(
    simd: S,
    frame: &Frame<'_>,
    lattice: &Lattice,
    live: &Live,
    first: usize,
    least_z: f32,
    batch: &mut Batch,
) {
    let zero = f64x8::splat(simd, 0.0);
    let margin = if CERTAIN { f64x8::splat(simd, -1.0) } else { zero };
    let block_steps = f64x8::splat(simd, BLOCK_STEPS);
    // Take the vertices to f64 and to the eye.
    let mut v = [[zero; 3]; 3];
    let mut a = [[zero; 3]; 3];
    let mut s = zero;
    for corner in 0..3 {
        for axis in 0..3 {
            let row = &live.vertices[3 * corner + axis][first..first + WIDTH];
            v[corner][axis] = f32x16::from_slice(simd, row).widen().0;
            a[corner][axis] = v[corner][axis] - f64x8::splat(simd, lattice.eye[axis]);
            s = s.max(a[corner][axis].abs());
        }
    }
    let edges = [difference(&v[0], &v[2]), difference(&v[1], &v[0])];
    let epsilon = largest(&edges[0]).max(largest(&edges[1]));
    let (square, edge_square) = (s * s, epsilon * epsilon);
    // Find the side of the plane that the eye is on.
    let n = cross(&edges[0], &edges[1]);
    let plane = dot(&a[0], &n);
    let relative_error = s * edge_square;
    let doubt = if CERTAIN { relative_error * f64x8::splat(simd, 8.0 * PLANE) } else { zero };
    let open = plane.abs().simd_le(doubt);
    let there = (1_u32 << (live.count - first).min(GROUP)) - 1;
    batch.ids.copy_from_slice(&live.ids[first..first + GROUP]);
    for (to, from) in batch.spans.iter_mut().zip(&live.spans) {
        to.copy_from_slice(&from[first..first + GROUP]);
    }
    let mut kept = there;
    let mut sign = plane;
    let doubtful = mask_bits(open) & there;
    if !CERTAIN {
        kept &= !doubtful;
    } else if doubtful != 0 {
        let (signs, invisible) = open_signs(frame, live, first, doubtful);
        sign = open.select(f64x8::load_array(simd, signs), plane);
        kept &= !invisible;
    }
    // Make the edge rows, scaled so that their error is below 1.
    let d = splat_vector(simd, lattice.directions[0]);
    let dx = splat_vector(simd, lattice.directions[1]);
    let dy = splat_vector(simd, lattice.directions[2]);
    let right = f64x8::splat(simd, lattice.extent[0]);
    let bottom = f64x8::splat(simd, lattice.extent[1]);
    let steps = f64x8::splat(simd, STEPS);
    let signed_one = f64x8::splat(simd, 1.0).copysign(sign);
    let least_size = f64x8::splat(simd, 4.0 * EDGE * lattice.omega) * square;
    let mut most = f64x8::splat(simd, f64::INFINITY);
    for i in 0..3 {
        let c = cross(&a[(i + 1) % 3], &a[(i + 2) % 3]);
        let row = [dot(&c, &dx), dot(&c, &dy), dot(&c, &d)];
        let scale = if CERTAIN {
            let unit = (size(&row, steps) * f64x8::splat(simd, ROW_SIZE)).max(least_size);
            reciprocal_of_next_power(simd, unit) * signed_one
        } else {
            signed_one
        };
        let row = scaled(&row, scale);
        most = most.min(upper(&row, right, bottom, zero));
        let rise = (row[0].max(zero) + row[1].max(zero)) * block_steps;
        store_row(&mut batch.rows[i], &row);
        store_pair(&mut batch.reach[i], margin - rise);
    }
    let mut outside = mask_bits(most.simd_lt(margin));
    // Make the row of z with its error.
    let normal = [dot(&n, &dx), dot(&n, &dy), dot(&n, &d)];
    let per_plane = f64x8::splat(simd, frame.sigma) / plane;
    let magnitude = per_plane.abs();
    let row = scaled(&normal, per_plane);
    let least_z = f64x8::splat(simd, f64::from(least_z));
    if !CERTAIN {
        outside |= mask_bits(upper(&row, right, bottom, zero).simd_lt(least_z));
        store_row(&mut batch.rows[3], &row);
        store_pair(&mut batch.reach[3], (row[0].max(zero) + row[1].max(zero)) * block_steps);
        batch.live = kept & !outside;
        return;
    }
    let size = size(&row, steps);
    let relative = f64x8::splat(simd, 60.0 * U / frame.sigma) * relative_error * magnitude;
    let error = size * (f64x8::splat(simd, DEPTH) + relative)
        + f64x8::splat(simd, 18.0 * U * lattice.omega) * edge_square * magnitude
        + f64x8::splat(simd, DEPTH_UNDERFLOW);
    let known = (size + error).simd_lt(f64x8::splat(simd, DEPTH_RANGE)) & !open;
    let row = [known.select(row[0], zero), known.select(row[1], zero), known.select(row[2], zero)];
    let error = known.select(error, f64x8::splat(simd, f64::INFINITY));
    let nearest = upper(&row, right, bottom, zero) + error;
    outside |= mask_bits(nearest.simd_lt(least_z));
    let rise = (row[0].max(zero) + row[1].max(zero)) * block_steps + error;
    store_row(&mut batch.rows[3], &row);
    store_pair(&mut batch.reach[3], rise);
    store_pair(&mut batch.depth_error, error);
    batch.live = kept & !outside;
}

#[inline(always)]
fn mask_bits<S: Simd>(mask: mask64x8<S>) -> u32 {
    mask.to_bitmask() as u32
}

/// The signs of V that f64 leaves open, as ±1 in their lanes, and the lanes where V = 0.
#[cold]
#[inline(never)]
fn open_signs(frame: &Frame<'_>, live: &Live, first: usize, lanes: u32) -> ([f64; GROUP], u32) {
    let mut signs = [1.0; GROUP];
    let mut invisible = 0;
    for lane in (0..GROUP).filter(|lane| lanes >> lane & 1 != 0) {
        let component = |row: usize| f64::from(live.vertices[row][first + lane]);
        let vertices: Vertices =
            std::array::from_fn(|corner| std::array::from_fn(|axis| component(3 * corner + axis)));
        let id = TriangleId::new(live.ids[first + lane]);
        let sign = frame.plane_sign(id, &vertices);
        if sign == 0 {
            invisible |= 1 << lane;
        } else {
            signs[lane] = f64::from(sign);
        }
    }
    (signs, invisible)
}

/// 1/2^k for the next power of two 2^k above a number below 2^1022. A scale is a matter of the
/// exponent; a division would take longer, and round.
#[inline(always)]
fn reciprocal_of_next_power<S: Simd>(simd: S, value: f64x8<S>) -> f64x8<S> {
    // Of a biased exponent e the next power has e + 1, its reciprocal 2·1023 − (e + 1).
    let exponent = value.bitcast::<u64x8<S>>() & u64x8::splat(simd, 0x7ff << 52);
    (u64x8::splat(simd, (2 * 1023 - 1) << 52) - exponent).bitcast::<f64x8<S>>()
}

/// |C| + steps·(|A| + |B|).
#[inline(always)]
fn size<S: Simd>([a, b, c]: &Vector<S>, steps: f64x8<S>) -> f64x8<S> {
    (a.abs() + b.abs()).mul_add(steps, c.abs())
}

/// The largest value of a row on the tile.
#[inline(always)]
fn upper<S: Simd>(
    [a, b, c]: &Vector<S>,
    right: f64x8<S>,
    bottom: f64x8<S>,
    zero: f64x8<S>,
) -> f64x8<S> {
    b.max(zero).mul_add(bottom, a.max(zero).mul_add(right, *c))
}

#[inline(always)]
fn splat_vector<S: Simd>(simd: S, v: [f64; 3]) -> Vector<S> {
    [f64x8::splat(simd, v[0]), f64x8::splat(simd, v[1]), f64x8::splat(simd, v[2])]
}

#[inline(always)]
fn scaled<S: Simd>(v: &Vector<S>, factor: f64x8<S>) -> Vector<S> {
    [v[0] * factor, v[1] * factor, v[2] * factor]
}

#[inline(always)]
fn difference<S: Simd>(a: &Vector<S>, b: &Vector<S>) -> Vector<S> {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline(always)]
fn cross<S: Simd>(a: &Vector<S>, b: &Vector<S>) -> Vector<S> {
    [
        a[1].mul_sub(b[2], a[2] * b[1]),
        a[2].mul_sub(b[0], a[0] * b[2]),
        a[0].mul_sub(b[1], a[1] * b[0]),
    ]
}

#[inline(always)]
fn dot<S: Simd>(a: &Vector<S>, b: &Vector<S>) -> f64x8<S> {
    a[2].mul_add(b[2], a[1].mul_add(b[1], a[0] * b[0]))
}

#[inline(always)]
fn largest<S: Simd>(v: &Vector<S>) -> f64x8<S> {
    v[0].abs().max(v[1].abs()).max(v[2].abs())
}

#[inline(always)]
fn store_row<S: Simd>(to: &mut [[f32; GROUP]; 3], row: &Vector<S>) {
    for i in 0..3 {
        store_pair(&mut to[i], row[i]);
    }
}

#[inline(always)]
fn store_pair<S: Simd>(to: &mut [f32; GROUP], value: f64x8<S>) {
    value.narrow(value).split().0.store_array(to);
}
