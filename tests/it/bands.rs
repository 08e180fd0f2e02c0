//! Frames in bands, and the way that a frame takes: neither changes a bit.

use crate::support::program::truecast;
use serde_json::Value;
use std::convert::Infallible;
use std::path::Path;
use truecast::film::{Film, Samples, load_exr};
use truecast::pixel::Window;
use truecast::render::{
    PlaneGroups, RenderOptions, Unwatched, VisibilityPath, predict, render, render_bands,
};
use truecast::scene::sampling::SampleGrid;
use truecast::scene::{Overrides, Scene};

/// See-through, shadows, textures' coordinates; more rows than a band has.
const SCENE: &str = r#"version = 1
[image]
width = 90
height = 160
[camera]
eye = [0.3, 2.5, 5]
target = [0, 0, 0]
up = [0, 1, 0]
fov_y_deg = 60
[[material]]
name = "glass"
kd = [0.2, 0.5, 0.9]
opacity = 0.4
[[material]]
name = "stone"
kd = [0.6, 0.5, 0.4]
[[mesh]]
shape = { plane = {} }
material = "stone"
scale = [6, 1, 6]
[[mesh]]
shape = { torus = { major = 1.0, minor = 0.4, around = 24, across = 16 } }
material = "glass"
translate = [0, 1, 0]
[[light]]
type = "point"
position = [2, 5, 3]
intensity = [1, 1, 1]
shadows = true
"#;

fn scene(text: &str) -> Scene {
    Scene::from_toml(text, Path::new("bands.toml"), Path::new(""), &Overrides::default()).unwrap()
}

/// Numbers below this are 0 and its noise: what f64 makes of coordinates up to 10 units, each path in
/// its own way, where the exact number is 0.
const ZERO: f32 = 1e-13;

/// The bits of a plane.
fn bits(samples: &Samples) -> Vec<u32> {
    match samples {
        Samples::Float(values) => values.iter().map(|value| value.to_bits()).collect(),
        Samples::Uint(values) => values.clone(),
    }
}

/// Bands of a frame, made on some threads, put together by planes, and how many there were.
fn in_bands(
    scene: &Scene,
    options: &RenderOptions,
    threads: usize,
) -> (Vec<(String, Vec<u32>)>, usize) {
    let (mut planes, mut count): (Vec<(String, Vec<u32>)>, usize) = (Vec::new(), 0);
    let append = |band: Film| {
        count += 1;
        if planes.is_empty() {
            planes = band.planes.iter().map(|plane| (plane.name.clone(), Vec::new())).collect();
        }
        for (plane, (name, all)) in band.planes.iter().zip(&mut planes) {
            assert_eq!(plane.name, *name);
            all.extend(bits(&plane.samples));
        }
        Ok::<_, Infallible>(())
    };
    let keep = |band: &Film| Ok(band.clone());
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    pool.install(|| render_bands(scene, options, &Unwatched, keep, append)).unwrap();
    (planes, count)
}

#[test]
fn bands_together_are_the_frame() {
    let mut scene = scene(SCENE);
    let frame = scene.camera.resolution();
    for side in [1, 2] {
        scene.samples = SampleGrid::new(side).unwrap();
        for path in [VisibilityPath::Cast, VisibilityPath::Raster] {
            for window in [None, Window::new(frame, 5, 7, 88, 150)] {
                let options = RenderOptions {
                    path,
                    window,
                    planes: PlaneGroups::all(),
                    ..RenderOptions::default()
                };
                let whole = render(&scene, &options, &Unwatched);
                for threads in [1, 3] {
                    let (planes, count) = in_bands(&scene, &options, threads);
                    assert!(count > 1, "{path:?}");
                    assert_eq!(planes.len(), whole.film.planes.len());
                    for (plane, (name, all)) in whole.film.planes.iter().zip(&planes) {
                        assert!(bits(&plane.samples) == *all, "{name}, {path:?}, {window:?}");
                    }
                }
            }
        }
    }
}

#[test]
fn a_band_that_cannot_be_kept_ends_the_frame() {
    let mut count = 0;
    let refuse = |()| {
        count += 1;
        Err("full")
    };
    let scene = scene(SCENE);
    let options = RenderOptions::default();
    let refused = render_bands(&scene, &options, &Unwatched, |_| Ok(()), refuse);
    assert_eq!(refused.unwrap_err(), "full");
    assert_eq!(count, 1);
    // Of faulty bands the topmost is told, whichever was made first.
    let mut taken = Vec::new();
    let from_64 = |band: &Film| match band.window.y0() {
        y @ 64.. => Err(y),
        y => Ok(y),
    };
    let take = |y| {
        taken.push(y);
        Ok(())
    };
    let faulty = render_bands(&scene, &options, &Unwatched, from_64, take);
    assert_eq!(faulty.unwrap_err(), 64);
    assert_eq!(taken, [0, 32]);
}

#[test]
fn one_frame_is_rasterized_and_many_samples_are_cast() {
    let quickest = |scene: &Scene| {
        let window = scene.camera.resolution().window();
        let ways = predict(scene, window);
        assert!(ways.is_sorted_by(|a, b| a.total() <= b.total()));
        ways[0]
    };
    let plain = SCENE.replace("shadows = true", "");
    // A shape of 250 000 triangles before 14 400 pixels.
    let many = plain.replace("around = 24, across = 16", "around = 500, across = 250");
    let mut scene = scene(&many);
    let first = quickest(&scene);
    assert_eq!((first.path, first.preset), (VisibilityPath::Raster, None));
    scene.samples = SampleGrid::new(16).unwrap();
    assert_eq!(quickest(&scene).path, VisibilityPath::Cast);
    // Shadows need a tree on either path.
    let shadowed = self::scene(SCENE);
    let window = shadowed.camera.resolution().window();
    assert!(predict(&shadowed, window).iter().all(|way| way.preset.is_some()));
}

#[test]
fn the_program_tells_its_way_and_every_way_gives_the_same_picture() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("scene.toml"), SCENE).unwrap();
    let run = |file: &str, more: &[&str]| -> Value {
        let picture = file.replace(".exr", ".png");
        let arguments = ["render", "scene.toml", "-o", file, "-o", &picture, "--json"];
        let (status, stdout, stderr) = truecast(folder.path(), &[&arguments, more].concat());
        assert_eq!(status, 0, "{stderr}");
        serde_json::from_str(&stdout).unwrap()
    };
    let told = run("any.exr", &[]);
    assert_eq!(told["path_chosen_by"], "prediction");
    assert_eq!(told["path"], told["predictions"][0]["path"]);
    assert_eq!(told["preset"], told["predictions"][0]["preset"]);
    let memory = &told["memory"];
    assert!(memory["mesh_bytes"].as_u64().unwrap() > 0);
    assert!(memory["bvh_bytes"].as_u64().unwrap() > 0, "shadows need a tree");
    assert!(memory["bytes_per_triangle"].as_f64().unwrap() > 36.0);

    // Every moment counts once.
    let times = told["times_ms"].as_object().unwrap();
    let stages =
        ["load", "build", "describe", "visibility", "shade", "develop", "list", "encode", "write"];
    let sum: f64 = stages.iter().map(|stage| times[*stage].as_f64().unwrap()).sum();
    assert_eq!(times.len(), stages.len() + 1);
    assert!(sum <= times["total"].as_f64().unwrap() + 0.01, "{times:?}");

    let read = |file: &str| load_exr(&folder.path().join(file)).unwrap();
    let any = read("any.exr");
    for path in ["cast", "raster"] {
        let file = format!("{path}.exr");
        let told = run(&file, &["--path", path]);
        assert_eq!(
            (told["path"].as_str(), told["path_chosen_by"].as_str()),
            (Some(path), Some("user"))
        );
        let film = read(&file);
        let png = |name: &str| std::fs::read(folder.path().join(name)).unwrap();
        assert!(png(&format!("{path}.png")) == png("any.png"), "{path}");
        assert_eq!(film.description, any.description);
        for plane in &film.planes {
            let other = any.plane(&plane.name).unwrap();
            match (&plane.samples, other) {
                // Which arithmetic decided is the path's own.
                _ if plane.name == "verdict.level" => {}
                (Samples::Float(ours), Samples::Float(theirs)) => {
                    let near = |(a, b): (&f32, &f32)| a == b || a.abs().max(b.abs()) < ZERO;
                    assert!(ours.iter().zip(theirs).all(near), "{}, {path}", plane.name);
                }
                _ => assert!(bits(&plane.samples) == bits(other), "{}, {path}", plane.name),
            }
        }
    }
    let (status, text, _) = truecast(folder.path(), &["explain", "scene.toml"]);
    assert_eq!(status, 0);
    let picked = told["path"].as_str().unwrap();
    assert!(text.contains(&format!("path       {picked}")), "{text}");
    assert!(text.contains("bytes per triangle"), "{text}");
}

#[test]
fn kept_trees_are_used_and_damaged_ones_are_not() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("scene.toml"), SCENE).unwrap();
    let run = |file: &str, more: &[&str]| -> (String, Vec<u8>, String) {
        let arguments = ["render", "scene.toml", "-o", file, "--json", "--path", "cast"];
        let (status, stdout, stderr) = truecast(folder.path(), &[&arguments, more].concat());
        assert_eq!(status, 0, "{stderr}");
        let told: Value = serde_json::from_str(&stdout).unwrap();
        let source = told["bvh_source"].as_str().unwrap().to_owned();
        (source, std::fs::read(folder.path().join(file)).unwrap(), stderr)
    };
    let cached = ["--bvh-cache", "trees/here"];
    let (source, plain, _) = run("plain.exr", &[]);
    assert_eq!(source, "built");
    assert!(!folder.path().join("trees").exists());
    assert_eq!(
        run("first.exr", &cached),
        ("built and kept".to_owned(), plain.clone(), String::new())
    );
    assert_eq!(run("again.exr", &cached), ("loaded".to_owned(), plain.clone(), String::new()));

    let kept = || -> Vec<std::path::PathBuf> {
        let files = std::fs::read_dir(folder.path().join("trees/here")).unwrap();
        files.map(|file| file.unwrap().path()).collect()
    };
    let [file] = kept().try_into().unwrap();
    let whole = std::fs::read(&file).unwrap();
    let mut changed = whole.clone();
    changed[whole.len() / 2] ^= 1;
    let long = vec![0; 1 << 20];
    for (damaged, why) in [
        (&whole[..whole.len() - 1], "digest"),
        (&whole[..50], "cut short"),
        (&[][..], "cut short"),
        (&changed[..], "digest"),
        (&long[..], "too long"),
    ] {
        std::fs::write(&file, damaged).unwrap();
        let (source, picture, stderr) = run("damaged.exr", &cached);
        assert_eq!(source, "built and kept", "{why}");
        assert!(picture == plain, "{why}");
        assert!(stderr.contains(why) && stderr.contains("built anew"), "{stderr}");
        assert!(std::fs::read(&file).unwrap() == whole, "{why}: it is replaced");
    }
    // A folder that cannot be one is told and no failure; another scene has a file of its own.
    let (source, picture, stderr) = run("none.exr", &["--bvh-cache", "scene.toml"]);
    assert_eq!(source, "built");
    assert!(picture == plain);
    assert!(stderr.contains("scene.toml"), "{stderr}");
    let moved = SCENE.replace("translate = [0, 1, 0]", "translate = [0, 1.5, 0]");
    std::fs::write(folder.path().join("scene.toml"), moved).unwrap();
    assert_eq!(run("moved.exr", &cached).0, "built and kept");
    assert_eq!(kept().len(), 2);
}
