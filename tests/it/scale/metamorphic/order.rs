//! H80: the order of triangles and of corners, and the sharing of vertices.

use super::{place, scenes_with_ties};
use crate::scale::ids;
use crate::support::configurations::{NARROW, agreed, agreed_within, assert_same};
use crate::support::rays::Random;
use crate::support::scenes::{Triangle, rectangle, standard_scene};
use std::collections::HashMap;

/// No two triangles of the scene lie in one plane seen from the origin, so the order in the file
/// does not decide.
fn has_no_shared_planes(triangles: &[Triangle]) -> bool {
    let buffer = agreed_within(&standard_scene(triangles), &NARROW, "planes");
    let mut reversed = triangles.to_vec();
    reversed.reverse();
    let other = agreed_within(&standard_scene(&reversed), &NARROW, "planes");
    let last = triangles.len() as u32 - 1;
    ids(&buffer).iter().zip(ids(&other)).all(|(a, b)| *a == b.map(|id| last - id))
}

/// The order of triangles, the order of corners and the sharing of vertices.
#[test]
fn h80_order_and_welding() {
    let mut random = Random(80);
    let mut without_shared_planes = 0;
    for (name, triangles) in scenes_with_ties() {
        let scene = standard_scene(&triangles);
        let reference = agreed(&scene);
        // Corners: cyclic orders keep everything, a swap turns the facing.
        for turn in 1..3 {
            let turned: Vec<Triangle> =
                triangles.iter().map(|t| [t[turn], t[(turn + 1) % 3], t[(turn + 2) % 3]]).collect();
            let buffer = agreed_within(&standard_scene(&turned), &NARROW, &name);
            assert_eq!(ids(&reference), ids(&buffer), "{name}");
            assert_eq!(reference.cover, buffer.cover, "{name}");
            for (a, b) in reference.visible.iter().flatten().zip(buffer.visible.iter().flatten()) {
                assert_eq!((a.facing, a.tie), (b.facing, b.tie), "{name}");
            }
        }
        let swapped: Vec<Triangle> = triangles.iter().map(|&[a, b, c]| [a, c, b]).collect();
        let buffer = agreed_within(&standard_scene(&swapped), &NARROW, &name);
        assert_eq!(ids(&reference), ids(&buffer), "{name}");
        for (a, b) in reference.visible.iter().flatten().zip(buffer.visible.iter().flatten()) {
            assert_eq!((a.facing.sign(), a.tie), (-b.facing.sign(), b.tie), "{name}");
        }
        // Welding: the same positions by fewer numbers.
        let mut welded = scene.clone();
        let mut numbers: HashMap<[u32; 3], u32> = HashMap::new();
        let mut positions = Vec::new();
        for corner in welded.mesh.corners.iter_mut().flatten() {
            let position = scene.mesh.positions[*corner as usize];
            *corner = *numbers.entry(position.map(f32::to_bits)).or_insert_with(|| {
                positions.push(position);
                positions.len() as u32 - 1
            });
        }
        welded.mesh.positions = positions;
        assert_same(&reference, &agreed_within(&welded, &NARROW, &name), &name);
        // Triangles: counts and depths stay, and so do the triangles where no plane is shared.
        let exact_ids = has_no_shared_planes(&triangles);
        without_shared_planes += usize::from(exact_ids);
        let mut order: Vec<usize> = (0..triangles.len()).collect();
        for _ in 0..4 {
            random.shuffle(&mut order);
            let shuffled: Vec<Triangle> = order.iter().map(|&k| triangles[k]).collect();
            let buffer = agreed_within(&standard_scene(&shuffled), &NARROW, &name);
            assert_eq!(reference.cover, buffer.cover, "{name}");
            for (a, b) in reference.visible.iter().zip(&buffer.visible) {
                assert_eq!(a.is_some(), b.is_some(), "{name}");
                let (Some(a), Some(b)) = (a, b) else { continue };
                if exact_ids {
                    assert_eq!(a.triangle.index(), order[b.triangle.index()], "{name}");
                    assert_eq!((place(a), a.barycentric), (place(b), b.barycentric), "{name}");
                } else {
                    assert!(a.t_lo <= b.t_hi && b.t_lo <= a.t_hi, "{name}: {a:?} {b:?}");
                }
            }
        }
    }
    assert!(without_shared_planes >= 4, "{without_shared_planes}");
}

/// A rectangle in front of another hides it whatever their order: the least transformation.
#[test]
fn h80_the_nearer_of_two_whatever_the_order() {
    let [near, far] = [4.0, 8.0].map(|z| rectangle([-9.0, -9.0], [9.0, 9.0], z));
    for (triangles, nearest) in [([near, far].concat(), 0..2), ([far, near].concat(), 2..4)] {
        let buffer = agreed(&standard_scene(&triangles));
        assert!(ids(&buffer).iter().all(|id| id.is_some_and(|id| nearest.contains(&id))));
    }
}
