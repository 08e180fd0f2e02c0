//! `render --accuracy` on both paths: what it writes, what it says, what it refuses.

use crate::support::program::truecast;
use serde_json::Value;
use std::fs;
use std::path::Path;
use tempfile::TempDir;
use truecast::film::{Film, Samples, load_exr};

const PATHS: [&str; 2] = ["cast", "raster"];
const LEVELS: [&str; 3] = ["double", "watertight", "fast"];

fn render(folder: &Path, more: &[&str]) -> (i32, Value, String) {
    let arguments = ["render", "--size", "64x36", "--json", "--quiet"];
    let (status, stdout, stderr) = truecast(folder, &[&arguments[..], more].concat());
    (status, serde_json::from_str(&stdout).unwrap_or_default(), stderr)
}

fn ids(film: &Film) -> &[u32] {
    match film.plane("id.prim").unwrap() {
        Samples::Uint(ids) => ids,
        other => panic!("ids are whole numbers: {other:?}"),
    }
}

fn description(film: &Film) -> Value {
    serde_json::from_str(&film.description).unwrap()
}

#[test]
fn every_level_renders_on_both_paths_and_says_which() {
    let folder = TempDir::new().unwrap();
    let load = |name: &str| load_exr(&folder.path().join(name)).unwrap();
    assert_eq!(render(folder.path(), &["-o", "exact.exr"]).0, 0);
    let exact = load("exact.exr");
    assert!(description(&exact).get("path").is_none());
    for level in LEVELS {
        for path in PATHS {
            let more = ["--accuracy", level, "--path", path, "--aov", "all", "-o", "a.exr"];
            let (status, report, stderr) = render(folder.path(), &more);
            assert_eq!(status, 0, "{level} {path}: {stderr}");
            let said = [&report["accuracy"], &report["path"], &report["path_chosen_by"]];
            assert_eq!(said, [level, path, "user"]);
            let film = load("a.exr");
            let said = description(&film);
            assert_eq!([&said["accuracy"], &said["path"]], [level, path]);
            let has_grid = (level, path) == ("watertight", "raster");
            assert_eq!(said.get("subpixel_bits").is_some(), has_grid, "{level} {path}");
            // Only what counts has counts.
            assert_eq!(film.plane("cover").is_some(), has_grid, "{level} {path}");
            for plane in ["R", "Z", "N.X", "facing", "verdict.level", "stable", "invalid"] {
                assert!(film.plane(plane).is_some(), "{level} {path}: {plane}");
            }
            let differ = ids(&film).iter().zip(ids(&exact)).filter(|(a, b)| a != b).count();
            assert!(differ < 40, "{level} {path}: {differ}");
            let Samples::Uint(levels) = film.plane("verdict.level").unwrap() else { panic!() };
            let most = levels.iter().max();
            assert_eq!(most, Some(&u32::from(level == "double")), "{level} {path}");
        }
        // The path by itself.
        let more = ["--accuracy", level, "-o", "b.exr"];
        let (status, report, stderr) = render(folder.path(), &more);
        assert_eq!(status, 0, "{stderr}");
        assert_eq!([&report["path"], &report["path_chosen_by"]], ["raster", "accuracy"]);
        assert_eq!(ids(&load("b.exr")), ids(&load("a.exr")), "{level}");
    }
}

#[test]
fn a_fast_depth_buffer_is_in_the_description_and_shows_its_ties() {
    let folder = TempDir::new().unwrap();
    let coarse = ["--accuracy", "fast", "--depth-bits", "16", "--near", "1e-3", "-o", "a.exr"];
    let (status, _, stderr) = render(folder.path(), &coarse);
    assert_eq!(status, 0, "{stderr}");
    let film = load_exr(&folder.path().join("a.exr")).unwrap();
    let expected = serde_json::json!({ "bits": 16, "near": 1e-3, "far": 1000.0 });
    assert_eq!(description(&film)["depth_buffer"], expected);
    let Samples::Uint(ties) = film.plane("verdict.tie").unwrap() else { panic!() };
    assert!(ties.iter().filter(|&&tie| tie != 0).count() > 100);
}

/// Neither threads nor bands show, in a window that begins within a tile.
#[test]
fn threads_do_not_show() {
    let folder = TempDir::new().unwrap();
    for level in LEVELS {
        for path in PATHS {
            let files = ["1", "3"].map(|threads| {
                let name = format!("{threads}.exr");
                let size = ["render", "--size", "160x300", "--crop", "5,7,150,299", "--quiet"];
                let which = ["--accuracy", level, "--path", path, "--threads", threads];
                let arguments = [&size[..], &which, &["-o", &name]].concat();
                let (status, _, stderr) = truecast(folder.path(), &arguments);
                assert_eq!(status, 0, "{stderr}");
                fs::read(folder.path().join(name)).unwrap()
            });
            assert!(files[0] == files[1], "{level} {path}");
        }
    }
}

/// A see-through material, and a light that casts shadows.
const SCENE: &str = r#"version = 1
[image]
width = 16
height = 9
[camera]
eye = [0.0, 0.0, 5.0]
target = [0.0, 0.0, 0.0]
up = [0.0, 1.0, 0.0]
fov_y_deg = 40.0
[[material]]
name = "m"
opacity = 0.5
[[mesh]]
shape = { icosphere = { level = 1 } }
material = "m"
[[light]]
type = "directional"
aim = [0.0, -1.0, -1.0]
intensity = [1.0, 1.0, 1.0]
shadows = false
"#;

#[test]
fn what_takes_certainty_is_refused_with_the_remedy() {
    let folder = TempDir::new().unwrap();
    let shadows = SCENE.replace("shadows = false", "shadows = true").replace("0.5\n", "1.0\n");
    fs::write(folder.path().join("opacity.toml"), SCENE).unwrap();
    fs::write(folder.path().join("shadows.toml"), shadows).unwrap();
    let plain = SCENE.replace("0.5\n", "1.0\n");
    fs::write(folder.path().join("plain.toml"), plain).unwrap();
    let refused = |more: &[&str], words: &[&str]| {
        let (status, _, stderr) = render(folder.path(), more);
        assert_eq!(status, 2, "{more:?}: {stderr}");
        assert!(words.iter().all(|word| stderr.contains(word)), "{more:?}: {stderr}");
    };
    for level in LEVELS {
        for path in PATHS {
            let which = ["--accuracy", level, "--path", path];
            let more = |scene| [&[scene][..], &which].concat();
            refused(&more("opacity.toml"), &["opacity", "use --accuracy exact"]);
            refused(&more("shadows.toml"), &["shadows", "use --accuracy exact"]);
            assert_eq!(render(folder.path(), &more("plain.toml")).0, 0, "{which:?}");
            let cover = [&which[..], &["--aov", "rgba,cover", "-o", "a.exr"]].concat();
            if (level, path) == ("watertight", "raster") {
                assert_eq!(render(folder.path(), &cover).0, 0);
            } else {
                refused(&cover, &["`cover`", "use --accuracy exact, or watertight"]);
            }
            if path == "cast" {
                let bits = [&which[..], &["--depth-bits", "24"]].concat();
                refused(&bits, &["--accuracy watertight or fast on --path raster"]);
            }
            if (level, path) != ("watertight", "raster") {
                let bits = [&which[..], &["--subpixel-bits", "4"]].concat();
                refused(&bits, &["--accuracy watertight on --path raster"]);
            }
        }
    }
    refused(&["--accuracy", "double", "--depth-bits", "24"], &["--accuracy watertight or fast"]);
    refused(&["--accuracy", "best"], &["double", "watertight", "fast"]);
    // What is checked is the exact answer alone.
    let (status, _, stderr) =
        truecast(folder.path(), &["check", "plain.toml", "--accuracy", "fast"]);
    assert!(status == 2 && stderr.contains("--accuracy"), "{stderr}");
}
