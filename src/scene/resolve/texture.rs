//! The textures: of all that materials ask for, those that a triangle wears, each file once.
//!
//! Which texture a material has is only known here, after the meshes: a file that nothing shows is
//! not opened, and whether it exists plays no part.

use super::material::Materials;
use crate::mesh::{NO_ATTRIBUTE, TriangleMesh};
use crate::scene::assemble::Assembly;
use crate::scene::error::SceneError;
use crate::scene::file::text::Faults;
use crate::scene::file::{MaterialFile, SceneFile, suggestion};
use crate::scene::texture::{
    Filter, Texture, TextureError, TextureRef, TextureRequest, TextureRequests, Wrap,
};
use std::collections::{HashMap, HashSet};
use std::path::{Path, PathBuf};
use toml::Spanned;

/// What a material of the scene file asks for.
pub(super) fn requests(
    written: &MaterialFile,
    base: &Path,
    faults: &mut Faults<'_>,
) -> TextureRequests {
    let filter = word("filter", &written.filter, &Filter::NAMED, faults);
    let wrap = word("wrap", &written.wrap, &Wrap::NAMED, faults);
    if written.kd_map.is_none() && written.ks_map.is_none() {
        for (key, value) in [("filter", &written.filter), ("wrap", &written.wrap)] {
            if let Some(value) = value {
                let message = format!("`{key}` has no use without `kd_map` or `ks_map`");
                faults.at(&value.span(), message);
            }
        }
    }
    let request = |map: &Option<Spanned<String>>| {
        map.as_ref().map(|file| TextureRequest {
            paths: vec![base.join(file.get_ref())],
            filter,
            wrap,
            scale: [1.0; 2],
            offset: [0.0; 2],
            place: faults.place(&file.span()),
            required: true,
        })
    };
    TextureRequests {
        kd: request(&written.kd_map),
        ks: request(&written.ks_map),
        ..TextureRequests::default()
    }
}

/// The value of a key that takes one of some words.
fn word<T: Copy + Default>(
    key: &str,
    written: &Option<Spanned<String>>,
    known: &[(&str, T)],
    faults: &mut Faults<'_>,
) -> T {
    let Some(written) = written else { return T::default() };
    let name = written.get_ref().as_str();
    if let Some((_, value)) = known.iter().find(|(word, _)| *word == name) {
        return *value;
    }
    let words: Vec<&str> = known.iter().map(|(word, _)| *word).collect();
    let message = format!("there is no {key} \"{name}\"");
    faults.at_with_help(&written.span(), message, suggestion(name, &words));
    T::default()
}

/// Reads what the assembled triangles wear and tells their materials.
pub(super) fn resolve(
    file: &SceneFile,
    materials: &mut Materials,
    assembly: &Assembly,
    faults: &mut Faults<'_>,
) -> Vec<Texture> {
    let mut worn = vec![false; materials.list.len()];
    for &number in &assembly.triangle_materials {
        worn[number as usize] = true;
    }
    let mut shelf = Shelf::default();
    for (number, requests) in materials.textures.iter().enumerate() {
        if worn[number] {
            let material = &mut materials.list[number];
            let mut read = |request: &Option<_>| shelf.read(request.as_ref()?, faults);
            material.kd_map = read(&requests.kd);
            material.ks_map = read(&requests.ks);
            // Where a texture that is required is missing, there will be no scene.
            let untextured = requests.untextured;
            if requests.kd.is_some() && material.kd_map.is_none() {
                (material.ka, material.kd) = (untextured.ka, untextured.kd);
            }
            if requests.ks.is_some() && material.ks_map.is_none() {
                material.ks = untextured.ks;
            }
        }
    }
    if !shelf.textures.is_empty() {
        warn_without_coordinates(file, materials, assembly, faults);
    }
    // Make smaller levels only where they are looked at.
    let maps = materials.list.iter().flat_map(|material| [material.kd_map, material.ks_map]);
    let mip = maps.flatten().filter(|map| map.filter == Filter::Mip);
    let mip: HashSet<u32> = mip.map(|map| map.texture).collect();
    let numbered = shelf.textures.into_iter().zip(0..);
    numbered.map(|(t, number)| if mip.contains(&number) { t.with_levels() } else { t }).collect()
}

/// The textures that were read so far.
#[derive(Default)]
struct Shelf {
    textures: Vec<Texture>,
    /// Their numbers by path, or why there is none.
    numbers: HashMap<PathBuf, Result<u32, TextureError>>,
    /// Paths whose fault was told, as an error or as a warning.
    told: HashSet<(PathBuf, bool)>,
}

impl Shelf {
    /// The texture that is asked for, read at its first use; `None` where it cannot be.
    fn read(&mut self, request: &TextureRequest, faults: &mut Faults<'_>) -> Option<TextureRef> {
        let path = request.paths.iter().find(|path| path.exists()).or(request.paths.first())?;
        let textures = &mut self.textures;
        let number = self.numbers.entry(path.clone()).or_insert_with(|| {
            textures.push(Texture::load(path)?);
            Ok(textures.len() as u32 - 1)
        });
        match number {
            Ok(texture) => Some(TextureRef {
                texture: *texture,
                filter: request.filter,
                wrap: request.wrap,
                scale: request.scale,
                offset: request.offset,
            }),
            Err(error) => {
                if self.told.insert((path.clone(), request.required)) {
                    tell(error, path, request, faults);
                }
                None
            }
        }
    }
}

/// A file that is not there or of another kind is no fault of a mesh that names it; a damaged or
/// too large one is, for it could be drawn.
fn tell(error: &TextureError, path: &Path, request: &TextureRequest, faults: &mut Faults<'_>) {
    let place = request.place.clone();
    let message = format!("the texture `{}` {error}", path.display());
    match error {
        TextureError::Reading(_) | TextureError::Kind if !request.required => {
            faults.warnings.push(format!("{place}: {message}; left out"));
        }
        TextureError::Reading(_) => faults.errors.push(SceneError::reading(place, message)),
        _ => {
            let help = match error {
                TextureError::Size(..) => "make it smaller",
                _ => "save it as a PNG or JPEG image",
            };
            faults.errors.push(SceneError::scene(place, message).with_help(help));
        }
    }
}

/// One warning for each mesh with triangles that cannot show their texture.
fn warn_without_coordinates(
    file: &SceneFile,
    materials: &Materials,
    assembly: &Assembly,
    faults: &mut Faults<'_>,
) {
    let is_textured = |number: u32| {
        let material = &materials.list[number as usize];
        material.kd_map.is_some() || material.ks_map.is_some()
    };
    for (index, object) in assembly.objects.iter().enumerate() {
        let triangles = object.triangles.start as usize..object.triangles.end as usize;
        let bare = triangles.filter(|&triangle| {
            is_textured(assembly.triangle_materials[triangle])
                && lacks_coordinates(&assembly.mesh, triangle)
        });
        let count = bare.count();
        if count == 0 {
            continue;
        }
        let message = format!(
            "mesh `{}`: {count} of its triangles have a texture but no texture coordinates; they \
             are drawn without it",
            object.name
        );
        // Where a mesh was refused, objects and meshes are not side by side; nor is a scene made.
        match file.meshes.get(index).filter(|_| file.meshes.len() == assembly.objects.len()) {
            Some(mesh) => faults.warn(&mesh.span, &message),
            None => faults.warnings.push(message),
        }
    }
}

fn lacks_coordinates(mesh: &TriangleMesh, triangle: usize) -> bool {
    mesh.corner_uvs.get(triangle).is_none_or(|corners| corners.contains(&NO_ATTRIBUTE))
}
