//! The program as a user meets it: files written, exit statuses, one clear error for bad input.

use crate::support::program;
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// A scene small enough to render in a blink: one triangle before the eye, one light.
const SCENE: &str = r#"version = 1
[image]
width = 40
height = 30
[camera]
eye = [0.0, 0.0, 5.0]
target = [0.0, 0.0, 0.0]
up = [0.0, 1.0, 0.0]
fov_y_deg = 40.0
[[mesh]]
file = "mesh.obj"
[[light]]
type = "point"
position = [1.0, 2.0, 4.0]
intensity = [1.0, 1.0, 1.0]
"#;

const MESH: &str = "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n";

/// A folder with a scene and its mesh.
struct Folder(TempDir);

impl Folder {
    fn new() -> Self {
        let folder = Self(TempDir::new().unwrap());
        folder.write("scene.toml", SCENE);
        folder.write("mesh.obj", MESH);
        folder
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn write(&self, name: &str, text: &str) {
        fs::write(self.path(name), text).unwrap();
    }

    fn names(&self) -> Vec<String> {
        let mut names: Vec<_> = fs::read_dir(self.0.path())
            .unwrap()
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }
}

/// What a run printed, and its exit status.
struct Ran {
    status: i32,
    stdout: String,
    stderr: String,
}

fn truecast(folder: &Path, arguments: &[&str]) -> Ran {
    let (status, stdout, stderr) = program::truecast(folder, arguments);
    Ran { status, stdout, stderr }
}

/// Renders a bad scene; demands the status, one error line with these words, and no new file.
fn assert_refused(folder: &Folder, arguments: &[&str], status: i32, words: &[&str]) {
    let before = folder.names();
    let ran = truecast(folder.0.path(), arguments);
    assert_eq!(ran.status, status, "{arguments:?}: {}", ran.stderr);
    assert_eq!(ran.stdout, "", "{arguments:?}");
    for word in words {
        assert!(ran.stderr.contains(word), "{arguments:?}: no {word:?} in {}", ran.stderr);
    }
    let errors = ran.stderr.lines().filter(|line| line.starts_with("error")).count();
    assert_eq!(errors, 1, "one error, not\n{}", ran.stderr);
    assert_eq!(folder.names(), before, "{arguments:?} left files behind");
}

#[test]
fn the_default_scene_renders_to_png_and_exr() {
    let folder = TempDir::new().unwrap();
    let ran = truecast(folder.path(), &["render", "--size", "96x54"]);
    assert_eq!(ran.status, 0, "{}", ran.stderr);
    assert!(ran.stdout.contains("wrote truecast.png") && ran.stdout.contains("truecast.exr"));
    for (name, magic) in [("truecast.png", &b"\x89PNG"[..]), ("truecast.exr", &b"v/1\x01"[..])] {
        assert!(fs::read(folder.path().join(name)).unwrap().starts_with(magic), "{name}");
    }
}

#[test]
fn a_scene_is_written_under_its_name_and_to_every_output() {
    let folder = Folder::new();
    assert_eq!(truecast(folder.0.path(), &["render", "scene.toml", "--quiet"]).status, 0);
    let arguments = ["render", "scene.toml", "-o", "ids.npy", "-o", "PICTURE.EXR", "--quiet"];
    assert_eq!(truecast(folder.0.path(), &arguments).status, 0);
    let names = folder.names();
    for name in ["scene.png", "scene.exr", "ids.npy", "PICTURE.EXR"] {
        assert!(names.iter().any(|n| n == name), "{name} is missing from {names:?}");
    }
    assert_eq!(names.len(), 6, "nothing else: {names:?}");
}

#[test]
fn the_same_scene_gives_the_same_bytes_for_any_number_of_threads() {
    let folder = Folder::new();
    let mut bytes = Vec::new();
    for (name, threads) in [("a", "1"), ("b", "2"), ("c", "2"), ("d", "7")] {
        for extension in ["exr", "png", "npy"] {
            let file = format!("{name}.{extension}");
            let arguments =
                ["render", "scene.toml", "-o", &file, "--aov", "all", "--threads", threads];
            assert_eq!(truecast(folder.0.path(), &arguments).status, 0);
            bytes.push(fs::read(folder.path(&file)).unwrap());
        }
    }
    for run in bytes.chunks(3).skip(1) {
        assert!(run == &bytes[..3], "two runs differ");
    }
}

#[test]
fn json_is_one_document_on_stdout() {
    let folder = Folder::new();
    for (arguments, schema) in [
        (&["render", "scene.toml", "--json"][..], "truecast/render/1"),
        (&["check", "scene.toml", "--json"], "truecast/check/1"),
        (&["pixel", "scene.toml", "20", "15", "--json"], "truecast/pixel/1"),
        (&["explain", "scene.toml", "--json"], "truecast/explain/1"),
    ] {
        let ran = truecast(folder.0.path(), arguments);
        assert_eq!(ran.status, 0, "{}", ran.stderr);
        let document: serde_json::Value = serde_json::from_str(&ran.stdout).unwrap();
        assert_eq!(document["schema"], schema);
    }
}

#[test]
fn usage_errors_end_with_2() {
    let folder = Folder::new();
    for arguments in [
        &["render", "scene.toml", "--size", "0x5"][..],
        &["render", "scene.toml", "--size", "70000x5"],
        &["render", "scene.toml", "--crop", "0,0,41,30"],
        &["render", "scene.toml", "--crop", "5,5,5,9"],
        &["render", "scene.toml", "-o", "picture.jpg"],
        &["render", "scene.toml", "--aov", "rgba,depht"],
        &["render", "scene.toml", "--accuracy", "perfect"],
        &["pixel", "scene.toml", "40", "0"],
        &["check", "scene.toml", "--pixel", "0,30"],
        &["check"],
        &["paint"],
        &[],
    ] {
        let before = folder.names();
        let ran = truecast(folder.0.path(), arguments);
        assert_eq!(ran.status, 2, "{arguments:?}: {}", ran.stderr);
        assert!(!ran.stderr.is_empty() && ran.stdout.is_empty(), "{arguments:?}");
        assert_eq!(folder.names(), before);
    }
}

#[test]
fn bad_scenes_end_with_3_and_name_the_place() {
    let render = ["render", "scene.toml"];
    let replaced = |from: &str, to: &str| {
        let folder = Folder::new();
        assert!(SCENE.contains(from));
        folder.write("scene.toml", &SCENE.replace(from, to));
        folder
    };
    let folder = replaced("width = 40", "widht = 40");
    assert_refused(&folder, &render, 3, &["scene.toml:3:1", "widht", "width"]);
    let folder = replaced("width = 40", "width = 0");
    assert_refused(&folder, &render, 3, &["scene.toml:3:9", "width"]);
    let folder = replaced("type = \"point\"", "type = \"area\"");
    assert_refused(&folder, &render, 3, &["scene.toml:13:8", "area"]);
    let folder = replaced("fov_y_deg = 40.0", "fov_y_deg = 40.0.0");
    assert_refused(&folder, &render, 3, &["scene.toml:9:"]);
}

#[test]
fn bad_meshes_end_with_3_and_name_the_line() {
    let render = ["render", "scene.toml"];
    for (mesh, words) in [
        ("v nan -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n", &["mesh.obj:1:3"][..]),
        ("v -1 -1 0\nv 1 inf 0\nv 0 1 0\nf 1 2 3\n", &["mesh.obj:2:5"]),
        ("v -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 4\n", &["mesh.obj:4:"]),
        ("# nothing here\n", &["mesh.obj", "no faces"]),
        ("v -1e39 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n", &["mesh.obj"]),
    ] {
        let folder = Folder::new();
        folder.write("mesh.obj", mesh);
        assert_refused(&folder, &render, 3, words);
    }
}

#[test]
fn bad_triangles_are_skipped_on_demand_by_every_command() {
    let folder = Folder::new();
    folder.write("mesh.obj", &format!("{MESH}v nan 0 0\nf 1 2 4\nf 4 2 3\n"));
    for command in [
        &["render", "scene.toml", "-o", "a.npy"][..],
        &["check", "scene.toml"],
        &["export", "scene.toml", "-o", "bundle"],
        &["pixel", "scene.toml", "20", "15"],
        &["explain", "scene.toml"],
    ] {
        let refused = truecast(folder.0.path(), command);
        assert_eq!(refused.status, 3, "{command:?}: {}", refused.stderr);
        let skipped = truecast(folder.0.path(), &[command, &["--skip-bad"]].concat());
        assert_eq!(skipped.status, 0, "{command:?}: {}", skipped.stderr);
        let warning = "mesh.obj:6: a face with a corner that is not finite is left out (2 times";
        assert!(skipped.stderr.contains(warning), "{command:?}: {}", skipped.stderr);
    }
}

#[test]
fn coordinates_of_1e19_and_more_are_rendered() {
    let folder = Folder::new();
    folder.write("mesh.obj", "v -1e19 -1e19 0\nv 1e30 -1e19 0\nv 0 8e37 0\nf 1 2 3\nf 1 3 2\n");
    assert_eq!(truecast(folder.0.path(), &["check", "scene.toml"]).status, 0);
}

#[test]
fn reading_and_writing_failures_end_with_4() {
    let folder = Folder::new();
    fs::create_dir(folder.path("folder.exr")).unwrap();
    for (arguments, words) in [
        (&["render", "missing.toml"][..], &["missing.toml"][..]),
        (&["render", "."], &["."]),
        (&["render", "scene.toml", "-o", "folder.exr"], &["folder.exr"]),
        (&["render", "scene.toml", "-o", "nowhere/picture.png"], &["nowhere"]),
        (&["render", "scene.toml", "-o", "mesh.obj/picture.png"], &["mesh.obj"]),
        (&["check", "scene.toml", "--diff", "nowhere/diff.png"], &["nowhere"]),
    ] {
        assert_refused(&folder, arguments, 4, words);
    }
    fs::remove_file(folder.path("mesh.obj")).unwrap();
    assert_refused(&folder, &["render", "scene.toml"], 4, &["scene.toml:11:8", "mesh.obj"]);
}

#[test]
fn a_check_of_nothing_ends_with_3() {
    let folder = Folder::new();
    folder.write("scene.toml", &SCENE.replace("eye = [0.0, 0.0, 5.0]", "eye = [0.0, 0.0, -5.0]"));
    folder.write("mesh.obj", &MESH.replace(" 0\n", " -9\n"));
    let ran = truecast(folder.0.path(), &["check", "scene.toml"]);
    assert_eq!(ran.status, 3);
    assert!(ran.stdout.contains("nothing to check"), "{}", ran.stdout);
}

#[test]
fn check_writes_its_picture_and_csv() {
    let folder = Folder::new();
    let arguments = ["check", "scene.toml", "--diff", "d.png", "--csv", "d.csv"];
    let ran = truecast(folder.0.path(), &arguments);
    assert_eq!(ran.status, 0, "{}", ran.stderr);
    assert!(ran.stdout.contains("0 differences"), "{}", ran.stdout);
    assert!(fs::read(folder.path("d.png")).unwrap().starts_with(b"\x89PNG"));
    assert_eq!(fs::read_to_string(folder.path("d.csv")).unwrap().lines().count(), 1);
}

#[test]
fn a_pixel_is_explained() {
    let folder = Folder::new();
    let ran = truecast(folder.0.path(), &["pixel", "scene.toml", "20", "15"]);
    assert_eq!(ran.status, 0, "{}", ran.stderr);
    for word in ["mesh.obj:4", "visible", "light 0: lit", "sum"] {
        assert!(ran.stdout.contains(word), "no {word:?} in {}", ran.stdout);
    }
}

#[test]
fn a_crop_is_a_part_of_the_frame() {
    let folder = Folder::new();
    let render = |file: &str, more: &[&str]| {
        let mut arguments = vec!["render", "scene.toml", "-o", file, "--quiet"];
        arguments.extend(more);
        assert_eq!(truecast(folder.0.path(), &arguments).status, 0);
        truecast::film::load_exr(&folder.path(file)).unwrap()
    };
    let frame = render("frame.exr", &[]);
    let crop = render("crop.exr", &["--crop", "13,7,29,25"]);
    assert_eq!(crop.resolution, frame.resolution);
    let window = crop.window;
    assert_eq!((window.x0(), window.y0(), window.x1(), window.y1()), (13, 7, 29, 25));
    use truecast::film::Samples;
    for plane in &crop.planes {
        for (index, pixel) in window.pixels().enumerate() {
            let in_frame = frame.window.index(pixel);
            match (&plane.samples, frame.plane(&plane.name).unwrap()) {
                (Samples::Float(a), Samples::Float(b)) => {
                    assert_eq!(a[index].to_bits(), b[in_frame].to_bits(), "{}", plane.name);
                }
                (Samples::Uint(a), Samples::Uint(b)) => assert_eq!(a[index], b[in_frame]),
                _ => panic!("{} changed its type", plane.name),
            }
        }
    }
}

#[test]
fn doubtful_pixels_and_colours_beyond_f32_are_reported() {
    let folder = Folder::new();
    // The lamp lies in the triangle's plane: every pixel that it meets is at the terminator.
    let flat = SCENE.replace("[1.0, 2.0, 4.0]", "[1.0, 2.0, 0.0]");
    folder.write("flat.toml", &flat);
    let arguments = ["render", "flat.toml", "--aov", "all", "-o", "flat.exr", "--json"];
    let ran = truecast(folder.0.path(), &arguments);
    let report: serde_json::Value = serde_json::from_str(&ran.stdout).unwrap();
    let covered = report["covered_pixels"].as_u64().unwrap();
    assert!(covered > 20);
    assert_eq!(report["invalid_pixels"], covered);
    assert_eq!(report["notes"]["near_terminator"], covered);
    for key in ["cancelled_vectors", "perspective_kept", "missing_normals"] {
        assert_eq!(report["notes"][key], 0);
    }
    assert_eq!(report["infinite_pixels"], 0);
    // Without the plane nobody counts its pixels.
    let ran = truecast(folder.0.path(), &["render", "flat.toml", "-o", "flat.exr", "--json"]);
    let report: serde_json::Value = serde_json::from_str(&ran.stdout).unwrap();
    assert_eq!(report["invalid_pixels"], serde_json::Value::Null);

    folder.write("bright.toml", &SCENE.replace("intensity = [1.0,", "intensity = [1e45,"));
    let arguments = ["render", "bright.toml", "--aov", "rgba,invalid", "-o", "bright.exr"];
    let ran = truecast(folder.0.path(), &arguments);
    assert_eq!(ran.status, 0, "{}", ran.stderr);
    let said = format!("{covered} pixels are brighter than f32 can hold: infinite in the EXR");
    assert!(ran.stdout.contains(&said), "{}", ran.stdout);
    let said = format!("{covered} pixels have a bit in the plane invalid");
    assert!(ran.stdout.contains(&said), "{}", ran.stdout);
}
