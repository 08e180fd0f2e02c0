//! Every special float in the place of every number of a scene: it either renders to planes of
//! numbers, the same by both paths, or is refused with a place.
//!
//! The scenes are in `specials::scenes`; in them each number that is put to the test stands in
//! ‹›. One is replaced at a time.

mod drawn;
mod scenes;

use scenes::{FORMS, Form};
use std::path::Path;
use truecast::check::{self, CheckOptions, Outcome};
use truecast::film::Samples;
use truecast::pixel::Resolution;
use truecast::render::{Accuracy, PlaneGroups, Unwatched, develop};
use truecast::scene::{Overrides, Scene, SceneErrors};

/// Zeros, ends of the ranges of f32 and f64, what overflows when squared or cubed, and no numbers.
const SPECIALS: [&str; 31] = [
    "0.0",
    "-0.0",
    "5e-324",
    "-5e-324",
    "2.2250738585072014e-308",
    "1e-200",
    "1e-45",
    "-1e-45",
    "1e-38",
    "1e-30",
    "-1e-30",
    "1e-19",
    "1.0",
    "-1.0",
    "3.141592653589793",
    "90.0",
    "1e19",
    "-1e19",
    "1e30",
    "1e37",
    "-1e37",
    "8.507059173023462e37",
    "3.4028234663852886e38",
    "-3.4028234663852886e38",
    "1e160",
    "-1e160",
    "1.7976931348623157e308",
    "-1.7976931348623157e308",
    "inf",
    "-inf",
    "nan",
];

/// Planes that a number at the end of f32 or beyond may make infinite.
const OVERFLOWING: [&str; 5] = ["R", "G", "B", "u", "v"];

/// The text with its marked numbers as they stand, but for one.
fn substitute(marked: &str, replaced: Option<(usize, &str)>) -> String {
    let mut parts = marked.split(['‹', '›']);
    let mut text = parts.next().unwrap_or_default().to_owned();
    for (number, pair) in parts.collect::<Vec<_>>().chunks(2).enumerate() {
        match replaced {
            Some((place, special)) if place == number => text.push_str(special),
            _ => text.push_str(pair[0]),
        }
        text.push_str(pair[1]);
    }
    text
}

fn marks(marked: &str) -> usize {
    marked.matches('‹').count()
}

/// What became of a scene.
#[derive(Debug, Default, PartialEq)]
struct Fate {
    refused: usize,
    rendered: usize,
    /// Planes that overflow f32, by name, each once.
    overflowing: Vec<String>,
    /// Scenes whose two answers differ, and in what.
    differing: Vec<String>,
}

/// Renders by both paths, and holds every number of every plane to what it may be.
#[track_caller]
fn assert_sound(loaded: Result<Scene, SceneErrors>, name: &str, fate: &mut Fate) {
    let scene = match loaded {
        Ok(scene) => scene,
        Err(errors) => {
            assert!(!errors.0.is_empty(), "{name}");
            for error in &errors.0 {
                let has_place = error.place.line > 0 && error.place.file.file_name().is_some();
                assert!(has_place && !error.message.is_empty(), "{name}: {error}");
            }
            fate.refused += 1;
            return;
        }
    };
    let options = CheckOptions { audited_pixels: 6, ..CheckOptions::default() };
    let (report, answers) = check::check(&scene, &options, &Unwatched);
    // Weights that differ by 2^-46 read different texels of a map that repeats this often.
    let is_noisy = repetitions(&scene) > 1e4;
    let is_radiance = |judged: &check::Judged| judged.difference.kind == check::Kind::Radiance;
    let is_excused = is_noisy && report.differences.iter().all(is_radiance);
    if report.outcome() == Outcome::Differences && !is_excused {
        fate.differing.push(format!("{name}: {:?}", report.differences));
    }
    for answer in &answers {
        let no_nan = answer.radiance.iter().flatten().all(|c| !c.is_nan() && *c >= 0.0);
        assert!(no_nan, "{name}: {:?}", answer.radiance);
        let film = develop(
            &scene,
            &answer.buffer,
            &answer.radiance,
            &answer.alpha,
            &PlaneGroups::all(),
            Accuracy::Exact,
        );
        for plane in &film.planes {
            let Samples::Float(values) = &plane.samples else { continue };
            assert!(values.iter().all(|value| !value.is_nan()), "{name}: {}", plane.name);
            if values.iter().any(|value| value.is_infinite()) {
                fate.overflowing.push(plane.name.clone());
            }
        }
    }
    fate.overflowing.sort_unstable();
    fate.overflowing.dedup();
    fate.rendered += 1;
}

/// How often a map of the scene repeats over a triangle, at most.
fn repetitions(scene: &Scene) -> f64 {
    let uv = scene.mesh.uvs.iter().flatten().fold(0.0_f64, |most, value| most.max(value.abs()));
    let maps = scene.materials.iter().flat_map(|material| [&material.kd_map, &material.ks_map]);
    let moved = maps.flatten().flat_map(|map| map.scale.into_iter().chain(map.offset));
    moved.fold(0.0, |most, value| most.max(value.abs() * uv.max(1.0)))
}

fn load(
    form: &Form<'_>,
    folder: &Path,
    file: usize,
    replaced: Option<(usize, &str)>,
) -> Result<Scene, SceneErrors> {
    let texts = [form.scene, form.obj, form.mtl];
    let [scene, obj, mtl] =
        std::array::from_fn(|k| substitute(texts[k], replaced.filter(|_| k == file)));
    if !obj.is_empty() {
        std::fs::write(folder.join("mesh.obj"), obj).unwrap();
        std::fs::write(folder.join("mesh.mtl"), mtl).unwrap();
    }
    Scene::from_toml(&scene, Path::new("scene.toml"), folder, &Overrides::default())
}

/// Every mark of a form, every special.
fn audit(form: &Form<'_>) {
    let folder = tempfile::tempdir().unwrap();
    let mut plain = Fate::default();
    assert_sound(load(form, folder.path(), 0, None), form.name, &mut plain);
    assert_eq!(plain, Fate { rendered: 1, ..Fate::default() }, "{} as it stands", form.name);
    let mut fate = Fate::default();
    for (file, text) in [form.scene, form.obj, form.mtl].into_iter().enumerate() {
        for place in 0..marks(text) {
            for special in SPECIALS {
                let before = text.split('‹').take(place + 1).collect::<Vec<_>>().join("");
                let line = before.lines().last().unwrap_or_default();
                let name = format!("{}: {special} after `{line}`", form.name);
                let mut one = Fate::default();
                let loaded = load(form, folder.path(), file, Some((place, special)));
                if matches!(special, "inf" | "-inf" | "nan") {
                    assert!(loaded.is_err(), "{name} is no number");
                }
                assert_sound(loaded, &name, &mut one);
                fate.refused += one.refused;
                fate.rendered += one.rendered;
                fate.differing.extend(one.differing);
                // EXR radiance is never clamped: a colour or a texture coordinate at the end of
                // f32 or beyond may be infinite in its plane. Nothing else may be, and nothing of
                // smaller numbers.
                let ends_f32 = special.parse::<f64>().unwrap().abs() >= f64::from(f32::MAX);
                let may_overflow = |plane: &String| OVERFLOWING.contains(&plane.as_str());
                if !ends_f32 || !one.overflowing.iter().all(may_overflow) {
                    let planes = one.overflowing.iter().map(|plane| format!("{name}: {plane}"));
                    fate.overflowing.extend(planes);
                }
            }
        }
    }
    assert!(fate.refused > 20 && fate.rendered > 20, "{}: {fate:?}", form.name);
    assert!(fate.overflowing.is_empty(), "{}: {:#?}", form.name, fate.overflowing);
    assert!(fate.differing.is_empty(), "{}: {:#?}", form.name, fate.differing);
}

#[test]
fn every_number_of_a_look_at_scene() {
    audit(&FORMS[0]);
}

#[test]
fn every_number_of_an_exact_camera_and_a_matrix() {
    audit(&FORMS[1]);
}

#[test]
fn every_number_of_a_computer_vision_camera() {
    audit(&FORMS[2]);
}

#[test]
fn every_number_of_a_gl_camera_and_of_shapes() {
    audit(&FORMS[3]);
}

/// The least frame and the thinnest ones.
#[test]
fn extreme_frames() {
    let folder = tempfile::tempdir().unwrap();
    for [width, height] in [[1, 1], [1, 65_536], [65_536, 1], [1, 2], [2, 1]] {
        let overrides =
            Overrides { resolution: Resolution::new(width, height), ..Overrides::default() };
        for form in [&FORMS[0], &FORMS[3]] {
            let texts = [form.obj, form.mtl].map(|text| substitute(text, None));
            std::fs::write(folder.path().join("mesh.obj"), &texts[0]).unwrap();
            std::fs::write(folder.path().join("mesh.mtl"), &texts[1]).unwrap();
            let text = substitute(form.scene, None);
            let loaded = Scene::from_toml(&text, Path::new("s.toml"), folder.path(), &overrides);
            let mut fate = Fate::default();
            assert_sound(loaded, &format!("{width} × {height}"), &mut fate);
            assert_eq!(fate, Fate { rendered: 1, ..Fate::default() }, "{width} × {height}");
        }
    }
    for [width, height] in [[0, 1], [1, 0], [65_537, 1], [1, 65_537]] {
        assert_eq!(Resolution::new(width, height), None);
    }
}
