//! Opacity as a user meets it: what `pixel` says, and what cannot be had.

use crate::support::program::truecast;
use std::fs;
use tempfile::TempDir;

const SCENE: &str = r#"version = 1
[image]
width = 9
height = 9
[camera]
eye = [0.0, 0.0, 5.0]
target = [0.0, 0.0, 0.0]
up = [0.0, 1.0, 0.0]
fov_y_deg = 40.0
[[material]]
name = "pane"
opacity = 0.25
[[mesh]]
shape = { plane = { width = 9.0, depth = 9.0 } }
material = "pane"
rotate_deg = [90.0, 0.0, 0.0]
[[mesh]]
shape = { plane = { width = 9.0, depth = 9.0 } }
rotate_deg = [90.0, 0.0, 0.0]
translate = [0.0, 0.0, -1.0]
[[mesh]]
shape = { plane = { width = 9.0, depth = 9.0 } }
rotate_deg = [90.0, 0.0, 0.0]
translate = [0.0, 0.0, -2.0]
[[light]]
type = "ambient"
ambient = [1.0, 1.0, 1.0]
"#;

#[test]
fn pixel_tells_the_share_of_every_surface() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("s.toml"), SCENE).unwrap();
    let (status, text, errors) = truecast(folder.path(), &["pixel", "s.toml", "2", "4", "--json"]);
    assert_eq!(status, 0, "{errors}");
    let document: serde_json::Value = serde_json::from_str(&text).unwrap();
    let candidates = document["candidates"].as_array().unwrap();
    let of = |key: &str| -> Vec<f64> {
        let covering = candidates.iter().filter(|candidate| candidate["covers"] == true);
        covering.map(|candidate| candidate[key].as_f64().unwrap()).collect()
    };
    assert_eq!(of("opacity"), [0.25, 1.0, 1.0]);
    assert_eq!(of("share"), [0.25, 0.75, 0.0]);
    let (_, text, _) = truecast(folder.path(), &["pixel", "s.toml", "2", "4"]);
    for words in ["visible; ", "opacity 0.25, share 0.25", "seen through; ", "hidden; "] {
        assert!(text.contains(words), "no {words:?} in {text}");
    }
}

#[test]
fn the_watertight_rasterizer_refuses_what_it_cannot_order() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("s.toml"), SCENE).unwrap();
    let arguments = ["render", "s.toml", "--path", "raster", "--accuracy", "watertight"];
    let (status, _, errors) = truecast(folder.path(), &arguments);
    assert!(status == 2 && errors.contains("opacity"), "{status}: {errors}");
    fs::write(folder.path().join("s.toml"), SCENE.replace("0.25", "1.0")).unwrap();
    let (status, _, errors) = truecast(folder.path(), &arguments);
    assert_eq!(status, 0, "{errors}");
}
