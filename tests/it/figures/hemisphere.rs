//! A73: ambient light against a hemisphere, and the hemisphere's curves.

use super::stage::{Picture, sheet};
use std::collections::HashSet;
use truecast::scene::Scene;
use truecast::scene::light::Light;

/// The largest difference of the text's two curves, (√2 − 1)/2, at 45° and 135°.
const LARGEST: f64 = 0.207_106_781;

/// f32 samples of values up to 1.
const SAMPLE_TOLERANCE: f64 = 1e-6;

/// Pixels of a ball of radius 30 pixels meet 45° within 1°, and the difference is
/// (sin θ + cos θ − 1)/2, which falls by 1.1e-4 within 1°.
const PEAK_TOLERANCE: f64 = 1.2e-4;

/// The scene with nothing but a white sky above a black ground, on white surfaces.
fn blend_alone(scene: &Scene) -> Scene {
    let mut scene = scene.clone();
    for material in &mut scene.materials {
        material.kd = [1.0; 3];
    }
    for light in &mut scene.lights {
        if let Light::Hemisphere(light) = light {
            (light.top, light.bottom) = ([1.0; 3], [0.0; 3]);
        }
    }
    scene
}

#[test]
fn a73_the_curves_differ_by_at_most_0_2071() {
    let cells = sheet("hemisphere").cells;
    let pictures: Vec<_> =
        cells[3..].iter().map(|cell| Picture::of(&blend_alone(&cell.scene))).collect();
    let [cosine, sine, linear] = &pictures[..] else { panic!("three curves") };
    let mut largest = 0.0_f64;
    for pixel in (0..cosine.rgb.len()).filter(|&pixel| cosine.objects[pixel].is_some()) {
        let zenith = cosine.normals[pixel][1].clamp(-1.0, 1.0).acos();
        let upper = zenith <= std::f64::consts::FRAC_PI_2;
        let half_sine = 0.5 * zenith.sin();
        for (picture, expected) in [
            (cosine, 0.5 + 0.5 * zenith.cos()),
            (sine, if upper { 1.0 - half_sine } else { half_sine }),
            (linear, 1.0 - zenith / std::f64::consts::PI),
        ] {
            let a = picture.rgb[pixel][0];
            // The arc cosine of an f32 normal near the poles is good to 3e-4 only, but there the
            // cosine's slope is 0 and half the sine's and the line's are 1/2 and 1/π.
            let near_pole = cosine.normals[pixel][1].abs() > 0.999;
            let tolerance = if near_pole { 3e-4 } else { SAMPLE_TOLERANCE };
            assert!((a - expected).abs() <= tolerance, "{zenith}: {a}, not {expected}");
        }
        largest = largest.max((cosine.rgb[pixel][0] - sine.rgb[pixel][0]).abs());
    }
    assert!((largest - LARGEST).abs() < PEAK_TOLERANCE, "{largest}");
    assert_eq!(format!("{largest:.4}"), "0.2071");
}

#[test]
fn a73_ambient_light_is_a_silhouette_or_blows_out_and_a_hemisphere_shows_form() {
    let cells = sheet("hemisphere").cells;
    let pictures: Vec<_> = cells.iter().map(|cell| Picture::of(&cell.scene)).collect();
    // Where the lamp does not reach, the first cell has no more than its ambient light.
    let shade: Vec<usize> = {
        let seen: Vec<usize> =
            (0..pictures[0].rgb.len()).filter(|&p| pictures[0].objects[p].is_some()).collect();
        let red = |pixel: usize| pictures[0].rgb[pixel][0];
        let least = seen.iter().map(|&pixel| red(pixel)).fold(f64::INFINITY, f64::min);
        seen.into_iter().filter(|&pixel| red(pixel) == least).collect()
    };
    assert!(shade.len() > 500, "{}", shade.len());
    let colors = |picture: &Picture| -> HashSet<[u64; 3]> {
        shade.iter().map(|&pixel| picture.rgb[pixel].map(f64::to_bits)).collect()
    };
    let blown = |picture: &Picture| picture.rgb.iter().filter(|rgb| rgb[0] > 1.0).count();
    let [dim, bright, ambient, hemispheres @ ..] = &pictures[..] else { panic!("six cells") };
    for flat in [dim, bright, ambient] {
        assert_eq!(colors(flat).len(), 1, "no detail in the shade");
    }
    assert_eq!(blown(dim), 0);
    assert!(blown(bright) > 1000, "whites are blown out");
    for hemisphere in hemispheres {
        assert!(colors(hemisphere).len() > 200, "detail in the shade");
        assert_eq!(blown(hemisphere), 0);
    }
}
