//! `truecast check --ids --depth` as a user meets it.

use crate::support::program::truecast;
use std::path::Path;
use tempfile::TempDir;

const SCENE: &str = r#"version = 1
[image]
width = 48
height = 36
[camera]
eye = [0.3, 0.2, 5.0]
target = [0.0, 0.0, 0.0]
up = [0.0, 1.0, 0.0]
fov_y_deg = 40.0
[[mesh]]
file = "mesh.obj"
"#;

const MESH: &str = "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nv 1.5 1.5 -2\nf 1 2 3\nf 2 4 3\n";

fn folder() -> TempDir {
    let folder = TempDir::new().unwrap();
    std::fs::write(folder.path().join("scene.toml"), SCENE).unwrap();
    std::fs::write(folder.path().join("mesh.obj"), MESH).unwrap();
    let made = truecast(
        folder.path(),
        &["render", "scene.toml", "-o", "ids.npy", "-o", "all.exr", "--quiet"],
    );
    assert_eq!(made.0, 0, "{}", made.2);
    folder
}

fn check(folder: &Path, arguments: &[&str]) -> (i32, String, String) {
    truecast(folder, &[&["check", "scene.toml"], arguments].concat())
}

#[test]
fn our_own_files_agree() {
    let folder = folder();
    for arguments in [
        &["--ids", "ids.npy"][..],
        &["--ids", "all.exr"],
        &["--depth", "all.exr"],
        &["--ids", "all.exr", "--depth", "all.exr", "--depth-channel", "t"],
    ] {
        let (status, stdout, stderr) = check(folder.path(), arguments);
        assert_eq!(status, 0, "{arguments:?}: {stdout}{stderr}");
        assert!(stdout.contains("no error in their picture"), "{stdout}");
    }
}

#[test]
fn an_error_is_named_with_both_triangles_and_written() {
    let folder = folder();
    // Everything one too high: the first triangle is taken for the second.
    let options = ["--ids", "ids.npy", "--id-base", "1", "--background", "4294967295"];
    let (status, stdout, _) = check(folder.path(), &options);
    assert_eq!(status, 1);
    for words in
        ["errors in their picture", "mesh.obj:", "truecast pixel scene.toml ", "--id-base 0"]
    {
        assert!(stdout.contains(words), "no {words} in {stdout}");
    }
    let written = ["--diff", "d.png", "--csv", "d.csv", "--quiet"];
    let (status, stdout, _) = check(folder.path(), &[&options[..], &written].concat());
    assert_eq!((status, stdout.as_str()), (1, ""));
    let csv = std::fs::read_to_string(folder.path().join("d.csv")).unwrap();
    assert!(csv.starts_with("x,y,class,") && csv.contains(",wrong,"), "{csv}");
    let png = std::fs::read(folder.path().join("d.png")).unwrap();
    assert!(png.starts_with(b"\x89PNG"));
    let (_, stdout, _) = check(folder.path(), &[&options[..], &["--json"]].concat());
    let document: serde_json::Value = serde_json::from_str(&stdout).unwrap();
    assert_eq!(document["schema"], "truecast/audit/1");
    assert!(document["counts"]["wrong"].as_u64().unwrap() > 0);
}

#[test]
fn bad_files_have_their_exit_statuses() {
    let folder = folder();
    let refused = |arguments: &[&str], expected: i32, words: &[&str]| {
        let (status, stdout, stderr) = check(folder.path(), arguments);
        assert_eq!((status, stdout.as_str()), (expected, ""), "{arguments:?}: {stderr}");
        for word in words {
            assert!(stderr.contains(word), "no {word} in {stderr}");
        }
    };
    refused(&["--ids", "none.npy"], 4, &["none.npy"]);
    refused(&["--ids", "scene.toml"], 4, &[".npy, .png or .exr"]);
    refused(&["--ids", "all.exr", "--ids-channel", "no"], 4, &["`no`", "id.prim"]);
    refused(&["--ids", "ids.npy", "--size", "50x36"], 3, &["48x36", "50x36"]);
    refused(&["--ids", "ids.npy", "--size", "36x48"], 3, &["transpose"]);
    refused(&["--depth", "ids.png"], 2, &["PNG"]);
    refused(&["scene.toml", "--ids", "ids.npy"], 2, &["one scene"]);
    refused(&["--ids", "ids.npy", "--pixel", "1,1"], 2, &["--pixel"]);
    // Fractions are no ids.
    refused(&["--ids", "all.exr", "--ids-channel", "Z"], 3, &["not the number of a triangle"]);
}

#[test]
fn nothing_to_check_is_not_a_pass() {
    let folder = folder();
    let mesh = "v -1 -1 9\nv 1 -1 9\nv 0 1 9\nf 1 2 3\n";
    std::fs::write(folder.path().join("mesh.obj"), mesh).unwrap();
    let made = truecast(folder.path(), &["render", "scene.toml", "-o", "no.npy", "--quiet"]);
    assert_eq!(made.0, 0, "{}", made.2);
    assert_eq!(check(folder.path(), &["--ids", "no.npy"]).0, 3);
}
