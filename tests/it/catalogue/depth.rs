//! H20 to H25 and H29: copies, common planes, and planes that are as close as numbers can be.

use super::configurations::agree_everywhere;
use super::{agree_with_golden, cover, ids};
use crate::support::golden;
use crate::support::scenes::{Sequence, Triangle, rectangle, standard_scene, triangles_of};

#[test]
fn h20_duplicates() {
    let buffer = agree_with_golden("dup3");
    assert_eq!(ids(&buffer), vec![Some(0); 289]);
    assert!(cover(&buffer).iter().all(|c| c.crossed == 3 && c.signed.abs() == 3));
    assert!(buffer.visible.iter().all(|v| v.unwrap().tie));
}

#[test]
fn h21_duplicates_permuted() {
    let [a, b, c] = triangles_of(&golden::scene("dup3").scene)[0];
    // Once turned and once reversed: the counts of two of them cancel.
    for copies in [[[a, b, c], [b, c, a], [a, c, b]], [[a, c, b], [c, a, b], [c, b, a]]] {
        let buffer = agree_everywhere("turned and reversed", &standard_scene(&copies));
        assert_eq!(ids(&buffer), vec![Some(0); 289]);
        assert!(cover(&buffer).iter().all(|c| c.crossed == 3 && c.signed.abs() == 1));
    }
}

#[test]
fn h22_coplanar_overlap() {
    let left = [[-9.0, -9.0, 8.0], [5.0, -1.5, 8.0], [-9.0, 9.0, 8.0]];
    let right = [[9.0, -9.0, 8.0], [9.0, 9.0, 8.0], [-5.0, 2.5, 8.0]];
    for triangles in [[left, right], [right, left]] {
        let buffer = agree_everywhere("coplanar", &standard_scene(&triangles));
        let mut seen = [0; 2];
        for (visible, cover) in buffer.visible.iter().zip(cover(&buffer)) {
            let Some(visible) = visible else { continue };
            seen[visible.triangle.index()] += 1;
            if cover.crossed == 2 {
                assert_eq!((visible.triangle.get(), visible.tie), (0, true));
            }
        }
        let both = cover(&buffer).iter().filter(|c| c.crossed == 2).count();
        assert!(both > 20 && seen[0] > both && seen[1] > 20, "{both} shared, {seen:?}");
    }
}

#[test]
fn h23_tilted_coplanar() {
    let buffer = agree_with_golden("coplanar_tilted");
    // All corners on x + 2y + 3z = 24: the lowest id of those that cover, in any order of file.
    let triangles = triangles_of(&golden::scene("coplanar_tilted").scene);
    assert!(triangles.iter().flatten().all(|[x, y, z]| x + 2.0 * y + 3.0 * z == 24.0));
    let reversed: Vec<Triangle> = triangles.iter().rev().copied().collect();
    let other = agree_everywhere("coplanar, reversed order", &standard_scene(&reversed));
    assert_eq!(cover(&buffer), cover(&other));
    for (index, (a, b)) in ids(&buffer).into_iter().zip(ids(&other)).enumerate() {
        let (Some(a), Some(b)) = (a, b) else { continue };
        // The first of one order is the last of the other.
        assert_eq!(a == 2 - b, cover(&buffer)[index].crossed == 1);
    }
}

#[test]
fn h24_parallel_one_ulp() {
    let buffer = agree_with_golden("parallel_1ulp_far_first");
    assert!(buffer.visible.iter().all(|v| v.unwrap().triangle.get() >= 2));
    // The same at other distances, the nearer one first and last.
    for z in [10.0_f32, 1000.0, 1e6, 1e-6] {
        let side = 4.0 * z;
        let near = rectangle([-side, -side], [side, side], z);
        let far = rectangle([-side, -side], [side, side], z.next_up());
        for (triangles, nearer) in [([near, far].concat(), 0), ([far, near].concat(), 1)] {
            let buffer = agree_everywhere(&format!("sheets at {z}"), &standard_scene(&triangles));
            assert!(buffer.visible.iter().all(|v| v.unwrap().triangle.get() / 2 == nearer), "{z}");
            assert!(cover(&buffer).iter().all(|c| c.crossed == 2), "{z}");
        }
    }
}

/// Pairs of slanted planes, of two triangles each.
const SLANTED_PAIRS: usize = 40;

/// A random slanted triangle, and the same with every corner one step of f32 further in z: between
/// the eye and the second lies the first wherever both are.
#[test]
fn h25_slanted_one_ulp() {
    let mut random = Sequence(25);
    let mut decided = 0;
    for number in 0..SLANTED_PAIRS {
        let distance = if number % 2 == 0 { 10.0 } else { 1000.0 };
        let corners = [[-3.0, -2.0], [3.0, -2.0], [0.0, 4.0]];
        let near: Triangle = corners.map(|[x, y]| {
            let mut about = |c: f64| (distance * (c + 0.5 * (random.next() - 0.5))) as f32;
            [about(x), about(y), about(1.25)]
        });
        let far = near.map(|[x, y, z]| [x, y, z.next_up()]);
        for (triangles, nearer) in [([far, near], 1), ([near, far], 0)] {
            let buffer = agree_everywhere(&format!("pair {number}"), &standard_scene(&triangles));
            for (visible, cover) in buffer.visible.iter().zip(cover(&buffer)) {
                if cover.crossed == 2 {
                    assert_eq!(visible.unwrap().triangle.get(), nearer, "pair {number}");
                    decided += 1;
                }
            }
        }
    }
    assert!(decided > 200 * 2 * SLANTED_PAIRS, "{decided}");
}

/// The code of a 24-bit depth buffer with the planes n and f, cut off; one step is 0.149 at 500.
fn d24(z: f64) -> u32 {
    let (n, f) = (0.1, 1000.0);
    (f64::from((1 << 24) - 1) * (f * (z - n)) / (z * (f - n))) as u32
}

/// Two sheets a tenth apart at 500: one code of a 24-bit depth buffer, and no doubt here.
#[test]
fn h29_d24_tie() {
    let [near, far] = [500.0_f32, 500.1];
    assert_eq!(d24(f64::from(near)), d24(f64::from(far)), "a depth buffer cannot tell");
    let sheet = |z: f32| rectangle([-900.0, -900.0], [900.0, 900.0], z);
    for (triangles, nearer) in
        [([sheet(far), sheet(near)].concat(), 1), ([sheet(near), sheet(far)].concat(), 0)]
    {
        let buffer = agree_everywhere("D24", &standard_scene(&triangles));
        for visible in &buffer.visible {
            let visible = visible.unwrap();
            assert_eq!(visible.triangle.get() / 2, nearer);
            assert!(visible.t_lo <= 62.5 && 62.5 <= visible.t_hi, "{visible:?}");
        }
    }
}
