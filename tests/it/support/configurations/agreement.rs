//! What it means that answers agree: bits within a path, statements between the paths, and truth
//! before the arbiter.

use rayon::prelude::*;
use truecast::check::tolerance::weights_agree;
use truecast::exact::Arbiter;
use truecast::pixel::Pixel;
use truecast::scene::Scene;
use truecast::visibility::{Level, NearestBuffer, VisibilityBuffer, Visible};

/// Largest relative width of a depth interval, the visibility buffer's contract.
const DEPTH_WIDTH: f64 = 1.0 / (1_u64 << 40) as f64;

/// Largest error of the sum of three weights, each good to 2^-49 of itself.
const WEIGHT_SUM: f64 = 1.0 / (1_u64 << 49) as f64;

/// Same answer, bit for bit. Levels of work may differ; counts are compared where both have them.
#[track_caller]
pub(crate) fn assert_same(reference: &VisibilityBuffer, found: &VisibilityBuffer, name: &str) {
    assert_eq!(reference.window, found.window, "{name}");
    for (index, pair) in reference.visible.iter().zip(&found.visible).enumerate() {
        let place = reference.window.pixel(index);
        assert_eq!(pair.0, pair.1, "{name}: {place:?}");
        let bits = [pair.0, pair.1].map(|visible| visible.as_ref().map(bits));
        assert_eq!(bits[0], bits[1], "{name}: {place:?}");
    }
    if let (Some(reference), Some(found)) = (&reference.cover, &found.cover) {
        assert_eq!(reference, found, "{name}");
    }
}

/// Largest relative error of a `NearestBuffer`'s t, its contract. A t beyond f32 is infinite or 0.
const NEAREST_T: f64 = 1.0 / (1 << 18) as f64;

/// The same ids, and t as near as they are promised.
#[track_caller]
pub(crate) fn assert_nearest_is(whole: &VisibilityBuffer, nearest: &NearestBuffer, name: &str) {
    assert_eq!(whole.window, nearest.window, "{name}");
    for (index, visible) in whole.visible.iter().enumerate() {
        let place = whole.window.pixel(index);
        let id = visible.as_ref().map_or(u32::MAX, |visible| visible.triangle.get());
        assert_eq!(id, nearest.ids[index], "{name}: {place:?}");
        let t = nearest.t[index];
        let Some(visible) = visible else {
            assert_eq!(t, f32::INFINITY, "{name}: {place:?}");
            continue;
        };
        let right = visible.t();
        let off = (f64::from(t) - right).abs();
        let is_beyond_f32 = !(right as f32).is_normal();
        assert!(is_beyond_f32 || off <= NEAREST_T * right, "{name}: {place:?}: {t} for {right}");
    }
}

fn bits(visible: &Visible) -> [u64; 5] {
    let [b0, b1, b2] = visible.barycentric.0;
    [b0, b1, b2, visible.t_lo, visible.t_hi].map(f64::to_bits)
}

/// FIN: depths are positive, finite and narrow intervals, weights are finite, not negative, and
/// sum to 1.
pub(super) fn assert_finite(name: &str, buffer: &VisibilityBuffer) {
    for (index, visible) in buffer.visible.iter().enumerate() {
        let Some(visible) = visible else { continue };
        let place = format!("{name} at {:?}: {visible:?}", buffer.window.pixel(index));
        // Written so that NaN fails.
        assert!(0.0 < visible.t_lo && visible.t_lo <= visible.t_hi, "{place}");
        assert!(visible.t_hi.is_finite(), "{place}");
        assert!(visible.t_hi - visible.t_lo <= visible.t_hi * DEPTH_WIDTH, "{place}");
        let weights = visible.barycentric.0;
        assert!(weights.iter().all(|&b| b.is_sign_positive() && b <= 1.0 + WEIGHT_SUM), "{place}");
        assert!((weights.iter().sum::<f64>() - 1.0).abs() <= WEIGHT_SUM, "{place}");
        assert!(!visible.tie || visible.level == Level::Exact, "{place}");
    }
}

/// The two paths say the same: id, facing, tie and counts equal, depth intervals overlap, weights
/// agree.
pub(super) fn assert_paths_agree(name: &str, cast: &VisibilityBuffer, raster: &VisibilityBuffer) {
    for (index, (a, b)) in cast.visible.iter().zip(&raster.visible).enumerate() {
        let place = format!("{name} at {:?}: {a:?}, {b:?}", cast.window.pixel(index));
        let statement = |v: &Visible| (v.triangle, v.facing, v.tie);
        assert_eq!(a.as_ref().map(statement), b.as_ref().map(statement), "{place}");
        let (Some(a), Some(b)) = (a, b) else { continue };
        assert!(a.t_lo <= b.t_hi && b.t_lo <= a.t_hi, "{place}");
        for (p, q) in a.barycentric.0.into_iter().zip(b.barycentric.0) {
            assert!(weights_agree(p, q), "{place}");
        }
    }
    assert_eq!(cast.cover, raster.cover, "{name}");
}

/// The arbiter says the same at `count` pixels, or at all where there are no more.
pub(super) fn assert_arbiter_agrees(
    name: &str,
    scene: &Scene,
    answer: &VisibilityBuffer,
    count: usize,
) {
    let arbiter = Arbiter::new(scene);
    let cover = answer.cover.as_ref().expect("the answer has counts");
    asked_pixels(answer, count).into_par_iter().for_each(|pixel| {
        let truth = arbiter.answer(pixel);
        let found = answer.at(pixel);
        let place = format!("{name} at {pixel:?}: {found:?}, in truth {truth:?}");
        assert_eq!(cover[answer.window.index(pixel)], truth.cover, "{place}");
        assert_eq!(found.is_some(), truth.visible.is_some(), "{place}");
        let (Some(found), Some(truth)) = (found, truth.visible) else { return };
        assert_eq!(found.triangle, truth.triangle, "{place}");
        assert_eq!((found.facing, found.tie), (truth.facing, truth.tie), "{place}");
        // Both intervals hold the exact t.
        assert!(found.t_lo <= truth.t_hi && truth.t_lo <= found.t_hi, "{place}");
        for (p, q) in found.barycentric.0.into_iter().zip(truth.barycentric.0) {
            assert!(weights_agree(p, q), "{place}");
        }
    });
}

/// A fixed sample: half beside id borders, half anywhere.
fn asked_pixels(answer: &VisibilityBuffer, count: usize) -> Vec<Pixel> {
    let all: Vec<Pixel> = answer.window.pixels().collect();
    if count >= all.len() {
        return all;
    }
    let id = |pixel: Pixel| answer.at(pixel).map(|visible| visible.triangle);
    let beside_a_border = |pixel: &Pixel| {
        let Pixel { x, y } = *pixel;
        [Pixel { x: x + 1, y }, Pixel { x, y: y + 1 }]
            .into_iter()
            .any(|next| answer.window.contains(next) && id(next) != id(*pixel))
    };
    let borders: Vec<Pixel> = all.iter().copied().filter(beside_a_border).collect();
    let mut asked = spread(&borders, count / 2);
    asked.extend(spread(&all, count / 2));
    asked
}

/// About `count` of the pixels, evenly spread.
fn spread(pixels: &[Pixel], count: usize) -> Vec<Pixel> {
    pixels.iter().copied().step_by(pixels.len().div_ceil(count.max(1)).max(1)).collect()
}
