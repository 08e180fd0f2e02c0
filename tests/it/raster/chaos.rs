//! Random scenes made of structure: small integers, powers of two, copies, shared edges and planes.

use super::{Triangles, assert_is_the_definition, grid_camera};
use crate::support::closed::contains;
use truecast::pixel::Resolution;
use truecast::scene::Scene;
use truecast::scene::camera::PinholeCamera;

/// A small generator of reproducible numbers (xorshift64*).
struct Random(u64);

impl Random {
    fn below(&mut self, count: u64) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 33) % count
    }

    fn from(&mut self, values: &[f32]) -> f32 {
        values[self.below(values.len() as u64) as usize]
    }
}

/// H14: closed meshes of chaotic integers, whose signed count is the eye's winding number.
#[test]
fn closed_meshes_have_one_signed_count() {
    let mut random = Random(0x9E37_79B9_7F4A_7C15);
    let (mut ties, mut exact, mut samples, mut on_surface) = (0, 0, 0, 0);
    for trial in 0..60 {
        // A sphere's grid with random vertices: poles and three rings of five.
        let mut vertex = || [0, 1, 2].map(|_| random.from(&[-3.0, -2.0, -1.0, 0.0, 1.0, 2.0, 3.0]));
        let (top, bottom) = (vertex(), vertex());
        let rings: Vec<[[f32; 3]; 5]> = (0..3).map(|_| [0; 5].map(|_| vertex())).collect();
        let mut mesh: Triangles = Vec::new();
        for i in 0..5 {
            let j = (i + 1) % 5;
            mesh.push([top, rings[0][i], rings[0][j]]);
            mesh.push([bottom, rings[2][j], rings[2][i]]);
            for pair in rings.windows(2) {
                mesh.push([pair[0][i], pair[1][i], pair[0][j]]);
                mesh.push([pair[0][j], pair[1][i], pair[1][j]]);
            }
        }
        let mut half = || f64::from(random.from(&[-5.0, -3.0, -1.0, 1.0, 3.0, 5.0])) / 2.0;
        let eye = [half(), half(), half()];
        let camera = PinholeCamera::exact(
            Resolution::new(9, 9).unwrap(),
            eye,
            [-4.5, -4.5, 2.0],
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
        )
        .unwrap();
        let scene = Scene::from_triangles(camera, &mesh);
        let buffer = assert_is_the_definition(&scene, &format!("trial {trial}"));
        // An eye on the surface sees V = 0 there: the mesh it sees is open.
        if mesh.iter().any(|triangle| contains(triangle, eye)) {
            on_surface += 1;
            continue;
        }
        let cover = buffer.cover.as_ref().unwrap();
        assert!(cover.iter().all(|c| c.signed == cover[0].signed), "trial {trial}: {cover:?}");
        samples += cover.len() as u64;
        exact += buffer.levels.exact;
        ties += buffer.visible.iter().flatten().filter(|v| v.tie).count();
    }
    assert!(on_surface < 20, "{on_surface} of 60 eyes lie on the surface");
    // The structure must bite: winners on ties, and samples that f64 could not decide.
    assert!(ties > 100 && exact > 1000, "{ties} ties, {exact} exact decisions in {samples}");
}

/// Scenes of grid-aligned, tiny, huge, copied and coplanar triangles against the definition.
#[test]
fn structured_scenes_agree_with_the_definition() {
    let mut random = Random(7);
    let mut exact = 0;
    for trial in 0..40 {
        let grid: Vec<f32> = (-6..=6).map(|i| i as f32).collect();
        let wild: Vec<f32> = (-8..=8)
            .flat_map(|e| [2.0_f32.powi(9 * e), -2.0_f32.powi(9 * e), 3.0 * 1.1_f32.powi(e)])
            .chain([0.0, -0.0, 1.4e-45, 8.5e37, -8.5e37])
            .collect();
        let values = if trial % 2 == 0 { &grid } else { &wild };
        let mut triangles: Triangles = Vec::new();
        for _ in 0..14 {
            let [p, q, r] = [0; 3].map(|_| [0, 1, 2].map(|_| random.from(values)));
            triangles.push([p, q, r]);
            match random.below(4) {
                // The same triangle the other way round, and a neighbour across an edge.
                0 => triangles.push([q, p, r]),
                1 => triangles.push([q, p, [0, 1, 2].map(|_| random.from(values))]),
                // Another triangle of the same plane (exact on the grid).
                2 => triangles.push([p, q, [0, 1, 2].map(|k| q[k] + r[k] - p[k])]),
                _ => {}
            }
        }
        triangles.iter_mut().flatten().flatten().for_each(|c| *c = c.clamp(-8.5e37, 8.5e37));
        let camera = match trial % 5 {
            0 | 1 => grid_camera([0.0, 0.0, -7.0], 8.0),
            2 => grid_camera([0.5, -1.0, -6.0], 4.0),
            // A mirrored image: det[DX DY D0] < 0.
            3 => PinholeCamera::exact(
                Resolution::new(17, 17).unwrap(),
                [0.0, 1.0, -6.0],
                [8.5, -8.5, 6.0],
                [-1.0, 0.0, 0.0],
                [0.0, 1.0, 0.0],
            )
            .unwrap(),
            _ => PinholeCamera::look_at(
                Resolution::new(13, 11).unwrap(),
                [1.2, 0.7, -5.3],
                [0.1, 0.0, 0.2],
                [0.0, 1.0, 0.0],
                70.0,
            )
            .unwrap(),
        };
        let scene = Scene::from_triangles(camera, &triangles);
        exact += assert_is_the_definition(&scene, &format!("trial {trial}")).levels.exact;
    }
    assert!(exact > 1000, "the exact stage was hardly asked: {exact}");
}
