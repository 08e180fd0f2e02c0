//! The mean of the corner normals at each pixel of a run, in f32, not yet unit.

use super::LANES;
use super::vector::{self, Reals};
use crate::shade::lanes::run::Run;
use fearless_simd::prelude::*;

/// Fills in the run's normals; what stands beyond a segment's end is overwritten by the next one.
#[inline(always)]
pub(super) fn mix_normals<S: Simd>(simd: S, run: &mut Run) {
    let Run { segments, faces, weights, mean_normal, .. } = run;
    let [mean_x, mean_y, mean_z] = mean_normal;
    for segment in segments.iter() {
        let face = &faces[segment.face];
        let sign = if face.turns { -1.0 } else { 1.0 };
        let narrowed =
            |v: [f64; 3]| [(sign * v[0]) as f32, (sign * v[1]) as f32, (sign * v[2]) as f32];
        let [a, b, c] =
            [narrowed(face.normals[0]), narrowed(face.normals[1]), narrowed(face.normals[2])];
        for start in (segment.start..segment.end).step_by(LANES) {
            let mean = if face.is_smooth {
                let w0 = vector::narrowed(simd, &weights[0], start);
                let w1 = vector::narrowed(simd, &weights[1], start);
                let w2 = vector::narrowed(simd, &weights[2], start);
                [
                    w0 * a[0] + w1 * b[0] + w2 * c[0],
                    w0 * a[1] + w1 * b[1] + w2 * c[1],
                    w0 * a[2] + w1 * b[2] + w2 * c[2],
                ]
            } else {
                vector::splat(simd, a)
            };
            store(mean[0], mean_x, start);
            store(mean[1], mean_y, start);
            store(mean[2], mean_z, start);
        }
    }
}

#[inline(always)]
fn store<S: Simd>(value: Reals<S>, numbers: &mut [f32], start: usize) {
    value.store_slice(&mut numbers[start..start + LANES]);
}
