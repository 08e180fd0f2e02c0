//! From what was written to what is meant: ranges, names, geometry, and what this version does not
//! simulate. Every fault is reported; the scene is made only of what has none.

mod camera;
mod left_out;
mod library;
mod light;
mod light_choice;
mod light_frame;
mod material;
mod mesh;
mod switches;
mod texture;
mod vertex_normals;

use super::Scene;
use super::file::SceneFile;
use super::file::text::Faults;
use super::load::Overrides;
use crate::color::LinearRgb;
use std::path::Path;
use toml::Spanned;

/// The scene that a file means. `None` where the camera or an image cannot be made; whether it may
/// be used, `faults` tells.
pub(super) fn scene(
    file: &SceneFile,
    base: &Path,
    overrides: &Overrides,
    faults: &mut Faults<'_>,
) -> Option<Scene> {
    let switches = switches::resolve(file, faults);
    let background = file
        .image
        .as_ref()
        .and_then(|image| image.background.as_ref())
        .map_or([0.0; 3], |rgb| color(rgb, "background", faults));
    let camera = camera::resolve(file, overrides, faults);
    let samples = camera::samples(file, faults);
    let mut materials = material::resolve(file, base, faults);
    let transforms = mesh::transforms(file, faults);
    let frames = light_frame::Frames::new(file, camera.as_ref(), &transforms, faults);
    let (lights, light_names) = light_choice::resolve(file, &frames, overrides, faults);
    let naive_normals = switches.rules().naive_normals;
    let made = mesh::Making { base, overrides, naive_normals };
    let assembly = mesh::resolve(file, &made, transforms, &mut materials, faults);
    let textures = texture::resolve(file, &mut materials, &assembly, faults);
    Some(Scene {
        camera: camera?,
        background,
        samples: overrides.samples.unwrap_or(samples),
        mesh: assembly.mesh,
        objects: assembly.objects,
        materials: materials.list,
        textures,
        triangle_materials: assembly.triangle_materials,
        lights,
        light_names,
        switches,
        warnings: Vec::new(),
    })
}

/// A colour: no channel below 0.
fn color(rgb: &Spanned<[f64; 3]>, key: &str, faults: &mut Faults<'_>) -> LinearRgb {
    if let Some(channel) = rgb.get_ref().iter().find(|&&channel| channel < 0.0) {
        let message = format!("`{key}` must be at least 0 in every channel, not {channel}");
        faults.at(&rgb.span(), message);
    }
    *rgb.get_ref()
}

/// A number that must be at least 0.
fn at_least_zero(value: &Spanned<f64>, key: &str, faults: &mut Faults<'_>) -> f64 {
    let number = *value.get_ref();
    if number < 0.0 {
        faults.at(&value.span(), format!("`{key}` must be at least 0, not {number}"));
    }
    number
}
