//! H18: triangles far smaller than pixels, in great number.

use super::cover;
use crate::support::configurations::{agree_everywhere, assert_same};
use crate::support::scenes::{Sequence, Triangle, standard_scene};
use crate::support::sizes;
use rayon::prelude::*;
use truecast::accel::{Accelerator, BuildPreset};
use truecast::cast::cast;
use truecast::exact::Arbiter;
use truecast::mesh::TriangleId;
use truecast::pixel::Pixel;
use truecast::raster::rasterize;
use truecast::visibility::Counting;

/// Grains of dust: the catalogue's number.
const GRAINS: usize = 1_000_000;

/// Of these, every so manieth has its first corner exactly on a sample; the others lie at random
/// and hardly ever meet one.
const AIMED_EVERY: usize = 1000;

/// Size of a grain in pixels, 2^-13: about 1e-4, and a multiple of f32's step at 8.
const GRAIN: f64 = 1.0 / 8192.0;

/// Grains in the plane z = 8 and one in eight in the plane z = 16; both projections are exact.
fn dust() -> Vec<Triangle> {
    let mut random = Sequence(18);
    (0..GRAINS)
        .map(|number| {
            let mut corner = [0; 2].map(|_| 17.0 * random.next() - 8.5);
            if number % AIMED_EVERY == 0 {
                corner = [0; 2].map(|_| random.below(17) as f64 - 8.0);
            }
            let depth = if number % 8 == 7 { 2.0 } else { 1.0 };
            let mut next = |first: bool| -> [f32; 3] {
                let moved = corner
                    .map(|c| c + if first { 0.0 } else { GRAIN * (2.0 * random.next() - 1.0) });
                [(depth * moved[0]) as f32, (depth * moved[1]) as f32, 8.0 * depth as f32]
            };
            [next(true), next(false), next(false)]
        })
        .collect()
}

/// The pixel whose sample lies in the closed box of the grain's image, if any does. Dividing by
/// 1 or 2 is exact.
fn near_pixel(triangle: &Triangle) -> Option<Pixel> {
    let mut place = [0_u32; 2];
    for k in 0..2 {
        let seen = triangle.map(|v| v[k] / (v[2] / 8.0));
        let (low, high) = (seen[0].min(seen[1]).min(seen[2]), seen[0].max(seen[1]).max(seen[2]));
        let sample = low.ceil();
        if sample > high || !(-8.0..=8.0).contains(&sample) {
            return None;
        }
        place[k] = (sample + 8.0) as u32;
    }
    Some(Pixel { x: place[0], y: place[1] })
}

/// Instead of 10⁴ random picks, every grain whose box holds a sample is put before the arbiter.
#[test]
fn h18_sub_pixel_dust() {
    let triangles = dust();
    let scene = standard_scene(&triangles);
    let window = scene.camera.resolution().window();
    let mut near = vec![Vec::new(); window.len()];
    for (index, triangle) in triangles.iter().enumerate() {
        if let Some(pixel) = near_pixel(triangle) {
            near[window.index(pixel)].push(TriangleId::new(index as u32));
        }
    }
    let accelerator = Accelerator::build(&scene.mesh, BuildPreset::Fastest);
    let answer = cast(&scene, &accelerator, window, Counting::All, &|| ());
    let raster = rasterize(&scene, window, Counting::All, &|| ());
    assert_eq!(answer.cover, raster.cover);
    if sizes::H18.running() == GRAINS {
        assert_same(&answer, &agree_everywhere("dust", &scene), "dust");
    }
    let arbiter = Arbiter::new(&scene);
    let sum: u32 = window
        .pixels()
        .collect::<Vec<_>>()
        .into_par_iter()
        .map(|pixel| {
            let index = window.index(pixel);
            let truth = arbiter.answer_among(&near[index], pixel);
            assert_eq!(cover(&answer)[index], truth.cover, "{pixel:?}");
            let expected = truth.visible.map(|surface| (surface.triangle, surface.tie));
            for path in [&answer, &raster] {
                let found = path.at(pixel).map(|v| (v.triangle, v.tie));
                assert_eq!(found, expected, "{pixel:?}");
            }
            truth.cover.crossed
        })
        .sum();
    // The aimed corners are covered where the wedge holds the moved sample: a quarter or so.
    let aimed = (GRAINS / AIMED_EVERY) as u32;
    assert!(sum > aimed / 10 && sum < aimed, "{sum} of {aimed} aimed grains are hit");
}
