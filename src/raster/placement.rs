//! Which triangles meet which tiles: eight triangles at a time, chunks of them in parallel.
//!
//! A triangle that certainly covers no sample of the window dies here: it lies behind the eye, or its
//! screen box holds no sample. Nothing is clipped: a triangle that reaches the eye's plane gets
//! the whole window, and where a triangle meets many tiles its edges choose among them.
//! Where anything is certified, triangles that the kernels' f64 cannot treat with certainty are *hard*: V too near to 0 for its
//! sign, or numbers beyond the range of f32. They are set up once here, by bounds of their own and
//! exact arithmetic (`bins::set_up`), and drawn one by one.

use super::arithmetic::Kernel;
use super::bins::{Candidate, set_up};
use super::bounds::Region;
use super::frame::{FRONT, Frame};
use super::image_plane::ImagePlane;
use super::octet::{Corners, Images, Lanes, OCTET, Plane, Triple};
use super::order::{self, Order};
use super::rows::U;
use super::screen_box::ScreenBoxes;
use super::tile_lists::{Grid, Listed, TileLists};
use crate::mesh::{TriangleId, TriangleMesh};
use crate::mutant::{self, Mutant};
use crate::pixel::Window;
use crate::simd::SimdLevel;
use fearless_simd::prelude::*;
use fearless_simd::{dispatch, f64x8, mask64x8};
use rayon::prelude::*;

/// Parallel steps: enough for many threads, few enough lists per tile. The number of threads has no
/// say, so that the order of the work is always the same.
const CHUNKS: u32 = 64;

/// Fewest triangles per parallel step: what a step costs by itself is spread over them.
const LEAST_CHUNK: u32 = 1 << 12;

/// A triangle that meets more tiles than this is held against each of them by its edges.
const FEW_TILES: u32 = 4;

/// Pairs that a chunk may list per triangle, and besides: what lists take stays below 2^8 bytes per
/// triangle. Triangles beyond go to every tile.
const PAIRS_PER_TRIANGLE: usize = 16;
const SPARE_PAIRS: usize = 1 << 18;

/// Most of |N|/|V|, and so of 1/w over a tile (times 2): f32 holds twice that, and its products with
/// 2^7 pixels.
const MOST_INVERSE_DEPTH: f64 = 1.2e30;

/// Every tile's triangles.
pub(super) struct Placement {
    grid: Grid,
    chunks: Vec<Chunk>,
    hard: Vec<Candidate>,
    hard_lists: TileLists,
}

/// The triangles of one parallel step.
#[derive(Default)]
struct Chunk {
    /// Triangles of tile i: `ids[starts[i]..starts[i + 1]]`.
    starts: Vec<u32>,
    ids: Vec<u32>,
    /// Their least w (`order::key`).
    keys: Vec<u16>,
    /// Triangles that every tile must look at.
    everywhere: Vec<u32>,
    hard: Vec<u32>,
}

impl Placement {
    /// Sorts all triangles into the tiles of a window.
    pub(super) fn new(
        plane: &ImagePlane,
        frame: &Frame,
        mesh: &TriangleMesh,
        (window, side): (Window, u32),
        simd: SimdLevel,
        kernel: Kernel,
    ) -> Self {
        let grid = Grid::new(window, side);
        let count = mesh.len() as u32;
        let length = count.div_ceil(CHUNKS).next_multiple_of(OCTET as u32).max(LEAST_CHUNK);
        let chunks: Vec<Chunk> = (0..count.div_ceil(length))
            .into_par_iter()
            .map(|chunk| {
                let ids = chunk * length..count.min((chunk + 1).saturating_mul(length));
                let believes = kernel != Kernel::Certain;
                let placing = Placing::new(frame, mesh, window, grid, ids.len(), believes);
                dispatch!(simd.dispatched(), simd => placing.chunk(simd, ids))
            })
            .collect();
        let region = Region::samples(window);
        let hard: Vec<Candidate> = chunks
            .iter()
            .flat_map(|chunk| &chunk.hard)
            .filter_map(|&id| set_up(plane, mesh, region, TriangleId::new(id)))
            .collect();
        let placed = |(number, candidate): (usize, &Candidate)| {
            (number as u32, grid.tiles_of(candidate.pixels))
        };
        let hard_lists = TileLists::new(grid, hard.iter().enumerate().map(placed));
        Self { grid, chunks, hard, hard_lists }
    }

    /// Lists the triangles of a tile, but for the hard ones.
    pub(super) fn triangles(&self, tile: Window, order: &mut Order) {
        let index = self.grid.index(tile);
        order.clear();
        for chunk in &self.chunks {
            let (from, to) = (chunk.starts[index] as usize, chunk.starts[index + 1] as usize);
            order.extend(&chunk.ids[from..to], &chunk.keys[from..to]);
            order.extend_first(&chunk.everywhere);
        }
    }

    /// The hard triangles of a tile.
    pub(super) fn hard(&self, tile: Window) -> impl Iterator<Item = &Candidate> {
        self.hard_lists.of(tile).map(|listed| match listed {
            Listed::Small(number) | Listed::Large(number, _) => &self.hard[number as usize],
        })
    }
}

/// Eight triangles to be placed by their edges.
struct Octet<'a, S: Simd> {
    first: u32,
    tiles: &'a [Lanes<i32>; 2],
    images: &'a Images<S>,
    plane: &'a Plane<S>,
    keys: &'a [u16; 8],
}

/// A chunk at work.
struct Placing<'a> {
    frame: &'a Frame,
    mesh: &'a TriangleMesh,
    window: Window,
    grid: Grid,
    most_pairs: usize,
    /// Whether no triangle is hard.
    believes: bool,
    /// (tile, triangle, key).
    pairs: Vec<(u32, u32, u16)>,
    everywhere: Vec<u32>,
    hard: Vec<u32>,
}

impl<'a> Placing<'a> {
    fn new(
        frame: &'a Frame,
        mesh: &'a TriangleMesh,
        window: Window,
        grid: Grid,
        triangles: usize,
        believes: bool,
    ) -> Self {
        let most_pairs = triangles * PAIRS_PER_TRIANGLE + SPARE_PAIRS;
        let pairs = Vec::with_capacity(triangles * 2);
        let (everywhere, hard) = (Vec::new(), Vec::new());
        Self { frame, mesh, window, grid, most_pairs, believes, pairs, everywhere, hard }
    }

    #[inline(always)]
    fn chunk<S: Simd>(mut self, simd: S, ids: std::ops::Range<u32>) -> Chunk {
        let boxes = ScreenBoxes::new(simd, self.frame, self.window, self.grid);
        let mut corners = Corners::new();
        for first in ids.clone().step_by(OCTET) {
            let count = (ids.end - first).min(OCTET as u32);
            for lane in 0..count {
                corners.set(lane as usize, self.mesh, first + lane);
            }
            self.octet(simd, &boxes, first, count, &corners);
        }
        self.sorted()
    }

    /// Places eight triangles (or the last few).
    #[inline(always)]
    fn octet<S: Simd>(
        &mut self,
        simd: S,
        boxes: &ScreenBoxes<S>,
        first: u32,
        count: u32,
        corners: &Corners,
    ) {
        let images = Images::new(simd, self.frame, corners);
        let [front, behind] = eye_plane(simd, self.frame, &images);
        let mut lanes = ((1_u64 << count) - 1) & !behind;
        if mutant::is(Mutant::MirrorGhost) {
            lanes |= behind & ((1 << count) - 1);
        }
        if mutant::is(Mutant::EyePlaneRejected) {
            lanes &= front;
        }
        if lanes == 0 {
            return;
        }
        let (tiles, empty) = boxes.tiles(simd, &images, front);
        lanes &= !empty;
        if lanes == 0 {
            return;
        }
        let plane = images.plane(simd, self.frame, corners);
        let hard = match self.believes {
            true => 0,
            false => lanes & (hard_lanes(simd, self.frame, &plane) | planted_hard(behind)),
        };
        let mut left = hard;
        while left != 0 {
            self.hard.push(first + left.trailing_zeros());
            left &= left - 1;
        }
        lanes &= !hard;
        let keys = keys(simd, &images, front);
        let mut large = 0_u64;
        let mut left = lanes;
        while left != 0 {
            let lane = left.trailing_zeros() as usize & 7;
            left &= left - 1;
            let [x0, x1] = [tiles[0].0[lane], tiles[1].0[lane]];
            let [y0, y1] = [tiles[0].0[8 + lane], tiles[1].0[8 + lane]];
            let (x1, y1) = (x1 - i32::from(mutant::is(Mutant::ShortBins)), y1);
            if (x1 - x0 + 1) as u32 * (y1 - y0 + 1) as u32 > FEW_TILES {
                large |= 1 << lane;
                continue;
            }
            for row in y0..=y1 {
                for column in x0..=x1 {
                    let tile = row as u32 * self.grid.columns + column as u32;
                    self.pairs.push((tile, first + lane as u32, keys[lane]));
                }
            }
        }
        if large != 0 {
            let octet = Octet { first, tiles: &tiles, images: &images, plane: &plane, keys: &keys };
            self.by_edges(simd, large, &octet);
        }
    }

    /// The tiles of large triangles: those of the box that no edge excludes.
    #[inline(always)]
    fn by_edges<S: Simd>(&mut self, simd: S, large: u64, octet: &Octet<'_, S>) {
        let Octet { first, tiles, images, plane, keys } = *octet;
        let inside = f64x8::splat(simd, 1.0).copysign(plane.volume);
        let (edges, pairs) = (images.edges(), images.size_products());
        let mut rows = [[[0.0_f64; 8]; 4]; 3];
        for k in 0..3 {
            for c in 0..3 {
                (edges[k][c] * inside).store_slice(&mut rows[k][c]);
            }
            (pairs[k] * self.frame.row_error).store_slice(&mut rows[k][3]);
        }
        let side = f64::from(self.grid.side);
        let steps = f64x8::from_slice(simd, &[0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]) * side;
        let mut left = large;
        while left != 0 {
            let lane = left.trailing_zeros() as usize & 7;
            left &= left - 1;
            let id = first + lane as u32;
            let [x0, x1] = [tiles[0].0[lane], tiles[1].0[lane]];
            let [y0, y1] = [tiles[0].0[8 + lane], tiles[1].0[8 + lane]];
            let area = (x1 - x0 + 1) as usize * (y1 - y0 + 1) as usize;
            if self.pairs.len() + area > self.most_pairs {
                self.everywhere.push(id);
                continue;
            }
            // An edge is largest over a tile at one corner sample; `reach` moves there.
            let [a, b, reach] = [0, 1, 2].map(|what| {
                [0, 1, 2].map(|k| {
                    let [a, b, c, e] = [0, 1, 2, 3].map(|c| rows[k][c][lane]);
                    [a, b, c + (side - 1.0) * (a.max(0.0) + b.max(0.0)) + e][what]
                })
            });
            for row in y0..=y1 {
                let y = f64::from(row as u32 + self.grid.first_row) * side + 0.5;
                let base = [0, 1, 2].map(|k| b[k] * y + reach[k]);
                let mut column = x0;
                while column <= x1 {
                    let x =
                        steps + (f64::from(column as u32 + self.grid.first_column) * side + 0.5);
                    let [w0, w1, w2] = [x * a[0] + base[0], x * a[1] + base[1], x * a[2] + base[2]];
                    let met = w0.min(w1).min(w2).simd_ge(0.0).to_bitmask();
                    let mut met = met & ((1_u64 << (x1 - column + 1).min(8)) - 1);
                    while met != 0 {
                        let tile = row as u32 * self.grid.columns + column as u32;
                        self.pairs.push((tile + met.trailing_zeros(), id, keys[lane]));
                        met &= met - 1;
                    }
                    column += 8;
                }
            }
        }
    }

    /// The pairs, sorted by tile.
    fn sorted(self) -> Chunk {
        let mut starts = vec![0_u32; self.grid.len() + 2];
        for &(tile, ..) in &self.pairs {
            starts[tile as usize + 2] += 1;
        }
        for tile in 2..starts.len() {
            starts[tile] += starts[tile - 1];
        }
        // `starts[i + 1]` runs from the start of tile i to its end.
        let (mut ids, mut keys) = (vec![0; self.pairs.len()], vec![0; self.pairs.len()]);
        for &(tile, id, key) in &self.pairs {
            let next = &mut starts[tile as usize + 1];
            (ids[*next as usize], keys[*next as usize]) = (id, key);
            *next += 1;
        }
        Chunk { starts, ids, keys, everywhere: self.everywhere, hard: self.hard }
    }
}

/// Keys of the least w of the triangles that have a certain one.
#[inline(always)]
fn keys<S: Simd>(simd: S, images: &Images<S>, front: u64) -> [u16; 8] {
    let [a, b, c] = &images.points;
    let least = a[2].min(b[2]).min(c[2]);
    let mut lanes = [0.0; 16];
    least.narrow(f64x8::splat(simd, 0.0)).store_slice(&mut lanes);
    let mut keys = [0; 8];
    for (lane, key) in keys.iter_mut().enumerate() {
        *key = if front >> lane & 1 == 1 { order::key(lanes[lane]) } else { 0 };
    }
    keys
}

/// Triangles that are certainly so far before the eye that their screen box is computed, and
/// triangles that certainly lie behind it.
///
/// A triangle with all w_i ≤ 0 covers nothing (`bounds::pixels_of`). w is off by less than 8u·ω·s.
#[inline(always)]
pub(super) fn eye_plane<S: Simd>(simd: S, frame: &Frame, images: &Images<S>) -> [u64; 2] {
    let least = f64x8::splat(simd, MOST_INVERSE_DEPTH.recip());
    let corner = |k: usize| (&images.points[k], images.sizes[k] * frame.w_norm);
    let [a, b, c] = [corner(0), corner(1), corner(2)];
    let front = is_front(least, a) & is_front(least, b) & is_front(least, c);
    let behind = is_behind(a) & is_behind(b) & is_behind(c);
    [front.to_bitmask(), behind.to_bitmask()]
}

/// For a corner and its ω·s. `FRONT` is far above w's error; f32 holds numerator and denominator of
/// every quotient.
#[inline(always)]
fn is_front<S: Simd>(least: f64x8<S>, ([x, y, w], size): (&Triple<S>, f64x8<S>)) -> mask64x8<S> {
    w.simd_gt((size * FRONT).max(least))
        & x.abs().max(y.abs()).max(size).simd_lt(MOST_INVERSE_DEPTH)
}

#[inline(always)]
fn is_behind<S: Simd>((point, size): (&Triple<S>, f64x8<S>)) -> mask64x8<S> {
    (point[2] + size * (8.0 * U)).simd_le(0.0)
}

/// Triangles that are not for the kernels: unless |V| is certainly at least ¾ of what it is computed
/// to be, and N/V of a size for f32 at every sample. NaN makes a triangle hard.
#[inline(always)]
pub(super) fn hard_lanes<S: Simd>(simd: S, frame: &Frame, plane: &Plane<S>) -> u64 {
    let size = plane.volume.abs();
    let certain = size.simd_gt(plane.volume_size * (4.0 * frame.volume_error));
    let most = plane.size * (2.0 * frame.row_magnitude);
    let in_range = most.simd_lt(size * MOST_INVERSE_DEPTH);
    let mut usable = (certain & in_range).to_bitmask();
    if mutant::is(Mutant::DeterminantEpsilon) {
        usable &= size.simd_gt(f64x8::splat(simd, 1e-6)).to_bitmask();
    }
    !usable
}

/// Triangles that a planted mistake has set up one by one.
#[inline(always)]
fn planted_hard(behind: u64) -> u64 {
    if mutant::is(Mutant::MirrorGhost) { behind } else { 0 }
}
