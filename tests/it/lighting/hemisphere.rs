//! Hemisphere lighting (CS315): the poles, the three curves of the text, and what Lambert's
//! brightness does that a hemisphere's does not.

use super::stage::{V3, floor, hemisphere, program_picture};
use super::{ULP, matte, surface, tilted};
use std::path::Path;
use truecast::scene::switches::{SwitchValue, Switches};
use truecast::scene::{Overrides, Scene};
use truecast::shade;

const UP: V3 = [0.0, 0.0, 1.0];

fn lit(curve: &'static str, normal: V3, top: V3, bottom: V3) -> V3 {
    let mut scene = floor();
    scene.switches = Switches::default().with("hemisphere", SwitchValue::Word(curve));
    scene.lights = vec![hemisphere(UP, top, bottom)];
    shade::shade_point(&scene, &surface(normal, UP), &matte([0.5, 1.0, 0.25]))
}

#[test]
fn a17_up_is_the_top_down_the_bottom_and_three_curves_lie_between() {
    let (top, bottom) = ([0.3, 0.7, 1.9], [0.2, 0.1, 0.6]);
    for curve in ["cosine", "sine", "linear"] {
        let times_kd = |color: V3| [0.5 * color[0], color[1], 0.25 * color[2]];
        assert_eq!(lit(curve, UP, top, bottom), times_kd(top), "{curve}");
        assert_eq!(lit(curve, UP.map(|c| -c), top, bottom), times_kd(bottom), "{curve}");
        // A black bottom and a white top show the curve itself.
        for degrees in [0.0_f64, 30.0, 45.0, 60.0, 90.0, 120.0, 135.0, 180.0] {
            let (sine, cosine) = degrees.to_radians().sin_cos();
            let formula = match curve {
                "cosine" => 0.5 + 0.5 * cosine,
                "linear" => 1.0 - degrees / 180.0,
                _ if degrees <= 90.0 => 1.0 - 0.5 * sine,
                _ => 0.5 * sine,
            };
            let a = lit(curve, tilted(degrees), [1.0; 3], [0.0; 3])[1];
            assert!((a - formula).abs() <= 2.0 * ULP, "{curve} {degrees}: {a} {formula}");
        }
    }
    // "Without too much error" is up to 0.2071, at 45° and 135°; the words' curve lies between.
    let largest = |one, other| {
        (0..=1800)
            .map(|tenths| {
                let normal = tilted(f64::from(tenths) / 10.0);
                let a = |curve| lit(curve, normal, [1.0; 3], [0.0; 3])[1];
                (a(one) - a(other)).abs()
            })
            .fold(0.0, f64::max)
    };
    assert!((largest("sine", "cosine") - (2.0_f64.sqrt() - 1.0) / 2.0).abs() <= 4.0 * ULP);
    // To a tenth of a degree, which moves the differences by less than 2e-6 at their largest.
    assert!((largest("sine", "linear") - 0.1053).abs() < 5e-5);
    assert!((largest("cosine", "linear") - 0.1053).abs() < 5e-5);
}

#[test]
fn a18_lambert_exceeds_white_where_a_hemisphere_does_not() {
    let load = |name: &str| {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(name);
        Scene::load(&path, &Overrides::default()).unwrap()
    };
    let (lambert, around) = (load("blow-out-lambert.toml"), load("blow-out-hemisphere.toml"));
    let largest = |scene: &Scene| {
        let background = scene.background;
        program_picture(scene)
            .iter()
            .filter(|rgb| **rgb != background)
            .fold([0.0_f64; 3], |most, rgb| std::array::from_fn(|k| most[k].max(rgb[k])))
    };
    assert!(largest(&lambert).iter().all(|&value| value > 1.0), "{:?}", largest(&lambert));
    let truecast::scene::light::Light::Hemisphere(light) = &around.lights[0] else {
        panic!("the scene's light is a hemisphere")
    };
    let kd = around.materials[0].kd;
    assert_eq!(kd, lambert.materials[0].kd, "one surface under two lights");
    for (k, value) in largest(&around).into_iter().enumerate() {
        let most = light.top[k].max(light.bottom[k]) * kd[k];
        assert!(value <= most && value > 0.9 * most && most <= 1.0, "{value} {most}");
    }
}
