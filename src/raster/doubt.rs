//! What f32 leaves open at a pixel: coverage and depth by f64 rows with bounds, then exactly.
//!
//! The cold part of a tile. One question at a time, in the order of the levels; the answers do not
//! depend on the order in which triangles come.

use super::bins::Candidate;
use super::blocks::{self, BlockGrid, Blocks, NOTHING, SAME_DEPTH};
use super::coverage::coverage;
use super::exact::{ExactStage, ExactTriangle};
use super::frame::Frame;
use super::image_plane::ImagePlane;
use super::rows::{Projection, TriangleRows};
use super::scan::scan;
use super::tile_rows::Drawn;
use crate::mesh::{TriangleId, TriangleMesh};
use crate::mutant::{self, Mutant};
use crate::pixel::{Pixel, Window};
use crate::visibility::LevelCounts;
use std::cmp::Ordering;
use std::rc::Rc;

/// Rows kept per tile before the store starts anew: about 300 bytes each.
const KEPT_ROWS: usize = 4096;

/// A tile's doubts.
pub(super) struct Doubt<'a> {
    plane: &'a ImagePlane,
    frame: &'a Frame,
    mesh: &'a TriangleMesh,
    pub(super) window: Window,
    pub(super) exact: ExactStage<'a>,
    pub(super) levels: LevelCounts,
    /// Rows by numbers of triangles, and how many there are.
    rows: Vec<Option<Rc<TriangleRows>>>,
    kept: usize,
    /// The last pair that was found to share a plane, candidate and nearest so far, by numbers.
    same_plane: [u32; 2],
    /// Whether the candidate of that pair goes before.
    candidate_wins: bool,
}

/// Lanes of one block, one triangle, that f32 does not decide.
pub(super) struct Doubtful {
    pub(super) lanes: u16,
    pub(super) block: usize,
    /// The triangle, by its number among the drawn ones.
    pub(super) number: u32,
    /// Lanes that it certainly covers.
    pub(super) covered: u16,
    /// Certain bounds of its 1/w.
    pub(super) low: [f32; 16],
    pub(super) high: [f32; 16],
}

/// A lane of a block, and its pixel.
#[derive(Clone, Copy)]
struct Place {
    block: usize,
    lane: usize,
    pixel: Pixel,
}

impl<'a> Doubt<'a> {
    pub(super) fn new(
        plane: &'a ImagePlane,
        frame: &'a Frame,
        mesh: &'a TriangleMesh,
        window: Window,
    ) -> Self {
        Self {
            plane,
            frame,
            mesh,
            window,
            exact: ExactStage::new(plane, mesh),
            levels: LevelCounts::default(),
            rows: Vec::new(),
            kept: 0,
            same_plane: [NOTHING; 2],
            candidate_wins: false,
        }
    }

    /// Decides the doubtful lanes.
    #[cold]
    #[inline(never)]
    pub(super) fn decide(
        &mut self,
        grid: &BlockGrid,
        blocks: &mut Blocks,
        drawn: &[Drawn],
        doubtful: &Doubtful,
    ) {
        let block = doubtful.block;
        let mut left = doubtful.lanes;
        while left != 0 {
            let lane = left.trailing_zeros() as usize;
            left &= left - 1;
            let covered = doubtful.covered >> lane & 1 == 1;
            let winner = &mut blocks.winner[block].0[lane];
            if covered && self.same_plane == [doubtful.number, *winner & !SAME_DEPTH] {
                self.levels.double += 1;
                if self.candidate_wins {
                    *winner = doubtful.number;
                    blocks.low[block].0[lane] = doubtful.low[lane];
                    blocks.high[block].0[lane] = doubtful.high[lane];
                }
                blocks.winner[block].0[lane] |= SAME_DEPTH;
                continue;
            }
            // Outside the tile.
            if blocks.low[block].0[lane] == f32::INFINITY {
                continue;
            }
            let pixel = blocks::pixel(grid, self.window, block, lane);
            if !covered {
                let Some(rows) = self.rows_of(drawn, doubtful.number) else { continue };
                let covered = coverage(&mut self.exact, &mut self.levels, &rows, [true; 3], pixel);
                if covered.is_none() {
                    continue;
                }
                count(blocks, block, lane, &drawn[doubtful.number as usize]);
            }
            let place = Place { block, lane, pixel };
            let inverse_depth = [doubtful.low[lane], doubtful.high[lane]];
            self.compare(blocks, drawn, place, doubtful.number, inverse_depth);
        }
    }

    /// Draws a hard triangle, which gets the number `drawn.len()`.
    #[cold]
    pub(super) fn draw_hard(
        &mut self,
        grid: &BlockGrid,
        blocks: &mut Blocks,
        drawn: &mut Vec<Drawn>,
        candidate: &Candidate,
    ) {
        let (number, id) = (drawn.len() as u32, candidate.rows.id);
        drawn.push(Drawn {
            plane: [0.0; 3],
            volume: 0.0,
            least_plane: f64::INFINITY,
            id: id.get(),
            volume_sign: candidate.rows.volume_sign,
        });
        self.keep(number as usize, Rc::new(candidate.rows.clone()));
        let mut fragments = Vec::new();
        scan(self.window, candidate, &mut self.exact, &mut self.levels, |pixel, fragment| {
            fragments.push((pixel, fragment.inverse_depth));
        });
        for (pixel, [low, high]) in fragments {
            let (block, lane) = blocks::place(grid, self.window, pixel);
            if blocks.low[block].0[lane] == f32::INFINITY {
                continue;
            }
            count(blocks, block, lane, &drawn[number as usize]);
            // To f32, outwards; a power of two scales exactly but for underflow, which the step
            // outwards covers.
            let [low, high] = [low, high].map(|z| z * self.frame.inverse_depth_unit);
            let inverse_depth = [(low as f32).next_down(), (high as f32).next_up()];
            self.compare(blocks, drawn, Place { block, lane, pixel }, number, inverse_depth);
        }
    }

    /// Holds a covering triangle against the nearest so far.
    fn compare(
        &mut self,
        blocks: &mut Blocks,
        drawn: &[Drawn],
        place: Place,
        number: u32,
        [low, high]: [f32; 2],
    ) {
        let Place { block, lane, pixel } = place;
        let winner = blocks.winner[block].0[lane];
        let order = if winner == NOTHING || low > blocks.high[block].0[lane] {
            Order::Before
        } else if high < blocks.low[block].0[lane] {
            Order::Behind
        } else {
            self.order(drawn, [number, winner & !SAME_DEPTH], pixel)
        };
        blocks.winner[block].0[lane] = match order {
            Order::Behind => return,
            Order::SameDepth { candidate_wins: false } => winner | SAME_DEPTH,
            Order::SameDepth { candidate_wins: true } => number | SAME_DEPTH,
            Order::Before => number,
        };
        if blocks.winner[block].0[lane] & !SAME_DEPTH == number {
            blocks.low[block].0[lane] = low;
            blocks.high[block].0[lane] = high;
        }
    }

    /// How two triangles that cover a sample lie there.
    fn order(&mut self, drawn: &[Drawn], pair: [u32; 2], pixel: Pixel) -> Order {
        let [candidate, nearest] = pair.map(|number| drawn[number as usize].id);
        let lowest_id = (candidate < nearest) != mutant::is(Mutant::LastIdInPlane);
        // Only triangles with V ≠ 0 cover, so that there always are rows and an order.
        let (Some(new), Some(old)) = (self.rows_of(drawn, pair[0]), self.rows_of(drawn, pair[1]))
        else {
            return Order::Behind;
        };
        let [x, y] = pixel.sample();
        let (new, old) = (new.inverse_depth(x, y), old.inverse_depth(x, y));
        if planted_reject(new[0], old[0]) {
            return Order::Behind;
        }
        // Disjoint intervals decide, and are never equal.
        if new[1] < old[0] {
            self.levels.double += 1;
            return Order::Behind;
        }
        if new[0] > old[1] {
            self.levels.double += 1;
            return Order::Before;
        }
        self.levels.exact += 1;
        let [new, old] = [candidate, nearest].map(TriangleId::new);
        let Some(order) = self.exact.depth_order(new, old, pixel) else {
            return Order::Behind;
        };
        let wins = match order.moved {
            _ if order.at_sample == Ordering::Equal && mutant::is(Mutant::LowestIdFirst) => {
                candidate < nearest
            }
            Ordering::Less => true,
            Ordering::Greater => false,
            Ordering::Equal => lowest_id,
        };
        if order.moved == Ordering::Equal {
            (self.same_plane, self.candidate_wins) = (pair, wins);
        }
        match order.at_sample {
            Ordering::Equal => Order::SameDepth { candidate_wins: wins },
            _ if wins => Order::Before,
            _ => Order::Behind,
        }
    }

    /// f64 rows of a drawn triangle, by its number; `None` when V = 0.
    pub(super) fn rows_of(&mut self, drawn: &[Drawn], number: u32) -> Option<Rc<TriangleRows>> {
        let number = number as usize;
        if let Some(Some(rows)) = self.rows.get(number) {
            return Some(Rc::clone(rows));
        }
        let id = TriangleId::new(drawn[number].id);
        let corners = self.mesh.triangle(id);
        let rows = Projection::new(self.plane, corners).rows(self.plane, id, || {
            let exact = ExactTriangle::new(self.plane, corners)?;
            Some((exact.volume_sign, exact.volume(self.plane)))
        })?;
        let rows = Rc::new(rows);
        self.keep(number, Rc::clone(&rows));
        Some(rows)
    }

    fn keep(&mut self, number: usize, rows: Rc<TriangleRows>) {
        if self.kept == KEPT_ROWS {
            (self.rows, self.kept) = (Vec::new(), 0);
        }
        if self.rows.len() <= number {
            self.rows.resize(number + 1, None);
        }
        self.rows[number] = Some(rows);
        self.kept += 1;
    }
}

/// How a candidate lies to the nearest triangle so far.
enum Order {
    Before,
    Behind,
    SameDepth { candidate_wins: bool },
}

/// Counts a covering triangle, where counts are asked for.
fn count(blocks: &mut Blocks, block: usize, lane: usize, drawn: &Drawn) {
    if let Some(crossed) = blocks.crossed.get_mut(block) {
        crossed.0[lane] += 1;
        let sign = if mutant::is(Mutant::UnsignedCount) { 1 } else { drawn.volume_sign };
        blocks.signed[block].0[lane] += sign;
    }
}

/// Whether a planted mistake keeps the nearest so far, by lower bounds of 1/t.
fn planted_reject(new: f64, old: f64) -> bool {
    mutant::is(Mutant::SingleDepth) && (new as f32) <= (old as f32)
        || mutant::is(Mutant::DoubleDepth) && new <= old
        || mutant::is(Mutant::DepthEpsilon) && (new - old).abs() < 1e-6 * old
}
