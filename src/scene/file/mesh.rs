//! `[[material]]` and `[[mesh]]` as written.

use super::generated::GeneratedFile;
use super::keys::Keys;
use super::text::{Faults, Span};
use super::values::{matrix, number, numbers, one_or_three, text};
use toml::Spanned;

/// `[[material]]`.
#[derive(Clone, Debug)]
pub struct MaterialFile {
    /// Its name.
    pub name: Spanned<String>,
    /// Reflection of ambient light.
    pub ka: Option<Spanned<[f64; 3]>>,
    /// Diffuse reflection.
    pub kd: Option<Spanned<[f64; 3]>>,
    /// Specular reflection.
    pub ks: Option<Spanned<[f64; 3]>>,
    /// Emission.
    pub ke: Option<Spanned<[f64; 3]>>,
    /// Specular exponent.
    pub ns: Option<Spanned<f64>>,
    /// How much the surface hides.
    pub opacity: Option<Spanned<f64>>,
    /// Keys of textures that are written: `kd_map`, `ks_map`, `filter`, `wrap`.
    pub texture_keys: Vec<Spanned<String>>,
}

const TEXTURE_KEYS: [&str; 4] = ["kd_map", "ks_map", "filter", "wrap"];

impl MaterialFile {
    pub(super) fn read(mut keys: Keys<'_, '_>, faults: &mut Faults<'_>) -> Option<Self> {
        let name = keys.require("name", text, faults);
        let ka = keys.read("ka", numbers, faults);
        let kd = keys.read("kd", numbers, faults);
        let ks = keys.read("ks", numbers, faults);
        let ke = keys.read("ke", numbers, faults);
        let ns = keys.read("ns", number, faults);
        let opacity = keys.read("opacity", number, faults);
        for key in TEXTURE_KEYS {
            keys.read(key, text, faults);
        }
        let mut texture_keys = keys.written();
        texture_keys.retain(|key| TEXTURE_KEYS.contains(&key.get_ref().as_str()));
        if !keys.close(faults) {
            return None;
        }
        Some(Self { name: name?, ka, kd, ks, ke, ns, opacity, texture_keys })
    }
}

/// `[[mesh]]`.
#[derive(Clone, Debug)]
pub struct MeshFile {
    /// Where its triangles come from.
    pub source: SourceFile,
    /// How the file's polygons become triangles.
    pub polygons: Option<Spanned<String>>,
    /// Name of a `[[material]]`.
    pub material: Option<Spanned<String>>,
    /// How normals vary over a triangle.
    pub shading: Option<Spanned<String>>,
    /// Whether the shading normal turns towards the eye.
    pub sides: Option<Spanned<String>>,
    /// Displacement.
    pub translate: Option<Spanned<[f64; 3]>>,
    /// Angles about x, y and z, degrees.
    pub rotate_deg: Option<Spanned<[f64; 3]>>,
    /// Factors along x, y and z.
    pub scale: Option<Spanned<[f64; 3]>>,
    /// The whole transform, row by row.
    pub matrix: Option<Spanned<[[f64; 4]; 4]>>,
    /// Bytes of the text at which the mesh begins.
    pub span: Span,
}

/// `file` or `shape` of a mesh.
#[derive(Clone, Debug)]
pub enum SourceFile {
    /// `file`.
    File(Spanned<String>),
    /// `shape`.
    Shape(GeneratedFile),
}

impl MeshFile {
    pub(super) fn read(mut keys: Keys<'_, '_>, faults: &mut Faults<'_>) -> Option<Self> {
        let span = keys.header.clone();
        let file = keys.read("file", text, faults);
        let shape = keys.ask("shape");
        let polygons = keys.read("polygons", text, faults);
        let material = keys.read("material", text, faults);
        let shading = keys.read("shading", text, faults);
        let sides = keys.read("sides", text, faults);
        let translate = keys.read("translate", numbers, faults);
        let rotate_deg = keys.read("rotate_deg", numbers, faults);
        let scale = keys.read("scale", one_or_three, faults);
        let matrix = keys.read("matrix", matrix, faults);
        let written = keys.written();
        let place_of = |name: &str| written.iter().find(|key| key.get_ref() == name);
        match (place_of("file"), place_of("shape")) {
            (None, None) => keys.fault(&span, "[[mesh]] lacks `file` or `shape`", faults),
            (Some(_), Some(key)) => {
                keys.fault(&key.span(), "a mesh has either `file` or `shape`, not both", faults);
            }
            _ => {}
        }
        if let (None, Some(key)) = (place_of("file"), place_of("polygons")) {
            keys.fault(&key.span(), "`polygons` belongs to a mesh with `file`", faults);
        }
        let shape = shape.and_then(|value| GeneratedFile::read(value, faults));
        if !keys.close(faults) {
            return None;
        }
        let source = match (file, shape) {
            (Some(file), _) => SourceFile::File(file),
            (None, Some(shape)) => SourceFile::Shape(shape),
            (None, None) => return None,
        };
        Some(Self {
            source,
            polygons,
            material,
            shading,
            sides,
            translate,
            rotate_deg,
            scale,
            matrix,
            span,
        })
    }
}
