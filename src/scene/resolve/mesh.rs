//! The meshes: read or made, given their materials, transformed and assembled.

use super::left_out::without_bad_faces;
use super::library::Library;
use super::material::Materials;
use super::vertex_normals;
use crate::mesh::NO_ATTRIBUTE;
use crate::scene::assemble::{Assembly, AssemblyFault, Piece};
use crate::scene::error::{Place, SceneError};
use crate::scene::file::text::Faults;
use crate::scene::file::{GeneratedFile, MeshFile, SceneFile, SourceFile, suggestion};
use crate::scene::load::Overrides;
use crate::scene::obj::{ObjOptions, Polygons};
use crate::scene::part::MeshPart;
use crate::scene::shapes::{self, Shape};
use crate::scene::transform::Transform;
use crate::scene::{Shading, Sides, Source};
use std::path::Path;
use toml::Spanned;

/// The transform of each mesh.
pub(super) fn transforms(file: &SceneFile, faults: &mut Faults<'_>) -> Vec<Transform> {
    file.meshes.iter().map(|mesh| transform(mesh, faults)).collect()
}

/// What all meshes of a scene are made with.
pub(super) struct Making<'a> {
    /// The folder that paths are relative to.
    pub(super) base: &'a Path,
    pub(super) overrides: &'a Overrides,
    /// Whether normals are transformed like directions.
    pub(super) naive_normals: bool,
}

pub(super) fn resolve(
    file: &SceneFile,
    making: &Making<'_>,
    transforms: Vec<Transform>,
    materials: &mut Materials,
    faults: &mut Faults<'_>,
) -> Assembly {
    let Making { base, overrides, naive_normals } = *making;
    let mut assembly = Assembly::default();
    let mut library = Library::default();
    for (mesh, transform) in file.meshes.iter().zip(transforms) {
        // Report every fault of the mesh before giving it up.
        let normals = vertex_normals::rule(mesh, faults);
        let sides = sides(mesh, faults);
        let shading = shading(mesh, faults);
        let polygons = polygons(mesh, faults);
        let named = named_material(mesh, file, materials, faults);
        let made;
        let (part, name, source, own) = match &mesh.source {
            SourceFile::Shape(written) => {
                let shape = written.shape.get_ref().to_shape();
                let Some(part) = build(&shape, written, faults) else { continue };
                made = part;
                (&made, shape.name().to_owned(), Source::Shape(shape.name().to_owned()), Vec::new())
            }
            SourceFile::File(written) => {
                let path = base.join(written.get_ref());
                let options = ObjOptions { polygons, skip_bad: overrides.skip_bad };
                let Some(read) = library.read(&path, options, written, faults) else { continue };
                let own =
                    if named.is_none() { read.numbers(materials).to_vec() } else { Vec::new() };
                let mut part = &read.file.part;
                if overrides.skip_bad
                    && let Some(less) = without_bad_faces(part, &transform, &path, faults)
                {
                    made = less;
                    part = &made;
                }
                let lines = part.lines.clone();
                (part, written.get_ref().clone(), Source::File { path, lines }, own)
            }
        };
        let remade = normals.and_then(|rule| vertex_normals::remake(part, rule, mesh, faults));
        let part = remade.as_ref().unwrap_or(part);
        let piece = Piece {
            part,
            transform,
            sides,
            shading,
            naive_normals,
            materials: triangle_materials(part, named, &own, materials),
            name,
            source,
        };
        if let Err(fault) = assembly.append(piece) {
            faults.errors.push(assembly_error(&fault, mesh, part, base, faults));
        }
    }
    assembly.finish()
}

/// Makes a shape; a parameter out of range is reported where it stands.
fn build(shape: &Shape, written: &GeneratedFile, faults: &mut Faults<'_>) -> Option<MeshPart> {
    let error = match shapes::build(shape) {
        Ok(part) => return Some(part),
        Err(error) => error,
    };
    let key = written.parameters.iter().find(|key| key.get_ref() == error.parameter);
    let span = key.map_or(written.shape.span(), |key| key.span());
    faults.at(&span, error.to_string());
    None
}

fn transform(mesh: &MeshFile, faults: &mut Faults<'_>) -> Transform {
    let step = |step: &Option<Spanned<[f64; 3]>>, neutral| {
        step.as_ref().map_or(neutral, |step| *step.get_ref())
    };
    let transform = match &mesh.matrix {
        None => Transform::from_steps(
            step(&mesh.scale, [1.0; 3]),
            step(&mesh.rotate_deg, [0.0; 3]),
            step(&mesh.translate, [0.0; 3]),
        ),
        Some(matrix) => {
            let steps = [
                ("scale", &mesh.scale),
                ("rotate_deg", &mesh.rotate_deg),
                ("translate", &mesh.translate),
            ];
            for (key, step) in steps {
                if let Some(step) = step {
                    let message = format!("a mesh has either `matrix` or `{key}`, not both");
                    faults.at(&step.span(), message);
                }
            }
            if matrix.get_ref()[3] != [0.0, 0.0, 0.0, 1.0] {
                let [a, b, c, d] = matrix.get_ref()[3];
                let message =
                    format!("the last row of `matrix` must be 0 0 0 1, not {a} {b} {c} {d}");
                faults.at(&matrix.span(), message);
            }
            Transform::from_matrix(*matrix.get_ref())
        }
    };
    if transform.orientation == 0 {
        faults.warn(&mesh.span, "the transform flattens this mesh");
    }
    transform
}

fn sides(mesh: &MeshFile, faults: &mut Faults<'_>) -> Sides {
    let Some(sides) = &mesh.sides else { return Sides::Single };
    match sides.get_ref().as_str() {
        "single" => Sides::Single,
        "double" => Sides::Double,
        other => {
            let message = format!("`sides` must be \"single\" or \"double\", not \"{other}\"");
            faults.at(&sides.span(), message);
            Sides::Single
        }
    }
}

fn polygons(mesh: &MeshFile, faults: &mut Faults<'_>) -> Polygons {
    let Some(written) = &mesh.polygons else { return Polygons::default() };
    let word = written.get_ref().as_str();
    let known = Polygons::ALL.iter().find(|(name, _)| *name == word);
    if known.is_none() {
        let names = Polygons::ALL.map(|(name, _)| name);
        let message = format!("`polygons` must be \"ears\" or \"fan\", not \"{word}\"");
        faults.at_with_help(&written.span(), message, suggestion(word, &names));
    }
    known.map_or_else(Polygons::default, |&(_, polygons)| polygons)
}

fn shading(mesh: &MeshFile, faults: &mut Faults<'_>) -> Shading {
    let Some(written) = &mesh.shading else { return Shading::Phong };
    let word = written.get_ref().as_str();
    let known = Shading::NAMED.iter().find(|(_, name)| *name == word);
    if known.is_none() {
        let words = Shading::NAMED.map(|(_, name)| name);
        let message = format!("there is no shading \"{word}\"");
        faults.at_with_help(&written.span(), message, suggestion(word, &words));
    }
    known.map_or(Shading::Phong, |&(shading, _)| shading)
}

/// The number of the material that the mesh names.
fn named_material(
    mesh: &MeshFile,
    file: &SceneFile,
    materials: &Materials,
    faults: &mut Faults<'_>,
) -> Option<u32> {
    let name = mesh.material.as_ref()?;
    let number = materials.named.get(name.get_ref()).copied();
    // Where a material had faults, it may be the one that is meant.
    if number.is_none() && !file.materials_lack {
        let mut known: Vec<&str> = materials.named.keys().map(String::as_str).collect();
        known.sort_unstable();
        let message = format!("there is no material `{}`", name.get_ref());
        match known.is_empty() {
            true => faults.at_with_help(&name.span(), message, "the scene has no `[[material]]`"),
            false => {
                let help = suggestion(name.get_ref(), &known);
                faults.at_with_help(&name.span(), message, help);
            }
        }
    }
    number
}

fn triangle_materials(
    part: &MeshPart,
    named: Option<u32>,
    own: &[u32],
    materials: &mut Materials,
) -> Vec<u32> {
    if let Some(number) = named {
        return vec![number; part.corners.len()];
    }
    (0..part.corners.len())
        .map(|triangle| {
            let name = part.triangle_materials.get(triangle).copied().unwrap_or(NO_ATTRIBUTE);
            let own = own.get(name as usize).copied();
            own.unwrap_or_else(|| materials.default_number())
        })
        .collect()
}

/// A position out of range is the fault of the face in the mesh file that uses it, or of the mesh.
fn assembly_error(
    fault: &AssemblyFault,
    mesh: &MeshFile,
    part: &MeshPart,
    base: &Path,
    faults: &Faults<'_>,
) -> SceneError {
    let here = faults.place(&mesh.span);
    let AssemblyFault::Position { position: [x, y, z], triangle } = fault else {
        return SceneError::scene(here, "with this mesh the scene has more triangles than ids");
    };
    let said = format!(
        "a corner at ({x:e}, {y:e}, {z:e}) after the transform; \
         each coordinate must be finite and at most 2^126 (8.5e37) in magnitude"
    );
    match &mesh.source {
        SourceFile::Shape(written) => {
            let name = written.shape.get_ref().to_shape().name();
            SceneError::scene(here, format!("mesh `{name}`: {said}"))
        }
        SourceFile::File(written) => {
            let line = triangle.and_then(|triangle| part.lines.get(triangle)).copied().unwrap_or(0);
            let place = Place::at(&base.join(written.get_ref()), line, 0);
            SceneError::scene(place, format!("mesh `{}`: {said}", written.get_ref()))
                .with_help(format!("the mesh stands at {here}"))
        }
    }
}
