//! Planes so close that only exact depths tell them apart.

use super::*;

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
