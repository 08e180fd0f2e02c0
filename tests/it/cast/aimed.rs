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
