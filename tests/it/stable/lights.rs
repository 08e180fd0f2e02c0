//! Distance, attenuation and cones: S05 to S09, S23, S25, S26.

use super::*;
use truecast::film::{FilmError, encode_png};
use truecast::render::{RenderOptions, render};

/// A spotlight over the origin whose axis misses it by an angle, in degrees.
fn spot(angle_deg: f64, cutoff_deg: f64, exponent: f64) -> String {
    let [x, _, z] = tilted(angle_deg.to_radians());
    format!(
        "type = \"spot\"\nposition = [0, 0, 2]\naim = [{x:?}, 0, {:?}]\n\
         cutoff_deg = {cutoff_deg:?}\nexponent = {exponent:?}\nintensity = [1, 1, 1]\n",
        -z
    )
}

#[test]
fn s05_a_light_close_to_the_surface_and_on_it() {
    let over = |r: f64| Setup::plate(UP).lit(&point([0.0, 0.0, r], [0.0, 0.0, 1.0]));
    assert_near(over(1e-23).value(), 1e46, TOLERANCE);
    // On it: no direction, the ambient part only, and counted.
    let mut setup = over(0.0);
    setup.material = "kd = [1, 1, 1]\nka = [0.5, 0.5, 0.5]\n".to_owned();
    setup.lights += "ambient = [0.25, 0.25, 0.25]\n";
    let shaded = setup.shaded();
    assert_eq!(shaded.radiance[0], [0.125; 3]);
    assert_eq!((shaded.notes.lights_at_surface, shaded.notes.non_finite), (1, 0));
}

#[test]
fn s06_attenuation_at_the_ends_of_its_range() {
    for (c, r, right) in [
        // r² leaves f32 in both.
        (1e38, 1e-23, 1e8),
        (1e-38, 2e19, 0.25),
        // The same for f64.
        (1e300, 1e-200, 1e100),
        (1e-300, 2e190, 2.5e-81),
    ] {
        let value = Setup::plate(UP).lit(&point([0.0, 0.0, r], [0.0, 0.0, c])).value();
        assert_near(value, right, TOLERANCE);
    }
}

#[test]
fn s07_every_distance_has_its_direction() {
    for length in [5e19, 5e-22, 5e-23, 5e-24, 5e150, 5e-150, 5e-300] {
        // d = length·(0.6, 0, 0.8), seen by two normals.
        let position = [0.6 * length, 0.0, 0.8 * length];
        let cosine = |normal| Setup::plate(normal).lit(&point(position, [1.0, 0.0, 0.0])).value();
        assert_near(cosine(UP), 0.8, TOLERANCE);
        assert_near(cosine([1.0, 0.0, 0.0]), 0.6, TOLERANCE);
    }
}

#[test]
fn s08_tiny_cones_have_their_own_size() {
    // Cosines in f32 make one cone of 0.01399° of 0.001°, 0.005° and 0.01°, and 0.0242° of 0.02°.
    for cutoff in [1e-6, 0.001, 0.005, 0.01, 0.02, 30.0, 90.0, 120.0, 179.0] {
        let at = |angle: f64| Setup::plate(UP).lit(&spot(angle, cutoff, 0.0)).value();
        // The rim to six digits, as the chord form has them in f32 already.
        assert_eq!((at(cutoff * (1.0 - 1e-6)), at(cutoff * (1.0 + 1e-6))), (1.0, 0.0), "{cutoff}");
    }
}

#[test]
fn s09_the_falloff_ends_behind_the_light() {
    // L·S = ∓0.1 under a cutoff of 120° and e = 2.5: the power of −0.1 is NaN.
    let angle = 0.1_f64.acos().to_degrees();
    let at = |angle: f64| Setup::plate(UP).lit(&spot(angle, 120.0, 2.5)).value();
    assert_eq!(at(180.0 - angle), 0.0);
    // 0.1^2.5; the angle in degrees and back costs 1e-16/0.1.
    assert_near(at(angle), 0.003_162_277_660_168_379, TOLERANCE);
    // e ≫ 1 as in S01.
    let sharp = Setup::plate(UP).lit(&spot(1e-4_f64.to_degrees(), 1.0, 1e8)).value();
    assert_near(sharp, 0.606_530_659_207_191_2, TOLERANCE);
}

#[test]
fn s23_intensities_beyond_f32_are_finite_and_reported() {
    // I = 1e30, 1/r² = 1e10, kd = 0.5.
    let light = point([0.0, 0.0, 1e-5], [0.0, 0.0, 1.0]).replace("[1, 1, 1]", "[1e30, 1e20, 0]");
    let mut setup = Setup::plate(UP).lit(&light);
    setup.material = "kd = [0.5, 0.5, 0.5]\n".to_owned();
    let shaded = setup.shaded();
    assert_near(shaded.radiance[0][0], 5e39, TOLERANCE);
    assert_near(shaded.radiance[0][1], 5e29, TOLERANCE);
    assert_eq!((shaded.radiance[0][2], shaded.notes.non_finite), (0.0, 0));
    // The film holds f32: infinite, counted, and refused by PNG.
    let film = render(&setup.scene(), &RenderOptions::default(), &Unwatched).film;
    assert_eq!(film.infinite_pixels(), 1);
    let refused = encode_png(&film);
    assert!(matches!(refused, Err(FilmError::NotFinite { plane: "R", x: 0, y: 0, .. })));
    setup.lights = setup.lights.replace("1e30", "1e28");
    let film = render(&setup.scene(), &RenderOptions::default(), &Unwatched).film;
    assert_eq!(film.infinite_pixels(), 0);
}

#[test]
fn s25_one_light_on_the_axis_is_the_cosine() {
    for degrees in [0.0, 1e-6, 10.0, 45.0, 60.0, 80.0, 89.0, 89.999] {
        let angle = f64::to_radians(degrees);
        let value =
            Setup::plate(tilted(angle)).lit(&point([0.0, 0.0, 5.0], [1.0, 0.0, 0.0])).value();
        assert!((value - angle.cos()).abs() <= 1e-12, "{degrees}: {value}");
    }
}

#[test]
fn s26_light_falls_with_distance_angle_and_exponent() {
    let falls = |values: Vec<f64>| {
        assert!(values.windows(2).all(|pair| pair[1] < pair[0]), "{values:?}");
        assert!(values.iter().all(|value| *value > 0.0), "{values:?}");
    };
    let over = |r: f64| Setup::plate(UP).lit(&point([0.0, 0.0, r], [1.0, 0.1, 0.01])).value();
    falls([1e-3, 0.5, 1.0, 2.0, 10.0, 1e3, 1e10, 1e100].map(over).to_vec());
    let beside = |angle: f64| Setup::plate(UP).lit(&spot(angle, 90.0, 3.0)).value();
    falls([0.0, 1e-5, 0.1, 10.0, 45.0, 80.0, 89.9].map(beside).to_vec());
    let lobe = |ns: f64| Setup::plate(tilted(0.1)).glossy(ns).lit(&directional(UP)).value();
    falls([0.0, 1e-6, 0.5, 1.0, 10.0, 100.0, 1e4].map(lobe).to_vec());
}
