//! Other programs' ray casters: asked about the same pixels, held against the same answer.

use super::{SMALL, scene_file};
use crate::support::program::truecast;
use serde_json::Value;
use tempfile::TempDir;

/// The report of closest hits on a small frame.
fn report(more: &[&str]) -> Value {
    let folder = TempDir::new().unwrap();
    let scene = scene_file("iteration-0.toml");
    let mut arguments = vec!["bench", scene.to_str().unwrap(), "--json", "--work", "closest"];
    arguments.extend(["--preset", "medium"]);
    arguments.extend(SMALL.iter().flatten());
    arguments.extend(more);
    let (status, stdout, stderr) = truecast(folder.path(), &arguments);
    assert_eq!(status, 0, "{stderr}");
    serde_json::from_str(&stdout).unwrap()
}

/// Every row of a program: its name, and its wrong pixels.
fn rows_of(report: &Value, program: &str) -> Vec<(String, u64)> {
    let rows = report["scenes"][0]["rows"].as_array().unwrap().iter();
    rows.filter(|row| row["program"].as_str().is_some_and(|name| name.starts_with(program)))
        .map(|row| {
            assert!(row["median_ms"].as_f64().unwrap() > 0.0, "{row}");
            (row["name"].as_str().unwrap().to_owned(), row["wrong_pixels"].as_u64().unwrap())
        })
        .collect()
}

/// Pixels of 576 that a peer may rightly see otherwise, for its rays are rounded.
const AT_EDGES: u64 = 6;

#[cfg(feature = "peers")]
#[test]
fn crates_answer_about_the_same_pixels() {
    let report = report(&[]);
    for (program, names) in [
        ("obvhs", &["obvhs BVH2", "obvhs CWBVH"][..]),
        ("bvh", &["bvh"]),
        ("parry3d", &["parry3d"]),
    ] {
        let rows = rows_of(&report, program);
        let found: Vec<&str> = rows.iter().map(|(name, _)| &**name).collect();
        assert_eq!(found, names);
        assert!(rows.iter().all(|(_, wrong)| *wrong <= AT_EDGES), "{rows:?}");
    }
    let rivalries = report["scenes"][0]["rivalries"].as_array().unwrap();
    assert!(rivalries.len() >= 3);
    assert!(rivalries.iter().all(|rivalry| rivalry["ratio"].as_f64().unwrap() > 0.0));
}

#[cfg(feature = "embree")]
#[test]
fn embree_answers_where_it_is_installed_and_is_noted_where_not() {
    let report = report(&[]);
    let rows = rows_of(&report, "Embree");
    let left_out = report["scenes"][0]["left_out"].as_array().unwrap();
    // Where it is not installed, the note is all there is to test.
    assert_eq!(rows.is_empty(), left_out.len() == 1, "{left_out:?}");
    if rows.is_empty() {
        assert!(left_out[0].as_str().unwrap().starts_with("Embree is not measured"));
        return;
    }
    assert_eq!(rows.len(), 4);
    assert!(rows.iter().all(|(_, wrong)| *wrong <= AT_EDGES), "{rows:?}");
}

/// Points and rays rounded to f32 see other occluders at few pixels, and the same at all others.
#[cfg(feature = "embree")]
#[test]
fn embree_answers_about_shadows() {
    let folder = TempDir::new().unwrap();
    let scene = scene_file("effect-shadows.toml");
    let mut arguments = vec!["bench", scene.to_str().unwrap(), "--json", "--work", "any"];
    arguments.extend(SMALL.iter().flatten());
    let (status, stdout, stderr) = truecast(folder.path(), &arguments);
    assert_eq!(status, 0, "{stderr}");
    let report: Value = serde_json::from_str(&stdout).unwrap();
    let rows = rows_of(&report, "Embree");
    if rows.is_empty() {
        let left_out = report["scenes"][0]["left_out"].as_array().unwrap();
        assert!(left_out[0].as_str().unwrap().starts_with("Embree is not measured"));
        return;
    }
    let names: Vec<&str> = rows.iter().map(|(name, _)| &**name).collect();
    assert_eq!(names, ["shadow Embree", "shadow Embree, robust"]);
    assert!(rows.iter().all(|(_, wrong)| *wrong <= AT_EDGES), "{rows:?}");
}

#[cfg(feature = "embree")]
#[test]
fn a_library_that_is_none_cannot_be_read() {
    let folder = TempDir::new().unwrap();
    std::fs::write(folder.path().join("not.so"), "no library").unwrap();
    for name in ["./not.so", "./missing.so"] {
        let scene = scene_file("iteration-0.toml");
        let arguments = ["bench", scene.to_str().unwrap(), "--size", "8x8", "--embree", name];
        let (status, stdout, stderr) = truecast(folder.path(), &arguments);
        assert_eq!((status, &*stdout), (4, ""), "{stderr}");
        assert!(stderr.contains(name), "{stderr}");
    }
}
