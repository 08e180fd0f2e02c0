//! The shape of the tree: obvhs clusters boxes, and only the shape is taken from it.
//!
//! obvhs computes areas in f32: they overflow from coordinates of 10¹⁹ (infinite costs, then NaN,
//! then a panic), vanish for small boxes far from the origin, and tie on regular grids, where its
//! clustering then merges one pair per pass. So it is given *stand-ins*: boxes moved to the median
//! of the scene, scaled by a power of two and moved apart by less than it matters. A stand-in
//! bounds nothing; the boxes that rays are tested against come from the triangles.

use super::bounds::Bounds;
use super::preset::BuildPreset;
use glam::Vec3A;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2;
use std::time::Duration;

/// Binary exponent of the largest stand-in coordinate. Areas then stay below 3·(2^51)² < 2^104,
/// so that the sums of areas along any path are finite, and boxes of 2^-74, 2^-124 of the scene,
/// still have an area in f32.
const LARGEST_EXPONENT: i32 = 50;

/// A tree over the boxes, at least one.
pub(super) fn cluster(boxes: Vec<Bounds>, preset: BuildPreset) -> Bvh2 {
    let stand_ins = stand_ins(&boxes);
    drop(boxes);
    build_bvh2(&stand_ins, preset.parameters(), &mut Duration::default())
}

fn stand_ins(boxes: &[Bounds]) -> Vec<Aabb> {
    let origin = median_center(boxes);
    let reach = boxes
        .iter()
        .flat_map(|bounds| [bounds.lo, bounds.hi])
        .flat_map(|corner| {
            std::array::from_fn::<_, 3, _>(|k| (f64::from(corner[k]) - origin[k]).abs())
        })
        .fold(f64::MIN_POSITIVE, f64::max);
    let scale = 2.0_f64.powi(LARGEST_EXPONENT - reach.log2().ceil() as i32);
    boxes
        .iter()
        .enumerate()
        .map(|(index, bounds)| {
            let largest_side = bounds.sides().into_iter().fold(0.0, f64::max);
            // Break ties: grow each face by up to 1/64 of the box, or by 2^-20 of its distance
            // where f32 would lose that.
            let face = |k: usize, value: f32, outwards: f64, number: u64| {
                let position = (f64::from(value) - origin[k]) * scale;
                let room = largest_side * scale / 64.0 + position.abs() / f64::from(1 << 20);
                (position + outwards * room * fraction(index as u64 * 6 + number)) as f32
            };
            let corner = |corner: [f32; 3], outwards: f64, number: u64| {
                Vec3A::from_array(std::array::from_fn(|k| {
                    face(k, corner[k], outwards, number + k as u64)
                }))
            };
            Aabb::new(corner(bounds.lo, -1.0, 0), corner(bounds.hi, 1.0, 3))
        })
        .collect()
}

/// The componentwise median of about a thousand centres: most of a scene lies near it, so that is
/// where f32 should be fine.
fn median_center(boxes: &[Bounds]) -> [f64; 3] {
    let step = boxes.len().div_ceil(1024).max(1);
    std::array::from_fn(|k| {
        let mut centers: Vec<f64> =
            boxes.iter().step_by(step).map(|bounds| bounds.center2()[k] * 0.5).collect();
        let middle = centers.len() / 2;
        *centers.select_nth_unstable_by(middle, f64::total_cmp).1
    })
}

/// A fixed pseudo-random number in [0, 1) for each input (the finalizer of SplitMix64).
fn fraction(number: u64) -> f64 {
    let mut z = number.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    (z >> 40) as f64 / f64::from(1 << 24)
}
