//! The camera as the vector kernels see it, and the bounds of their f64 arithmetic.
//!
//! With M = ±2^-k·adj(P), turned so that w > 0 before the eye and scaled so that ω = |m_w|₁ is
//! 1…2, corner i has the image X_i = M·(v_i − e) = (x·w, y·w, w). R_0 = X_1 × X_2 (and cyclically)
//! are edge rows; with S_ij = M·(v_j − v_i), N = S_20 × S_01 is the plane's row, V = X_0·N, and
//! N·(x, y, 1)/V = 1/w where the triangle covers. N and V are taken from differences, which keeps
//! small far triangles well conditioned. Source: Olano & Greer (1997).
//!
//! **Bounds.** u = 2^-53, s_i = max|v_i − e|, γ_m ≈ m·u as in `rows`, where each triangle has bounds
//! of its own; these are coarser, one number per frame and product of sizes s. Every sample has
//! 0 ≤ x < W + 64, 0 ≤ y < H + 64, the padding of the last tiles included. With
//! χ = max(|m_x|₁ + (W + 64)·ω, |m_y|₁ + (H + 64)·ω), |X_i| ≤ |m|₁·s_i component by component, so that
//! the magnitudes of a row's monomials add up to at most
//! 2·(|m_x|₁ + ω·x)·(|m_y|₁ + ω·y)·s_i·s_j ≤ 2·χ²·s_i·s_j at any sample.
//!
//! * X: an entry of M, v − e, their product and two sums round: 5.
//! * A row: X twice, product and difference: 12. Moved to a tile's origin (product, two sums) and
//!   scaled: 16. Its value, coefficients taken as they are, is off by less than
//!   γ_16·2·χ²·s_i·s_j < 33u·χ²·s_i·s_j. Values at the corners of tiles in f64: two sums more, 37u.
//! * S and N round as X and rows do, with r_ij = max|v_j − v_i| instead of s_i. Times 1/|V| (a division
//!   and a product more), 1/w is off by less than 37u·χ²·r_01·r_20/|V| for N.
//! * V: N, X, product and two sums: 20; six monomials of at most χ²·ω·r_01·r_20·s_0 each:
//!   126u·χ²·ω·r_01·r_20·s_0.
//! * w: 5, so that 6u·ω·s_i.
//!
//! `row_error` is 64u·χ² and `volume_error` 256u·χ²·ω: at least half as much again, and twice, what
//! is needed; ω, χ and s are themselves rounded, by less than 2^-48 of themselves. Fused operations
//! only leave roundings out. Nothing overflows (`image_plane`: here |X| ≤ 2^236 still, as 2^-k ≤ 1
//! where ω ≥ 1), and what underflows is far below the bounds, as s and r ≥ 2^-149 where V is certain.

use super::image_plane::ImagePlane;
use super::rows::U;

/// Pixels by which padded tiles may reach beyond the frame: the largest side of a tile.
pub(super) const PADDING: f64 = 64.0;

/// The numbers of one frame that all triangles and tiles share.
#[derive(Clone, Debug)]
pub(super) struct Frame {
    /// Rows x, y, w of M.
    pub(super) matrix: [[f64; 3]; 3],
    /// The eye.
    pub(super) eye: [f64; 3],
    /// ω: |w| is at most ω·s.
    pub(super) w_norm: f64,
    /// Times s_i·s_j: bound of an edge row's error at any sample; times r_01·r_20, of N's.
    pub(super) row_error: f64,
    /// Times r_01·r_20·s_0: bound of V's error.
    pub(super) volume_error: f64,
    /// χ²: |N| at any sample is at most 2·χ²·r_01·r_20.
    pub(super) row_magnitude: f64,
    /// Room that a screen box is given besides a share of its coordinates, in pixels.
    pub(super) box_room: f64,
    /// ±1: sgn det(P), by which the sign of V differs from that of the definition.
    pub(super) orientation: f64,
    /// t·(1/w).
    pub(super) ray_parameter: f64,
    /// 1/w for one unit of `TriangleRows::inverse_depth`: 2^k.
    pub(super) inverse_depth_unit: f64,
}

/// Least w of a triangle whose screen box is computed, in units of ω·s. With it the image of a
/// corner, of which numerator and denominator are off by 6u·χ·s and 6u·ω·s, is off by at most
/// 6u·2^10·(χ/ω + |x|) in f64.
pub(super) const FRONT: f64 = 1.0 / 1024.0;

impl Frame {
    /// Reads the image plane.
    pub(super) fn new(plane: &ImagePlane) -> Self {
        let norm = |row: &[f64; 3]| row[0].abs() + row[1].abs() + row[2].abs();
        // 2^k: the power of two below |m_w|₁ of the integer lattice (at least 1), by its exponent
        // bits; scaling by it is exact.
        let power = f64::from_bits(norm(&plane.adjugate[2]).to_bits() & (0x7ff << 52));
        let scale = plane.orientation / power;
        let matrix = plane.adjugate.map(|row| row.map(|entry| entry * scale));
        let w_norm = norm(&matrix[2]);
        let chi = [0, 1]
            .map(|axis| norm(&matrix[axis]) + (plane.extent[axis] + PADDING) * w_norm)
            .into_iter()
            .fold(0.0, f64::max);
        Self {
            matrix,
            eye: plane.eye,
            w_norm,
            row_error: 64.0 * U * chi * chi,
            volume_error: 256.0 * U * chi * chi * w_norm,
            row_magnitude: chi * chi,
            // 6u·2^10·χ/ω (see `FRONT`), doubled, and 2^-18 for coordinates of few pixels.
            box_room: chi / w_norm * (12.0 * U / FRONT) + 1.0 / f64::from(1 << 18),
            orientation: plane.orientation,
            ray_parameter: plane.ray_parameter_per_depth() * power,
            inverse_depth_unit: power,
        }
    }
}
