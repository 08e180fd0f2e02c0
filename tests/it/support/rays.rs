//! A fixed sequence of numbers, lattice rounding, and closed surfaces to aim at.
//!
//! No expectation lives here.

use super::scenes::Triangle;

/// The nearest multiple of 2^-50, which the lattice of a camera of size 1 keeps.
pub(crate) fn on_lattice(value: f64) -> f64 {
    (value * 2.0_f64.powi(50)).round() * 2.0_f64.powi(-50)
}

/// A reproducible sequence: Steele, Lea and Flood, "Fast splittable pseudorandom number
/// generators" (2014).
pub(crate) struct Random(pub(crate) u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A multiple of 2^-53 in [0, 1).
    pub(crate) fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A multiple of 2^-22 in [0, 1).
    pub(crate) fn step(&mut self) -> f64 {
        (self.bits() >> 42) as f64 / f64::from(1 << 22)
    }

    /// A whole number in 0..count.
    pub(crate) fn below(&mut self, count: usize) -> usize {
        ((u128::from(self.bits()) * count as u128) >> 64) as usize
    }

    /// A whole number in −reach..=reach.
    pub(crate) fn integer(&mut self, reach: i32) -> f32 {
        (self.below(2 * reach as usize + 1) as i32 - reach) as f32
    }

    /// The list in a random order.
    pub(crate) fn shuffle<T>(&mut self, list: &mut [T]) {
        for last in (1..list.len()).rev() {
            list.swap(last, self.below(last + 1));
        }
    }
}

/// An upright torus about the z axis through the origin, closed, counter-clockwise from outside.
pub(crate) fn torus(around: u32, across: u32, major: f64, minor: f64) -> Vec<Triangle> {
    let corner = |i: u32, j: u32| -> [f32; 3] {
        let turn = |n: u32, of: u32| std::f64::consts::TAU * f64::from(n % of) / f64::from(of);
        let (u, v) = (turn(i, around), turn(j, across));
        let reach = major + minor * v.cos();
        [reach * u.cos(), reach * u.sin(), minor * v.sin()].map(|c| c as f32)
    };
    let mut triangles = Vec::new();
    for i in 0..around {
        for j in 0..across {
            let [a, b] = [corner(i, j), corner(i + 1, j)];
            let [c, d] = [corner(i + 1, j + 1), corner(i, j + 1)];
            triangles.push([a, b, c]);
            triangles.push([a, c, d]);
        }
    }
    triangles
}

/// The axis-aligned box from `lo` to `hi`, counter-clockwise from outside.
pub(crate) fn closed_box(lo: [f32; 3], hi: [f32; 3]) -> Vec<Triangle> {
    let corner =
        |bits: usize| std::array::from_fn(|k| if bits >> k & 1 == 1 { hi[k] } else { lo[k] });
    // Each face by its four corners, bit k of a number choosing the side along axis k.
    [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
        .into_iter()
        .flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]])
        .map(|face| face.map(corner))
        .collect()
}
