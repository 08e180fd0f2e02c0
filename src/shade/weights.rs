//! The weights with which colours, normals and texture coordinates of the corners are mixed.
//!
//! Perspective-correct ones are visibility's own, W_i/ΣW. Linear on the screen, as scan-line
//! interpolation has it (IIT, "Gouraud Surface Rendering": along the edges, then along the scan
//! line), the weight of corner i is b_i·z_i/Σ b_k·z_k with the corners' depths z: the projected
//! triangle's barycentric coordinates. The visible point itself never moves.

use super::terms::accumulate;
use super::vector;
use super::watch::{Note, Watch};
use crate::color::LinearRgb;
use crate::scene::Scene;
use crate::visibility::Visible;

/// The three weights; their sum is 1. On a triangle with a corner at or behind the eye plane,
/// which has no image of three corners, they stay perspective-correct, and `watch` is told.
#[inline]
pub(super) fn weights<W: Watch>(scene: &Scene, visible: &Visible, watch: &mut W) -> [f64; 3] {
    let perspective = visible.barycentric.0;
    if !scene.switches.rules().screen_interpolation {
        return perspective;
    }
    let (eye, axis) = (scene.camera.eye(), scene.camera.axis());
    let depth = scene
        .mesh
        .triangle(visible.triangle)
        .map(|corner| vector::dot(axis, vector::sub(corner.map(f64::from), eye)));
    if !depth.iter().all(|&z| z > 0.0) {
        watch.note(Note::PerspectiveKept);
        return perspective;
    }
    // Depths by their largest, so that no product overflows.
    let largest = depth.iter().fold(0.0_f64, |m, &z| m.max(z));
    let scaled: [f64; 3] = std::array::from_fn(|i| perspective[i] * (depth[i] / largest));
    let sum = scaled[0] + scaled[1] + scaled[2];
    scaled.map(|weight| weight / sum)
}

/// Σ w_i·c_i of colours: a corner without weight gives nothing, however bright it is.
#[inline(always)]
pub(super) fn mix_colors(weights: [f64; 3], colors: [LinearRgb; 3]) -> LinearRgb {
    let mut sum = [0.0; 3];
    for (weight, color) in weights.into_iter().zip(colors).filter(|(weight, _)| *weight > 0.0) {
        accumulate(&mut sum, color.map(|value| weight * value));
    }
    sum
}

/// Σ w_i·a_i.
#[inline(always)]
pub(super) fn mix<const N: usize>(weights: [f64; 3], [a, b, c]: [[f64; N]; 3]) -> [f64; N] {
    std::array::from_fn(|k| weights[0] * a[k] + weights[1] * b[k] + weights[2] * c[k])
}
