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
    pub(in crate::raster) fn rank<S: Simd>(&self, simd: S, inverse_depth: f32x16<S>) -> f32x16<S> {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::SimdLevel;
    use fearless_simd::dispatch;

    /// Every lane holds what `DepthBuffer::stored` says, at every instruction set; only where that lies
    /// within 2^-20 of half a step may it be the neighbour.
    #[test]
    fn lanes_hold_what_a_depth_buffer_stores() {
        let (near, far, ray_parameter, z_per_t) = (0.1, 1000.0, 3.0, 0.7);
        for format in [DepthFormat::D16, DepthFormat::D24, DepthFormat::D32] {
            let Some(buffer) = DepthBuffer::new(format, near, far) else { panic!() };
            let stored = StoredDepth::new(Kernel::Stored(buffer, z_per_t), ray_parameter);
            for first in 0..40 {
                let z: [f64; 16] =
                    std::array::from_fn(|lane| 0.05 * 1.017_f64.powi(16 * first + lane as i32));
                let inverse = z.map(|z| (ray_parameter * z_per_t / z) as f32);
                for level in SimdLevel::available() {
                    let mut ranks = [0.0_f32; 16];
                    dispatch!(level.dispatched(), simd => {
                        let lanes = f32x16::from_slice(simd, &inverse);
                        stored.rank(simd, lanes).store_slice(&mut ranks);
                    });
                    for (rank, inverse) in ranks.iter().zip(inverse) {
                        let z = ray_parameter * z_per_t / f64::from(inverse);
                        let expected = buffer.stored(z);
                        let depth = (far / (far - near) * (1.0 - near / z)).clamp(0.0, 1.0);
                        let unrounded =
                            if stored.steps > 0.0 { depth * stored.steps } else { depth };
                        let is_half = (unrounded.fract() - 0.5).abs() < 1.0 / (1 << 20) as f64;
                        let error = (f64::from(-rank) - expected).abs();
                        let step = match format {
                            DepthFormat::D32 => f64::from(f32::EPSILON) / 2.0,
                            _ => f64::from(u8::from(is_half)),
                        };
                        assert!(error <= step, "{format:?} at {z}: {rank} for {expected}");
                    }
                }
            }
        }
    }
}
