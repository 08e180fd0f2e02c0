//! Whether a triangle crosses a shadow's segment, in integers: the definition of `super`.
//!
//! Lights are at any finite position, so expansions of f64 could over- or underflow; integers
//! cannot. Every predicate is homogeneous in the coordinates of points, in the camera's directions and
//! in a light's direction, so each of the three groups is scaled by a power of two of its own that
//! makes integers of its numbers, and no sign changes.

use super::super::ray::Ray;
use crate::mutant::{self, Mutant};
use crate::scene::light_point::LightPoint;
use dashu_int::IBig;

type Vector = [IBig; 3];

/// Three corners.
type Corners = [[f32; 3]; 3];

/// The visible triangle's plane in integers, with the ray's directions.
struct Surface {
    eye: Vector,
    normal: Vector,
    /// V.
    volume: IBig,
    /// d, DX, DY.
    directions: [Vector; 3],
}

/// Whether `triangle` crosses the open segment from the ray's point on `surface` to the light.
#[cold]
pub(super) fn crosses(ray: &Ray, surface: &Corners, triangle: &Corners, light: LightPoint) -> bool {
    let corners = [surface, triangle].map(|corners| corners.map(|v| v.map(f64::from)));
    let points = corners.as_flattened().iter().chain([&ray.eye]);
    let unit = match &light {
        LightPoint::Position(l) => unit_of(points.chain([l])),
        LightPoint::Direction(_) => unit_of(points),
    };
    let integers = |v: [f64; 3]| v.map(|c| integer(c, unit));
    let [surface, v] = corners.map(|corners| corners.map(integers));
    let surface = Surface::new(ray, &surface, integers(ray.eye));
    let n = cross(&minus(&v[1], &v[0]), &minus(&v[2], &v[0]));

    // The light's side of the plane, then the surface point's.
    let (light, is_position) = match light {
        LightPoint::Position(l) => (integers(l), true),
        LightPoint::Direction(l) => {
            let unit = unit_of([&l].into_iter());
            (l.map(|c| integer(c, unit)), false)
        }
    };
    let tau = sign(&match is_position {
        true => dot(&n, &minus(&light, &v[0])),
        false => dot(&n, &light),
    });
    if tau == 0 || surface.side(&n, &v[0], -tau) != -tau {
        return false;
    }

    // And of the planes through the edges and the light.
    (0..3).all(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        let plane = match is_position {
            true => cross(&minus(&v[j], &light), &minus(&v[k], &light)),
            false => cross(&minus(&v[k], &v[j]), &light),
        };
        surface.side(&plane, &v[j], -tau) == -tau
    })
}

impl Surface {
    fn new(ray: &Ray, corners: &[Vector; 3], eye: Vector) -> Self {
        let [v0, v1, v2] = corners;
        let normal = cross(&minus(v1, v0), &minus(v2, v0));
        let volume = dot(&normal, &minus(v0, &eye));
        let unit = unit_of(ray.directions.iter());
        let directions = ray.directions.map(|d| d.map(|c| integer(c, unit)));
        Self { eye, normal, volume, directions }
    }

    /// The side of the moved surface point against a plane through `point`, 0 only where the plane
    /// is that of the surface or `normal` is 0: `sgn*(g·d)`·sgn V. `wanted` is for planted mistakes.
    fn side(&self, normal: &Vector, point: &Vector, wanted: i8) -> i8 {
        let height = dot(normal, &minus(&self.eye, point));
        let g: Vector =
            std::array::from_fn(|k| &height * &self.normal[k] + &self.volume * &normal[k]);
        let mut signs = self.directions.iter().map(|direction| sign(&dot(&g, direction)));
        if mutant::is(Mutant::ShadowBothSides) || mutant::is(Mutant::ShadowNeitherSide) {
            let both = mutant::is(Mutant::ShadowBothSides);
            return match signs.next() {
                Some(0) | None => {
                    if both {
                        wanted
                    } else {
                        0
                    }
                }
                Some(side) => side * sign(&self.volume),
            };
        }
        signs.find(|&side| side != 0).unwrap_or(0) * sign(&self.volume)
    }
}

fn minus(a: &Vector, b: &Vector) -> Vector {
    std::array::from_fn(|k| &a[k] - &b[k])
}

fn cross(a: &Vector, b: &Vector) -> Vector {
    std::array::from_fn(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        &a[i] * &b[j] - &a[j] * &b[i]
    })
}

fn dot(a: &Vector, b: &Vector) -> IBig {
    &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
}

fn sign(value: &IBig) -> i8 {
    match value.cmp(&IBig::ZERO) {
        std::cmp::Ordering::Less => -1,
        std::cmp::Ordering::Equal => 0,
        std::cmp::Ordering::Greater => 1,
    }
}

/// A finite f64 as m·2^k with m odd, or (0, 0).
fn odd_and_exponent(value: f64) -> (i64, i32) {
    let bits = value.to_bits();
    let field = (bits >> 52 & 0x7ff) as i32;
    let fraction = (bits & ((1 << 52) - 1)) as i64;
    let (mantissa, exponent) =
        if field == 0 { (fraction, -1074) } else { (fraction | 1 << 52, field - 1075) };
    if mantissa == 0 {
        return (0, 0);
    }
    let zeros = mantissa.trailing_zeros();
    let odd = mantissa >> zeros;
    (if value < 0.0 { -odd } else { odd }, exponent + zeros as i32)
}

/// The largest power of two, by its exponent, of which all numbers are multiples; 0 if all are 0.
fn unit_of<'a>(vectors: impl Iterator<Item = &'a [f64; 3]>) -> i32 {
    let exponents = vectors.flatten().map(|&c| odd_and_exponent(c));
    exponents.filter(|&(odd, _)| odd != 0).map(|(_, exponent)| exponent).min().unwrap_or(0)
}

/// value·2^-unit.
fn integer(value: f64, unit: i32) -> IBig {
    let (odd, exponent) = odd_and_exponent(value);
    if odd == 0 {
        return IBig::ZERO;
    }
    IBig::from(odd) << (exponent - unit) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integers_are_the_floats() {
        for value in [1.0, -3.0, 0.1, 5e-324, -1.5e308, 2.0_f64.powi(-1022), 6.0] {
            let (odd, exponent) = odd_and_exponent(value);
            assert_eq!(odd.rem_euclid(2), 1);
            // Two steps, because 2^-1074 alone is no factor that keeps all bits.
            let half = exponent / 2;
            assert_eq!(odd as f64 * 2.0_f64.powi(half) * 2.0_f64.powi(exponent - half), value);
        }
        assert_eq!(unit_of([&[0.0, 6.0, 20.0]].into_iter()), 1);
        assert_eq!(integer(20.0, 1), IBig::from(10));
        assert_eq!(unit_of([&[0.0; 3]].into_iter()), 0);
        assert_eq!(integer(-0.0, 7), IBig::ZERO);
    }
}
