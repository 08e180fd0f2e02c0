//! `[[material]]` and `[[mesh]]` as written.

use super::generated::GeneratedFile;
use super::keys::Keys;
use super::text::{Faults, Span};
use super::values::{boolean, matrix, number, numbers, one_or_three, text};
use toml::Spanned;

/// `[[material]]`.
#[derive(Clone, Debug)]
pub struct MaterialFile {
    /// Its name.
    pub name: Spanned<String>,
    /// Name of the coefficients that those written replace.
    pub preset: Option<Spanned<String>>,
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
    /// Whether lights leave it alone.
    pub unlit: Option<Spanned<bool>>,
    /// How much the surface hides.
    pub opacity: Option<Spanned<f64>>,
    /// File of the texture of `kd`.
    pub kd_map: Option<Spanned<String>>,
    /// File of the texture of `ks`.
    pub ks_map: Option<Spanned<String>>,
    /// How both are filtered.
    pub filter: Option<Spanned<String>>,
    /// What lies outside both.
    pub wrap: Option<Spanned<String>>,
}

impl MaterialFile {
    pub(super) fn read(mut keys: Keys<'_, '_>, faults: &mut Faults<'_>) -> Option<Self> {
        let name = keys.require("name", text, faults);
        let ka = keys.read("ka", numbers, faults);
        let kd = keys.read("kd", numbers, faults);
        let ks = keys.read("ks", numbers, faults);
        let ke = keys.read("ke", numbers, faults);
        let ns = keys.read("ns", number, faults);
        let preset = keys.read("preset", text, faults);
        let unlit = keys.read("unlit", boolean, faults);
        let opacity = keys.read("opacity", number, faults);
        let kd_map = keys.read("kd_map", text, faults);
        let ks_map = keys.read("ks_map", text, faults);
        let filter = keys.read("filter", text, faults);
        let wrap = keys.read("wrap", text, faults);
        if !keys.close(faults) {
            return None;
        }
        Some(Self {
            name: name?,
            preset,
            ka,
            kd,
            ks,
            ke,
            ns,
            unlit,
            opacity,
            kd_map,
            ks_map,
            filter,
            wrap,
        })
    }
}

/// `[[mesh]]`.
#[derive(Clone, Debug)]
pub struct MeshFile {
    /// Where its triangles come from.
    pub source: SourceFile,
    /// Name by which lights refer to it.
    pub name: Option<Spanned<String>>,
    /// How the file's polygons become triangles.
    pub polygons: Option<Spanned<String>>,
    /// Name of a `[[material]]`.
    pub material: Option<Spanned<String>>,
    /// How normals vary over a triangle.
    pub shading: Option<Spanned<String>>,
    /// Whether the shading normal turns towards the eye.
    pub sides: Option<Spanned<String>>,
    /// Where vertex normals come from.
    pub vertex_normals: Option<Spanned<String>>,
    /// Largest angle between faces that share a vertex normal, degrees.
    pub crease_deg: Option<Spanned<f64>>,
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
        let name = keys.read("name", text, faults);
        let polygons = keys.read("polygons", text, faults);
        let material = keys.read("material", text, faults);
        let shading = keys.read("shading", text, faults);
        let sides = keys.read("sides", text, faults);
        let vertex_normals = keys.read("vertex_normals", text, faults);
        let crease_deg = keys.read("crease_deg", number, faults);
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
            name,
            polygons,
            material,
            shading,
            sides,
            vertex_normals,
            crease_deg,
            translate,
            rotate_deg,
            scale,
            matrix,
            span,
        })
    }
}
