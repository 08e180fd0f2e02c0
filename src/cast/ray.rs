//! Camera rays as the caster's arithmetic wants them.
//!
//! The lattice is scaled by 2^-E, E the camera's exponent: directions are then multiples of 2^-53
//! of magnitude at most 1, exactly, and signs do not change. A ray parameter t of a scaled
//! direction is t·2^-E of the camera's own.

use crate::mutant::{self, Mutant};
use crate::pixel::Pixel;
use crate::scene::camera::PinholeCamera;

/// What all rays of a picture share.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    eye: [f64; 3],
    d0: [f64; 3],
    dx: [f64; 3],
    dy: [f64; 3],
    t_scale: f64,
}

/// The ray of one sample.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ray {
    /// e.
    pub(super) eye: [f64; 3],
    /// d, then DX and DY, which decide where a product with d is 0: the sample moved by (+ε, +ε²).
    pub(super) directions: [[f64; 3]; 3],
}

impl View {
    pub(super) fn new(camera: &PinholeCamera) -> Self {
        // |E| ≤ 301, so the power and every product with it are exact: components of d are 0 or
        // at least 2^(E−53).
        let scale = 2.0_f64.powi(-camera.exponent());
        let scaled = |v: [f64; 3]| v.map(|c| c * scale);
        Self {
            eye: camera.eye(),
            d0: scaled(camera.d0()),
            dx: scaled(camera.dx()),
            dy: scaled(camera.dy()),
            t_scale: scale,
        }
    }

    /// e.
    pub(super) fn eye(&self) -> [f64; 3] {
        self.eye
    }

    /// DX, DY and D0: the direction at (x, y) is D0 + x·DX + y·DY.
    pub(super) fn lattice(&self) -> [[f64; 3]; 3] {
        [self.dx, self.dy, self.d0]
    }

    /// The ray through the sample of `pixel`. No operation rounds, by the camera's contract.
    pub(super) fn ray(&self, pixel: Pixel) -> Ray {
        let [mut x, mut y] = pixel.sample();
        if mutant::is(Mutant::CornerSamples) {
            (x, y) = (x - 0.5, y - 0.5);
        }
        let d = std::array::from_fn(|k| self.d0[k] + x * self.dx[k] + y * self.dy[k]);
        Ray { eye: self.eye, directions: mutant::moves([d, self.dx, self.dy]) }
    }

    /// The camera's t for a t of the scaled direction. Exact: a hit on f32 geometry has
    /// 2^-708 < t < 2^182 on the scaled ray, so the result is a normal number.
    pub(super) fn camera_t(&self, t: f64) -> f64 {
        t * self.t_scale
    }

    /// The t of the scaled direction for one of the camera's own. Exact, as [`Self::camera_t`].
    pub(super) fn scaled_t(&self, t: f64) -> f64 {
        t / self.t_scale
    }
}

impl Ray {
    /// d.
    pub(super) fn direction(&self) -> [f64; 3] {
        self.directions[0]
    }
}
