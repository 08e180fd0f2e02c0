//! Parameters out of range are refused by name and never panic; those at the ends work.

use super::super::topology::{check_attributes, weld};
use super::super::*;

/// A shape with one length parameter set.
type WithLength = (&'static str, fn(f64) -> Shape);
/// A shape with one count parameter set, and the least value that works.
type WithCount = (&'static str, u32, fn(u32) -> Shape);

const LENGTHS: [WithLength; 18] = [
    ("radius", |radius| Shape::UvSphere(UvSphere { radius, ..UvSphere::default() })),
    ("radius", |radius| Shape::Icosphere(Icosphere { radius, ..Icosphere::default() })),
    ("major", |major| Shape::Torus(Torus { major, ..Torus::default() })),
    ("minor", |minor| Shape::Torus(Torus { minor, ..Torus::default() })),
    ("width", |width| Shape::Plane(Plane { width, ..Plane::default() })),
    ("depth", |depth| Shape::Plane(Plane { depth, ..Plane::default() })),
    ("size x", |x| Shape::Box(Cuboid { size: [x, 1.0, 1.0], ..Cuboid::default() })),
    ("size y", |y| Shape::Box(Cuboid { size: [1.0, y, 1.0], ..Cuboid::default() })),
    ("size z", |z| Shape::Box(Cuboid { size: [1.0, 1.0, z], ..Cuboid::default() })),
    ("radius", |radius| Shape::Cylinder(Cylinder { radius, ..Cylinder::default() })),
    ("height", |height| Shape::Cylinder(Cylinder { height, ..Cylinder::default() })),
    ("radius", |radius| Shape::Cone(Cone { radius, ..Cone::default() })),
    ("height", |height| Shape::Cone(Cone { height, ..Cone::default() })),
    ("size", |size| Shape::Terrain(Terrain { size, ..Terrain::default() })),
    ("height", |height| Shape::Terrain(Terrain { height, ..Terrain::default() })),
    ("size", |size| Shape::Soup(Soup { size, ..Soup::default() })),
    ("extent", |extent| Shape::Soup(Soup { extent, ..Soup::default() })),
    ("spacing", |spacing| Shape::TeapotField(TeapotField { spacing, ..TeapotField::default() })),
];

const COUNTS: [WithCount; 18] = [
    ("around", 3, |around| Shape::UvSphere(UvSphere { around, ..UvSphere::default() })),
    ("rings", 2, |rings| Shape::UvSphere(UvSphere { rings, ..UvSphere::default() })),
    ("level", 0, |level| Shape::Icosphere(Icosphere { level, ..Icosphere::default() })),
    ("around", 3, |around| Shape::Torus(Torus { around, ..Torus::default() })),
    ("across", 3, |across| Shape::Torus(Torus { across, ..Torus::default() })),
    ("columns", 1, |columns| Shape::Plane(Plane { columns, ..Plane::default() })),
    ("rows", 1, |rows| Shape::Plane(Plane { rows, ..Plane::default() })),
    ("segments", 1, |segments| Shape::Box(Cuboid { segments, ..Cuboid::default() })),
    ("around", 3, |around| Shape::Cylinder(Cylinder { around, ..Cylinder::default() })),
    ("stacks", 1, |stacks| Shape::Cylinder(Cylinder { stacks, ..Cylinder::default() })),
    ("around", 3, |around| Shape::Cone(Cone { around, ..Cone::default() })),
    ("stacks", 1, |stacks| Shape::Cone(Cone { stacks, ..Cone::default() })),
    ("segments", 2, |segments| Shape::Teapot(Teapot { segments, ..Teapot::default() })),
    ("columns", 1, |columns| Shape::Hall(Hall { columns, ..Hall::default() })),
    ("detail", 1, |detail| Shape::Hall(Hall { detail, ..Hall::default() })),
    ("columns", 1, |columns| Shape::TeapotField(TeapotField { columns, ..TeapotField::default() })),
    ("rows", 1, |rows| Shape::TeapotField(TeapotField { rows, ..TeapotField::default() })),
    ("level", 0, |level| Shape::TeapotField(TeapotField { level, ..TeapotField::default() })),
];

#[test]
fn lengths_out_of_range_are_refused_by_name() {
    for (parameter, with) in LENGTHS {
        for value in [f64::NAN, f64::INFINITY, -f64::INFINITY, -1.0, 0.0, -0.0, 9e-19, 2e18] {
            let error = build(&with(value)).expect_err(parameter);
            assert_eq!(error.shape, with(value).name());
            assert_eq!((error.parameter, error.value), (parameter, value.to_string()));
        }
    }
}

#[test]
fn counts_out_of_range_are_refused_by_name_before_anything_is_made() {
    for (parameter, least, with) in COUNTS {
        let error = build(&with(u32::MAX)).expect_err(parameter);
        assert!(error.parameter.contains(parameter), "{error}");
        assert!(error.range.contains("40000000 triangles"), "{error}");
        assert!(build(&with(least)).is_ok(), "{parameter} {least}");
        if least > 0 {
            let error = build(&with(least - 1)).expect_err(parameter);
            assert_eq!((error.parameter, error.value), (parameter, (least - 1).to_string()));
        }
    }
    let both = UvSphere { around: u32::MAX, rings: u32::MAX, ..UvSphere::default() };
    assert!(build(&Shape::UvSphere(both)).is_err());
    for (level, fits) in [(10, true), (11, false), (62, false), (64, false), (1 << 31, false)] {
        // What fits at level 10 takes seconds to make, so only what does not is asked for.
        assert!(fits || build(&Shape::Icosphere(Icosphere { radius: 1.0, level })).is_err());
    }
}

#[test]
fn a_torus_keeps_its_hole() {
    for (minor, fits) in
        [(2.0, false), (1.9999999, false), (1.99999, true), (2.1e-6, true), (1e-6, false)]
    {
        let torus = Torus { major: 2.0, minor, around: 12, across: 8 };
        assert_eq!(build(&Shape::Torus(torus)).is_ok(), fits, "{minor}");
    }
}

#[test]
fn shapes_at_the_ends_of_the_range_have_no_empty_triangles() {
    let [small, large] = [MIN_LENGTH, MAX_LENGTH];
    let cylinder = |radius, height| {
        Shape::Cylinder(Cylinder { radius, height, around: 12, stacks: 2, caps: true })
    };
    let cone =
        |radius, height| Shape::Cone(Cone { radius, height, around: 12, stacks: 2, caps: true });
    let torus = |major, minor| Shape::Torus(Torus { major, minor, around: 12, across: 12 });
    for shape in [
        Shape::UvSphere(UvSphere { radius: small, ..UvSphere::default() }),
        Shape::UvSphere(UvSphere { radius: large, around: 3, rings: 100_000 }),
        Shape::Icosphere(Icosphere { radius: large, level: 2 }),
        Shape::Box(Cuboid { size: [small, 1.0, large], segments: 3 }),
        cylinder(small, large),
        cylinder(large, small),
        cone(small, large),
        cone(large, small),
        torus(large, 1.1e-6 * large),
        torus(1e6 * small, 1.1 * small),
        torus(large, 0.999998 * large),
    ] {
        let part = build(&shape).expect("in range");
        assert!(check_attributes(&part) > 0.0, "{shape:?}");
        assert_eq!(weld(&part).boundary, 0, "{shape:?}");
    }
}

#[test]
fn an_error_says_all_there_is_to_say() {
    let torus = Torus { minor: -1.0, ..Torus::default() };
    let error = build(&Shape::Torus(torus)).expect_err("negative");
    assert_eq!(error.to_string(), "torus: minor is -1, but must be a length from 1e-18 to 1e18");
}
