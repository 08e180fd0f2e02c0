//! H88: sides, and what they add up to on closed meshes.

use super::same_place;
use crate::scale::cover;
use crate::support::closed::{integer_chaos, sphere};
use crate::support::configurations::{Breadth, NARROW, agreed_within};
use crate::support::rays::{closed_box, torus};
use crate::support::scenes::{Triangle, standard_scene};
use truecast::pixel::Resolution;
use truecast::scene::Scene;
use truecast::scene::camera::PinholeCamera;
use truecast::visibility::Facing;

/// det(a_0, a_1, a_2) of corners that are multiples of ¼, times 64, seen from the origin.
fn volume(triangle: &Triangle) -> i64 {
    let [a, b, c] = triangle.map(|v| v.map(|c| (4.0 * c) as i64));
    a[0] * (b[1] * c[2] - b[2] * c[1])
        + a[1] * (b[2] * c[0] - b[0] * c[2])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
}

/// Facing is −sgn V, by whole numbers; what a culling renderer shows is the picture of the front
/// faces alone, and the nearer of front and back is the whole picture. (There is no culling to
/// switch on: visibility does not depend on facing.)
#[test]
fn h88_facing() {
    for seed in 0..20 {
        let triangles: Vec<Triangle> = integer_chaos(seed)
            .iter()
            .map(|t| t.map(|[x, y, z]| [x, y, z + 2.0 + (seed % 4) as f32]))
            .collect();
        let name = format!("chaos {seed}");
        let whole = agreed_within(&standard_scene(&triangles), &NARROW, &name);
        for visible in whole.visible.iter().flatten() {
            let v = volume(&triangles[visible.triangle.index()]);
            assert_eq!(i64::from(visible.facing.sign()), -v.signum(), "{name}");
        }
        // Triangles out of the way keep the numbers of the others.
        let only = |side: i64| -> Vec<Triangle> {
            let away = [[0.0, 0.0, -1.0]; 3];
            triangles.iter().map(|t| if volume(t).signum() == side { *t } else { away }).collect()
        };
        let [front, back] =
            [-1, 1].map(|side| agreed_within(&standard_scene(&only(side)), &NARROW, &name));
        assert!(front.visible.iter().flatten().all(|v| v.facing == Facing::Front), "{name}");
        assert!(back.visible.iter().flatten().all(|v| v.facing == Facing::Back), "{name}");
        for (index, visible) in whole.visible.iter().enumerate() {
            let halves = [front.visible[index], back.visible[index]];
            let counts = [&front, &back].map(|half| cover(half, index));
            let all = cover(&whole, index);
            assert_eq!(all.crossed, counts[0].crossed + counts[1].crossed, "{name}");
            assert_eq!(all.signed, counts[1].crossed as i32 - counts[0].crossed as i32, "{name}");
            match visible {
                None => assert_eq!(halves, [None, None], "{name}"),
                Some(v) => {
                    let [same, other] = match v.facing {
                        Facing::Front => halves,
                        Facing::Back => [halves[1], halves[0]],
                    };
                    assert_eq!(same.as_ref().map(same_place), Some(same_place(v)), "{name}");
                    assert!(other.is_none_or(|other| v.t_lo <= other.t_hi), "{name}");
                }
            }
        }
    }
}

/// An eye and the winding number of a closed mesh about it.
type Winding = ([f64; 3], i32);

/// The signed count of a closed mesh is the winding number of the eye, at every sample.
#[test]
fn h88_signed_count_of_closed_meshes() {
    let look = |eye: [f64; 3], target: [f64; 3]| {
        let frame = Resolution::new(41, 31).unwrap();
        PinholeCamera::look_at(frame, eye, target, [0.1, 0.2, 1.0], 100.0).unwrap()
    };
    let twice = |mut triangles: Vec<Triangle>| {
        // A second sheet inside the first, both outwards: an eye inside both winds twice.
        let inner: Vec<Triangle> =
            triangles.iter().map(|t| t.map(|v| v.map(|c| c * 0.5))).collect();
        triangles.extend(inner);
        triangles
    };
    let meshes: [(&str, Vec<Triangle>, Vec<Winding>); 5] = [
        (
            "sphere",
            sphere(16, 32, 2.0, [0.0; 3]),
            vec![([0.3, 0.1, -0.2], 1), ([0.0, 0.0, 1.5], 1), ([3.0, 1.0, 0.5], 0)],
        ),
        (
            "torus",
            torus(32, 16, 3.0, 1.0),
            vec![
                ([3.0, 0.0, 0.25], 1),
                ([0.0; 3], 0),
                ([0.5, -0.5, 4.0], 0),
                ([0.0, -7.0, 0.0], 0),
            ],
        ),
        (
            "box",
            closed_box([-1.0, -2.0, -1.5], [1.0, 2.0, 1.5]),
            vec![([0.0; 3], 1), ([0.5, -1.5, 1.0], 1), ([3.0, 0.0, 0.0], 0), ([1.0, 5.0, 1.5], 0)],
        ),
        (
            "two boxes",
            twice(closed_box([-2.0; 3], [2.0; 3])),
            vec![([0.0; 3], 2), ([1.5, 0.0, 0.0], 1), ([4.0, 1.0, 1.0], 0)],
        ),
        (
            "two spheres",
            twice(sphere(12, 24, 2.0, [0.0; 3])),
            vec![([0.1, 0.0, 0.0], 2), ([0.0, 1.5, 0.0], 1), ([0.0, 0.0, 4.0], 0)],
        ),
    ];
    for (name, triangles, eyes) in meshes {
        for (eye, winding) in eyes {
            // Towards a face, an edge and a vertex of the mesh, and along the axes.
            let corner = triangles[triangles.len() / 3][0].map(f64::from);
            for target in [corner, [0.0, 0.0, 9.0], [9.0, 0.5, 0.0], [-4.0, -5.0, -6.0]] {
                let scene = Scene::from_triangles(look(eye, target), &triangles);
                let breadth = Breadth { audited_pixels: 20, ..NARROW };
                let buffer = agreed_within(&scene, &breadth, name);
                let counts = buffer.cover.as_ref().unwrap();
                assert!(counts.iter().all(|c| c.signed == winding), "{name} from {eye:?}");
                assert!(winding == 0 || buffer.covered_pixels() == counts.len(), "no hole");
            }
        }
    }
}
