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

/// Closed spheres of four rings of five whose corners are integers in −3…3, in no sensible place:
/// folded, pierced, with faces edge-on and without area, yet closed as a list of corners.
pub(crate) fn integer_chaos(seed: u64) -> Vec<Triangle> {
    let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1;
    let mut corner = || {
        [0; 3].map(|_| {
            // Xorshift: any fixed sequence will do.
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            (state % 7) as f32 - 3.0
        })
    };
    let poles = [corner(), corner()];
    let rings: Vec<[[f32; 3]; 5]> = (0..4).map(|_| [0; 5].map(|_| corner())).collect();
    let mut triangles = Vec::new();
    for k in 0..5 {
        let next = (k + 1) % 5;
        triangles.push([poles[0], rings[0][k], rings[0][next]]);
        for pair in rings.windows(2) {
            triangles.push([pair[0][k], pair[1][k], pair[1][next]]);
            triangles.push([pair[0][k], pair[1][next], pair[0][next]]);
        }
        triangles.push([rings[3][k], poles[1], rings[3][next]]);
    }
    triangles
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
