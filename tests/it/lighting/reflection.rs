//! A05–A10: mirror, lobes and the BRDF form.

use super::stage::{V3, colors, cross, directional, dot, floor, unit};
use super::{NORTH, ULP, lit, shiny, surface, tilted};
use truecast::scene::material::Material;
use truecast::shade;
use truecast::shade::blinn_phong::{blinn_specular, halfway};
use truecast::shade::reflection::{brdf, phong_specular, reflect};

#[test]
fn a05_the_mirror_direction_lies_opposite_in_the_same_plane() {
    let steps = [-2.0, -1.0, 0.0, 1.0, 3.0];
    let directions: Vec<V3> = (0..125)
        .map(|i| [steps[i % 5], steps[i / 5 % 5], steps[i / 25]])
        .filter(|v| *v != [0.0; 3])
        .map(unit)
        .collect();
    for &l in &directions {
        for &n in &directions {
            let r = reflect(l, n);
            // Each of the three is a handful of f64 operations on numbers of at most 2.
            let bound = 8.0 * ULP;
            assert!((dot(r, r).sqrt() - 1.0).abs() <= bound);
            assert!((dot(r, n) - dot(l, n)).abs() <= bound);
            assert!(dot(l, cross(n, r)).abs() <= bound);
            // Shading languages define reflect(i, n) = i − 2(n·i)n for the incoming i = −l.
            let incoming = l.map(|c| -c);
            let theirs: V3 = std::array::from_fn(|k| incoming[k] - 2.0 * dot(n, incoming) * n[k]);
            assert!((0..3).all(|k| (theirs[k] - r[k]).abs() <= bound));
        }
    }
}

#[test]
fn a06_the_lobe_tends_to_the_perfect_mirror() {
    let eye = tilted(-40.0);
    let (mut last_width, mut last_energy) = (f64::INFINITY, f64::INFINITY);
    for ns in [1.0, 10.0, 1e2, 1e4, 1e6, 1e8, f64::MAX] {
        let material = shiny([0.0; 3], [1.0; 3], ns);
        // In the mirror direction the whole light arrives, at any exponent: 1 − q·ns with the
        // half degree of freedom that rounding leaves to N·H.
        let peak = lit(NORTH, tilted(40.0), eye, &material);
        assert!(peak <= 1.0 && peak >= (-ns * 1e-31).exp() * (1.0 - 1e-12), "{ns:e}: {peak}");
        // Off the mirror direction less and less does.
        let values: Vec<f64> =
            (0..900).map(|i| lit(NORTH, tilted(f64::from(i) * 0.1), eye, &material)).collect();
        assert!(values.iter().all(|value| value.is_finite() && (0.0..=1.0).contains(value)));
        let width = values.iter().filter(|value| **value >= 0.5).count() as f64;
        let energy: f64 = values.iter().sum();
        assert!(width <= last_width && energy < last_energy, "{ns:e}: {width} {energy}");
        (last_width, last_energy) = (width, energy);
    }
    assert!(last_width <= 1.0);
}

#[test]
fn a07_phong_looks_at_the_mirror_direction() {
    // Light 60° from the normal, the mirror direction −60°.
    let l = tilted(60.0);
    for ns in [1.0, 10.0, 100.0] {
        assert!((phong_specular(NORTH, l, tilted(-60.0), ns) - 1.0).abs() < 1e-12);
        for degrees in [31.0_f64, 60.0, 89.0] {
            assert_eq!(phong_specular(NORTH, l, tilted(degrees), ns), 0.0, "beyond 90° from R");
        }
    }
    // At shininess 1 the Phong highlight ends at 90° from R; Blinn-Phong is visible well past it.
    assert!(phong_specular(NORTH, l, tilted(29.0), 1.0) > 0.0);
    assert!(blinn_specular(NORTH, l, tilted(60.0), 1.0) > 0.4);
    // (R·V)^ns itself.
    let value = phong_specular(NORTH, l, tilted(-40.0), 5.0);
    assert!((value - 20.0_f64.to_radians().cos().powi(5)).abs() < 1e-14);
}

#[test]
fn a08_blinn_phong_uses_the_halfway_vector() {
    for (light, eye) in [(60.0, -40.0), (10.0, 30.0), (85.0, 80.0), (-5.0, 70.0_f64)] {
        let (l, v) = (tilted(light), tilted(eye));
        let h = halfway(l, v).unwrap();
        assert!((dot(h, h) - 1.0).abs() <= 4.0 * ULP, "H is always made unit");
        // Coplanar: the angle from N to H is half the angle from R to V.
        let psi = dot(NORTH, h).clamp(-1.0, 1.0).acos();
        let phi = dot(reflect(l, NORTH), v).clamp(-1.0, 1.0).acos();
        assert!((psi - phi / 2.0).abs() < 1e-7, "{light} {eye}");
        for ns in [1.0, 10.0, 100.0] {
            let (blinn, phong) = (blinn_specular(NORTH, l, v, ns), phong_specular(NORTH, l, v, ns));
            assert!(blinn > phong, "wider at equal exponent: {light} {eye} {ns}");
        }
    }
    // The picture's term is that lobe.
    let material = shiny([0.0; 3], [1.0; 3], 10.0);
    let (l, v) = (tilted(60.0), tilted(60.0));
    assert_eq!(lit(NORTH, unit(l), v, &material), blinn_specular(NORTH, unit(unit(l)), v, 10.0));
}

/// A lobe for N = (0, 0, 1), by 50-digit arithmetic.
struct Lobe {
    /// L and V, not unit.
    l: V3,
    v: V3,
    ns: f64,
    n_dot_l: f64,
    /// (N·H)^ns.
    value: f64,
}

const fn lobe(l: V3, v: V3, ns: f64, n_dot_l: f64, value: f64) -> Lobe {
    Lobe { l, v, ns, n_dot_l, value }
}

const LOBES: [Lobe; 11] = [
    lobe([3.0, 4.0, 12.0], [-2.0, 3.0, 6.0], 0.0, 12.0 / 13.0, 1.0),
    lobe([3.0, 4.0, 12.0], [-2.0, 3.0, 6.0], 1.0, 12.0 / 13.0, 0.923_710_686_916_141_5),
    lobe([3.0, 4.0, 12.0], [-2.0, 3.0, 6.0], 27.9, 12.0 / 13.0, 0.109_258_067_327_869_76),
    lobe([3.0, 4.0, 12.0], [-2.0, 3.0, 6.0], 100.0, 12.0 / 13.0, 0.000_357_764_153_861_907_5),
    lobe([1.0, 2.0, 2.0], [-1.0, -2.0, 2.0], 1e6, 2.0 / 3.0, 1.0),
    lobe([4.0, 0.0, 3.0], [0.0, 0.0, 1.0], 1.0, 0.6, 0.894_427_190_999_915_9),
    lobe([4.0, 0.0, 3.0], [0.0, 0.0, 1.0], 27.9, 0.6, 0.044_473_910_580_295_056),
    lobe([4.0, 0.0, 3.0], [0.0, 0.0, 1.0], 1e6, 0.6, 0.0),
    lobe([12.0, 3.0, 4.0], [2.0, -6.0, 3.0], 27.9, 4.0 / 13.0, 9.940_116_780_399_044e-10),
    lobe([8.0, 4.0, 1.0], [7.0, 4.0, 4.0], 1.0, 1.0 / 9.0, 0.282_166_323_991_550_17),
    lobe([8.0, 4.0, 1.0], [7.0, 4.0, 4.0], 100.0, 1.0 / 9.0, 1.123_357_605_429_369e-55),
];

#[test]
fn a09_iteration_three_adds_the_highlight() {
    for Lobe { l, v, ns, n_dot_l: cosine, value: lobe } in LOBES {
        let (l, v) = (unit(l), unit(v));
        let material = Material {
            ka: [0.25; 3],
            ke: [0.125; 3],
            ..shiny([0.5, 0.0, 0.5], [0.0, 0.75, 0.75], ns)
        };
        let mut scene = floor();
        let light = colors([0.5; 3], [2.0; 3], [3.0; 3]);
        scene.lights = vec![directional(l.map(|c| -c), light)];
        let [diffuse, specular, both] = shade::shade_point(&scene, &surface(NORTH, v), &material);
        let base = 0.125 + 0.25 * 0.5;
        // 1e-15 per unit of exponent: the lobe's relative error is ns times that of N·H.
        let error = (4.0 + ns) * 1e-15;
        assert!((diffuse - (base + 0.5 * 2.0 * cosine)).abs() <= 1e-15);
        assert!((specular - (base + 0.75 * 3.0 * lobe)).abs() <= 1e-15 + error * lobe, "{ns}");
        assert!((both - (diffuse + specular - base)).abs() <= 2e-15);
        // B gates both parts: the same light from below leaves emission and ambient.
        let below = directional([-l[0], -l[1], l[2]], light);
        scene.lights = vec![below];
        assert_eq!(shade::shade_point(&scene, &surface(NORTH, v), &material), [base; 3]);
    }
}

#[test]
fn a10_the_brdf_is_reciprocal() {
    let (kd, ks) = ([0.1, 0.2, 0.3], [0.9, 0.5, 0.0]);
    let directions = LOBES.map(|lobe| (unit(lobe.l), unit(lobe.v)));
    for (incoming, outgoing) in directions {
        for ns in [0.0, 1.0, 27.9, 1e6] {
            let there = brdf(kd, ks, ns, NORTH, incoming, outgoing);
            let back = brdf(kd, ks, ns, NORTH, outgoing, incoming);
            assert_eq!(there.map(f64::to_bits), back.map(f64::to_bits));
            // I·B·(N·L)·f_r weights both parts by N·L once.
            let cosine = dot(NORTH, incoming);
            let lobe = blinn_specular(NORTH, incoming, outgoing, ns);
            for channel in 0..3 {
                let apart = kd[channel] * cosine + ks[channel] * cosine * lobe;
                assert!((cosine * there[channel] - apart).abs() <= 2.0 * ULP);
            }
        }
    }
}
