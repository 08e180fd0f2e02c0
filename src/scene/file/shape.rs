//! `shape = { NAME = { … } }` of a mesh: the keys of generated shapes.
//!
//! Only names and defaults; ranges are checked where the shape is built. Names of two words may be
//! written with a hyphen. The structs here mirror those of `scene::shapes` field by field; serde's
//! `remote` makes the compiler compare them.

use crate::scene::shapes::{
    Cone, Cuboid, Cylinder, Hall, Icosphere, Plane, Shape, Soup, Teapot, TeapotField, Terrain,
    Torus, UvSphere,
};
use serde::{Deserialize, Deserializer};

/// A shape as it is written: a table with one key, the shape's name, whose value is a table of
/// parameters. A parameter that is left out has its default.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum ShapeFile {
    /// `uv_sphere = { radius, around, rings }`
    #[serde(alias = "uv-sphere", with = "UvSphereKeys")]
    UvSphere(UvSphere),
    /// `icosphere = { radius, level }`
    #[serde(with = "IcosphereKeys")]
    Icosphere(Icosphere),
    /// `torus = { major, minor, around, across }`
    #[serde(with = "TorusKeys")]
    Torus(Torus),
    /// `plane = { width, depth, columns, rows }`
    #[serde(with = "PlaneKeys")]
    Plane(Plane),
    /// `box = { size, segments }`; `size` is one number or three
    #[serde(with = "CuboidKeys")]
    Box(Cuboid),
    /// `cylinder = { radius, height, around, stacks, caps }`
    #[serde(with = "CylinderKeys")]
    Cylinder(Cylinder),
    /// `cone = { radius, height, around, stacks, caps }`
    #[serde(with = "ConeKeys")]
    Cone(Cone),
    /// `teapot = { segments, lid, bottom }`
    #[serde(with = "TeapotKeys")]
    Teapot(Teapot),
    /// `terrain = { size, height, cells, seed }`: 2 · cells² triangles, `cells` at most 2896
    #[serde(with = "TerrainKeys")]
    Terrain(Terrain),
    /// `soup = { count, size, extent, seed }`: `count` triangles, at most 16777216
    #[serde(with = "SoupKeys")]
    Soup(Soup),
    /// `hall = { columns, detail }`: `columns` in each of two rows
    #[serde(with = "HallKeys")]
    Hall(Hall),
    /// `teapot_field = { columns, rows, spacing, level }`
    #[serde(alias = "teapot-field", with = "TeapotFieldKeys")]
    TeapotField(TeapotField),
}

impl ShapeFile {
    /// The shape that is meant; its parameters may still be out of range.
    pub fn to_shape(&self) -> Shape {
        match self.clone() {
            Self::UvSphere(sphere) => Shape::UvSphere(sphere),
            Self::Icosphere(sphere) => Shape::Icosphere(sphere),
            Self::Torus(torus) => Shape::Torus(torus),
            Self::Plane(plane) => Shape::Plane(plane),
            Self::Box(cuboid) => Shape::Box(cuboid),
            Self::Cylinder(cylinder) => Shape::Cylinder(cylinder),
            Self::Cone(cone) => Shape::Cone(cone),
            Self::Teapot(teapot) => Shape::Teapot(teapot),
            Self::Terrain(terrain) => Shape::Terrain(terrain),
            Self::Soup(soup) => Shape::Soup(soup),
            Self::Hall(hall) => Shape::Hall(hall),
            Self::TeapotField(field) => Shape::TeapotField(field),
        }
    }
}

#[derive(Deserialize)]
#[serde(remote = "UvSphere", default = "UvSphere::default", deny_unknown_fields)]
struct UvSphereKeys {
    radius: f64,
    around: u32,
    rings: u32,
}

#[derive(Deserialize)]
#[serde(remote = "Icosphere", default = "Icosphere::default", deny_unknown_fields)]
struct IcosphereKeys {
    radius: f64,
    level: u32,
}

#[derive(Deserialize)]
#[serde(remote = "Torus", default = "Torus::default", deny_unknown_fields)]
struct TorusKeys {
    major: f64,
    minor: f64,
    around: u32,
    across: u32,
}

#[derive(Deserialize)]
#[serde(remote = "Plane", default = "Plane::default", deny_unknown_fields)]
struct PlaneKeys {
    width: f64,
    depth: f64,
    columns: u32,
    rows: u32,
}

#[derive(Deserialize)]
#[serde(remote = "Cuboid", default = "Cuboid::default", deny_unknown_fields)]
struct CuboidKeys {
    #[serde(deserialize_with = "one_or_three")]
    size: [f64; 3],
    segments: u32,
}

#[derive(Deserialize)]
#[serde(remote = "Cylinder", default = "Cylinder::default", deny_unknown_fields)]
struct CylinderKeys {
    radius: f64,
    height: f64,
    around: u32,
    stacks: u32,
    caps: bool,
}

#[derive(Deserialize)]
#[serde(remote = "Cone", default = "Cone::default", deny_unknown_fields)]
struct ConeKeys {
    radius: f64,
    height: f64,
    around: u32,
    stacks: u32,
    caps: bool,
}

#[derive(Deserialize)]
#[serde(remote = "Teapot", default = "Teapot::default", deny_unknown_fields)]
struct TeapotKeys {
    segments: u32,
    lid: bool,
    bottom: bool,
}

#[derive(Deserialize)]
#[serde(remote = "Terrain", default = "Terrain::default", deny_unknown_fields)]
struct TerrainKeys {
    size: f64,
    height: f64,
    cells: u32,
    seed: u32,
}

#[derive(Deserialize)]
#[serde(remote = "Soup", default = "Soup::default", deny_unknown_fields)]
struct SoupKeys {
    count: u32,
    size: f64,
    extent: f64,
    seed: u32,
}

#[derive(Deserialize)]
#[serde(remote = "Hall", default = "Hall::default", deny_unknown_fields)]
struct HallKeys {
    columns: u32,
    detail: u32,
}

#[derive(Deserialize)]
#[serde(remote = "TeapotField", default = "TeapotField::default", deny_unknown_fields)]
struct TeapotFieldKeys {
    columns: u32,
    rows: u32,
    spacing: f64,
    level: u32,
}

/// Reads one number for all axes, or three.
fn one_or_three<'de, D: Deserializer<'de>>(deserializer: D) -> Result<[f64; 3], D::Error> {
    #[derive(Deserialize)]
    #[serde(untagged, expecting = "size must be one number or three: [x, y, z]")]
    enum Size {
        One(f64),
        Three([f64; 3]),
    }
    Ok(match Size::deserialize(deserializer)? {
        Size::One(size) => [size; 3],
        Size::Three(sizes) => sizes,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::shapes::build;

    #[derive(Deserialize)]
    struct Written {
        shape: ShapeFile,
    }

    fn parse(shape: &str) -> Result<Shape, String> {
        let text = format!("shape = {{ {shape} }}");
        let written: Result<Written, _> = toml::from_str(&text);
        written.map(|w| w.shape.to_shape()).map_err(|e| e.to_string())
    }

    #[test]
    fn every_parameter_of_every_shape_is_read() {
        let written = [
            (
                "uv_sphere = { radius = 2, around = 5, rings = 4 }",
                Shape::UvSphere(UvSphere { radius: 2.0, around: 5, rings: 4 }),
            ),
            (
                "icosphere = { radius = 0.5, level = 1 }",
                Shape::Icosphere(Icosphere { radius: 0.5, level: 1 }),
            ),
            (
                "torus = { major = 2, minor = 0.5, around = 7, across = 6 }",
                Shape::Torus(Torus { major: 2.0, minor: 0.5, around: 7, across: 6 }),
            ),
            (
                "plane = { width = 3, depth = 4, columns = 5, rows = 6 }",
                Shape::Plane(Plane { width: 3.0, depth: 4.0, columns: 5, rows: 6 }),
            ),
            (
                "box = { size = [1, 2.5, 3], segments = 2 }",
                Shape::Box(Cuboid { size: [1.0, 2.5, 3.0], segments: 2 }),
            ),
            ("box = { size = 4 }", Shape::Box(Cuboid { size: [4.0; 3], segments: 1 })),
            (
                "cylinder = { radius = 2, height = 3, around = 5, stacks = 4, caps = false }",
                Shape::Cylinder(Cylinder {
                    radius: 2.0,
                    height: 3.0,
                    around: 5,
                    stacks: 4,
                    caps: false,
                }),
            ),
            (
                "cone = { radius = 2, height = 3, around = 5, stacks = 4, caps = false }",
                Shape::Cone(Cone { radius: 2.0, height: 3.0, around: 5, stacks: 4, caps: false }),
            ),
            (
                "teapot = { segments = 3, lid = false, bottom = false }",
                Shape::Teapot(Teapot { segments: 3, lid: false, bottom: false }),
            ),
            (
                "terrain = { size = 3, height = 0.5, cells = 4, seed = 9 }",
                Shape::Terrain(Terrain { size: 3.0, height: 0.5, cells: 4, seed: 9 }),
            ),
            (
                "soup = { count = 5, size = 0.5, extent = 3, seed = 9 }",
                Shape::Soup(Soup { count: 5, size: 0.5, extent: 3.0, seed: 9 }),
            ),
            ("hall = { columns = 2, detail = 1 }", Shape::Hall(Hall { columns: 2, detail: 1 })),
            (
                "teapot_field = { columns = 2, rows = 3, spacing = 8, level = 0 }",
                Shape::TeapotField(TeapotField { columns: 2, rows: 3, spacing: 8.0, level: 0 }),
            ),
        ];
        for (text, expected) in written {
            assert_eq!(parse(text), Ok(expected.clone()), "{text}");
            assert!(text.starts_with(expected.name()));
            assert!(build(&expected).is_ok(), "{text}");
        }
    }

    #[test]
    fn what_is_left_out_has_its_default() {
        let written = [
            ("uv_sphere", Shape::UvSphere(UvSphere::default())),
            ("uv-sphere", Shape::UvSphere(UvSphere::default())),
            ("icosphere", Shape::Icosphere(Icosphere::default())),
            ("torus", Shape::Torus(Torus::default())),
            ("plane", Shape::Plane(Plane::default())),
            ("box", Shape::Box(Cuboid::default())),
            ("cylinder", Shape::Cylinder(Cylinder::default())),
            ("cone", Shape::Cone(Cone::default())),
            ("teapot", Shape::Teapot(Teapot::default())),
            ("terrain", Shape::Terrain(Terrain::default())),
            ("soup", Shape::Soup(Soup::default())),
            ("hall", Shape::Hall(Hall::default())),
            ("teapot_field", Shape::TeapotField(TeapotField::default())),
            ("teapot-field", Shape::TeapotField(TeapotField::default())),
        ];
        for (name, expected) in written {
            assert_eq!(parse(&format!("{name} = {{}}")), Ok(expected), "{name}");
        }
    }

    #[test]
    fn what_is_not_meant_is_refused_by_name() {
        let refused = [
            ("sphere = {}", "sphere"),
            ("torus = { majr = 1 }", "majr"),
            ("teapot = { segments = -1 }", "-1"),
            ("box = { size = [1, 2] }", "one number or three"),
            ("box = { size = \"big\" }", "one number or three"),
        ];
        for (text, word) in refused {
            let message = parse(text).expect_err(text);
            assert!(message.contains(word), "{message}");
        }
        assert!(parse("torus = {}, plane = {}").is_err());
    }
}
