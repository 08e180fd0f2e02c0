//! What GLSL and the fixed part of the pipeline give a shader, in f64: functions, perspective
//! weights, varyings. And what a comparison must know of a run: how close it came to a jump.

use super::super::stage::{V3, cross, dot};
use truecast::pixel::Pixel;
use truecast::scene::camera::PinholeCamera;

pub(super) type Mat4 = [[f64; 4]; 4];

/// How close a shader came to places where its value jumps or loses its digits.
pub(super) struct Doubts {
    /// Smallest number but 0 whose sign decided.
    pub(super) gate: f64,
    /// Smallest length of a sum of unit vectors that was made unit.
    pub(super) length: f64,
    /// Whether a number whose sign decided was negative.
    pub(super) turned_away: bool,
}

impl Doubts {
    pub(super) const NONE: Self =
        Self { gate: f64::INFINITY, length: f64::INFINITY, turned_away: false };

    /// The number, noted as one whose sign decides.
    pub(super) fn gate(&mut self, number: f64) -> f64 {
        if number != 0.0 {
            self.gate = self.gate.min(number.abs());
        }
        self.turned_away |= number < 0.0;
        number
    }

    /// As [`Self::gate`], for a number that rounding may have made 0.
    pub(super) fn rounded_gate(&mut self, number: f64) -> f64 {
        self.gate = self.gate.min(number.abs());
        self.turned_away |= number < 0.0;
        number
    }

    /// `normalize` of a sum of unit vectors.
    pub(super) fn normalize(&mut self, sum: V3) -> V3 {
        self.length = self.length.min(dot(sum, sum).sqrt());
        normalize(sum)
    }
}

pub(super) fn normalize(a: V3) -> V3 {
    let length = dot(a, a).sqrt();
    a.map(|c| c / length)
}

pub(super) fn add(a: V3, b: V3) -> V3 {
    std::array::from_fn(|k| a[k] + b[k])
}

pub(super) fn sub(a: V3, b: V3) -> V3 {
    std::array::from_fn(|k| a[k] - b[k])
}

pub(super) fn minus(a: V3) -> V3 {
    a.map(|c| -c)
}

pub(super) fn scale(k: f64, a: V3) -> V3 {
    a.map(|c| k * c)
}

pub(super) fn mult(a: V3, b: V3) -> V3 {
    std::array::from_fn(|k| a[k] * b[k])
}

/// `reflect(I, N)` = I − 2(N·I)N.
pub(super) fn reflect(i: V3, n: V3) -> V3 {
    sub(i, scale(2.0 * dot(n, i), n))
}

/// `(matrix * vec4(a, w)).xyz`.
pub(super) fn transform(matrix: &Mat4, a: V3, w: f64) -> V3 {
    std::array::from_fn(|row| {
        let [x, y, z, last] = matrix[row];
        x * a[0] + y * a[1] + z * a[2] + last * w
    })
}

pub(super) fn product(a: &Mat4, b: &Mat4) -> Mat4 {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..4).map(|k| a[i][k] * b[k][j]).sum()))
}

/// `lookAt(eye, at, up)`: world to eye space, x right, y up, looking along −z.
pub(super) fn look_at(eye: V3, at: V3, up: V3) -> Mat4 {
    let forward = normalize(sub(at, eye));
    let right = normalize(cross(forward, up));
    let up = cross(right, forward);
    let row = |r: V3| [r[0], r[1], r[2], -dot(r, eye)];
    [row(right), row(up), row(minus(forward)), [0.0, 0.0, 0.0, 1.0]]
}

/// Corners in homogeneous window coordinates (X, Y, W): what `gl_Position` comes to.
pub(super) fn window_positions(camera: &PinholeCamera, corners: [V3; 3]) -> [V3; 3] {
    let (dx, dy, d0) = (camera.dx(), camera.dy(), camera.d0());
    let rows = [cross(dy, d0), cross(d0, dx), cross(dx, dy)];
    let volume = dot(dx, rows[0]);
    corners.map(|corner| {
        let a = sub(corner, camera.eye());
        rows.map(|row| dot(row, a) / volume)
    })
}

/// Weights of varyings at a pixel's centre, as the OpenGL specification has them: barycentric in
/// the window, each divided by its corner's W, made to sum to 1. `None` outside the triangle, or
/// where it has no proper image.
pub(super) fn varying_weights(window: &[V3; 3], pixel: Pixel) -> Option<V3> {
    if window.iter().any(|corner| corner[2] < 0.1) {
        return None;
    }
    let at = pixel.sample();
    let flat = window.map(|[x, y, w]| [x / w, y / w]);
    let area = |p: [f64; 2], q: [f64; 2], r: [f64; 2]| {
        (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
    };
    let whole = area(flat[0], flat[1], flat[2]);
    // Of a thinner sliver the weights are off by more than the bound allows.
    if whole.abs() < 1.0 {
        return None;
    }
    let barycentric = [
        area(at, flat[1], flat[2]) / whole,
        area(flat[0], at, flat[2]) / whole,
        area(flat[0], flat[1], at) / whole,
    ];
    if barycentric.iter().any(|&b| b <= 0.0) {
        return None;
    }
    let divided: V3 = std::array::from_fn(|i| barycentric[i] / window[i][2]);
    let sum = divided[0] + divided[1] + divided[2];
    Some(divided.map(|b| b / sum))
}

/// A varying at the fragment.
pub(super) fn varying(weights: V3, [a, b, c]: [V3; 3]) -> V3 {
    std::array::from_fn(|k| weights[0] * a[k] + weights[1] * b[k] + weights[2] * c[k])
}
