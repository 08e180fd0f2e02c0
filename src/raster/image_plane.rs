//! The image plane in homogeneous coordinates: adj(P) of P = [DX DY D0], as f64 and as integers.
//!
//! Source: Olano & Greer, "Triangle scan conversion using 2D homogeneous coordinates" (1997).
//! With X = adj(P)·(v − e), X = det(P)·(x·w, y·w, w): the vertex in the image, never divided.
//! Only the camera is treated here; vertices and edges are `rows` (f64) and `exact` (integers).

use super::dyadic::{Dyadic, Scaled, sign};
use crate::mutant::{self, Mutant};
use crate::scene::camera::PinholeCamera;
use dashu_int::IBig;

/// A camera as the rasterizer sees it.
pub(super) struct ImagePlane {
    /// adj(P) of the integer lattice, each entry correctly rounded (one relative error u).
    ///
    /// Magnitudes are 0 or 1…2^107. With |v − e| in 0 or 2^-149…2^128 the f64 filters cannot
    /// overflow or lose bits to underflow: X ≤ 2^237, edge rows ≤ 2^477, V ≤ 2^716; each sum of
    /// products is a multiple of the last bit of its smallest product: X of 2^-202,
    /// rows of 2^-457, V of 2^-712, all normal numbers.
    pub(super) adjugate: [[f64; 3]; 3],
    /// The eye.
    pub(super) eye: [f64; 3],
    /// Width and height of the frame, in pixels.
    pub(super) extent: [f64; 2],
    /// sgn det(P), ±1.
    pub(super) orientation: f64,
    /// The same matrix as integers, without their common power of two.
    pub(super) exact: ExactPlane,
}

/// adj(P) in integers.
pub(super) struct ExactPlane {
    /// adj(P)·2^-`adjugate_exponent`.
    pub(super) adjugate: [[IBig; 3]; 3],
    /// The same numbers: below 2^107.
    pub(super) adjugate_short: [[i128; 3]; 3],
    /// Power of two that was taken out of `adjugate`.
    pub(super) adjugate_exponent: i64,
    /// det(P) of the integer lattice.
    pub(super) determinant: IBig,
    /// The lattice's unit is 2^`lattice_exponent`.
    pub(super) lattice_exponent: i64,
    /// The eye's components.
    pub(super) eye: [Dyadic; 3],
}

impl ImagePlane {
    /// Reads the camera's numbers.
    pub(super) fn new(camera: &PinholeCamera) -> Self {
        // Read the vectors as multiples of the lattice's unit q0 = 2^(E−53): at most 2^53 steps.
        let q0_exponent = i64::from(camera.exponent()) - 53;
        let q0 = 2.0_f64.powi(camera.exponent() - 53);
        let steps = [camera.dx(), camera.dy(), camera.d0()].map(|v| v.map(|c| (c / q0) as i64));
        // Drop the powers of two that all nine share: hand-written cameras become small integers.
        let shared = steps.iter().flatten().fold(0, |bits, c| bits | c).trailing_zeros();
        let [dx, dy, d0] = steps.map(|v| v.map(|c| i128::from(c >> shared)));
        // Rows of the adjugate are the cross products of columns: below 2^107, exact in i128.
        let rows = [cross(dy, d0), cross(d0, dx), cross(dx, dy)];
        let determinant: IBig = (0..3).map(|k| IBig::from(dx[k]) * IBig::from(rows[0][k])).sum();
        let common = rows.iter().flatten().fold(0, |bits, c| bits | c).trailing_zeros();
        let resolution = camera.resolution();
        Self {
            // `as f64` rounds i128 to nearest.
            adjugate: rows.map(|row| row.map(|c| c as f64)),
            eye: camera.eye(),
            extent: [f64::from(resolution.width()), f64::from(resolution.height())],
            orientation: match mutant::is(Mutant::OrientationIgnored) {
                true => 1.0,
                false => f64::from(sign(&determinant)),
            },
            exact: ExactPlane {
                adjugate: rows.map(|row| row.map(|c| IBig::from(c >> common))),
                adjugate_short: rows.map(|row| row.map(|c| c >> common)),
                adjugate_exponent: i64::from(common),
                determinant,
                lattice_exponent: q0_exponent + i64::from(shared),
                eye: camera.eye().map(Dyadic::new),
            },
        }
    }

    /// t·(plane row)/|V| for the f64 rows over `adjugate`: 2^-`lattice_exponent`/|det(P)|, because t
    /// is in units of the lattice's directions.
    pub(super) fn ray_parameter_per_depth(&self) -> f64 {
        let determinant = Scaled::from_integer(&self.exact.determinant);
        Scaled {
            mantissa: 1.0 / determinant.mantissa.abs(),
            exponent: -determinant.exponent - self.exact.lattice_exponent,
        }
        .value()
    }
}

fn cross(a: [i128; 3], b: [i128; 3]) -> [i128; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
