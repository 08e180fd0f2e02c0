//! A scene as it is meant: checked, complete and total. What was written is `file::SceneFile`.
//!
//! Everything after loading can rely on it: positions are finite and in range, normals are unit,
//! every index is valid, every light and material is evaluable. No visibility, no shading here.

mod assemble;
pub mod camera;
pub mod error;
pub mod file;
pub mod hash;
pub(crate) mod lattice;
pub mod light;
pub mod light_point;
mod load;
pub mod material;
pub mod obj;
pub mod part;
mod resolve;
pub mod sampling;
pub mod shapes;
pub mod switches;
pub mod texture;
pub(crate) mod transform;
mod vertex_normals;

pub use load::{Overrides, SceneErrors};

use crate::color::LinearRgb;
use crate::mesh::{TriangleId, TriangleMesh};
use camera::PinholeCamera;
use light::Light;
use material::Material;
use sampling::SampleGrid;
use std::ops::Range;
use std::path::PathBuf;
use switches::Switches;
use texture::Texture;

/// Everything that a picture depends on.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The camera, and with it the resolution.
    pub camera: PinholeCamera,
    /// Radiance where nothing is visible.
    pub background: LinearRgb,
    /// Samples per pixel for colour and alpha; every other plane is of the pixel centre.
    pub samples: SampleGrid,
    /// All triangles, world space, in the order of ids.
    pub mesh: TriangleMesh,
    /// The meshes of the file, in order; their triangle ranges follow each other without gaps.
    pub objects: Vec<Object>,
    /// Materials; triangles refer to them by position.
    pub materials: Vec<Material>,
    /// The textures that the materials of triangles refer to by position, each file once.
    pub textures: Vec<Texture>,
    /// Per triangle, position in `materials`.
    pub triangle_materials: Vec<u32>,
    /// Lights, in file order.
    pub lights: Vec<Light>,
    /// Name of each light: the scene file's, else its place there, such as `light[0]`.
    pub light_names: Vec<String>,
    /// The switches of the shading equation.
    pub switches: Switches,
    /// Things a user should know that are no errors.
    pub warnings: Vec<String>,
}

/// One `[[mesh]]` of the scene file.
#[derive(Clone, Debug)]
pub struct Object {
    /// File name or shape name.
    pub name: String,
    /// Its triangles' ids.
    pub triangles: Range<u32>,
    /// How normals vary over a triangle.
    pub shading: Shading,
    /// Whether the shading normal turns towards the eye.
    pub sides: Sides,
    /// Where its triangles were written.
    pub source: Source,
}

/// Where a mesh comes from.
#[derive(Clone, Debug)]
pub enum Source {
    /// Made by a generator of that name.
    Shape(String),
    /// Read from a file.
    File {
        /// The file.
        path: PathBuf,
        /// 1-based line of the face of each triangle.
        lines: Vec<u32>,
    },
}

/// How normals vary over a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shading {
    /// Corner normals are interpolated, and each sample is lit.
    Phong,
    /// The corners are lit, and their colours interpolated.
    Gouraud,
    /// One normal for the whole triangle; what that means, the switch `flat` says.
    Flat,
    /// The colours of the vertices are interpolated; nothing is lit.
    VertexColor,
}

impl Shading {
    /// Every way with its word in scene files.
    pub const NAMED: [(Self, &'static str); 4] = [
        (Self::Phong, "phong"),
        (Self::Gouraud, "gouraud"),
        (Self::Flat, "flat"),
        (Self::VertexColor, "vertex-color"),
    ];
}

/// Whether the shading normal turns towards the eye.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Sides {
    /// The normal is used as given.
    #[default]
    Single,
    /// The shading normal turns when the face normal points away from the eye.
    Double,
}

impl Scene {
    /// A scene of bare triangles in the order given: default material, no lights, black
    /// background. For programs that only ask what is visible.
    ///
    /// # Panics
    /// When a position is not finite or larger than 2^126, or there are too many triangles.
    pub fn from_triangles(camera: PinholeCamera, triangles: &[[[f32; 3]; 3]]) -> Self {
        assert!(triangles.len() <= TriangleId::MAX_COUNT / 3, "too many triangles");
        let positions: Vec<[f32; 3]> = triangles.iter().flatten().copied().collect();
        let largest = positions.iter().flatten().fold(0.0_f32, |m, c| {
            assert!(c.is_finite(), "positions are finite");
            m.max(c.abs())
        });
        assert!(f64::from(largest) <= lattice::power_of_two(126), "positions are at most 2^126");
        let count = triangles.len() as u32;
        Self {
            camera,
            background: [0.0; 3],
            samples: SampleGrid::CENTRE,
            mesh: TriangleMesh {
                positions,
                corners: (0..count).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
                ..TriangleMesh::default()
            },
            objects: vec![Object {
                name: "triangles".to_owned(),
                triangles: 0..count,
                shading: Shading::Phong,
                sides: Sides::Single,
                source: Source::Shape("triangles".to_owned()),
            }],
            materials: vec![Material::default_named("default")],
            textures: Vec::new(),
            triangle_materials: vec![0; triangles.len()],
            lights: Vec::new(),
            light_names: Vec::new(),
            switches: Switches::default(),
            warnings: Vec::new(),
        }
    }

    /// The object that a triangle belongs to, and its position in `objects`.
    pub fn object_of(&self, id: TriangleId) -> (usize, &Object) {
        let index = self.objects.partition_point(|object| object.triangles.end <= id.get());
        (index, &self.objects[index])
    }

    /// The material of a triangle, and its position in `materials`.
    pub fn material_of(&self, id: TriangleId) -> (usize, &Material) {
        let index = self.triangle_materials[id.index()] as usize;
        (index, &self.materials[index])
    }

    /// Whether nothing is seen through a triangle.
    pub fn is_opaque(&self, id: TriangleId) -> bool {
        self.material_of(id).1.opacity == 1.0
    }

    /// Where a triangle was written: `file.obj:line`, or the shape and the triangle's number in it.
    pub fn describe_source(&self, id: TriangleId) -> String {
        let (_, object) = self.object_of(id);
        let local = id.get() - object.triangles.start;
        match &object.source {
            Source::Shape(name) => format!("{name}#{local}"),
            Source::File { path, lines } => match lines.get(local as usize) {
                Some(line) => format!("{}:{line}", path.display()),
                None => format!("{}#{local}", path.display()),
            },
        }
    }
}
