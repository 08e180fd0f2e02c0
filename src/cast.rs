//! The ray caster: for each pixel, the nearest triangle that covers its sample, with proof.
//!
//! World-space triple products, a conservative walk through the accelerator, an f64 filter with
//! certain bounds and expansions behind it. It shares with the rasterizer the scene, the lattice
//! camera's numbers and the definition of visibility, and no arithmetic.
//!
//! Every value in the buffer depends on the triangle and the pixel only: same bits for any tile
//! size, thread count and build preset. Only `levels` counts the work as it was done.

mod candidate;
mod coverage;
mod exact;
mod expansion;
mod filter;
mod layers;
mod memo;
mod pair;
mod ray;
pub mod shadow;
mod single;
mod unrounded;

use crate::accel::{Accelerator, Pending, Slabs};
use crate::mutant::{self, Mutant};
use crate::pixel::{Pixel, Window, for_each_tile};
use crate::scene::Scene;
use crate::visibility::{
    Counting, Cover, Facing, Level, LevelCounts, VisibilityBuffer, VisibilityTile, Visible,
};
pub use layers::cast_layers;

use candidate::Candidate;
use memo::{PicturePairs, SamePlane};
use ray::View;
use single::ShearedRay;

/// Side of a tile, in pixels: neighbouring rays walk through the same nodes.
pub const TILE_SIDE: u32 = 32;

/// What is visible at every pixel of `window`, with `accelerator` built over the scene's mesh.
/// `done` is called once per finished tile of 32 × 32 pixels, from any thread.
pub fn cast(
    scene: &Scene,
    accelerator: &Accelerator,
    window: Window,
    counting: Counting,
    done: &(dyn Fn() + Sync),
) -> VisibilityBuffer {
    cast_with_tiles(scene, accelerator, window, counting, done, TILE_SIDE)
}

/// As [`cast`], in tiles of `side` × `side` pixels (at least 1). The answer is the same.
pub fn cast_with_tiles(
    scene: &Scene,
    accelerator: &Accelerator,
    window: Window,
    counting: Counting,
    done: &(dyn Fn() + Sync),
    side: u32,
) -> VisibilityBuffer {
    let view = View::new(&scene.camera);
    let pairs = PicturePairs::default();
    let tiles = for_each_tile(&window.tiles(side), done, |tile| {
        let mut caster = TileCaster {
            view,
            accelerator,
            counting,
            pending: Pending::default(),
            same_plane: SamePlane::new(&pairs),
            levels: LevelCounts::default(),
        };
        let mut answer = VisibilityTile::empty(tile, counting);
        for (index, pixel) in tile.pixels().enumerate() {
            if mutant::is(Mutant::TileEdges) && pixel.x + 1 == tile.x1() {
                continue;
            }
            let (visible, cover) = caster.cast_pixel(pixel);
            answer.visible[index] = visible;
            if let Some(place) = answer.cover.get_mut(index) {
                *place = cover;
            }
        }
        answer.levels = caster.levels;
        answer
    });
    VisibilityBuffer::from_tiles(window, counting, tiles)
}

/// One tile's work and its memory between pixels.
struct TileCaster<'a> {
    view: View,
    accelerator: &'a Accelerator,
    counting: Counting,
    pending: Pending,
    same_plane: SamePlane<'a>,
    levels: LevelCounts,
}

impl TileCaster<'_> {
    /// The nearest covering triangle at a pixel, and the cover if it is counted.
    fn cast_pixel(&mut self, pixel: Pixel) -> (Option<Visible>, Cover) {
        let Self { view, accelerator, counting, pending, same_plane, levels } = self;
        let ray = view.ray(pixel);
        let slabs = Slabs::new(ray.eye, ray.direction());
        // Most rays of an empty sky meet no leaf.
        let mut sheared = None;
        let mut highest = None;
        let mut nearest: Option<Candidate> = None;
        let mut cover = Cover::default();
        accelerator.traverse(&slabs, pending, |triangles| {
            let sheared = sheared.get_or_insert_with(|| ShearedRay::new(&ray));
            for triangle in triangles {
                let (covering, level) = coverage::decide(&ray, sheared, triangle);
                count(levels, level);
                highest = highest.max(Some(level));
                let Some(covering) = covering else { continue };
                cover.crossed += counted(triangle.copies);
                cover.signed += sign_counted(covering.sign) * triangle.copies as i32;
                let mut found = Candidate::new(&ray, triangle, covering);
                if mutant::is(Mutant::NearPlane) && found.reach() < 1e-4 {
                    continue;
                }
                let Some(best) = &mut nearest else {
                    nearest = Some(found);
                    continue;
                };
                let (nearer, level) = found.precedes(best, &ray, same_plane);
                count(levels, level);
                highest = highest.max(Some(level));
                if nearer {
                    nearest = Some(found);
                }
            }
            match (&nearest, *counting) {
                (Some(best), Counting::Nearest) => best.reach(),
                _ => f64::INFINITY,
            }
        });
        count_pixel(levels, highest);
        (nearest.map(|mut best| visible(view, &ray, &mut best)), cover)
    }
}

/// The buffer's entry for the nearest triangle.
fn visible(view: &View, ray: &ray::Ray, nearest: &mut Candidate) -> Visible {
    let surface = nearest.narrow(ray);
    let covering = nearest.covering;
    let on_edge = covering.on_edge && !mutant::is(Mutant::UnmarkedTies);
    let tie = nearest.shared || on_edge;
    let front = (covering.sign < 0) != mutant::is(Mutant::FacingFlipped);
    Visible {
        triangle: nearest.triangle.id,
        facing: if front { Facing::Front } else { Facing::Back },
        level: if tie { Level::Exact } else { covering.level },
        tie,
        barycentric: surface.barycentric,
        t_lo: view.camera_t(surface.t[0]),
        t_hi: view.camera_t(surface.t[1]),
    }
}

/// What the copies of a triangle add to the cover.
fn counted(copies: u32) -> u32 {
    if mutant::is(Mutant::CoverTwice) { copies * copies } else { copies }
}

/// What sgn V adds to the signed count.
fn sign_counted(sign: i8) -> i32 {
    if mutant::is(Mutant::UnsignedCount) { 1 } else { i32::from(sign) }
}

fn count(levels: &mut LevelCounts, level: Level) {
    match level {
        Level::Single => levels.single += 1,
        Level::Double => levels.double += 1,
        Level::Exact => levels.exact += 1,
    }
}

fn count_pixel(levels: &mut LevelCounts, highest: Option<Level>) {
    match highest {
        None => {}
        Some(Level::Single) => levels.pixels_single += 1,
        Some(Level::Double) => levels.pixels_double += 1,
        Some(Level::Exact) => levels.pixels_exact += 1,
    }
}

#[cfg(test)]
mod filter_tests;
#[cfg(test)]
mod tests;
