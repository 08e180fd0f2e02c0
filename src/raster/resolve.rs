//! The answer's numbers for the visible triangle of each pixel.
//!
//! They depend on (triangle, pixel) alone, never on the order of the work: weights and t come from
//! the triangle's integer rows.

use super::exact::{ExactStage, ExactTriangle};
use super::rows::U;
use super::tile::Fragment;
use crate::mesh::Barycentric;
use crate::mutant::{self, Mutant};
use crate::pixel::{Pixel, Window};
use crate::visibility::{Facing, Level, Visible};
use std::rc::Rc;

/// Turns a tile's z-buffer into the visible triangles.
pub(super) fn resolve(
    window: Window,
    fragments: &[Option<Fragment>],
    exact: &mut ExactStage<'_>,
) -> Vec<Option<Visible>> {
    let mut last: Option<(Fragment, Rc<ExactTriangle>)> = None;
    let mut visible = Vec::with_capacity(fragments.len());
    for (pixel, fragment) in window.pixels().zip(fragments) {
        visible.push(fragment.and_then(|fragment| {
            // Neighbouring pixels mostly show the same triangle.
            let triangle = match last.take() {
                Some((before, triangle)) if before.triangle == fragment.triangle => triangle,
                _ => exact.triangle(fragment.triangle)?,
            };
            let answer = answer(pixel, &fragment, &triangle);
            last = Some((fragment, triangle));
            Some(answer)
        }));
    }
    visible
}

/// The answer for one fragment.
pub(super) fn answer(pixel: Pixel, fragment: &Fragment, triangle: &ExactTriangle) -> Visible {
    // t is off by at most 6u; the factors' own roundings and products take 2u more.
    let t = triangle.t_at(pixel);
    let on_edge = fragment.on_edge && !mutant::is(Mutant::UnmarkedTies);
    let tie = on_edge || fragment.same_depth;
    let front = (triangle.volume_sign < 0) != mutant::is(Mutant::FacingFlipped);
    Visible {
        triangle: fragment.triangle,
        facing: if front { Facing::Front } else { Facing::Back },
        level: if fragment.exact || tie { Level::Exact } else { Level::Double },
        tie,
        barycentric: Barycentric(triangle.weights_at(pixel)),
        t_lo: t * (1.0 - 12.0 * U),
        t_hi: t * (1.0 + 12.0 * U),
    }
}
