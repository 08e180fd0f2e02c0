//! Tests of all shapes together, by property.

mod closed;
mod generated;
mod normals;
mod ranges;
mod teapot;

use super::*;

/// Every shape but the teapot and those for scenes of many triangles: coarsest, odd, default and lopsided.
fn samples() -> Vec<Shape> {
    let sphere = |radius, around, rings| Shape::UvSphere(UvSphere { radius, around, rings });
    let torus = |major, minor, around, across| Shape::Torus(Torus { major, minor, around, across });
    let cylinder = |around, stacks, caps| {
        Shape::Cylinder(Cylinder { radius: 0.7, height: 3.1, around, stacks, caps })
    };
    let cone =
        |around, stacks, caps| Shape::Cone(Cone { radius: 0.7, height: 3.1, around, stacks, caps });
    let plane = |columns, rows| Shape::Plane(Plane { width: 0.3, depth: 7.0, columns, rows });
    let mut samples = vec![
        sphere(1.0, 3, 2),
        sphere(0.1, 7, 5),
        sphere(3.0, 200, 2),
        Shape::UvSphere(UvSphere::default()),
        torus(1.0, 0.35, 3, 3),
        torus(0.7, 0.1, 5, 7),
        torus(2.0, 1.9, 8, 4),
        Shape::Torus(Torus::default()),
        plane(1, 1),
        plane(3, 8),
        Shape::Plane(Plane::default()),
        Shape::Box(Cuboid::default()),
        Shape::Box(Cuboid { size: [0.1, 0.7, 3.3], segments: 7 }),
        cylinder(3, 1, true),
        cylinder(13, 3, true),
        cylinder(13, 3, false),
        Shape::Cylinder(Cylinder::default()),
        cone(3, 1, true),
        cone(13, 3, true),
        cone(13, 3, false),
        Shape::Cone(Cone::default()),
    ];
    let icosphere = |level| Shape::Icosphere(Icosphere { radius: 0.3, level });
    samples.extend((0..=5).map(icosphere));
    samples
}
