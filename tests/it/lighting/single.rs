//! Shading in f32: the same bits at every instruction set, the decisions of f64, and values within
//! the error that is said of those in f64.

use super::neutrality;
use super::stage::{V3, bits};
use crate::called_for::scenes;
use crate::support::program::truecast;
use std::path::Path;
use truecast::film::Samples;
use truecast::pixel::{Resolution, Window};
use truecast::raster::rasterize;
use truecast::render::{RenderOptions, Unwatched, VisibilityPath, render};
use truecast::scene::light::Light;
use truecast::scene::switches::{DIALECTS, SWITCHES, SwitchValue, Switches};
use truecast::scene::{Overrides, Scene};
use truecast::shade::{self, Effects, Precision, ShadeOptions, single_error};
use truecast::simd::SimdLevel;
use truecast::visibility::{Counting, LevelCounts, VisibilityBuffer};

fn look(scene: &Scene) -> VisibilityBuffer {
    rasterize(scene, scene.camera.resolution().window(), Counting::Nearest, &|| ())
}

fn shaded(scene: &Scene, buffer: &VisibilityBuffer, options: ShadeOptions) -> Vec<V3> {
    shade::shade_with(scene, buffer, &options, None, &|| ()).radiance
}

/// Σ_j P_j at a point of a surface, per channel, and the largest exponent of a cone.
fn peaks(scene: &Scene, position: V3, kd: V3, ks: V3) -> (V3, f64) {
    let mut sum = [0.0; 3];
    let mut falloff = 0.0_f64;
    for light in &scene.lights {
        let (colors, at) = match light {
            Light::Directional(light) => (light.colors, None),
            Light::Point(light) => (light.colors, Some((light.position, light.attenuation))),
            Light::Spot(light) => {
                falloff = falloff.max(light.exponent);
                (light.colors, Some((light.position, light.attenuation)))
            }
            Light::Ambient(_) | Light::Hemisphere(_) => continue,
        };
        let attenuation = at.map_or(1.0, |(p, [a, b, c])| {
            let r = (0..3).map(|k| (p[k] - position[k]).powi(2)).sum::<f64>().sqrt();
            a + r * (b + c * r)
        });
        for k in 0..3 {
            sum[k] += (kd[k] * colors.diffuse[k] + ks[k] * colors.specular[k]) / attenuation;
        }
    }
    (sum, falloff)
}

/// The largest error of f32 as a share of what is said of it; the bits are compared on the way.
fn share_of_error(name: &str, scene: &Scene, buffer: &VisibilityBuffer) -> f64 {
    let options = ShadeOptions::new(Effects::of(scene));
    let double = shaded(scene, buffer, options);
    let by = |level| {
        let options = ShadeOptions { simd: Some(level), precision: Precision::Single, ..options };
        shaded(scene, buffer, options)
    };
    let single = by(SimdLevel::Baseline);
    for level in SimdLevel::available() {
        assert!(bits(&by(level)) == bits(&single), "{name} at {level}");
    }
    let mut largest = 0.0_f64;
    for (index, pixel) in buffer.window.pixels().enumerate() {
        let (double, single) = (double[index], single[index]);
        let Some(visible) = buffer.at(pixel) else {
            assert_eq!(double, single, "{name}");
            continue;
        };
        if double == single {
            continue;
        }
        let (_, material) = scene.material_of(visible.triangle);
        let (point, _) = shade::surface_point(scene, pixel, visible);
        let (sum, falloff) = peaks(scene, point.position, material.kd, material.ks);
        for k in 0..3 {
            // Sums are off by 2^-20 of the pixel at most.
            let allowed = single_error(material.ns, falloff) * sum[k] + double[k] / 1_048_576.0;
            let error = (double[k] - single[k]).abs();
            if error > 0.0 {
                largest = largest.max(error / allowed);
            }
        }
    }
    assert!(largest <= 1.0, "{name}: {largest} of the error that is said");
    largest
}

#[test]
fn f32_is_within_the_error_that_is_said_and_the_same_bits_at_every_level() {
    let mut all = scenes::scenes(331, 187);
    all.extend(neutrality::scenes());
    let largest = all.iter().map(|(name, scene)| share_of_error(name, scene, &look(scene)));
    let largest = largest.fold(0.0, f64::max);
    // The bound is one of the worst case, in which every rounding goes the same way.
    assert!(largest > 1e-3, "f32 was at work: {largest}");
}

#[test]
fn f32_is_within_the_error_in_scenes_of_the_repository() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let mut largest = 0.0_f64;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|extension| extension != "toml") {
            continue;
        }
        let resolution = Resolution::new(240, 135);
        let overrides = Overrides { resolution, ..Overrides::default() };
        let Ok(scene) = Scene::load(&path, &overrides) else { continue };
        let name = path.display().to_string();
        largest = largest.max(share_of_error(&name, &scene, &look(&scene)));
    }
    assert!(largest > 1e-3, "f32 was at work: {largest}");
}

#[test]
fn f32_is_within_the_error_with_every_switch() {
    let (_, scene) = scenes::scenes(331, 187).swap_remove(6);
    let buffer = look(&scene);
    for switch in &SWITCHES {
        let values = match switch.words {
            [] => vec![SwitchValue::Is(false), SwitchValue::Is(true)],
            words => words.iter().map(|word| SwitchValue::Word(word)).collect(),
        };
        for value in values {
            let switches = Switches::of_dialect(DIALECTS[0]).unwrap().with(switch.name, value);
            share_of_error(switch.name, &Scene { switches, ..scene.clone() }, &buffer);
        }
    }
}

// Far from the origin, where an f32 coordinate steps by 0.06 and more.
#[test]
fn f32_knows_no_far_away() {
    let (_, scene) = scenes::scenes(331, 187).swap_remove(6);
    let buffer = look(&scene);
    let near = share_of_error("near", &scene, &buffer);
    assert!(near > 1e-3, "{near}");
    // Everything 16 times as large: powers of two change no digit.
    let mut large = scene.clone();
    for position in &mut large.mesh.positions {
        *position = position.map(|c| c * 16.0);
    }
    for light in &mut large.lights {
        if let Light::Spot(light) = light {
            light.position = light.position.map(|c| c * 16.0);
        }
    }
    share_of_error("sixteen times as large", &large, &look(&large));
}

// Both forms of a lobe, of a falloff and of a rim, and the exponents at which they change.
#[test]
fn f32_is_within_the_error_for_soft_and_sharp_lights() {
    let (_, scene) = scenes::scenes(331, 187).swap_remove(6);
    let buffer = look(&scene);
    let mut largest = 0.0_f64;
    for (ns, exponent, cutoff_deg) in [
        (0.0, 0.0, 30.0),
        (1.0, 1.0, 179.0),
        (2.5, 200.0, 100.0),
        (200.0, 201.0, 91.0),
        (201.0, 1e4, 60.0),
        (1e5, 2.0, 8.5),
        (60.0, 20.0, 7.5),
        (30.0, 0.0, 0.5),
    ] {
        let mut scene = scene.clone();
        scene.materials.iter_mut().for_each(|material| material.ns = ns);
        for light in &mut scene.lights {
            if let Light::Spot(light) = light {
                (light.exponent, light.cutoff_deg) = (exponent, cutoff_deg);
            }
        }
        let name = format!("ns {ns}, exponent {exponent}, cutoff {cutoff_deg}");
        largest = largest.max(share_of_error(&name, &scene, &buffer));
    }
    assert!(largest > 1e-3, "f32 was at work: {largest}");
}

// A pixel's bits are its own: whoever renders a part of the frame renders the same picture.
#[test]
fn f32_of_a_pixel_does_not_depend_on_its_neighbours() {
    let mut all = scenes::scenes(83, 47);
    all.extend(neutrality::scenes());
    for (name, mut scene) in all {
        // Neighbouring triangles wear different materials.
        let count = scene.materials.len() as u32;
        let mut others = scene.materials.clone();
        others.iter_mut().for_each(|other| other.kd = other.kd.map(|c| 0.3 * c + 0.1));
        scene.materials.extend(others);
        let odd = scene.triangle_materials.iter_mut().skip(1).step_by(2);
        odd.for_each(|material| *material += count);
        let buffer = look(&scene);
        let options =
            ShadeOptions { precision: Precision::Single, ..ShadeOptions::new(Effects::of(&scene)) };
        let whole = shaded(&scene, &buffer, options);
        let size = scene.camera.resolution();
        for x0 in [1, 2, 7] {
            let window = Window::new(size, x0, 1, size.width() - 1, size.height()).unwrap();
            let part = VisibilityBuffer {
                window,
                visible: window.pixels().map(|pixel| buffer.at(pixel).copied()).collect(),
                cover: None,
                levels: LevelCounts::default(),
            };
            let part = shaded(&scene, &part, options);
            let same: Vec<V3> = window.pixels().map(|p| whole[buffer.window.index(p)]).collect();
            assert!(bits(&part) == bits(&same), "{name} from column {x0} on");
        }
    }
}

// What f32 cannot hold goes the way of f64.
#[test]
fn numbers_that_f32_does_not_take_are_shaded_in_f64() {
    let (_, scene) = scenes::scenes(331, 187).swap_remove(6);
    let buffer = look(&scene);
    let is_double = |scene: &Scene| {
        let options = ShadeOptions::new(Effects::of(scene));
        let double = shaded(scene, &buffer, options);
        let single = ShadeOptions { precision: Precision::Single, ..options };
        bits(&double) == bits(&shaded(scene, &buffer, single))
    };
    assert!(!is_double(&scene), "f32 is at work");
    for (ns, ke) in [(0.5, 0.0), (1e9, 0.0), (30.0, 1e-200), (30.0, 1e30)] {
        let mut scene = scene.clone();
        for material in &mut scene.materials {
            (material.ns, material.ke[1]) = (ns, ke);
        }
        assert!(is_double(&scene), "{ns} {ke:e}");
    }
}

#[test]
fn pictures_in_f32_have_its_colours_and_every_other_plane_of_f64() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/default.toml");
    let overrides = Overrides { resolution: Resolution::new(97, 61), ..Overrides::default() };
    let scene = Scene::load(&path, &overrides).unwrap();
    let with = |shading| {
        let path = VisibilityPath::Raster;
        let options = RenderOptions { path, shading, ..RenderOptions::default() };
        render(&scene, &options, &Unwatched).film
    };
    let [double, single] = [Precision::Double, Precision::Single].map(with);
    assert!(single.description.contains("\"shading\":\"single\""), "{}", single.description);
    assert!(!double.description.contains("shading\":\"single"), "{}", double.description);
    let options = ShadeOptions::new(Effects::of(&scene));
    let options = ShadeOptions { precision: Precision::Single, ..options };
    let colors = shaded(&scene, &look(&scene), options);
    let mut channels = 0;
    for (in_double, in_single) in double.planes.iter().zip(&single.planes) {
        let Some(k) = ["R", "G", "B"].iter().position(|name| *name == in_single.name) else {
            assert!(in_double == in_single, "{}", in_single.name);
            continue;
        };
        channels += 1;
        let Samples::Float(values) = &in_single.samples else { panic!("{}", in_single.name) };
        assert!(values.iter().zip(&colors).all(|(value, color)| *value == color[k] as f32));
        assert!(in_double.samples != in_single.samples, "f32 was not at work");
    }
    assert_eq!(channels, 3);
    let folder = tempfile::TempDir::new().unwrap();
    let scene = path.to_str().unwrap();
    let arguments = ["render", scene, "--size", "97x61", "--json", "--shading", "single"];
    let (status, stdout, _) =
        truecast(folder.path(), &[&arguments[..], &["-o", "a.exr", "-o", "a.png"]].concat());
    assert_eq!(status, 0);
    assert!(stdout.contains("\"shading\": \"single\""), "{stdout}");
}
