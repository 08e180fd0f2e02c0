//! Exact signs and values of the caster's polynomials, in expansions.
//!
//! With a_i = v_i − e, c_0 = a_1 × a_2 and so on cyclically: W_i = c_i·d, V = a_0·c_0,
//! n = (v_1 − v_0) × (v_2 − v_0), D = n·d. `sgn*` of a product with d is the first nonzero sign of
//! the products with d, DX and DY. Everything here is right for every input in range.

use super::expansion::Expansion;
use super::pair::PairVector;
use super::ray::Ray;

/// `sgn*` of a product, and whether the product with d itself is 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Signed {
    pub(super) sign: i8,
    pub(super) zero: bool,
}

/// A triangle's vertices in f64 (exact).
pub(super) type Vertices = [[f64; 3]; 3];

/// `sgn*(W_i)`; sign 0 where the edge lies on a line through the eye or has no length.
#[cold]
pub(super) fn edge_sign(ray: &Ray, vertices: &Vertices, i: usize) -> Signed {
    let c = edge_cross(ray, vertices, i);
    first_sign(ray, |direction| dot(&c, direction))
}

/// |W_i|, relative error below 2u.
#[cold]
pub(super) fn edge_magnitude(ray: &Ray, vertices: &Vertices, i: usize) -> f64 {
    dot(&edge_cross(ray, vertices, i), ray.direction()).estimate().abs()
}

/// sgn V.
#[cold]
pub(super) fn plane_sign(ray: &Ray, vertices: &Vertices) -> i8 {
    plane(ray, vertices).sign()
}

/// |V|, relative error below 2u.
#[cold]
pub(super) fn plane_magnitude(ray: &Ray, vertices: &Vertices) -> f64 {
    plane(ray, vertices).estimate().abs()
}

/// `sgn*(F)`, F = V'_A·D'_B − V'_B·D'_A, for two covering triangles with their signs of V:
/// negative where A is nearer, 0 where both lie in one plane.
#[cold]
pub(super) fn depth_sign(ray: &Ray, a: (&Vertices, i8), b: (&Vertices, i8)) -> Signed {
    // A minus sign on both V and n of a triangle: V' = |V|, n' = sgn(V)·n.
    let oriented = |(vertices, sign): (&Vertices, i8)| {
        let (v, n) = (plane(ray, vertices), normal(vertices));
        if sign < 0 { (v.negated(), n.map(Expansion::negated)) } else { (v, n) }
    };
    let ((mut v_a, n_a), (mut v_b, n_b)) = (oriented(a), oriented(b));
    v_a.compress();
    v_b.compress();
    first_sign(ray, |direction| {
        let (mut d_a, mut d_b) = (dot(&n_a, direction), dot(&n_b, direction).negated());
        d_a.compress();
        d_b.compress();
        let mut f = Expansion::ZERO;
        f.add_product_of(&v_b, &d_a);
        f.add_product_of(&v_a, &d_b);
        f.negated()
    })
}

fn first_sign(ray: &Ray, value: impl Fn([f64; 3]) -> Expansion) -> Signed {
    let signs = ray.directions.iter().map(|&direction| value(direction).sign());
    let mut zero = false;
    for (k, sign) in signs.enumerate() {
        if sign != 0 {
            return Signed { sign, zero };
        }
        zero |= k == 0;
    }
    Signed { sign: 0, zero }
}

/// c_i.
fn edge_cross(ray: &Ray, vertices: &Vertices, i: usize) -> [Expansion; 3] {
    let [j, k] = [(i + 1) % 3, (i + 2) % 3];
    cross(
        &PairVector::difference(vertices[j], ray.eye),
        &PairVector::difference(vertices[k], ray.eye),
    )
}

/// n.
fn normal(vertices: &Vertices) -> [Expansion; 3] {
    cross(
        &PairVector::difference(vertices[1], vertices[0]),
        &PairVector::difference(vertices[2], vertices[0]),
    )
}

/// V = a_0·n, the same as a_0·c_0.
fn plane(ray: &Ray, vertices: &Vertices) -> Expansion {
    let n = normal(vertices);
    let a = PairVector::difference(vertices[0], ray.eye);
    let mut sum = Expansion::ZERO;
    for (n, (low, high)) in n.iter().zip(a.low.into_iter().zip(a.high)) {
        sum.add_scaled(n, low);
        sum.add_scaled(n, high);
    }
    sum
}

fn cross(a: &PairVector, b: &PairVector) -> [Expansion; 3] {
    std::array::from_fn(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        let mut component = Expansion::ZERO;
        for (x, y) in [(a.low, b.low), (a.low, b.high), (a.high, b.low), (a.high, b.high)] {
            component.add_product(x[i], y[j]);
            component.add_product(-x[j], y[i]);
        }
        component.compress();
        component
    })
}

fn dot(vector: &[Expansion; 3], direction: [f64; 3]) -> Expansion {
    let mut sum = Expansion::ZERO;
    for (component, d) in vector.iter().zip(direction) {
        sum.add_scaled(component, d);
    }
    sum
}
