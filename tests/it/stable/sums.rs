//! Sums over lights: S18, S24, S27, S29, S30.

use super::*;
use truecast::scene::light::{DirectionalLight, Light, LightColors};

/// A sphere on a floor, 24 × 18 pixels, ka = 0.25.
fn sphere(lights: &str) -> Scene {
    let text = format!(
        "version = 1\n[image]\nwidth = 24\nheight = 18\n[camera]\neye = [0, 2, 6]\n\
         target = [0, 0.5, 0]\nup = [0, 1, 0]\nfov_y_deg = 40\n\
         [[material]]\nname = \"m\"\nka = [0.25, 0.5, 0.75]\nkd = [0.5, 0.3, 0.1]\n\
         ks = [0.5, 0.5, 0.5]\nke = [0.0625, 0, 0]\nns = 20\n\
         [[mesh]]\nshape = {{ uv_sphere = {{ around = 24, rings = 12 }} }}\nmaterial = \"m\"\n\
         [[mesh]]\nshape = {{ plane = {{ width = 6, depth = 6 }} }}\nmaterial = \"m\"\n\
         translate = [0, -1, 0]\n{lights}"
    );
    load(&text, "")
}

fn bits(radiance: &[V3]) -> Vec<[u64; 3]> {
    radiance.iter().map(|rgb| rgb.map(f64::to_bits)).collect()
}

#[test]
fn s18_many_small_lights_are_not_lost() {
    let mut scene = Setup::plate(UP).scene();
    let light = |intensity: f64| {
        let colors = LightColors { ambient: [0.0; 3], diffuse: [intensity; 3], specular: [0.0; 3] };
        Light::Directional(DirectionalLight { aim: [0.0, 0.0, -1.0], colors, shadows: false })
    };
    for (count, right) in [(100_000, 1.001), (1_000_000, 1.01)] {
        for bright_first in [true, false] {
            let mut lights = vec![light(1e-8); count];
            lights.insert(if bright_first { 0 } else { count }, light(1.0));
            scene.lights = lights;
            // In f32, bright first, the sum stays 1. In f64 each of the sums near 1 rounds by at
            // most 2^-53.
            let value = shaded(&scene).radiance[0][0];
            assert_near(value, right, count as f64 * f64::EPSILON / 2.0);
        }
    }
}

#[test]
fn s24_ambient_parts_are_neither_gated_nor_attenuated() {
    let mut setup = Setup::plate(UP);
    setup.material = "kd = [1, 1, 1]\nks = [1, 1, 1]\nka = [0.5, 0.25, 1]\n".to_owned();
    let lights = [
        // Black but for its ambient part; behind the surface; outside the cone; far away.
        "type = \"point\"\nposition = [0, 0, 2]\nintensity = [0, 0, 0]\n",
        "type = \"directional\"\naim = [0, 0, 1]\nintensity = [1, 1, 1]\n",
        "type = \"spot\"\nposition = [0, 0, 2]\naim = [1, 0, 0]\ncutoff_deg = 10\n\
         intensity = [1, 1, 1]\n",
        "type = \"point\"\nposition = [0, 0, -1e30]\nattenuation = [0, 0, 1]\n\
         intensity = [1, 1, 1]\n",
    ];
    for light in lights {
        let lit = setup.clone().lit(&format!("{light}ambient = [0.5, 0.5, 0.5]\n"));
        assert_eq!(lit.shaded().radiance[0], [0.25, 0.125, 0.5], "{light}");
    }
}

#[test]
fn s27_light_is_linear() {
    let spot = "[[light]]\ntype = \"spot\"\nposition = [2, 4, 3]\ntarget = [0, 0, 0]\n\
                attenuation = [0.5, 0.1, 0.02]\ncutoff_deg = 25\nexponent = 3\n";
    let sun = "[[light]]\ntype = \"directional\"\naim = [1, -2, -1]\n";
    let with = |lights: &str| {
        let mut scene = sphere(lights);
        scene.materials.iter_mut().for_each(|material| material.ke = [0.0; 3]);
        shaded(&scene).radiance
    };
    let one = with(&format!("{spot}intensity = [0.3, 0.7, 1.1]\n"));
    let two = with(&format!("{spot}intensity = [0.6, 1.4, 2.2]\n"));
    assert!(one.iter().filter(|rgb| rgb[0] > 0.0).count() > 50);
    let doubled: Vec<V3> = one.iter().map(|rgb| rgb.map(|value| 2.0 * value)).collect();
    assert_eq!(bits(&two), bits(&doubled));
    // Two lights are the sum of their pictures: four parts added in another order.
    let other = with(&format!("{sun}intensity = [0.2, 0.4, 0.6]\n"));
    let both =
        with(&format!("{spot}intensity = [0.3, 0.7, 1.1]\n{sun}intensity = [0.2, 0.4, 0.6]\n"));
    for ((one, other), both) in one.iter().zip(&other).zip(&both) {
        for k in 0..3 {
            let sum = one[k] + other[k];
            assert!((both[k] - sum).abs() <= 2.0 * f64::EPSILON * sum, "{} {sum}", both[k]);
        }
    }
}

#[test]
fn s29_a_term_that_says_nothing_changes_nothing() {
    let colors = "intensity = [0.9, 0.8, 0.7]\nambient = [0.1, 0, 0]\nposition = [2, 4, 3]\n\
                  attenuation = [0.5, 0.1, 0.02]\n";
    let point = sphere(&format!("[[light]]\ntype = \"point\"\n{colors}"));
    let spot = |exponent: f64| {
        sphere(&format!(
            "[[light]]\ntype = \"spot\"\naim = [0, -1, 0]\ncutoff_deg = 180\n\
             exponent = {exponent:?}\n{colors}"
        ))
    };
    let plain = shaded(&point);
    assert!(plain.radiance.iter().filter(|rgb| rgb[1] > 0.05).count() > 50);
    for scene in [spot(0.0), spot(7.5)] {
        assert_eq!(bits(&shaded(&scene).radiance), bits(&plain.radiance));
        // With all code switched on, wanted or not.
        let forced = shade::shade(&scene, &visible(&scene), Effects::ALL, &|| ());
        assert_eq!(bits(&forced.radiance), bits(&plain.radiance));
    }
}

#[test]
fn s30_a_light_without_intensity_adds_its_ambient_part() {
    let kinds = [
        "type = \"directional\"\naim = [1, -2, -1]\n",
        "type = \"point\"\nposition = [2, 4, 3]\n",
        "type = \"spot\"\nposition = [2, 4, 3]\ntarget = [0, 0, 0]\ncutoff_deg = 40\n",
    ];
    for kind in kinds {
        let scene = sphere(&format!(
            "[[light]]\n{kind}intensity = [0, 0, 0]\nambient = [0.5, 0.25, 0.125]\n"
        ));
        // ke + ka·Ia, exact in binary.
        let right = [0.0625 + 0.125, 0.125, 0.093_75];
        for (seen, rgb) in visible(&scene).visible.iter().zip(shaded(&scene).radiance) {
            assert_eq!(rgb, if seen.is_some() { right } else { [0.0; 3] }, "{kind}");
        }
    }
}
