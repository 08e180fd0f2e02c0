//! The predicates against integers, on inputs near zero.

use super::candidate;
use super::coverage;
use super::exact;
use super::filter::Relative;
use super::pair::{PairVector, triple_product};
use super::ray::Ray;
use super::single::ShearedRay;
use crate::accel::LeafTriangle;
use crate::mesh::TriangleId;
use dashu_int::IBig;
use proptest::prelude::*;

type Vector = [IBig; 3];

/// Inputs are multiples of 2^-40 here: integers after scaling.
fn vector(v: [f64; 3]) -> Vector {
    v.map(|c| {
        let steps = c * 2.0_f64.powi(40);
        assert!(steps.fract() == 0.0 && steps.abs() < 2.0_f64.powi(110));
        let low = steps % 2.0_f64.powi(60);
        (IBig::from(((steps - low) * 2.0_f64.powi(-60)) as i64) << 60) + IBig::from(low as i64)
    })
}

fn minus(a: &Vector, b: &Vector) -> Vector {
    std::array::from_fn(|k| &a[k] - &b[k])
}

fn determinant(a: &Vector, b: &Vector, c: &Vector) -> IBig {
    &c[0] * (&a[1] * &b[2] - &a[2] * &b[1])
        + &c[1] * (&a[2] * &b[0] - &a[0] * &b[2])
        + &c[2] * (&a[0] * &b[1] - &a[1] * &b[0])
}

fn sign_of(value: &IBig) -> i8 {
    match value.cmp(&IBig::ZERO) {
        std::cmp::Ordering::Less => -1,
        std::cmp::Ordering::Equal => 0,
        std::cmp::Ordering::Greater => 1,
    }
}

/// Binary exponent that makes an integer of every f64 in these tests.
const SCALE: usize = 400;

/// value · 2^400.
fn scaled(value: f64) -> IBig {
    if value == 0.0 {
        return IBig::ZERO;
    }
    let bits = value.to_bits();
    let exponent = ((bits >> 52) & 0x7ff) as i64 - 1075 + SCALE as i64;
    let mantissa = IBig::from((bits & ((1 << 52) - 1)) | 1 << 52);
    let shift = usize::try_from(exponent).expect("values in these tests are above 2^-347");
    if value < 0.0 { -(mantissa << shift) } else { mantissa << shift }
}

fn magnitude(value: IBig) -> IBig {
    if value < IBig::ZERO { -value } else { value }
}

/// W_0, W_1, W_2 for a direction, and V, by integers.
fn by_integers(ray: &Ray, v: &[[f64; 3]; 3], direction: [f64; 3]) -> ([IBig; 3], IBig) {
    let e = vector(ray.eye);
    let a = v.map(|vertex| minus(&vector(vertex), &e));
    let d = vector(direction);
    (
        std::array::from_fn(|i| determinant(&a[(i + 1) % 3], &a[(i + 2) % 3], &d)),
        determinant(&a[0], &a[1], &a[2]),
    )
}

/// The triangle as the tree holds it; its coordinates must be f32.
fn leaf(v: &[[f64; 3]; 3]) -> LeafTriangle {
    let vertices = v.map(|vertex| {
        vertex.map(|c| {
            assert_eq!(f64::from(c as f32), c);
            c as f32
        })
    });
    LeafTriangle { vertices, id: TriangleId::new(0), copies: 1 }
}

fn first_nonzero(signs: [i8; 3]) -> i8 {
    signs.into_iter().find(|&sign| sign != 0).unwrap_or(0)
}

fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![
        (-8_i32..=8).prop_map(f64::from),
        (-1.0e3_f32..1.0e3).prop_map(|c| f64::from((c * 4096.0).round() / 4096.0)),
    ]
}

fn point() -> impl Strategy<Value = [f64; 3]> {
    [coordinate(), coordinate(), coordinate()]
}

/// A ray through a corner, through a point of an edge, or a few steps of the lattice beside it.
fn aimed() -> impl Strategy<Value = (Ray, [[f64; 3]; 3])> {
    (
        [point(), point(), point()],
        point(),
        0..=4_u32,
        [-2_i32..=2, -2..=2, -2..=2],
        [-2_i32..=2, -2..=2, -2..=2],
    )
        .prop_map(|(v, eye, along, nudge, dx)| {
            let s = f64::from(along) / 4.0;
            let step = 2.0_f64.powi(-38);
            let direction = std::array::from_fn(|k| {
                let on_edge = v[0][k] + (v[1][k] - v[0][k]) * s;
                on_edge - eye[k] + f64::from(nudge[k]) * step
            });
            let ray = Ray { eye, directions: [direction, dx.map(f64::from), [1.0, 0.5, -0.25]] };
            (ray, v)
        })
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(4096) })]

    /// Coverage, its edge flag and the filter against integers; rays are aimed at edges, so most
    /// edge functions are 0 or within rounding of it.
    #[test]
    fn coverage_is_the_definition((ray, v) in aimed()) {
        let (w, plane) = by_integers(&ray, &v, ray.directions[0]);
        let (wx, _) = by_integers(&ray, &v, ray.directions[1]);
        let (wy, _) = by_integers(&ray, &v, ray.directions[2]);
        let signs: [i8; 3] =
            std::array::from_fn(|i| first_nonzero([sign_of(&w[i]), sign_of(&wx[i]), sign_of(&wy[i])]));
        let covered = plane != IBig::ZERO && signs == [sign_of(&plane); 3];

        let sheared = ShearedRay::new(&ray);
        let triangle = leaf(&v);
        let (covering, _) = coverage::decide(&ray, &sheared, &triangle);
        prop_assert_eq!(covering.is_some(), covered);
        if let Some(covering) = covering {
            prop_assert_eq!(covering.sign, sign_of(&plane));
            prop_assert_eq!(covering.on_edge, w.contains(&IBig::ZERO));
        }
        for i in 0..3 {
            let exact = exact::edge_sign(&ray, &v, i);
            prop_assert_eq!(exact.sign, signs[i]);
            prop_assert_eq!(exact.zero, w[i] == IBig::ZERO);
        }
        prop_assert_eq!(exact::plane_sign(&ray, &v), sign_of(&plane));

        // No filter gives a wrong sign.
        let relative = Relative::new(ray.eye, &v);
        let (estimates, bound) = relative.edge_functions(&ray);
        for i in 0..3 {
            for bound in [bound, relative.tight_edge_bound(&ray, i)] {
                if estimates[i].abs() > bound {
                    prop_assert_eq!(estimates[i].signum() as i8, sign_of(&w[i]));
                }
            }
        }
        if let Some(sign) = relative.plane_and_speed(&ray)[0].sign() {
            prop_assert_eq!(sign, sign_of(&plane));
        }
    }

    /// A triple product that pairs certify is within 3u of the integer one.
    #[test]
    fn certified_values_are_good_to_three_units((ray, v) in aimed()) {
        let (w, plane) = by_integers(&ray, &v, ray.directions[0]);
        let a = v.map(|vertex| PairVector::difference(vertex, ray.eye));
        let d = PairVector::exact(ray.direction());
        let edge = |i: usize, j: usize| PairVector::difference(v[i], v[j]);
        let computed = [
            (triple_product(&d, &a[1], &edge(2, 1)), &w[0]),
            (triple_product(&d, &a[2], &edge(0, 2)), &w[1]),
            (triple_product(&d, &a[0], &edge(1, 0)), &w[2]),
            (triple_product(&edge(0, 2), &edge(1, 0), &a[0]), &plane),
        ];
        for (value, exact) in computed {
            let Some(value) = value else { continue };
            // value·2^120 is the integer's scale.
            let (value, wanted) = (scaled(value) << 120, exact << SCALE);
            prop_assert!(magnitude(value - &wanted) << 53 <= magnitude(wanted) * 3);
        }
    }

    /// The surface of a covering triangle: bounds of t that hold, weights good to 9u.
    #[test]
    fn surfaces_are_certain((ray, v) in aimed()) {
        if coverage::decide(&ray, &ShearedRay::new(&ray), &leaf(&v)).0.is_none() {
            return Ok(());
        }
        let (w, plane) = by_integers(&ray, &v, ray.directions[0]);
        let speed: IBig = w.iter().sum();
        let sign = IBig::from(sign_of(&speed));
        let surface = candidate::surface(&ray, &v);
        let [lo, hi] = surface.t.map(|t| scaled(t) * &speed * &sign);
        let exact = (plane << SCALE) * &sign;
        prop_assert!(lo <= exact && exact <= hi);
        for (weight, w) in surface.barycentric.0.into_iter().zip(w) {
            let (computed, wanted) = (scaled(weight) * &speed, w << SCALE);
            prop_assert!(magnitude(computed - &wanted) << 53 <= magnitude(wanted) * 9);
        }
    }

    /// The order of two planes, nearly or exactly equal in depth at the sample, against integers.
    #[test]
    fn depth_order_is_the_definition(
        (ray, a) in aimed(),
        weights in [-4_i32..=4, -4..=4, -4..=4, -4..=4],
        lift in -1_i32..=1,
    ) {
        // B's corners lie in A's plane (small integer combinations of its edges), or one of them
        // is lifted by a step.
        let corner = |p: i32, q: i32| -> [f64; 3] {
            std::array::from_fn(|k| {
                a[0][k] + f64::from(p) * (a[1][k] - a[0][k]) + f64::from(q) * (a[2][k] - a[0][k])
            })
        };
        let mut b = [corner(weights[0], weights[1]), corner(weights[2], weights[3]), a[2]];
        b[2][2] += f64::from(lift) * 2.0_f64.powi(-12);
        let (_, v_a) = by_integers(&ray, &a, ray.directions[0]);
        let (_, v_b) = by_integers(&ray, &b, ray.directions[0]);
        let (s_a, s_b) = (sign_of(&v_a), sign_of(&v_b));
        prop_assume!(s_a != 0 && s_b != 0);
        let signs = ray.directions.map(|direction| {
            let speed = |v: &[[f64; 3]; 3]| -> IBig { by_integers(&ray, v, direction).0.into_iter().sum() };
            let f = (&v_a * speed(&b) - &v_b * speed(&a)) * IBig::from(s_a) * IBig::from(s_b);
            sign_of(&f)
        });
        let exact = exact::depth_sign(&ray, (&a, s_a), (&b, s_b));
        prop_assert_eq!(exact.sign, first_nonzero(signs));
        prop_assert_eq!(exact.zero, signs[0] == 0);
    }
}
