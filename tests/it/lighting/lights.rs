//! A11–A16: distance, kinds of light, cones, and sums over lights.

use super::stage::{
    V3, ambient, colors, directional, dot, floor, look, pixel_at, point, radiance_at, spot, unit,
    white,
};
use super::{NORTH, ULP, matte, shiny, surface};
use truecast::scene::Scene;
use truecast::scene::light::Light;
use truecast::shade::{self, Effects, LightTerm, Outcome};

/// Every light's term at the pixel that looks at (x, y, 0).
fn terms_at(scene: &Scene, x: i32, y: i32) -> Vec<LightTerm> {
    let visible = super::stage::look_at(scene, pixel_at(x, y)).unwrap();
    shade::terms(scene, pixel_at(x, y), &visible, None).lights
}

#[test]
fn a11_distance_attenuates_positional_lights_only() {
    let material = shiny([0.7, 0.3, 0.1], [0.5; 3], 20.0);
    let at = |distance: f64, abc: V3| {
        let mut scene = floor();
        scene.lights = vec![point([0.0, 0.6 * distance, 0.8 * distance], abc, white())];
        shade::shade_point(&scene, &surface(NORTH, NORTH), &material)
    };
    for distance in [0.3, 1.0, 7.0, 1e20, 1e-20] {
        let (near, far) = (at(distance, [0.0, 0.0, 1.0]), at(2.0 * distance, [0.0, 0.0, 1.0]));
        assert_eq!(near, far.map(|value| 4.0 * value), "a quarter, exactly");
        let (near, far) = (at(distance, [0.0, 1.0, 0.0]), at(2.0 * distance, [0.0, 1.0, 0.0]));
        assert_eq!(near, far.map(|value| 2.0 * value), "a half, exactly");
        assert_eq!(at(distance, [1.0, 0.0, 0.0]), at(2.0 * distance, [1.0, 0.0, 0.0]));
    }
    let (all, plain) = (at(2.0, [1.0, 2.0, 3.0]), at(2.0, [1.0, 0.0, 0.0]));
    for channel in 0..3 {
        assert!((all[channel] * 17.0 / plain[channel] - 1.0).abs() <= 4.0 * ULP);
    }
    // A directional light is the same wherever the surface is.
    let mut scene = floor();
    scene.lights = vec![directional([0.0, -3.0, -4.0], white())];
    let mut moved = surface(NORTH, NORTH);
    let here = shade::shade_point(&scene, &moved, &material);
    moved.position = [1e6, -3.0, 1e-9];
    assert_eq!(shade::shade_point(&scene, &moved, &material), here);
}

#[test]
fn a12_a_directional_light_is_the_same_everywhere() {
    let mut scene = floor();
    scene.lights = vec![directional([1.0, -2.0, -3.0], white())];
    let here = terms_at(&scene, 2, 3)[0];
    assert_eq!(here.distance, None);
    assert!((here.n_dot_l.unwrap() - 3.0 / 14.0_f64.sqrt()).abs() <= ULP);
    let first = here.n_dot_l.unwrap().to_bits();
    for z in [-100.0, -3.5, 0.125, 5.0] {
        scene.mesh.positions.iter_mut().for_each(|p| p[2] = z);
        for (x, y) in [(0, 0), (-1, 2), (1, 0)] {
            assert_eq!(terms_at(&scene, x, y)[0].n_dot_l.unwrap().to_bits(), first);
        }
    }
}

#[test]
fn a13_a_point_light_is_seen_in_another_direction_from_every_point() {
    let mut scene = floor();
    let position = [1.0, 2.0, 5.0];
    scene.lights = vec![point(position, [1.0, 0.0, 0.0], white())];
    scene.materials[0] = matte([1.0; 3]);
    for x in -8..=8_i32 {
        for y in -8..=8_i32 {
            let (dx, dy) = (1.0 - f64::from(x), 2.0 - f64::from(y));
            let r = (dx * dx + dy * dy + 25.0).sqrt();
            let term = terms_at(&scene, x, y)[0];
            assert_eq!(term.distance, Some(r));
            // By 1/r, which is rounded once more than the quotient.
            assert!((term.n_dot_l.unwrap() - 5.0 / r).abs() <= ULP);
            assert_eq!(term.gate(), Some(1));
        }
    }
}

/// A floor under a spotlight at height 4 that aims straight down.
fn under_spot(cutoff_deg: f64, exponent: f64) -> Scene {
    let mut scene = floor();
    scene.materials[0] = matte([1.0; 3]);
    scene.lights = vec![Light::Spot(spot([0.0, 0.0, 4.0], [0.0, 0.0, -1.0], cutoff_deg, exponent))];
    scene
}

#[test]
fn a14_a_spotlight_is_a_cone_with_its_rim() {
    // A cutoff of 45° reaches x² + y² ≤ 16; the points (±4, 0), (0, ±4) lie exactly on the rim.
    let hard = under_spot(45.0, 0.0);
    let picture = super::stage::picture(&hard);
    let mut open = hard.clone();
    let Light::Spot(light) = &mut open.lights[0] else { unreachable!() };
    light.cutoff_deg = 180.0;
    light.exponent = 77.0;
    let without_cone = super::stage::picture(&open);
    let mut plain = hard.clone();
    plain.lights = vec![point([0.0, 0.0, 4.0], [1.0, 0.0, 0.0], white())];
    assert_eq!(without_cone, super::stage::picture(&plain), "180° is a point light");
    let window = look(&hard).window;
    for x in -8..=8_i32 {
        for y in -8..=8_i32 {
            let index = window.index(pixel_at(x, y));
            let lit = x * x + y * y <= 16;
            let expected = if lit { without_cone[index] } else { [0.0; 3] };
            assert_eq!(picture[index], expected, "a hard disc: ({x}, {y})");
        }
    }
    // Every Pythagorean rim is lit: the point (r, 0) under a cone of atan(r/4).
    for r in 1..=8_i32 {
        let rim = under_spot((f64::from(r) / 4.0).atan().to_degrees(), 3.0);
        assert_eq!(terms_at(&rim, r, 0)[0].outcome, Outcome::Lit, "{r}");
        assert_eq!(terms_at(&rim, 0, -r)[0].outcome, Outcome::Lit, "{r}");
    }
    // Aim flipped: dark.
    let mut flipped = hard.clone();
    flipped.lights = vec![Light::Spot(spot([0.0, 0.0, 4.0], [0.0, 0.0, 1.0], 45.0, 0.0))];
    assert!(super::stage::picture(&flipped).iter().all(|rgb| *rgb == [0.0; 3]));
    // (L·S)^e inside: at (3, 0), L·S = 0.8.
    let soft = radiance_at(&under_spot(45.0, 2.0), 3, 0)[0];
    assert!((soft - 0.8 * 0.8 * 0.8).abs() <= 2.0 * ULP);
    // Between 90° and 180° the cone has no inside behind the light, but the floor is in front.
    assert_eq!(radiance_at(&under_spot(135.0, 0.0), 8, 8), radiance_at(&plain, 8, 8));
}

#[test]
fn a15_global_ambient_is_added_once_and_never_attenuated() {
    let mut scene = floor();
    scene.materials[0].ka = [0.3, 0.6, 0.9];
    let constant = [0.3 * 0.5, 0.6 * 0.25, 0.9 * 2.0];
    let others = [
        Light::Spot(spot([0.0, 0.0, 1e3], [0.0, 0.0, 1.0], 20.0, 9.0)),
        point([0.0, 0.0, 50.0], [0.0, 0.0, 1.0], white()),
        directional([0.0, 0.0, -1.0], white()),
    ];
    for count in 0..=others.len() {
        scene.lights = others[..count].to_vec();
        let without = radiance_at(&scene, 3, -2);
        scene.lights.insert(0, ambient([0.5, 0.25, 2.0]));
        assert_eq!(terms_at(&scene, 3, -2)[0].ambient, constant);
        let with = radiance_at(&scene, 3, -2);
        for channel in 0..3 {
            let difference = with[channel] - without[channel];
            assert!((difference - constant[channel]).abs() <= 2.0 * ULP * with[channel]);
        }
    }
}

#[test]
fn a16_iteration_four_is_the_sum_over_all_lights() {
    let scene = super::neutrality::busy_scene();
    let all = super::stage::picture(&scene);
    let only = |lights: Vec<Light>| {
        let mut part = scene.clone();
        part.background = [0.0; 3];
        part.lights = lights;
        super::stage::picture(&part)
    };
    let dark = only(Vec::new());
    let parts: Vec<Vec<V3>> = scene.lights.iter().map(|light| only(vec![light.clone()])).collect();
    let backwards = only(scene.lights.iter().rev().cloned().collect());
    // n lights are 3n + 1 additions of numbers that are not negative, each of which rounds by at
    // most half an ulp of the final sum; both sides round.
    let bound = (3.0 * scene.lights.len() as f64 + 1.0) * ULP;
    let mut seen = 0;
    for (index, visible) in look(&scene).visible.iter().enumerate() {
        if visible.is_none() {
            continue;
        }
        seen += 1;
        for channel in 0..3 {
            let emission = dark[index][channel];
            let sum: f64 =
                emission + parts.iter().map(|part| part[index][channel] - emission).sum::<f64>();
            let value = all[index][channel];
            assert!((value - sum).abs() <= 2.0 * bound * value, "{value} {sum}");
            assert!((value - backwards[index][channel]).abs() <= bound * value);
        }
    }
    assert!(seen > 50);
}

#[test]
fn a_million_faint_lights_add_up() {
    // C18: in f32, left to right, 1 + 10⁶ · 10⁻⁸ stays 1.
    let mut scene = floor();
    scene.lights = vec![ambient([1.0; 3])];
    scene.lights.extend(std::iter::repeat_n(ambient([1e-8; 3]), 1_000_000));
    scene.materials[0].ka = [1.0; 3];
    let material = scene.materials[0].clone();
    let value = shade::shade_point(&scene, &surface(NORTH, NORTH), &material)[0];
    // 10⁶ additions near 1, each off by at most 2^-53.
    assert!((value - 1.01).abs() <= 1e6 * ULP / 2.0, "{value}");
}

#[test]
fn a_lights_own_ambient_is_neither_gated_nor_attenuated() {
    // C24: black light, far light, light behind, light outside its cone, light at the point.
    let own = colors([0.5, 0.25, 1.0], [0.0; 3], [0.0; 3]);
    let bright = colors(own.ambient, [1.0; 3], [1.0; 3]);
    let behind = [0.0, 0.0, -5.0];
    let mut outside = spot([0.0, 0.0, 4.0], [1.0, 0.0, 0.0], 10.0, 2.0);
    outside.colors = bright;
    // Inside the cone, but beside the light: (L·S)^e is 0, and so is the denominator c·r² in f64.
    let mut beside = spot([0.0, 0.0, 1e-170], [1.0, 0.0, 0.0], 120.0, 2.0);
    beside.attenuation = [0.0, 0.0, 5e-324];
    beside.colors = bright;
    let cases = [
        (directional([0.0, 0.0, -1.0], own), Outcome::NoColor),
        (directional([0.0, 0.0, 1.0], bright), Outcome::FacesAway),
        (directional([1.0, 0.0, 0.0], bright), Outcome::FacesAway),
        (point(behind, [0.0, 0.0, 1e9], bright), Outcome::FacesAway),
        (point([0.0, 0.0, 1e200], [0.0, 0.0, 1e9], bright), Outcome::Faded),
        (point([0.0; 3], [0.0, 0.0, 1.0], bright), Outcome::AtSurface),
        (Light::Spot(outside), Outcome::OutsideCone),
        (Light::Spot(beside), Outcome::Faded),
    ];
    for (light, outcome) in cases {
        let mut scene = floor();
        scene.materials[0] = shiny([0.8; 3], [0.5; 3], 9.0);
        scene.materials[0].ka = [0.5; 3];
        scene.lights = vec![light];
        assert_eq!(terms_at(&scene, 0, 0)[0].outcome, outcome);
        assert_eq!(radiance_at(&scene, 0, 0), [0.25, 0.125, 0.5], "{outcome:?}");
        let notes = shade::shade(&scene, &look(&scene), Effects::ALL, &|| ()).notes;
        assert_eq!(notes.lights_at_surface, u64::from(outcome == Outcome::AtSurface));
    }
}

#[test]
fn the_terminator_has_two_clean_sides() {
    // C21: for ns = 0 the highlight is 1 wherever B is; a light 1e-12 above the horizon is lit
    // whole, one below is not, and only those within 1e-13 are counted as doubtful.
    let mut scene = floor();
    scene.materials[0] = shiny([0.0; 3], [1.0; 3], 0.0);
    let buffer = look(&scene);
    for (sine, value, doubtful) in
        [(1e-12, 1.0, 0), (-1e-12, 0.0, 0), (0.0, 0.0, 289), (1e-14, 1.0, 289), (-1e-14, 0.0, 289)]
    {
        scene.lights = vec![directional([1.0, 0.0, -sine], white())];
        let shaded = shade::shade(&scene, &buffer, Effects::of(&scene), &|| ());
        assert!(shaded.radiance.iter().all(|rgb| *rgb == [value; 3]), "{sine:e}");
        assert_eq!(shaded.notes.near_terminator, doubtful, "{sine:e}");
    }
}

#[test]
fn light_falls_monotonically_and_scales_linearly() {
    let value = |light: Light, ns: f64| {
        let mut scene = floor();
        scene.lights = vec![light];
        let eye = unit([1.0, 0.0, 2.0]);
        shade::shade_point(&scene, &surface(NORTH, eye), &shiny([0.5; 3], [0.5; 3], ns))[0]
    };
    let falls = |values: Vec<f64>| assert!(values.is_sorted_by(|a, b| a > b), "{values:?}");
    let at = |r: f64| point([0.0, 0.6 * r, 0.8 * r], [1.0, 0.5, 0.25], white());
    falls((1..50).map(|i| value(at(0.1 * f64::from(i)), 8.0)).collect());
    falls((1..50).map(|i| value(at(1.0), f64::from(i))).collect());
    falls(
        (0..40)
            .map(|i| {
                let aim = f64::from(i).to_radians();
                value(
                    Light::Spot(spot([0.0, 0.0, 1.0], [aim.sin(), 0.0, -aim.cos()], 60.0, 3.0)),
                    8.0,
                )
            })
            .collect(),
    );
    // Twice the light is exactly twice the radiance.
    let doubled = colors([0.0; 3], [2.0; 3], [2.0; 3]);
    let (one, two) = (value(at(1.7), 8.0), {
        let Light::Point(light) = at(1.7) else { unreachable!() };
        value(point(light.position, light.attenuation, doubled), 8.0)
    });
    assert_eq!(two, 2.0 * one);
    assert!(dot(NORTH, NORTH) == 1.0 && one > 0.0);
}
