//! Whether, and how, a triangle covers a sample: f64 rows with their bounds, then integers.
//!
//! A filter that cannot certify a sign hands the one decision it has to the exact stage; nothing is
//! decided by a tolerance. These rows hold over the whole frame, so that what they leave open at a
//! sample is a property of triangle and sample: it is what the answer reports as its level.

use super::exact::ExactStage;
use super::rows::TriangleRows;
use crate::mesh::TriangleId;
use crate::mutant::{self, Mutant};
use crate::pixel::Pixel;
use crate::visibility::LevelCounts;

/// A triangle at a sample that it covers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fragment {
    pub(super) triangle: TriangleId,
    /// Its coverage of the sample was decided exactly.
    pub(super) exact: bool,
    /// The sample lies exactly on one of its edges.
    pub(super) on_edge: bool,
    /// Another covering triangle has exactly the same depth at the sample.
    pub(super) same_depth: bool,
    /// Certain bounds of 1/t, up to the frame's common factor.
    pub(super) inverse_depth: [f64; 2],
}

/// How a triangle covers a sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Coverage {
    pub(super) exact: bool,
    pub(super) on_edge: bool,
}

/// Whether, and how, the triangle covers the sample; edges that are not `open` certainly do.
#[inline]
pub(super) fn coverage(
    exact: &mut ExactStage<'_>,
    levels: &mut LevelCounts,
    rows: &TriangleRows,
    open: [bool; 3],
    pixel: Pixel,
) -> Option<Coverage> {
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
        levels.double += 1;
        return certain.then_some(Coverage { exact: false, on_edge: false });
    }
    levels.exact += 1;
    exact_coverage(exact, rows, pixel)
}

/// Coverage by the tie rule, for the edges that f64 leaves open.
#[cold]
fn exact_coverage(
    exact: &mut ExactStage<'_>,
    rows: &TriangleRows,
    pixel: Pixel,
) -> Option<Coverage> {
    let [x, y] = pixel.sample();
    let triangle = exact.triangle(rows.id)?;
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
