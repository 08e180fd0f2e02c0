//! What all tiles of a picture share, and one tile's rays as the kernels want them.
//!
//! All t here are those of the scaled ray (see [`View`]), divided by σ, a power of two near the
//! largest distance of a vertex from the eye: t' = t/σ, and its reciprocal z = σ/t is what the
//! kernels compare, because z is affine in the pixel. σ only keeps f32 in range.

use crate::accel::{Accelerator, WideTree};
use crate::cast::exact::{self, Vertices};
use crate::cast::filter::Relative;
use crate::cast::ray::View;
use crate::cast::unrounded;
use crate::mesh::{TriangleId, TriangleMesh};
use crate::pixel::{Pixel, Window};
use crate::scene::Scene;
use std::collections::HashMap;
use std::sync::{Mutex, PoisonError};

/// Side of a tile of the kernels, in pixels: 8 × 8 blocks of 4 × 4. Larger tiles do less per ray
/// in the tree; their state still fits the first-level cache.
pub(in crate::cast) const SIDE: usize = 32;

/// Scenes whose largest distance from the eye lies in 2^±100 are culled in f32 before the set-up;
/// products of a coordinate, a direction and a pixel number stay far from over- and underflow then.
const CULL_RANGE: [f64; 2] = [1.0 / (1_u128 << 100) as f64, (1_u128 << 100) as f64];

/// Largest relative error that the inverse camera matrix may bring to t' and to pixel coordinates
/// anywhere in the frame: 2^-24, one rounding of f32. Cameras measure 2^-40 and below; one of
/// nearly 180 degrees may not, and its tiles then neither order nor cull by it.
const MOST_RESIDUAL: f64 = 1.0 / (1 << 24) as f64;

/// What all tiles share.
pub(in crate::cast) struct Frame<'a> {
    pub(in crate::cast) view: View,
    pub(in crate::cast) mesh: &'a TriangleMesh,
    pub(in crate::cast) accelerator: &'a Accelerator,
    pub(super) tree: &'a WideTree,
    /// σ.
    pub(super) sigma: f64,
    /// t for the camera's own direction is this over z.
    pub(super) t_per_inverse_z: f64,
    /// Largest magnitude of a coordinate per axis, plus that of the eye.
    pub(super) reach: [f64; 3],
    /// Rows X, Y, w of the inverse of [DX DY D0]: a = X·DX + Y·DY + w·D0 for a = (X, Y, w).
    pub(super) inverse: [[f64; 3]; 3],
    /// Whether `inverse` is good enough to order boxes by t'.
    pub(super) orders: bool,
    /// Whether triangles may be culled in f32.
    pub(super) culls: bool,
    /// sgn V of triangles for which the f64 filter leaves it open.
    plane_signs: Mutex<HashMap<TriangleId, i8>>,
}

impl<'a> Frame<'a> {
    pub(in crate::cast) fn new(scene: &'a Scene, accelerator: &'a Accelerator) -> Self {
        let (view, mesh) = (View::new(&scene.camera), &scene.mesh);
        let resolution = scene.camera.resolution();
        let sides = resolution.width() + resolution.height();
        let tree = accelerator.tree();
        let reach: [f64; 3] =
            std::array::from_fn(|k| f64::from(tree.reach[k]) + view.eye()[k].abs());
        let largest = reach.into_iter().fold(0.0, f64::max);
        let sigma = power_of_two_near(largest.clamp(CULL_RANGE[0], CULL_RANGE[1]));
        let (inverse, residual) = inverse(view.lattice());
        let orders = residual * (1.0 + f64::from(sides)) < MOST_RESIDUAL
            && inverse.iter().flatten().all(|c| c.abs() < 1e12);
        let culls = orders && largest > CULL_RANGE[0] && largest < CULL_RANGE[1];
        Self {
            view,
            mesh,
            accelerator,
            tree,
            sigma,
            t_per_inverse_z: view.camera_t(sigma),
            reach,
            inverse,
            orders,
            culls,
            plane_signs: Mutex::default(),
        }
    }

    /// sgn V of a triangle: by the f64 filter, or exactly once per frame.
    pub(in crate::cast) fn sign_of_plane(&self, id: TriangleId, vertices: &Vertices) -> i8 {
        // V depends on the eye alone: any ray will do.
        let ray = self.view.ray(Pixel { x: 0, y: 0 });
        let [plane, _] = Relative::new(ray.eye, vertices).plane_and_speed(&ray);
        plane.sign().unwrap_or_else(|| self.plane_sign(id, vertices))
    }

    /// sgn V of a triangle for which a filter leaves it open: decided once per frame.
    #[cold]
    pub(super) fn plane_sign(&self, id: TriangleId, vertices: &Vertices) -> i8 {
        let ray = self.view.ray(Pixel { x: 0, y: 0 });
        let mut signs = self.plane_signs.lock().unwrap_or_else(PoisonError::into_inner);
        *signs.entry(id).or_insert_with(|| {
            unrounded::plane_sign(&ray, vertices)
                .unwrap_or_else(|| exact::plane_sign(&ray, vertices))
        })
    }
}

/// A tile's place and rays.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lattice {
    pub(super) window: Window,
    pub(super) eye: [f64; 3],
    /// d of the tile's first sample, DX and DY.
    pub(super) directions: [[f64; 3]; 3],
    /// Largest pixel steps from the first sample.
    pub(super) extent: [f64; 2],
    /// |d|₁ + (SIDE − 1)·(|DX|₁ + |DY|₁): bounds |d|₁ over a full tile.
    pub(super) omega: f64,
}

impl Lattice {
    pub(super) fn new(frame: &Frame<'_>, window: Window) -> Self {
        let ray = frame.view.ray(window.pixel(0));
        let directions = ray.directions;
        let [d, dx, dy] = directions.map(|v| v.iter().map(|c| c.abs()).sum::<f64>());
        Self {
            window,
            eye: ray.eye,
            directions,
            extent: [f64::from(window.width() - 1), f64::from(window.height() - 1)],
            // Twelve roundings at most.
            omega: (d + (SIDE - 1) as f64 * (dx + dy)) * (1.0 + 16.0 * f64::EPSILON),
        }
    }
}

/// The power of two at or below a positive normal number.
fn power_of_two_near(value: f64) -> f64 {
    f64::from_bits(value.to_bits() & !((1 << 52) - 1))
}

/// Rows of the inverse of the matrix with these columns, and a bound of how far the product of the
/// two is from 1: a row applied to a point of pixel coordinates (x, y) at t is wrong by at most
/// t·residual·(1 + |x| + |y|), besides the rounding of its application.
fn inverse([dx, dy, d0]: [[f64; 3]; 3]) -> ([[f64; 3]; 3], f64) {
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let cross = |a: [f64; 3], b: [f64; 3]| -> [f64; 3] {
        std::array::from_fn(|k| {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            a[i] * b[j] - a[j] * b[i]
        })
    };
    let determinant = dot(d0, cross(dx, dy));
    let rows = [cross(dy, d0), cross(d0, dx), cross(dx, dy)].map(|r| r.map(|c| c / determinant));
    let columns = [dx, dy, d0];
    let mut residual = 0.0;
    for (i, row) in rows.iter().enumerate() {
        for (j, column) in columns.iter().enumerate() {
            let expected = f64::from(u8::from(i == j));
            let size: f64 = row.iter().zip(column).map(|(r, c)| (r * c).abs()).sum();
            // Five roundings of at most u·size each in the product itself.
            let wrong = (dot(*row, *column) - expected).abs() + 4.0 * f64::EPSILON * size;
            residual = if wrong < residual { residual } else { wrong };
        }
    }
    (rows, residual)
}
