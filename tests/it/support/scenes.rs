//! The standard camera and the shapes of the hard cases.

use truecast::pixel::Resolution;
use truecast::scene::Scene;
use truecast::scene::camera::PinholeCamera;

/// Three corners.
pub(crate) type Triangle = [[f32; 3]; 3];

/// The standard camera G(f): 17 × 17 pixels of side 1 at distance `f` along z, eye at the origin.
/// Pixel (8, 8) looks along (0, 0, f), pixel (i, j) along (i − 8, j − 8, f).
pub(crate) fn standard_camera(f: f64) -> PinholeCamera {
    scaled_camera(f, 1.0)
}

/// [`standard_camera`] with all directions multiplied by `scale`, a power of two.
pub(crate) fn scaled_camera(f: f64, scale: f64) -> PinholeCamera {
    let frame = Resolution::new(17, 17).unwrap();
    let d0 = [-8.5, -8.5, f].map(|c| c * scale);
    let camera =
        PinholeCamera::exact(frame, [0.0; 3], d0, [scale, 0.0, 0.0], [0.0, scale, 0.0]).unwrap();
    assert_eq!(camera.d0(), d0, "lies on the lattice");
    camera
}

/// A camera of one pixel whose sample looks along `direction` (components about 1), which may be
/// moved by the lattice by 2^-52 at most and is kept when it holds f32 numbers.
pub(crate) fn single_ray_camera(eye: [f64; 3], direction: [f64; 3]) -> PinholeCamera {
    let half_pixel = 2.0_f64.powi(-11);
    let d0 = [direction[0] - half_pixel, direction[1] - half_pixel, direction[2]];
    let (dx, dy) = ([2.0 * half_pixel, 0.0, 0.0], [0.0, 2.0 * half_pixel, 0.0]);
    PinholeCamera::exact(Resolution::new(1, 1).unwrap(), eye, d0, dx, dy).unwrap()
}

/// A camera of one pixel whose sample looks from `eye` along `direction`, exactly.
pub(crate) fn single_ray(eye: [f64; 3], direction: [f64; 3]) -> PinholeCamera {
    let largest = direction.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
    let step = 2.0_f64.powi(largest.log2().floor() as i32 - 2);
    // The steps span the plane across the largest component.
    let along = (0..3).find(|&k| direction[k].abs() == largest).unwrap();
    let axis = |k: usize| std::array::from_fn(|i| if i == k % 3 { step } else { 0.0 });
    let (dx, dy): ([f64; 3], [f64; 3]) = (axis(along + 1), axis(along + 2));
    let d0 = std::array::from_fn(|k| direction[k] - 0.5 * dx[k] - 0.5 * dy[k]);
    let camera = PinholeCamera::exact(Resolution::new(1, 1).unwrap(), eye, d0, dx, dy).unwrap();
    let exact: [f64; 3] =
        std::array::from_fn(|k| camera.d0()[k] + 0.5 * camera.dx()[k] + 0.5 * camera.dy()[k]);
    assert_eq!(exact, direction, "the camera keeps the direction");
    camera
}

/// Triangles seen by G(8).
pub(crate) fn standard_scene(triangles: &[Triangle]) -> Scene {
    Scene::from_triangles(standard_camera(8.0), triangles)
}

/// `count` triangles around the hub (0, 0, 4), rim radius 4.
pub(crate) fn fan(count: u32) -> Vec<Triangle> {
    let rim = |k: u32| {
        let angle = std::f64::consts::TAU * f64::from(k) / f64::from(count);
        [(4.0 * angle.cos()) as f32, (4.0 * angle.sin()) as f32, 4.0]
    };
    (0..count).map(|k| [[0.0, 0.0, 4.0], rim(k), rim((k + 1) % count)]).collect()
}

/// Two triangles that make a rectangle in the plane z, corners at (x0, y0) and (x1, y1).
pub(crate) fn rectangle([x0, y0]: [f32; 2], [x1, y1]: [f32; 2], z: f32) -> [Triangle; 2] {
    [[[x0, y0, z], [x1, y0, z], [x0, y1, z]], [[x1, y0, z], [x1, y1, z], [x0, y1, z]]]
}

/// Every component of every corner multiplied by `factor`.
pub(crate) fn scaled(triangles: &[Triangle], factor: f32) -> Vec<Triangle> {
    triangles.iter().map(|triangle| triangle.map(|v| v.map(|c| c * factor))).collect()
}

/// G(f) with `side` × `side` pixels (odd): the middle pixel looks along (0, 0, f).
pub(crate) fn grid_camera(side: u32, f: f64) -> PinholeCamera {
    let corner = -f64::from(side) / 2.0;
    let frame = Resolution::new(side, side).unwrap();
    let (dx, dy) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
    PinholeCamera::exact(frame, [0.0; 3], [corner, corner, f], dx, dy).unwrap()
}

/// Squares of `cell` pixels that fill the frame of `grid_camera(side, z)`, all vertices exactly on
/// pixel centres, two triangles each, at depth `z`.
pub(crate) fn pixel_grid(side: u32, cell: u32, z: f32) -> Vec<Triangle> {
    let half = (side / 2) as i32;
    let cell = cell as i32;
    let starts = || (-half..half).step_by(cell as usize);
    starts()
        .flat_map(|y| starts().map(move |x| [x, y]))
        .flat_map(|[x, y]| {
            rectangle([x, y].map(|c| c as f32), [x + cell, y + cell].map(|c| c as f32), z)
        })
        .collect()
}

/// The triangles of a scene, in the order of ids.
pub(crate) fn triangles_of(scene: &Scene) -> Vec<Triangle> {
    scene.mesh.ids().map(|id| scene.mesh.triangle(id)).collect()
}

/// The T-vertex M of [`T_JUNCTION`]: rounding puts it 5.46e-9 below the edge from A to B.
pub(crate) const T_VERTEX: [f32; 3] = [0.3, 0.1, 1.0];
const A: [f32; 3] = [0.0, 0.0, 1.0];
const B: [f32; 3] = [1.0, 1.0 / 3.0, 1.0];
/// One triangle on the far side of AB, two on the near side that meet in M: a mesh with a gap.
pub(crate) const T_JUNCTION: [Triangle; 3] =
    [[A, B, [0.0, 1.0, 1.0]], [A, [1.0, -1.0, 1.0], T_VERTEX], [T_VERTEX, [1.0, -1.0, 1.0], B]];
/// The sliver that closes the gap.
pub(crate) const T_SLIVER: Triangle = [A, T_VERTEX, B];

/// A small pseudo-random sequence in [0, 1).
pub(crate) struct Sequence(pub(crate) u64);

impl Sequence {
    pub(crate) fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// An integer in 0…count − 1.
    pub(crate) fn below(&mut self, count: usize) -> usize {
        (self.next() * count as f64) as usize
    }

    /// A multiple of 2^-22.
    pub(crate) fn step(&mut self) -> f64 {
        (self.next() * f64::from(1 << 22)).floor() / f64::from(1 << 22)
    }
}
