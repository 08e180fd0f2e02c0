//! Where in a rectangle of pixels the edges leave anything to test: rejection and row spans.
//!
//! Both only drop samples that an edge certainly excludes; no sample is accepted here.

use super::bounds::Rectangle;
use super::rows::{Row, TriangleRows};
use crate::mutant::{self, Mutant};

/// Least and greatest computed value of an edge over the samples of a rectangle: a linear function
/// takes them at corners.
pub(super) fn range_over(edge: &Row, pixels: Rectangle) -> [f64; 2] {
    let [[x0, y0], [x1, y1]] = pixels.samples();
    let (x_low, x_high) = if edge.a >= 0.0 { (x0, x1) } else { (x1, x0) };
    let (y_low, y_high) = if edge.b >= 0.0 { (y0, y1) } else { (y1, y0) };
    [edge.at(x_low, y_low), edge.at(x_high, y_high)]
}

/// Rows narrower than this, in pixels, are tested pixel by pixel: two divisions cost as much.
const SHORT_ROW: u32 = 8;

/// The columns of one row of pixels outside which an open edge certainly excludes the triangle.
///
/// Where a·x + r < 0, r = b·y + c, the edge excludes x. The boundary −r/a is computed with a few
/// roundings; with the row's bound added to r and a whole pixel of room on both sides the rest of
/// the error cannot matter: it is relative, 4u of a coordinate below 2^17 (2^-34 of a pixel).
pub(super) fn span(rows: &TriangleRows, open: [bool; 3], pixels: Rectangle, y: f64) -> (u32, u32) {
    if pixels.x1 - pixels.x0 < SHORT_ROW {
        return (pixels.x0, pixels.x1);
    }
    let (mut low, mut high) = (f64::from(pixels.x0), f64::from(pixels.x1));
    for (edge, open) in rows.edges.iter().zip(open) {
        if open && edge.a != 0.0 {
            let boundary = -((edge.b * y + edge.c) + 2.0 * edge.bound) / edge.a;
            if edge.a > 0.0 {
                let room = if mutant::is(Mutant::ShortSpan) { -1.0 } else { 1.0 };
                low = low.max(boundary.floor() - room);
            } else {
                high = high.min(boundary.ceil() + 1.0);
            }
        }
    }
    if low < high { (low as u32, high as u32) } else { (pixels.x0, pixels.x0) }
}
