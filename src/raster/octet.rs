//! Eight triangles at a time in f64 lanes: their corners, images, rows and V.
//!
//! The same operations in the same order at every instruction set, none of them fused: V and N are
//! stored and compared bit for bit. Bounds are `frame`'s. Nothing is decided here.

use super::frame::Frame;
use crate::mesh::TriangleMesh;
use fearless_simd::prelude::*;
use fearless_simd::{f32x16, f64x8};

/// Triangles per group.
pub(super) const OCTET: usize = 8;

/// One number per lane of a vector, on a cache line of its own.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(super) struct Lanes<T>(pub(super) [T; 16]);

/// The corners of eight triangles: component k of corner c is row 3·c + k, of which two stand in a
/// vector; the last row is not used.
pub(super) struct Corners([Lanes<f32>; 5]);

impl Corners {
    pub(super) const fn new() -> Self {
        Self([Lanes([0.0; 16]); 5])
    }

    /// Puts a triangle into a lane.
    #[inline(always)]
    pub(super) fn set(&mut self, lane: usize, mesh: &TriangleMesh, id: u32) {
        let [a, b, c] = mesh.corners[id as usize].map(|corner| mesh.positions[corner as usize]);
        let lane = lane & 7;
        let [rows0, rows1, rows2, rows3, rows4] = &mut self.0;
        (rows0.0[lane], rows0.0[8 + lane]) = (a[0], a[1]);
        (rows1.0[lane], rows1.0[8 + lane]) = (a[2], b[0]);
        (rows2.0[lane], rows2.0[8 + lane]) = (b[1], b[2]);
        (rows3.0[lane], rows3.0[8 + lane]) = (c[0], c[1]);
        rows4.0[lane] = c[2];
    }
}

impl Corners {
    /// The corners in f64.
    #[inline(always)]
    fn vectors<S: Simd>(&self, simd: S) -> [Triple<S>; 3] {
        let [r0, r1, r2, r3, r4] = &self.0;
        let (ax, ay) = widened(simd, r0);
        let (az, bx) = widened(simd, r1);
        let (by, bz) = widened(simd, r2);
        let (cx, cy) = widened(simd, r3);
        let (cz, _) = widened(simd, r4);
        [[ax, ay, az], [bx, by, bz], [cx, cy, cz]]
    }
}

/// A homogeneous point or row of eight triangles.
pub(super) type Triple<S> = [f64x8<S>; 3];

/// The images of the corners.
pub(super) struct Images<S: Simd> {
    /// X_i: x·w, y·w, w.
    pub(super) points: [Triple<S>; 3],
    /// s_i = max|v_i − e|.
    pub(super) sizes: [f64x8<S>; 3],
}

impl<S: Simd> Images<S> {
    /// Moves corners into homogeneous image coordinates.
    #[inline(always)]
    pub(super) fn new(simd: S, frame: &Frame, corners: &Corners) -> Self {
        let [a, b, c] = corners.vectors(simd);
        let [x, y, z] = frame.eye;
        let (a, size_a) = moved(simd, frame, [a[0] - x, a[1] - y, a[2] - z]);
        let (b, size_b) = moved(simd, frame, [b[0] - x, b[1] - y, b[2] - z]);
        let (c, size_c) = moved(simd, frame, [c[0] - x, c[1] - y, c[2] - z]);
        Self { points: [a, b, c], sizes: [size_a, size_b, size_c] }
    }

    /// The edge rows R_0, R_1, R_2, opposite corners 0, 1, 2.
    #[inline(always)]
    pub(super) fn edges(&self) -> [Triple<S>; 3] {
        let [a, b, c] = &self.points;
        [cross(b, c), cross(c, a), cross(a, b)]
    }

    /// s_1·s_2, s_2·s_0, s_0·s_1, which belong to the edges.
    #[inline(always)]
    pub(super) fn size_products(&self) -> Triple<S> {
        let [a, b, c] = self.sizes;
        [b * c, c * a, a * b]
    }

    /// N and V, taken from the corners' differences.
    #[inline(always)]
    pub(super) fn plane(&self, simd: S, frame: &Frame, corners: &Corners) -> Plane<S> {
        let [a, b, c] = corners.vectors(simd);
        let (s01, size01) = moved(simd, frame, [b[0] - a[0], b[1] - a[1], b[2] - a[2]]);
        let (s20, size20) = moved(simd, frame, [a[0] - c[0], a[1] - c[1], a[2] - c[2]]);
        let row = cross(&s20, &s01);
        let (volume, size) = (dot(&row, &self.points[0]), size01 * size20);
        Plane { row, volume, size, volume_size: size * self.sizes[0] }
    }
}

/// The planes of eight triangles.
pub(super) struct Plane<S: Simd> {
    /// N = S_20 × S_01.
    pub(super) row: Triple<S>,
    /// V = X_0·N.
    pub(super) volume: f64x8<S>,
    /// max|v_0 − v_2|·max|v_1 − v_0|.
    pub(super) size: f64x8<S>,
    /// The same times s_0.
    pub(super) volume_size: f64x8<S>,
}

/// M·a, and max|a|.
#[inline(always)]
fn moved<S: Simd>(simd: S, frame: &Frame, a: Triple<S>) -> (Triple<S>, f64x8<S>) {
    let size = a[0].abs().max(a[1].abs()).max(a[2].abs());
    let [x, y, w] = &frame.matrix;
    ([along(simd, x, &a), along(simd, y, &a), along(simd, w, &a)], size)
}

/// A row of M times a.
#[inline(always)]
fn along<S: Simd>(simd: S, row: &[f64; 3], a: &Triple<S>) -> f64x8<S> {
    let row = [f64x8::splat(simd, row[0]), f64x8::splat(simd, row[1]), f64x8::splat(simd, row[2])];
    dot(a, &row)
}

/// Two rows of corners.
#[inline(always)]
fn widened<S: Simd>(simd: S, rows: &Lanes<f32>) -> (f64x8<S>, f64x8<S>) {
    f32x16::from_slice(simd, &rows.0).widen()
}

#[inline(always)]
fn dot<S: Simd>(a: &Triple<S>, b: &Triple<S>) -> f64x8<S> {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
fn cross<S: Simd>(a: &Triple<S>, b: &Triple<S>) -> Triple<S> {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
