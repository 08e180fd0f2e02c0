//! Curved surfaces as what they are: where a ray meets a sphere or a torus, and which way it faces
//! there.
//!
//! A shape of a scene file stands for one of these, and its triangles err from it. Rays are taken to
//! object space, where the parameter t is the same. Nothing here knows triangles; t and normals are
//! good to some 1e-12 of the size of the shape, far below the error of any mesh.

use super::roots::roots;
use crate::scene::shapes::Shape;
use crate::scene::transform::Transform;

type Vector = [f64; 3];

/// A surface in object space, about the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Surface {
    Sphere {
        radius: f64,
    },
    /// Its axis is y.
    Torus {
        major: f64,
        minor: f64,
    },
}

/// A curved surface in world space.
#[derive(Clone, Debug)]
pub(super) struct Curved {
    surface: Surface,
    transform: Transform,
    /// Rows of the inverse of the linear part.
    inverse: [Vector; 3],
    origin: Vector,
}

/// Where a ray meets it first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Contact {
    /// Ray parameter.
    pub(super) t: f64,
    /// Unit normal, outwards.
    pub(super) normal: Vector,
}

impl Curved {
    /// The surface that a shape stands for; `None` for a shape that is none of these, and for a
    /// transform that flattens.
    pub(super) fn new(shape: &Shape, transform: Transform) -> Option<Self> {
        let surface = match shape {
            Shape::UvSphere(sphere) => Surface::Sphere { radius: sphere.radius },
            Shape::Icosphere(sphere) => Surface::Sphere { radius: sphere.radius },
            Shape::Torus(torus) => Surface::Torus { major: torus.major, minor: torus.minor },
            _ => return None,
        };
        let [x, y, z] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
            .map(|axis| transform.direction(axis));
        let cofactors = [cross(y, z), cross(z, x), cross(x, y)];
        let determinant = dot(x, cofactors[0]);
        if determinant == 0.0 || !determinant.is_finite() {
            return None;
        }
        let inverse = cofactors.map(|row| row.map(|c| c / determinant));
        let origin = transform.position([0.0; 3]);
        Some(Self { surface, transform, inverse, origin })
    }

    /// The first point of the ray with t > 0 at which it crosses the surface.
    pub(super) fn first_contact(&self, eye: Vector, direction: Vector) -> Option<Contact> {
        let to_object = |v: Vector| self.inverse.map(|row| dot(row, v));
        let from = to_object(std::array::from_fn(|k| eye[k] - self.origin[k]));
        let along = to_object(direction);
        // Count t from the point nearest to the centre: that keeps the coefficients small.
        let middle = -dot(from, along) / dot(along, along);
        let nearest: Vector = std::array::from_fn(|k| from[k] + middle * along[k]);
        let reach = match self.surface {
            Surface::Sphere { radius } => radius,
            Surface::Torus { major, minor } => major + minor,
        };
        let square = reach * reach - dot(nearest, nearest);
        if square <= 0.0 {
            return None;
        }
        // A little wider than the enclosing sphere, so that contacts on it are inside.
        let half = 1.001 * (square / dot(along, along)).sqrt();
        let low = (-half).max(-middle);
        let polynomial = self.surface.along(nearest, along);
        let t = *roots(&polynomial, low, half).first()?;
        let point: Vector = std::array::from_fn(|k| nearest[k] + t * along[k]);
        let normal = self.transform.normal(self.surface.normal(point))?;
        Some(Contact { t: middle + t, normal })
    }
}

impl Surface {
    /// The polynomial in t whose roots are the contacts of o + t·d.
    fn along(self, o: Vector, d: Vector) -> Vec<f64> {
        let (a, b, c) = (dot(d, d), dot(o, d), dot(o, o));
        match self {
            // |o + t·d|² = r².
            Self::Sphere { radius } => vec![c - radius * radius, 2.0 * b, a],
            // (|p|² + R² − r²)² = 4R²(x² + z²).
            Self::Torus { major, minor } => {
                let c = c + major * major - minor * minor;
                let four = 4.0 * major * major;
                vec![
                    c * c - four * (o[0] * o[0] + o[2] * o[2]),
                    4.0 * b * c - 2.0 * four * (o[0] * d[0] + o[2] * d[2]),
                    4.0 * b * b + 2.0 * a * c - four * (d[0] * d[0] + d[2] * d[2]),
                    4.0 * a * b,
                    a * a,
                ]
            }
        }
    }

    /// The outward unit normal at a point of the surface.
    fn normal(self, p: Vector) -> Vector {
        let outwards = match self {
            Self::Sphere { .. } => p,
            Self::Torus { major, .. } => {
                // From the nearest point of the tube's centre line.
                let distance = (p[0] * p[0] + p[2] * p[2]).sqrt();
                let center = major / distance;
                [p[0] - center * p[0], p[1], p[2] - center * p[2]]
            }
        };
        let length = dot(outwards, outwards).sqrt();
        outwards.map(|c| c / length)
    }
}

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::shapes::{Torus, UvSphere};

    /// Contacts are found to this share of the shape's size, and normals to as much.
    const NEAR: f64 = 1e-12;

    fn assert_near(found: Vector, expected: Vector) {
        for (f, e) in found.iter().zip(expected) {
            assert!((f - e).abs() < NEAR, "{found:?} {expected:?}");
        }
    }

    #[test]
    fn a_sphere_is_met_where_its_transform_puts_it() {
        let shape = Shape::UvSphere(UvSphere { radius: 2.0, ..UvSphere::default() });
        let transform = Transform::from_steps([3.0, 1.0, 1.0], [0.0; 3], [10.0, 0.0, 0.0]);
        let curved = Curved::new(&shape, transform).unwrap();
        // An ellipsoid from x = 4 to 16, met from the left at twice the direction's length.
        let contact = curved.first_contact([0.0; 3], [2.0, 0.0, 0.0]).unwrap();
        assert!((contact.t - 2.0).abs() < NEAR);
        assert_near(contact.normal, [-1.0, 0.0, 0.0]);
        assert!(curved.first_contact([0.0; 3], [-1.0, 0.0, 0.0]).is_none());
        // From inside it is met from behind.
        let contact = curved.first_contact([10.0, 0.0, 0.0], [0.0, 1.0, 0.0]).unwrap();
        assert!((contact.t - 2.0).abs() < NEAR);
        assert_near(contact.normal, [0.0, 1.0, 0.0]);
    }

    #[test]
    fn a_torus_is_met_at_its_tube_and_not_in_its_hole() {
        let torus = Torus { major: 2.0, minor: 0.5, ..Torus::default() };
        let transform = Transform::from_steps([1.0; 3], [90.0, 0.0, 0.0], [0.0; 3]);
        let curved = Curved::new(&Shape::Torus(torus), transform).unwrap();
        // Its axis is z now. Along z through the middle of the tube, and through the hole.
        let contact = curved.first_contact([2.0, 0.0, 9.0], [0.0, 0.0, -1.0]).unwrap();
        assert!((contact.t - 8.5).abs() < NEAR);
        assert_near(contact.normal, [0.0, 0.0, 1.0]);
        assert!(curved.first_contact([0.0, 0.0, 9.0], [0.0, 0.0, -1.0]).is_none());
        // Along x: four contacts, the first of them outside.
        let contact = curved.first_contact([-9.0, 0.0, 0.0], [1.0, 0.0, 0.0]).unwrap();
        assert!((contact.t - 6.5).abs() < NEAR);
        assert_near(contact.normal, [-1.0, 0.0, 0.0]);
        // From within the hole: the inner side of the tube.
        let contact = curved.first_contact([0.0; 3], [1.0, 0.0, 0.0]).unwrap();
        assert!((contact.t - 1.5).abs() < NEAR);
        assert_near(contact.normal, [-1.0, 0.0, 0.0]);
    }

    #[test]
    fn other_shapes_and_flattened_ones_have_no_surface_here() {
        let flat = Transform::from_steps([1.0, 0.0, 1.0], [0.0; 3], [0.0; 3]);
        assert!(Curved::new(&Shape::Torus(Torus::default()), flat).is_none());
        let cone = Shape::Cone(crate::scene::shapes::Cone::default());
        let still = Transform::from_steps([1.0; 3], [0.0; 3], [0.0; 3]);
        assert!(Curved::new(&cone, still).is_none());
    }
}
