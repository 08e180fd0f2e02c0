//! The materials: those of the scene file first, then those that mesh files bring along.

use super::{at_least_zero, color, texture};
use crate::scene::file::text::Faults;
use crate::scene::file::{MaterialFile, SceneFile, suggestion};
use crate::scene::material::Material;
use crate::scene::texture::TextureRequests;
use std::collections::HashMap;
use std::path::Path;
use toml::Spanned;

/// The scene's materials as they grow.
pub(super) struct Materials {
    /// In the order of their numbers.
    pub(super) list: Vec<Material>,
    /// The textures that each asks for.
    pub(super) textures: Vec<TextureRequests>,
    /// Those of the scene file by name.
    pub(super) named: HashMap<String, u32>,
    default: Option<u32>,
}

impl Materials {
    /// Appends a material and gives its number.
    pub(super) fn push(&mut self, material: Material, textures: TextureRequests) -> u32 {
        self.list.push(material);
        self.textures.push(textures);
        self.list.len() as u32 - 1
    }

    /// The number of the default material, which the scene has only if it is asked for.
    pub(super) fn default_number(&mut self) -> u32 {
        if let Some(number) = self.default {
            return number;
        }
        let number = self.push(Material::default_named("default"), TextureRequests::default());
        *self.default.insert(number)
    }
}

pub(super) fn resolve(file: &SceneFile, base: &Path, faults: &mut Faults<'_>) -> Materials {
    let mut materials =
        Materials { list: Vec::new(), textures: Vec::new(), named: HashMap::new(), default: None };
    for written in &file.materials {
        let material = material(written, faults);
        let textures = texture::requests(written, base, faults);
        let name = material.name.clone();
        if materials.named.contains_key(&name) {
            let message = format!("the name `{name}` is taken by another material");
            faults.at(&written.name.span(), message);
            continue;
        }
        let number = materials.push(material, textures);
        materials.named.insert(name, number);
    }
    materials
}

fn material(written: &MaterialFile, faults: &mut Faults<'_>) -> Material {
    let default =
        preset(written, faults).unwrap_or_else(|| Material::default_named(written.name.get_ref()));
    let opacity = written.opacity.as_ref().map_or(default.opacity, |opacity| {
        let number = *opacity.get_ref();
        if !(0.0..=1.0).contains(&number) {
            faults.at(&opacity.span(), format!("`opacity` must be from 0 to 1, not {number}"));
        }
        number
    });
    let mut rgb = |key: &str, value: &Option<Spanned<[f64; 3]>>, default| {
        value.as_ref().map_or(default, |rgb| color(rgb, key, faults))
    };
    // A texture alone is the whole coefficient, unless a preset gives one.
    let unless_textured = |map: &Option<_>, default| match map {
        Some(_) if written.preset.is_none() => [1.0; 3],
        _ => default,
    };
    let kd = rgb("kd", &written.kd, unless_textured(&written.kd_map, default.kd));
    let ka = rgb("ka", &written.ka, if written.preset.is_some() { default.ka } else { kd });
    let ks = rgb("ks", &written.ks, unless_textured(&written.ks_map, default.ks));
    let ke = rgb("ke", &written.ke, default.ke);
    let ns = written.ns.as_ref().map_or(default.ns, |ns| at_least_zero(ns, "ns", faults));
    let unlit = written.unlit.as_ref().is_some_and(|unlit| *unlit.get_ref());
    Material { ka, kd, ks, ke, ns, unlit, opacity, ..default }
}

/// The material of the preset that is named, with the name of this material.
fn preset(written: &MaterialFile, faults: &mut Faults<'_>) -> Option<Material> {
    let word = written.preset.as_ref()?;
    let found = Material::preset(word.get_ref(), written.name.get_ref());
    if found.is_none() {
        let message = format!("there is no preset `{}`", word.get_ref());
        let help = suggestion(word.get_ref(), &Material::PRESETS);
        faults.at_with_help(&word.span(), message, help);
    }
    found
}
