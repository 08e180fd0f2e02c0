//! Normals that cancel, are transformed, or belong to tiny faces: S10, S11, S22.

use super::*;

/// Two triangles that share an edge through the origin, with these normals at its ends.
pub(super) fn hinge(left: V3, right: V3) -> String {
    let vn = |[x, y, z]: V3| format!("vn {x:?} {y:?} {z:?}\n");
    format!(
        "v -4 0 0\nv 4 0 0\nv 0 4 0\nv 0 -4 0\n{}{}vn 0 0 1\nf 1//1 2//2 3//3\nf 2//2 1//1 4//3\n",
        vn(left),
        vn(right)
    )
}

#[test]
fn s10_normals_that_cancel_give_way_to_the_face() {
    let at = |z: f64| {
        let view = view([0.0, 0.0, 8.0], [0.0, 0.0, -8.0]);
        let obj = hinge([1.0, 0.0, z], [-1.0, 0.0, z]);
        let shaded = Setup::of(view, obj).lit(&directional([0.6, 0.0, 0.8])).shaded();
        (shaded.radiance[0][0], shaded.notes.cancelled_normals)
    };
    // ½(1, 0, 0) + ½(−1, 0, 0); and with a meaningless rest that points into the surface.
    for z in [0.0, -0.0, -1e-7, 1e-7, -5e-324] {
        let (value, cancelled) = at(z);
        assert_near(value, 0.8, TOLERANCE);
        assert_eq!(cancelled, 1, "{z:e}");
    }
    // From 1e-6 of a unit length on, it has a meaning.
    assert_eq!(at(-1e-5), (0.0, 0));
    let (value, cancelled) = at(1e-5);
    assert_near(value, 0.8, TOLERANCE);
    assert_eq!(cancelled, 0);
}

/// N of the plate with the normal (0.6, 0, 0.8) under a transform, by its three cosines.
fn normal_under(transform: &str) -> V3 {
    let along = |axis: V3| {
        let cosine = |to_light: V3| {
            Setup::plate([0.6, 0.0, 0.8]).meshed(transform).lit(&directional(to_light)).value()
        };
        cosine(axis) - cosine(axis.map(|c| -c))
    };
    [along([1.0, 0.0, 0.0]), along([0.0, 1.0, 0.0]), along([0.0, 0.0, 1.0])]
}

#[track_caller]
fn assert_normal(transform: &str, right: V3) {
    let normal = normal_under(transform);
    for k in 0..3 {
        assert!((normal[k] - right[k]).abs() <= TOLERANCE, "{transform}: {normal:?}");
    }
}

#[test]
fn s11_normals_survive_every_transform() {
    // Flattened: the inverse does not exist.
    assert_normal("scale = [1, 1, 0]\n", [0.0, 0.0, 1.0]);
    // Determinants of 1e-60, 1e39 and 1e-69.
    for scale in ["1e-20", "1e13", "1e-23"] {
        assert_normal(&format!("scale = {scale}\n"), [0.6, 0.0, 0.8]);
    }
    // A mirror: the outward side stays outward.
    assert_normal("scale = [-1, 1, 1]\n", [-0.6, 0.0, 0.8]);
    assert_normal(
        "matrix = [[0, 1, 0, 0], [1, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]\n",
        [0.0, 0.6, 0.8],
    );
    // Uneven: (0.6/3, 0, 0.8/1) = (1, 0, 4)/√17.
    let length = 17.0_f64.sqrt();
    assert_normal("scale = [3, 5, 1]\n", [1.0 / length, 0.0, 4.0 / length]);
}

#[test]
fn s22_a_tiny_face_has_its_normal() {
    // Corners s·(±4, ∓1, ∓3)…, in the plane with the normal (3, 0, 4)/5; s = 2^-40 is about 1e-12,
    // and in f32 the products underflow from 2^-75 on.
    for exponent in [0, -40, -75, -100] {
        let s = 2.0_f64.powi(exponent);
        let corner =
            |p: f64, q: f64| format!("v {:?} {:?} {:?}\n", 4.0 * p * s, q * s, -3.0 * p * s);
        let corners = corner(-1.0, -1.0) + &corner(1.0, -1.0) + &corner(0.0, 1.0);
        let view = view([0.0, 0.0, 8.0], [0.0, 0.0, -8.0]);
        let setup = Setup::of(view, format!("{corners}f 1 2 3\n")).meshed("shading = \"flat\"\n");
        let shaded = setup.lit(&directional(UP)).shaded();
        assert_near(shaded.radiance[0][0], 0.8, TOLERANCE);
        assert_eq!(shaded.notes.missing_normals, 0);
    }
}
