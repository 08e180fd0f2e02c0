//! The audit: the arbiter looks at a sample of the pixels on which both paths agree.
//!
//! Half of the sample are the pixels nearest to an edge, where errors live (`edge_distance`); the
//! other half is drawn anywhere, every other time where something is seen through a surface, if
//! anything is. The seed is fixed, so a check is repeatable.

mod edge_distance;

use super::blame::{Blame, Judged, visibility_error};
use super::compare::{Answered, Difference, Kind, largest_exponent, layers_differ};
use super::expected;
use super::tolerance::compare_radiance;
use crate::color::LinearRgb;
use crate::exact::Arbiter;
use crate::pixel::Pixel;
use crate::render::Progress;
use crate::scene::Scene;
use crate::shade::Effects;
use crate::visibility::VisibilityBuffer;
use edge_distance::edge_distance;
use rayon::prelude::*;
use std::collections::HashSet;

/// Seed of the sample; any number does.
const SEED: u64 = 0x7275_6563_6173_7431;

/// Chooses up to `count` pixels that are not disputed, half of them nearest to an edge; all of
/// them if the window has no more than `count`.
pub(super) fn sample(
    scene: &Scene,
    answered: &Answered,
    disputed: &[Pixel],
    count: usize,
) -> Vec<Pixel> {
    let buffer = &answered.buffer;
    let window = buffer.window;
    let mut taken: HashSet<Pixel> = disputed.iter().copied().collect();
    if count >= window.len() {
        return window.pixels().filter(|pixel| !taken.contains(pixel)).collect();
    }
    let mut chosen = nearest_to_edges(scene, buffer, &taken, count.div_ceil(2));
    taken.extend(&chosen);
    let layered: Vec<Pixel> = window.pixels().filter(|&p| answered.is_layered(p)).collect();
    let mut random = SplitMix64(SEED);
    // Drawing may repeat a pixel; four draws per wanted pixel are enough wherever there are
    // plenty, and a small frame simply gives fewer.
    for draw in 0..4 * count {
        if chosen.len() >= count {
            break;
        }
        let pixel = match layered.len() {
            many if many > 0 && draw % 2 == 0 => layered[random.below(many)],
            _ => window.pixel(random.below(window.len())),
        };
        if taken.insert(pixel) {
            chosen.push(pixel);
        }
    }
    chosen.sort_unstable_by_key(|pixel| (pixel.y, pixel.x));
    chosen
}

/// The `count` pixels with the smallest distance to an edge, of equal ones the first; fewer where
/// fewer show a triangle or lie beside one.
fn nearest_to_edges(
    scene: &Scene,
    buffer: &VisibilityBuffer,
    taken: &HashSet<Pixel>,
    count: usize,
) -> Vec<Pixel> {
    let window = buffer.window;
    let mut distances: Vec<(f64, usize)> = (0..window.len())
        .into_par_iter()
        .filter(|&index| !taken.contains(&window.pixel(index)))
        .map(|index| (edge_distance(scene, buffer, window.pixel(index)), index))
        .filter(|(distance, _)| distance.is_finite())
        .collect();
    let order = |a: &(f64, usize), b: &(f64, usize)| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1));
    if count < distances.len() {
        distances.select_nth_unstable_by(count, order);
        distances.truncate(count);
    }
    distances.into_iter().map(|(_, index)| window.pixel(index)).collect()
}

/// Asks the arbiter about every pixel of the sample; both paths agree there, so an error is both's.
pub(super) fn audit(
    scene: &Scene,
    arbiter: &Arbiter<'_>,
    answers: &[Answered; 2],
    sample: &[Pixel],
    progress: &dyn Progress,
) -> Vec<Judged> {
    progress.begin("audit", sample.len());
    // Both paths are shaded with the same shadows, so only the arbiter's own can tell.
    let exposures = match Effects::of(scene).has(Effects::SHADOWS) {
        true => expected::exposures(scene, arbiter, sample),
        false => Vec::new(),
    };
    sample
        .par_iter()
        .enumerate()
        .filter_map(|(number, &pixel)| {
            let exact = arbiter.answer(pixel);
            progress.step();
            let errors = [0, 1].map(|i| {
                visibility_error(&answers[i], pixel, &exact)
                    .or_else(|| layers_error(scene, arbiter, &answers[i], pixel))
                    .or_else(|| {
                        let (radiance, _) = *exposures.get(number)?;
                        radiance_error(scene, &answers[i], pixel, radiance)
                    })
            });
            let kind = errors[0].or(errors[1])?;
            Some(Judged {
                difference: Difference { pixel, kind },
                blame: Blame::of(errors[0].is_some(), errors[1].is_some()),
                exact,
                found_by_audit: true,
            })
        })
        .collect()
}

/// Whether an answer that is right about the nearest surface is wrong about what lies behind it.
fn layers_error(
    scene: &Scene,
    arbiter: &Arbiter<'_>,
    answered: &Answered,
    pixel: Pixel,
) -> Option<Kind> {
    let nearest = answered.buffer.at(pixel)?;
    let found = answered.layers.of(answered.buffer.window.index(pixel));
    let exact = match scene.is_opaque(nearest.triangle) {
        true => Vec::new(),
        false => expected::layers(scene, arbiter, pixel),
    };
    layers_differ(found, &exact).then_some(Kind::Layers)
}

/// Whether an answer's radiance is not the exact one.
fn radiance_error(
    scene: &Scene,
    answered: &Answered,
    pixel: Pixel,
    exact: LinearRgb,
) -> Option<Kind> {
    let index = answered.buffer.window.index(pixel);
    let ns = largest_exponent(scene, answered, index);
    (!compare_radiance(answered.radiance[index], exact, ns).1).then_some(Kind::Radiance)
}

/// Steele, Lea and Flood, "Fast splittable pseudorandom number generators" (2014).
struct SplitMix64(u64);

impl SplitMix64 {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number below `bound` (> 0); the bias of the multiplication is below 2^-32 here.
    fn below(&mut self, bound: usize) -> usize {
        ((u128::from(self.next()) * bound as u128) >> 64) as usize
    }
}

#[cfg(test)]
mod tests;
