//! From object space to world space: positions, normals and winding.
//!
//! A transform is p' = M·p + t in f64, without fused operations; rounding to f32 happens once, in
//! `assemble`. Normals go by the cofactor matrix of M times the sign of det M, which equals
//! |det M| · M⁻ᵀ where that exists, and is right for a flattening M of rank 2 as well.

use super::camera::unit;
use dashu_ratio::RBig;

type Matrix3 = [[f64; 3]; 3];

const IDENTITY: Matrix3 = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// A transform of one mesh.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Transform {
    linear: Matrix3,
    translation: [f64; 3],
    normals: Matrix3,
    /// Exact sign of the determinant: −1 mirrors, 0 flattens.
    pub(crate) orientation: i32,
}

impl Transform {
    /// Scales, then rotates about x, then y, then z by right-handed angles in degrees, then moves.
    pub(crate) fn from_steps(scale: [f64; 3], rotate_deg: [f64; 3], translation: [f64; 3]) -> Self {
        let [(sx, cx), (sy, cy), (sz, cz)] = rotate_deg.map(sine_and_cosine);
        let about_x = [[1.0, 0.0, 0.0], [0.0, cx, -sx], [0.0, sx, cx]];
        let about_y = [[cy, 0.0, sy], [0.0, 1.0, 0.0], [-sy, 0.0, cy]];
        let about_z = [[cz, -sz, 0.0], [sz, cz, 0.0], [0.0, 0.0, 1.0]];
        let rotation = product(about_z, product(about_y, about_x));
        let linear = rotation.map(|row| std::array::from_fn(|k| row[k] * scale[k]));
        Self::new(linear, translation)
    }

    /// The first three rows of a 4×4 matrix for column vectors.
    pub(crate) fn from_matrix(matrix: [[f64; 4]; 4]) -> Self {
        let [a, b, c, _] = matrix;
        Self::new([a, b, c].map(|row| [row[0], row[1], row[2]]), [a[3], b[3], c[3]])
    }

    fn new(linear: Matrix3, translation: [f64; 3]) -> Self {
        let orientation = determinant_sign(linear);
        let normals = cofactors(scaled_to_one(linear));
        let normals = if orientation < 0 { normals.map(|row| row.map(|c| -c)) } else { normals };
        Self { linear, translation, normals, orientation }
    }

    /// A position in world space.
    pub(crate) fn position(&self, p: [f64; 3]) -> [f64; 3] {
        let [x, y, z] = apply(self.linear, p);
        let [tx, ty, tz] = self.translation;
        [x + tx, y + ty, z + tz]
    }

    /// A direction in world space, not unit.
    pub(crate) fn direction(&self, v: [f64; 3]) -> [f64; 3] {
        apply(self.linear, v)
    }

    /// A normal transformed like a direction, made unit; `None` where the transform leaves none.
    pub(crate) fn naive_normal(&self, n: [f64; 3]) -> Option<[f64; 3]> {
        unit(apply(scaled_to_one(self.linear), n))
    }

    /// A unit normal in world space; `None` where the transform leaves none.
    pub(crate) fn normal(&self, n: [f64; 3]) -> Option<[f64; 3]> {
        unit(apply(self.normals, n))
    }
}

fn apply(m: Matrix3, p: [f64; 3]) -> [f64; 3] {
    m.map(|row| row[0] * p[0] + row[1] * p[1] + row[2] * p[2])
}

fn product(a: Matrix3, b: Matrix3) -> Matrix3 {
    a.map(|row| std::array::from_fn(|k| row[0] * b[0][k] + row[1] * b[1][k] + row[2] * b[2][k]))
}

/// Sine and cosine of an angle in degrees; exact at multiples of 90°.
fn sine_and_cosine(degrees: f64) -> (f64, f64) {
    // Both the remainder and the difference from the nearest quarter turn are exact in f64.
    let turn = degrees % 360.0;
    let quarters = (turn / 90.0).round();
    let rest = (turn - 90.0 * quarters).to_radians();
    let (sine, cosine) = (libm::sin(rest), libm::cos(rest));
    match (quarters as i32).rem_euclid(4) {
        0 => (sine, cosine),
        1 => (cosine, -sine),
        2 => (-sine, -cosine),
        _ => (-cosine, sine),
    }
}

/// The matrix divided by the power of two that brings its largest entry into [½, 1): products of
/// two entries then neither overflow nor lose a normal's direction to underflow.
fn scaled_to_one(m: Matrix3) -> Matrix3 {
    let largest = m.iter().flatten().fold(0.0_f64, |l, c| l.max(c.abs()));
    if largest == 0.0 || !largest.is_finite() {
        return m;
    }
    let (_, exponent) = libm::frexp(largest);
    m.map(|row| row.map(|c| libm::scalbn(c, -exponent)))
}

fn cofactors([a, b, c]: Matrix3) -> Matrix3 {
    let cross = |u: [f64; 3], v: [f64; 3]| {
        [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
    };
    [cross(b, c), cross(c, a), cross(a, b)]
}

/// Exact sign of the determinant of the stored numbers. A matrix that overflowed counts as 1; the
/// positions that it makes are refused.
fn determinant_sign(m: Matrix3) -> i32 {
    let [a, b, c] = m.map(|row| row.map(|entry| RBig::try_from(entry).ok()));
    let (
        [Some(a0), Some(a1), Some(a2)],
        [Some(b0), Some(b1), Some(b2)],
        [Some(c0), Some(c1), Some(c2)],
    ) = (&a, &b, &c)
    else {
        return 1;
    };
    let determinant =
        a0 * (b1 * c2 - b2 * c1) + a1 * (b2 * c0 - b0 * c2) + a2 * (b0 * c1 - b1 * c0);
    match determinant.cmp(&RBig::ZERO) {
        std::cmp::Ordering::Less => -1,
        std::cmp::Ordering::Equal => 0,
        std::cmp::Ordering::Greater => 1,
    }
}

impl Default for Transform {
    fn default() -> Self {
        Self::new(IDENTITY, [0.0; 3])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rotated(rotate_deg: [f64; 3]) -> Transform {
        Transform::from_steps([1.0; 3], rotate_deg, [0.0; 3])
    }

    #[test]
    fn quarter_turns_are_exact_and_right_handed() {
        assert_eq!(rotated([90.0, 0.0, 0.0]).position([0.0, 1.0, 0.0]), [0.0, 0.0, 1.0]);
        assert_eq!(rotated([0.0, 90.0, 0.0]).position([0.0, 0.0, 1.0]), [1.0, 0.0, 0.0]);
        assert_eq!(rotated([0.0, 0.0, 90.0]).position([1.0, 0.0, 0.0]), [0.0, 1.0, 0.0]);
        assert_eq!(rotated([0.0, 0.0, -450.0]).position([1.0, 0.0, 0.0]), [0.0, -1.0, 0.0]);
        assert_eq!(rotated([0.0, 0.0, 180.0]).position([1.0, 2.0, 3.0]), [-1.0, -2.0, 3.0]);
        assert_eq!(rotated([0.0, 0.0, 720.0]), Transform::default());
    }

    #[test]
    fn scale_comes_before_x_before_y_before_z_before_translation() {
        // (1, 2, 3) scaled: (2, 6, 12); x by 90°: (2, −12, 6); y by 90°: (6, −12, −2);
        // z by 90°: (12, 6, −2); moved by (100, 200, 300).
        let transform =
            Transform::from_steps([2.0, 3.0, 4.0], [90.0, 90.0, 90.0], [100.0, 200.0, 300.0]);
        assert_eq!(transform.position([1.0, 2.0, 3.0]), [112.0, 206.0, 298.0]);
    }

    #[test]
    fn a_mirror_turns_the_normal_with_the_surface() {
        let mirror = Transform::from_steps([-1.0, 1.0, 1.0], [0.0; 3], [0.0; 3]);
        assert_eq!(mirror.orientation, -1);
        let [x, y, z] = mirror.normal([0.6, 0.0, 0.8]).unwrap();
        assert!((x + 0.6).abs() < f64::EPSILON && y == 0.0 && (z - 0.8).abs() < f64::EPSILON);
    }

    #[test]
    fn normals_stay_perpendicular_under_uneven_scale_of_any_size() {
        // The plane x + z = 0 squeezed to x + z/4 = 0 has the normal (1, 0, ¼).
        for size in [1e-200, 1e-23, 1.0, 1e13, 1e200] {
            let transform = Transform::from_steps([size, size, 4.0 * size], [0.0; 3], [0.0; 3]);
            let h = 0.5_f64.sqrt();
            let [x, y, z] = transform.normal([h, 0.0, h]).unwrap();
            let length = (1.0_f64 + 0.0625).sqrt();
            // Four roundings of numbers of at most 1.
            let bound = 4.0 * f64::EPSILON;
            assert!((x - 1.0 / length).abs() < bound && y == 0.0, "{size}: {x} {y} {z}");
            assert!((z - 0.25 / length).abs() < bound, "{size}: {x} {y} {z}");
        }
    }

    #[test]
    fn a_flattening_transform_leaves_the_normal_of_its_plane() {
        let flat = Transform::from_steps([1.0, 1.0, 0.0], [0.0; 3], [0.0; 3]);
        assert_eq!(flat.orientation, 0);
        assert_eq!(flat.normal([0.6, 0.0, 0.8]), Some([0.0, 0.0, 1.0]));
        assert_eq!(flat.normal([1.0, 0.0, 0.0]), None);
        let gone = Transform::from_steps([0.0; 3], [0.0; 3], [0.0; 3]);
        assert_eq!(gone.normal([0.0, 0.0, 1.0]), None);
    }

    #[test]
    fn the_orientation_is_exact_where_doubles_cancel() {
        // Rows (1+ε, 1, 0), (1, 1−ε, 0): the determinant is −ε², and 0 in f64.
        let e = f64::EPSILON;
        let row = |a, b, c| [a, b, c, 0.0];
        let matrix = [
            row(1.0 + e, 1.0, 0.0),
            row(1.0, 1.0 - e, 0.0),
            row(0.0, 0.0, 1.0),
            [0.0, 0.0, 0.0, 1.0],
        ];
        assert_eq!(Transform::from_matrix(matrix).orientation, -1);
    }
}
