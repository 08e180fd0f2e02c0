//! Hemisphere lights: S15, S16, S31.

use super::*;

/// a for a normal, under a light whose top is +y.
fn top_share(curve: &str, normal: V3) -> f64 {
    let light = "type = \"hemisphere\"\ndirection = [0, 1, 0]\ntop = [1, 1, 1]\n\
                 bottom = [0, 0, 0]\n";
    Setup::plate(normal).lit(light).switched(&format!("hemisphere = \"{curve}\"")).value()
}

/// A normal at an angle from +y, degrees.
fn from_top(degrees: f64) -> V3 {
    let angle = degrees.to_radians();
    [angle.sin(), angle.cos(), 0.0]
}

#[test]
fn s15_the_sine_form_keeps_its_digits_at_the_pole() {
    // 1 − ½|N × up| to 50 digits. √(1 − cos²) is NaN for the first in f32, and 0 for the others.
    for (normal, right) in [
        ([0.0, 1.000_000_1, 0.0], 1.0),
        ([1e-4, 1.0, 2e-4], 0.999_888_196_603_920_1),
        ([3e-4, 1.0, 0.0], 0.999_850_000_006_75),
    ] {
        assert_near(top_share("sine", normal), right, 1e-15);
    }
}

#[test]
fn s16_the_three_curves_differ_as_they_do_on_paper() {
    // (√2 − 1)/2 at 45° and 135°; the linear curve is half way between the two there.
    let most = 0.207_106_781_186_547_5;
    for (degrees, sign) in [(45.0, 1.0), (135.0, -1.0)] {
        let [cosine, sine, linear] =
            ["cosine", "sine", "linear"].map(|curve| top_share(curve, from_top(degrees)));
        assert_near(sign * (cosine - sine), most, TOLERANCE);
        assert_near(sign * (cosine - linear), most / 2.0, TOLERANCE);
        assert_near(sign * (linear - sine), most / 2.0, TOLERANCE);
    }
    // Nowhere more, and the order never changes within a half.
    for step in 0..=36 {
        let degrees = f64::from(step) * 5.0;
        let [cosine, sine, linear] =
            ["cosine", "sine", "linear"].map(|curve| top_share(curve, from_top(degrees)));
        let sign = if degrees <= 90.0 { 1.0 } else { -1.0 };
        assert!(sign * (cosine - sine) <= most + 1e-15, "{degrees}");
        // A few roundings of 1.
        let is_between = sign * (cosine - linear) >= -1e-15 && sign * (linear - sine) >= -1e-15;
        assert!(is_between, "{degrees}: {cosine} {linear} {sine}");
    }
}

#[test]
fn s31_top_side_and_bottom_are_exact() {
    for curve in ["cosine", "sine", "linear"] {
        assert_eq!(top_share(curve, [0.0, 1.0, 0.0]), 1.0, "{curve}");
        assert_eq!(top_share(curve, [1.0, 0.0, 0.0]), 0.5, "{curve}");
        assert_eq!(top_share(curve, [0.0, -1.0, 0.0]), 0.0, "{curve}");
    }
}
