//! Several pixels at once: every bit of radiance and every note is that of one pixel after the
//! other, at every instruction set.

use super::neutrality;
use super::stage::bits;
use crate::called_for::scenes;
use std::path::Path;
use truecast::pixel::{Pixel, Resolution};
use truecast::raster::rasterize;
use truecast::scene::switches::{DIALECTS, SWITCHES, SwitchValue, Switches};
use truecast::scene::{Overrides, Scene, Sides};
use truecast::shade::{self, Asker, Effects, Occlusion, ShadeOptions};
use truecast::simd::SimdLevel;
use truecast::visibility::{Counting, VisibilityBuffer};

fn look(scene: &Scene) -> VisibilityBuffer {
    rasterize(scene, scene.camera.resolution().window(), Counting::Nearest, &|| ())
}

fn is_the_same<'a>(
    name: &str,
    scene: &'a Scene,
    buffer: &VisibilityBuffer,
    occlusion: Option<Occlusion<'a>>,
) {
    for effects in [Effects::of(scene), Effects::ALL] {
        let by = |simd| {
            let options = ShadeOptions { simd, ..ShadeOptions::new(effects) };
            shade::shade_with(scene, buffer, &options, occlusion, &|| ())
        };
        let single = by(None);
        for level in SimdLevel::available() {
            let several = by(Some(level));
            let differs = bits(&single.radiance)
                .iter()
                .zip(bits(&several.radiance))
                .position(|(single, several)| *single != several);
            assert_eq!(differs, None, "{name} at {level}");
            assert_eq!(several.notes, single.notes, "{name} at {level}");
        }
    }
}

#[test]
fn pictures_are_the_same_bits_at_every_level() {
    // A width that is no multiple of anything: the last run and its last lanes are cut.
    let mut all = scenes::scenes(83, 47);
    all.extend(neutrality::scenes());
    for (name, scene) in &mut all {
        let buffer = look(scene);
        is_the_same(name, scene, &buffer, None);
        scene.objects.iter_mut().for_each(|object| object.sides = Sides::Double);
        let buffer = look(scene);
        is_the_same(name, scene, &buffer, None);
    }
}

#[test]
fn scenes_of_the_repository_are_the_same_bits_at_every_level() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let mut count = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|extension| extension != "toml") {
            continue;
        }
        let resolution = Resolution::new(150, 90);
        let overrides = Overrides { resolution, ..Overrides::default() };
        // Some scenes know one size only.
        let scene = Scene::load(&path, &overrides)
            .or_else(|_| Scene::load(&path, &Overrides::default()))
            .unwrap();
        is_the_same(&path.display().to_string(), &scene, &look(&scene), None);
        count += 1;
    }
    assert!(count > 5, "{count} scenes");
}

#[test]
fn every_switch_is_the_same_bits_at_every_level() {
    let (_, scene) = scenes::scenes(83, 47).swap_remove(6);
    let buffer = look(&scene);
    let of = |switches| Scene { switches, ..scene.clone() };
    for dialect in DIALECTS {
        is_the_same(dialect, &of(Switches::of_dialect(dialect).unwrap()), &buffer, None);
    }
    for switch in &SWITCHES {
        let values = match switch.words {
            [] => vec![SwitchValue::Is(false), SwitchValue::Is(true)],
            words => words.iter().map(|word| SwitchValue::Word(word)).collect(),
        };
        for value in values {
            let switches = Switches::of_dialect(DIALECTS[0]).unwrap().with(switch.name, value);
            is_the_same(switch.name, &of(switches), &buffer, None);
        }
    }
}

#[test]
fn shadows_are_the_same_bits_at_every_level() {
    // Shadows in stripes that no lane boundary follows.
    let hides = |pixel: Pixel, light: usize| (pixel.x * 7 + pixel.y * 3 + light as u32) % 5 < 2;
    for (name, mut scene) in scenes::scenes(83, 47) {
        for light in &mut scene.lights {
            set_shadows(light);
        }
        let buffer = look(&scene);
        let asker = || -> Asker<'_> { Box::new(move |pixel, _, light| hides(pixel, light)) };
        let options = ShadeOptions::new(Effects::of(&scene));
        let open = shade::shade_with(&scene, &buffer, &options, None, &|| ());
        let shadowed = shade::shade_with(&scene, &buffer, &options, Some(&asker), &|| ());
        let casts = scene.lights.iter().any(|light| light.casts_shadows());
        assert_eq!(open.radiance != shadowed.radiance, casts, "{name}");
        is_the_same(name, &scene, &buffer, Some(&asker));
    }
}

fn set_shadows(light: &mut truecast::scene::light::Light) {
    use truecast::scene::light::Light;
    match light {
        Light::Ambient(_) | Light::Hemisphere(_) => {}
        Light::Directional(light) => light.shadows = true,
        Light::Point(light) => light.shadows = true,
        Light::Spot(light) => light.shadows = true,
    }
}
