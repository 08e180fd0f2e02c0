//! Eight triangles' rows over one tile, in f32, scaled so that their error is below 1.
//!
//! An edge row is taken to the tile's first sample, in f64, and divided by
//! max(2^-20·S, 4·row_error·s_i·s_j), S = |C| + T·(|A| + |B|), T the largest offset of a sample: any
//! common positive factor is allowed. Then |W| ≤ 2^20 on the tile, and **W > 1 is certainly
//! inside, W < −1 certainly outside**:
//!
//! * f64: the row's error (`frame`) is at most `row_error`·s_i·s_j, after the division ¼.
//! * f32, v = 2^-24: a drawn W is (A·l_x + B·l_y) + (A·b_x + (B·b_y + C)), l a pixel of a block, b the
//!   block, both exact. Every monomial goes through at most 6 roundings (coefficient, product,
//!   four sums; fused, fewer), and monomials add up to at most 2^20: 6·v·2^20 < 0.376.
//!   The bounds of a block, −1 − 3·(max(A, 0) + max(B, 0)), and of the tile are such sums too.
//!   What f32 loses to underflow, 2^-149 per operation, is nothing beside 1.
//!
//! Together less than 0.63. The row of 1/w is N/|V|. With ρ = `volume_error`·r_01·r_20·s_0/|V| ≤ ¼
//! (`placement` calls others hard), 1/|V| is off by at most 4/3·ρ of itself, N by
//! `row_error`·r_01·r_20: the error at any sample of the tile is below
//! S·(6·v + 4/3·ρ) + 4/3·`row_error`·r_01·r_20/|V|, S as above, the widening by it (one rounding)
//! included; what is taken is a little more, and 2^-120 for underflow.

use super::arithmetic::Arithmetic;
use super::blocks::BlockGrid;
use super::frame::Frame;
use super::octet::{Corners, Images, Lanes, Plane, Triple};
use super::placement::eye_plane;
use super::screen_box::{Met, ScreenBoxes};
use super::tile_lists::Grid;
use crate::mutant::{self, Mutant};
use crate::pixel::{Pixel, Window};
use fearless_simd::prelude::*;
use fearless_simd::{f32x16, f64x8, mask32x16};

/// 2^-20: S times this is an edge row's unit.
const UNIT: f64 = 1.0 / (1 << 20) as f64;

/// Shares of S, ρ·S and N's error in the error of 1/w: 6·v, 4/3 and 4/3, and room.
const SINGLE_SHARE: f64 = 6.5 / (1 << 24) as f64;
const VOLUME_SHARE: f64 = 1.4;

/// Far below every 1/w of a scene of usual size, far above what underflow takes.
const LEAST_ERROR: f64 = 1e-36;

/// A triangle certainly hidden by what is drawn: 1/w_min is below the least bound by this factor,
/// more than the roundings of w (2^-39 of it, `frame::FRONT`) and of the product.
const HIDDEN: f64 = 1.0 + UNIT;

/// With V and N known to one part in 2^26 each, their quotient is off by at most half an ulp of f32,
/// and rounds to the f32 next to its true value or to that one's neighbour.
const KNOWN: f64 = (1 << 26) as f64;

/// Whether a triangle whose certain w are at least `least_w`, or have no certain bound where that is 0,
/// is hidden by what is drawn, for the least bound of the drawn 1/w.
pub(super) fn is_hidden(least_w: f32, farthest: f32) -> bool {
    least_w > 0.0 && farthest > 0.0 && f64::from(least_w) * f64::from(farthest) > HIDDEN
}

/// Where a tile lies and how far it reaches.
pub(super) struct TileFrame<S: Simd> {
    /// The first sample.
    origin: [f64; 2],
    /// Largest offset of a sample, T.
    reach: f64,
    boxes: ScreenBoxes<S>,
}

impl<S: Simd> TileFrame<S> {
    #[inline(always)]
    pub(super) fn new(simd: S, frame: &Frame, grid: &BlockGrid, tile: Window) -> Self {
        let first = Pixel { x: tile.x0(), y: tile.y0() };
        // The boxes need no tiles here.
        let boxes = ScreenBoxes::new(simd, frame, tile, Grid::new(tile, 1));
        Self { origin: first.sample(), reach: grid.reach(), boxes }
    }
}

/// A triangle drawn in a tile, with what its t takes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Drawn {
    /// N, over the frame, positive where the triangle covers.
    pub(super) plane: [f64; 3],
    /// |V|·t·(1/w): divided by N·(x, y, 1), it is t.
    pub(super) volume: f64,
    /// Least N·(x, y, 1) at which t is known to f32; +∞ where V is not known so well.
    pub(super) least_plane: f64,
    pub(super) id: u32,
    /// sgn V, ±1.
    pub(super) volume_sign: i32,
}

/// The rows of eight triangles. Vectors hold two rows: edges 0 and 1; edge 2 and 1/w.
pub(super) struct TileRows {
    pub(super) a: [Lanes<f32>; 2],
    pub(super) b: [Lanes<f32>; 2],
    pub(super) c: [Lanes<f32>; 2],
    /// 3·(max(A, 0) + max(B, 0)): the most by which a value grows within a block.
    pub(super) growth: [Lanes<f32>; 2],
    /// Bound of the error of 1/w in lanes 8…15.
    pub(super) error: Lanes<f32>,
    /// Blocks that the triangle can meet, along x in lanes 0…7, along y in lanes 8…15.
    pub(super) from: Lanes<i32>,
    pub(super) to: Lanes<i32>,
    /// The same four rows in f64, for [`Arithmetic::DOUBLE`]: edges 0, 1, 2 and 1/w.
    pub(super) wide: [[[f64; 8]; 3]; 4],
    plane: [[f64; 8]; 3],
    volume: [f64; 8],
    least_plane: [f64; 8],
}

impl TileRows {
    pub(super) fn new() -> Self {
        let (zero, none) = (Lanes([0.0; 16]), Lanes([0; 16]));
        Self {
            a: [zero; 2],
            b: [zero; 2],
            c: [zero; 2],
            growth: [zero; 2],
            error: zero,
            from: none,
            to: none,
            wide: [[[0.0; 8]; 3]; 4],
            plane: [[0.0; 8]; 3],
            volume: [0.0; 8],
            least_plane: [0.0; 8],
        }
    }

    /// Sets up the lanes of `lanes`, none of them hard where anything is certified, and hands back
    /// those that may cover a sample of the tile nearer than `farthest`.
    #[inline(always)]
    pub(super) fn set_up<S: Simd, A: Arithmetic>(
        &mut self,
        simd: S,
        frame: &Frame,
        tile: &TileFrame<S>,
        corners: &Corners,
        lanes: u64,
        farthest: f32,
    ) -> u64 {
        let images = Images::new(simd, frame, corners);
        let [a, b, c] = &images.points;
        let [front, _] = eye_plane(simd, frame, &images);
        let mut lanes = lanes;
        if farthest > 0.0 {
            // 1/w of a covered sample is a mean of the corners' 1/w, where all w are positive.
            let least_w = a[2].min(b[2]).min(c[2]);
            let hidden = (least_w * f64::from(farthest)).simd_gt(HIDDEN);
            lanes &= !(hidden.to_bitmask() & front);
        }
        let met = tile.boxes.blocks(simd, &images, front, &mut self.from, &mut self.to);
        lanes &= !met.none;
        if lanes == 0 {
            return 0;
        }
        let edges = images.edges();
        let pairs = images.size_products();
        let Plane { row, volume, size: plane_size, volume_size } =
            images.plane(simd, frame, corners);
        let inside = f64x8::splat(simd, 1.0).copysign(volume);
        let size = volume.abs();
        if A::BELIEVED {
            // What the eye sees edge-on covers nothing.
            lanes &= size.simd_gt(0.0).to_bitmask();
        }
        // Edges, in their units.
        let least = 4.0 * frame.row_error;
        let e0 = edge_row(tile, &edges[0], pairs[0] * least, inside);
        let e1 = edge_row(tile, &edges[1], pairs[1] * least, inside);
        let e2 = edge_row(tile, &edges[2], pairs[2] * least, inside);
        // Its bits do not depend on the tile.
        let plane = [row[0] * inside, row[1] * inside, row[2] * inside];
        let inverse = f64x8::splat(simd, 1.0) / size;
        let c = moved(tile, &plane);
        let total = magnitude(tile, &plane, c) * inverse;
        let volume_error = volume_size * frame.volume_error;
        let plane_error = plane_size * frame.row_error;
        let depth = [plane[0] * inverse, plane[1] * inverse, c * inverse];
        let error = total * (volume_error * inverse * VOLUME_SHARE + SINGLE_SHARE)
            + plane_error * inverse * VOLUME_SHARE
            + LEAST_ERROR;
        if A::DOUBLE {
            for (row, lanes) in [e0, e1, e2, depth].iter().zip(&mut self.wide) {
                for (coefficient, lanes) in row.iter().zip(lanes) {
                    coefficient.store_slice(lanes);
                }
            }
        }
        // To f32; the error outwards.
        let rows_a = [e0[0].narrow(e1[0]), e2[0].narrow(depth[0])];
        let rows_b = [e0[1].narrow(e1[1]), e2[1].narrow(depth[1])];
        let rows_c = [e0[2].narrow(e1[2]), e2[2].narrow(depth[2])];
        let error = error * HIDDEN;
        let error = error.narrow(error);
        let zero = f32x16::splat(simd, 0.0);
        let reach = tile.reach as f32;
        let mut masks = [0_u64; 2];
        // The least value that an edge needs somewhere in the tile, and 1/w.
        let bound = if A::CERTIFIED { 1.0 } else { 0.0 };
        let mut least = [-bound; 16];
        least[8..].fill(farthest);
        let least = [f32x16::splat(simd, -bound), f32x16::from_slice(simd, &least)];
        for half in 0..2 {
            let (a, b, c) = (rows_a[half], rows_b[half], rows_c[half]);
            let growth = a.max(zero) + b.max(zero);
            let most = match mutant::is(Mutant::TileCorner) {
                true => (a.min(zero) + b.min(zero)) * reach + c,
                false => growth * reach + c,
            };
            let most = match half {
                0 => most,
                _ => {
                    let depth_error = mask_of_depth(simd).select(error, zero);
                    if A::CERTIFIED { most + depth_error } else { most }
                }
            };
            // NaN never excludes.
            masks[half] = most.simd_lt(least[half]).to_bitmask();
            a.store_slice(&mut self.a[half].0);
            b.store_slice(&mut self.b[half].0);
            c.store_slice(&mut self.c[half].0);
            (growth * 3.0).store_slice(&mut self.growth[half].0);
        }
        let outside = masks[0] | masks[0] >> 8 | masks[1] | masks[1] >> 8;
        lanes &= !outside;
        if lanes & met.few != 0 {
            lanes &= !(met.few & between_samples(simd, &met, rows_a, rows_b, rows_c, -bound));
        }
        if lanes == 0 {
            return 0;
        }
        match A::CERTIFIED {
            true => error.store_slice(&mut self.error.0),
            false => zero.store_slice(&mut self.error.0),
        }
        for (c, plane) in plane.iter().enumerate() {
            plane.store_slice(&mut self.plane[c]);
        }
        (volume * frame.ray_parameter).store_slice(&mut self.volume);
        let known = size.simd_gt(volume_error * KNOWN);
        known
            .select(plane_error * KNOWN, f64x8::splat(simd, f64::INFINITY))
            .store_slice(&mut self.least_plane);
        lanes
    }

    /// The triangle of a lane.
    #[inline(always)]
    pub(super) fn drawn(&self, frame: &Frame, lane: usize, id: u32) -> Drawn {
        let volume = self.volume[lane];
        Drawn {
            plane: [0, 1, 2].map(|c| self.plane[c][lane]),
            volume: volume.abs(),
            least_plane: self.least_plane[lane],
            id,
            volume_sign: if (volume < 0.0) == (frame.orientation < 0.0) { 1 } else { -1 },
        }
    }
}

/// Triangles that cover none of the 2 × 2 samples from the first that they can meet: at each of
/// them some edge is below `least`. Values round as drawn ones do (at most 6 times).
#[inline(always)]
fn between_samples<S: Simd>(
    simd: S,
    met: &Met<S>,
    a: [f32x16<S>; 2],
    b: [f32x16<S>; 2],
    c: [f32x16<S>; 2],
    least: f32,
) -> u64 {
    let least = f32x16::splat(simd, least);
    let (first, second) =
        (a[0] * met.x + (b[0] * met.y + c[0]), a[1] * met.x + (b[1] * met.y + c[1]));
    let covered = covered_lanes(least, first, second)
        | covered_lanes(least, first + a[0], second + a[1])
        | covered_lanes(least, first + b[0], second + b[1])
        | covered_lanes(least, first + a[0] + b[0], second + a[1] + b[1]);
    !covered & 0xff
}

/// Triangles no edge of which is below `least`. The upper half of `second` is 1/w.
#[inline(always)]
fn covered_lanes<S: Simd>(least: f32x16<S>, first: f32x16<S>, second: f32x16<S>) -> u64 {
    let (first, second) = (first.simd_lt(least).to_bitmask(), second.simd_lt(least).to_bitmask());
    !(first | first >> 8 | second & 0xff)
}

/// C of a row at the tile's first sample.
#[inline(always)]
fn moved<S: Simd>(tile: &TileFrame<S>, row: &Triple<S>) -> f64x8<S> {
    let [x, y] = tile.origin;
    row[0] * x + (row[1] * y + row[2])
}

/// S of a row, for its C at the tile's first sample.
#[inline(always)]
fn magnitude<S: Simd>(tile: &TileFrame<S>, row: &Triple<S>, c: f64x8<S>) -> f64x8<S> {
    c.abs() + (row[0].abs() + row[1].abs()) * tile.reach
}

/// An edge row in its unit, from the tile's first sample.
#[inline(always)]
fn edge_row<S: Simd>(
    tile: &TileFrame<S>,
    row: &Triple<S>,
    least_unit: f64x8<S>,
    inside: f64x8<S>,
) -> Triple<S> {
    let c = moved(tile, row);
    let scale = inside / (magnitude(tile, row, c) * UNIT).max(least_unit);
    [row[0] * scale, row[1] * scale, c * scale]
}

/// Lanes 8…15: those of 1/w.
#[inline(always)]
fn mask_of_depth<S: Simd>(simd: S) -> mask32x16<S> {
    mask32x16::from_bitmask(simd, 0xff00)
}
