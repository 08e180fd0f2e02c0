//! On a closed mesh the signed count is the winding number of the eye, whatever the sample meets.

use super::answers;
use crate::support::closed::integer_chaos;
use crate::support::scenes::Triangle;
use truecast::pixel::Resolution;
use truecast::scene::Scene;
use truecast::scene::camera::PinholeCamera;

/// det of three integer corners seen from the eye, all doubled to be integers.
fn doubled_volume(triangle: &Triangle, eye: [f64; 3]) -> i64 {
    let a = triangle.map(|v| [0, 1, 2].map(|k| (2.0 * (f64::from(v[k]) - eye[k])) as i64));
    a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1])
        + a[0][1] * (a[1][2] * a[2][0] - a[1][0] * a[2][2])
        + a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0])
}

#[test]
fn h14_the_signed_count_of_a_closed_mesh_is_the_same_at_every_sample() {
    let frame = Resolution::new(9, 9).unwrap();
    let (mut scenes, mut ties) = (0, 0);
    for seed in 0..40 {
        let triangles = integer_chaos(seed);
        for eye in [[0.5, 0.5, -4.5], [0.5, -0.5, 0.5]] {
            // Inside the hull, an eye in a triangle's plane may lie on the triangle itself.
            if eye[2] > -3.0 && triangles.iter().any(|t| doubled_volume(t, eye) == 0) {
                continue;
            }
            let d0 = [-2.25, -2.25, 2.0];
            let (dx, dy) = ([0.5, 0.0, 0.0], [0.0, 0.5, 0.0]);
            let camera = PinholeCamera::exact(frame, eye, d0, dx, dy).unwrap();
            let answers = answers(&Scene::from_triangles(camera, &triangles));
            let counts: Vec<i32> = answers.iter().map(|answer| answer.cover.signed).collect();
            assert_eq!(counts, vec![counts[0]; 81], "seed {seed}, eye {eye:?}");
            assert!(eye[2] > -3.0 || counts[0] == 0, "no winding outside");
            scenes += 1;
            ties += answers.iter().filter(|a| a.visible.is_some_and(|s| s.tie)).count();
        }
    }
    // The test means something only if it meets degenerate samples.
    assert!(scenes > 45 && ties > 200, "{scenes} scenes, {ties} ties");
}
