//! What a depth buffer stores for an f32 1/w, sixteen lanes at a time.
//!
//! D = far/(far − near)·(1 − near/z) is linear in 1/w. As in [`DepthBuffer::stored`], it is evaluated
//! in f64 and only then rounded: what shows is the storage, not the way to it.

use crate::raster::arithmetic::Kernel;
use crate::raster::watertight::{DepthBuffer, DepthFormat};
use fearless_simd::prelude::*;
use fearless_simd::{f32x16, f64x8};

/// D = `offset` − `slope`·(1/w), in steps.
pub(in crate::raster) struct StoredDepth {
    offset: f64,
    slope: f64,
    /// Number of steps from 0 to 1; 0 for a floating-point format.
    steps: f64,
}

/// Added and taken away again, it leaves the nearest whole number, ties to even, of what is below
/// 2^51.
const ROUNDING: f64 = 1.5 * (1_u64 << 52) as f64;

impl StoredDepth {
    /// For the frame's t·(1/w). Kernels without a depth buffer never ask.
    pub(in crate::raster) fn new(kernel: Kernel, ray_parameter: f64) -> Self {
        let Kernel::Stored(buffer, z_per_t) = kernel else {
            return Self { offset: 0.0, slope: 0.0, steps: 0.0 };
        };
        let DepthBuffer { near, far, .. } = buffer;
        let offset = far / (far - near);
        Self {
            offset,
            slope: offset * near / (ray_parameter * z_per_t),
            steps: match buffer.format() {
                DepthFormat::D16 => 65_535.0,
                DepthFormat::D24 => 16_777_215.0,
                DepthFormat::D32 => 0.0,
            },
        }
    }

    /// The higher, the nearer: minus what is stored, 0 to −1 or to minus all steps, which f32 holds.
    #[inline(always)]
    pub(in crate::raster) fn rank<S: Simd>(
        &self,
        simd: S,
        inverse_depth: f32x16<S>,
    ) -> f32x16<S> {
        let (upper, lower) = inverse_depth.widen();
        self.half(simd, upper).narrow(self.half(simd, lower))
    }

    #[inline(always)]
    fn half<S: Simd>(&self, simd: S, inverse_depth: f64x8<S>) -> f64x8<S> {
        let (zero, one) = (f64x8::splat(simd, 0.0), f64x8::splat(simd, 1.0));
        let depth = f64x8::splat(simd, self.offset) - inverse_depth * self.slope;
        let depth = depth.max(zero).min(one);
        let stored = match self.steps {
            0.0 => depth,
            steps => (depth * steps + ROUNDING) - ROUNDING,
        };
        zero - stored
    }
}
