//! Closed meshes: what an eye off their surface sees has one signed count, its winding number.

use super::scenes::Triangle;
use truecast::pixel::Resolution;
use truecast::scene::camera::PinholeCamera;

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

/// Whether a closed triangle of small integers contains a point of small quarters.
pub(crate) fn contains(triangle: &[[f32; 3]; 3], point: [f64; 3]) -> bool {
    let a = triangle.map(|v| -> [i64; 3] {
        std::array::from_fn(|k| (4.0 * (f64::from(v[k]) - point[k])) as i64)
    });
    let dot = |p: [i64; 3], q: [i64; 3]| p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
    let cross = |p: [i64; 3], q: [i64; 3]| {
        [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]
    };
    let c = [cross(a[1], a[2]), cross(a[2], a[0]), cross(a[0], a[1])];
    let normal: [i64; 3] = std::array::from_fn(|k| c[0][k] + c[1][k] + c[2][k]);
    if normal == [0; 3] {
        // Collinear corners: on one of the three segments.
        return [(0, 1), (1, 2), (2, 0)]
            .iter()
            .any(|&(i, j)| cross(a[i], a[j]) == [0; 3] && dot(a[i], a[j]) <= 0);
    }
    dot(a[0], c[0]) == 0 && c.iter().all(|&c| dot(c, normal) >= 0)
}

/// A UV sphere about `center`, closed, counter-clockwise from outside.
pub(crate) fn sphere(rings: u32, segments: u32, radius: f64, center: [f64; 3]) -> Vec<Triangle> {
    let vertex = |ring: u32, segment: u32| -> [f32; 3] {
        let polar = std::f64::consts::PI * f64::from(ring) / f64::from(rings);
        let around = std::f64::consts::TAU * f64::from(segment % segments) / f64::from(segments);
        let direction = if ring == 0 || ring == rings {
            [0.0, 0.0, if ring == 0 { 1.0 } else { -1.0 }]
        } else {
            [polar.sin() * around.cos(), polar.sin() * around.sin(), polar.cos()]
        };
        // On multiples of 2^-24, so that differences keep a camera's lattice.
        let grid = f64::from(1 << 24);
        std::array::from_fn(|k| {
            (((center[k] + radius * direction[k]) * grid).round() / grid) as f32
        })
    };
    let mut triangles = Vec::new();
    for ring in 0..rings {
        for segment in 0..segments {
            let [a, b] = [vertex(ring, segment), vertex(ring, segment + 1)];
            let [c, d] = [vertex(ring + 1, segment), vertex(ring + 1, segment + 1)];
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

/// A star-shaped shell of radius about 2 around the eye at the origin, made for the six cameras of
/// [`shell_camera`]: every one of their samples meets a vertex, an edge or a diagonal exactly.
///
/// The corners of a cube's grid of `2·half` × `2·half` steps, every second one, each moved along
/// its ray: t has 12 bits and the integer direction at most 12, so t·d is exact in f32, and the
/// image of an edge is the line between grid points that it was on the cube.
pub(crate) fn aimed_shell(half: i32) -> Vec<Triangle> {
    assert!(half % 2 == 0 && half < 2048);
    let corner = |direction: [i32; 3]| -> [f32; 3] {
        let length = direction.iter().map(|&c| f64::from(c * c)).sum::<f64>().sqrt();
        // The largest power of two that leaves t 12 bits.
        let unit = 2.0_f64.powi((2.0 / length).log2().floor() as i32 - 11);
        let t = (2.0 / length / unit).round() * unit;
        direction.map(|c| (t * f64::from(c)) as f32)
    };
    let mut triangles = Vec::new();
    for face in 0..6 {
        let (along, side) = (face % 3, if face < 3 { half } else { -half });
        for u in (-half..half).step_by(2) {
            for v in (-half..half).step_by(2) {
                let at = |u: i32, v: i32| {
                    let mut direction = [0; 3];
                    direction[along] = side;
                    direction[(along + 1) % 3] = u;
                    direction[(along + 2) % 3] = v;
                    corner(direction)
                };
                let [a, b, c, d] = [at(u, v), at(u + 2, v), at(u + 2, v + 2), at(u, v + 2)];
                // Counter-clockwise from outside: u, v and the positive axis are right-handed.
                let pair = if side > 0 { [[a, b, c], [a, c, d]] } else { [[a, c, b], [a, d, c]] };
                triangles.extend(pair);
            }
        }
    }
    triangles
}

/// The camera that looks at one face of [`aimed_shell`], sample by sample at its grid points.
pub(crate) fn shell_camera(half: i32, face: usize) -> PinholeCamera {
    let (along, side) = (face % 3, if face < 3 { half } else { -half });
    let axis = |k: usize| std::array::from_fn(|i| if i == k % 3 { 1.0 } else { 0.0 });
    let mut d0 = [-f64::from(half) - 0.5; 3];
    d0[along] = f64::from(side);
    let frame = Resolution::new(2 * half as u32 + 1, 2 * half as u32 + 1).unwrap();
    let camera =
        PinholeCamera::exact(frame, [0.0; 3], d0, axis(along + 1), axis(along + 2)).unwrap();
    assert_eq!(camera.d0(), d0, "lies on the lattice");
    camera
}
