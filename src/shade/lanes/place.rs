//! Where the pixels' surfaces are, their normals, and the way to the eye: `surface` over lanes.
//!
//! A segment's lanes are written up to eight at once; what stands beyond its end is overwritten by
//! the next segment or never looked at.

use super::face::Plane;
use super::run::Run;
use super::vector::{self, Mask, Reals, Vectors};
use super::{LANES, Lanes};
use crate::pixel::Pixel;
use crate::shade::frame::Frame;
use crate::shade::surface::CANCELLED_SQUARED;
use fearless_simd::prelude::*;

/// The columns of eight neighbouring samples; exact.
#[inline(always)]
fn columns<S: Simd>(simd: S, first: Pixel, start: usize) -> Reals<S> {
    let [x, _] = Pixel { x: first.x + start as u32, ..first }.sample();
    Reals::splat(simd, x) + Reals::load_array(simd, [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0])
}

/// The directions of the pixels' rays: `surface::ray_direction`.
#[inline(always)]
pub(super) fn ray_directions<S: Simd>(
    simd: S,
    frame: &Frame<'_>,
    first: Pixel,
    start: usize,
) -> Vectors<S> {
    let camera = &frame.scene.camera;
    let (d0, dx, dy) = (camera.d0(), camera.dx(), camera.dy());
    let x = columns(simd, first, start);
    let [_, y] = first.sample();
    let [dx0, dx1, dx2] = dx;
    [
        x * dx0 + Reals::splat(simd, d0[0]) + Reals::splat(simd, y * dy[0]),
        x * dx1 + Reals::splat(simd, d0[1]) + Reals::splat(simd, y * dy[1]),
        x * dx2 + Reals::splat(simd, d0[2]) + Reals::splat(simd, y * dy[2]),
    ]
}

/// V of eight neighbouring pixels, and where it needs more care than this; zero where no light asks
/// for it.
#[inline(always)]
pub(super) fn to_eye<S: Simd>(
    simd: S,
    frame: &Frame<'_>,
    lanes: &Lanes,
    first: Pixel,
    start: usize,
) -> (Vectors<S>, Mask<S>) {
    let certain = Mask::splat(simd, false);
    if !lanes.specular {
        return (vector::splat(simd, [0.0; 3]), certain);
    }
    if frame.rules.distant_viewer {
        return (vector::splat(simd, frame.scene.camera.axis().map(|c| -c)), certain);
    }
    let ray = ray_directions(simd, frame, first, start);
    let squared = vector::squared_length(ray);
    let inverse = Reals::splat(simd, 1.0) / squared.sqrt();
    let unit = vector::scaled(ray, inverse);
    (vector::negated(unit), !vector::is_unscaled(squared))
}

/// Fills in the positions and normals of a run, and which of its normals cancelled.
#[inline(always)]
pub(super) fn place<S: Simd>(
    simd: S,
    frame: &Frame<'_>,
    lanes: &Lanes,
    first: Pixel,
    run: &mut Run,
) {
    let eye = vector::splat(simd, frame.scene.camera.eye());
    let Run { segments, faces, weights, t_low, t_high, position, normal, doubtful, .. } = run;
    for segment in segments.iter() {
        let face = &faces[segment.face];
        let plane = Plane::of(frame.scene, segment.triangle);
        for start in (segment.start..segment.end).step_by(LANES) {
            let weights = vector::load3(simd, weights, start);
            if lanes.positional {
                let ray = ray_directions(simd, frame, first, start);
                let low = vector::load(simd, t_low, start);
                let half = (vector::load(simd, t_high, start) - low) * 0.5;
                let t = low + half;
                // Take the point with the smaller bound.
                let reach = vector::largest_component(ray);
                let ray_error = (t * reach + Reals::splat(simd, lanes.largest_eye)) * f64::EPSILON
                    + half * reach;
                let is_by_ray = ray_error.simd_lt(plane.corner_error);
                for k in 0..3 {
                    let by_ray = eye[k] + t * ray[k];
                    let along = weights[1] * plane.edges[0][k] + weights[2] * plane.edges[1][k];
                    let by_corners = Reals::splat(simd, plane.origin[k]) + along;
                    let point = is_by_ray.select(by_ray, by_corners);
                    vector::store(point, &mut position[k], start);
                }
            }
            let unit = if face.is_smooth {
                let [a, b, c] = face.normals;
                let [w0, w1, w2] = weights;
                let mean = [
                    w0 * a[0] + w1 * b[0] + w2 * c[0],
                    w0 * a[1] + w1 * b[1] + w2 * c[1],
                    w0 * a[2] + w1 * b[2] + w2 * c[2],
                ];
                let squared = vector::squared_length(mean);
                let cancelled = !squared.simd_ge(CANCELLED_SQUARED);
                let lanes = segment.lanes_from(start);
                *doubtful |= (cancelled.to_bitmask() as u32 & lanes) << start;
                vector::scaled(mean, Reals::splat(simd, 1.0) / squared.sqrt())
            } else {
                vector::splat(simd, face.normals[0])
            };
            let unit = if face.turns { vector::negated(unit) } else { unit };
            for k in 0..3 {
                vector::store(unit[k], &mut normal[k], start);
            }
        }
    }
}
