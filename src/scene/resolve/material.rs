//! The materials: those of the scene file first, then those that mesh files bring along.

use super::{at_least_zero, color};
use crate::scene::file::text::Faults;
use crate::scene::file::{MaterialFile, SceneFile};
use crate::scene::material::Material;
use std::collections::HashMap;
use toml::Spanned;

/// The scene's materials as they grow.
pub(super) struct Materials {
    /// In the order of their numbers.
    pub(super) list: Vec<Material>,
    /// Those of the scene file by name.
    pub(super) named: HashMap<String, u32>,
    default: Option<u32>,
}

impl Materials {
    /// Appends a material and gives its number.
    pub(super) fn push(&mut self, material: Material) -> u32 {
        self.list.push(material);
        self.list.len() as u32 - 1
    }

    /// The number of the default material, which the scene has only if it is asked for.
    pub(super) fn default_number(&mut self) -> u32 {
        if let Some(number) = self.default {
            return number;
        }
        let number = self.push(Material::default_named("default"));
        *self.default.insert(number)
    }
}

pub(super) fn resolve(file: &SceneFile, faults: &mut Faults<'_>) -> Materials {
    let mut materials = Materials { list: Vec::new(), named: HashMap::new(), default: None };
    for written in &file.materials {
        let material = material(written, faults);
        let name = material.name.clone();
        if materials.named.contains_key(&name) {
            let message = format!("the name `{name}` is taken by another material");
            faults.at(&written.name.span(), message);
            continue;
        }
        let number = materials.push(material);
        materials.named.insert(name, number);
    }
    materials
}

fn material(written: &MaterialFile, faults: &mut Faults<'_>) -> Material {
    for key in &written.texture_keys {
        let message = format!("textures (`{}`) are not simulated by this version", key.get_ref());
        faults.at(&key.span(), message);
    }
    let default = Material::default_named(written.name.get_ref());
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
    let kd = rgb("kd", &written.kd, default.kd);
    let ka = rgb("ka", &written.ka, kd);
    let ks = rgb("ks", &written.ks, default.ks);
    let ke = rgb("ke", &written.ke, default.ke);
    let ns = written.ns.as_ref().map_or(default.ns, |ns| at_least_zero(ns, "ns", faults));
    Material { name: default.name, ka, kd, ks, ke, ns, opacity }
}
