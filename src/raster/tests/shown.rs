//! The short way to weights and t against the integers' own, bit for bit.

use super::{aimed_triangles, cameras};
use crate::pixel::{Pixel, Resolution};
use crate::raster::exact::ExactTriangle;
use crate::raster::exact_row::doubled;
use crate::raster::image_plane::ImagePlane;
use crate::raster::shown::Shown;
use crate::scene::camera::PinholeCamera;
use crate::simd::SimdLevel;
use fearless_simd::prelude::*;
use fearless_simd::{Simd, dispatch, f64x8};

#[test]
fn weights_and_t_are_those_of_the_exact_stage() {
    let mut compared = 0;
    let whole_numbers = PinholeCamera::exact(
        Resolution::new(640, 360).unwrap(),
        [0.5, -0.25, -3.0],
        [-320.0, -180.0, 300.0],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
    );
    for camera in cameras().into_iter().chain(whole_numbers) {
        let plane = ImagePlane::new(&camera);
        for (index, &corners) in aimed_triangles(&camera).iter().enumerate() {
            let exact = ExactTriangle::new(&plane, corners);
            let Some(shown) = Shown::new(&plane, corners) else { continue };
            let exact = exact.expect("V is not 0");
            assert_eq!(shown.volume_sign, exact.volume_sign);
            for level in SimdLevel::available() {
                for first in [[400, 76], [0, 0], [632, 359]] {
                    let first = Pixel { x: first[0], y: first[1] };
                    compared += dispatch!(level.dispatched(), simd =>
                        compare(simd, &shown, &exact, first, index));
                }
            }
        }
    }
    assert!(compared > 20_000, "{compared}");
}

/// Eight pixels of a row.
fn compare<S: Simd>(
    simd: S,
    shown: &Shown,
    exact: &ExactTriangle,
    first: Pixel,
    index: usize,
) -> usize {
    let [x2, y2] = doubled(first).map(|c| c as f64);
    let steps = f64x8::from_slice(simd, &[0.0, 2.0, 4.0, 6.0, 8.0, 10.0, 12.0, 14.0]);
    let (weights, t, known) = shown.at(simd, steps + x2, f64x8::splat(simd, y2));
    let lanes = (0..8).filter(|lane| known >> lane & 1 == 1);
    lanes
        .map(|lane| {
            let pixel = Pixel { x: first.x + lane as u32, y: first.y };
            let expected = exact.weights_at(pixel).map(f64::to_bits);
            let found = [0, 1, 2].map(|k| weights[k].as_slice()[lane].to_bits());
            // Where the plane's row is 0 there is no t, and nothing is visible.
            if exact.t_at(pixel).is_finite() {
                assert_eq!(found, expected, "{index} {pixel:?}");
                let t = t.as_slice()[lane];
                assert_eq!(t.to_bits(), exact.t_at(pixel).to_bits(), "{index} {pixel:?}");
            }
        })
        .count()
}
