//! The meshes: read or made, given their materials, transformed and assembled.

use super::material::Materials;
use crate::mesh::NO_ATTRIBUTE;
use crate::scene::assemble::{Assembly, AssemblyFault, Piece};
use crate::scene::error::{Place, SceneError};
use crate::scene::file::text::Faults;
use crate::scene::file::{MeshFile, SceneFile, SourceFile, suggestion};
use crate::scene::obj::{self, ObjFile};
use crate::scene::part::MeshPart;
use crate::scene::transform::Transform;
use crate::scene::{Sides, Source, shapes};
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use toml::Spanned;

/// Mesh files that were read, once each; `None` for one with faults, which were reported.
type Library = HashMap<PathBuf, Option<ObjFile>>;

pub(super) fn resolve(
    file: &SceneFile,
    base: &Path,
    materials: &mut Materials,
    faults: &mut Faults<'_>,
) -> Assembly {
    let mut assembly = Assembly::default();
    let mut library = Library::new();
    for mesh in &file.meshes {
        // Report every fault of the mesh before giving it up.
        let transform = transform(mesh, faults);
        let sides = sides(mesh, faults);
        check_shading(mesh, faults);
        let named = named_material(mesh, file, materials, faults);
        let made;
        let (part, name, source, own) = match &mesh.source {
            SourceFile::Shape(name, shape) => match shapes::build(&shape.get_ref().to_shape()) {
                Ok(part) => {
                    made = part;
                    (&made, name.clone(), Source::Shape(name.clone()), Vec::new())
                }
                Err(error) => {
                    faults.at(&shape.span(), format!("shape `{name}`: {error}"));
                    continue;
                }
            },
            SourceFile::File(written) => {
                let path = base.join(written.get_ref());
                let Some(read) = read_file(&path, written, &mut library, faults) else { continue };
                let own = if named.is_none() {
                    own_materials(read, &path, materials, faults)
                } else {
                    Vec::new()
                };
                let source = Source::File { path, lines: read.part.lines.clone() };
                (&read.part, written.get_ref().clone(), source, own)
            }
        };
        let piece = Piece {
            part,
            transform,
            sides,
            materials: triangle_materials(part, named, &own, materials),
            name,
            source: source.clone(),
        };
        if let Err(fault) = assembly.append(piece) {
            faults.errors.push(assembly_error(&fault, mesh, &source, faults));
        }
    }
    assembly.finish()
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

fn check_shading(mesh: &MeshFile, faults: &mut Faults<'_>) {
    let Some(shading) = &mesh.shading else { return };
    match shading.get_ref().as_str() {
        "phong" => {}
        word @ ("gouraud" | "flat") => {
            let message = format!("{word} shading is not simulated by this version");
            faults.at_with_help(&shading.span(), message, "only \"phong\" is");
        }
        other => {
            let words = ["phong", "gouraud", "flat"];
            let message = format!("there is no shading \"{other}\"");
            faults.at_with_help(&shading.span(), message, suggestion(other, &words));
        }
    }
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

/// The file's mesh, read at its first use.
fn read_file<'a>(
    path: &Path,
    written: &Spanned<String>,
    library: &'a mut Library,
    faults: &mut Faults<'_>,
) -> Option<&'a ObjFile> {
    let read = library.entry(path.to_owned()).or_insert_with(|| {
        if let Err(error) = readable(path, faults.place(&written.span())) {
            faults.errors.push(error);
            return None;
        }
        match obj::load(path) {
            Ok(file) => {
                faults.warnings.extend(file.warnings.iter().cloned());
                Some(file)
            }
            Err(errors) => {
                faults.errors.extend(errors);
                None
            }
        }
    });
    read.as_ref()
}

/// Whether a mesh file is there and of a kind that is read.
fn readable(path: &Path, place: Place) -> Result<(), SceneError> {
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    match extension.as_str() {
        "obj" => {}
        "ply" | "stl" | "gltf" | "glb" => {
            let message = format!("{extension} files are not read by this version");
            return Err(SceneError::scene(place, message).with_help("meshes are read from .obj"));
        }
        _ => {
            let message = format!("`{}` is not the name of a mesh file", path.display());
            return Err(SceneError::scene(place, message).with_help("meshes are read from .obj"));
        }
    }
    let opened = std::fs::File::open(path).and_then(|file| file.metadata());
    let why = match opened {
        Ok(about) if about.is_dir() => "it is a folder".to_owned(),
        Ok(_) => return Ok(()),
        Err(error) => error.to_string(),
    };
    let message = format!("the mesh file `{}` cannot be read: {why}", path.display());
    Err(SceneError::reading(place, message))
}

/// For each material that a file's triangles name, its number in the scene.
fn own_materials(
    read: &ObjFile,
    path: &Path,
    materials: &mut Materials,
    faults: &mut Faults<'_>,
) -> Vec<Option<u32>> {
    let number_of = |name: &String| match read.materials.iter().find(|m| m.name == *name) {
        Some(material) => Some(materials.of_file(path, material)),
        None => {
            let message = format!("{}: no library has the material `{name}`", path.display());
            if !faults.warnings.contains(&message) {
                faults.warnings.push(message);
            }
            None
        }
    };
    read.part.material_names.iter().map(number_of).collect()
}

fn triangle_materials(
    part: &MeshPart,
    named: Option<u32>,
    own: &[Option<u32>],
    materials: &mut Materials,
) -> Vec<u32> {
    if let Some(number) = named {
        return vec![number; part.corners.len()];
    }
    (0..part.corners.len())
        .map(|triangle| {
            let name = part.triangle_materials.get(triangle).copied().unwrap_or(NO_ATTRIBUTE);
            let own = own.get(name as usize).copied().flatten();
            own.unwrap_or_else(|| materials.default_number())
        })
        .collect()
}

fn assembly_error(
    fault: &AssemblyFault,
    mesh: &MeshFile,
    source: &Source,
    faults: &Faults<'_>,
) -> SceneError {
    let here = faults.place(&mesh.span);
    match fault {
        AssemblyFault::TooMany => {
            SceneError::scene(here, "with this mesh the scene has more triangles than ids")
        }
        AssemblyFault::Position { position: [x, y, z], triangle } => {
            let name = match source {
                Source::Shape(name) => name.clone(),
                Source::File { path, .. } => path.display().to_string(),
            };
            let message = format!(
                "mesh `{name}`: a corner at ({x:e}, {y:e}, {z:e}) after the transform; \
                 each coordinate must be finite and at most 2^126 (8.5e37) in magnitude"
            );
            match (source, triangle) {
                (Source::File { path, lines }, Some(triangle)) => {
                    let line = lines.get(*triangle).copied().unwrap_or(0);
                    SceneError::scene(Place::at(path, line, 0), message)
                        .with_help(format!("the mesh stands at {here}"))
                }
                _ => SceneError::scene(here, message),
            }
        }
    }
}
