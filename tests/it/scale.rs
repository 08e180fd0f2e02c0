//! The hard cases of traversal (H50–H65), of scale and extremes (H70–H7A) and the transformations
//! that must not change an answer (H80–H89), each under its name.
//!
//! Every scene goes through `support::configurations`: both paths, all build presets and the linear
//! scan, several tile sizes, one and two threads, and the arbiter. H8A is `stability`'s.

mod extremes;
mod metamorphic;
mod supersampling;
mod traversal;

use crate::support::scenes::Triangle;
use truecast::scene::Scene;
use truecast::visibility::{Cover, VisibilityBuffer};

/// The counts at a pixel of a buffer that has them.
pub(crate) fn cover(buffer: &VisibilityBuffer, index: usize) -> Cover {
    buffer.cover.as_ref().expect("counts were asked for")[index]
}

/// The visible triangle of every pixel, row by row.
fn ids(buffer: &VisibilityBuffer) -> Vec<Option<u32>> {
    buffer.visible.iter().map(|v| v.map(|v| v.triangle.get())).collect()
}

/// XO: no sample is covered twice.
#[track_caller]
fn assert_covered_once(buffer: &VisibilityBuffer) {
    assert!(buffer.cover.as_ref().unwrap().iter().all(|cover| cover.crossed <= 1));
}

/// The triangles of a scene of bare triangles.
fn triangles_of(scene: &Scene) -> Vec<Triangle> {
    scene.mesh.ids().map(|id| scene.mesh.triangle(id)).collect()
}

/// Every component times 2^k, exact while it stays in the range of f32.
fn times_power_of_two(triangles: &[Triangle], k: i32) -> Vec<Triangle> {
    let factor = 2.0_f64.powi(k);
    triangles.iter().map(|t| t.map(|v| v.map(|c| (f64::from(c) * factor) as f32))).collect()
}
