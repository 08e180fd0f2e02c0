//! Several samples per pixel as a user meets them: scene files, options, files and the check.
//!
//! What a sample is worth is tested in `scale::supersampling`.

use crate::support::program::truecast;
use std::fs;
use std::path::Path;
use tempfile::TempDir;
use truecast::film::{Film, Samples, decode_exr};

const SCENE: &str = r#"version = 1
[image]
width = 40
height = 30
background = [0.0, 0.25, 0.0]
[camera]
eye = [0.0, 0.0, 5.0]
target = [0.0, 0.0, 0.0]
up = [0.0, 1.0, 0.0]
fov_y_deg = 40.0
[[material]]
name = "glass"
kd = [0.5, 0.5, 0.5]
ks = [0.5, 0.5, 0.5]
ns = 200.0
opacity = 0.5
[[mesh]]
shape = { torus = { major = 1.0, minor = 0.35, around = 24, across = 12 } }
material = "glass"
rotate_deg = [50.0, 0.0, 20.0]
[[light]]
type = "point"
position = [1.0, 2.0, 4.0]
intensity = [1.0, 1.0, 1.0]
"#;

fn folder(scene: &str) -> TempDir {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("s.toml"), scene).unwrap();
    folder
}

fn rendered(folder: &Path, name: &str, more: &[&str]) -> Film {
    let file = format!("{name}.exr");
    let mut arguments = vec!["render", "s.toml", "-o", &file, "--quiet"];
    arguments.extend(more);
    let (status, _, errors) = truecast(folder, &arguments);
    assert_eq!(status, 0, "{errors}");
    decode_exr(&fs::read(folder.join(file)).unwrap()).unwrap()
}

/// The bits of one value of a plane.
fn number(samples: &Samples, index: usize) -> u32 {
    match samples {
        Samples::Float(values) => values[index].to_bits(),
        Samples::Uint(values) => values[index],
    }
}

#[test]
fn the_command_line_wins_and_the_picture_says_it() {
    let folder = folder(&SCENE.replace("height = 30", "height = 30\nsamples = 3"));
    let folder = folder.path();
    let written = rendered(folder, "written", &[]);
    let samples = |film: &Film| {
        let description: serde_json::Value = serde_json::from_str(&film.description).unwrap();
        description["samples"].clone()
    };
    assert_eq!(samples(&written), 3);
    let plain = rendered(folder, "plain", &["--samples", "1"]);
    assert_eq!(samples(&plain), serde_json::Value::Null);
    assert_ne!(written.planes, plain.planes);
    let two = rendered(folder, "two", &["--samples", "2"]);
    assert_eq!(samples(&two), 2);
    for wrong in ["0", "17", "-1", "2.5", "many"] {
        let (status, _, errors) = truecast(folder, &["render", "s.toml", "--samples", wrong]);
        assert_eq!(status, 2, "{wrong}: {errors}");
    }
}

#[test]
fn crops_and_threads_change_no_bit() {
    let folder = folder(SCENE);
    let folder = folder.path();
    for path in ["cast", "raster"] {
        let options = ["--samples", "3", "--path", path];
        let whole = rendered(folder, "whole", &options);
        for threads in ["1", "2"] {
            let more: Vec<&str> = options.iter().copied().chain(["--threads", threads]).collect();
            assert_eq!(rendered(folder, "again", &more).planes, whole.planes);
        }
        let more: Vec<&str> = options.iter().copied().chain(["--crop", "7,5,33,22"]).collect();
        let crop = rendered(folder, "crop", &more);
        for (part, all) in crop.planes.iter().zip(&whole.planes) {
            for (index, pixel) in crop.window.pixels().enumerate() {
                let from = whole.window.index(pixel);
                assert_eq!(
                    number(&part.samples, index),
                    number(&all.samples, from),
                    "{}",
                    part.name
                );
            }
        }
    }
}

#[test]
fn the_check_compares_means_and_layers() {
    let folder = folder(SCENE);
    let arguments = ["check", "s.toml", "--samples", "3", "--json", "--audit", "100"];
    let (status, text, errors) = truecast(folder.path(), &arguments);
    assert_eq!(status, 0, "{errors}");
    let document: serde_json::Value = serde_json::from_str(&text).unwrap();
    let scene = &document["scenes"][0];
    assert_eq!(scene["samples"], 3);
    assert!(scene["layered_pixels"].as_u64().unwrap() > 100, "{scene}");
    assert!(scene["audited_layered_pixels"].as_u64().unwrap() > 30, "{scene}");
    let (status, text, _) = truecast(folder.path(), &["check", "s.toml"]);
    assert!(status == 0 && text.contains("see through a surface"), "{text}");
    let (status, text, _) = truecast(folder.path(), &["explain", "s.toml"]);
    assert!(
        status == 0 && text.contains("opacity               yes  material \"glass\""),
        "{text}"
    );
}
