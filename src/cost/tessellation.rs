//! The knob *tessellation*: how finely curved shapes are cut into triangles, and how these are
//! shaded, against the curved surfaces themselves.
//!
//! Every sphere and torus of the scene is made anew at several finenesses and in three shadings; all
//! else stays. Finding what is visible and lighting it are timed, with the tree built before. What
//! is right is told by `analytic` and lit by the same equation, with the surface's own normal at
//! every pixel. Shadows, layers and samples inside a pixel are left out, on both sides.

mod rewriting;
mod surface;

use super::errors::{Counted, Errors, Picture};
use super::levels::seen;
use super::turns::{Candidate, Output, take_turns};
use super::{CostOptions, Knob, Measure, Written, reading};
use crate::accel::BuildPreset;
use crate::render::{Answerer, Progress, VisibilityPath};
use crate::scene::Scene;
use crate::shade::{Effects, shade};
use crate::visibility::Counting;
use rewriting::Rewriting;

pub(super) const NAME: &str = "tessellation";

/// Finenesses, as powers of two of the counts that are written, with their names.
const FINENESS: [(i32, &str); 4] = [(-2, "1/4"), (-1, "1/2"), (0, "1"), (1, "2")];

/// Shadings by their words in scene files.
const SHADINGS: [&str; 3] = ["flat", "gouraud", "phong"];

/// What times are divided by: the scene as it is usually written.
const BASELINE: &str = "phong 1";

/// Prices the finenesses and shadings; or says why the scene has none to price.
pub(super) fn knob(
    written: &Written,
    scene: &Scene,
    options: &CostOptions,
    progress: &dyn Progress,
) -> Result<Knob, String> {
    let rewriting = Rewriting::of(written)?;
    let is_see_through = |&material: &u32| scene.materials[material as usize].opacity != 1.0;
    if scene.triangle_materials.iter().any(is_see_through) {
        return Err("some surface is see-through".to_owned());
    }
    for (mesh, _) in rewriting.curved() {
        let first = scene.objects[*mesh].triangles.start as usize;
        let material = &scene.materials[scene.triangle_materials[first] as usize];
        if material.kd_map.is_some() || material.ks_map.is_some() {
            return Err(format!("`{}` is textured", material.name));
        }
    }
    let read = |text: String| {
        written
            .read(&text, options)
            .map_err(|errors| format!("made anew, the scene is refused: {errors}"))
    };
    let others = read(rewriting.without_curved()?)?;
    let right = surface::picture(scene, &others, &rewriting);
    let mut made = Vec::new();
    for (power, fineness) in FINENESS {
        for shading in SHADINGS {
            let scene = read(rewriting.with(power, shading)?)?;
            let preset = BuildPreset::default();
            let caster = Answerer::new(&scene, VisibilityPath::Cast, preset, progress);
            made.push((format!("{shading} {fineness}"), shading, scene, caster));
        }
    }
    let candidates: Vec<Candidate<'_>> = made
        .iter()
        .map(|(name, shading, scene, caster)| {
            let right = &right;
            Candidate {
                name: name.clone(),
                family: shading,
                triangles: scene.mesh.len(),
                baseline: BASELINE.to_owned(),
                run: Box::new(move || draw(scene, caster)),
                judge: Box::new(move |output| {
                    let thing = |id| scene.object_of(id).0 as u32;
                    let Output::Picture(buffer, radiance) = output else {
                        unreachable!("every candidate draws a picture")
                    };
                    let found = Picture { seen: seen(scene, &buffer, thing), radiance };
                    Errors::of(&found, right, Counted::SameThing)
                }),
            }
        })
        .collect();
    let measure = Measure::Radiance;
    let settings = take_turns(&candidates, measure, options.rounds, (NAME, progress));
    Ok(Knob {
        name: NAME,
        timed: "finding what is visible and lighting it, without shadows",
        against: "the curved surfaces themselves; wrong pixels show another mesh, the other errors \
                  are those of all other pixels",
        measure,
        reading: reading::tessellation(&settings),
        settings,
    })
}

/// One sample per pixel of the nearest surface.
fn draw(scene: &Scene, caster: &Answerer) -> Output {
    let window = scene.camera.resolution().window();
    let buffer = caster.answer(scene, window, Counting::Nearest, &|| ());
    let radiance = shade(scene, &buffer, Effects::of(scene), &|| ()).radiance;
    Output::Picture(buffer, radiance)
}
