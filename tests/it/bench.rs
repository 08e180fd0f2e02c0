//! The benchmark: its report's fields, no time for a wrong kernel, and baselines on the command line.

#[cfg(any(feature = "peers", feature = "embree"))]
mod peers;

use crate::support::program::truecast;
use serde_json::Value;
use std::cell::RefCell;
use std::fs;
use std::path::{Path, PathBuf};
use std::rc::Rc;
use tempfile::TempDir;
use truecast::bench::kernels::light_of;
use truecast::bench::reference::Reference;
use truecast::bench::rounds::{Row, take_turns};
use truecast::bench::workload::{Answer, Variant, Work};
use truecast::mesh::TriangleId;
use truecast::pixel::Resolution;
use truecast::raster::rasterize;
use truecast::render::Unwatched;
use truecast::scene::{Overrides, Scene};
use truecast::simd::SimdLevel;
use truecast::visibility::{Counting, LevelCounts, NearestBuffer, VisibilityBuffer, Visible};

/// What is asked for unless a test asks for something else.
const SMALL: [[&str; 2]; 3] = [["--rounds", "2"], ["--size", "32x18"], ["--threads", "1"]];

fn scene_file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(name)
}

fn bench(folder: &Path, more: &[&str]) -> (i32, String, String) {
    bench_of("iteration-0.toml", folder, more)
}

fn bench_of(scene: &str, folder: &Path, more: &[&str]) -> (i32, String, String) {
    let scene = scene_file(scene);
    let mut arguments = vec!["bench", scene.to_str().unwrap()];
    arguments.extend(SMALL.iter().filter(|pair| !more.contains(&pair[0])).flatten());
    arguments.extend(more);
    truecast(folder, &arguments)
}

#[test]
fn the_report_has_its_fields_and_positive_times() {
    let folder = TempDir::new().unwrap();
    let (status, stdout, stderr) =
        bench(folder.path(), &["--json", "-o", "a.csv", "-o", "a.json", "-o", "a.svg"]);
    assert_eq!((status, &*stderr), (0, ""));
    let report: Value = serde_json::from_str(&stdout).unwrap();
    assert_eq!(report["schema"], "truecast/bench/2");
    assert!(report["machine"]["logical_cores"].as_u64().unwrap() > 0);
    assert!(report["machine"]["rustc"].as_str().unwrap().starts_with("rustc 1."));
    let scene = &report["scenes"][0];
    assert_eq!((&scene["threads"], &report["rounds"]), (&1.into(), &2.into()));
    assert_eq!((&scene["width"], &scene["height"]), (&32.into(), &18.into()));
    assert_eq!(scene["audited_pixels"], 200);
    assert_eq!(scene["disputed_pixels"], 0);
    assert!(scene["price_of_proof"].as_f64().unwrap() > 0.0);
    assert_eq!(scene["trees"].as_array().unwrap().len(), 5);
    let rows = scene["rows"].as_array().unwrap();
    for row in rows {
        let name = row["name"].as_str().unwrap();
        for key in ["median_ms", "min_ms", "max_ms", "rate"] {
            assert!(row[key].as_f64().unwrap() > 0.0, "{name}: {key}");
        }
        assert!(row["mad_ms"].as_f64().unwrap() >= 0.0, "{name}");
        assert_eq!(row["n"], 2, "{name}");
        let is_checked = !name.starts_with("build") && !["light", "shade"].contains(&name);
        if row["exact"] == true {
            let wrong = if is_checked { Value::from(0) } else { Value::Null };
            assert_eq!(row["wrong_pixels"], wrong, "{name}");
        } else if is_checked {
            assert!(row["wrong_pixels"].is_u64(), "{name}");
        }
        let counts_decisions =
            row["program"].is_null() && (name.starts_with("cast") || name.starts_with("raster"));
        assert_eq!(row["decisions"].is_object(), counts_decisions, "{name}");
    }
    let svg = fs::read_to_string(folder.path().join("a.svg")).unwrap();
    for row in rows.iter().filter(|row| row["program"].is_null()) {
        assert!(svg.contains(row["name"].as_str().unwrap()), "{row}");
    }
    // A bar per row.
    assert_eq!(svg.matches("<polygon").count(), rows.len());
    let csv = fs::read_to_string(folder.path().join("a.csv")).unwrap();
    assert_eq!(csv.lines().count(), 1 + rows.len());
    let columns = csv.lines().next().unwrap().split(',').count();
    // "cast medium, cover" is quoted.
    let cover = csv.lines().find(|line| line.contains("\"cast medium, cover\"")).unwrap();
    assert_eq!(cover.split(',').count(), columns + 1);
    let written = fs::read_to_string(folder.path().join("a.json")).unwrap();
    assert_eq!(serde_json::from_str::<Value>(&written).unwrap(), report);
}

#[test]
fn growth_over_meshes_of_several_sizes_is_drawn_and_read() {
    let folder = TempDir::new().unwrap();
    let scene = |cells: u32| {
        let name = format!("{cells}.toml");
        let shape =
            format!("shape = {{ terrain = {{ size = 8.0, height = 1.0, cells = {cells} }} }}");
        let text = format!(
            "version = 1\n[image]\nwidth = 32\nheight = 18\n[camera]\neye = [0, 3, 6]\ntarget = [0, 0, 0]\nup = [0, 1, 0]\n\
             fov_y_deg = 60\n[[mesh]]\n{shape}\n[[light]]\ntype = \"directional\"\naim = [0, -1, 0]\n\
             intensity = [1, 1, 1]\n"
        );
        fs::write(folder.path().join(&name), text).unwrap();
        name
    };
    let [small, large] = [scene(4), scene(32)];
    let measured = |scenes: &[&str], plot: &str| {
        let options = ["--rounds", "2", "--size", "32x18", "--threads", "1", "--growth", plot];
        let only = ["--work", "closest", "--preset", "medium", "--only", "cast medium"];
        truecast(folder.path(), &[&["bench"], scenes, &options, &only].concat())
    };
    let (status, stdout, stderr) = measured(&[&small, &large], "growth.svg");
    assert_eq!((status, &*stderr), (0, ""));
    let (_, lines) = stdout.split_once("\ngrowth\n").unwrap();
    let line = lines.lines().find(|line| line.starts_with("cast medium: ")).unwrap();
    assert!(line.contains("ns per ray, ") && line.ends_with("32 -> 2048 triangles"), "{line}");
    // log 2048 / log 32 = 11/5.
    assert!(line.contains(" times (log n: 2.20), "), "{line}");
    let svg = fs::read_to_string(folder.path().join("growth.svg")).unwrap();
    for line in lines.lines() {
        assert!(svg.contains(line.split(" -> ").next().unwrap()), "{line}");
    }
    let refused = |scenes: &[&str], plot: &str, status: i32, word: &str| {
        let (found, stdout, stderr) = measured(scenes, plot);
        assert_eq!((found, &*stdout), (status, ""), "{stderr}");
        assert!(stderr.contains(word), "{stderr}");
    };
    refused(&[&small], "growth.svg", 3, "differ in their number of triangles");
    refused(&[&small, &small], "growth.svg", 3, "differ in their number of triangles");
    refused(&[&small, &large], "growth.png", 2, "end it in .svg");
}

/// Writes a baseline whose medians are those of a run times `factor`.
fn scaled_baseline(folder: &Path, factor: f64) -> String {
    let (status, stdout, _) = bench(folder, &["--json"]);
    assert_eq!(status, 0);
    let mut report: Value = serde_json::from_str(&stdout).unwrap();
    for row in report["scenes"][0]["rows"].as_array_mut().unwrap() {
        row["median_ms"] = (row["median_ms"].as_f64().unwrap() * factor).into();
        row["mad_ms"] = (row["mad_ms"].as_f64().unwrap() * factor).into();
    }
    let path = folder.join(format!("{factor}.json"));
    fs::write(&path, report.to_string()).unwrap();
    path.to_str().unwrap().to_owned()
}

#[test]
fn a_baseline_finds_what_became_slower() {
    let folder = TempDir::new().unwrap();
    // A thousandfold is beyond noise in every row whose deviation is below a third of its median,
    // and one of sixteen always is.
    let faster_once = scaled_baseline(folder.path(), 1e-3);
    let (status, stdout, _) = bench(folder.path(), &["--rounds", "9", "--baseline", &faster_once]);
    assert_eq!(status, 1, "{stdout}");
    assert!(stdout.contains("slower: ") && stdout.contains("cast medium"), "{stdout}");
    let slower_once = scaled_baseline(folder.path(), 1e3);
    let (status, stdout, _) = bench(folder.path(), &["--baseline", &slower_once]);
    assert_eq!(status, 0, "{stdout}");
    assert!(stdout.contains(", 0 slower beyond noise"), "{stdout}");
}

#[test]
fn what_cannot_be_compared_or_measured_is_refused() {
    let folder = TempDir::new().unwrap();
    let same = scaled_baseline(folder.path(), 1.0);
    let refused = |more: &[&str], status: i32, word: &str| {
        let (found, stdout, stderr) = bench(folder.path(), more);
        assert_eq!((found, &*stdout), (status, ""), "{stderr}");
        assert!(stderr.contains(word), "{stderr}");
    };
    refused(&["--baseline", &same, "--size", "16x9"], 3, "give --size 32x18");
    refused(&["--baseline", &same, "--threads", "2"], 3, "give --threads 1");
    refused(&["--baseline", "missing.json"], 4, "missing.json");
    refused(&["-o", "report.txt"], 2, "end it in .json, .csv or .svg");
    refused(&["-o", "missing/report.svg"], 4, "missing");
    refused(&["--only", "nobody's"], 3, "no variant is asked for");
    refused(&["--rounds", "0"], 2, "expected a whole number");
    let (status, _, stderr) = bench_of("iteration-1.toml", folder.path(), &["--baseline", &same]);
    assert_eq!(status, 3, "{stderr}");
    assert!(stderr.contains("was not measured"), "{stderr}");
}

#[test]
fn the_workload_is_what_was_asked_for() {
    let folder = TempDir::new().unwrap();
    let more = ["--json", "--work", "closest,build", "--preset", "fast,medium", "--threads", "1,2"];
    let (status, stdout, stderr) = bench(folder.path(), &more);
    assert_eq!(status, 0, "{stderr}");
    let report: Value = serde_json::from_str(&stdout).unwrap();
    let scenes = report["scenes"].as_array().unwrap();
    let threads: Vec<_> = scenes.iter().map(|scene| scene["threads"].as_u64().unwrap()).collect();
    assert_eq!(threads, [1, 2]);
    for scene in scenes {
        let rows = scene["rows"].as_array().unwrap().iter().filter(|row| row["program"].is_null());
        let mut names: Vec<_> = rows.map(|row| row["name"].as_str().unwrap()).collect();
        names.sort_unstable();
        let expected = [
            "build fast",
            "build medium",
            "cast fast",
            "cast medium",
            "cast medium, double",
            "cast medium, fast",
            "cast medium, one by one",
            "cast medium, surfaces",
            "cast medium, watertight",
        ];
        assert_eq!(names, expected);
    }
    let (status, stdout, _) = bench(folder.path(), &["--json", "--only", "RASTER, c;develop"]);
    let report: Value = serde_json::from_str(&stdout).unwrap();
    let rows = report["scenes"][0]["rows"].as_array().unwrap();
    let found: Vec<_> = rows.iter().map(|row| row["name"].as_str().unwrap()).collect();
    assert_eq!((status, found), (0, vec!["raster, cover", "develop"]));
    let names: Vec<&str> = SimdLevel::available().into_iter().map(SimdLevel::name).collect();
    let levels = names.join(",");
    let more = ["--json", "--work", "raster", "--simd", &levels];
    let (status, stdout, stderr) = bench(folder.path(), &more);
    assert_eq!(status, 0, "{stderr}");
    let report: Value = serde_json::from_str(&stdout).unwrap();
    let scenes = report["scenes"].as_array().unwrap();
    for scene in scenes {
        let rows = scene["rows"].as_array().unwrap().iter();
        let names = rows.map(|row| (row["name"].as_str().unwrap(), row["exact"] == true));
        let expected = [
            ("raster", true),
            ("raster, surfaces", true),
            ("raster, watertight", false),
            ("raster, double", false),
            ("raster, fast", false),
        ];
        assert_eq!(names.collect::<Vec<_>>(), expected);
    }
    let found: Vec<_> = scenes.iter().map(|scene| scene["simd"].as_str().unwrap()).collect();
    assert_eq!(found, names);
    for (option, word) in [("--work", "shades"), ("--preset", "slowest"), ("--simd", "avx")] {
        let (status, stdout, stderr) = bench(folder.path(), &[option, word]);
        assert_eq!((status, &*stdout), (2, ""), "{stderr}");
        assert!(stderr.contains(word), "{stderr}");
    }
}

#[test]
fn a_mesh_file_is_seen_as_a_whole_or_as_it_was_asked_for() {
    let folder = TempDir::new().unwrap();
    // A tetrahedron far from the origin.
    let mesh = "v 100 0 0\nv 101 0 0\nv 100 1 0\nv 100 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    fs::write(folder.path().join("mesh.obj"), mesh).unwrap();
    let run = |more: &[&str]| {
        let mut arguments = vec!["bench", "mesh.obj", "--json", "--work", "raster"];
        arguments.extend(["--rounds", "1", "--size", "64x36"]);
        arguments.extend(more);
        truecast(folder.path(), &arguments)
    };
    let (status, stdout, stderr) = run(&[]);
    assert_eq!((status, &*stderr), (0, ""));
    let report: Value = serde_json::from_str(&stdout).unwrap();
    let scene = &report["scenes"][0];
    assert_eq!((&scene["scene"], &scene["triangles"]), (&"mesh.obj".into(), &4.into()));
    let covered = scene["covered_pixels"].as_u64().unwrap();
    assert!((100..64 * 36 / 2).contains(&covered), "{covered}");
    // From nearer it covers more; from elsewhere nothing.
    let view = ["--eye", "101,0.6,0.7", "--target", "100,0,0"];
    let (status, stdout, _) = run(&view);
    let report: Value = serde_json::from_str(&stdout).unwrap();
    assert!(status == 0 && report["scenes"][0]["covered_pixels"].as_u64().unwrap() > covered);
    assert_eq!(run(&["--eye", "0,0,0", "--target", "-1,0,0"]).0, 3);
    assert_eq!(run(&["--eye", "0,0,0"]).0, 2);
    assert_eq!(run(&["--eye", "0,0", "--target", "1,0,0"]).0, 2);
    assert_eq!(run(&["--eye", "0,0,0", "--target", "0,9,0"]).0, 2);
    assert_eq!(run(&["--fov", "180"]).0, 2);
}

/// One triangle, and a camera that looks away from it.
const AWAY: &str = r#"version = 1
[image]
width = 8
height = 6
[camera]
eye = [0.0, 0.0, 5.0]
target = [0.0, 0.0, 9.0]
up = [0.0, 1.0, 0.0]
fov_y_deg = 40.0
[[mesh]]
file = "mesh.obj"
"#;

#[test]
fn a_scene_that_shows_nothing_is_not_timed() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("away.toml"), AWAY).unwrap();
    let mesh = "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n";
    fs::write(folder.path().join("mesh.obj"), mesh).unwrap();
    let (status, stdout, stderr) = truecast(folder.path(), &["bench", "away.toml"]);
    assert_eq!((status, &*stdout), (3, ""), "{stderr}");
    assert!(stderr.contains("away.toml: no triangle is visible"), "{stderr}");
}

/// Rows of variants that rasterize and then change the answer.
fn rows_of(changes: &[fn(&mut VisibilityBuffer)], counting: Counting) -> Vec<Row> {
    let overrides = Overrides { resolution: Resolution::new(32, 18), ..Overrides::default() };
    let scene = Scene::load(&scene_file("iteration-0.toml"), &overrides).unwrap();
    let window = scene.camera.resolution().window();
    let answer = |counting| rasterize(&scene, window, counting, &|| ());
    let both = [answer(Counting::All), answer(Counting::All)];
    let reference = Reference::of(&scene, &both, 50, &Unwatched);
    assert!(reference.covered_pixels() > 0);
    let variants: Vec<Variant<'_>> = changes
        .iter()
        .map(|change| {
            Variant::visibility("kernel", Work::Raster, window.len(), move || {
                let mut buffer = answer(counting);
                change(&mut buffer);
                buffer
            })
        })
        .collect();
    take_turns(&variants, &reference, 3, &Unwatched)
}

#[test]
fn a_wrong_kernel_has_no_time_but_its_wrong_pixels() {
    let lose_two: fn(&mut VisibilityBuffer) = |buffer| {
        buffer.visible.iter_mut().filter(|v| v.is_some()).take(2).for_each(|v| *v = None);
    };
    let rename_one: fn(&mut VisibilityBuffer) = |buffer| {
        let visible = buffer.visible.iter_mut().flatten().last().unwrap();
        visible.triangle = TriangleId::new(visible.triangle.get() + 1);
    };
    let rows = rows_of(&[|_| (), lose_two, rename_one], Counting::Nearest);
    let found: Vec<_> = rows.iter().map(|row| (row.wrong_pixels, row.times.is_some())).collect();
    assert_eq!(found, [(Some(0), true), (Some(2), false), (Some(1), false)]);
    assert_eq!(rows[0].times.unwrap().n, 3);
}

#[test]
fn ids_alone_are_held_against_what_is_right_too() {
    let overrides = Overrides { resolution: Resolution::new(32, 18), ..Overrides::default() };
    let scene = Scene::load(&scene_file("iteration-0.toml"), &overrides).unwrap();
    let window = scene.camera.resolution().window();
    let buffer = rasterize(&scene, window, Counting::Nearest, &|| ());
    let id = |visible: &Option<Visible>| visible.map_or(u32::MAX, |v| v.triangle.get());
    let right: Vec<u32> = buffer.visible.iter().map(id).collect();
    let reference = Reference::of(&scene, &[buffer.clone(), buffer], 50, &Unwatched);
    let variant = |name, ids: Vec<u32>| {
        let t = vec![1.0; ids.len()];
        let buffer = NearestBuffer { window, ids, t, levels: LevelCounts::default() };
        let buffer = Rc::new(RefCell::new(buffer));
        let answer = move || Answer::Nearest(Rc::clone(&buffer));
        Variant::new(name, Work::Closest, window.len(), answer)
    };
    let mut wrong = right.clone();
    wrong.iter_mut().take(3).for_each(|id| *id = id.wrapping_sub(1));
    let variants = [
        variant("right", right.clone()),
        variant("wrong", wrong.clone()),
        variant("short", right[1..].to_vec()),
        variant("wrong but another's", wrong).of("another"),
    ];
    let rows = take_turns(&variants, &reference, 2, &Unwatched);
    let found: Vec<_> = rows.iter().map(|row| (row.wrong_pixels, row.times.is_some())).collect();
    let all = Some(window.len());
    assert_eq!(found, [(Some(0), true), (Some(3), false), (all, false), (Some(3), true)]);
}

#[test]
fn a_wrong_cover_is_wrong_where_it_is_counted() {
    let count_more: fn(&mut VisibilityBuffer) = |buffer| {
        if let Some(cover) = &mut buffer.cover {
            cover[0].crossed += 1;
        }
    };
    assert_eq!(rows_of(&[count_more], Counting::All)[0].wrong_pixels, Some(1));
    assert_eq!(rows_of(&[count_more], Counting::Nearest)[0].wrong_pixels, Some(0));
}

#[test]
fn both_paths_wrong_alike_are_found_by_the_arbiter() {
    let overrides = Overrides { resolution: Resolution::new(32, 18), ..Overrides::default() };
    let scene = Scene::load(&scene_file("iteration-0.toml"), &overrides).unwrap();
    let window = scene.camera.resolution().window();
    let right = rasterize(&scene, window, Counting::All, &|| ());
    let mut wrong = right.clone();
    wrong.visible.fill(None);
    let reference = Reference::of(&scene, &[wrong.clone(), wrong.clone()], 200, &Unwatched);
    assert_eq!((reference.disputed_pixels(), reference.audited_pixels()), (0, 200));
    assert!(reference.wrong_pixels(&wrong) > 0, "the audit sees covered pixels");
    // Where the two differ, the arbiter says which is right.
    let reference = Reference::of(&scene, &[wrong, right.clone()], 0, &Unwatched);
    assert_eq!(reference.disputed_pixels(), right.covered_pixels());
    assert_eq!(reference.wrong_pixels(&right), 0);
}

#[test]
fn wrong_shadows_are_found_by_exact_arithmetic() {
    let overrides = Overrides { resolution: Resolution::new(32, 18), ..Overrides::default() };
    let scene = Scene::load(&scene_file("effect-shadows.toml"), &overrides).unwrap();
    let window = scene.camera.resolution().window();
    let buffer = rasterize(&scene, window, Counting::Nearest, &|| ());
    let light = light_of(&scene).unwrap();
    let both = [buffer.clone(), buffer];
    let reference =
        Reference::of(&scene, &both, 0, &Unwatched).with_shadows(&scene, light, window.len());
    // Every visible point is either lit or in shadow, and the scene has both.
    let count = |answer| reference.wrong_shadows(&vec![answer; window.len()]);
    let (lit, dark) = (count(true), count(false));
    assert!(lit > 0 && dark > 0, "{lit} {dark}");
    assert_eq!(lit + dark, reference.covered_pixels());
    assert_eq!(reference.wrong_shadows(&[]), reference.covered_pixels());
}

#[test]
fn counters_are_the_same_in_every_run_and_fit_the_scene() {
    let folder = TempDir::new().unwrap();
    let run = |more: &[&str]| {
        let arguments = [&["--json", "--work", "closest,raster"][..], more].concat();
        let (status, stdout, stderr) = bench(folder.path(), &arguments);
        assert_eq!(status, 0, "{stderr}");
        let report: Value = serde_json::from_str(&stdout).unwrap();
        report["scenes"].as_array().unwrap().clone()
    };
    let levels: Vec<&str> = SimdLevel::available().into_iter().map(SimdLevel::name).collect();
    let presets = ["--preset", "fast,medium", "--simd", &levels.join(",")];
    let mut scenes = run(&presets);
    scenes.extend(run(&[&presets[..], &["--threads", "3"]].concat()));
    let first = &scenes[0];
    assert!(scenes.iter().all(|scene| scene["counters"] == first["counters"]));
    let counters = first["counters"].as_array().unwrap();
    let names: Vec<_> = counters.iter().map(|own| own["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["cast fast", "cast medium", "raster"]);
    let (triangles, covered) =
        (first["triangles"].as_u64().unwrap(), first["covered_pixels"].as_u64().unwrap());
    for own in counters {
        let count = |what: &str| own["counts"][what].as_u64().unwrap_or_else(|| panic!("{what}"));
        // A visible sample was drawn.
        assert!(count("samples") >= covered, "{own}");
        if own["name"] == "raster" {
            assert!((1..=count("listed")).contains(&count("drawn")), "{own}");
        } else {
            let nodes = count("nodes");
            assert!((nodes..=16 * nodes).contains(&count("boxes")), "{own}");
            assert!(count("leaf_triangles") >= count("set_up"), "{own}");
            // One tile at this size: no triangle is met twice, but for room in leaves.
            assert!(count("set_up") > 0 && count("set_up") <= triangles, "{own}");
        }
    }
    // What is not asked for is not counted.
    let raster = run(&["--only", "raster"]);
    let names = raster[0]["counters"].as_array().unwrap().iter().map(|own| own["name"].clone());
    assert_eq!(names.collect::<Vec<_>>(), ["raster"]);
}
