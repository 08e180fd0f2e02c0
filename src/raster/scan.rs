//! One triangle over the pixels of a tile, one by one, in f64: for triangles that the vector kernels
//! do not take, and for layers, which keep every fragment.

use super::bins::Candidate;
use super::bounds::Rectangle;
use super::coverage::{Fragment, coverage};
use super::exact::ExactStage;
use super::span::{range_over, span};
use crate::mutant::{self, Mutant};
use crate::pixel::{Pixel, Window};
use crate::visibility::LevelCounts;

/// Calls `keep` for every pixel of the tile that the triangle covers.
pub(super) fn scan(
    tile: Window,
    candidate: &Candidate,
    exact: &mut ExactStage<'_>,
    levels: &mut LevelCounts,
    mut keep: impl FnMut(Pixel, Fragment),
) {
    let rows = &candidate.rows;
    let Some(pixels) = candidate.pixels.intersection(Rectangle::of(tile)) else {
        return;
    };
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
    }
    for y in pixels.y0..pixels.y1 {
        let y_sample = f64::from(y) + 0.5;
        let (x0, x1) = span(rows, open, pixels, y_sample);
        for x in x0..x1 {
            let pixel = Pixel { x, y };
            if let Some(coverage) = coverage(exact, levels, rows, open, pixel) {
                let [x, y] = pixel.sample();
                let fragment = Fragment {
                    triangle: rows.id,
                    exact: coverage.exact,
                    on_edge: coverage.on_edge,
                    same_depth: false,
                    inverse_depth: rows.inverse_depth(x, y),
                };
                keep(pixel, fragment);
            }
        }
    }
}
