//! Only the effects that a scene calls for: the others change no bit and are never evaluated, each
//! that is called for matters, and what nothing asks for is not built.

pub(crate) mod scenes;

use crate::lighting::neutrality;
use std::fmt::Write;
use std::path::Path;
use std::sync::Mutex;
use truecast::accel::{Accelerator, BuildPreset};
use truecast::color::LinearRgb;
use truecast::mesh::NO_ATTRIBUTE;
use truecast::raster::rasterize;
use truecast::render::{
    Accuracy, Answerer, Progress, RenderOptions, VisibilityPath, describe, expose, render,
};
use truecast::scene::light::Light;
use truecast::scene::material::Material;
use truecast::scene::{Overrides, Scene};
use truecast::shade::{self, Effects};
use truecast::visibility::{Counting, VisibilityBuffer};

/// Effects that `render` makes, not `shade`.
const OF_PIXELS: Effects = Effects::OPACITY.with(Effects::SUPERSAMPLING);

/// The twelve, and small ones that meet the rims of the equation.
fn scenes_of_every_kind() -> Vec<(&'static str, Scene)> {
    let mut all = scenes::scenes(64, 36);
    all.extend(neutrality::scenes());
    all
}

fn look(scene: &Scene) -> VisibilityBuffer {
    let window = scene.camera.resolution().window();
    rasterize(scene, window, Counting::Nearest, &|| ())
}

fn bits(radiance: &[LinearRgb]) -> Vec<[u64; 3]> {
    radiance.iter().map(|rgb| rgb.map(f64::to_bits)).collect()
}

/// Radiance and alpha of a whole exposure.
fn exposed(scene: &Scene, effects: Effects) -> (Vec<[u64; 3]>, Vec<u64>) {
    let answerer = Answerer::Cast(Accelerator::build(&scene.mesh, BuildPreset::Fast));
    // Several samples are asked of the same path: another may differ in the weights' last bits.
    let window = scene.camera.resolution().window();
    let buffer = answerer.answer(scene, window, Counting::Nearest, &|| ());
    let layers = answerer.layers(scene, &buffer, &|| ());
    let seen = (&buffer, &layers);
    let exposure = expose(scene, &answerer, seen, effects, &truecast::render::Unwatched);
    (bits(&exposure.radiance), exposure.alpha.iter().map(|alpha| alpha.to_bits()).collect())
}

#[test]
fn effects_that_are_not_called_for_change_no_bit() {
    for (name, scene) in scenes_of_every_kind() {
        let buffer = look(&scene);
        assert!(buffer.covered_pixels() > 50, "{name}");
        let needed = Effects::of(&scene);
        let reference = shade::shade(&scene, &buffer, Effects::ALL, &|| ());
        let right = bits(&reference.radiance);
        let supersets = Effects::NAMED.map(|(extra, _)| needed.with(extra));
        for effects in supersets.into_iter().chain([needed]) {
            let shaded = shade::shade(&scene, &buffer, effects, &|| ());
            assert!(bits(&shaded.radiance) == right, "{name}: {effects:?}");
            assert_eq!(shaded.notes, reference.notes, "{name}: {effects:?}");
        }
        let forced = shade::shade_ungated(&scene, &buffer);
        assert!(bits(&forced) == right, "{name}: everything evaluated");
        let is_same = exposed(&scene, needed) == exposed(&scene, Effects::ALL);
        assert!(is_same, "{name}: exposed");
    }
}

#[test]
fn effects_that_are_called_for_matter_and_others_are_never_evaluated() {
    let mut met = Effects::NONE;
    for (name, scene) in scenes_of_every_kind() {
        let buffer = look(&scene);
        let needed = Effects::of(&scene);
        met = met.with(needed);
        // Nobody is asked about shadows here.
        let counted = needed.without(OF_PIXELS.with(Effects::SHADOWS));
        let counts = shade::count_evaluations(&scene, &buffer, needed);
        assert_eq!(counts.evaluated(), counted, "{name}: {counts:?}");
        let full = exposed(&scene, needed);
        for (effect, effect_name) in Effects::NAMED {
            if needed.has(effect) {
                let without = exposed(&scene, needed.without(effect));
                assert!(without != full, "{name} without {effect_name}");
            }
        }
    }
    assert_eq!(met, Effects::ALL, "every effect is called for by some scene");
}

#[test]
fn nothing_sets_a_surface_up_where_no_light_has_a_direction() {
    for (name, mut scene) in scenes::scenes(64, 36) {
        // Only ambient parts stay. A face without a normal in f64 would be noted if it were set up.
        scene.lights =
            vec![Light::Ambient(truecast::scene::light::AmbientLight { ambient: [0.5; 3] })];
        for material in &mut scene.materials {
            *material = Material { opacity: material.opacity, ..Material::default_named("m") };
        }
        assert!(scene.mesh.corner_normals.iter().any(|n| !n.contains(&NO_ATTRIBUTE)), "{name}");
        let buffer = look(&scene);
        let counts = shade::count_evaluations(&scene, &buffer, Effects::ALL);
        assert_eq!(counts.of(Effects::INTERPOLATED_NORMALS), 0, "{name}");
        let flattened = flattened(&scene);
        let shaded = shade::shade(&flattened, &buffer, Effects::ALL, &|| ());
        assert_eq!(shaded.notes.missing_normals, 0, "{name}");
        scene.lights = vec![sun()];
        let lit = shade::shade(&self::flattened(&scene), &buffer, Effects::ALL, &|| ());
        assert!(lit.notes.missing_normals > 0, "{name}: the other way round it is noted");
    }
}

/// The scene with all triangles shrunk to a point, after they were seen.
fn flattened(scene: &Scene) -> Scene {
    let mut flat = scene.clone();
    flat.mesh.corner_normals.clear();
    flat.mesh.corners.iter_mut().for_each(|corners| *corners = [corners[0]; 3]);
    flat
}

fn sun() -> Light {
    let scene = scenes::scenes(16, 9).swap_remove(2).1;
    scene.lights[0].clone()
}

/// Keeps the names of the stages that begin.
#[derive(Default)]
struct Stages(Mutex<Vec<String>>);

impl Progress for Stages {
    fn begin(&self, stage: &str, _steps: usize) {
        self.0.lock().unwrap().push(stage.to_owned());
    }
    fn step(&self) {}
}

#[test]
fn the_raster_path_builds_no_tree_and_asks_for_no_layers() {
    let (_, scene) = scenes::scenes(32, 18).swap_remove(6);
    for (path, right) in [
        (VisibilityPath::Raster, ["rasterize", "shade"].as_slice()),
        (VisibilityPath::Cast, &["build", "cast", "shade"]),
    ] {
        let stages = Stages::default();
        render(&scene, &RenderOptions { path, ..RenderOptions::default() }, &stages);
        assert_eq!(*stages.0.lock().unwrap(), right);
    }
}

#[test]
fn a_texture_that_no_triangle_wears_is_not_read() {
    let head = "version = 1\n[image]\nwidth = 4\nheight = 3\n[camera]\neye = [0, 4, 4]\n\
        target = [0, 0, 0]\nup = [0, 1, 0]\nfov_y_deg = 45\n\
        [[material]]\nname = \"idle\"\nkd_map = \"there-is-no-such.png\"\n\
        [[material]]\nname = \"m\"\n[[mesh]]\nshape = { plane = {} }\nmaterial = ";
    let load = |material| {
        let text = format!("{head}\"{material}\"\n");
        let overrides = Overrides::default();
        Scene::from_toml(&text, Path::new("s.toml"), Path::new("nowhere"), &overrides)
    };
    assert!(load("m").unwrap().textures.is_empty());
    assert!(load("idle").is_err(), "the one that is worn is read");
}

#[test]
fn a_picture_names_its_effects() {
    for (name, scene) in scenes::scenes(16, 9) {
        let described = describe(&scene, Accuracy::Exact);
        let names: Vec<_> = Effects::of(&scene).names().collect();
        assert_eq!(described["effects"], serde_json::json!(names), "{name}");
        if name == "everything" {
            let all: Vec<_> = Effects::ALL.names().collect();
            assert_eq!(names, all);
            for new in ["shadows", "textures", "opacity", "supersampling", "hemisphere"] {
                assert!(names.contains(&new), "{new}");
            }
        }
    }
}

#[test]
fn measured_shares_are_shares() {
    let folder = tempfile::tempdir().unwrap();
    let mut text = String::from(
        "version = 1\n[image]\nwidth = 8\nheight = 6\nsamples = 2\n[camera]\neye = [0, 2, 4]\n\
         target = [0, 0, 0]\nup = [0, 1, 0]\nfov_y_deg = 45\n\
         [[material]]\nname = \"m\"\nkd = [0.5, 0.5, 0.5]\nopacity = 0.5\n\
         [[mesh]]\nshape = { torus = {} }\nmaterial = \"m\"\n",
    );
    write!(text, "[[light]]\ntype = \"point\"\nposition = [1, 3, 3]\ndiffuse = [1, 1, 1]\n")
        .unwrap();
    std::fs::write(folder.path().join("s.toml"), text).unwrap();
    let explain = |more: &[&str]| {
        let mut command = assert_cmd::Command::new(env!("CARGO_BIN_EXE_truecast"));
        let output = command.current_dir(folder.path()).args(["explain", "s.toml"]).args(more);
        let output = output.output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).unwrap()
    };
    let json =
        |more: &[&str]| -> serde_json::Value { serde_json::from_str(&explain(more)).unwrap() };
    let document = json(&["--json", "--measure", "--size", "20x16"]);
    let numbers = |value: &serde_json::Value, names: &[&str]| -> Vec<Option<f64>> {
        names.iter().map(|name| value[*name].as_f64()).collect()
    };
    let mut on = Vec::new();
    for entry in document["effects"].as_array().unwrap() {
        let found = numbers(entry, &["share", "median_ms", "mad_ms"]);
        if entry["on"] == true {
            on.push(entry["effect"].as_str().unwrap());
            assert!((0.0..=1.0).contains(&found[0].unwrap()), "{entry}");
            assert!(found[1].unwrap() > 0.0 && found[2].unwrap() >= 0.0, "{entry}");
        } else {
            assert_eq!(found, [None; 3], "{entry}");
        }
    }
    assert_eq!(on, ["point", "diffuse", "interpolated normals", "opacity", "supersampling"]);
    let shading = &document["shading"];
    let names = ["median_ms", "one_sample_median_ms", "megapixels_per_second", "rounds"];
    assert!(numbers(shading, &names).iter().all(|number| number.unwrap() > 0.0), "{shading}");
    let speed = 20.0 * 16.0 * 1e-3 / shading["median_ms"].as_f64().unwrap();
    let said = shading["megapixels_per_second"].as_f64().unwrap();
    // Two quotients of the same two numbers, a few 2^-53 apart.
    assert!((said / speed - 1.0).abs() < 1e-12, "{said} {speed}");
    // In words, and only when asked for.
    let table = explain(&["--measure", "--size", "20x16"]);
    assert!(table.contains("share of shading") && table.contains(" Mpixel/s at 20x16"), "{table}");
    assert_eq!(table.matches(" %  ").count(), on.len(), "{table}");
    let plain = explain(&["--size", "20x16"]);
    assert!(!plain.contains("share") && plain.contains("20x16 pixels"), "{plain}");
    assert_eq!(json(&["--json"]).get("shading"), None);
}
