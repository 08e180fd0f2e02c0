//! `truecast explain`: what a scene is made of and which effects it calls for, and by whom.

mod memory;
mod shares;

use super::arguments::ExplainArguments;
use super::failure::Failure;
use super::{OK, output, prediction};
use serde_json::json;
use truecast::render::{Accuracy, ShadingTimes, describe, predict};
use truecast::scene::material::Material;
use truecast::scene::{Overrides, Scene};
use truecast::shade;

pub(super) fn run(arguments: &ExplainArguments) -> Result<u8, Failure> {
    let scene = Scene::load(
        &arguments.scene,
        &Overrides {
            skip_bad: arguments.skip_bad,
            resolution: arguments.size,
            ..Overrides::default()
        },
    )?;
    output::print_warnings(&scene.warnings);
    output::print_warnings(&advice(&scene));
    let times = arguments.measure.then(|| shares::measure(&scene)).flatten();
    if arguments.json {
        output::print_json(&document(arguments, &scene, times.as_ref()));
    } else {
        output::print(&text(arguments, &scene, times.as_ref()));
    }
    Ok(OK)
}

/// Materials against the usual advice. Said here only: well-known ones go against it on purpose.
fn advice(scene: &Scene) -> Vec<String> {
    let sentence = |material: &Material| {
        let excess = material.excess()?;
        Some(format!(
            "material `{}`: kd + ks is {excess:.3} in a channel; the usual advice is ka + kd + ks \
             below 1, and radiance may exceed 1 here",
            material.name
        ))
    };
    scene.materials.iter().filter_map(sentence).collect()
}

fn text(arguments: &ExplainArguments, scene: &Scene, times: Option<&ShadingTimes>) -> String {
    let camera = &scene.camera;
    let frame = camera.resolution();
    let mut text = format!("{}\n\n", arguments.scene.display());
    text += &format!(
        "image      {}x{} pixels; the sample of pixel (i, j) is (i + 0.5, j + 0.5), y downwards\n",
        frame.width(),
        frame.height()
    );
    text += &format!(
        "camera     eye {:?}\n           d(x, y) = D0 + x DX + y DY\n           D0 {:?}\n           \
         DX {:?}\n           DY {:?}\n           lattice 2^{}; moved the image by {:.1e} pixels\n",
        camera.eye(),
        camera.d0(),
        camera.dx(),
        camera.dy(),
        camera.exponent(),
        camera.deviation_pixels()
    );
    text += &format!(
        "meshes     {}, {} triangles\nmaterials  {}\nlights     {}\n",
        scene.objects.len(),
        scene.mesh.len(),
        scene.materials.len(),
        scene.lights.len()
    );
    text += &memory::line(scene);
    text += &prediction::lines(&predict(scene, frame.window()));
    for (index, material) in scene.materials.iter().enumerate() {
        let Material { name, ka, kd, ks, ke, ns, unlit, .. } = material;
        let unlit = if *unlit { ", unlit" } else { "" };
        text += &format!(
            "material {index} `{name}`: ka {ka:?}, kd {kd:?}, ks {ks:?}, ke {ke:?}, ns {ns}{unlit}\n"
        );
    }
    let heading = if times.is_some() { "share of shading  " } else { "" };
    text += &format!("\neffect                on   {heading}called for by\n");
    for call in shade::explain(scene) {
        let by = match call.called_by.as_slice() {
            [] => "-".to_owned(),
            [first, second, third, rest @ ..] if !rest.is_empty() => {
                format!("{first}, {second}, {third} and {} more", rest.len())
            }
            callers => callers.join(", "),
        };
        let share = times.map(|times| shares::column(times, call.effect)).unwrap_or_default();
        let on = if call.on { "yes" } else { "no" };
        text += &format!("{:<21} {on:<4} {share}{by}\n", call.effect);
    }
    text += &times.map(|times| shares::summary(times, scene)).unwrap_or_default();
    for (object, faults) in shade::flat_faults(scene) {
        let name = &scene.objects[object].name;
        let faults: Vec<_> = faults.iter().map(ToString::to_string).collect();
        text += &format!("\nflat shading of mesh {object} `{name}`: {}\n", faults.join("; "));
    }
    text += &format!("\ndialect    {}\n", scene.switches.dialect);
    if let Some(table) = scene.switches.table().as_object() {
        for (name, value) in table {
            let value = value.as_str().map_or_else(|| value.to_string(), str::to_owned);
            text += &format!("  {name:<20} {value}\n");
        }
    }
    text
}

fn document(
    arguments: &ExplainArguments,
    scene: &Scene,
    times: Option<&ShadingTimes>,
) -> serde_json::Value {
    let effects: Vec<_> = shade::explain(scene)
        .into_iter()
        .map(|call| {
            let mut effect =
                json!({ "effect": call.effect, "on": call.on, "called_by": call.called_by });
            if let Some(times) = times {
                shares::add_to_effect(times, call.effect, &mut effect);
            }
            effect
        })
        .collect();
    let mut document = json!({
        "schema": "truecast/explain/1",
        "scene": arguments.scene.display().to_string(),
        "picture": describe(scene, Accuracy::Exact),
        "lattice_exponent": scene.camera.exponent(),
        "deviation_pixels": scene.camera.deviation_pixels(),
        "triangles": scene.mesh.len(),
        "memory": memory::document(scene),
        "predictions": prediction::predictions_document(&predict(
            scene,
            scene.camera.resolution().window(),
        )),
        "meshes": scene.objects.iter().map(|object| json!({
            "name": object.name,
            "first_triangle": object.triangles.start,
            "triangles": object.triangles.len(),
        })).collect::<Vec<_>>(),
        "materials": scene.materials.iter().map(|material| json!({
            "name": material.name,
            "ka": material.ka,
            "kd": material.kd,
            "ks": material.ks,
            "ke": material.ke,
            "ns": material.ns,
            "unlit": material.unlit,
        })).collect::<Vec<_>>(),
        "lights": scene.light_names,
        "advice": advice(scene),
        "flat_faults": shade::flat_faults(scene).iter().map(|(object, faults)| json!({
            "mesh": object,
            "faults": faults.iter().map(ToString::to_string).collect::<Vec<_>>(),
        })).collect::<Vec<_>>(),
        "effects": effects,
        "warnings": scene.warnings,
    });
    if let Some(times) = times {
        document["shading"] = shares::document(times, scene);
    }
    document
}
