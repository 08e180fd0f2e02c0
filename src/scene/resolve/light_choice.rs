//! The lights and their names, and which of them a program asks for.
//!
//! What is asked for beside the scene file serves tests of a light rig: radiance is a sum over the
//! lights, so that one light's part, or the ambient part of all, can be looked at alone.

use super::light;
use super::light_frame::Frames;
use crate::scene::error::{Place, SceneError};
use crate::scene::file::text::Faults;
use crate::scene::file::{SceneFile, suggestion};
use crate::scene::light::{Light, LightColors};
use crate::scene::load::Overrides;

/// The lights that stay, and their names.
pub(super) fn resolve(
    file: &SceneFile,
    frames: &Frames<'_>,
    overrides: &Overrides,
    faults: &mut Faults<'_>,
) -> (Vec<Light>, Vec<String>) {
    let names = names(file, faults);
    let stays = chosen(&names, &overrides.only_lights, faults);
    let mut lights = Vec::new();
    let mut kept = Vec::new();
    for ((written, name), stays) in file.lights.iter().zip(names).zip(stays) {
        // Even a light that goes must be without faults.
        let Some(mut light) = light::resolve(written, frames, faults) else { continue };
        if !stays {
            continue;
        }
        if let (true, Some(colors)) = (overrides.ambient_only, colors(&mut light)) {
            *colors = LightColors { diffuse: [0.0; 3], specular: [0.0; 3], ..*colors };
        }
        lights.push(light);
        kept.push(name);
    }
    (lights, kept)
}

fn names(file: &SceneFile, faults: &mut Faults<'_>) -> Vec<String> {
    let mut names: Vec<String> = Vec::with_capacity(file.lights.len());
    for (index, light) in file.lights.iter().enumerate() {
        let name = match &light.name {
            None => format!("light[{index}]"),
            Some(written) => {
                let name = written.get_ref();
                if names.contains(name) {
                    let message = format!("the name `{name}` is taken by another light");
                    faults.at(&written.span(), message);
                }
                name.clone()
            }
        };
        names.push(name);
    }
    names
}

/// Which lights stay: all, or those of the names or numbers given.
fn chosen(names: &[String], wanted: &[String], faults: &mut Faults<'_>) -> Vec<bool> {
    let mut stays = vec![wanted.is_empty(); names.len()];
    for word in wanted {
        let number = || word.parse::<usize>().ok().filter(|&number| number < names.len());
        match names.iter().position(|name| name == word).or_else(number) {
            Some(index) => stays[index] = true,
            None => {
                let message = format!("there is no light `{word}`");
                let known: Vec<&str> = names.iter().map(String::as_str).collect();
                let help = match known.is_empty() {
                    true => "the scene has no `[[light]]`".to_owned(),
                    false => suggestion(word, &known),
                };
                let place = Place::file(faults.file);
                faults.errors.push(SceneError::scene(place, message).with_help(help));
            }
        }
    }
    stays
}

/// The colours of a light that has more than an ambient one.
fn colors(light: &mut Light) -> Option<&mut LightColors> {
    match light {
        Light::Directional(light) => Some(&mut light.colors),
        Light::Point(light) => Some(&mut light.colors),
        Light::Spot(light) => Some(&mut light.colors),
        _ => None,
    }
}
