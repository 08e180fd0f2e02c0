//! Rays aimed at vertices, edges and box faces: random rays test nothing.

use super::*;

/// H15, H16: rays from inside a closed mesh at its vertices and edge midpoints. Each crosses the
/// mesh exactly once net (the eye's winding number), at every offset; and the tree gives what the
/// linear scan gives.
#[test]
fn h15_rays_at_vertices_and_edges_of_a_closed_sphere() {
    for center in [[0.0; 3], [148_376.0, 1234.0, -223_423.0]] {
        let triangles = sphere(16, 32, 2.0, center);
        let mut scene = Scene::from_triangles(standard_camera(8.0), &triangles);
        let accelerator = Accelerator::build(&scene.mesh, BuildPreset::Medium);
        let linear = Accelerator::linear(&scene.mesh);
        let mut random = Sequence(7);
        let mut ties = 0;
        for number in 0..4000 {
            let triangle = triangles[number % triangles.len()];
            let eye: [f64; 3] =
                std::array::from_fn(|k| f64::from((center[k] + random.step() - 0.5) as f32));
            let target: [f64; 3] = if number % 3 == 0 {
                std::array::from_fn(|k| {
                    (f64::from(triangle[0][k]) + f64::from(triangle[1][k])) * 0.5
                })
            } else {
                triangle[number % 3].map(f64::from)
            };
            // Exact through the vertex or midpoint, or rounded to f32: beside it by an ulp.
            let exact = number % 2 == 0;
            let direction = std::array::from_fn(|k| {
                let d = target[k] - eye[k];
                if exact { d } else { f64::from(d as f32) }
            });
            scene.camera = single_ray(eye, direction);
            let buffer = all(&scene, &accelerator);
            let cover = buffer.cover.as_ref().unwrap()[0];
            assert_eq!(cover.signed.abs(), 1, "ray {number} from {eye:?} along {direction:?}");
            let winner = buffer.visible[0].expect("a closed mesh has no hole");
            ties += usize::from(winner.tie);
            assert_same(&buffer, &nearest(&scene, &accelerator));
            let scanned = all(&scene, &linear);
            assert_same(&scanned, &buffer);
            assert_eq!(scanned.cover, buffer.cover);
        }
        assert!(ties > 1200, "exactly aimed rays hit edges exactly: {ties}");
    }
}

/// A large sphere through the tree only: no hole, one crossing.
#[test]
fn h57_aimed_rays_leave_no_hole_in_a_large_sphere() {
    let triangles = sphere(100, 200, 2.0, [0.0; 3]);
    let mut scene = Scene::from_triangles(standard_camera(8.0), &triangles);
    let accelerator = Accelerator::build(&scene.mesh, BuildPreset::Fastest);
    let mut random = Sequence(11);
    for number in 0..30_000 {
        let target = triangles[(number * 7919) % triangles.len()][number % 3].map(f64::from);
        let eye: [f64; 3] = std::array::from_fn(|_| random.step() - 0.5);
        let direction = std::array::from_fn(|k| f64::from((target[k] - eye[k]) as f32));
        scene.camera = single_ray(eye, direction);
        let buffer = all(&scene, &accelerator);
        assert_eq!(buffer.cover.as_ref().unwrap()[0].signed, 1, "ray {number}");
        assert!(buffer.visible[0].is_some());
    }
}

/// A scene of quads seen by one ray from (0, 0.25, 0), with enough bystanders for a tree.
fn quads_and_ray(quads: &[[Triangle; 2]], direction: [f64; 3]) -> Scene {
    let mut triangles = quads.concat();
    for k in 0..40 {
        let away = 100.0 + 3.0 * k as f32;
        triangles.extend(quad([away, away + 1.0], [away, away + 2.0], 70.0 + away));
    }
    Scene::from_triangles(single_ray([0.0, 0.25, 0.0], direction), &triangles)
}

#[test]
fn h50_a_ray_in_the_plane_of_a_box_face() {
    let ahead = [0.0, 0.0, 1.0];
    // x = 0 is the right edge of the left quad: exclusive; of the right quad it is the left edge.
    let left = [quad([-1.0, 0.0], [-1.0, 1.0], 5.0), quad([-9.0, -8.0], [-1.0, 1.0], 50.0)];
    let right = [quad([0.0, 1.0], [-1.0, 1.0], 5.0), quad([8.0, 9.0], [-1.0, 1.0], 50.0)];
    for direction in [ahead, [-0.0, 0.0, 1.0], [-0.0, -0.0, 1.0]] {
        let none = agreed(&quads_and_ray(&left, direction));
        let some = agreed(&quads_and_ray(&right, direction));
        assert_eq!(covered(&none), 0);
        assert_eq!(covered(&some), 1);
        assert!(some.visible[0].unwrap().tie);
        assert!(some.visible[0].unwrap().t_lo <= 5.0 && some.visible[0].unwrap().t_hi >= 5.0);
    }
}

/// The nearest multiple of 2^-50, which the lattice of a camera of size 1 keeps.
fn on_lattice(value: f64) -> f64 {
    (value * 2.0_f64.powi(50)).round() * 2.0_f64.powi(-50)
}

#[test]
fn h51_h52_boxes_that_end_just_beside_an_axis_parallel_ray() {
    let quads = [quad([-1.0, 1e-6], [-1.0, 1.0], 50.0), quad([1e-6, 1.0], [-1.0, 1.0], 50.0)];
    for x in [0.0, 1e-9, -1e-9] {
        let x = on_lattice(x);
        let buffer = agreed(&quads_and_ray(&quads, [x, 0.0, 1.0]));
        assert_eq!(ids(&buffer), [0], "the left quad's lower half, x = {x:e}");
    }
    // Five times the boundary's direction: the right quad's upper half.
    assert_eq!(ids(&agreed(&quads_and_ray(&quads, [on_lattice(1e-7), 0.0, 1.0]))), [3]);
}

#[test]
fn h54_flat_boxes() {
    let quads: Vec<Triangle> = (0..1000)
        .flat_map(|k| {
            let x = k as f32 * 0.5;
            let corner = |y: f32, z: f32| [x, y, z];
            [
                [corner(-1.0, 4.0), corner(1.0, 4.0), corner(1.0, 6.0)],
                [corner(-1.0, 4.0), corner(1.0, 6.0), corner(-1.0, 6.0)],
            ]
        })
        .collect();
    // In the plane of quad 0: edge-on, never visible.
    let mut scene = Scene::from_triangles(single_ray([0.0, 0.25, 0.0], [0.0, 0.0, 1.0]), &quads);
    assert_eq!(covered(&agreed(&scene)), 0);
    // From the left of it by 2^-40, leaning to it by 2^-42 per unit: crosses plane 0 at t = 4…6.
    let lean = 2.0_f64.powi(-42);
    scene.camera = single_ray([-5.0 * lean, 0.25, 0.0], [lean, 0.0, 1.0]);
    let buffer = agreed(&scene);
    assert_eq!(covered(&buffer), 1);
    assert!(ids(&buffer)[0] < 2);
    let visible = buffer.visible[0].unwrap();
    assert!(visible.t_lo <= 5.0 && 5.0 <= visible.t_hi);
    assert_eq!(buffer.cover.unwrap()[0].crossed, 1);
}
