//! Exact values in plain f64, where no operation happens to round.
//!
//! On grids (integers, halves, few bits) every product and sum of a predicate fits 53 bits. Its
//! rounding errors are computed beside it; where all are 0 the f64 value is the value, also if it
//! is 0, and `sgn*` needs no expansion. Where one is not, the answer is `None` and nothing is lost
//! but time. Ranges are those of the expansions: nothing under- or overflows.

use super::exact::{Signed, Vertices};
use super::expansion::{two_difference, two_product, two_sum};
use super::ray::Ray;

/// `sgn*(W_i)`.
pub(super) fn edge_sign(ray: &Ray, vertices: &Vertices, i: usize) -> Option<Signed> {
    let mut exactly = Exactly::default();
    let c = edge_cross(&mut exactly, ray, vertices, i);
    first_sign(ray, |direction| {
        let value = exactly.dot(c, direction);
        exactly.holds().then(|| sign_of(value))
    })
}

/// W_i.
pub(super) fn edge_value(ray: &Ray, vertices: &Vertices, i: usize) -> Option<f64> {
    let mut exactly = Exactly::default();
    let c = edge_cross(&mut exactly, ray, vertices, i);
    let value = exactly.dot(c, ray.direction());
    exactly.holds().then_some(value)
}

/// sgn V.
pub(super) fn plane_sign(ray: &Ray, vertices: &Vertices) -> Option<i8> {
    let mut exactly = Exactly::default();
    let (value, _) = plane(&mut exactly, ray, vertices);
    exactly.holds().then(|| sign_of(value))
}

/// `sgn*(F)` for two covering triangles with their signs of V. V and D must not round; the two
/// products of F may: TwoProduct's results order as the products do, high parts first, because a
/// rounded product and its error are unique and rounding is monotone.
pub(super) fn depth_sign(ray: &Ray, a: (&Vertices, i8), b: (&Vertices, i8)) -> Option<Signed> {
    let mut exactly = Exactly::default();
    let mut oriented = |(vertices, sign): (&Vertices, i8)| {
        let (v, n) = plane(&mut exactly, ray, vertices);
        let sign = f64::from(sign);
        (v * sign, n.map(|c| c * sign))
    };
    let ((v_a, n_a), (v_b, n_b)) = (oriented(a), oriented(b));
    first_sign(ray, |direction| {
        let (d_a, d_b) = (exactly.dot(n_a, direction), exactly.dot(n_b, direction));
        let (left, right) = (two_product(v_a, d_b), two_product(v_b, d_a));
        exactly.holds().then(|| match sign_of(left[0] - right[0]) {
            0 => sign_of(left[1] - right[1]),
            sign => sign,
        })
    })
}

/// The first sign that is not 0 along d, DX and DY.
fn first_sign(ray: &Ray, mut sign: impl FnMut([f64; 3]) -> Option<i8>) -> Option<Signed> {
    let [d, dx, dy] = ray.directions;
    match sign(d)? {
        0 => {}
        sign => return Some(Signed { sign, zero: false }),
    }
    let sign = match sign(dx)? {
        0 => sign(dy)?,
        sign => sign,
    };
    Some(Signed { sign, zero: true })
}

/// c_i.
fn edge_cross(exactly: &mut Exactly, ray: &Ray, vertices: &Vertices, i: usize) -> [f64; 3] {
    let a = exactly.difference(vertices[(i + 1) % 3], ray.eye);
    let b = exactly.difference(vertices[(i + 2) % 3], ray.eye);
    exactly.cross(a, b)
}

/// V and n.
fn plane(exactly: &mut Exactly, ray: &Ray, vertices: &Vertices) -> (f64, [f64; 3]) {
    let a = exactly.difference(vertices[0], ray.eye);
    let (p, q) = (
        exactly.difference(vertices[1], vertices[0]),
        exactly.difference(vertices[2], vertices[0]),
    );
    let n = exactly.cross(p, q);
    (exactly.dot(a, n), n)
}

/// f64 arithmetic that keeps account of what it lost.
#[derive(Clone, Copy, Debug, Default)]
struct Exactly {
    /// Sum of the magnitudes of all rounding errors: 0 only if there was none.
    lost: f64,
}

impl Exactly {
    /// Whether nothing was lost.
    fn holds(&self) -> bool {
        self.lost == 0.0
    }

    #[inline(always)]
    fn kept(&mut self, [value, error]: [f64; 2]) -> f64 {
        self.lost += error.abs();
        value
    }

    #[inline(always)]
    fn difference(&mut self, a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|k| self.kept(two_difference(a[k], b[k])))
    }

    #[inline(always)]
    fn cross(&mut self, a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|k| {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            let (p, q) = (self.kept(two_product(a[i], b[j])), self.kept(two_product(a[j], b[i])));
            self.kept(two_difference(p, q))
        })
    }

    #[inline(always)]
    fn dot(&mut self, a: [f64; 3], b: [f64; 3]) -> f64 {
        let [x, y, z] = std::array::from_fn(|k| self.kept(two_product(a[k], b[k])));
        let xy = self.kept(two_sum(x, y));
        self.kept(two_sum(xy, z))
    }
}

fn sign_of(value: f64) -> i8 {
    i8::from(value > 0.0) - i8::from(value < 0.0)
}
