//! The oracle bundle as another program reads it: against golden answers and the rasterizer, and
//! where it may be written. What the README's reader prints was printed by it; here only its text
//! is looked at.

use crate::support::golden;
use crate::support::program::truecast;
use crate::support::scenes::standard_camera;
use std::fs;
use std::path::Path;
use tempfile::TempDir;
use truecast::export::{FILES, PixelCounts, assemble};
use truecast::raster::rasterize;
use truecast::render::Unwatched;
use truecast::scene::Scene;
use truecast::scene::camera::PinholeCamera;
use truecast::visibility::Counting;

/// Exports to `folder/bundle`.
fn export(scene: &Scene, folder: &TempDir) -> PixelCounts {
    let target = folder.path().join("bundle");
    let bundle = assemble(scene, &target, &Unwatched).unwrap();
    let counts = bundle.counts;
    let bytes = bundle.place(&target).unwrap();
    assert_eq!(names(folder.path()), ["bundle"]);
    let mut files = FILES.map(str::to_owned);
    files.sort();
    assert_eq!(names(&target), files);
    let written: u64 =
        FILES.iter().map(|file| fs::metadata(target.join(file)).unwrap().len()).sum();
    assert_eq!(bytes, written);
    counts
}

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<_> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

/// An array of the bundle, of the shape given.
fn array<T: npyz::Deserialize>(folder: &TempDir, name: &str, shape: &[u64]) -> Vec<T> {
    let bytes = fs::read(folder.path().join("bundle").join(name)).unwrap();
    let file = npyz::NpyFile::new(&bytes[..]).unwrap();
    assert_eq!(file.shape(), shape, "{name}");
    assert_eq!(file.order(), npyz::Order::C, "{name}");
    file.into_vec().unwrap()
}

fn json(folder: &TempDir, name: &str) -> serde_json::Value {
    serde_json::from_slice(&fs::read(folder.path().join("bundle").join(name)).unwrap()).unwrap()
}

#[test]
fn a_bundle_holds_the_golden_answers() {
    for golden in golden::scenes() {
        let folder = TempDir::new().unwrap();
        let counts = export(&golden.scene, &folder);
        let frame = golden.scene.camera.resolution();
        let shape = [u64::from(frame.height()), u64::from(frame.width())];
        let ids: Vec<u32> = array(&folder, "prim.npy", &shape);
        let expected: Vec<u32> = golden.ids.iter().map(|id| id.unwrap_or(0xFFFF_FFFF)).collect();
        assert_eq!(ids, expected, "{}", golden.name);
        assert_eq!(array::<u32>(&folder, "cover.npy", &shape), golden.cover, "{}", golden.name);
        // The rasterizer knows the rest.
        let raster = rasterize(&golden.scene, frame.window(), Counting::All, &|| ());
        let t_lo: Vec<f64> = array(&folder, "t_lo.npy", &shape);
        let t_hi: Vec<f64> = array(&folder, "t_hi.npy", &shape);
        let facing: Vec<i8> = array(&folder, "facing.npy", &shape);
        let tie: Vec<u8> = array(&folder, "tie.npy", &shape);
        for (index, visible) in raster.visible.iter().enumerate() {
            let found = (facing[index], tie[index]);
            match visible {
                None => {
                    assert_eq!((found, t_lo[index], t_hi[index]), ((0, 0), 0.0, 0.0));
                }
                Some(visible) => {
                    assert_eq!(found, (visible.facing.sign(), u8::from(visible.tie)));
                    assert!(t_lo[index] <= visible.t_hi && visible.t_lo <= t_hi[index]);
                    assert!(t_lo[index] > 0.0 && t_hi[index] - t_lo[index] <= 1e-14 * t_lo[index]);
                }
            }
        }
        let stable: Vec<u8> = array(&folder, "stable.npy", &shape);
        let unstable = stable.iter().filter(|&&stable| stable == 0).count();
        let tied = tie.iter().filter(|&&tie| tie == 1).count();
        let covered = golden.ids.iter().flatten().count();
        let found = [counts.covered, counts.tied, counts.unstable];
        assert_eq!(found, [covered, tied, unstable].map(|count| count as u64), "{}", golden.name);
    }
}

#[test]
fn triangles_and_camera_are_read_back_bit_for_bit() {
    let frame = truecast::pixel::Resolution::new(31, 17).unwrap();
    let camera = PinholeCamera::look_at(
        frame,
        [0.1, -2.3, 5.7],
        [1.0 / 3.0, 0.5, -1.0],
        [0.0, 1.0, 0.1],
        41.7,
    )
    .unwrap();
    let awkward = [1.0_f32.next_up(), f32::MIN_POSITIVE / 8.0, -0.1];
    let triangles = [[awkward, [0.0, 1e30, 0.3], [7.0, -1e-30, 16_777_217.0]], [[0.5; 3]; 3]];
    let scene = Scene::from_triangles(camera.clone(), &triangles);
    let folder = TempDir::new().unwrap();
    export(&scene, &folder);
    let corners: Vec<f32> = array(&folder, "triangles.npy", &[2, 3, 3]);
    let bits = |values: &[f32]| values.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
    assert_eq!(bits(&corners), bits(triangles.as_flattened().as_flattened()));
    let read = json(&folder, "camera.json");
    for (key, expected) in
        [("eye", camera.eye()), ("d0", camera.d0()), ("dx", camera.dx()), ("dy", camera.dy())]
    {
        for (k, expected) in expected.into_iter().enumerate() {
            assert_eq!(read[key][k].as_f64().unwrap().to_bits(), expected.to_bits(), "{key}");
        }
    }
    assert_eq!((&read["width"], &read["height"]), (&31.into(), &17.into()));
}

#[test]
fn a_pixel_is_stable_if_a_256th_of_a_pixel_changes_nothing() {
    // At the depth of the image plane one pixel is one unit. The left edge of each triangle runs
    // this many 256ths of a pixel right of the centre of pixel (8, 8), whose x is 0.
    for (steps, stable, visible) in
        [(3.0, 1, false), (0.5, 0, false), (0.0, 0, true), (-0.5, 0, true), (-3.0, 1, true)]
    {
        let left = steps / 256.0;
        let triangle = [[left, -90.0, 8.0], [90.0, -90.0, 8.0], [left, 500.0, 8.0]];
        let scene = Scene::from_triangles(standard_camera(8.0), &[triangle]);
        let folder = TempDir::new().unwrap();
        export(&scene, &folder);
        let ids: Vec<u32> = array(&folder, "prim.npy", &[17, 17]);
        assert_eq!(ids[8 * 17 + 8] == 0, visible, "{steps}");
        let found: Vec<u8> = array(&folder, "stable.npy", &[17, 17]);
        for (index, &found) in found.iter().enumerate() {
            let expected = if index % 17 == 8 { stable } else { 1 };
            assert_eq!(found, expected, "{steps} {index}");
        }
    }
}

const SCENE: &str = r#"version = 1
[image]
width = 40
height = 70
[camera]
eye = [0.0, 0.0, 5.0]
target = [0.0, 0.0, 0.0]
up = [0.0, 1.0, 0.0]
fov_y_deg = 40.0
[[mesh]]
file = "mesh.obj"
[[mesh]]
shape = { box = {} }
translate = [0.0, 0.0, -4.0]
"#;

/// A folder with a scene and its mesh.
fn folder() -> TempDir {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("scene.toml"), SCENE).unwrap();
    let mesh = "v -1 -1 0\nv 1 -1 0\nv 0 1 0\n# a comment\nf 1 2 3\n\nf 3 2 1\n";
    fs::write(folder.path().join("mesh.obj"), mesh).unwrap();
    folder
}

/// Runs `export scene.toml` with the arguments and hands back its status and what it printed.
fn run(folder: &TempDir, arguments: &[&str]) -> (i32, String, String) {
    truecast(folder.path(), &[&["export", "scene.toml"], arguments].concat())
}

#[test]
fn sources_name_mesh_file_and_line() {
    let folder = folder();
    let (status, stdout, stderr) = run(&folder, &["-o", "bundle", "--json"]);
    assert_eq!(status, 0, "{stderr}");
    let document: serde_json::Value = serde_json::from_str(&stdout).unwrap();
    assert_eq!(document["schema"], "truecast/export/1");
    assert_eq!(document["files"].as_array().unwrap().len(), FILES.len());
    let sources = json(&folder, "sources.json");
    let [mesh, shape] = &sources["meshes"].as_array().unwrap()[..] else { panic!("two meshes") };
    assert_eq!((&mesh["first"], &mesh["count"]), (&0.into(), &2.into()));
    assert_eq!((&mesh["name"], &mesh["file"]), (&"mesh.obj".into(), &"mesh.obj".into()));
    assert_eq!(mesh["lines"], serde_json::json!([5, 7]));
    assert_eq!((&shape["first"], &shape["count"]), (&2.into(), &12.into()));
    assert_eq!((&shape["file"], &shape["lines"]), (&().into(), &serde_json::json!([])));
}

#[test]
fn a_former_bundle_and_an_empty_folder_are_replaced() {
    let folder = folder();
    fs::create_dir(folder.path().join("bundle")).unwrap();
    assert_eq!(run(&folder, &["-o", "bundle", "--quiet"]).0, 0);
    let first: Vec<_> = FILES
        .iter()
        .map(|file| fs::read(folder.path().join("bundle").join(file)).unwrap())
        .collect();
    assert_eq!(run(&folder, &["-o", "bundle/", "--size", "8x9", "--threads", "1"]).0, 0);
    array::<u32>(&folder, "prim.npy", &[9, 8]);
    // The same scene gives the same bytes, for any number of threads.
    assert_eq!(run(&folder, &["-o", "bundle", "--threads", "3"]).0, 0);
    for (file, first) in FILES.iter().zip(&first) {
        assert!(&fs::read(folder.path().join("bundle").join(file)).unwrap() == first, "{file}");
    }
    assert_eq!(names(folder.path()), ["bundle", "mesh.obj", "scene.toml"]);
}

#[test]
fn nothing_that_is_no_bundle_is_replaced() {
    let folder = folder();
    let path = |name: &str| folder.path().join(name);
    fs::create_dir(path("work")).unwrap();
    fs::write(path("work/camera.json"), "mine").unwrap();
    assert_eq!(run(&folder, &["-o", "bundle", "--quiet"]).0, 0);
    fs::write(path("bundle/results.csv"), "mine").unwrap();
    let before = names(folder.path());
    for (target, words) in [
        ("work", "holds no bundle"),
        ("bundle", "results.csv"),
        ("mesh.obj", "a file has this name"),
        ("mesh.obj/bundle", "is not a folder"),
        ("nowhere/bundle", "there is no folder nowhere"),
        (".", "holds no bundle"),
    ] {
        let (status, stdout, stderr) = run(&folder, &["-o", target]);
        assert_eq!((status, stdout.as_str()), (4, ""), "{target}: {stderr}");
        assert!(stderr.starts_with("error: cannot write ") && stderr.contains(words), "{stderr}");
        assert_eq!(stderr.lines().count(), 1, "{stderr}");
        assert_eq!(names(folder.path()), before, "{target}");
    }
    assert_eq!(fs::read_to_string(path("work/camera.json")).unwrap(), "mine");
    assert_eq!(names(&path("bundle")).len(), FILES.len() + 1);
    // A bad scene leaves nothing either.
    fs::write(path("mesh.obj"), "v 0 0\n").unwrap();
    assert_eq!(run(&folder, &["-o", "new"]).0, 3);
    assert_eq!(run(&folder, &[]).0, 2);
    assert_eq!(names(folder.path()), before);
}

#[test]
fn the_readme_reads_every_plane_it_speaks_of() {
    let readme = include_str!("../../README.md");
    let script = readme.split("```python\n").nth(1).expect("a Python example");
    let script = script.split("```").next().unwrap();
    for name in ["prim", "triangles", "stable", "tie", "camera.json", "eye", "d0", "dx", "dy"] {
        let quoted =
            script.contains(&format!("\"{name}\"")) || script.contains(&format!("/{name}"));
        assert!(quoted, "{name}");
    }
    // Balanced brackets and no tabs: the least that Python asks for.
    for (open, close) in [('(', ')'), ('[', ']'), ('{', '}')] {
        assert_eq!(script.matches(open).count(), script.matches(close).count(), "{open}");
    }
    assert!(!script.contains('\t'));
    assert!(script.lines().filter(|line| !line.trim().is_empty()).count() <= 40);
}
