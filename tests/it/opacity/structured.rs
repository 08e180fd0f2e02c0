//! Scenes full of ties with opacities dealt over them: both paths, every tree, the arbiter.

use super::{agreed, glow};
use crate::support::closed::integer_chaos;
use crate::support::golden;
use std::fs;
use std::path::Path;
use truecast::accel::BuildPreset;
use truecast::check::{Blame, CheckOptions, Kind, Outcome, answer, check, judge};
use truecast::render::Unwatched;
use truecast::scene::{Overrides, Scene};

/// Opacities that are dealt in turn; exact in f64, one of them opaque.
const OPACITIES: [f64; 5] = [0.5, 0.25, 1.0, 0.0, 0.75];

/// Deals opacities over a scene's triangles, each with an emission of its own.
fn deal(mut scene: Scene, start: usize, step: usize) -> Scene {
    scene.materials = (0..scene.mesh.len())
        .map(|id| {
            let shade = (id % 7) as f64 / 8.0;
            glow([shade, 1.0 - shade, 0.5], OPACITIES[(start + id * step) % OPACITIES.len()])
        })
        .collect();
    scene.triangle_materials = (0..scene.mesh.len() as u32).collect();
    scene.background = [0.0, 0.0, 2.0];
    scene
}

#[test]
fn h14_closed_integer_chaos() {
    let (mut layered, mut most) = (0, 0);
    for seed in 0..25 {
        let mut triangles = integer_chaos(seed);
        triangles.iter_mut().flatten().for_each(|corner| corner[2] += 6.0);
        let scene = crate::support::scenes::standard_scene(&triangles);
        let scene = deal(scene, seed as usize, 1 + seed as usize % 4);
        let seen = agreed(&format!("chaos {seed}"), &scene);
        layered += seen.layers.layered_pixels();
        most = most.max(seen.layers.most());
    }
    assert!(layered > 500 && most >= 4, "{layered} pixels, {most} layers at most");
}

#[test]
fn golden_scenes_with_ties() {
    let mut ties = 0;
    for case in golden::scenes() {
        for start in 0..OPACITIES.len() {
            let seen = agreed(&case.name, &deal(case.scene.clone(), start, 1));
            let window = seen.layers.window;
            ties += (0..window.len()).flat_map(|i| seen.layers.of(i)).filter(|v| v.tie).count();
        }
    }
    assert!(ties > 1000, "{ties} ties behind the nearest surface");
}

/// H20 to H28 and others as they come with the project: the check agrees.
#[test]
fn hard_scenes_of_the_project() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let (mut scenes, mut layered) = (0, 0);
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        if !name.starts_with("hard-") || !name.ends_with(".toml") {
            continue;
        }
        let scene = deal(Scene::load(&path, &Overrides::default()).unwrap(), 0, 1);
        let options = CheckOptions { audited_pixels: 30, ..CheckOptions::default() };
        let (report, _) = check(&scene, &options, &Unwatched);
        assert_eq!(report.outcome(), Outcome::Agreement, "{name}: {:?}", report.differences);
        scenes += 1;
        layered += report.layered_pixels;
    }
    assert!(scenes >= 20 && layered > 5000, "{scenes} scenes, {layered} layered pixels");
}

fn checked_scene() -> Scene {
    let mut triangles = integer_chaos(3);
    triangles.iter_mut().flatten().for_each(|corner| corner[2] += 6.0);
    deal(crate::support::scenes::standard_scene(&triangles), 3, 1)
}

#[test]
fn the_check_compares_layers_and_audits_them() {
    let scene = checked_scene();
    let options = CheckOptions { audited_pixels: 60, preset: BuildPreset::Fast, window: None };
    let (report, _) = check(&scene, &options, &Unwatched);
    assert_eq!(report.outcome(), Outcome::Agreement, "{:?}", report.differences);
    assert!(report.layered_pixels > 20, "{}", report.layered_pixels);
    assert!(report.audited_layered_pixels >= 15, "{}", report.audited_layered_pixels);
}

/// Damaged layers, alpha and radiance are found where they are, and blamed on whoever gave them.
#[test]
fn the_check_finds_damage_behind_the_nearest_surface() {
    let scene = checked_scene();
    let options = CheckOptions::default();
    let right = answer(&scene, &options, &Unwatched);
    let mut other = scene.clone();
    // What was opaque is not: more is seen behind.
    for material in other.materials.iter_mut().filter(|material| material.opacity == 1.0) {
        material.opacity = 0.5;
    }
    let wrong = answer(&other, &options, &Unwatched);
    let window = right[0].buffer.window;
    let index = (0..window.len())
        .find(|&i| {
            right[0].layers.of(i) != wrong[0].layers.of(i) && !right[0].layers.of(i).is_empty()
        })
        .expect("some pixel sees more");
    for (path, blame) in [(0, Blame::Cast), (1, Blame::Raster)] {
        let mut damaged = right.clone();
        damaged[path].layers = wrong[path].layers.clone();
        let report = judge(&scene, &damaged, &options, &Unwatched);
        assert_eq!(report.blamed(blame), report.differences.len());
        assert_eq!(report.count(Kind::Layers), report.differences.len());
        let pixel = window.pixel(index);
        assert!(report.differences.iter().any(|judged| judged.difference.pixel == pixel));

        let mut damaged = right.clone();
        damaged[path].alpha[index] += 0.125;
        let report = judge(&scene, &damaged, &options, &Unwatched);
        assert_eq!((report.count(Kind::Alpha), report.blamed(blame)), (1, 1));

        let mut damaged = right.clone();
        damaged[path].radiance[index][1] += 0.125;
        let report = judge(&scene, &damaged, &options, &Unwatched);
        assert_eq!((report.count(Kind::Radiance), report.blamed(blame)), (1, 1));
    }
    // Both wrong in the same way: only the audit tells.
    let mut damaged = right.clone();
    for path in 0..2 {
        damaged[path].layers = wrong[path].layers.clone();
    }
    let report = judge(&scene, &damaged, &options, &Unwatched);
    assert!(report.count(Kind::Layers) > 0);
    assert_eq!(report.blamed(Blame::Both), report.differences.len());
}
