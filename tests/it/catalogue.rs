//! The catalogue of hard cases, by their names: H01 to H18 coverage, H20 to H31 depth, H40 to H4B
//! the eye. Each is one test whose name begins with the case's, and each scene goes through every
//! configuration of both paths and before the arbiter (`support::configurations`).
//!
//! What is asserted here beyond agreement is known beforehand: a count of pixels from a program of
//! its own, an invariant, or a transformation that must not change the picture. G(8), the camera
//! of most cases, looks from the origin along +z through 17 × 17 pixels; at depth 8 a unit is a
//! pixel, and the sample of pixel (8, 8) is the point (0, 0).

mod coverage;
mod crowds;
mod depth;
mod eye;
mod names;
mod order;
mod rays;
mod ties;

use crate::support::configurations::agree_everywhere;
use crate::support::golden;
use truecast::scene::Scene;
use truecast::visibility::{Cover, VisibilityBuffer};

/// The column and the row of every sample of G(f), relative to the middle, row by row.
fn samples() -> impl Iterator<Item = [i32; 2]> {
    (0..289).map(|index| [index % 17 - 8, index / 17 - 8])
}

fn ids(buffer: &VisibilityBuffer) -> Vec<Option<u32>> {
    buffer.visible.iter().map(|v| v.map(|v| v.triangle.get())).collect()
}

fn cover(buffer: &VisibilityBuffer) -> &[Cover] {
    buffer.cover.as_ref().expect("the answer has counts")
}

/// XO: every sample is covered at most once.
fn assert_covered_once(name: &str, buffer: &VisibilityBuffer) {
    for (index, cover) in cover(buffer).iter().enumerate() {
        assert!(cover.crossed <= 1, "{name} at {:?}: {cover:?}", buffer.window.pixel(index));
    }
}

/// SC: the signed count is the same at every sample; it comes back.
fn one_signed_count(name: &str, buffer: &VisibilityBuffer) -> i32 {
    let first = cover(buffer)[0].signed;
    for (index, cover) in cover(buffer).iter().enumerate() {
        assert_eq!(cover.signed, first, "{name} at {:?}", buffer.window.pixel(index));
    }
    first
}

/// A golden scene's answer, after it was found to be the golden one.
fn agree_with_golden(name: &str) -> VisibilityBuffer {
    let golden = golden::scene(name);
    let buffer = agree_everywhere(name, &golden.scene);
    assert_eq!(ids(&buffer), golden.ids, "{name}");
    let crossed: Vec<u32> = cover(&buffer).iter().map(|c| c.crossed).collect();
    let signed: Vec<i32> = cover(&buffer).iter().map(|c| c.signed).collect();
    assert_eq!((crossed, signed), (golden.cover, golden.signed), "{name}");
    buffer
}

/// META: the transformed scene shows the same triangle at every pixel, covered as often.
fn assert_same_picture(name: &str, reference: &VisibilityBuffer, transformed: &Scene) {
    let buffer = agree_everywhere(name, transformed);
    assert_eq!(ids(reference), ids(&buffer), "{name}");
    let crossed = |buffer: &VisibilityBuffer| -> Vec<u32> {
        cover(buffer).iter().map(|c| c.crossed).collect()
    };
    assert_eq!(crossed(reference), crossed(&buffer), "{name}");
    let ties = |buffer: &VisibilityBuffer| -> Vec<bool> {
        buffer.visible.iter().flatten().map(|v| v.tie).collect()
    };
    assert_eq!(ties(reference), ties(&buffer), "{name}");
}
