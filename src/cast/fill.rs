//! From ids to what is known of a surface: weights, bounds of t and level, eight samples at a time.
//!
//! The same numbers as [`candidate::surface`], bit for bit: the same operations in the same order on
//! pairs, none of them fused. What depends on the triangle alone, the cross products of its edge
//! functions and |V|, is computed once and kept for the samples that follow. Samples that are
//! not clear of an edge for f32, about one in 10³, are looked at one by one.

use super::candidate::{self, CLEAR_EDGE, Candidate, T_PADDING};
use super::coverage;
use super::pair::{self, PairVector};
use super::single::ShearedRay;
use super::tile::{Frame, NOTHING, Samples, lane_of};
use super::visible;
use crate::accel::{GROUP, LeafTriangle};
use crate::mesh::{Barycentric, TriangleId};
use crate::mutant;
use crate::pixel::{Pixel, Window};
use crate::simd::SimdLevel;
use crate::visibility::{Facing, Level, Visible};
use fearless_simd::{Simd, SimdBase, SimdMask, dispatch, f64x8};

/// Places of the table of triangles: a tile seldom shows more, and the rows of a tile share them.
const PLACES: usize = 1024;

/// What a triangle brings to all its samples.
#[derive(Clone, Copy, Debug)]
struct Known {
    id: u32,
    /// Per corner and axis, the high and low part of a_j × E_i.
    high: [[f64; 3]; 3],
    low: [[f64; 3]; 3],
    /// Per corner, [`CLEAR_EDGE`] of the vectors' sizes without d.
    clear: [f64; 3],
    /// |V|.
    plane: f64,
    facing: Facing,
    /// Whether the scene holds it more than once.
    copied: bool,
}

/// The triangles of the last samples, each with one place.
pub(super) struct Table(Vec<Known>);

impl Table {
    pub(super) fn new() -> Self {
        let nothing = Known {
            id: NOTHING,
            high: [[0.0; 3]; 3],
            low: [[0.0; 3]; 3],
            clear: [f64::INFINITY; 3],
            plane: 0.0,
            facing: Facing::Front,
            copied: false,
        };
        Self(vec![nothing; PLACES])
    }
}

/// Fills a tile's columns of a strip's rows; `first` is the tile's first column there.
pub(super) fn fill(
    frame: &Frame<'_>,
    window: Window,
    level: SimdLevel,
    samples: &Samples,
    table: &mut Table,
    rows: &mut [&mut [Option<Visible>]],
    first: usize,
) {
    dispatch!(
        level.dispatched(),
        simd => fill_tile(simd, frame, window, samples, table, rows, first)
    );
}

#[inline(always)]
fn fill_tile<S: Simd>(
    simd: S,
    frame: &Frame<'_>,
    window: Window,
    samples: &Samples,
    table: &mut Table,
    rows: &mut [&mut [Option<Visible>]],
    first: usize,
) {
    let width = window.width() as usize;
    let mut group = Group::EMPTY;
    let mut found = Found::EMPTY;
    for y in 0..rows.len() {
        let row = &mut rows[y][first..first + width];
        let mut x = 0;
        while x < width {
            let places = &mut row[x..(x + GROUP).min(width)];
            for i in 0..GROUP {
                let (block, lane) = lane_of(x + i, y);
                group.ids[i] = if i < places.len() { samples.ids[block][lane] } else { NOTHING };
                group.ties[i] = samples.is_tie(block, lane);
            }
            let pixel = Pixel { x: window.x0() + x as u32, y: window.y0() + y as u32 };
            x += GROUP;
            if group.ids == [NOTHING; GROUP] {
                places.fill(None);
                continue;
            }
            gather(frame, table, &mut group);
            let [d, dx, _] = frame.view.ray(pixel).directions;
            evaluate(simd, &group.lanes, d, dx, &mut found);
            write(frame, pixel, &group, &found, places);
        }
    }
}

/// Eight samples side by side and their triangles.
struct Group {
    ids: [u32; GROUP],
    ties: [bool; GROUP],
    lanes: Lanes,
    facings: [Facing; GROUP],
    copied: [bool; GROUP],
    /// The triangle of all lanes, or [`NOTHING`] where they are mixed.
    only: u32,
}

impl Group {
    const EMPTY: Self = Self {
        ids: [NOTHING; GROUP],
        ties: [false; GROUP],
        lanes: Lanes::EMPTY,
        facings: [Facing::Front; GROUP],
        copied: [false; GROUP],
        only: NOTHING,
    };
}

/// Brings what is known of the samples' triangles into lanes.
#[inline(always)]
fn gather(frame: &Frame<'_>, table: &mut Table, group: &mut Group) {
    let id = group.ids[0];
    if id != NOTHING && group.ids == [id; GROUP] {
        if group.only == id {
            return;
        }
        let place = look_up(frame, table, id);
        let known = &table.0[place];
        let lanes = &mut group.lanes;
        for corner in 0..3 {
            for axis in 0..3 {
                lanes.high[corner][axis] = [known.high[corner][axis]; GROUP];
                lanes.low[corner][axis] = [known.low[corner][axis]; GROUP];
            }
            lanes.clear[corner] = [known.clear[corner]; GROUP];
        }
        lanes.plane = [known.plane; GROUP];
        group.facings = [known.facing; GROUP];
        group.copied = [known.copied; GROUP];
        group.only = id;
        return;
    }
    group.only = NOTHING;
    let mut last = NOTHING;
    let mut place = 0;
    for i in 0..GROUP {
        let id = group.ids[i];
        if id == NOTHING {
            continue;
        }
        if id != last {
            place = look_up(frame, table, id);
            last = id;
        }
        let known = &table.0[place];
        let lanes = &mut group.lanes;
        for corner in 0..3 {
            for axis in 0..3 {
                lanes.high[corner][axis][i] = known.high[corner][axis];
                lanes.low[corner][axis][i] = known.low[corner][axis];
            }
            lanes.clear[corner][i] = known.clear[corner];
        }
        lanes.plane[i] = known.plane;
        group.facings[i] = known.facing;
        group.copied[i] = known.copied;
    }
}

/// Writes the samples.
#[inline(always)]
fn write(
    frame: &Frame<'_>,
    pixel: Pixel,
    group: &Group,
    found: &Found,
    places: &mut [Option<Visible>],
) {
    for (i, to) in places.iter_mut().enumerate() {
        let id = group.ids[i];
        if id == NOTHING {
            *to = None;
            continue;
        }
        if found.clear >> i & 1 == 0 {
            let pixel = Pixel { x: pixel.x + i as u32, y: pixel.y };
            *to = look_closely(frame, pixel, id, group.ties[i]);
            continue;
        }
        let tie = group.ties[i] || group.copied[i];
        let weights = [found.weights[0][i], found.weights[1][i], found.weights[2][i]];
        *to = Some(Visible {
            triangle: TriangleId::new(id),
            facing: group.facings[i],
            level: if tie { Level::Exact } else { Level::Single },
            tie,
            barycentric: Barycentric(mutant::shifted(weights)),
            t_lo: frame.view.camera_t(found.t[0][i]),
            t_hi: frame.view.camera_t(found.t[1][i]),
        });
    }
}

/// A sample that may lie near an edge.
#[cold]
#[inline(never)]
fn look_closely(frame: &Frame<'_>, pixel: Pixel, id: u32, tie: bool) -> Option<Visible> {
    let ray = frame.view.ray(pixel);
    let id = TriangleId::new(id);
    let copies = 1 + frame.accelerator.copies_of(id).len() as u32;
    let triangle = LeafTriangle { vertices: frame.mesh.triangle(id), id, copies };
    let covering = coverage::decide(&ray, &ShearedRay::new(&ray), &triangle).0?;
    let mut candidate = Candidate::new(&ray, &triangle, covering);
    candidate.shared |= tie;
    Some(visible(&frame.view, &ray, &mut candidate))
}

/// The place of a triangle in the table.
#[inline(always)]
fn look_up(frame: &Frame<'_>, table: &mut Table, id: u32) -> usize {
    // Fibonacci hashing: the high bits of the product with 2^32 over the golden ratio.
    let place = (id.wrapping_mul(0x9e37_79b9) >> 22) as usize % PLACES;
    if table.0[place].id != id {
        table.0[place] = learn(frame, id);
    }
    place
}

/// Computes what a triangle brings.
#[inline(never)]
fn learn(frame: &Frame<'_>, id: u32) -> Known {
    let triangle = TriangleId::new(id);
    let v = frame.mesh.triangle(triangle).map(|vertex| vertex.map(f64::from));
    // Any ray will do: |V| and its sign depend on the eye alone.
    let ray = frame.view.ray(Pixel { x: 0, y: 0 });
    let edges = candidate::edge_pairs(ray.eye, &v);
    let crosses: [PairVector; 3] = std::array::from_fn(|i| pair::cross(&edges[i][0], &edges[i][1]));
    let front =
        (frame.sign_of_plane(triangle, &v) < 0) != mutant::is(mutant::Mutant::FacingFlipped);
    Known {
        id,
        high: std::array::from_fn(|i| crosses[i].high),
        low: std::array::from_fn(|i| crosses[i].low),
        clear: std::array::from_fn(|i| {
            let [a, e] = &edges[i];
            CLEAR_EDGE * (a.largest() * e.largest())
        }),
        plane: candidate::plane_magnitude(&ray, &v, &edges),
        facing: if front { Facing::Front } else { Facing::Back },
        copied: !frame.accelerator.copies_of(triangle).is_empty(),
    }
}

/// [`Known`] of eight samples, over lanes.
#[repr(align(64))]
struct Lanes {
    high: [[[f64; GROUP]; 3]; 3],
    low: [[[f64; GROUP]; 3]; 3],
    clear: [[f64; GROUP]; 3],
    plane: [f64; GROUP],
}

impl Lanes {
    const EMPTY: Self = Self {
        high: [[[0.0; GROUP]; 3]; 3],
        low: [[[0.0; GROUP]; 3]; 3],
        clear: [[f64::INFINITY; GROUP]; 3],
        plane: [0.0; GROUP],
    };
}

/// What comes out, over lanes.
#[repr(align(64))]
struct Found {
    weights: [[f64; GROUP]; 3],
    t: [[f64; GROUP]; 2],
    /// Bit per lane: clear of every edge.
    clear: u32,
}

impl Found {
    const EMPTY: Self = Self { weights: [[0.0; GROUP]; 3], t: [[0.0; GROUP]; 2], clear: 0 };
}

/// The lanes of a vector.
const NUMBERS: [f64; GROUP] = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];

/// Evaluates eight samples from the direction `d` on, `dx` apart: see [`candidate::surface`].
#[inline(always)]
fn evaluate<S: Simd>(simd: S, lanes: &Lanes, d: [f64; 3], dx: [f64; 3], found: &mut Found) {
    let numbers = f64x8::load_array_ref(simd, &NUMBERS);
    // Directions are exact on the lattice.
    let mut direction = [numbers; 3];
    let mut largest = f64x8::splat(simd, 0.0);
    for k in 0..3 {
        direction[k] = f64x8::splat(simd, d[k]) + numbers * f64x8::splat(simd, dx[k]);
        largest = largest.max(direction[k].abs());
    }
    let mut w = [numbers; 3];
    let mut clear = u32::MAX;
    for i in 0..3 {
        w[i] = dot(simd, &lanes.high[i], &lanes.low[i], &direction).abs();
        let threshold = f64x8::load_array_ref(simd, &lanes.clear[i]) * largest;
        clear &= w[i].simd_gt(threshold).to_bitmask() as u32;
    }
    let speed = (w[0] + w[1]) + w[2];
    let t = f64x8::load_array_ref(simd, &lanes.plane) / speed;
    for i in 0..3 {
        (w[i] / speed).store_array(&mut found.weights[i]);
    }
    for i in 0..2 {
        (t * f64x8::splat(simd, T_PADDING[i])).store_array(&mut found.t[i]);
    }
    found.clear = clear;
}

/// As `pair::dot` with a vector without low parts.
#[inline(always)]
fn dot<S: Simd>(
    simd: S,
    high: &[[f64; GROUP]; 3],
    low: &[[f64; GROUP]; 3],
    direction: &[f64x8<S>; 3],
) -> f64x8<S> {
    let mut products = *direction;
    let mut tails = *direction;
    for k in 0..3 {
        let a = f64x8::load_array_ref(simd, &high[k]);
        let (product, error) = two_product(simd, a, direction[k]);
        products[k] = product;
        tails[k] = error + f64x8::load_array_ref(simd, &low[k]) * direction[k];
    }
    let (s1, e1) = two_sum(products[0], products[1]);
    let (s2, e2) = two_sum(s1, products[2]);
    s2 + (((tails[0] + tails[1]) + tails[2]) + (e1 + e2))
}

/// As `expansion::two_sum`.
#[inline(always)]
fn two_sum<S: Simd>(a: f64x8<S>, b: f64x8<S>) -> (f64x8<S>, f64x8<S>) {
    let sum = a + b;
    let b_part = sum - a;
    let a_part = sum - b_part;
    (sum, (a - a_part) + (b - b_part))
}

/// As `expansion::two_product`.
#[inline(always)]
fn two_product<S: Simd>(simd: S, a: f64x8<S>, b: f64x8<S>) -> (f64x8<S>, f64x8<S>) {
    let product = a * b;
    let ((a_hi, a_lo), (b_hi, b_lo)) = (split(simd, a), split(simd, b));
    let error = ((a_hi * b_hi - product) + a_hi * b_lo + a_lo * b_hi) + a_lo * b_lo;
    (product, error)
}

#[inline(always)]
fn split<S: Simd>(simd: S, a: f64x8<S>) -> (f64x8<S>, f64x8<S>) {
    let scaled = a * f64x8::splat(simd, f64::from((1 << 27) + 1));
    let hi = scaled - (scaled - a);
    (hi, a - hi)
}
