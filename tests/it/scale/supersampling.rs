//! H86: with an odd number of samples per axis the middle one is the plain image; no number of
//! samples changes any plane but colour and alpha.

use super::metamorphic::scenes_with_ties;
use crate::support::configurations::{POOLS, assert_same};
use crate::support::scenes::{rectangle, standard_scene};
use truecast::accel::BuildPreset;
use truecast::film::{Film, Plane, Samples};
use truecast::render::{
    Answerer, PlaneGroups, RenderOptions, Unwatched, VisibilityPath, expose, render,
};
use truecast::scene::Scene;
use truecast::scene::light::{AmbientLight, Light};
use truecast::scene::sampling::SampleGrid;
use truecast::shade::Effects;
use truecast::visibility::{Counting, Layers, VisibilityBuffer};

const PATHS: [VisibilityPath; 2] = [VisibilityPath::Cast, VisibilityPath::Raster];

fn with_samples(scene: &Scene, side: u32) -> Scene {
    Scene { samples: SampleGrid::new(side).unwrap(), ..scene.clone() }
}

fn film(scene: &Scene, path: VisibilityPath) -> Film {
    let options = RenderOptions { path, planes: PlaneGroups::all(), ..RenderOptions::default() };
    render(scene, &options, &Unwatched).film
}

fn is_color(plane: &&Plane) -> bool {
    ["R", "G", "B", "A"].contains(&plane.name.as_str())
}

fn color(film: &Film) -> Vec<Vec<f32>> {
    let planes = film.planes.iter().filter(is_color);
    planes
        .map(|plane| match &plane.samples {
            Samples::Float(values) => values.clone(),
            Samples::Uint(_) => panic!("{} is a float plane", plane.name),
        })
        .collect()
}

#[test]
fn h86_odd_supersampling() {
    for (name, triangles) in scenes_with_ties() {
        let mut scene = standard_scene(&triangles);
        scene.lights.push(Light::Ambient(AmbientLight { ambient: [0.1, 0.7, 1.3] }));
        let window = scene.camera.resolution().window();
        for path in PATHS {
            let answerer = Answerer::new(&scene, path, BuildPreset::Medium, &Unwatched);
            let plain = answerer.see(&scene, window, Counting::All, &Unwatched);
            let layers = Layers::none(window);
            let radiance = |scene: &Scene, buffer: &VisibilityBuffer| {
                expose(scene, &answerer, (buffer, &layers), Effects::of(scene), &Unwatched).radiance
            };
            let plain_radiance = radiance(&scene, &plain);
            for side in [1, 3, 5, 7, 9, 11, 13, 15] {
                let grid = SampleGrid::new(side).unwrap();
                let middle = grid.offsets().nth((grid.count() / 2) as usize).unwrap();
                let shifted = Scene { camera: scene.camera.shifted(middle), ..scene.clone() };
                let sub_sample = answerer.see(&shifted, window, Counting::All, &Unwatched);
                assert_same(&plain, &sub_sample, &format!("{name}, {path:?}, {side}"));
                assert_eq!(plain.cover, sub_sample.cover, "{name}, {path:?}, {side}");
                assert_eq!(plain_radiance, radiance(&shifted, &sub_sample), "{name}, {side}");
            }
        }
    }
}

#[test]
fn h86_other_planes_do_not_change() {
    for (name, triangles) in scenes_with_ties().into_iter().take(6) {
        let mut scene = standard_scene(&triangles);
        scene.lights.push(Light::Ambient(AmbientLight { ambient: [1.0; 3] }));
        for path in PATHS {
            let plain = film(&scene, path);
            let mut changed = 0;
            for side in [2, 3, 16] {
                let fine = film(&with_samples(&scene, side), path);
                assert_eq!(plain.planes.len(), fine.planes.len());
                for (a, b) in plain.planes.iter().zip(&fine.planes) {
                    assert_eq!(a.name, b.name);
                    match is_color(&a) {
                        true => changed += usize::from(a.samples != b.samples),
                        false => assert_eq!(a.samples, b.samples, "{name}: {}", a.name),
                    }
                }
            }
            // What fills the frame keeps its colour; what has an outline in it does not.
            let alpha = &color(&plain)[3];
            let has_outline = alpha.contains(&0.0) && alpha.contains(&1.0);
            assert_eq!(changed > 0, has_outline, "{name}");
        }
    }
}

/// An edge through the centres of a column: its pixels are covered by the samples on its side, and
/// those on the edge belong to the side that the tie rule gives them to.
#[test]
fn h86_shares_of_a_half_covered_pixel() {
    let right = standard_scene(&rectangle([0.0, -20.0], [20.0, 20.0], 8.0));
    let left = standard_scene(&rectangle([-20.0, -20.0], [0.0, 20.0], 8.0));
    for path in PATHS {
        for (side, of_right) in [(2, 1.0), (4, 2.0), (16, 8.0), (3, 2.0), (5, 3.0), (15, 8.0)] {
            let alpha = |scene| color(&film(&with_samples(scene, side), path)).remove(3);
            let share = of_right / f64::from(side);
            let column = |alpha: &[f32], x: usize| alpha[5 * 17 + x];
            let (on_right, on_left) = (alpha(&right), alpha(&left));
            assert_eq!(column(&on_right, 8), share as f32, "{side}");
            assert_eq!(column(&on_left, 8), (1.0 - share) as f32, "{side}");
            for (x, covered) in [(7, 0.0), (9, 1.0)] {
                assert_eq!((column(&on_right, x), column(&on_left, x)), (covered, 1.0 - covered));
            }
        }
    }
}

/// The mean of plain frames by shifted cameras, one after the other, and for one or two threads.
#[test]
fn a_fine_frame_is_the_mean_of_shifted_ones() {
    let (_, triangles) = scenes_with_ties().remove(1);
    let mut scene = standard_scene(&triangles);
    scene.background = [0.3, 0.0, 0.7];
    scene.lights.push(Light::Ambient(AmbientLight { ambient: [0.1, 0.7, 1.3] }));
    let window = scene.camera.resolution().window();
    for path in PATHS {
        let fine = with_samples(&scene, 3);
        let answerer = Answerer::new(&scene, path, BuildPreset::Medium, &Unwatched);
        let exposed = |scene: &Scene| {
            let seen = answerer.see(scene, window, Counting::Nearest, &Unwatched);
            let layers = answerer.see_through(scene, &seen, &Unwatched);
            expose(scene, &answerer, (&seen, &layers), Effects::of(scene), &Unwatched)
        };
        let mut sums = vec![[0.0; 4]; window.len()];
        for offset in fine.samples.offsets() {
            let one = exposed(&Scene { camera: scene.camera.shifted(offset), ..scene.clone() });
            for (index, sum) in sums.iter_mut().enumerate() {
                let [r, g, b] = one.radiance[index];
                *sum = std::array::from_fn(|k| sum[k] + [r, g, b, one.alpha[index]][k]);
            }
        }
        for pool in &*POOLS {
            let found = pool.install(|| exposed(&fine));
            for (index, sum) in sums.iter().enumerate() {
                let [r, g, b] = found.radiance[index];
                assert_eq!([r, g, b, found.alpha[index]], sum.map(|sum| sum / 9.0), "{path:?}");
            }
        }
    }
}
