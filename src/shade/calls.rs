//! Which effects a scene calls for, and which of its parts does so.
//!
//! A light calls for a term only where its colour meets a coefficient of a material in use, so a
//! black light or a material that no triangle wears costs nothing. Nothing is evaluated here.

use super::effects::Effects;
use super::lights::is_black;
use super::method::Method;
use crate::color::LinearRgb;
use crate::mesh::NO_ATTRIBUTE;
use crate::scene::Scene;
use crate::scene::light::{Light, LightColors};
use crate::scene::material::Material;
use crate::scene::sampling::SampleGrid;
use crate::scene::switches::Rules;

/// Who calls for an effect, by position in the scene's lists.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Caller {
    Light(usize),
    Material(usize),
    Object(usize),
    Image,
}

/// Per channel, whether any material in use reflects light: a light calls for a term only where
/// its colour meets a coefficient.
#[derive(Default)]
struct Reflectance {
    ambient: [bool; 3],
    diffuse: [bool; 3],
    specular: [bool; 3],
    /// By hemisphere lights.
    around: bool,
}

/// Names every effect that the scene calls for, with each of its callers. Linear in the triangles,
/// lights and materials.
pub(super) fn visit_calls(scene: &Scene, mut call: impl FnMut(Effects, Caller)) {
    // Only materials that a triangle wears and shows count.
    let methods = Method::of_objects(scene);
    let mut in_use = vec![false; scene.materials.len()];
    for (object, _) in scene.objects.iter().zip(&methods).filter(|(_, method)| method.is_lit()) {
        let range = object.triangles.start as usize..object.triangles.end as usize;
        for &material in &scene.triangle_materials[range] {
            in_use[material as usize] = true;
        }
    }
    visit_pixel(scene, &in_use, &mut call);
    let worn = || scene.materials.iter().enumerate().filter(|(index, _)| in_use[*index]);
    let rules = scene.switches.rules();
    let mut reflectance = Reflectance::default();
    for (index, material) in worn().filter(|(_, material)| !material.unlit) {
        if !is_black(material.ke) {
            call(Effects::EMISSION, Caller::Material(index));
        }
        merge(
            &mut reflectance.ambient,
            if rules.ambient_by_diffuse { material.kd } else { material.ka },
        );
        merge(&mut reflectance.diffuse, material.kd);
        merge(&mut reflectance.specular, material.ks);
    }

    // Lights call for their kind and for what they modulate.
    let mut lit = Reflectance::default();
    for (index, light) in scene.lights.iter().enumerate() {
        visit_light(light, rules, &reflectance, &mut lit, |effect| {
            call(effect, Caller::Light(index))
        });
    }

    // Materials call for the terms in which they meet a light.
    for (index, material) in worn() {
        visit_material(material, rules, &lit, |effect| call(effect, Caller::Material(index)));
    }

    // Normals matter where something depends on their direction.
    if lit.around || lit.diffuse.contains(&true) || lit.specular.contains(&true) {
        let smooth = |index: &usize| methods[*index].uses_corner_normals();
        for (index, object) in scene.objects.iter().enumerate().filter(|(index, _)| smooth(index)) {
            let range = object.triangles.start as usize..object.triangles.end as usize;
            let normals = scene.mesh.corner_normals.get(range).unwrap_or_default();
            if normals.iter().any(|corners| !corners.contains(&NO_ATTRIBUTE)) {
                call(Effects::INTERPOLATED_NORMALS, Caller::Object(index));
            }
        }
    }
}

/// Effects of what a pixel is made of: several surfaces, several samples.
fn visit_pixel(scene: &Scene, in_use: &[bool], mut call: impl FnMut(Effects, Caller)) {
    for (index, material) in scene.materials.iter().enumerate() {
        if in_use[index] && material.opacity != 1.0 {
            call(Effects::OPACITY, Caller::Material(index));
        }
    }
    if scene.samples != SampleGrid::CENTRE {
        call(Effects::SUPERSAMPLING, Caller::Image);
    }
}

fn visit_light(
    light: &Light,
    rules: &Rules,
    reflectance: &Reflectance,
    lit: &mut Reflectance,
    mut call: impl FnMut(Effects),
) {
    let black = [0.0; 3];
    let (colors, kind) = match light {
        Light::Ambient(light) => {
            let ambient = light.ambient;
            (LightColors { ambient, diffuse: black, specular: black }, Effects::AMBIENT)
        }
        Light::Directional(light) => (light.colors, Effects::DIRECTIONAL),
        Light::Point(light) => (light.colors, Effects::POINT),
        Light::Spot(light) => (light.colors, Effects::SPOT),
        Light::Hemisphere(light) => {
            if meets(light.top, reflectance.diffuse) || meets(light.bottom, reflectance.diffuse) {
                call(Effects::HEMISPHERE);
                lit.around = true;
            }
            return;
        }
    };
    let ambient = meets(colors.ambient, reflectance.ambient);
    if ambient {
        call(Effects::AMBIENT);
        merge(&mut lit.ambient, colors.ambient);
    }
    let diffuse = meets(colors.diffuse, reflectance.diffuse);
    let specular = meets(colors.specular, reflectance.specular);
    let positional = matches!(light, Light::Point(_) | Light::Spot(_));
    let fades_ambient = rules.attenuate_ambient && positional && ambient;
    if !diffuse && !specular && !fades_ambient {
        return;
    }
    call(kind);
    if light.casts_shadows() && (diffuse || specular) {
        call(Effects::SHADOWS);
    }
    if diffuse {
        call(Effects::DIFFUSE);
        merge(&mut lit.diffuse, colors.diffuse);
    }
    if specular {
        call(Effects::SPECULAR);
        merge(&mut lit.specular, colors.specular);
    }
    let attenuation = match light {
        Light::Point(light) => light.attenuation,
        Light::Spot(light) => light.attenuation,
        Light::Ambient(_) | Light::Directional(_) | Light::Hemisphere(_) => [1.0, 0.0, 0.0],
    };
    if attenuation != [1.0, 0.0, 0.0] {
        call(Effects::ATTENUATION);
    }
    if let Light::Spot(light) = light
        && light.cutoff_deg < 180.0
    {
        call(Effects::CONE);
        if light.exponent != 0.0 {
            call(Effects::EXPONENT);
        }
    }
}

fn visit_material(
    material: &Material,
    rules: &Rules,
    lit: &Reflectance,
    mut call: impl FnMut(Effects),
) {
    let reflects_diffuse = !material.unlit && meets(material.kd, lit.diffuse);
    let reflects_specular = !material.unlit && meets(material.ks, lit.specular);
    if reflects_diffuse {
        call(Effects::DIFFUSE);
    }
    if reflects_specular {
        call(Effects::SPECULAR);
    }
    let shows_diffuse = reflects_diffuse
        || material.unlit
        || lit.around
        || rules.ambient_by_diffuse && meets(material.kd, lit.ambient);
    if material.kd_map.is_some() && shows_diffuse || material.ks_map.is_some() && reflects_specular
    {
        call(Effects::TEXTURES);
    }
}

fn meets(color: LinearRgb, channels: [bool; 3]) -> bool {
    (0..3).any(|channel| color[channel] != 0.0 && channels[channel])
}

fn merge(channels: &mut [bool; 3], color: LinearRgb) {
    for (channel, value) in channels.iter_mut().zip(color) {
        *channel |= value != 0.0;
    }
}

/// One effect, whether a scene calls for it, and who does.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Call {
    /// The effect's name, as in [`Effects::NAMED`].
    pub effect: &'static str,
    /// Whether it is on.
    pub on: bool,
    /// Who calls for it: `light[0] (spot)`, `material "brass"`, `mesh[1] "teapot.obj"`,
    /// `image.samples = 3`; positions are 0-based in file order.
    pub called_by: Vec<String>,
}

/// Every effect, in the order of [`Effects::NAMED`], with who calls for it.
pub fn explain(scene: &Scene) -> Vec<Call> {
    let mut calls = Effects::NAMED.map(|(_, effect)| Call { effect, on: false, called_by: vec![] });
    visit_calls(scene, |effect, caller| {
        let call = &mut calls[effect.position()];
        call.on = true;
        call.called_by.push(describe(scene, caller));
    });
    calls.into()
}

fn describe(scene: &Scene, caller: Caller) -> String {
    match caller {
        Caller::Light(index) => {
            let kind = scene.lights[index].kind();
            format!("light[{index}] ({kind})")
        }
        Caller::Material(index) => format!("material {:?}", scene.materials[index].name),
        Caller::Object(index) => format!("mesh[{index}] {:?}", scene.objects[index].name),
        Caller::Image => format!("image.samples = {}", scene.samples.side()),
    }
}
