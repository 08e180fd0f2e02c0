//! The lighting models of the texts, row by row: A01–A10 reflection here, A11–A16 lights in
//! `lights`, what must not change a bit in `neutrality`, extremes in `extremes`.

mod extremes;
mod lights;
mod neutrality;
mod stage;

use stage::{
    V3, ambient, bits, colors, directional, dot, floor, look, octahedron, picture, pixel_at, point,
    radiance_at, smooth_octahedron, spot, unit, white,
};
use truecast::mesh::Barycentric;
use truecast::scene::light::Light;
use truecast::scene::material::Material;
use truecast::shade::blinn_phong::{blinn_specular, halfway};
use truecast::shade::reflection::{brdf, phong_specular, reflect};
use truecast::shade::{self, Effects, SurfacePoint};

/// One unit in the last place of 1.
const ULP: f64 = f64::EPSILON;

const NORTH: V3 = [0.0, 0.0, 1.0];

fn matte(kd: V3) -> Material {
    Material { ka: [0.0; 3], kd, ..Material::default_named("matte") }
}

fn shiny(kd: V3, ks: V3, ns: f64) -> Material {
    Material { ks, ns, ..matte(kd) }
}

/// A point at the origin with the given normal, seen from the given side.
fn surface(normal: V3, to_eye: V3) -> SurfacePoint {
    SurfacePoint {
        position: [0.0; 3],
        to_eye,
        face_normal: normal,
        shading_normal: normal,
        uv: None,
        barycentric: Barycentric([1.0, 0.0, 0.0]),
    }
}

/// The radiance at the origin under one directional light from `to_light`, all colours white.
fn lit(normal: V3, to_light: V3, to_eye: V3, material: &Material) -> f64 {
    let mut scene = floor();
    scene.lights = vec![directional(to_light.map(|c| -c), white())];
    shade::shade_point(&scene, &surface(normal, to_eye), material)[0]
}

/// A direction in the plane y = 0, `degrees` away from north.
fn tilted(degrees: f64) -> V3 {
    let angle = degrees.to_radians();
    [angle.sin(), 0.0, angle.cos()]
}

#[test]
fn a01_iteration_zero_is_the_emission_and_nothing_else() {
    let mut scene = octahedron();
    let ke = [0.1, 0.7, 1e30];
    scene.materials[0] = Material { ke, ..matte([0.0; 3]) };
    scene.background = [0.25; 3];
    // No light at all, then lights of every kind whose colours meet no coefficient.
    let idle = [
        ambient([1.0; 3]),
        directional([0.0, 0.0, -1.0], white()),
        point([0.0, 0.0, 9.0], [0.0, 0.0, 1.0], white()),
        Light::Spot(spot([0.0, 0.0, 9.0], [0.0, 0.0, -1.0], 30.0, 4.0)),
    ];
    for lights in [&idle[..0], &idle[..]] {
        scene.lights = lights.to_vec();
        let buffer = look(&scene);
        for (visible, radiance) in buffer.visible.iter().zip(picture(&scene)) {
            assert_eq!(radiance, if visible.is_some() { ke } else { [0.25; 3] });
        }
        assert!(buffer.covered_pixels() > 50);
        // No light was evaluated, even with every effect forced on.
        let counts = shade::count_evaluations(&scene, &buffer, Effects::of(&scene));
        assert_eq!(counts.evaluated(), Effects::EMISSION);
        let forced = shade::count_evaluations(&scene, &buffer, Effects::ALL);
        assert!(Effects::EMISSION.with(Effects::AMBIENT).contains(forced.evaluated()));
    }
}

#[test]
fn a02_iteration_one_is_one_colour_per_material() {
    let mut scene = octahedron();
    let second = Material { ka: [0.3, 0.1, 0.9], ke: [0.0, 0.5, 0.0], ..matte([0.4; 3]) };
    scene.materials.push(second);
    scene.triangle_materials = vec![0, 1, 0, 1, 0, 0, 0, 0];
    let light = [0.2, 0.4, 1.1];
    scene.lights = vec![ambient(light)];
    let buffer = look(&scene);
    let mut pixels_of = [0, 0];
    for (visible, radiance) in buffer.visible.iter().zip(picture(&scene)) {
        let Some(visible) = visible else { continue };
        let (index, material) = scene.material_of(visible.triangle);
        let expected: V3 = std::array::from_fn(|c| material.ke[c] + material.ka[c] * light[c]);
        assert_eq!(radiance.map(f64::to_bits), expected.map(f64::to_bits));
        pixels_of[index] += 1;
    }
    assert!(pixels_of.iter().all(|&count| count > 20), "{pixels_of:?}");
    let counts = shade::count_evaluations(&scene, &buffer, Effects::of(&scene));
    assert_eq!(counts.evaluated(), Effects::EMISSION.with(Effects::AMBIENT));
}

#[test]
fn a03_channels_never_meet() {
    let scene = neutrality::busy_scene();
    let mut permuted = scene.clone();
    let turn = |color: &mut V3| color.rotate_left(1);
    turn(&mut permuted.background);
    for material in &mut permuted.materials {
        [&mut material.ka, &mut material.kd, &mut material.ks, &mut material.ke]
            .into_iter()
            .for_each(turn);
    }
    for light in &mut permuted.lights {
        let colors = match light {
            Light::Ambient(light) => {
                turn(&mut light.ambient);
                continue;
            }
            Light::Directional(light) => &mut light.colors,
            Light::Point(light) => &mut light.colors,
            Light::Spot(light) => &mut light.colors,
        };
        [&mut colors.ambient, &mut colors.diffuse, &mut colors.specular].into_iter().for_each(turn);
    }
    let mut expected = picture(&scene);
    assert!(expected.iter().any(|[r, g, b]| r != g && g != b), "three different channels");
    expected.iter_mut().for_each(turn);
    assert_eq!(bits(&picture(&permuted)), bits(&expected));
}

#[test]
fn a04_iteration_two_is_the_cosine() {
    // Whole-numbered planes: the normal of (a, 0, c) with a² + c² = h² has the cosine c/h.
    for (a, c, h) in [(0.0, 1.0, 1.0), (3.0, 4.0, 5.0), (20.0, 21.0, 29.0), (63.0, 16.0, 65.0)] {
        for turn in [1.0_f64, -1.0] {
            let mut scene = floor();
            let (u, v) = ([c as f32, 0.0, (-a * turn) as f32], [0.0, 1.0_f32, 0.0]);
            let corner = |p: f32, q: f32| std::array::from_fn(|k| p * u[k] + q * v[k]);
            scene.mesh.positions =
                vec![corner(-1.0, -h as f32), corner(1.0, -h as f32), corner(0.0, h as f32)];
            scene.mesh.corners = vec![[0, 1, 2]];
            scene.objects[0].triangles = 0..1;
            scene.triangle_materials = vec![0];
            scene.materials[0] = matte([1.0; 3]);
            scene.lights = vec![directional([0.0, 0.0, -1.0], white())];
            let value = radiance_at(&scene, 0, 0)[0];
            assert!((value - c / h).abs() <= ULP, "{a} {c}: {value}");
        }
    }
    // 0 from 90° on, and independent of the eye to the bit.
    let material = matte([1.0; 3]);
    for degrees in [0.0, 10.0, 45.0, 89.0] {
        let reference = lit(tilted(degrees), NORTH, NORTH, &material);
        assert!((reference - degrees.to_radians().cos()).abs() <= ULP);
        for eye in [[1.0, 0.0, 0.0], [0.6, 0.8, 0.0], [0.0, 0.0, -1.0]] {
            assert_eq!(lit(tilted(degrees), NORTH, eye, &material).to_bits(), reference.to_bits());
        }
    }
    for normal in
        [[1.0, 0.0, 0.0], [-0.0, 1.0, -0.0], tilted(91.0), tilted(179.0), [0.0, 0.0, -1.0]]
    {
        assert_eq!(lit(normal, NORTH, NORTH, &material), 0.0);
    }
}

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
            assert!(dot(l, stage::cross(n, r)).abs() <= bound);
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

/// (L, V, ns, N·L, (N·H)^ns) for N = (0, 0, 1), by 50-digit arithmetic.
const LOBES: [([i32; 3], [i32; 3], f64, f64, f64); 11] = [
    ([3, 4, 12], [-2, 3, 6], 0.0, 12.0 / 13.0, 1.0),
    ([3, 4, 12], [-2, 3, 6], 1.0, 12.0 / 13.0, 0.923_710_686_916_141_5),
    ([3, 4, 12], [-2, 3, 6], 27.9, 12.0 / 13.0, 0.109_258_067_327_869_76),
    ([3, 4, 12], [-2, 3, 6], 100.0, 12.0 / 13.0, 0.000_357_764_153_861_907_5),
    ([1, 2, 2], [-1, -2, 2], 1e6, 2.0 / 3.0, 1.0),
    ([4, 0, 3], [0, 0, 1], 1.0, 0.6, 0.894_427_190_999_915_9),
    ([4, 0, 3], [0, 0, 1], 27.9, 0.6, 0.044_473_910_580_295_056),
    ([4, 0, 3], [0, 0, 1], 1e6, 0.6, 0.0),
    ([12, 3, 4], [2, -6, 3], 27.9, 4.0 / 13.0, 9.940_116_780_399_044e-10),
    ([8, 4, 1], [7, 4, 4], 1.0, 1.0 / 9.0, 0.282_166_323_991_550_17),
    ([8, 4, 1], [7, 4, 4], 100.0, 1.0 / 9.0, 1.123_357_605_429_369e-55),
];

#[test]
fn a09_iteration_three_adds_the_highlight() {
    for (l, v, ns, cosine, lobe) in LOBES {
        let (l, v) = (unit(l.map(f64::from)), unit(v.map(f64::from)));
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
    let directions = LOBES.map(|(l, v, ..)| (unit(l.map(f64::from)), unit(v.map(f64::from))));
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

#[test]
fn corner_normals_that_cancel_give_way_to_the_face() {
    // C10: half of (1, 0, 0) and half of (−1, 0, 0).
    let mut scene = floor();
    scene.materials[0] = matte([1.0; 3]);
    scene.lights = vec![directional([0.0, 0.0, -1.0], white())];
    for tilt in [0.0, 1e-7] {
        scene.mesh.normals = vec![unit([1.0, 0.0, tilt]), unit([-1.0, 0.0, tilt]), NORTH];
        scene.mesh.corner_normals = vec![[0, 1, 2]; 2];
        let visible = stage::seen(0, [0.5, 0.5, 0.0]);
        let (point, notes) = shade::surface_point(&scene, pixel_at(0, 0), &visible);
        assert_eq!(point.shading_normal, NORTH, "{tilt:e}");
        assert_eq!(notes.cancelled_normals, 1);
        let (_, none) = shade::surface_point(&scene, pixel_at(0, 0), &stage::seen(0, [0.25; 3]));
        assert_eq!(none.cancelled_normals, 0);
    }
}

#[test]
fn double_sides_turn_the_normal_single_sides_do_not() {
    use truecast::scene::Sides;
    let mut scene = smooth_octahedron();
    for corners in &mut scene.mesh.corners {
        corners.swap(1, 2);
    }
    scene.mesh.corner_normals = scene.mesh.corners.clone();
    scene.mesh.normals.iter_mut().for_each(|n| *n = n.map(|c| -c));
    scene.lights = vec![directional([0.0, 0.0, -1.0], white())];
    scene.materials[0] = matte([1.0; 3]);
    let inside_out = radiance_at(&scene, 1, 1);
    scene.objects[0].sides = Sides::Double;
    let turned = radiance_at(&scene, 1, 1);
    let mut right = smooth_octahedron();
    right.lights = scene.lights.clone();
    right.materials = scene.materials.clone();
    assert_eq!(inside_out, [0.0; 3]);
    let expected = radiance_at(&right, 1, 1)[0];
    assert!(expected > 0.5 && (turned[0] - expected).abs() <= 4.0 * ULP);
    let visible = stage::look_at(&scene, pixel_at(1, 1)).unwrap();
    let (point, _) = shade::surface_point(&scene, pixel_at(1, 1), &visible);
    assert!(point.face_normal[2] < 0.0 && point.shading_normal[2] > 0.0, "N itself never turns");
}
