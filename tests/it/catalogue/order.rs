//! H26 to H28, H30 and H31: planes that cross on samples, and what the order of a file may do.

use super::{agree_with_golden, cover, ids, samples};
use crate::support::configurations::agree_everywhere;
use crate::support::golden;
use crate::support::scenes::{Sequence, Triangle, grid_camera, standard_scene, triangles_of};
use truecast::accel::{Accelerator, BuildPreset};
use truecast::cast::cast;
use truecast::raster::rasterize;
use truecast::scene::Scene;
use truecast::visibility::Counting;

/// Two planes of slopes ±2^-20 that cross at the samples of column 8: to the left of it and on it
/// different ones are nearer, for every row alike.
#[test]
fn h26_interpenetration() {
    let buffer = agree_with_golden("interpenetrating_2^-20");
    let mut triangles = triangles_of(&golden::scene("interpenetrating_2^-20").scene);
    let sheet = |id: Option<u32>| id.unwrap() / 2;
    for (index, [x, _]) in samples().enumerate() {
        let side = sheet(ids(&buffer)[8 * 17 + if x < 0 { 0 } else { 16 }]);
        assert_eq!(sheet(ids(&buffer)[index]), side);
        assert!(x != 0 || buffer.visible[index].unwrap().tie);
    }
    // In the other order of file the same sheets are seen: no id decides.
    triangles.rotate_left(2);
    let other = agree_everywhere("interpenetration, other order", &standard_scene(&triangles));
    for (a, b) in ids(&buffer).into_iter().zip(ids(&other)) {
        assert_eq!(sheet(a), 1 - sheet(b));
    }
}

/// Two leaves on the same side of an edge that runs down the samples of a column.
#[test]
fn h27_fold_edge() {
    let (top, bottom) = ([0.0, -9.0, 8.0], [0.0, 9.0, 8.0]);
    let leaf = |z: f32| [top, bottom, [9.0, 0.0, z]];
    for (far, near) in [(9.0, 7.0), (8.0 + 1e-3, 8.0), (8.0_f32.next_up(), 8.0)] {
        for (triangles, nearer) in [([leaf(far), leaf(near)], 1), ([leaf(near), leaf(far)], 0)] {
            let buffer = agree_everywhere("fold", &standard_scene(&triangles));
            for row in 0..17 {
                let visible = buffer.visible[row * 17 + 8].expect("the edge is a left edge");
                assert_eq!((visible.triangle.get(), visible.tie), (nearer, true), "{near}, {far}");
                assert_eq!(cover(&buffer)[row * 17 + 8].crossed, 2);
            }
        }
    }
}

/// The planes z = 8, z = 8 + x/16 and z = 8 + y/16: the nearest at the sample (x, y) has the least
/// of 0, x and y, and on the lines where two are equal it has the least of 0, x + ε and y + ε².
#[test]
fn h28_three_planes() {
    let corners = [[-64.0, -64.0], [192.0, -64.0], [-64.0, 192.0]];
    let plane = |slope: fn(f32, f32) -> f32| -> Triangle {
        corners.map(|[x, y]| [x, y, 8.0 + slope(x, y) / 16.0])
    };
    let planes = [plane(|_, _| 0.0), plane(|x, _| x), plane(|_, y| y)];
    for order in [[0, 1, 2], [2, 1, 0], [1, 2, 0]] {
        let buffer = agree_everywhere("planes", &standard_scene(&order.map(|k| planes[k])));
        let mut ties = 0;
        for (index, [x, y]) in samples().enumerate() {
            let moved = [0.0, f64::from(x) + 1e-3, f64::from(y) + 1e-6];
            let nearest = (0..3).min_by(|&a, &b| moved[a].total_cmp(&moved[b])).unwrap();
            let visible = buffer.visible[index].unwrap();
            assert_eq!(order[visible.triangle.index()], nearest, "({x}, {y})");
            assert_eq!(cover(&buffer)[index].crossed, 3);
            ties += usize::from(visible.tie);
        }
        // Three half lines of eight samples, and their common end.
        assert_eq!(ties, 3 * 8 + 1);
    }
}

/// Any order of the numbers 0…count − 1.
fn shuffled(count: usize, random: &mut Sequence) -> Vec<usize> {
    let mut order: Vec<usize> = (0..count).collect();
    for k in (1..count).rev() {
        order.swap(k, random.below(k + 1));
    }
    order
}

/// Scenes in which no two triangles of one plane cover a common sample.
#[test]
fn h30_permuted_file_order() {
    let mut random = Sequence(30);
    let names =
        ["fan64", "grid_exact", "box_inside", "interpenetrating_2^-20", "tiny_in_front_of_huge"];
    for name in names {
        let golden = golden::scene(name);
        let reference = agree_everywhere(name, &golden.scene);
        let triangles = triangles_of(&golden.scene);
        for _ in 0..3 {
            let order = shuffled(triangles.len(), &mut random);
            let permuted: Vec<Triangle> = order.iter().map(|&k| triangles[k]).collect();
            let scene = Scene::from_triangles(golden.scene.camera.clone(), &permuted);
            let buffer = agree_everywhere(&format!("{name}, permuted"), &scene);
            assert_eq!(reference.cover, buffer.cover, "{name}");
            for (a, b) in reference.visible.iter().zip(&buffer.visible) {
                let back = |id: usize| order[id];
                assert_eq!(
                    a.map(|v| (v.triangle.index(), v.t_lo, v.t_hi, v.barycentric, v.tie)),
                    b.map(|v| (back(v.triangle.index()), v.t_lo, v.t_hi, v.barycentric, v.tie)),
                    "{name}"
                );
            }
        }
    }
}

/// Planes of the chain.
const CHAIN: usize = 1000;

/// Parallel planes one step of f32 apart in random order of file: the nearest, and after it is
/// taken away the next, to the last.
#[test]
fn h31_order_chain() {
    let mut random = Sequence(31);
    let mut order = shuffled(CHAIN, &mut random);
    let plane = |&step: &usize| -> Triangle {
        let z = f32::from_bits(1000.0_f32.to_bits() + step as u32);
        [[-2000.0, -2000.0, z], [6000.0, -2000.0, z], [-2000.0, 6000.0, z]]
    };
    let of = |order: &[usize]| {
        let triangles: Vec<Triangle> = order.iter().map(plane).collect();
        Scene::from_triangles(grid_camera(3, 8.0), &triangles)
    };
    agree_everywhere("chain", &of(&order));
    for expected in 0..CHAIN {
        let scene = of(&order);
        let window = scene.camera.resolution().window();
        let accelerator = Accelerator::build(&scene.mesh, BuildPreset::Fastest);
        let buffer = cast(&scene, &accelerator, window, Counting::Nearest, &|| ());
        let raster = rasterize(&scene, window, Counting::Nearest, &|| ());
        assert_eq!(ids(&buffer), ids(&raster));
        let winner = ids(&buffer)[4].expect("a plane is left") as usize;
        assert_eq!(order[winner], expected);
        assert_eq!(ids(&buffer), vec![Some(winner as u32); 9]);
        order.remove(winner);
    }
}
