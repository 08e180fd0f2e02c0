//! Mirror reflection, Phong's own lobe and the BRDF form: the older and the newer way of writing
//! the specular term.
//!
//! Pure functions for comparison and plots; the equation that shades pictures is in `equation`.
//! Sources: Phong, "Illumination for Computer Generated Pictures" (1975); Curless, "Shading".

use super::blinn_phong;
use super::vector;
use crate::color::LinearRgb;

/// The ideal reflection r = 2(l·n)n − l of the unit direction `l` about the unit normal `n`; both
/// `l` and `r` point away from the surface. Unit, with r·n = l·n, in the plane of l and n.
pub fn reflect(l: [f64; 3], n: [f64; 3]) -> [f64; 3] {
    vector::sub(vector::scaled(n, 2.0 * vector::dot(l, n)), l)
}

/// Phong's lobe (R·V)_+^ns for unit vectors, ns ≥ 0. Not gated by N·L.
///
/// By q = |V − R|²/2, so that it cannot exceed 1.
pub fn phong_specular(n: [f64; 3], l: [f64; 3], v: [f64; 3], ns: f64) -> f64 {
    blinn_phong::lobe(blinn_phong::one_minus_cosine(v, reflect(l, n)), ns)
}

/// The BRDF f_r(ω_in, ω_out) = kd + ks (N·H)_+^ns: radiance is I · B · (N·L) · f_r.
///
/// Reciprocal bit for bit: the two directions enter only through their sum.
pub fn brdf(
    kd: LinearRgb,
    ks: LinearRgb,
    ns: f64,
    n: [f64; 3],
    incoming: [f64; 3],
    outgoing: [f64; 3],
) -> LinearRgb {
    let specular = blinn_phong::blinn_specular(n, incoming, outgoing, ns);
    std::array::from_fn(|channel| kd[channel] + ks[channel] * specular)
}
