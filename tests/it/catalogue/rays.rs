//! H14 to H16: closed meshes, and rays aimed at their vertices and edges. Random rays test
//! nothing: no kernel misses them.

use super::{assert_covered_once, one_signed_count};
use crate::support::closed::{aimed_shell, contains, integer_chaos, shell_camera, sphere};
use crate::support::configurations::{agree_everywhere, agree_once};
use crate::support::scenes::{Sequence, Triangle, single_ray, standard_camera};
use crate::support::sizes;
use truecast::accel::{Accelerator, BuildPreset};
use truecast::cast::cast;
use truecast::pixel::Resolution;
use truecast::raster::rasterize;
use truecast::scene::Scene;
use truecast::scene::camera::PinholeCamera;
use truecast::visibility::Counting;

/// Closed meshes; of these so many as `sizes::H14` says go through all configurations, evenly
/// spread, the others through one.
const CHAOTIC_MESHES: usize = 250;

/// Whether the sample along `direction` meets an exact zero: some W of a triangle with V ≠ 0 is 0.
/// In integers: corners and eye are doubled.
fn meets_an_edge(triangles: &[Triangle], eye: [f64; 3], direction: [i64; 3]) -> bool {
    let determinant = |a: [i64; 3], b: [i64; 3], c: [i64; 3]| {
        a[0] * (b[1] * c[2] - b[2] * c[1])
            + a[1] * (b[2] * c[0] - b[0] * c[2])
            + a[2] * (b[0] * c[1] - b[1] * c[0])
    };
    triangles.iter().any(|triangle| {
        let [a, b, c] =
            triangle.map(|v| [0, 1, 2].map(|k| (2.0 * (f64::from(v[k]) - eye[k])) as i64));
        determinant(a, b, c) != 0
            && [(a, b), (b, c), (c, a)].iter().any(|&(p, q)| determinant(p, q, direction) == 0)
    })
}

#[test]
fn h14_integer_chaos() {
    let frame = Resolution::new(9, 9).unwrap();
    let mut random = Sequence(14);
    let (mut meshes, mut samples, mut on_edges, mut inside) = (0, 0, 0, 0);
    let mut seed = 0;
    while meshes < CHAOTIC_MESHES {
        seed += 1;
        let triangles = integer_chaos(seed);
        // Odd multiples of one half, up to 5/2: inside the mesh or outside of it.
        let eye = [0; 3].map(|_| random.below(6) as f64 - 2.5);
        if triangles.iter().any(|triangle| contains(triangle, eye)) {
            continue;
        }
        let d0 = [-4.5, -4.5, 2.0];
        let (dx, dy) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
        let camera = PinholeCamera::exact(frame, eye, d0, dx, dy).unwrap();
        let scene = Scene::from_triangles(camera, &triangles);
        let name = format!("chaos {seed} from {eye:?}");
        let every = CHAOTIC_MESHES / sizes::H14.running();
        let agree = if meshes % every == 0 { agree_everywhere } else { agree_once };
        let winding = one_signed_count(&name, &agree(&name, &scene));
        // The sample of pixel (i, j) looks along (i − 4, j − 4, 2).
        on_edges +=
            (0..81).filter(|i| meets_an_edge(&triangles, eye, [i % 9 - 4, i / 9 - 4, 2])).count();
        samples += 81;
        inside += usize::from(winding != 0);
        meshes += 1;
    }
    // The test means something only if samples meet edges exactly, and windings differ.
    assert!(2 * on_edges >= samples, "{on_edges} of {samples} samples lie on an edge");
    assert!(inside > 10, "{inside} eyes are wound around");
}

/// The middles of H15's spheres, and of Embree's own test far from the origin.
const CENTRES: [[f64; 3]; 2] = [[0.0; 3], [148_376.0, 1234.0, -223_423.0]];

/// What an aimed ray aims at.
#[derive(Clone, Copy, PartialEq)]
enum Target {
    Vertex,
    EdgeMiddle,
}

/// Rays from the inner unit cube of a sphere to f32(v − o), which passes a target by less than
/// half a step of f32: every one crosses the mesh exactly once net, and from near the origin,
/// where the sphere is convex as far as these rays can tell, exactly once. The rasterizer answers
/// every `raster_every`-th.
fn aim(
    [rings, segments]: [u32; 2],
    centre: [f64; 3],
    target: Target,
    rays: usize,
    raster_every: usize,
) {
    let triangles = sphere(rings, segments, 2.0, centre);
    let mut scene = Scene::from_triangles(standard_camera(8.0), &triangles);
    let accelerator = Accelerator::build(&scene.mesh, BuildPreset::Medium);
    let mut random = Sequence(15);
    for number in 0..rays {
        // 7919 is prime to the number of triangles: every triangle has its turn.
        let triangle = triangles[(number * 7919) % triangles.len()];
        let [a, b] = [triangle[number % 3], triangle[(number + 1) % 3]];
        let end = if target == Target::Vertex { a } else { b };
        let eye: [f64; 3] =
            std::array::from_fn(|k| f64::from((centre[k] + random.step() - 0.5) as f32));
        let direction = std::array::from_fn(|k| {
            f64::from(((f64::from(a[k]) + f64::from(end[k])) / 2.0 - eye[k]) as f32)
        });
        scene.camera = single_ray(eye, direction);
        let window = scene.camera.resolution().window();
        let answer = cast(&scene, &accelerator, window, Counting::All, &|| ());
        let place = format!("ray {number} from {eye:?} along {direction:?}");
        let cover = answer.cover.as_ref().unwrap()[0];
        assert!(answer.visible[0].is_some(), "a hole: {place}");
        assert_eq!(cover.signed, 1, "{place}");
        assert!(cover.crossed == 1 || centre != [0.0; 3], "{place}: {cover:?}");
        if number % raster_every == 0 {
            let raster = rasterize(&scene, window, Counting::All, &|| ());
            let id = |v: &Option<truecast::visibility::Visible>| v.map(|v| (v.triangle, v.tie));
            assert_eq!(id(&answer.visible[0]), id(&raster.visible[0]), "{place}");
            assert_eq!(answer.cover, raster.cover, "{place}");
        }
    }
}

/// Steps of half a side of the shell whose every sample goes through all configurations, and of
/// the one that goes through a single one.
const SHELLS: [i32; 2] = [12, 48];

/// The spheres' rays pass beside their targets by a rounding. The shells' are exact: every sample
/// meets a vertex or an edge, 6 × 25² of the small shell and 6 × 97² = 56 454 of the large one.
#[test]
fn h15_sphere_to_vertices() {
    for centre in CENTRES {
        aim([100, 200], centre, Target::Vertex, sizes::H15.running(), 300);
    }
    for (half, agree) in SHELLS.into_iter().zip([agree_everywhere, agree_once]) {
        let mut scene = Scene::from_triangles(shell_camera(half, 0), &aimed_shell(half));
        for face in 0..6 {
            scene.camera = shell_camera(half, face);
            let name = format!("shell of {half}, face {face}");
            let buffer = agree(&name, &scene);
            assert_covered_once(&name, &buffer);
            assert_eq!(one_signed_count(&name, &buffer), 1, "{name}");
            assert!(buffer.visible.iter().all(|v| v.unwrap().tie), "{name}: all samples are aimed");
        }
    }
}

/// The catalogue's number of rays to the middles of edges.
const EDGE_RAYS: usize = 20_000;

#[test]
fn h16_to_edge_midpoints() {
    for centre in CENTRES {
        let raster_every = EDGE_RAYS / sizes::H16.running();
        aim([16, 32], centre, Target::EdgeMiddle, EDGE_RAYS, raster_every);
    }
}
