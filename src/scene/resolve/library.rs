//! The mesh files of a scene, each read once however many meshes are made of it.

use super::material::Materials;
use crate::scene::error::{Place, SceneError};
use crate::scene::file::text::Faults;
use crate::scene::obj::{self, ObjFile, ObjOptions};
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use toml::Spanned;

/// Mesh files by path and by how they are read; `None` for one with faults, which were reported.
#[derive(Default)]
pub(super) struct Library(HashMap<(PathBuf, ObjOptions), Option<ReadFile>>);

/// A mesh file and the numbers of its materials.
pub(super) struct ReadFile {
    pub(super) file: ObjFile,
    /// The scene's number of each of the file's materials, once a mesh needs them. Materials of
    /// different files are different, whatever their names.
    numbers: Option<Vec<u32>>,
}

impl ReadFile {
    /// The scene's numbers of the file's materials, in the order of `material_names`.
    pub(super) fn numbers(&mut self, materials: &mut Materials) -> &[u32] {
        let file = &self.file;
        self.numbers.get_or_insert_with(|| {
            let textured = file.materials.iter().zip(&file.textures);
            textured.map(|(own, textures)| materials.push(own.clone(), textures.clone())).collect()
        })
    }
}

impl Library {
    /// A file, read at its first use; `None` when it has faults.
    pub(super) fn read(
        &mut self,
        path: &Path,
        options: ObjOptions,
        written: &Spanned<String>,
        faults: &mut Faults<'_>,
    ) -> Option<&mut ReadFile> {
        let read = self.0.entry((path.to_owned(), options)).or_insert_with(|| {
            if let Err(error) = check_readable(path, faults.place(&written.span())) {
                faults.errors.push(error);
                return None;
            }
            match obj::load(path, options) {
                Ok(file) => {
                    // A file that is read in two ways says nearly all things twice.
                    for warning in &file.warnings {
                        if !faults.warnings.contains(warning) {
                            faults.warnings.push(warning.clone());
                        }
                    }
                    Some(ReadFile { file, numbers: None })
                }
                Err(errors) => {
                    faults.errors.extend(errors);
                    None
                }
            }
        });
        read.as_mut()
    }
}

/// Whether a mesh file is there and of a kind that is read. Faults are the scene file's, which
/// names it.
fn check_readable(path: &Path, place: Place) -> Result<(), SceneError> {
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    if extension != "obj" {
        let message = match extension.as_str() {
            "ply" | "stl" | "gltf" | "glb" => {
                format!("{extension} files are not read by this version")
            }
            _ => format!("`{}` is not the name of a mesh file", path.display()),
        };
        return Err(SceneError::scene(place, message).with_help("meshes are read from .obj"));
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
