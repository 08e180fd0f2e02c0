//! One tile of the watertight rasterizer: pieces in the order of ids, into an f32 z-buffer.

use super::projection::Projector;
use super::snapped::{Piece, Scannable, sample};
use crate::mesh::Barycentric;
use crate::pixel::{Pixel, Window};
use crate::raster::bounds::Rectangle;
use crate::raster::tile_lists::{Listed, TileLists};
use crate::visibility::{Counting, Facing, Level, VisibilityTile, Visible};

/// The nearest piece so far, and its depth.
#[derive(Clone, Copy)]
struct Fragment {
    piece: u32,
    depth: f32,
}

/// Everything visible in one tile.
pub(super) fn rasterize_tile(
    projector: &Projector<'_>,
    pieces: &[Piece],
    lists: &TileLists,
    counting: Counting,
    window: Window,
) -> VisibilityTile {
    let mut tile = VisibilityTile::empty(window, counting);
    let mut fragments: Vec<Option<Fragment>> = vec![None; window.len()];
    for listed in lists.of(window) {
        let (Listed::Small(number) | Listed::Large(number, _)) = listed;
        let piece = &pieces[number as usize];
        let Some(scannable) = piece.scannable(projector.orientation) else { continue };
        let Some(pixels) = piece.pixels(projector.subpixel_bits, window) else { continue };
        scan(projector, &scannable, pixels, |pixel, values| {
            let index = window.index(pixel);
            if let Some(cover) = tile.cover.get_mut(index) {
                cover.crossed += 1;
                cover.signed += scannable.volume_sign;
            }
            // Nearest is the greatest 1/w; the first drawn stays where depths are equal.
            let depth = scannable.depth(values);
            if fragments[index].is_none_or(|nearest| depth > nearest.depth) {
                fragments[index] = Some(Fragment { piece: number, depth });
            }
        });
        tile.levels.single += pixels.len();
    }
    for (index, fragment) in fragments.iter().enumerate() {
        tile.visible[index] = fragment.and_then(|fragment| {
            let piece = &pieces[fragment.piece as usize];
            let scannable = piece.scannable(projector.orientation)?;
            Some(answer(projector, &scannable, window.pixel(index), fragment.depth))
        });
    }
    tile
}

/// Calls `covered` with the values of the edge functions at every covered sample of a rectangle.
fn scan(
    projector: &Projector<'_>,
    scannable: &Scannable<'_>,
    pixels: Rectangle,
    mut covered: impl FnMut(Pixel, [i64; 3]),
) {
    let edges = &scannable.edges;
    // From one sample to the next an edge function changes by a whole pixel: 2·2^N half steps.
    let step = edges.map(|edge| edge.a << (projector.subpixel_bits.get() + 1));
    for y in pixels.y0..pixels.y1 {
        let first = sample(projector.subpixel_bits, Pixel { x: pixels.x0, y });
        let mut values = edges.map(|edge| edge.at(first));
        for x in pixels.x0..pixels.x1 {
            if (0..3).all(|k| values[k] >= edges[k].least) {
                covered(Pixel { x, y }, values);
            }
            for k in 0..3 {
                values[k] += step[k];
            }
        }
    }
}

fn answer(
    projector: &Projector<'_>,
    scannable: &Scannable<'_>,
    pixel: Pixel,
    depth: f32,
) -> Visible {
    let at = sample(projector.subpixel_bits, pixel);
    let values = scannable.edges.map(|edge| edge.at(at));
    let t = projector.ray_parameter(depth);
    Visible {
        triangle: scannable.piece.id,
        facing: if scannable.volume_sign < 0 { Facing::Front } else { Facing::Back },
        level: Level::Single,
        tie: false,
        barycentric: Barycentric(scannable.weights(values)),
        t_lo: t,
        t_hi: t,
    }
}
