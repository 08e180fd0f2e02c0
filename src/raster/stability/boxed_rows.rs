//! A triangle's rows with bounds that hold over a box around a sample instead of at the sample.
//!
//! **Bounds.** A row's own bound E is K·(q_A·W + q_B·H + q_C), W and H the frame's sides (at least
//! 1), K·q_A the error of A, and so on. At a point up to h outside the frame the error is at most
//! E·(1 + h), because h ≤ h·W. Twice that is taken: the second half, at least 8u of the sum of the
//! magnitudes, has room for the roundings of x ± h (one, u) and of the values computed here (in all
//! less than 6u). No sign is decided exactly here.

use crate::pixel::Pixel;
use crate::raster::rows::{Row, TriangleRows, U};

/// The rows of a triangle for boxes of half width `h`: an edge's value at a *centre* above its
/// bound is certainly positive at every point of the box, below its negative certainly negative at
/// every point. The plane's bound holds for its value at each *point* of the box.
pub(super) fn boxed(rows: &TriangleRows, h: f64) -> TriangleRows {
    let mut boxed = rows.clone();
    for edge in &mut boxed.edges {
        // Over the box the true value changes by h·(|A| + |B|): a sum of non-negative numbers with
        // at most 5 roundings.
        let change = h * (edge.a.abs() + edge.b.abs());
        edge.bound = (change + error_in_box(edge, h)) * (1.0 + 8.0 * U);
    }
    boxed.plane.bound = error_in_box(&boxed.plane, h);
    boxed
}

fn error_in_box(row: &Row, h: f64) -> f64 {
    row.bound * (2.0 + 2.0 * h)
}

/// Whether a triangle certainly covers every point of the box around a pixel's centre.
pub(super) fn covers_all(boxed: &TriangleRows, pixel: Pixel) -> bool {
    let [x, y] = pixel.sample();
    boxed.edges.iter().all(|edge| edge.at(x, y) > edge.bound)
}

/// Whether a triangle certainly covers no point of the box around a pixel's centre.
pub(super) fn covers_nothing(boxed: &TriangleRows, pixel: Pixel) -> bool {
    let [x, y] = pixel.sample();
    boxed.edges.iter().any(|edge| edge.at(x, y) < -edge.bound)
}

/// Whether, at every point of the box, `other` certainly lies behind `winner`, which covers it.
///
/// 1/t of both is linear in (x, y), and so is their difference: it is least at a corner. Where
/// `other`'s row is not positive it covers nothing, so that the continued row may be compared.
pub(super) fn is_behind(other: &TriangleRows, winner: &TriangleRows, pixel: Pixel, h: f64) -> bool {
    let [x, y] = pixel.sample();
    [[x - h, y - h], [x + h, y - h], [x - h, y + h], [x + h, y + h]]
        .iter()
        .all(|&[x, y]| other.inverse_depth(x, y)[1] < winner.inverse_depth(x, y)[0])
}
