//! From a tile's z-buffer to an answer, believed as it is.

use crate::mesh::{Barycentric, TriangleId};
use crate::pixel::{Pixel, Window};
use crate::raster::arithmetic::Kernel;
use crate::raster::blocks::{self, BLOCK_SIDE, NOTHING, SAME_DEPTH};
use crate::raster::image_plane::ImagePlane;
use crate::raster::nearest::BlockRow;
use crate::raster::rows::Homogeneous;
use crate::raster::strips::Strip;
use crate::raster::tile::{Tile, Tiling};
use crate::visibility::{Facing, Level, Visible};
use fearless_simd::prelude::*;
use fearless_simd::{dispatch, f32x16, f64x8, u32x16};

/// Writes a tile's ids and t.
pub(super) fn nearest(
    tiling: &Tiling<'_>,
    tile: &Tile,
    window: Window,
    ids: &mut Strip<'_, u32>,
    t: &mut Strip<'_, f32>,
) {
    dispatch!(tiling.simd.dispatched(), simd => blocks(simd, tiling, tile, window, ids, t));
}

#[inline(always)]
fn blocks<S: Simd>(
    simd: S,
    tiling: &Tiling<'_>,
    tile: &Tile,
    window: Window,
    ids: &mut Strip<'_, u32>,
    t: &mut Strip<'_, f32>,
) {
    let (per_side, side) = (tiling.blocks.per_side, BLOCK_SIDE);
    let mut answer = BlockRow::new();
    for row in 0..window.height().div_ceil(side) as usize {
        for column in 0..window.width().div_ceil(side) as usize {
            let block = row * per_side + column;
            let (block_ids, block_t) = (&mut answer.ids[column], &mut answer.t[column]);
            block_ids.0 = [u32::MAX; 16];
            for lane in 0..16 {
                let winner = tile.blocks.winner[block].0[lane] & !SAME_DEPTH;
                if let Some(drawn) = tile.drawn.get(winner as usize) {
                    block_ids.0[lane] = drawn.id;
                }
            }
            let (upper, lower) = inverse_depths(simd, tiling, tile, block);
            let over = f64x8::splat(simd, tiling.frame.ray_parameter);
            let values = (over / upper).narrow(over / lower);
            let nothing =
                u32x16::from_slice(simd, &block_ids.0).simd_eq(u32x16::splat(simd, u32::MAX));
            let values = nothing.select(f32x16::splat(simd, f32::INFINITY), values);
            values.store_slice(&mut block_t.0);
        }
        answer.store(window, row, ids, t);
    }
}

/// 1/w of a block's winners.
#[inline(always)]
fn inverse_depths<S: Simd>(
    simd: S,
    tiling: &Tiling<'_>,
    tile: &Tile,
    block: usize,
) -> (f64x8<S>, f64x8<S>) {
    match tiling.kernel {
        Kernel::Double => {
            let depths = &tile.depths[block];
            (f64x8::from_slice(simd, &depths[..8]), f64x8::from_slice(simd, &depths[8..]))
        }
        // What is compared in a depth buffer is no 1/w.
        Kernel::Stored(..) => f32x16::from_slice(simd, &tile.blocks.high[block].0).widen(),
        Kernel::Single | Kernel::Certain => {
            f32x16::from_slice(simd, &tile.blocks.low[block].0).widen()
        }
    }
}

/// Writes a tile's surfaces.
pub(super) fn surfaces(
    tiling: &Tiling<'_>,
    tile: &Tile,
    window: Window,
    visible: &mut Strip<'_, Option<Visible>>,
) {
    let level = if tiling.kernel == Kernel::Double { Level::Double } else { Level::Single };
    // Neighbours mostly see the same triangle.
    let mut last: Option<(u32, Edges)> = None;
    for pixel in window.pixels() {
        let (block, lane) = blocks::place(&tiling.blocks, window, pixel);
        let winner = tile.blocks.winner[block].0[lane];
        let number = winner & !SAME_DEPTH;
        if number == NOTHING {
            continue;
        }
        let drawn = &tile.drawn[number as usize];
        let id = TriangleId::new(drawn.id);
        let edges = match &last {
            Some((same, edges)) if *same == number => edges,
            _ => {
                let corners = tiling.mesh.triangle(id);
                &last.insert((number, Edges::new(&tiling.plane, corners))).1
            }
        };
        let inverse_depth = match tiling.kernel {
            Kernel::Double => tile.depths[block][lane],
            Kernel::Stored(..) => f64::from(tile.blocks.high[block].0[lane]),
            Kernel::Single | Kernel::Certain => f64::from(tile.blocks.low[block].0[lane]),
        };
        let t = tiling.frame.ray_parameter / inverse_depth;
        visible.row_from(pixel)[0] = Some(Visible {
            triangle: id,
            facing: if drawn.volume_sign < 0 { Facing::Front } else { Facing::Back },
            level,
            tie: winner & SAME_DEPTH != 0,
            barycentric: edges.weights(pixel),
            t_lo: t,
            t_hi: t,
        });
    }
}

/// Edge rows of a triangle over the frame, in f64.
struct Edges([[f64; 3]; 3]);

impl Edges {
    fn new(plane: &ImagePlane, corners: [[f32; 3]; 3]) -> Self {
        let [a, b, c] = corners.map(|corner| {
            let from_eye = [0, 1, 2].map(|k| f64::from(corner[k]) - plane.eye[k]);
            Homogeneous::new(plane, from_eye).value
        });
        Self([cross(b, c), cross(c, a), cross(a, b)])
    }

    /// Weights at a sample, none negative; a third each where rows are too small to tell.
    fn weights(&self, pixel: Pixel) -> Barycentric {
        let [x, y] = pixel.sample();
        let values = self.0.map(|[a, b, c]| (a * x + b * y) + c);
        let sum = (values[0] + values[1]) + values[2];
        let weights = values.map(|value| (value / sum).max(0.0));
        let total = (weights[0] + weights[1]) + weights[2];
        let is_known = total > 0.0 && total.is_finite();
        Barycentric(if is_known { weights.map(|weight| weight / total) } else { [1.0 / 3.0; 3] })
    }
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
