//! `name` of a light, `render --light` and `--ambient-only`: parts of a sum looked at alone.

use assert_cmd::Command;
use std::fs;
use std::path::Path;
use tempfile::TempDir;
use truecast::film::Samples;
use truecast::render::{PlaneGroup, PlaneGroups, RenderOptions, Unwatched, render};
use truecast::scene::{Overrides, Scene};

const SCENE: &str = r#"version = 1
[image]
width = 40
height = 30
[camera]
eye = [0.0, 0.0, 5.0]
target = [0.0, 0.0, 0.0]
up = [0.0, 1.0, 0.0]
fov_y_deg = 40.0
[[material]]
name = "m"
ka = [0.25, 0.5, 0.125]
kd = [0.5, 0.4, 0.3]
ks = [0.3, 0.3, 0.3]
[[mesh]]
shape = { uv_sphere = {} }
material = "m"
[[light]]
type = "ambient"
ambient = [0.1, 0.2, 0.3]
[[light]]
name = "key"
type = "point"
position = [1.0, 2.0, 4.0]
intensity = [1.0, 1.0, 1.0]
ambient = [0.05, 0.05, 0.05]
[[light]]
name = "fill"
type = "spot"
position = [-3.0, 1.0, 4.0]
target = [0.0, 0.0, 0.0]
cutoff_deg = 30
intensity = [0.5, 0.4, 0.3]
"#;

fn load(only: &[&str], ambient_only: bool) -> Result<Scene, String> {
    let only_lights = only.iter().map(ToString::to_string).collect();
    let overrides = Overrides { only_lights, ambient_only, ..Overrides::default() };
    Scene::from_toml(SCENE, Path::new("t.toml"), Path::new(""), &overrides)
        .map_err(|errors| errors.to_string())
}

/// R, G and B, one after the other.
fn picture(only: &[&str], ambient_only: bool) -> Vec<f32> {
    let planes = PlaneGroups::default().with(PlaneGroup::Color);
    let options = RenderOptions { planes, ..RenderOptions::default() };
    let film = render(&load(only, ambient_only).unwrap(), &options, &Unwatched).film;
    let samples = |name| match film.plane(name).unwrap() {
        Samples::Float(samples) => samples.clone(),
        Samples::Uint(_) => panic!("{name} is float"),
    };
    ["R", "G", "B"].into_iter().flat_map(samples).collect()
}

/// Four samples are rounded to f32 (2^-24 of at most their sum each), and added in f64.
const SUM_TOLERANCE: f64 = 4.0 / (1 << 24) as f64;

#[test]
fn a79_the_lights_alone_add_up_to_the_picture() {
    let full = picture(&[], false);
    let parts = ["light[0]", "key", "fill"].map(|name| picture(&[name], false));
    assert_eq!(parts[1], picture(&["1"], false));
    assert_eq!(full, picture(&["fill", "0", "key"], false));
    let mut lit = 0;
    for (index, &expected) in full.iter().enumerate() {
        let sum: f64 = parts.iter().map(|part| f64::from(part[index])).sum();
        assert!(
            (sum - f64::from(expected)).abs() <= SUM_TOLERANCE * sum,
            "{index}: {sum} {expected}"
        );
        lit += usize::from(parts[1][index] > 0.0 && parts[2][index] > 0.0);
    }
    assert!(lit > 100, "{lit} samples have several lights");
}

#[test]
fn a79_ambient_only_is_ka_times_the_ambient_parts() {
    let picture = picture(&[], true);
    // ka · (0.1 + 0.05, 0.2 + 0.05, 0.3 + 0.05) wherever the sphere is.
    for (channel, expected) in [0.25 * 0.15, 0.5 * 0.25, 0.125 * 0.35].into_iter().enumerate() {
        let samples = &picture[channel * 1200..(channel + 1) * 1200];
        let lit: Vec<f32> = samples.iter().copied().filter(|&sample| sample != 0.0).collect();
        assert!(lit.len() > 100);
        // One rounding to f32.
        assert!(
            lit.iter().all(|&sample| (f64::from(sample) - expected).abs() <= 1e-8),
            "{expected}"
        );
    }
    let key = load(&["key"], true).unwrap();
    assert_eq!((key.lights.len(), key.light_names), (1, vec!["key".to_owned()]));
}

#[test]
fn a79_unknown_lights_and_names_taken_twice_are_refused() {
    let message = load(&["fil"], false).unwrap_err();
    assert!(message.contains("t.toml: there is no light `fil`"), "{message}");
    assert!(message.contains("did you mean `fill`?"), "{message}");
    assert!(load(&["3"], false).unwrap_err().contains("there is no light `3`"));
    let text = SCENE.replace("\"fill\"", "\"key\"");
    let twice = Scene::from_toml(&text, Path::new("t"), Path::new(""), &Overrides::default());
    let message = twice.unwrap_err().to_string();
    assert!(message.contains("the name `key` is taken by another light"), "{message}");
    let names = load(&[], false).unwrap().light_names;
    assert_eq!(names, ["light[0]", "key", "fill"]);
}

#[test]
fn a79_the_program_knows_both_options() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("s.toml"), SCENE).unwrap();
    let status = |more: &[&str], file: &str| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_truecast"));
        command.current_dir(folder.path()).args(["render", "s.toml", "--quiet", "-o", file]);
        command.args(more).output().unwrap().status.code()
    };
    assert_eq!(status(&["--light", "key", "--light", "2"], "two.exr"), Some(0));
    assert_eq!(status(&["--ambient-only"], "ambient.exr"), Some(0));
    assert_eq!(status(&["--light", "keyy"], "none.exr"), Some(3));
    assert!(!folder.path().join("none.exr").exists());
    let green = |file: &str| {
        let film = truecast::film::load_exr(&folder.path().join(file)).unwrap();
        let Samples::Float(samples) = film.plane("G").unwrap() else { panic!("float") };
        samples.clone()
    };
    assert_eq!(green("two.exr"), picture(&["key", "fill"], false)[1200..2400]);
    assert_eq!(green("ambient.exr"), picture(&[], true)[1200..2400]);
}
