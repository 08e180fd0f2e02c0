//! Rays aimed exactly, a fixed sequence of numbers, and spheres to aim at.
//!
//! No expectation lives here.

use super::scenes::Triangle;
use truecast::pixel::Resolution;
use truecast::scene::camera::PinholeCamera;

/// A camera of one pixel whose sample looks from `eye` along `direction`, bit for bit.
pub(crate) fn exact_ray_camera(eye: [f64; 3], direction: [f64; 3]) -> PinholeCamera {
    let largest = direction.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
    let step = 2.0_f64.powi(largest.log2().floor() as i32 - 2);
    // The steps span the plane across the largest component.
    let along = (0..3).find(|&k| direction[k].abs() == largest).unwrap();
    let axis = |k: usize| std::array::from_fn(|i| if i == k % 3 { step } else { 0.0 });
    let (dx, dy): ([f64; 3], [f64; 3]) = (axis(along + 1), axis(along + 2));
    let d0 = std::array::from_fn(|k| direction[k] - 0.5 * dx[k] - 0.5 * dy[k]);
    let camera = PinholeCamera::exact(Resolution::new(1, 1).unwrap(), eye, d0, dx, dy).unwrap();
    let sample: [f64; 3] =
        std::array::from_fn(|k| camera.d0()[k] + 0.5 * camera.dx()[k] + 0.5 * camera.dy()[k]);
    assert_eq!(sample, direction, "the camera keeps the direction");
    camera
}

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

/// A UV sphere about `center`, closed, counter-clockwise from outside, its corners on multiples of
/// 2^-24 so that differences keep a camera's lattice.
pub(crate) fn sphere(rings: u32, segments: u32, radius: f64, center: [f64; 3]) -> Vec<Triangle> {
    let corner = |ring: u32, segment: u32| -> [f32; 3] {
        let polar = std::f64::consts::PI * f64::from(ring) / f64::from(rings);
        let around = std::f64::consts::TAU * f64::from(segment % segments) / f64::from(segments);
        let direction = if ring == 0 || ring == rings {
            [0.0, 0.0, if ring == 0 { 1.0 } else { -1.0 }]
        } else {
            [polar.sin() * around.cos(), polar.sin() * around.sin(), polar.cos()]
        };
        let grid = f64::from(1 << 24);
        std::array::from_fn(|k| {
            (((center[k] + radius * direction[k]) * grid).round() / grid) as f32
        })
    };
    let mut triangles = Vec::new();
    for ring in 0..rings {
        for segment in 0..segments {
            let [a, b] = [corner(ring, segment), corner(ring, segment + 1)];
            let [c, d] = [corner(ring + 1, segment), corner(ring + 1, segment + 1)];
            if ring > 0 {
                triangles.push([a, c, b]);
            }
            if ring + 1 < rings {
                triangles.push([b, c, d]);
            }
        }
    }
    triangles
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
