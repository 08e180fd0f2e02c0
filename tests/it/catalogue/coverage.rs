//! H10 to H13 and H17: T-junctions, the edge that contraction cracks, and the needle.

use super::{agree_with_golden, assert_covered_once, cover, ids, samples};
use crate::support::configurations::agree_everywhere;
use crate::support::golden;
use crate::support::scenes::{
    T_JUNCTION, T_SLIVER, T_VERTEX, Triangle, single_ray_camera, standard_scene, triangles_of,
};
use truecast::pixel::Resolution;
use truecast::scene::Scene;
use truecast::scene::camera::PinholeCamera;
use truecast::visibility::VisibilityBuffer;

/// The ray through the T-vertex, moved upwards by `offset`: half of the gap of 5.46e-9 there is
/// 2.73e-9.
fn beside_the_t_vertex(triangles: &[Triangle], offset: f64) -> VisibilityBuffer {
    let direction = [f64::from(T_VERTEX[0]), f64::from(T_VERTEX[1]) + offset, 1.0];
    let scene = Scene::from_triangles(single_ray_camera([0.0; 3], direction), triangles);
    agree_everywhere(&format!("T-junction + {offset:e}"), &scene)
}

#[test]
fn h10_t_junction_gap() {
    for (offset, expected) in [(2.73e-9, None), (1e-3, Some(0)), (-1e-3, Some(1))] {
        let buffer = beside_the_t_vertex(&T_JUNCTION, offset);
        // Below the vertex the sample belongs to one of the two small triangles.
        let found = buffer.visible[0].map(|v| v.triangle.get().min(1));
        assert_eq!(found, expected, "{offset:e}");
        assert_eq!(cover(&buffer)[0].crossed, u32::from(expected.is_some()), "{offset:e}");
    }
}

/// M lies exactly on AB: two small triangles cover what the large one covers, sample by sample.
#[test]
fn h11_exact_t_vertex() {
    let [a, b, m] = [[0.0, 0.0, 8.0], [4.0, 2.0, 8.0], [2.0, 1.0, 8.0]];
    let (above, below) = ([4.0, -6.0, 8.0], [0.0, 6.0, 8.0]);
    let whole = standard_scene(&[[a, b, above], [b, a, below]]);
    let parted = standard_scene(&[[a, b, above], [m, a, below], [b, m, below]]);
    let whole = agree_everywhere("without T-vertex", &whole);
    let parted = agree_everywhere("with T-vertex", &parted);
    assert_covered_once("with T-vertex", &parted);
    assert!(cover(&parted).iter().any(|c| c.crossed == 1));
    // Three samples lie on AB, one of them at M.
    for index in [8 * 17 + 8, 9 * 17 + 10] {
        assert!(parted.visible[index].unwrap().tie);
    }
    let joined = |id: u32| id.min(1);
    let parted: Vec<_> = ids(&parted).into_iter().map(|id| id.map(joined)).collect();
    assert_eq!(parted, ids(&whole));
}

#[test]
fn h12_fma_crack() {
    let (x, y) = (1.0 + f32::EPSILON, 1.0 + 3.0 * f32::EPSILON);
    let (b, c) = ([x, y, 1.0], [-x, -y, 1.0]);
    let triangles = [[[-3.0, 1.0, 1.0], b, c], [[3.0, -1.0, 1.0], c, b]];
    let ahead = single_ray_camera([0.0; 3], [0.0, 0.0, 1.0]);
    for scene in [Scene::from_triangles(ahead, &triangles), standard_scene(&triangles)] {
        let buffer = agree_everywhere("crack", &scene);
        assert_covered_once("crack", &buffer);
        let middle = buffer.visible[buffer.visible.len() / 2].expect("the edge is no crack");
        assert!(middle.tie);
    }
}

/// H10's mesh with the sliver in the gap, under 10⁴ samples that lie 2^-34 apart vertically: with
/// it every sample is covered once, without it the sliver's samples are holes.
#[test]
fn h13_bridged_t_junction() {
    let mut bridged = T_JUNCTION.to_vec();
    bridged.push(T_SLIVER);
    let filled = beside_the_t_vertex(&bridged, 2.73e-9);
    assert_eq!((ids(&filled)[0], cover(&filled)[0].crossed), (Some(3), 1));

    // Rows from 10 steps below M to 90 steps above: 5.2e-9 of the gap's 5.46e-9.
    let (across, down) = (2.0_f64.powi(-36), 2.0_f64.powi(-34));
    let [x, y] = [T_VERTEX[0], T_VERTEX[1]].map(f64::from);
    let camera = PinholeCamera::exact(
        Resolution::new(100, 100).unwrap(),
        [0.0; 3],
        [x - 50.5 * across, y - 10.5 * down, 1.0],
        [across, 0.0, 0.0],
        [0.0, down, 0.0],
    )
    .unwrap();
    let bridged = agree_everywhere("bridged", &Scene::from_triangles(camera.clone(), &bridged));
    let open = agree_everywhere("open", &Scene::from_triangles(camera, &T_JUNCTION));
    assert!(cover(&bridged).iter().all(|c| (c.crossed, c.signed.abs()) == (1, 1)));
    assert_eq!(super::one_signed_count("bridged", &bridged).abs(), 1);
    let mut slivers = 0;
    for (with, without) in ids(&bridged).into_iter().zip(ids(&open)) {
        assert_eq!(without, with.filter(|&id| id != 3));
        slivers += usize::from(with == Some(3));
    }
    assert!(slivers > 5000, "the samples lie in the gap: {slivers}");
}

#[test]
fn h17_needle() {
    let name = "needle_1e8x1e-3";
    let needle = agree_with_golden(name);
    for (visible, [_, y]) in needle.visible.iter().zip(samples()) {
        assert_eq!(visible.is_some(), y == 0);
    }
    // Two triangles on its long edges complete the picture: no gap and no double cover.
    let needle = triangles_of(&golden::scene(name).scene)[0];
    let mut downwards = needle;
    downwards.sort_by(|p, q| p[1].total_cmp(&q[1]));
    let [top, tip, bottom] = downwards;
    assert!(tip == [5e7, 0.0, 8.0] && top[0] == -5e7 && bottom[0] == -5e7);
    let far = 1e8;
    let above = [top, tip, [0.0, -far, 8.0]];
    let below = [bottom, tip, [0.0, far, 8.0]];
    let buffer = agree_everywhere("completed", &standard_scene(&[needle, above, below]));
    assert_covered_once("completed", &buffer);
    for (id, [_, y]) in ids(&buffer).into_iter().zip(samples()) {
        let expected = match y {
            0 => 0,
            y if y < 0 => 1,
            _ => 2,
        };
        assert_eq!(id, Some(expected));
    }
}
