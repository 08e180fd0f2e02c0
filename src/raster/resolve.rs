//! The answer's numbers for the visible triangle of each pixel.
//!
//! They depend on (triangle, pixel) alone, never on the order of the work: weights and t come from
//! the triangle's integer rows, the level from its f64 rows over the whole frame.

use super::blocks;
use super::coverage::{Coverage, coverage};
use super::doubt::Doubt;
use super::exact::ExactTriangle;
use super::rows::{TriangleRows, U};
use super::strips::Strip;
use super::tile::{Tile, Tiling};
use crate::mesh::{Barycentric, TriangleId};
use crate::mutant::{self, Mutant};
use crate::pixel::Pixel;
use crate::visibility::{Cover, Facing, Level, LevelCounts, Visible};
use std::rc::Rc;

/// Turns a tile's z-buffer into visible triangles, and writes what was counted.
pub(super) fn write(
    tiling: &Tiling<'_>,
    tile: &Tile,
    doubt: &mut Doubt<'_>,
    visible: &mut Strip<'_, Option<Visible>>,
    cover: Option<&mut Strip<'_, Cover>>,
) {
    let (grid, window) = (&tiling.blocks, doubt.window);
    let mut last: Option<(u32, Rc<TriangleRows>, Rc<ExactTriangle>)> = None;
    for pixel in window.pixels() {
        let (block, lane) = blocks::place(grid, window, pixel);
        let Some((number, same_depth)) = tile.winner(block, lane) else { continue };
        let drawn = &tile.drawn[number as usize];
        // Neighbouring pixels mostly show the same triangle.
        let known = match last.take() {
            Some(known) if known.0 == drawn.id => Some(known),
            _ => doubt.rows_of(&tile.drawn, number).and_then(|rows| {
                let exact = doubt.exact.triangle(TriangleId::new(drawn.id))?;
                Some((drawn.id, rows, exact))
            }),
        };
        let Some((id, rows, triangle)) = known else { continue };
        // What the visible triangle's own coverage takes; counted when it was decided.
        let mut counted = LevelCounts::default();
        let covered = coverage(&mut doubt.exact, &mut counted, &rows, [true; 3], pixel);
        let covered = covered.unwrap_or(Coverage { exact: true, on_edge: true });
        visible.row_from(pixel)[0] =
            Some(answer(pixel, TriangleId::new(id), covered, same_depth, &triangle));
        last = Some((id, rows, triangle));
    }
    if let Some(cover) = cover {
        for pixel in window.pixels() {
            let (block, lane) = blocks::place(grid, window, pixel);
            cover.row_from(pixel)[0] = tile.blocks.cover(block, lane);
        }
    }
}

/// The answer for one triangle at one pixel.
pub(super) fn answer(
    pixel: Pixel,
    id: TriangleId,
    covered: Coverage,
    same_depth: bool,
    triangle: &ExactTriangle,
) -> Visible {
    // t is off by at most 6u; the factors' own roundings and products take 2u more.
    let t = triangle.t_at(pixel);
    let on_edge = covered.on_edge && !mutant::is(Mutant::UnmarkedTies);
    let tie = on_edge || same_depth;
    let front = (triangle.volume_sign < 0) != mutant::is(Mutant::FacingFlipped);
    Visible {
        triangle: id,
        facing: if front { Facing::Front } else { Facing::Back },
        level: if covered.exact || tie { Level::Exact } else { Level::Double },
        tie,
        barycentric: Barycentric(triangle.weights_at(pixel)),
        t_lo: t * (1.0 - 12.0 * U),
        t_hi: t * (1.0 + 12.0 * U),
    }
}
