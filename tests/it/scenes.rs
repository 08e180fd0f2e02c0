//! Every scene that comes with the project: it says what it is for, and both paths and the arbiter
//! agree on it.

use std::fs;
use std::path::Path;
use truecast::check::{CheckOptions, Outcome, check};
use truecast::render::Unwatched;
use truecast::scene::{Overrides, Scene};

#[test]
fn every_scene_checks_without_a_difference() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let mut checked = 0;
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|extension| extension != "toml") {
            continue;
        }
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
    assert!(checked >= 18, "{checked} scenes");
}
