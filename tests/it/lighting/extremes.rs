//! Every number that a checked scene may hold, at the ends of its range: radiance is a number, an
//! infinite one is counted, and nothing panics.

use super::neutrality::busy_scene;
use super::stage::{V3, bits, look, unit};
use std::path::Path;
use truecast::scene::light::{Light, LightColors};
use truecast::scene::switches::{DIALECTS, SWITCHES, SwitchValue, Switches};
use truecast::scene::texture::{Filter, Level, Texture, TextureRef, Wrap};
use truecast::scene::{Scene, Shading, Sides};
use truecast::shade::{self, Effects, ShadeOptions};

use truecast::visibility::VisibilityBuffer;

/// Magnitudes around every edge of f32 and f64.
const MAGNITUDES: [f64; 20] = [
    0.0,
    -0.0,
    5e-324,
    1e-310,
    f64::MIN_POSITIVE,
    1e-200,
    1e-160,
    1e-45,
    1e-38,
    1e-8,
    0.5,
    1.0,
    std::f64::consts::PI,
    1e8,
    1e38,
    f32::MAX as f64,
    1e154,
    1e200,
    1e300,
    f64::MAX,
];

/// Cutoffs in degrees, 0 < c ≤ 180.
const CUTOFFS: [f64; 9] = [5e-324, 1e-300, 1e-15, 1e-7, 45.0, 90.0, 135.0, 179.999_999_9, 180.0];

/// A small repeatable sequence (Knuth's multiplier), for choosing among the values above.
struct Dice(u64);

impl Dice {
    fn below(&mut self, count: usize) -> usize {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) as usize) % count
    }

    fn magnitude(&mut self) -> f64 {
        MAGNITUDES[self.below(MAGNITUDES.len())]
    }

    fn signed(&mut self) -> f64 {
        let magnitude = self.magnitude();
        if self.below(2) == 0 { -magnitude } else { magnitude }
    }
}

/// How many numbers [`set`] knows.
const FIELDS: usize = 32;

/// Sets one number of the scene; `dice` chooses which colour channel, axis or light.
fn set(scene: &mut Scene, field: usize, dice: &mut Dice) {
    let value = dice.magnitude();
    let channel = dice.below(3);
    match field {
        0 => scene.materials[0].ke[channel] = value,
        1 => scene.materials[0].ka[channel] = value,
        2 => scene.materials[0].kd[channel] = value,
        3 => scene.materials[0].ks[channel] = value,
        4 => scene.materials[0].ns = value,
        5 => scene.background[channel] = value,
        6..=8 => {
            // A normal of unit length whose other components are tiny.
            let mut normal = [dice.signed(), dice.signed(), dice.signed()];
            normal = normal.map(|c| c.clamp(-1e100, 1e100));
            let count = scene.mesh.normals.len();
            if normal.iter().any(|c| c.abs() > 1e-100) {
                scene.mesh.normals[dice.below(count)] = unit(normal);
            }
        }
        9..=11 => {
            let count = scene.mesh.positions.len();
            let largest = 2.0_f64.powi(126);
            let coordinate = dice.signed().clamp(-largest, largest) as f32;
            scene.mesh.positions[dice.below(count)][channel] = coordinate;
        }
        _ => {
            let count = scene.lights.len();
            set_light(&mut scene.lights[dice.below(count)], field, value, channel, dice);
        }
    }
}

fn set_light(light: &mut Light, field: usize, value: f64, channel: usize, dice: &mut Dice) {
    let set_colors = |colors: &mut LightColors| match field {
        12..=13 => colors.ambient[channel] = value,
        14..=16 => colors.diffuse[channel] = value,
        17..=19 => colors.specular[channel] = value,
        _ => {}
    };
    let aim = unit([[1.0, 1e-200, 0.0], [5e-324, 1.0, -0.0], [1e-8, 0.0, -1.0]][channel]);
    let set_attenuation = |abc: &mut V3| {
        let mut changed = *abc;
        changed[channel] = value;
        if field >= 29 {
            changed = [0.0; 3];
            changed[channel] = value;
        }
        if changed != [0.0; 3] {
            *abc = changed;
        }
    };
    match light {
        Light::Ambient(light) => light.ambient[channel] = value,
        Light::Hemisphere(light) => match field {
            12..=15 => light.top[channel] = value,
            16..=19 => light.bottom[channel] = value,
            20 => light.up = aim,
            _ => {}
        },
        Light::Directional(light) => {
            set_colors(&mut light.colors);
            if field == 20 {
                light.aim = aim;
            }
        }
        Light::Point(light) => {
            set_colors(&mut light.colors);
            match field {
                21..=23 => light.position[channel] = dice.signed(),
                26..=31 => set_attenuation(&mut light.attenuation),
                _ => {}
            }
        }
        Light::Spot(light) => {
            set_colors(&mut light.colors);
            match field {
                20 => light.aim = aim,
                21..=23 => light.position[channel] = dice.signed(),
                24 => light.cutoff_deg = CUTOFFS[dice.below(CUTOFFS.len())],
                25 => light.exponent = value,
                26..=31 => set_attenuation(&mut light.attenuation),
                _ => {}
            }
        }
    }
}

/// Draws a dialect and switches, a way of shading, maps with texture coordinates of any size, colours
/// of vertices, and whether the second material is lit at all.
fn set_words(scene: &mut Scene, dice: &mut Dice) {
    let mut switches = Switches::of_dialect(DIALECTS[dice.below(DIALECTS.len())]).unwrap();
    for switch in &SWITCHES {
        if dice.below(3) != 0 {
            continue;
        }
        let value = match switch.words {
            [] => SwitchValue::Is(dice.below(2) == 0),
            words => SwitchValue::Word(words[dice.below(words.len())]),
        };
        switches = switches.with(switch.name, value);
    }
    scene.switches = switches;
    scene.objects[0].shading = Shading::NAMED[dice.below(Shading::NAMED.len())].0;
    scene.objects[0].sides = [Sides::Single, Sides::Double][dice.below(2)];
    scene.materials[1].unlit = dice.below(4) == 0;
    let count = scene.mesh.positions.len();
    scene.mesh.colors =
        (0..count).map(|_| [dice.magnitude(), dice.magnitude(), dice.magnitude()]).collect();
    scene.mesh.uvs = (0..count).map(|_| [dice.signed(), dice.signed()]).collect();
    scene.mesh.corner_uvs = scene.mesh.corners.clone();
    let texels = vec![[0.0, 0.5, 1.0], [f32::MAX, 1e-45, 0.25], [1.0; 3], [0.0; 3]];
    let texture = Texture::new(Path::new("t.png"), Level::new(2, 2, texels).unwrap());
    scene.textures = vec![texture.with_levels()];
    let mut map = || {
        (dice.below(2) == 0).then(|| TextureRef {
            texture: 0,
            filter: Filter::NAMED[dice.below(3)].1,
            wrap: Wrap::NAMED[dice.below(2)].1,
            scale: [dice.signed(), dice.signed()],
            offset: [dice.signed(), dice.signed()],
        })
    };
    (scene.materials[0].kd_map, scene.materials[0].ks_map) = (map(), map());
}

/// Shades and checks; returns how many pixels left the range.
fn check(scene: &Scene, buffer: &VisibilityBuffer) -> u64 {
    let shaded = shade::shade(scene, buffer, Effects::of(scene), &|| ());
    let mut infinite = 0;
    for rgb in &shaded.radiance {
        assert!(rgb.iter().all(|value| *value >= 0.0), "{rgb:?} in {scene:?}");
        infinite += u64::from(rgb.iter().any(|value| value.is_infinite()));
    }
    assert_eq!(shaded.notes.non_finite, infinite);
    // Lane by lane and pixel by pixel, it is the same number.
    let options = ShadeOptions { simd: None, ..ShadeOptions::new(Effects::of(scene)) };
    let single = shade::shade_with(scene, buffer, &options, None, &|| ());
    assert_eq!(bits(&single.radiance), bits(&shaded.radiance), "{scene:?}");
    assert_eq!(single.notes, shaded.notes, "{scene:?}");
    let forced = shade::shade(scene, buffer, Effects::ALL, &|| ());
    assert_eq!(bits(&forced.radiance), bits(&shaded.radiance), "{scene:?}");
    infinite
}

#[test]
fn numbers_at_the_ends_of_their_ranges_never_make_nan() {
    let mut dice = Dice(1);
    let original = busy_scene();
    let buffer = look(&original);
    let (mut infinite, mut scenes_in_range) = (0, 0);
    for round in 0..6_000 {
        // One field at a time first, then up to a dozen together.
        let mut scene = original.clone();
        let fields = if round < 2_000 { 1 } else { 1 + dice.below(12) };
        let mut moved = false;
        for _ in 0..fields {
            let field = dice.below(FIELDS);
            moved |= (9..=11).contains(&field);
            set(&mut scene, field, &mut dice);
        }
        let pixels = if moved { check(&scene, &look(&scene)) } else { check(&scene, &buffer) };
        infinite += pixels;
        scenes_in_range += u32::from(pixels == 0);
    }
    // Both kinds of scene were really met.
    assert!(infinite > 0 && scenes_in_range > 3_000, "{infinite} {scenes_in_range}");
}

#[test]
fn words_and_numbers_at_the_ends_of_their_ranges_never_make_nan() {
    let mut dice = Dice(35);
    let original = busy_scene();
    let buffer = look(&original);
    let (mut infinite, mut scenes_in_range) = (0, 0);
    for round in 0..6_000 {
        let mut scene = original.clone();
        set_words(&mut scene, &mut dice);
        let mut moved = false;
        for _ in 0..if round < 2_000 { 0 } else { dice.below(8) } {
            let field = dice.below(FIELDS);
            moved |= (9..=11).contains(&field);
            set(&mut scene, field, &mut dice);
        }
        let pixels = if moved { check(&scene, &look(&scene)) } else { check(&scene, &buffer) };
        infinite += pixels;
        scenes_in_range += u32::from(pixels == 0);
    }
    assert!(infinite > 0 && scenes_in_range > 2_000, "{infinite} {scenes_in_range}");
}

#[test]
fn a_light_at_the_pole_of_its_attenuation_is_finite() {
    // a = b = 0: the equation has a pole at r = 0, and 1/r² leaves the range at 1e-160.
    for r in [1e-20, 1e-100, 1e-150, 1e-160, 1e-300, 5e-324] {
        let mut scene = super::stage::floor();
        scene.lights =
            vec![super::stage::point([0.0, 0.0, r], [0.0, 0.0, 1.0], super::stage::white())];
        scene.materials[0] = super::shiny([0.5, 0.0, 0.5], [0.0, 0.5, 0.5], 10.0);
        let buffer = look(&scene);
        let shaded = shade::shade(&scene, &buffer, Effects::of(&scene), &|| ());
        assert_eq!(shaded.notes.non_finite, 0, "{r:e}");
        let under = shaded.radiance[buffer.window.index(super::stage::pixel_at(0, 0))];
        assert!(under.iter().all(|value| *value >= 1e39 && value.is_finite()), "{r:e}: {under:?}");
    }
}

#[test]
fn a_scene_scaled_by_a_power_of_two_keeps_every_bit() {
    use truecast::scene::camera::PinholeCamera;
    let mut original = busy_scene();
    // Attenuation has a length of its own.
    for light in &mut original.lights {
        match light {
            Light::Point(light) => light.attenuation = [1.0, 0.0, 0.0],
            Light::Spot(light) => light.attenuation = [1.0, 0.0, 0.0],
            Light::Ambient(_) | Light::Directional(_) | Light::Hemisphere(_) => {}
        }
    }
    let expected = shade::shade(&original, &look(&original), Effects::ALL, &|| ());
    for exponent in [-90, -40, -1, 1, 40, 110] {
        let s = 2.0_f64.powi(exponent);
        let mut scene = original.clone();
        scene.mesh.positions.iter_mut().for_each(|p| *p = p.map(|c| (f64::from(c) * s) as f32));
        for light in &mut scene.lights {
            match light {
                Light::Point(light) => light.position = light.position.map(|c| c * s),
                Light::Spot(light) => light.position = light.position.map(|c| c * s),
                Light::Ambient(_) | Light::Directional(_) | Light::Hemisphere(_) => {}
            }
        }
        let camera = &original.camera;
        let [eye, d0, dx, dy] =
            [camera.eye(), camera.d0(), camera.dx(), camera.dy()].map(|v| v.map(|c| c * s));
        scene.camera = PinholeCamera::exact(camera.resolution(), eye, d0, dx, dy).unwrap();
        let shaded = shade::shade(&scene, &look(&scene), Effects::ALL, &|| ());
        assert_eq!(bits(&shaded.radiance), bits(&expected.radiance), "2^{exponent}");
    }
}
