//! Bicubic Bézier patches: points and normals by Bernstein polynomials.
//!
//! At 0 and 1 the polynomials are exactly 0 and 1, so patches that share an edge's control points
//! share its points bit for bit. No subdivision, no adaptivity.

/// Control points, `[row along u][column along v]`.
pub(super) type Patch = [[[f64; 3]; 4]; 4];

/// The cubic Bernstein polynomials at t.
fn weights(t: f64) -> [f64; 4] {
    let s = 1.0 - t;
    [s * s * s, 3.0 * (s * s) * t, 3.0 * s * (t * t), t * t * t]
}

/// Their derivatives at t.
fn slopes(t: f64) -> [f64; 4] {
    let s = 1.0 - t;
    let inner = 3.0 * s * (s - 2.0 * t);
    let outer = 3.0 * t * (2.0 * s - t);
    [-3.0 * (s * s), inner, outer, 3.0 * (t * t)]
}

/// The sum of control points with weights `along_u` × `along_v`; no component is a negative zero.
fn blend(patch: &Patch, along_u: [f64; 4], along_v: [f64; 4]) -> [f64; 3] {
    let mix = |points: &[[f64; 3]; 4], weights: [f64; 4]| {
        [0, 1, 2].map(|axis| {
            let [a, b, c, d] = [0, 1, 2, 3].map(|k: usize| weights[k] * points[k][axis]);
            (a + b) + (c + d) + 0.0
        })
    };
    // Along u first: a column's curve then depends on that column alone.
    let columns = [0, 1, 2, 3].map(|column: usize| mix(&patch.map(|row| row[column]), along_u));
    mix(&columns, along_v)
}

/// The point at (u, v), each 0…1.
pub(super) fn point(patch: &Patch, u: f64, v: f64) -> [f64; 3] {
    blend(patch, weights(u), weights(v))
}

/// The unit normal at (u, v), each 0…1: the side from which u runs down and v to the right,
/// ∂u × ∂v made unit.
///
/// Where the edge u = 0 or u = 1 shrinks to a point, ∂v vanishes. Beside it ∂v = u · ∂u∂v, or
/// (u − 1) · ∂u∂v, to first order, so the limit of the direction is that of ∂u × ±∂u∂v.
pub(super) fn normal(patch: &Patch, u: f64, v: f64) -> [f64; 3] {
    let along_u = blend(patch, slopes(u), weights(v));
    let is_point = |row: usize| patch[row].iter().all(|point| *point == patch[row][0]);
    // The control points decide: a derivative that should vanish is off by a rounding at some v.
    let along_v = if u == 0.0 && is_point(0) {
        blend(patch, slopes(u), slopes(v))
    } else if u == 1.0 && is_point(3) {
        blend(patch, slopes(u), slopes(v)).map(|c| -c)
    } else {
        blend(patch, weights(u), slopes(v))
    };
    let [a, b] = [along_u, along_v];
    let n = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    let length = (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt();
    n.map(|c| c / length + 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A patch with no symmetry: x and y run with the columns and rows, z = x³ + 2y³ + 3xy through
    /// its blossom, so that every derivative is known.
    fn polynomial() -> Patch {
        let at = |row: usize, column: usize| {
            let (x, y) = (column as f64 / 3.0, row as f64 / 3.0);
            let cube = |k: usize| if k == 3 { 1.0 } else { 0.0 };
            [x, y, cube(column) + 2.0 * cube(row) + 3.0 * x * y]
        };
        [0, 1, 2, 3].map(|row| [0, 1, 2, 3].map(|column| at(row, column)))
    }

    #[test]
    fn a_patch_reproduces_a_polynomial_and_its_normal() {
        // Values up to 6 from sums of 16 products of three roundings each.
        const BOUND: f64 = 64.0 * f64::EPSILON;
        for (u, v) in [(0.0, 0.0), (0.3, 0.8), (1.0, 0.25), (0.6, 1.0), (1.0, 1.0)] {
            let p = point(&polynomial(), u, v);
            let z = v * v * v + 2.0 * u * u * u + 3.0 * u * v;
            for (value, expected) in p.into_iter().zip([v, u, z]) {
                assert!((value - expected).abs() <= BOUND);
            }
            // ∂u × ∂v = (0, 1, zu) × (1, 0, zv) = (zv, zu, −1).
            let expected = [3.0 * v * v + 3.0 * u, 6.0 * u * u + 3.0 * v, -1.0];
            let length = expected.iter().map(|c| c * c).sum::<f64>().sqrt();
            let n = normal(&polynomial(), u, v);
            for (value, expected) in n.into_iter().zip(expected) {
                assert!((value - expected / length).abs() <= BOUND);
            }
        }
    }
}
