//! Lobes and their gate: S01 to S04, S17, S21, S28.

use super::*;

#[test]
fn s01_sharp_lobes_keep_their_digits() {
    // cos^ns θ to 50 digits. In f32, N·H rounds to 1 and the values are 1, 0.3036 and 0.6207.
    for (theta, ns, right) in [
        (1e-4, 1e8, 0.606_530_659_207_191_2),
        (3e-4, 1e7, 0.637_628_147_317_783_2),
        (1e-3, 1e6, 0.606_530_609_168_400_4),
        (1e-7, 1e14, 0.606_530_659_712_632_9),
    ] {
        // L = V = H = z, and N tilted by θ.
        let value = Setup::plate(tilted(theta)).glossy(ns).lit(&directional(UP)).value();
        assert_near(value, right, TOLERANCE);
    }
}

#[test]
fn s02_no_highlight_exceeds_one() {
    // An f32 unit vector with n·n = 1.0000002, and its 1e8th power 2.26e10.
    let f = f64::from(0.577_350_3_f32);
    assert!(3.0 * f * f > 1.000_000_1);
    for switches in ["", "renormalize = false"] {
        let setup = Setup::plate([f; 3]).glossy(1e8).lit(&directional([f; 3])).switched(switches);
        let value = setup.seen(view_from([1.0; 3])).value();
        assert!(value <= 1.0, "{value}");
        assert_near(value, 1.0, TOLERANCE);
    }
}

#[test]
fn s03_zero_to_the_power_of_zero_is_one_behind_the_gate_and_nothing_before_it() {
    let seen_from = |to_eye: V3, to_light: V3, ns: f64| {
        let setup = Setup::plate(UP).glossy(ns).lit(&directional(to_light));
        setup.seen(view_from(to_eye)).value()
    };
    // H = (1, 0, 0), N·H = 0, N·L = 0.8: 0^0 = 1, 0^2.5 = 0.
    let (behind, light) = ([0.6, 0.0, -0.8], [0.6, 0.0, 0.8]);
    assert_eq!(seen_from(behind, light, 0.0), 1.0);
    assert!(seen_from(behind, light, 2.5) < 1e-30);
    // L + V = (1.4, 0, −0.2), N·H < 0: the power is NaN, the term 0.
    let light = [0.8, 0.0, 0.6];
    assert_eq!(seen_from(behind, light, 2.5), 0.0);
    assert_eq!(seen_from(behind, light, 0.0), 1.0);
    // N·L ≤ 0: nothing at all, also of exponent 0.
    for light in [[0.8, 0.0, -0.6], [1.0, 0.0, 0.0], [1.0, 0.0, -0.0]] {
        assert_eq!(seen_from(UP, light, 0.0), 0.0);
    }
    // Spotlights alike: L·S = 0 to the power of e.
    for (exponent, right) in [(0.0, 1.0), (2.5, 0.0)] {
        let spot = format!(
            "type = \"spot\"\nposition = [0, 0, 2]\naim = [1, 0, 0]\ncutoff_deg = 120\n\
             exponent = {exponent:?}\nintensity = [1, 1, 1]\n"
        );
        assert_eq!(Setup::plate(UP).lit(&spot).value(), right);
    }
}

#[test]
fn s04_halfway_of_nearly_opposite_directions() {
    // l = (3, 4 + 5ε, 0.1), v = −(3, 4, 0.1). N lies 45° from H, so that N·H moves with H at first
    // order; the right values are N·(l + v)/|l + v| of unit l, v to 50 digits.
    let normal = [-0.588_815_518_717_029_9, 0.424_414_831_056_210_64, 0.687_872_325_262_469_8];
    for (epsilon, right) in [
        (1e-6, 0.707_106_781_186_515_7),
        (1e-7, 0.707_106_781_186_547_2),
        (1e-8, std::f64::consts::FRAC_1_SQRT_2),
    ] {
        let setup = Setup::plate(normal)
            .glossy(1.0)
            .lit(&directional([3.0, 4.0 + 5.0 * epsilon, 0.1]))
            .seen(view([-3.0, -4.0, -0.1], [3.0, 4.0, 0.1]));
        // Unit vectors round by 2^-53 per component, over |L + V| = 0.6ε. f32 is off by 0.1° at
        // 1e-6 and by 8° at 1e-7.
        assert_near(setup.value(), right, 4e-15 / epsilon);
    }
    // Exactly opposite: no limit exists, and no highlight. Seen from behind, so that N·L = 1.
    let setup = Setup::plate(UP).glossy(10.0).lit(&directional(UP));
    let shaded = setup.seen(view_from([0.0, 0.0, -1.0])).shaded();
    assert_eq!((shaded.radiance[0], shaded.notes.opposite_view), ([0.0; 3], 1));
}

#[test]
fn s17_the_older_lobe_keeps_its_digits_too() {
    let phong = |normal, to_light, to_eye, ns| {
        let setup = Setup::plate(normal).glossy(ns).switched("specular = \"phong\"");
        setup.lit(&directional(to_light)).seen(view_from(to_eye)).value()
    };
    // N tilted by θ/2 turns R by θ away from V = L; the values of S01.
    assert_near(phong(tilted(5e-5), UP, UP, 1e8), 0.606_530_659_207_191_2, TOLERANCE);
    assert_near(phong(tilted(5e-4), UP, UP, 1e6), 0.606_530_609_168_400_4, TOLERANCE);
    // Grazing, V = R: R = 2(N·L)N − L cancels to 1e-9, and no power exceeds 1.
    let value = phong(UP, [1.0, 0.0, 1e-9], [-1.0, 0.0, 1e-9], 1e6);
    assert!(value <= 1.0);
    assert_near(value, 1.0, TOLERANCE);
    // A tilt δ of N is an angle δ for H and 2δ for R: cos(2δ) = cos⁴δ to δ⁴·(4/3 − 1/3)/2, so
    // that Blinn's lobe at 4·ns is Phong's at ns.
    let (delta, ns) = (1e-3, 1e4);
    let blinn = Setup::plate(tilted(delta)).glossy(4.0 * ns).lit(&directional(UP)).value();
    assert_near(phong(tilted(delta), UP, UP, ns), blinn, 2.0 * ns * delta.powi(4));
}

#[test]
fn s21_the_terminator_is_gated_by_the_sign_of_one_cosine() {
    // ns = 0: the specular part jumps by its whole height where N·L changes its sign.
    let at = |z: f64| {
        let setup = Setup::plate(UP).glossy(0.0).lit(&directional([1.0, 0.0, z]));
        let shaded = setup.shaded();
        (shaded.radiance[0][0], shaded.notes.near_terminator)
    };
    for z in [1e-7, 1e-12, 1.1e-13] {
        assert_eq!((at(z), at(-z)), ((1.0, 0), (0.0, 0)), "{z:e}");
    }
    // In doubt below 1e-13, and counted; each side is still its sign's.
    for z in [0.9e-13, 1e-20, 5e-324] {
        assert_eq!((at(z), at(-z)), ((1.0, 1), (0.0, 1)), "{z:e}");
    }
    assert_eq!(at(0.0), (0.0, 1));
}

#[test]
fn s28_light_and_eye_may_be_swapped() {
    // Unit vectors a = (3, 4, 12)/13 and b = (2, −1, 2)/3 with a·b = 2/3: |a + b|² = 10/3 and
    // N·H = (12/13 + 2/3)/√(10/3).
    let (a, b) = ([3.0, 4.0, 12.0], [2.0, -1.0, 2.0]);
    let value = |to_light: V3, to_eye: V3| {
        Setup::plate(UP).glossy(37.0).lit(&directional(to_light)).seen(view_from(to_eye)).value()
    };
    let cosine: f64 = 62.0 / 39.0 / (10.0_f64 / 3.0).sqrt();
    assert_near(value(a, b), cosine.powi(37), TOLERANCE);
    // 37 times the rounding of H's four sums.
    assert_near(value(a, b), value(b, a), 37.0 * 4.0 * f64::EPSILON);
}
