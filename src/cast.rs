//! The ray caster: for each pixel, the nearest triangle that covers its sample, with proof.
//!
//! World-space triple products, a conservative walk through the accelerator, an f64 filter with
//! certain bounds and expansions behind it. It shares with the rasterizer the scene, the lattice
//! camera's numbers and the definition of visibility, and no arithmetic.
//!
//! Every value in the buffer depends on the triangle and the pixel only: same bits for any tile
//! size, thread count and build preset. Only `levels` counts the work as it was done.

mod candidate;
mod counts;
mod coverage;
mod exact;
mod expansion;
mod fill;
mod filter;
mod layers;
mod memo;
mod nearest;
mod pair;
mod ray;
pub mod shadow;
mod single;
mod strips;
mod surfaces;
mod tile;
mod unproven;
mod unrounded;
mod whole;

use crate::accel::{Accelerator, Pending, Slabs};
use crate::mutant::{self, Mutant};
use crate::pixel::{Pixel, Window, for_each_tile};
use crate::scene::Scene;
use crate::simd::SimdLevel;
use crate::visibility::{
    Counting, Cover, Facing, Level, LevelCounts, VisibilityBuffer, VisibilityTile, Visible,
};
pub use counts::{WalkCounts, count_walk};
pub use layers::cast_layers;
pub use nearest::{cast_nearest, cast_nearest_into};
pub use surfaces::surfaces;
pub use unproven::{Unproven, cast_unproven, cast_unproven_into};

use candidate::Candidate;
use memo::{PicturePairs, SamePlane};
use ray::View;
use single::ShearedRay;
use whole::Whole;

/// Side of a tile, in pixels: neighbouring rays walk through the same nodes.
pub const TILE_SIDE: u32 = 32;

/// How rays are cast. The answer does not depend on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CastOptions {
    /// Whether the rays of a tile walk the tree together; else one by one.
    pub tiles: bool,
    /// Largest side of a tile, in pixels, at least 1. Tiles that walk together are at most 32.
    pub side: u32,
    /// The instruction set of the kernels.
    pub simd: SimdLevel,
}

impl Default for CastOptions {
    fn default() -> Self {
        Self { tiles: true, side: TILE_SIDE, simd: SimdLevel::best() }
    }
}

/// What is visible at every pixel of `window`, with `accelerator` built over the scene's mesh.
/// `done` is called once per finished tile of 32 × 32 pixels, from any thread.
pub fn cast(
    scene: &Scene,
    accelerator: &Accelerator,
    window: Window,
    counting: Counting,
    done: &(dyn Fn() + Sync),
) -> VisibilityBuffer {
    cast_with(scene, accelerator, window, counting, CastOptions::default(), done)
}

/// As [`cast`], done as `options` say. The answer is the same.
pub fn cast_with(
    scene: &Scene,
    accelerator: &Accelerator,
    window: Window,
    counting: Counting,
    options: CastOptions,
    done: &(dyn Fn() + Sync),
) -> VisibilityBuffer {
    let mut buffer = VisibilityBuffer::unseen(window);
    cast_into(&CastPicture::new(scene, accelerator, options), window, counting, &mut buffer, done);
    buffer
}

/// A picture that is ready to be cast, whole or in bands: what its pixels share is made once.
pub struct CastPicture<'a> {
    scene: &'a Scene,
    accelerator: &'a Accelerator,
    options: CastOptions,
    whole: Whole<'a>,
}

impl<'a> CastPicture<'a> {
    /// The picture of the scene's camera, with `accelerator` built over the scene's mesh.
    pub fn new(scene: &'a Scene, accelerator: &'a Accelerator, options: CastOptions) -> Self {
        Self { scene, accelerator, options, whole: Whole::new(scene, accelerator) }
    }
}

/// As [`cast_with`], of a part of a picture, into a buffer that was used before: whatever it held is
/// written over, and its memory is kept. Parts may be cast side by side.
pub fn cast_into(
    picture: &CastPicture<'_>,
    window: Window,
    counting: Counting,
    buffer: &mut VisibilityBuffer,
    done: &(dyn Fn() + Sync),
) {
    let CastPicture { scene, accelerator, options, whole } = picture;
    // Mistakes are planted in the decisions of single rays, unless they are of the tiles.
    let by_tiles = counting == Counting::Nearest && options.tiles && mutant::spares_tiles();
    if by_tiles {
        whole::cast_whole(whole, window, *options, buffer, done);
    } else {
        *buffer = cast_rays(scene, accelerator, window, counting, *options, done);
    }
}

/// Ray by ray.
fn cast_rays(
    scene: &Scene,
    accelerator: &Accelerator,
    window: Window,
    counting: Counting,
    options: CastOptions,
    done: &(dyn Fn() + Sync),
) -> VisibilityBuffer {
    let view = View::new(&scene.camera);
    let pairs = PicturePairs::default();
    let tiles = for_each_tile(&window.tiles(options.side), done, |tile| {
        let mut caster = TileCaster {
            view,
            accelerator,
            counting,
            pending: Pending::new(options.simd),
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
        level: match covering.level {
            _ if tie => Level::Exact,
            Level::Exact => Level::Exact,
            _ if surface.is_clear => Level::Single,
            _ => Level::Double,
        },
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
