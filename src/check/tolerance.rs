//! Every tolerance of the cross-check, named, with its unit and reason.
//!
//! Ids, facing, cover and signed counts, and tie marks have none: they are equal or they differ.
//! Depth has none either: both paths give certain intervals, and certain intervals of one number
//! overlap.

use crate::color::LinearRgb;

/// Largest relative difference of a corner weight, dimensionless. Each path promises a few 2^-50
/// per weight; 2^-46 leaves eight times that for either.
pub const BARYCENTRIC_RELATIVE: f64 = 1.0 / (1_u64 << 46) as f64;

/// Smallest corner weight that is compared relatively. Below it a weight moves the surface point
/// by less than one f64 rounding of a position, and 2^-46 of this floor is compared instead.
pub const BARYCENTRIC_FLOOR: f64 = 1.0 / (1_u64 << 60) as f64;

/// Scale of the radiance tolerance, linear light. A weight error of 2^-46 moves the surface point
/// and the normal by about 1e-14 relative; the sharpest term, (N·H)^ns, multiplies that by at most
/// √ns/√e, and steep attenuation or a nearby light by a few powers of ten. 1e-9 covers both and is
/// a hundredth of an f32 rounding step.
pub const RADIANCE: f64 = 1e-9;

/// Whether two weights agree.
pub fn weights_agree(a: f64, b: f64) -> bool {
    let scale = a.abs().max(b.abs()).max(BARYCENTRIC_FLOOR);
    (a - b).abs() <= BARYCENTRIC_RELATIVE * scale
}

/// Largest difference of a channel that is tolerated between radiance `a` and `b` on a surface of
/// specular exponent `ns`: 1e-9 · (1 + |I|) · (1 + √ns).
pub fn radiance_bound(a: f64, b: f64, ns: f64) -> f64 {
    RADIANCE * (1.0 + a.abs().max(b.abs())) * (1.0 + ns.sqrt())
}

/// Largest difference over the channels, and whether every channel is within its bound. Equal
/// infinities, which colours beyond f64 make, differ by 0; NaN is never within a bound.
pub fn compare_radiance(a: LinearRgb, b: LinearRgb, ns: f64) -> (f64, bool) {
    let mut largest = 0.0_f64;
    let mut within = true;
    for k in 0..3 {
        let difference = if a[k] == b[k] { 0.0 } else { (a[k] - b[k]).abs() };
        // An infinite difference is none that an infinite bound could tolerate.
        within &= difference.is_finite() && difference <= radiance_bound(a[k], b[k], ns);
        largest = if difference.is_nan() { f64::NAN } else { largest.max(difference) };
    }
    (largest, within)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tolerance_ends_where_it_says() {
        assert!(weights_agree(0.5, 0.5 + 0.5 * BARYCENTRIC_RELATIVE));
        assert!(!weights_agree(0.5, 0.5 + 1.1 * BARYCENTRIC_RELATIVE));
        assert!(weights_agree(0.0, BARYCENTRIC_FLOOR * BARYCENTRIC_RELATIVE));
        assert!(!weights_agree(1e-9, 1.001e-9));
        assert!(compare_radiance([1.0; 3], [1.0 + 1.9e-9; 3], 0.0).1);
        assert!(!compare_radiance([1.0; 3], [1.0 + 2.1e-9; 3], 0.0).1);
        assert!(!compare_radiance([f64::NAN; 3], [f64::NAN; 3], 0.0).1);
        assert_eq!(compare_radiance([f64::INFINITY; 3], [f64::INFINITY; 3], 0.0), (0.0, true));
        assert!(!compare_radiance([f64::INFINITY; 3], [1.0; 3], 0.0).1);
    }
}
