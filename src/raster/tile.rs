//! One tile: its triangles in the order of ids, over its pixels, into a z-buffer of intervals.
//!
//! A filter that cannot certify a sign hands the one decision it has to the exact stage; nothing is
//! decided by a tolerance. What was found is turned into the answer's shape by `resolve`.

use super::bins::{Bins, Candidate};
use super::bounds::Rectangle;
use super::exact::ExactStage;
use super::image_plane::ImagePlane;
use super::resolve::resolve;
use super::rows::TriangleRows;
use super::span::{range_over, span};
use crate::mesh::{TriangleId, TriangleMesh};
use crate::mutant::{self, Mutant};
use crate::pixel::{Pixel, Window};
use crate::visibility::{Counting, Cover, LevelCounts, VisibilityTile};
use std::cmp::Ordering;

/// What the z-buffer holds of the nearest triangle so far.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fragment {
    pub(super) triangle: TriangleId,
    /// Its coverage of the sample was decided exactly.
    pub(super) exact: bool,
    /// The sample lies exactly on one of its edges.
    pub(super) on_edge: bool,
    /// Another covering triangle has exactly the same depth at the sample.
    ///
    /// Independent of the order of work: the first triangle of the least t replaces what was there
    /// as strictly nearer, without a mark. Every later one of that t meets a triangle of that t, and
    /// whichever survives is marked; nothing strictly nearer comes to clear it. So at the end it is
    /// set if and only if two triangles share the least t.
    pub(super) same_depth: bool,
    /// Certain bounds of 1/t, up to the frame's common factor.
    pub(super) inverse_depth: [f64; 2],
}

/// How a triangle covers a sample.
#[derive(Clone, Copy)]
pub(super) struct Coverage {
    exact: bool,
    on_edge: bool,
}

/// What becomes of the fragments of a tile.
pub(super) trait Keep {
    /// A triangle covers the sample at `index` of the tile.
    fn keep(tile: &mut Tile<'_, Self>, index: usize, rows: &TriangleRows, fragment: Fragment)
    where
        Self: Sized;
}

/// A tile at work.
pub(super) struct Tile<'a, K> {
    pub(super) window: Window,
    pub(super) exact: ExactStage<'a>,
    pub(super) kept: K,
    levels: LevelCounts,
}

/// The nearest fragment of each pixel, and counts of all where they are asked for.
struct Nearest {
    fragments: Vec<Option<Fragment>>,
    cover: Vec<Cover>,
}

/// Everything visible in one tile.
pub(super) fn rasterize_tile(
    plane: &ImagePlane,
    mesh: &TriangleMesh,
    bins: &Bins<'_>,
    counting: Counting,
    tile_window: Window,
) -> VisibilityTile {
    let VisibilityTile { window: tile_window, cover, .. } =
        VisibilityTile::empty(tile_window, counting);
    let nearest = Nearest { fragments: vec![None; tile_window.len()], cover };
    let mut tile = Tile::new(tile_window, ExactStage::new(plane, mesh), nearest);
    for candidate in bins.candidates(tile_window) {
        tile.scan(&candidate);
    }
    VisibilityTile {
        window: tile_window,
        visible: resolve(tile_window, &tile.kept.fragments, &mut tile.exact),
        cover: tile.kept.cover,
        levels: tile.levels,
    }
}

impl<'a, K: Keep> Tile<'a, K> {
    /// A tile before its first triangle.
    pub(super) fn new(window: Window, exact: ExactStage<'a>, kept: K) -> Self {
        Self { window, exact, kept, levels: LevelCounts::default() }
    }

    /// Tests every pixel that the triangle can cover.
    pub(super) fn scan(&mut self, candidate: &Candidate) {
        let rows = &candidate.rows;
        let Some(pixels) = candidate.pixels.intersection(Rectangle::of(self.window)) else {
            return;
        };
        let mut pixels = pixels;
        if mutant::is(Mutant::TileEdges) {
            pixels.x1 = pixels.x1.min(self.window.x1() - 1);
            if pixels.x1 <= pixels.x0 {
                return;
            }
        }
        // Drop the triangle where one edge excludes the whole rectangle; note the edges that leave
        // no doubt in it.
        let mut open = [true; 3];
        for (edge, open) in rows.edges.iter().zip(&mut open) {
            let [least, greatest] = range_over(edge, pixels);
            let corner = if mutant::is(Mutant::TileCorner) { least } else { greatest };
            if corner < -edge.bound {
                return;
            }
            // True values are then at least 3·bound, so each pixel's own test would certify it too:
            // a level does not depend on the tile.
            *open = least.is_nan() || least <= 4.0 * edge.bound;
            if mutant::is(Mutant::ClosedEdges) {
                *open = least < -edge.bound;
            }
        }
        for y in pixels.y0..pixels.y1 {
            let y_sample = f64::from(y) + 0.5;
            let (x0, x1) = span(rows, open, pixels, y_sample);
            for x in x0..x1 {
                let pixel = Pixel { x, y };
                if let Some(coverage) = self.coverage(rows, open, pixel) {
                    self.keep(rows, pixel, coverage);
                }
            }
        }
    }

    /// Whether, and how, the triangle covers the sample.
    #[inline]
    fn coverage(&mut self, rows: &TriangleRows, open: [bool; 3], pixel: Pixel) -> Option<Coverage> {
        let [x, y] = pixel.sample();
        let (mut certain, mut outside) = (true, false);
        for (edge, open) in rows.edges.iter().zip(open) {
            if open {
                let value = edge.at(x, y);
                certain &= value > edge.bound;
                outside |= value < -edge.bound;
            }
        }
        if certain || outside {
            self.levels.double += 1;
            return certain.then_some(Coverage { exact: false, on_edge: false });
        }
        self.levels.exact += 1;
        self.exact_coverage(rows, pixel)
    }

    /// Coverage by the tie rule, for the edges that f64 leaves open.
    #[cold]
    fn exact_coverage(&mut self, rows: &TriangleRows, pixel: Pixel) -> Option<Coverage> {
        let [x, y] = pixel.sample();
        let triangle = self.exact.triangle(rows.id)?;
        let mut on_edge = false;
        for (edge, exact) in rows.edges.iter().zip(&triangle.edges) {
            if edge.at(x, y) > edge.bound {
                continue;
            }
            let sign = exact.sign_at(pixel);
            if mutant::is(Mutant::SignBit) && sign == 0 {
                match edge.at(x, y).is_sign_negative() {
                    true => return None,
                    false => continue,
                }
            }
            if exact.moved_sign(sign) <= 0 && !(sign == 0 && mutant::is(Mutant::InclusiveEdges)) {
                return None;
            }
            if sign == 0 && mutant::is(Mutant::ExclusiveEdges) {
                return None;
            }
            on_edge |= sign == 0;
        }
        Some(Coverage { exact: true, on_edge })
    }

    /// Hands on that a triangle covers a sample.
    #[inline]
    fn keep(&mut self, rows: &TriangleRows, pixel: Pixel, coverage: Coverage) {
        let [x, y] = pixel.sample();
        let fragment = Fragment {
            triangle: rows.id,
            exact: coverage.exact,
            on_edge: coverage.on_edge,
            same_depth: false,
            inverse_depth: rows.inverse_depth(x, y),
        };
        K::keep(self, self.window.index(pixel), rows, fragment);
    }
}

impl Keep for Nearest {
    /// Counts a covering triangle and keeps it if it is the nearest.
    #[inline]
    fn keep(tile: &mut Tile<'_, Self>, index: usize, rows: &TriangleRows, fragment: Fragment) {
        let mut fragment = fragment;
        if let Some(cover) = tile.kept.cover.get_mut(index) {
            cover.crossed += 1;
            cover.signed += if mutant::is(Mutant::UnsignedCount) { 1 } else { rows.volume_sign };
        }
        if let Some(nearest) = tile.kept.fragments[index] {
            if planted_reject(&fragment, &nearest) {
                return;
            }
            // Compare 1/t: disjoint intervals decide, and are never equal.
            let [low, high] = fragment.inverse_depth;
            let [nearest_low, nearest_high] = nearest.inverse_depth;
            if high < nearest_low {
                tile.levels.double += 1;
                return;
            }
            if low > nearest_high {
                tile.levels.double += 1;
            } else {
                tile.levels.exact += 1;
                if !tile.settle(&mut fragment, nearest, index) {
                    return;
                }
            }
        }
        tile.kept.fragments[index] = Some(fragment);
    }
}

impl Tile<'_, Nearest> {
    /// Orders two triangles whose depth intervals overlap. True where the candidate survives; marks
    /// the survivor where both have the same depth.
    #[cold]
    fn settle(&mut self, candidate: &mut Fragment, nearest: Fragment, index: usize) -> bool {
        let pixel = self.window.pixel(index);
        let order = self.exact.depth_order(candidate.triangle, nearest.triangle, pixel);
        // Only triangles with V ≠ 0 cover, so that there always is an order.
        let Some(order) = order else { return false };
        let wins = match order.moved {
            _ if order.at_sample == Ordering::Equal && mutant::is(Mutant::LowestIdFirst) => {
                candidate.triangle < nearest.triangle
            }
            Ordering::Less => true,
            Ordering::Greater => false,
            // The same plane: the lowest id.
            Ordering::Equal => {
                (candidate.triangle < nearest.triangle) != mutant::is(Mutant::LastIdInPlane)
            }
        };
        if order.at_sample == Ordering::Equal {
            candidate.same_depth = true;
            if let Some(nearest) = &mut self.kept.fragments[index] {
                nearest.same_depth = true;
            }
        }
        wins
    }
}

/// Whether a planted mistake keeps the nearest so far, by its lower bounds of 1/t.
#[inline(always)]
fn planted_reject(candidate: &Fragment, nearest: &Fragment) -> bool {
    let [new, old] = [candidate.inverse_depth[0], nearest.inverse_depth[0]];
    mutant::is(Mutant::SingleDepth) && (new as f32) <= (old as f32)
        || mutant::is(Mutant::DoubleDepth) && new <= old
        || mutant::is(Mutant::DepthEpsilon) && (new - old).abs() < 1e-6 * old
}
