//! `[[material]]` and `[[mesh]]` as written.

use super::keys::{Keys, suggestion};
use super::shape::ShapeFile;
use super::text::{Faults, Span};
use super::values::{Value, kind, matrix, number, numbers, one_or_three, text};
use serde::Deserialize;
use toml::Spanned;
use toml::de::{DeTable, DeValue, ValueDeserializer};

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
    /// `shape`: its name and its numbers.
    Shape(String, Spanned<ShapeFile>),
}

impl MeshFile {
    pub(super) fn read(mut keys: Keys<'_, '_>, faults: &mut Faults<'_>) -> Option<Self> {
        let span = keys.header.clone();
        let file = keys.read("file", text, faults);
        let shape = keys.ask("shape");
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
        let shape = shape.and_then(|value| read_shape(value, faults));
        if !keys.close(faults) {
            return None;
        }
        let source = match (file, shape) {
            (Some(file), _) => SourceFile::File(file),
            (None, Some((name, shape))) => SourceFile::Shape(name, shape),
            (None, None) => return None,
        };
        Some(Self { source, material, shading, sides, translate, rotate_deg, scale, matrix, span })
    }
}

/// Reads `{ NAME = { … } }`.
fn read_shape(value: &Value<'_>, faults: &mut Faults<'_>) -> Option<(String, Spanned<ShapeFile>)> {
    let DeValue::Table(table) = value.get_ref() else {
        let message = format!("`shape` must be a table, not {}", kind(value.get_ref()));
        faults.at_with_help(&value.span(), message, "write `shape = { NAME = { … } }`");
        return None;
    };
    let mut names = table.iter();
    let (Some((name, inner)), None) = (names.next(), names.next()) else {
        let message = format!("`shape` must name one shape, not {}", table.len());
        faults.at(&value.span(), message);
        return None;
    };
    // Refuse numbers that are none here, where each has a place.
    let numbers = if let DeValue::Table(inner) = inner.get_ref() { inner } else { &DeTable::new() };
    let mut clean = true;
    for (key, value) in numbers {
        if let (DeValue::Float(_), Err(wrong)) = (value.get_ref(), number(value)) {
            let message = format!(
                "`{key}` must be {}, not {}",
                wrong.expected,
                wrong.found,
                key = key.get_ref()
            );
            faults.at(&wrong.span, message);
            clean = false;
        }
    }
    if !clean {
        return None;
    }
    match ShapeFile::deserialize(ValueDeserializer::from(value.clone())) {
        Ok(shape) => Some((name.get_ref().to_string(), Spanned::new(value.span(), shape))),
        Err(error) => {
            report_shape(&error, name.get_ref(), numbers, &value.span(), faults);
            None
        }
    }
}

/// Says in our words what serde says of a shape.
fn report_shape(
    error: &toml::de::Error,
    shape: &str,
    numbers: &DeTable<'_>,
    whole: &Span,
    faults: &mut Faults<'_>,
) {
    let span = error.span().unwrap_or_else(|| whole.clone());
    let message = error.message();
    // Names stand in backticks: the offender first, then those that are known.
    let quoted: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
    match (&quoted[..], message.split_once(", expected ")) {
        ([offender, known @ ..], _) if message.starts_with("unknown field") => faults.at_with_help(
            &span,
            format!("unknown key `{offender}` in shape `{shape}`"),
            suggestion(offender, known),
        ),
        ([offender, known @ ..], _) if message.starts_with("unknown variant") => {
            let help = suggestion(offender, known);
            faults.at_with_help(&span, format!("there is no shape `{offender}`"), help);
        }
        ([lacking, ..], _) if message.starts_with("missing field") => {
            faults.at(&span, format!("shape `{shape}` lacks `{lacking}`"));
        }
        (_, Some((found, expected))) => {
            let key = numbers.iter().find(|(_, value)| value.span() == span);
            let name = key.map_or(shape, |(key, _)| key.get_ref());
            let expected = match expected {
                "f64" => "a number",
                "u8" | "u16" | "u32" | "u64" | "usize" => "a whole number, 0 or more",
                "i32" | "i64" => "a whole number",
                other => other,
            };
            let found = found.rsplit_once(": ").map_or(found, |(_, found)| found);
            let found = found.strip_prefix("integer ").unwrap_or(found).replace('`', "");
            faults.at(&span, format!("`{name}` must be {expected}, not {found}"));
        }
        _ => faults.at(&span, format!("shape `{shape}`: {message}")),
    }
}
