//! All fragments of the pixels whose nearest surface is see-through, in depth order.
//!
//! The tile scans its triangles as for the z-buffer and keeps every fragment that does not
//! certainly lie behind an opaque one; each pixel's fragments are then sorted, by intervals of 1/t
//! where they are disjoint and by exact rows where they are not.

use super::TILE_SIDE;
use super::bins::Bins;
use super::bounds::Region;
use super::coverage::{Coverage, Fragment};
use super::exact::ExactStage;
use super::image_plane::ImagePlane;
use super::resolve::answer;
use super::scan::scan;
use crate::mesh::TriangleId;
use crate::pixel::{Pixel, Window, for_each_tile};
use crate::scene::Scene;
use crate::visibility::{Layers, LevelCounts, VisibilityBuffer, Visible};
use std::cmp::Ordering;

/// Whether nothing is seen through a triangle.
type Opaque<'a> = &'a (dyn Fn(TriangleId) -> bool + Sync);

/// The surfaces behind the nearest at every pixel of `nearest` (the rasterizer's answer) whose
/// nearest is not `opaque`. `done` is called once per finished tile of
/// `nearest.window.tiles(TILE_SIDE)`, from any thread.
pub fn rasterize_layers(
    scene: &Scene,
    nearest: &VisibilityBuffer,
    opaque: &(dyn Fn(TriangleId) -> bool + Sync),
    done: &(dyn Fn() + Sync),
) -> Layers {
    let is_see_through = |visible: &Visible| !opaque(visible.triangle);
    if !nearest.visible.iter().flatten().any(is_see_through) {
        return Layers::none(nearest.window);
    }
    let plane = ImagePlane::new(&scene.camera);
    let bins = Bins::new(&plane, &scene.mesh, Region::samples(nearest.window), TILE_SIDE);
    let tiles = for_each_tile(&nearest.window.tiles(TILE_SIDE), done, |window| {
        let wanted: Vec<bool> =
            window.pixels().map(|pixel| nearest.at(pixel).is_some_and(is_see_through)).collect();
        let lists = match wanted.contains(&true) {
            true => {
                rasterize_tile(ExactStage::new(&plane, &scene.mesh), &bins, opaque, window, wanted)
            }
            false => Vec::new(),
        };
        (window, lists)
    });
    Layers::from_tiles(nearest.window, &tiles)
}

/// The fragments of a tile's wanted pixels.
struct Collected<'a> {
    opaque: Opaque<'a>,
    pixels: Vec<Collecting>,
}

/// The fragments of one pixel.
struct Collecting {
    is_wanted: bool,
    /// Some opaque fragment certainly has at least this 1/t.
    opaque_inverse_depth: f64,
    fragments: Vec<Fragment>,
}

impl Collected<'_> {
    fn keep(&mut self, index: usize, fragment: Fragment) {
        let pixel = &mut self.pixels[index];
        let [low, high] = fragment.inverse_depth;
        // Strictly behind an opaque fragment: no layer, and no tie of one.
        if !pixel.is_wanted || high < pixel.opaque_inverse_depth {
            return;
        }
        if (self.opaque)(fragment.triangle) {
            pixel.opaque_inverse_depth = pixel.opaque_inverse_depth.max(low);
        }
        pixel.fragments.push(fragment);
    }
}

/// Per pixel of the tile, the surfaces behind the nearest.
fn rasterize_tile<'a>(
    exact: ExactStage<'a>,
    bins: &Bins<'_>,
    opaque: Opaque<'a>,
    window: Window,
    wanted: Vec<bool>,
) -> Vec<Vec<Visible>> {
    let collecting = |is_wanted| Collecting {
        is_wanted,
        opaque_inverse_depth: f64::NEG_INFINITY,
        fragments: Vec::new(),
    };
    let mut kept = Collected { opaque, pixels: wanted.into_iter().map(collecting).collect() };
    let (mut exact, mut levels) = (exact, LevelCounts::default());
    for candidate in bins.candidates(window) {
        scan(window, &candidate, &mut exact, &mut levels, |pixel, fragment| {
            kept.keep(window.index(pixel), fragment);
        });
    }
    let pixels = window.pixels().zip(kept.pixels);
    pixels.map(|(pixel, found)| behind_nearest(&mut exact, opaque, pixel, found)).collect()
}

/// A pixel's surfaces behind the nearest, up to and including the first opaque one.
fn behind_nearest(
    exact: &mut ExactStage<'_>,
    opaque: Opaque<'_>,
    pixel: Pixel,
    found: Collecting,
) -> Vec<Visible> {
    let mut fragments = found.fragments;
    fragments.retain(|fragment| fragment.inverse_depth[1] >= found.opaque_inverse_depth);
    fragments.sort_by(|a, b| depth_order(exact, a, b, pixel));
    // Equal depths stand side by side, because order at the moved sample refines that at the sample.
    for index in 1..fragments.len() {
        let [before, behind] = [fragments[index - 1], fragments[index]];
        if have_same_depth(exact, &before, &behind, pixel) {
            fragments[index - 1].same_depth = true;
            fragments[index].same_depth = true;
        }
    }
    let first_opaque = fragments.iter().position(|fragment| opaque(fragment.triangle));
    let end = first_opaque.map_or(fragments.len(), |first| first + 1);
    let behind = fragments.iter().take(end).skip(1);
    behind
        .filter_map(|fragment| {
            let triangle = exact.triangle(fragment.triangle)?;
            let covered = Coverage { exact: fragment.exact, on_edge: fragment.on_edge };
            Some(answer(pixel, fragment.triangle, covered, fragment.same_depth, &triangle))
        })
        .collect()
}

/// Which of two fragments of a pixel is nearer; in one plane the lower id.
fn depth_order(exact: &mut ExactStage<'_>, a: &Fragment, b: &Fragment, pixel: Pixel) -> Ordering {
    match disjoint(a, b) {
        Some(order) => order,
        None => exact
            .depth_order(a.triangle, b.triangle, pixel)
            .map_or(Ordering::Equal, |order| order.moved)
            .then(a.triangle.cmp(&b.triangle)),
    }
}

/// Whether two fragments of a pixel have exactly the same t.
fn have_same_depth(exact: &mut ExactStage<'_>, a: &Fragment, b: &Fragment, pixel: Pixel) -> bool {
    disjoint(a, b).is_none()
        && exact
            .depth_order(a.triangle, b.triangle, pixel)
            .is_some_and(|order| order.at_sample == Ordering::Equal)
}

/// The order by certain bounds of 1/t, if they settle it: the larger 1/t is nearer.
fn disjoint(a: &Fragment, b: &Fragment) -> Option<Ordering> {
    if a.inverse_depth[0] > b.inverse_depth[1] {
        Some(Ordering::Less)
    } else if a.inverse_depth[1] < b.inverse_depth[0] {
        Some(Ordering::Greater)
    } else {
        None
    }
}
