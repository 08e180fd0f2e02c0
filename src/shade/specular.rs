//! The specular lobe at a point, by Blinn or by Phong, with normals of any length up to 1.
//!
//! Only the cosine and its power; colours and gates are in `equation`. Sources: Phong,
//! "Illumination for Computer Generated Pictures" (1975); Blinn (1977), see `blinn_phong`.

use super::blinn_phong::{halfway, one_minus_cosine, shortened_lobe};
use super::geometry::Geometry;
use super::reflection::reflect;
use super::vector;
use crate::scene::switches::{Rules, SpecularModel};

/// The cosine of the specular lobe and its power; `None` where L = −V leaves no halfway vector.
pub(super) fn specular_lobe(
    rules: &Rules,
    geometry: &Geometry,
    to_light: [f64; 3],
    exponent: f64,
) -> Option<(f64, f64)> {
    let (q, length) = match rules.specular {
        SpecularModel::Blinn => {
            let half = halfway(to_light, geometry.to_eye)?;
            (one_minus_cosine(geometry.normal, half), geometry.normal_length)
        }
        SpecularModel::Phong if geometry.normal_length == 1.0 => {
            (one_minus_cosine(geometry.to_eye, reflect(to_light, geometry.normal)), 1.0)
        }
        // A shorter normal makes a shorter R, of at most unit length; at length 0, V·R is 0.
        SpecularModel::Phong => {
            let normal = vector::scaled(geometry.normal, geometry.normal_length);
            match vector::measure(reflect(to_light, normal)) {
                Some(mirror) => (one_minus_cosine(geometry.to_eye, mirror.unit()), mirror.length),
                None => (1.0, 0.0),
            }
        }
    };
    Some(((1.0 - q) * length, shortened_lobe(q, length, exponent)))
}
