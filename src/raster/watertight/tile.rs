//! One tile of the watertight rasterizer: pieces in the order of ids, into a z-buffer, f32 or of few bits.

use super::Snapped;
use super::depth_buffer::DepthBuffer;
use super::projection::Projector;
use super::snapped::{Scannable, sample};
use crate::mesh::Barycentric;
use crate::pixel::{Pixel, Window};
use crate::raster::bounds::Rectangle;
use crate::raster::strips::Strip;
use crate::raster::tile_lists::Listed;
use crate::visibility::{Counting, Cover, Facing, Level, LevelCounts, VisibilityTile, Visible};

/// What is compared: interpolated depths as they are, or as a depth buffer stores them.
pub(super) struct DepthTest {
    pub(super) buffer: Option<DepthBuffer>,
    /// Depth along the view axis per unit of t.
    pub(super) z_per_t: f64,
}

impl DepthTest {
    /// The lower, the nearer; a depth is an interpolated 1/w.
    fn rank(&self, projector: &Projector<'_>, depth: f32) -> f64 {
        match &self.buffer {
            None => -f64::from(depth),
            Some(buffer) => buffer.stored(projector.ray_parameter(depth) * self.z_per_t),
        }
    }
}

/// The nearest piece so far, and its depth.
#[derive(Clone, Copy)]
struct Fragment {
    piece: u32,
    depth: f32,
    rank: f64,
    /// Another triangle has the same rank.
    tie: bool,
}

/// Everything visible in one tile.
pub(super) fn rasterize_tile(
    snapped: &Snapped<'_>,
    counting: Counting,
    window: Window,
) -> VisibilityTile {
    let Snapped { projector, test, pieces, .. } = snapped;
    let mut tile = VisibilityTile::empty(window, counting);
    let fragments = draw(snapped, window, &mut tile.cover, &mut tile.levels);
    for (index, fragment) in fragments.iter().enumerate() {
        tile.visible[index] = fragment.and_then(|fragment| {
            let piece = &pieces[fragment.piece as usize];
            let scannable = piece.scannable(projector.orientation)?;
            let tie = fragment.tie && test.buffer.is_some();
            let seen = answer(projector, &scannable, window.pixel(index), fragment.depth);
            Some(Visible { tie, ..seen })
        });
    }
    tile
}

/// Writes a tile's ids and t.
pub(super) fn write_nearest(
    snapped: &Snapped<'_>,
    window: Window,
    ids: &mut Strip<'_, u32>,
    t: &mut Strip<'_, f32>,
) {
    let fragments = draw(snapped, window, &mut [], &mut LevelCounts::default());
    for (pixel, fragment) in window.pixels().zip(fragments) {
        let (id, depth) = match fragment {
            None => (u32::MAX, f32::INFINITY),
            Some(Fragment { piece, depth, .. }) => {
                let t = snapped.projector.ray_parameter(depth) as f32;
                (snapped.pieces[piece as usize].id.get(), t)
            }
        };
        ids.row_from(pixel)[0] = id;
        t.row_from(pixel)[0] = depth;
    }
}

/// The nearest pieces of one tile; counts where there is room to.
fn draw(
    snapped: &Snapped<'_>,
    window: Window,
    cover: &mut [Cover],
    levels: &mut LevelCounts,
) -> Vec<Option<Fragment>> {
    let Snapped { projector, test, pieces, lists } = snapped;
    let mut fragments: Vec<Option<Fragment>> = vec![None; window.len()];
    for listed in lists.of(window) {
        let (Listed::Small(number) | Listed::Large(number, _)) = listed;
        let piece = &pieces[number as usize];
        let Some(scannable) = piece.scannable(projector.orientation) else { continue };
        let Some(pixels) = piece.pixels(projector.subpixel_bits, window) else { continue };
        scan(projector, &scannable, pixels, |pixel, values| {
            let index = window.index(pixel);
            if let Some(cover) = cover.get_mut(index) {
                cover.crossed += 1;
                cover.signed += scannable.volume_sign;
            }
            // The first drawn stays where depths are equal.
            let depth = scannable.depth(values);
            let rank = test.rank(projector, depth);
            match &mut fragments[index] {
                Some(nearest) if rank == nearest.rank => {
                    nearest.tie |= pieces[nearest.piece as usize].id != piece.id;
                }
                Some(nearest) if rank > nearest.rank => {}
                nearest => *nearest = Some(Fragment { piece: number, depth, rank, tie: false }),
            }
        });
        levels.single += pixels.len();
    }
    fragments
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
