//! Many triangles in one place: duplicates, nests, chains, soups, near planes.

use super::*;

#[test]
fn h58_many_identical_triangles_are_one_answer() {
    let triangle = [[-4.0, -4.0, 8.0], [4.0, -4.0, 8.0], [-4.0, 4.0, 8.0]];
    let count = 100_000;
    let scene = Scene::from_triangles(standard_camera(8.0), &vec![triangle; count]);
    let buffer = all(&scene, &Accelerator::build(&scene.mesh, BuildPreset::Medium));
    assert_eq!(covered(&buffer), 36);
    for (visible, cover) in buffer.visible.iter().zip(buffer.cover.as_ref().unwrap()) {
        let Some(visible) = visible else { continue };
        assert_eq!(visible.triangle.get(), 0);
        assert!(visible.tie);
        assert_eq!(cover.crossed as usize, count);
        assert_eq!(cover.signed.unsigned_abs() as usize, count);
    }
}

#[test]
fn h59_h65_nested_and_chained_triangles() {
    let concentric: Vec<Triangle> = (1..=600)
        .map(|i| {
            let s = i as f32 / 64.0;
            [[-s, -s, 8.0], [2.0 * s, -s, 8.0], [-s, 2.0 * s, 8.0]]
        })
        .collect();
    let scene = Scene::from_triangles(standard_camera(8.0), &concentric);
    // One plane: the lowest id wherever it reaches.
    let buffer = agreed(&scene);
    assert_eq!(ids(&buffer)[8 * 17 + 8], 0);
    let chain: Vec<Triangle> = (-140..=120)
        .map(|k| {
            let s = 2.0_f64.powi(k) as f32;
            [[-s, -s, 2.0 * s], [s, -s, 2.0 * s], [-s, s, 3.0 * s]]
        })
        .collect();
    let scene = Scene::from_triangles(standard_camera(8.0), &chain);
    let buffer = agreed(&scene);
    assert_eq!(ids(&buffer)[8 * 17 + 6], 0, "the smallest is nearest");
    assert_finite(&buffer);
}

/// H64: random triangles of all sizes, several thousand rays, counts by tree and by scan.
#[test]
fn h64_all_hits_by_tree_and_by_scan() {
    let mut random = Sequence(3);
    let mut triangles: Vec<Triangle> = (0..1500)
        .map(|_| {
            let size = 4.0 * random.next().powi(6) + 0.05;
            let center: [f64; 3] = [
                12.0 * random.next() - 6.0,
                12.0 * random.next() - 6.0,
                12.0 * random.next() - 2.0,
            ];
            std::array::from_fn(|_| {
                std::array::from_fn(|k| (center[k] + size * (random.next() - 0.5)) as f32)
            })
        })
        .collect();
    // On small integers too, so that ties abound.
    for _ in 0..500 {
        triangles.push(std::array::from_fn(|_| {
            std::array::from_fn(|_| (random.next() * 7.0).floor() as f32 - 3.0)
        }));
    }
    let resolution = Resolution::new(40, 40).unwrap();
    let camera = PinholeCamera::exact(
        resolution,
        [0.25, -0.5, -8.5],
        [-0.625, -0.625, 1.0],
        [1.0 / 32.0, 0.0, 0.0],
        [0.0, 1.0 / 32.0, 0.0],
    )
    .unwrap();
    let scene = Scene::from_triangles(camera, &triangles);
    let buffer = agreed(&scene);
    assert_finite(&buffer);
    assert!(buffer.visible.iter().flatten().filter(|v| v.tie).count() > 10);
    // H63, H30: a permuted order of triangles is the same picture, ids apart, where no two
    // triangles share a plane.
    let mut reversed = triangles.clone();
    reversed.reverse();
    let other = agreed(&Scene::from_triangles(scene.camera.clone(), &reversed));
    assert_eq!(buffer.cover, other.cover);
    for (a, b) in buffer.visible.iter().zip(&other.visible) {
        assert_eq!(a.map(|v| bits(&v)[3]), b.map(|v| bits(&v)[3]), "t does not depend on order");
        assert_eq!(a.map(|v| v.tie), b.map(|v| v.tie));
    }
}

/// H24, H25: planes one ulp apart, the far one first in the file; the filter decides.
#[test]
fn h24_planes_one_step_apart_are_ordered() {
    let near = 1000.0_f32;
    let far = f32::from_bits(near.to_bits() + 1);
    let plane = |z: f32| quad([-2000.0, 2000.0], [-2000.0, 2000.0], z);
    let scene = Scene::from_triangles(standard_camera(8.0), &[plane(far), plane(near)].concat());
    let buffer = agreed(&scene);
    assert!(buffer.visible.iter().all(|v| v.unwrap().triangle.get() >= 2));
}
