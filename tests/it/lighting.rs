//! The systems of the texts, row by row: A01–A04 here, A05–A10 in `reflection`, A11–A16 in
//! `lights`, A17–A18 in `hemisphere`, A20–A35 in `surfaces`, A40–A56 in `shading`, `perspective`,
//! `tessellation` and `pipelines`, A60–A65 in `shaders`; which are tests at all in `names`. Every
//! switch by what it changes in `switches`; what must not change a bit in `neutrality`, ends of
//! ranges in `extremes`.

mod extremes;
mod hemisphere;
mod lanes;
mod lights;
mod names;
pub(crate) mod neutrality;
mod normals;
mod perspective;
mod pipelines;
mod reflection;
mod shaders;
mod shading;
mod single;
mod stage;
mod surfaces;
mod switches;
mod tessellation;

use stage::{
    V3, ambient, bits, directional, floor, look, octahedron, picture, point, radiance_at, spot,
    white,
};
use truecast::mesh::Barycentric;
use truecast::scene::light::Light;
use truecast::scene::material::Material;
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
            Light::Hemisphere(light) => {
                [&mut light.top, &mut light.bottom].into_iter().for_each(turn);
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
