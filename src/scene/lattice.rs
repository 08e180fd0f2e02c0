//! The lattice that makes a ray's direction exact.
//!
//! With M = max_k(|D0| + W·|DX| + H·|DY|)_k ≤ 2^E, q0 = 2^(E−53) and q1 = 2^8·q0, D0 is rounded to
//! a multiple of q0 and DX, DY to multiples of q1. Then for every x in [0, W], y in [0, H] that are
//! multiples of 2^-8, each of `x·DX`, `y·DY` and every partial sum of `D0 + x·DX + y·DY` is a
//! multiple of q0 of magnitude at most 2^53·q0, hence an f64: no operation rounds, in any order.

use crate::pixel::Resolution;
use dashu_int::IBig;

/// Sub-pixel bits of the lattice: samples may lie on the 1/256 pixel grid.
pub(crate) const SUBPIXEL_BITS: i32 = 8;

/// Vectors on a lattice, and its exponent E.
pub(super) struct Lattice {
    /// D0, DX, DY.
    pub(super) vectors: [[f64; 3]; 3],
    /// E: all samples' directions are at most 2^E in magnitude, per component.
    pub(super) exponent: i32,
}

/// Rounds `[D0, DX, DY]` (finite) to the lattice; `None` when M is not within 2^±300.
pub(super) fn put_on_lattice(resolution: Resolution, vectors: [[f64; 3]; 3]) -> Option<Lattice> {
    let m = extent(resolution, vectors);
    if !(power_of_two(-300)..=power_of_two(300)).contains(&m) {
        return None;
    }
    let mut exponent = binary_exponent(m);
    loop {
        let q0 = power_of_two(exponent - 53);
        let q1 = q0 * f64::from(1 << SUBPIXEL_BITS);
        // Division by a power of two is exact here: M/q0 < 2^54 and M > 2^-300.
        let round = |value: f64, q: f64| (value / q).round_ties_even() * q + 0.0;
        let [d0, dx, dy] = vectors;
        let rounded =
            [d0.map(|c| round(c, q0)), dx.map(|c| round(c, q1)), dy.map(|c| round(c, q1))];
        // Rounding up may pass 2^E by a few q; the sum is exact while it does not, so this
        // comparison cannot err on the accepting side.
        if extent(resolution, rounded) <= power_of_two(exponent) {
            return Some(Lattice { vectors: rounded, exponent });
        }
        exponent += 1;
    }
}

/// Largest displacement of the image by the rounding, over the corners of the frame, in pixels.
pub(super) fn deviation_pixels(
    resolution: Resolution,
    ideal: [[f64; 3]; 3],
    rounded: [[f64; 3]; 3],
) -> f64 {
    let norm = |v: [f64; 3]| v.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
    let difference: [[f64; 3]; 3] =
        std::array::from_fn(|i| std::array::from_fn(|k| rounded[i][k] - ideal[i][k]));
    let pixel = norm(rounded[1]).min(norm(rounded[2]));
    let (width, height) = (f64::from(resolution.width()), f64::from(resolution.height()));
    [(0.0, 0.0), (width, 0.0), (0.0, height), (width, height)]
        .iter()
        .map(|(x, y)| {
            norm(std::array::from_fn(|k| {
                difference[0][k] + x * difference[1][k] + y * difference[2][k]
            })) / pixel
        })
        .fold(0.0, f64::max)
}

/// Exact sign of det[a b c] for vectors on the lattice of exponent `exponent`.
pub(super) fn determinant_sign(columns: [[f64; 3]; 3], exponent: i32) -> i32 {
    let q0 = power_of_two(exponent - 53);
    let [a, b, c] = columns.map(|column| {
        column.map(|value| {
            let steps = value / q0;
            debug_assert!(steps.fract() == 0.0 && steps.abs() <= power_of_two(53));
            IBig::from(steps as i64)
        })
    });
    let determinant = &c[0] * (&a[1] * &b[2] - &a[2] * &b[1])
        + &c[1] * (&a[2] * &b[0] - &a[0] * &b[2])
        + &c[2] * (&a[0] * &b[1] - &a[1] * &b[0]);
    if determinant == IBig::ZERO {
        0
    } else if determinant > IBig::ZERO {
        1
    } else {
        -1
    }
}

/// M: the largest component of |D0| + W·|DX| + H·|DY|.
fn extent(resolution: Resolution, [d0, dx, dy]: [[f64; 3]; 3]) -> f64 {
    let (width, height) = (f64::from(resolution.width()), f64::from(resolution.height()));
    (0..3).map(|k| d0[k].abs() + width * dx[k].abs() + height * dy[k].abs()).fold(0.0, f64::max)
}

/// 2^`exponent`, exactly, down to the subnormal ones.
pub(super) fn power_of_two(exponent: i32) -> f64 {
    libm::scalbn(1.0, exponent)
}

/// The smallest E with `value ≤ 2^E`, for a normal positive value.
fn binary_exponent(value: f64) -> i32 {
    let floor = ((value.to_bits() >> 52) & 0x7ff) as i32 - 1023;
    if value == power_of_two(floor) { floor } else { floor + 1 }
}
