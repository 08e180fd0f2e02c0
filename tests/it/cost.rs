//! What accuracy costs: prices of both knobs, against what is known of them, and what has no price.

use crate::support::program::truecast;
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

fn scene_file(name: &str) -> String {
    let path: PathBuf = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(name);
    path.to_str().unwrap().to_owned()
}

/// The prices of the built-in scene, or of those named, quickly.
fn prices(folder: &Path, more: &[&str]) -> Value {
    let mut arguments = vec!["cost", "--json", "--rounds", "2", "--threads", "1"];
    if !more.contains(&"--size") {
        arguments.extend(["--size", "160x90"]);
    }
    arguments.extend(more);
    let (status, stdout, stderr) = truecast(folder, &arguments);
    assert_eq!((status, &*stderr), (0, ""));
    serde_json::from_str(&stdout).unwrap()
}

fn settings<'a>(report: &'a Value, knob: &str) -> &'a Vec<Value> {
    let knobs = report["scenes"][0]["knobs"].as_array().unwrap();
    let knob = knobs.iter().find(|own| own["knob"] == knob).expect("the scene has the knob");
    knob["settings"].as_array().unwrap()
}

fn number(setting: &Value, key: &str) -> f64 {
    setting[key].as_f64().unwrap_or_else(|| panic!("{key} of {setting}"))
}

#[test]
fn the_report_has_its_fields_in_every_format() {
    let folder = TempDir::new().unwrap();
    let files = ["-o", "a.json", "-o", "a.csv", "-o", "a.svg"];
    let report = prices(folder.path(), &files);
    assert_eq!(report["schema"], "truecast/cost/1");
    assert_eq!((&report["threads"], &report["rounds"]), (&1.into(), &2.into()));
    let read = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
    assert_eq!(serde_json::from_str::<Value>(&read("a.json")).unwrap(), report);
    let all = [settings(&report, "accuracy"), settings(&report, "tessellation")];
    let (csv, svg) = (read("a.csv"), read("a.svg"));
    assert_eq!(csv.lines().count(), 1 + all[0].len() + all[1].len());
    for setting in all.into_iter().flatten() {
        let name = setting["name"].as_str().unwrap();
        for key in ["median_ms", "min_ms", "ratio", "triangles"] {
            assert!(number(setting, key) > 0.0, "{name}: {key}");
        }
        assert!(csv.contains(name) && svg.contains(&format!("{name}: ")), "{name}");
        if setting["baseline"] == setting["name"] {
            assert_eq!(number(setting, "ratio"), 1.0, "{name}");
        }
    }
    for knob in report["scenes"][0]["knobs"].as_array().unwrap() {
        assert!(knob["reading"].as_str().unwrap().ends_with('.'), "{knob}");
        let settings = knob["settings"].as_array().unwrap();
        let on_frontier = settings.iter().filter(|s| s["frontier"] == true).count();
        assert!((1..=settings.len()).contains(&on_frontier));
    }
}

#[test]
fn exact_levels_are_right_and_coarser_grids_are_more_wrong() {
    let folder = TempDir::new().unwrap();
    let report = prices(folder.path(), &["--size", "320x180"]);
    let wrong = |name: &str| {
        let all = settings(&report, "accuracy");
        let setting = all.iter().find(|s| s["name"] == name).unwrap_or_else(|| panic!("{name}"));
        number(setting, "wrong_pixels")
    };
    assert_eq!((wrong("cast exact"), wrong("raster exact")), (0.0, 0.0));
    let [four, eight, twelve] = ["4 bits", "8 bits", "12 bits below the pixel"]
        .map(|bits| wrong(&format!("raster watertight, {bits}")));
    // f64 errs nowhere here, and a depth buffer of 16 bits where f32 does not.
    assert_eq!((wrong("cast double"), wrong("raster double")), (0.0, 0.0));
    let [fast, d24, d16] = ["", ", 24-bit depth", ", 16-bit depth"]
        .map(|buffer| wrong(&format!("raster fast{buffer}")));
    assert!(fast <= d24 && d24 < d16, "{fast} {d24} {d16}");
    // A vertex moves 16 times as far with 4 bits as with 8, and 256 times as far as with 12.
    assert!(four > 4.0 * eight && eight > twelve, "{four} {eight} {twelve}");
}

/// An error that is of second order in the size of triangles falls at least this many times where
/// they are half as large: 4 in the limit, less where few pixels see outlines.
const SECOND_ORDER: f64 = 3.0;

/// One of first order: 2 in the limit.
const FIRST_ORDER: f64 = 1.6;

#[test]
fn errors_against_the_curved_surface_fall_as_they_must() {
    let folder = TempDir::new().unwrap();
    let report = prices(folder.path(), &["--size", "320x180"]);
    let rms = |name: &str| {
        let all = settings(&report, "tessellation");
        let setting = all.iter().find(|s| s["name"] == name).unwrap_or_else(|| panic!("{name}"));
        assert!(number(setting, "max_radiance_error") >= number(setting, "rms_radiance_error"));
        number(setting, "rms_radiance_error")
    };
    // One normal per triangle errs by its size; interpolated ones by its square. A wrong reference
    // would leave an error that no fineness removes.
    for (coarse, fine) in [("1/4", "1/2"), ("1/2", "1"), ("1", "2")] {
        let fall =
            |shading: &str| rms(&format!("{shading} {coarse}")) / rms(&format!("{shading} {fine}"));
        assert!(fall("flat") > FIRST_ORDER, "{coarse}: {}", fall("flat"));
        assert!(fall("phong") > SECOND_ORDER, "{coarse}: {}", fall("phong"));
    }
    for fineness in ["1/4", "1/2", "1", "2"] {
        let [flat, gouraud, phong] =
            ["flat", "gouraud", "phong"].map(|shading| rms(&format!("{shading} {fineness}")));
        assert!(phong < gouraud && gouraud < flat, "{fineness}: {phong} {gouraud} {flat}");
    }
    let wrong: Vec<f64> = settings(&report, "tessellation")
        .iter()
        .filter(|setting| setting["family"] == "phong")
        .map(|setting| number(setting, "wrong_pixels"))
        .collect();
    assert!(wrong.is_sorted_by(|a, b| a > b), "outlines come nearer too: {wrong:?}");
}

/// A scene of one icosphere in a textured or see-through material, or of a box.
fn scene_of(shape: &str, material: &str) -> String {
    format!(
        r#"version = 1
[image]
width = 32
height = 18
[camera]
eye = [0.0, 0.0, 5.0]
target = [0.0, 0.0, 0.0]
up = [0.0, 1.0, 0.0]
fov_y_deg = 40.0
[[material]]
name = "m"
{material}
[[mesh]]
shape = {{ {shape} }}
material = "m"
rotate_deg = [10.0, 20.0, 30.0]
scale = [1.0, 0.5, 1.0]
[[light]]
type = "directional"
aim = [0.0, -1.0, -1.0]
intensity = [1.0, 1.0, 1.0]
"#
    )
}

#[test]
fn a_knob_that_a_scene_has_not_is_left_out_with_the_reason() {
    let folder = TempDir::new().unwrap();
    let cases = [
        ("box = { segments = 1 }", "", "no mesh of the scene is a `torus`"),
        ("icosphere = { level = 2 }", "opacity = 0.5", "see-through"),
    ];
    for (shape, material, reason) in cases {
        fs::write(folder.path().join("s.toml"), scene_of(shape, material)).unwrap();
        let report = prices(folder.path(), &["s.toml", "--size", "32x18"]);
        assert_eq!(report["scenes"][0]["knobs"].as_array().unwrap().len(), 1, "{shape}");
        let left_out = report["scenes"][0]["left_out"][0].as_str().unwrap();
        assert!(left_out.contains(reason), "{left_out}");
    }
    // A lone curved mesh, squeezed and turned, has both.
    fs::write(folder.path().join("s.toml"), scene_of("icosphere = { level = 3 }", "")).unwrap();
    let report = prices(folder.path(), &["s.toml", "--size", "64x36"]);
    let phong: Vec<f64> = settings(&report, "tessellation")
        .iter()
        .filter(|setting| setting["family"] == "phong")
        .map(|setting| number(setting, "rms_radiance_error"))
        .collect();
    assert!(phong[0] > FIRST_ORDER * phong[1] && phong[2] > FIRST_ORDER * phong[3], "{phong:?}");
}

#[test]
fn what_cannot_be_priced_is_refused() {
    let folder = TempDir::new().unwrap();
    let refused = |arguments: &[&str], status: i32, word: &str| {
        let mut all = vec!["cost"];
        all.extend(arguments);
        let (found, stdout, stderr) = truecast(folder.path(), &all);
        assert_eq!((found, &*stdout), (status, ""), "{stderr}");
        assert!(stderr.contains(word), "{stderr}");
    };
    refused(&["-o", "prices.html"], 2, "end it in .json, .csv or .svg");
    refused(&["-o", "missing/prices.json"], 4, "missing");
    refused(&["--rounds", "0"], 2, "expected a whole number");
    refused(&["--accuracy", "best"], 2, "--accuracy");
    refused(&["missing.toml"], 4, "missing.toml");
    fs::write(folder.path().join("bad.toml"), "version = 2\n").unwrap();
    refused(&["bad.toml"], 3, "bad.toml");
    fs::write(folder.path().join("bytes.toml"), [0x76, 0xff]).unwrap();
    refused(&["bytes.toml"], 3, "UTF-8");
    let away = scene_of("torus = { major = 1.0 }", "")
        .replace("target = [0.0, 0.0, 0.0]", "target = [0.0, 0.0, 9.0]");
    fs::write(folder.path().join("away.toml"), away).unwrap();
    refused(&["away.toml"], 3, "no triangle is visible");
    // What is wrong anywhere is found before anything is timed.
    refused(&[&scene_file("cost.toml"), "missing.toml"], 4, "missing.toml");
}
