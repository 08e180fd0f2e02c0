//! A point as lights see it: where it is, its normal, and where the eye is.
//!
//! It is set up only where some light's direction matters; what a kernel has no use for is zero.

use super::coefficients::Coefficients;
use super::frame::Frame;
use super::kernel_effects::KernelEffects;
use super::surface::{self, unless_cancelled};
use super::vector;
use super::watch::Watch;
use super::weights::{mix, weights};
use crate::pixel::Pixel;
use crate::visibility::Visible;

/// What is visible at a pixel.
pub(super) struct Seen<'a> {
    pub(super) pixel: Pixel,
    pub(super) visible: &'a Visible,
    /// Its world position, where it is known already.
    pub(super) position: Option<[f64; 3]>,
}

/// A point as lights see it; what the kernel has no use for is zero.
#[derive(Clone, Copy)]
pub(super) struct Geometry {
    pub(super) position: [f64; 3],
    /// V, unit.
    pub(super) to_eye: [f64; 3],
    /// N̂, unit.
    pub(super) normal: [f64; 3],
    /// |N|: 1, unless an interpolated normal is left as it is.
    pub(super) normal_length: f64,
    /// Where L is mixed from that of the corners.
    pub(super) mixture: Option<Mixture>,
}

/// The corners from which L is interpolated.
#[derive(Clone, Copy)]
pub(super) struct Mixture {
    pub(super) corners: [[f64; 3]; 3],
    pub(super) weights: [f64; 3],
}

impl Mixture {
    /// The mean of the corners' unit directions to a point, made unit; `None` where it cancels. A
    /// corner at the point itself has none.
    pub(super) fn direction_to(&self, point: [f64; 3]) -> Option<[f64; 3]> {
        let directions =
            self.corners.map(|corner| vector::unit(vector::sub(point, corner)).unwrap_or_default());
        unless_cancelled(mix(self.weights, directions))
    }
}

/// The point that is visible at a pixel as lights see it; `None` where none has a direction.
pub(super) fn geometry_at_pixel<const E: u8, W: Watch>(
    frame: &Frame<'_>,
    seen: &Seen<'_>,
    is_smooth: bool,
    coefficients: &Coefficients,
    watch: &mut W,
) -> Option<Geometry> {
    let effects = const { KernelEffects(E) };
    let (scene, rules, pixel, visible) = (frame.scene, frame.rules, seen.pixel, seen.visible);
    if !frame.sees::<W>(coefficients, effects) {
        return None;
    }
    let is_smooth = is_smooth && effects.has(KernelEffects::NORMALS);
    let weights = if is_smooth || rules.interpolate_vectors {
        weights(scene, visible, watch)
    } else {
        [0.0; 3]
    };
    let normal = surface::shading_normal(scene, visible, weights, is_smooth, watch);
    let mixture = rules.interpolate_vectors.then(|| Mixture {
        corners: scene.mesh.triangle(visible.triangle).map(|corner| corner.map(f64::from)),
        weights,
    });
    Some(Geometry {
        position: if effects.has(KernelEffects::POSITIONAL) {
            seen.position.unwrap_or_else(|| surface::position(scene, pixel, visible))
        } else {
            [0.0; 3]
        },
        to_eye: match &mixture {
            _ if !effects.has(KernelEffects::SPECULAR) => [0.0; 3],
            Some(mixture) if !rules.distant_viewer => {
                mixture.direction_to(scene.camera.eye()).unwrap_or_default()
            }
            _ => surface::to_eye(scene, pixel),
        },
        normal: normal.unit,
        normal_length: normal.length,
        mixture,
    })
}
