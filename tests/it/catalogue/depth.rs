//! H20 to H25 and H29: copies, common planes, and planes that are as close as numbers can be.

use super::{agree_with_golden, cover, ids};
use crate::support::configurations::agree_everywhere;
use crate::support::golden;
use crate::support::scenes::{Sequence, Triangle, rectangle, standard_scene, triangles_of};
use truecast::raster::{DepthBuffer, DepthFormat, SubpixelBits, rasterize_watertight};
use truecast::scene::Scene;
use truecast::visibility::{Counting, VisibilityBuffer};

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

/// Two sheets: their depths, and the depth buffers from 0.1 to 1000 that cannot tell them apart and
/// those that can. D24 counts in steps of D·16 777 215; near 1, f32 has nearly the same steps.
const SHEETS: [(f32, f32, &[DepthFormat], &[DepthFormat]); 5] = {
    use DepthFormat::{D16, D24, D32};
    [
        // 500.1 is step …537.78, 500.2 is …538.45: both …538.
        (500.1, 500.2, &[D16, D24, D32], &[]),
        // 500 is …537.11 and 500.05 is …537.45: both …537.
        (500.0, 500.05, &[D16, D24, D32], &[]),
        // The catalogue's pair: closer than a step of 0.149, but on both sides of …537.5.
        (500.0, 500.1, &[D16], &[D24, D32]),
        // Further apart than a step, far closer than D16's of 38.1.
        (500.0, 500.2, &[D16], &[D24, D32]),
        (500.0, 501.0, &[D16], &[D24, D32]),
    ]
};

fn depth_buffered(scene: &Scene, format: DepthFormat) -> VisibilityBuffer {
    let buffer = DepthBuffer::new(format, DepthBuffer::STANDARD_NEAR, DepthBuffer::STANDARD_FAR);
    let window = scene.camera.resolution().window();
    let bits = SubpixelBits::default();
    rasterize_watertight(scene, window, bits, buffer, Counting::Nearest, &|| ())
}

/// Two sheets at 500 that are closer than a depth buffer's steps: its ties, and no doubt here.
#[test]
fn h29_d24_tie() {
    let sheet = |z: f32| rectangle([-900.0, -900.0], [900.0, 900.0], z);
    for (near, far, ties, orders) in SHEETS {
        for (triangles, nearer) in
            [([sheet(far), sheet(near)].concat(), 1), ([sheet(near), sheet(far)].concat(), 0)]
        {
            let scene = standard_scene(&triangles);
            let buffer = agree_everywhere("sheets", &scene);
            let t = f64::from(near) / 8.0;
            for visible in &buffer.visible {
                let visible = visible.unwrap();
                assert_eq!(visible.triangle.get() / 2, nearer);
                assert!(visible.t_lo <= t && t <= visible.t_hi, "{visible:?}");
            }
            // A depth buffer that cannot tell shows the first sheet and says so.
            for &format in ties {
                for visible in depth_buffered(&scene, format).visible {
                    let visible = visible.unwrap();
                    let said = (visible.triangle.get() / 2, visible.tie);
                    assert_eq!(said, (0, true), "{near} and {far} in {format:?}");
                }
            }
            for &format in orders {
                for visible in depth_buffered(&scene, format).visible {
                    let visible = visible.unwrap();
                    let said = (visible.triangle.get() / 2, visible.tie);
                    assert_eq!(said, (nearer, false), "{near} and {far} in {format:?}");
                }
            }
        }
    }
}

/// Pairs of sheets a given distance apart, swept over many steps of the depth buffer: ties come as
/// often as two places share a step, and never between places more than a step apart.
#[test]
fn h29_d24_and_d16_ties_by_distance() {
    const PAIRS: u32 = 60;
    let step = |format: DepthFormat| {
        let (near, far) = (DepthBuffer::STANDARD_NEAR, DepthBuffer::STANDARD_FAR);
        500.0 * 500.0 * (far - near) / (far * near) / 2.0_f64.powi(format.bits() as i32)
    };
    assert!((step(DepthFormat::D24) - 0.149).abs() < 1e-3);
    assert!((step(DepthFormat::D16) - 38.1).abs() < 0.1);
    for format in [DepthFormat::D24, DepthFormat::D16] {
        for (part, expected) in [(0.25, 0.75), (0.5, 0.5), (1.5, 0.0)] {
            let mut ties = 0;
            for pair in 0..PAIRS {
                // Twenty steps on either side of 500, where a step changes by less than a tenth
                // for D24; for D16 within one step.
                let offset = match format {
                    DepthFormat::D16 => f64::from(pair) / f64::from(PAIRS) - 0.5,
                    _ => f64::from(pair) * 0.37,
                };
                let near = 500.0 + offset * step(format);
                let far = near + part * step(format);
                let sheets = [near, far]
                    .map(|z| rectangle([-900.0, -900.0], [900.0, 900.0], z as f32))
                    .concat();
                let seen = depth_buffered(&standard_scene(&sheets), format).visible[144].unwrap();
                ties += u32::from(seen.tie);
                assert!(seen.triangle.get() < 2, "{format:?}: {near} before {far}");
            }
            let share = f64::from(ties) / f64::from(PAIRS);
            // Sixty places, evenly spread over the step: the share is known to a tenth or so.
            assert!((share - expected).abs() < 0.12, "{format:?}, {part} of a step: {share}");
        }
    }
}
