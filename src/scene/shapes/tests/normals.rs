//! Normals are those of the true surface, unit, and on the outer side of their triangles.

use super::super::topology::{check_attributes, dot};
use super::super::*;
use super::samples;

#[test]
fn normals_are_unit_and_on_the_side_of_the_winding() {
    for shape in samples() {
        let least = check_attributes(&build(&shape).expect("in range"));
        assert!(least > 0.0, "{shape:?}: {least}");
    }
}

/// Each normal with the position it stands at.
fn at_corners(part: &MeshPart) -> impl Iterator<Item = ([f64; 3], [f64; 3])> + '_ {
    let corners = part.corners.iter().flatten().zip(part.corner_normals.iter().flatten());
    corners.map(|(&p, &n)| (part.positions[p as usize], part.normals[n as usize]))
}

fn assert_near(found: [f64; 3], expected: [f64; 3], bound: f64) {
    for (a, b) in found.into_iter().zip(expected) {
        assert!((a - b).abs() <= bound, "{found:?} is not {expected:?}");
    }
}

#[test]
fn sphere_normals_are_the_position_made_unit() {
    // One rounding each for position, length and quotient, and that of the normal's own components.
    const BOUND: f64 = 4.0 * f64::EPSILON;
    for shape in [
        Shape::UvSphere(UvSphere { radius: 0.3, around: 37, rings: 19 }),
        Shape::Icosphere(Icosphere { radius: 0.3, level: 4 }),
    ] {
        for (p, n) in at_corners(&build(&shape).expect("in range")) {
            let length = dot(p, p).sqrt();
            assert_near(n, p.map(|c| c / length), BOUND);
        }
    }
}

#[test]
fn torus_normals_point_away_from_the_centre_line() {
    let torus = Torus { major: 1.0, minor: 0.25, around: 37, across: 19 };
    // Positions near 1 differ from the centre line by 0.25: four times a few roundings.
    const BOUND: f64 = 16.0 * f64::EPSILON;
    for (p, n) in at_corners(&build(&Shape::Torus(torus)).expect("in range")) {
        let distance = (p[0] * p[0] + p[2] * p[2]).sqrt();
        let centre = [p[0] / distance, 0.0, p[2] / distance];
        assert_near(n, [0, 1, 2].map(|k| (p[k] - centre[k]) / 0.25), BOUND);
    }
}

#[test]
fn cylinder_and_cone_normals_are_square_on_their_lines() {
    // Components up to 1 with a few roundings each.
    const BOUND: f64 = 8.0 * f64::EPSILON;
    let cylinder = Cylinder { radius: 0.5, height: 2.0, around: 37, stacks: 3, caps: false };
    for (p, n) in at_corners(&build(&Shape::Cylinder(cylinder)).expect("in range")) {
        assert_near(n, [2.0 * p[0], 0.0, 2.0 * p[2]], BOUND);
    }
    // Radius 3, height 4: the normal rises by 3 for every 4 outwards.
    let cone = Cone { radius: 3.0, height: 4.0, around: 37, stacks: 3, caps: false };
    for (p, n) in at_corners(&build(&Shape::Cone(cone)).expect("in range")) {
        let distance = (p[0] * p[0] + p[2] * p[2]).sqrt();
        if distance == 0.0 {
            assert_eq!(p, [0.0, 4.0, 0.0]);
            assert_near([n[1], (n[0] * n[0] + n[2] * n[2]).sqrt(), 0.0], [0.6, 0.8, 0.0], BOUND);
        } else {
            assert_near(n, [0.8 * p[0] / distance, 0.6, 0.8 * p[2] / distance], BOUND);
        }
    }
}

#[test]
fn boxes_and_planes_have_face_normals() {
    for shape in samples().into_iter().filter(|s| matches!(s, Shape::Box(_) | Shape::Plane(_))) {
        let part = build(&shape).expect("in range");
        // Right triangles with legs along axes have exact normals up to the quotient's rounding.
        assert!(check_attributes(&part) >= 1.0 - 2.0 * f64::EPSILON, "{shape:?}");
    }
}

#[test]
fn texture_squares_stand_upright_on_a_box() {
    // On the four sides, t grows with y; on all faces the origin is bottom left seen from outside,
    // which the sign of every texture triangle has shown.
    let part = build(&Shape::Box(Cuboid { size: [2.0; 3], segments: 3 })).expect("in range");
    for (corners, uvs) in part.corners.iter().zip(&part.corner_uvs) {
        for (corner, uv) in corners.iter().zip(uvs) {
            let ([x, y, z], [_, t]) = (part.positions[*corner as usize], part.uvs[*uv as usize]);
            let on_side = x.abs() == 1.0 || z.abs() == 1.0;
            // Corners of top and bottom lie on the sides, too: only inner heights tell.
            if on_side && y.abs() < 1.0 {
                // t is a third or two, y a third of ±1: one rounding each.
                assert!((2.0 * t - 1.0 - y).abs() <= 2.0 * f64::EPSILON);
            }
        }
    }
}
