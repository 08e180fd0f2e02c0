//! Closed shapes are closed, oriented outwards and of the right genus and volume.

use super::super::topology::{volume, weld};
use super::super::*;
use super::samples;
use std::f64::consts::{PI, TAU};

#[test]
fn closed_shapes_are_closed_and_the_others_have_the_edges_they_should() {
    for shape in samples() {
        let welded = weld(&build(&shape).expect("in range"));
        let (euler, boundary) = match &shape {
            Shape::Torus(_) => (0, 0),
            Shape::Plane(plane) => (1, 2 * (plane.columns + plane.rows)),
            Shape::Cylinder(Cylinder { caps: false, around, .. }) => (0, 2 * around),
            Shape::Cone(Cone { caps: false, around, .. }) => (1, *around),
            _ => (2, 0),
        };
        assert_eq!((welded.euler, welded.boundary), (euler, boundary as usize), "{shape:?}");
    }
}

/// Volume inside a profile of (distance, height), from above downwards, carried around the axis in
/// `around` flat steps: frusta over regular polygons.
fn turned_volume(profile: &[[f64; 2]], around: u32) -> f64 {
    let n = f64::from(around);
    let area = 0.5 * n * (TAU / n).sin();
    let frustum = |[d, y]: [f64; 2], [d2, y2]: [f64; 2]| (y - y2) * (d * d + d * d2 + d2 * d2);
    area / 3.0 * profile.windows(2).map(|pair| frustum(pair[0], pair[1])).sum::<f64>()
}

#[test]
fn volumes_are_those_of_the_polyhedra() {
    // Sums over at most 12 288 triangles, a few roundings each, of terms of one order of magnitude.
    const RELATIVE_BOUND: f64 = 1e-11;
    let mut compared = 0;
    for shape in samples() {
        let expected = match &shape {
            Shape::UvSphere(s) => {
                let angle = |k| PI * f64::from(k) / f64::from(s.rings);
                let point = |k| [s.radius * f64::sin(angle(k)), s.radius * f64::cos(angle(k))];
                turned_volume(&(0..=s.rings).map(point).collect::<Vec<_>>(), s.around)
            }
            Shape::Torus(t) => {
                let angle = |k| TAU * f64::from(k) / f64::from(t.across);
                let point =
                    |k| [t.major + t.minor * f64::cos(angle(k)), -t.minor * f64::sin(angle(k))];
                turned_volume(&(0..=t.across).map(point).collect::<Vec<_>>(), t.around)
            }
            Shape::Cylinder(c) if c.caps => {
                turned_volume(&[[c.radius, c.height], [c.radius, 0.0]], c.around)
            }
            Shape::Cone(c) if c.caps => {
                turned_volume(&[[0.0, c.height], [c.radius, 0.0]], c.around)
            }
            Shape::Box(cuboid) => cuboid.size.iter().product(),
            _ => continue,
        };
        let found = volume(&build(&shape).expect("in range"));
        assert!((found - expected).abs() <= RELATIVE_BOUND * expected, "{shape:?}: {found}");
        compared += 1;
    }
    assert!(compared >= 14);
}

#[test]
fn refinement_quarters_the_missing_volume() {
    // The second-order term dominates at these finenesses; the next is below 5 % of it.
    const RATIO: std::ops::Range<f64> = 3.8..4.2;
    let of = |shape: Shape| volume(&build(&shape).expect("in range"));
    let sphere = |n| of(Shape::UvSphere(UvSphere { radius: 1.0, around: 2 * n, rings: n }));
    let icosphere = |level| of(Shape::Icosphere(Icosphere { radius: 1.0, level }));
    let torus = |n| of(Shape::Torus(Torus { major: 1.0, minor: 0.35, around: n, across: n }));
    let ball = 4.0 / 3.0 * PI;
    let ring = 2.0 * PI * PI * 0.35 * 0.35;
    for (whole, coarse, fine) in [
        (ball, sphere(12), sphere(24)),
        (ball, icosphere(3), icosphere(4)),
        (ring, torus(24), torus(48)),
    ] {
        assert!(coarse < fine && fine < whole);
        assert!(RATIO.contains(&((whole - coarse) / (whole - fine))));
    }
}

#[test]
fn spheres_and_torus_pass_through_exact_points() {
    let has = |shape: Shape, point: [f64; 3]| {
        let part = build(&shape).expect("in range");
        assert!(part.positions.contains(&point), "{shape:?} lacks {point:?}");
    };
    let axes = |length: f64| {
        (0..3).flat_map(move |axis| {
            [length, -length].map(|value| {
                let mut point = [0.0; 3];
                point[axis] = value;
                point
            })
        })
    };
    for point in axes(1.3) {
        has(Shape::UvSphere(UvSphere { radius: 1.3, around: 12, rings: 6 }), point);
        has(Shape::Icosphere(Icosphere { radius: 1.3, level: 1 }), point);
        has(Shape::Icosphere(Icosphere { radius: 1.3, level: 3 }), point);
    }
    for point in axes(1.25).filter(|point| point[1] == 0.0) {
        has(Shape::Torus(Torus { major: 1.0, minor: 0.25, around: 12, across: 8 }), point);
    }
    has(Shape::Torus(Torus { major: 1.0, minor: 0.25, around: 12, across: 8 }), [1.0, 0.25, 0.0]);
    let sphere = build(&Shape::UvSphere(UvSphere::default())).expect("in range");
    assert_eq!(sphere.positions.iter().filter(|p| p[1] == 0.0).count(), 48);
    assert_eq!(sphere.positions.len(), 2 + 23 * 48);
}
