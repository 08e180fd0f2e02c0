//! Shadows in pictures: known shapes, what does not cast any, and a check that would notice.

use std::path::Path;
use truecast::check::{self, Answered, Blame, CheckOptions, Kind, Outcome};
use truecast::color::LinearRgb;
use truecast::render::{
    Answerer, RenderOptions, Unwatched, VisibilityPath, expose::expose, render,
};
use truecast::scene::sampling::SampleGrid;
use truecast::scene::{Overrides, Scene, Shading};
use truecast::shade::Effects;
use truecast::visibility::{Counting, Layers};

/// A floor of 16 × 16 units in the plane z = 0, seen along −z so that pixel (i, j) looks at the
/// point (i − 7.5, 7.5 − j); a screen of 4 × 4 units
/// floats behind the eye, where only the sun sees it. `more` is further text of the scene.
fn scene(more: &str) -> Scene {
    let text = format!(
        "version = 1\n\
         [image]\nwidth = 16\nheight = 16\n\
         [camera.exact]\neye = [0, 0, 64]\nd0 = [-8, 8, -64]\ndx = [1, 0, 0]\ndy = [0, -1, 0]\n\
         [[material]]\nname = \"floor\"\nka = [0.25, 0.25, 0.25]\nkd = [0.5, 0.5, 0.5]\n\
         [[mesh]]\nshape = {{ plane = {{ width = 16, depth = 16 }} }}\nmaterial = \"floor\"\nrotate_deg = [90, 0, 0]\n\
         {more}"
    );
    Scene::from_toml(&text, Path::new("s.toml"), Path::new(""), &Overrides::default()).unwrap()
}

/// A screen behind the eye, z = 128: it is never seen. The sun shines along −z.
const SCREEN: &str = "[[material]]\nname = \"screen\"\n\
    [[mesh]]\nshape = { plane = { width = 4, depth = 4 } }\nmaterial = \"screen\"\n\
    rotate_deg = [90, 0, 0]\ntranslate = [0, 0, 128]\n";
const SUN: &str = "[[light]]\ntype = \"directional\"\naim = [0, 0, -1]\nintensity = [1, 1, 1]\n\
    ambient = [1, 1, 1]\nshadows = true\n";

fn radiance(scene: &Scene, path: VisibilityPath) -> Vec<LinearRgb> {
    let answerer = Answerer::new(scene, path, RenderOptions::default().preset, &Unwatched);
    let window = scene.camera.resolution().window();
    let buffer = answerer.see(scene, window, Counting::Nearest, &Unwatched);
    let layers = Layers::none(window);
    expose(scene, &answerer, (&buffer, &layers), Effects::of(scene), &Unwatched).radiance
}

const PATHS: [VisibilityPath; 2] = [VisibilityPath::Cast, VisibilityPath::Raster];

#[test]
fn a_screen_shades_exactly_its_outline_and_the_ambient_part_stays() {
    let scene = scene(&format!("{SCREEN}{SUN}"));
    for path in PATHS {
        for (index, rgb) in radiance(&scene, path).into_iter().enumerate() {
            let (x, y) = (index as i32 % 16 - 8, 7 - index as i32 / 16);
            // Pixel centres are halves: the square −2…2 holds those of −2 ≤ x, y < 2.
            let dark = (-2..2).contains(&x) && (-2..2).contains(&y);
            assert_eq!(rgb, [if dark { 0.25 } else { 0.75 }; 3], "{path:?}: {x} {y}");
        }
    }
}

/// With a screen of 5 × 5 units its edges run through pixel centres: the moved sample decides, and
/// each of 25 pixels is dark, not 16 or 36.
#[test]
fn edges_through_samples_are_decided_by_the_tie_rule() {
    let scene =
        scene(&format!("{SCREEN}{SUN}").replace("width = 4, depth = 4", "width = 5, depth = 5"));
    for path in PATHS {
        let dark: Vec<usize> = radiance(&scene, path)
            .iter()
            .enumerate()
            .filter(|(_, rgb)| rgb[0] == 0.25)
            .map(|(index, _)| index)
            .collect();
        // The sample moves right and down: columns −2.5 … 1.5, rows 2.5 … −1.5.
        let expected: Vec<usize> =
            (5..10).flat_map(|row| (5..10).map(move |column| row * 16 + column)).collect();
        assert_eq!(dark, expected, "{path:?}");
    }
}

#[test]
fn see_through_screens_cast_no_shadow() {
    let lit = |more: &str| radiance(&scene(&format!("{SCREEN}{more}{SUN}")), VisibilityPath::Cast);
    assert!(lit("").contains(&[0.25; 3]));
    let open = SCREEN.replace("name = \"screen\"\n", "name = \"screen\"\nopacity = 0.5\n");
    let scene = scene(&format!("{open}{SUN}"));
    assert!(radiance(&scene, VisibilityPath::Cast).iter().all(|rgb| *rgb == [0.75; 3]));
}

#[test]
fn only_lights_that_say_so_cast_shadows() {
    let quiet = SUN.replace("shadows = true", "shadows = false");
    for text in [quiet.clone(), SUN.replace("shadows = true\n", "")] {
        let scene = scene(&format!("{SCREEN}{text}"));
        assert!(!Effects::of(&scene).has(Effects::SHADOWS));
        assert!(radiance(&scene, VisibilityPath::Raster).iter().all(|rgb| *rgb == [0.75; 3]));
    }
    // Two lights: each pixel loses only the one that is hidden.
    let both = scene(&format!("{SCREEN}{SUN}{quiet}"));
    let values: Vec<f64> = radiance(&both, VisibilityPath::Cast).iter().map(|rgb| rgb[0]).collect();
    assert!(values.iter().all(|value| [1.0, 1.5].contains(value)), "{values:?}");
}

/// Colours that are lit at the corners get the shadow of the pixel, not that of the corner.
#[test]
fn shadows_fall_on_pixels_whatever_the_shading() {
    let mut scene = scene(&format!("{SCREEN}{SUN}"));
    let reference = radiance(&scene, VisibilityPath::Cast);
    for shading in [Shading::Gouraud, Shading::Flat] {
        scene.objects[0].shading = shading;
        for (a, b) in radiance(&scene, VisibilityPath::Cast).iter().zip(&reference) {
            // The weights sum to 1 within 2^-50.
            assert!((a[0] - b[0]).abs() <= 2.0_f64.powi(-50), "{shading:?}: {a:?} {b:?}");
        }
    }
}

#[test]
fn samples_soften_an_outline_by_their_share() {
    let mut scene =
        scene(&format!("{SCREEN}{SUN}").replace("width = 4, depth = 4", "width = 5, depth = 5"));
    scene.samples = SampleGrid::new(2).unwrap();
    let values: Vec<f64> = radiance(&scene, VisibilityPath::Cast).iter().map(|c| c[0]).collect();
    let sum: f64 = values.iter().map(|value| (0.75 - value) / 0.5).sum();
    // The square covers 25 pixels; on its border half of the four samples are dark, at the
    // corners one.
    assert_eq!(sum, 25.0);
    assert_eq!(values[5 * 16 + 5], 0.625);
    assert_eq!(values[5 * 16 + 7], 0.5);
    assert_eq!(values[7 * 16 + 7], 0.25);
}

/// On a closed convex mesh no face that a light outside reaches is hidden from it: not one bit of
/// the picture changes when the light casts shadows.
#[test]
fn a_convex_body_casts_none_on_itself() {
    for aim in ["[0, 0, -1]", "[-1, -2, -0.5]", "[1, 0, 0]"] {
        let text = format!(
            "version = 1\n[image]\nwidth = 48\nheight = 48\n\
             [camera]\neye = [0, 1, 4]\ntarget = [0, 0, 0]\nup = [0, 1, 0]\nfov_y_deg = 40\n\
             [[mesh]]\nshape = {{ icosphere = {{ radius = 1, level = 3 }} }}\nshading = \"flat\"\n\
             [[light]]\ntype = \"directional\"\naim = {aim}\nintensity = [1, 1, 1]\nshadows = true\n"
        );
        let load = |text: &str| {
            Scene::from_toml(text, Path::new("s.toml"), Path::new(""), &Overrides::default())
                .unwrap()
        };
        let shadowed = radiance(&load(&text), VisibilityPath::Cast);
        let plain = radiance(&load(&text.replace("true", "false")), VisibilityPath::Cast);
        assert!(plain.iter().any(|rgb| rgb[0] > 0.0), "{aim}");
        assert_eq!(shadowed, plain, "{aim}");
    }
}

#[test]
fn the_check_agrees_and_its_audit_finds_a_common_error() {
    let scene = scene(&format!("{SCREEN}{SUN}"));
    let options = CheckOptions { audited_pixels: usize::MAX, ..CheckOptions::default() };
    let (report, answers) = check::check(&scene, &options, &Unwatched);
    assert_eq!(report.outcome(), Outcome::Agreement);
    // Both paths forget the shadow of one pixel.
    let dark = answers[0].radiance.iter().position(|rgb| rgb[0] == 0.25).expect("a shadow");
    let damaged: Vec<Answered> = answers
        .iter()
        .map(|answer| {
            let mut answer = answer.clone();
            answer.radiance[dark] = [0.75; 3];
            answer
        })
        .collect();
    let damaged: [Answered; 2] = damaged.try_into().unwrap();
    let report = check::judge(&scene, &damaged, &options, &Unwatched);
    assert_eq!(report.differences.len(), 1);
    assert_eq!(report.count(Kind::Radiance), 1);
    assert_eq!(report.blamed(Blame::Both), 1);
}

#[test]
fn a_picture_with_shadows_is_the_same_for_every_preset_and_thread_count() {
    use truecast::accel::BuildPreset;
    let scene = scene(&format!("{SCREEN}{SUN}"));
    let film = |preset, threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let options = RenderOptions { preset, ..RenderOptions::default() };
        pool.install(|| render(&scene, &options, &Unwatched).film)
    };
    let reference = film(BuildPreset::Medium, 1);
    for preset in BuildPreset::ALL {
        assert_eq!(film(preset, 2), reference, "{preset:?}");
    }
}
