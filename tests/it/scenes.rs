//! Every scene that comes with the project: it says what it is for, and both paths and the arbiter
//! agree on it. Sheets are no scenes; `figures` draws them.

use std::fs;
use std::path::{Path, PathBuf};
use truecast::check::{CheckOptions, Outcome, check};
use truecast::render::Unwatched;
use truecast::scene::{Overrides, Scene};

/// The scene files of a folder and of the folders in it.
fn scene_files(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            files.extend(scene_files(&path));
        } else if path.extension().is_some_and(|extension| extension == "toml")
            && !fs::read_to_string(&path).unwrap().contains("\n[[cell]]\n")
        {
            files.push(path);
        }
    }
    files
}

#[test]
fn every_scene_checks_without_a_difference() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let mut checked = 0;
    for path in scene_files(&folder) {
        let name = path.display();
        let head: Vec<_> =
            fs::read_to_string(&path).unwrap().lines().take(3).map(str::to_owned).collect();
        assert!(head.iter().all(|line| line.starts_with('#')), "{name} opens with its purpose");
        let scene = Scene::load(&path, &Overrides::default()).unwrap();
        assert_eq!(scene.warnings, Vec::<String>::new(), "{name}");
        let (report, _) = check(&scene, &CheckOptions::default(), &Unwatched);
        assert_eq!(report.outcome(), Outcome::Agreement, "{name}");
        checked += 1;
    }
    assert!(checked >= 40, "{checked} scenes");
}
