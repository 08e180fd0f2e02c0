//! Drawing eight triangles into a tile, without a branch per block or pixel.
//!
//! **Phase 1**, per triangle, sixteen blocks at a time: which blocks may the triangle cover nearer
//! than what is drawn there? They are appended to one list of (triangle, block). **Phase 2**, per
//! item of the list, sixteen pixels at a time: where the triangle certainly covers and certainly is
//! nearest, it is stored; pixels at which f32 leaves a doubt go to `doubt`. Bounds are those of
//! `tile_rows`: an edge's value is off by less than 1, 1/w by the triangle's own bound.
//!
//! An arithmetic without certification believes f32 in both phases: bounds of 0, no doubt, and nothing
//! fused, so that what is believed is the same at every instruction set.

use super::arithmetic::Arithmetic;
use super::blocks::{BlockGrid, Blocks, MOST_BLOCKS, MOST_VECTORS, SAME_DEPTH};
use super::doubt::{Doubt, Doubtful};
use super::octet::Lanes;
use super::tile_rows::{Drawn, TileRows};
use super::unproven::StoredDepth;
use crate::mutant::{self, Mutant};
use fearless_simd::prelude::*;
use fearless_simd::{f32x16, i32x16, u32x16};

/// What phase 1 leaves for phase 2, per triangle of an octet.
struct Values {
    /// Values of edges 0, 1, 2 and 1/w at the lanes of a block, from its first pixel.
    within: [Lanes<f32>; 4],
    /// Their values at the first pixel of each block that was looked at.
    at_block: [[Lanes<f32>; MOST_VECTORS]; 4],
}

impl Values {
    /// Row k at the lanes of a block.
    #[inline(always)]
    fn at<S: Simd>(&self, simd: S, k: usize, block: usize) -> f32x16<S> {
        f32x16::from_slice(simd, &self.within[k].0)
            + f32x16::splat(simd, self.at_block[k][block >> 4].0[block & 15])
    }
}

/// A row of one triangle in all lanes.
struct Splat<S: Simd> {
    a: f32x16<S>,
    b: f32x16<S>,
    c: f32x16<S>,
    growth: f32,
}

impl<S: Simd> Splat<S> {
    #[inline(always)]
    fn at<A: Arithmetic>(&self, x: f32x16<S>, y: f32x16<S>) -> f32x16<S> {
        match A::CERTIFIED {
            true => self.a.mul_add(x, self.b.mul_add(y, self.c)),
            false => self.a * x + (self.b * y + self.c),
        }
    }
}

/// Row k of a lane of an octet.
#[inline(always)]
fn row<S: Simd>(simd: S, rows: &TileRows, k: usize, lane: usize) -> Splat<S> {
    let (half, lane) = (k >> 1, (k & 1) * 8 + lane);
    Splat {
        a: f32x16::splat(simd, rows.a[half].0[lane]),
        b: f32x16::splat(simd, rows.b[half].0[lane]),
        c: f32x16::splat(simd, rows.c[half].0[lane]),
        growth: rows.growth[half].0[lane],
    }
}

/// What is drawn: the lanes of `lanes`; lane k is triangle `numbers[k]` of `drawn`.
pub(super) struct Octet<'a> {
    pub(super) rows: &'a TileRows,
    pub(super) lanes: u64,
    pub(super) drawn: &'a [Drawn],
    pub(super) numbers: &'a [u32; 8],
    /// What is compared, for [`Arithmetic::STORED`].
    pub(super) stored: &'a StoredDepth,
}

/// Room to draw in.
pub(super) struct Drawing {
    values: Vec<Values>,
    /// Lane · 256 + block; a vector more than can be listed.
    pub(super) items: Box<[u32; 8 * MOST_BLOCKS + 16]>,
}

impl Drawing {
    pub(super) fn new() -> Self {
        let values = || Values {
            within: [Lanes([0.0; 16]); 4],
            at_block: [[Lanes([0.0; 16]); MOST_VECTORS]; 4],
        };
        Self {
            values: (0..8).map(|_| values()).collect(),
            items: Box::new([0; 8 * MOST_BLOCKS + 16]),
        }
    }

    /// Draws an octet's lanes.
    #[inline(always)]
    pub(super) fn draw<S: Simd, A: Arithmetic, const COUNTING: bool>(
        &mut self,
        simd: S,
        grid: &BlockGrid,
        blocks: &mut Blocks,
        octet: &Octet<'_>,
        doubt: &mut Doubt<'_>,
    ) {
        let Octet { rows, drawn, numbers, stored, .. } = *octet;
        let count = self.list::<S, A>(simd, grid, blocks, octet);
        let mut changed = [0_u64; 4];
        for index in 0..count {
            let item = self.items[index] as usize;
            let (lane, block) = (item >> 8 & 7, item & (MOST_BLOCKS - 1));
            let values = &self.values[lane];
            let least = values
                .at(simd, 0, block)
                .min(values.at(simd, 1, block))
                .min(values.at(simd, 2, block));
            let depth = values.at(simd, 3, block);
            let nearest_low = f32x16::from_slice(simd, &blocks.low[block].0);
            let nearest_high = f32x16::from_slice(simd, &blocks.high[block].0);
            let winner = u32x16::from_slice(simd, &blocks.winner[block].0);
            let number = u32x16::splat(simd, numbers[lane]);
            if !A::CERTIFIED {
                // A NaN is drawn nowhere.
                let covered = least.simd_ge(0.0) & depth.simd_gt(0.0);
                let rank = if A::STORED { stored.rank(simd, depth) } else { depth };
                let nearer = rank.simd_gt(nearest_low) & covered;
                nearer.select(rank, nearest_low).store_slice(&mut blocks.low[block].0);
                let mut winner = winner;
                if A::STORED {
                    nearer.select(depth, nearest_high).store_slice(&mut blocks.high[block].0);
                    let same = rank.simd_eq(nearest_low) & covered;
                    winner = same.select(winner | u32x16::splat(simd, SAME_DEPTH), winner);
                }
                nearer.select(number, winner).store_slice(&mut blocks.winner[block].0);
                changed[block >> 6] |= u64::from(nearer.to_bitmask() != 0) << (block & 63);
                continue;
            }
            let error = f32x16::splat(simd, rows.error.0[8 + lane]);
            let (low, high) = (depth - error, depth + error);
            // Written so that NaN is a doubt.
            let outside = least.simd_lt(-1.0);
            let covered = match mutant::is(Mutant::ClosedEdges) {
                true => least.simd_ge(-1.0),
                false => least.simd_gt(1.0),
            };
            let nearer = low.simd_gt(nearest_high) & covered;
            nearer.select(low, nearest_low).store_slice(&mut blocks.low[block].0);
            nearer.select(high, nearest_high).store_slice(&mut blocks.high[block].0);
            nearer.select(number, winner).store_slice(&mut blocks.winner[block].0);
            if COUNTING {
                let sign = match mutant::is(Mutant::UnsignedCount) {
                    true => 1,
                    false => drawn[numbers[lane] as usize].volume_sign,
                };
                let one = covered.select(i32x16::splat(simd, 1), i32x16::splat(simd, 0));
                let crossed = i32x16::from_slice(simd, &blocks.crossed[block].0);
                (crossed + one).store_slice(&mut blocks.crossed[block].0);
                let signed = i32x16::from_slice(simd, &blocks.signed[block].0);
                (signed + one * i32x16::splat(simd, sign)).store_slice(&mut blocks.signed[block].0);
            }
            let visible = !(outside | high.simd_lt(nearest_low));
            let doubtful = match COUNTING {
                // A doubtful sample is counted whatever its depth.
                true => (visible | !(outside | covered)) & !nearer,
                false => visible & !nearer,
            };
            let doubtful = doubtful.to_bitmask();
            let any = visible.to_bitmask() != 0;
            changed[block >> 6] |= u64::from(any) << (block & 63);
            if doubtful != 0 {
                let mut interval = [[0.0; 16]; 2];
                low.store_slice(&mut interval[0]);
                high.store_slice(&mut interval[1]);
                let doubtful = Doubtful {
                    lanes: doubtful as u16,
                    block,
                    number: numbers[lane],
                    covered: covered.to_bitmask() as u16,
                    low: interval[0],
                    high: interval[1],
                };
                doubt.decide(grid, blocks, drawn, &doubtful);
            }
        }
        if A::CERTIFIED {
            doubt.levels.single += 16 * count as u64;
        }
        if !COUNTING && changed != [0; 4] {
            blocks.update_farthest(simd, grid, changed);
        }
    }

    /// Phase 1: lists (lane, block) and hands back how many there are.
    #[inline(always)]
    pub(super) fn list<S: Simd, A: Arithmetic>(
        &mut self,
        simd: S,
        grid: &BlockGrid,
        blocks: &Blocks,
        octet: &Octet<'_>,
    ) -> usize {
        let Octet { rows, lanes, stored, .. } = *octet;
        let x = f32x16::from_slice(simd, &WITHIN_X);
        let y = f32x16::from_slice(simd, &WITHIN_Y);
        let numbers = u32x16::from_slice(simd, &NUMBERS);
        let bound = if A::CERTIFIED { 1.0 } else { 0.0 };
        let mut count = 0;
        let mut left = lanes;
        while left != 0 {
            let lane = left.trailing_zeros() as usize & 7;
            left &= left - 1;
            let values = &mut self.values[lane];
            let [edge0, edge1, edge2, inverse_depth] = [
                row(simd, rows, 0, lane),
                row(simd, rows, 1, lane),
                row(simd, rows, 2, lane),
                row(simd, rows, 3, lane),
            ];
            let [within0, within1, within2, within3] = &mut values.within;
            (edge0.a * x + edge0.b * y).store_slice(&mut within0.0);
            (edge1.a * x + edge1.b * y).store_slice(&mut within1.0);
            (edge2.a * x + edge2.b * y).store_slice(&mut within2.0);
            (inverse_depth.a * x + inverse_depth.b * y).store_slice(&mut within3.0);
            let least0 = f32x16::splat(simd, -bound - edge0.growth);
            let least1 = f32x16::splat(simd, -bound - edge1.growth);
            let least2 = f32x16::splat(simd, -bound - edge2.growth);
            let room = f32x16::splat(simd, inverse_depth.growth + rows.error.0[8 + lane]);
            let [block0, block1, block2, block3] = &mut values.at_block;
            let (first, last) = (rows.from.0[8 + lane], rows.to.0[8 + lane]);
            let late = usize::from(mutant::is(Mutant::ShortSpan));
            let from = first as usize * grid.per_side / 16 + late;
            let to = ((last as usize + 1) * grid.per_side).div_ceil(16).min(grid.vectors);
            for vector in from..to {
                let (bx, by) = (
                    f32x16::from_slice(simd, &grid.x[vector].0),
                    f32x16::from_slice(simd, &grid.y[vector].0),
                );
                let w0 = edge0.at::<A>(bx, by);
                let w1 = edge1.at::<A>(bx, by);
                let w2 = edge2.at::<A>(bx, by);
                let depth = inverse_depth.at::<A>(bx, by);
                let farthest = f32x16::from_slice(simd, &blocks.farthest[vector].0);
                let nearest = match A::STORED {
                    true => stored.rank(simd, depth + room),
                    false => depth + room,
                };
                // NaN stays in the list.
                let hidden = w0.simd_lt(least0)
                    | w1.simd_lt(least1)
                    | w2.simd_lt(least2)
                    | nearest.simd_lt(farthest);
                let base = vector * 16;
                w0.store_slice(&mut block0[vector & (MOST_VECTORS - 1)].0);
                w1.store_slice(&mut block1[vector & (MOST_VECTORS - 1)].0);
                w2.store_slice(&mut block2[vector & (MOST_VECTORS - 1)].0);
                depth.store_slice(&mut block3[vector & (MOST_VECTORS - 1)].0);
                let may = !hidden;
                let items = numbers + ((lane as u32) << 8 | base as u32);
                items.compress(may).store_slice(&mut self.items[count..count + 16]);
                count += may.to_bitmask().count_ones() as usize;
            }
        }
        count
    }
}

/// The lanes of a block, in pixels from its first.
const WITHIN_X: [f32; 16] =
    [0.0, 1.0, 2.0, 3.0, 0.0, 1.0, 2.0, 3.0, 0.0, 1.0, 2.0, 3.0, 0.0, 1.0, 2.0, 3.0];
const WITHIN_Y: [f32; 16] =
    [0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 2.0, 2.0, 2.0, 2.0, 3.0, 3.0, 3.0, 3.0];
const NUMBERS: [u32; 16] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15];
