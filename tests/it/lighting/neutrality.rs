//! What must not change a bit: the way a pixel is asked for, and the threads that shade it. Effects
//! that a scene does not call for are the subject of `called_for`, with these scenes and more.

use super::stage::{
    ambient, bits, colors, directional, floor, hemisphere, look, octahedron, point,
    smooth_octahedron, spot, white,
};
use super::{matte, shiny};
use truecast::scene::Scene;
use truecast::scene::light::Light;
use truecast::scene::material::Material;
use truecast::shade::{self, Effects};

/// Every effect at once, with three unequal colour channels everywhere.
pub(super) fn busy_scene() -> Scene {
    let mut scene = smooth_octahedron();
    scene.background = [0.01, 0.02, 0.03];
    scene.materials = vec![
        Material {
            ka: [0.3, 0.2, 0.1],
            ke: [0.05, 0.0, 0.01],
            ..shiny([0.7, 0.5, 0.2], [0.9, 0.8, 0.6], 27.9)
        },
        shiny([0.1, 0.5, 0.9], [0.2, 0.1, 0.3], 0.0),
    ];
    scene.triangle_materials = vec![0, 1, 0, 0, 0, 0, 0, 0];
    let uneven = colors([0.1, 0.0, 0.05], [0.9, 0.7, 0.4], [0.5, 0.6, 0.7]);
    let mut cone = spot([2.0, 5.0, 9.0], [-2.0, -5.0, -9.0], 25.0, 8.0);
    cone.attenuation = [1.0, 0.0, 0.02];
    cone.colors = uneven;
    scene.lights = vec![
        directional([1.0, -2.0, -3.0], uneven),
        ambient([0.2, 0.3, 0.4]),
        Light::Spot(cone),
        point([-6.0, 1.0, 7.0], [0.5, 0.1, 0.01], uneven),
        hemisphere([1.0, 3.0, 0.5], [0.2, 0.3, 0.6], [0.1, 0.05, 0.0]),
    ];
    scene
}

/// Scenes that call for few, other, or all effects, each by name.
pub(crate) fn scenes() -> Vec<(&'static str, Scene)> {
    let with = |mut scene: Scene, material: Material, lights: Vec<Light>| {
        scene.materials = vec![material];
        scene.lights = lights;
        scene
    };
    let sun = || directional([0.0, -1.0, -2.0], white());
    let plain = [1.0, 0.0, 0.0];
    let lamp = || point([1.0, 2.0, 9.0], plain, white());
    let disc = |cutoff, e| Light::Spot(spot([0.0, 1.0, 9.0], [0.0, 0.0, -1.0], cutoff, e));
    // Lights the half plane in front of it and a strip of the one behind, up to 120° from its aim.
    let sideways = spot([0.0, 0.0, 3.0], [1.0, 0.0, 0.0], 120.0, 0.0);
    let grey = || matte([0.5; 3]);
    let glossy = || shiny([0.5, 0.25, 0.0], [0.0, 0.5, 0.5], 50.0);
    let glow = || Material { ke: [0.5, -0.0, 0.25], ..matte([0.0; 3]) };
    vec![
        ("nothing", with(octahedron(), matte([0.0; 3]), vec![])),
        ("glow", with(octahedron(), glow(), vec![sun()])),
        ("sun on matte", with(octahedron(), grey(), vec![sun()])),
        ("sun on smooth gloss", with(smooth_octahedron(), glossy(), vec![sun()])),
        ("lamp on gloss", with(octahedron(), glossy(), vec![lamp()])),
        (
            "fading lamp",
            with(floor(), grey(), vec![point([1.0, 2.0, 3.0], [0.0, 1.0, 1.0], white())]),
        ),
        ("open spot", with(floor(), glossy(), vec![disc(180.0, 9.0)])),
        ("hard spot", with(floor(), glossy(), vec![disc(30.0, 0.0), lamp()])),
        (
            "sky",
            with(
                smooth_octahedron(),
                grey(),
                vec![hemisphere([0.0, 1.0, 0.0], [0.9, 0.8, 0.7], [0.0, 0.1, 0.2])],
            ),
        ),
        ("wide hard spot", with(floor(), grey(), vec![Light::Spot(sideways)])),
        ("everything", busy_scene()),
    ]
}

#[test]
fn callers_are_named() {
    let calls = shade::explain(&busy_scene());
    assert_eq!(calls.len(), Effects::NAMED.len());
    let off: Vec<_> = calls.iter().filter(|call| !call.on).map(|call| call.effect).collect();
    assert_eq!(off, ["shadows", "textures", "opacity", "supersampling"]);
    let called_by = |effect: &str| {
        let call = calls.iter().find(|call| call.effect == effect).unwrap();
        call.called_by.join(", ")
    };
    assert_eq!(called_by("spot"), "light[2] (spot)");
    assert_eq!(called_by("attenuation"), "light[2] (spot), light[3] (point)");
    assert_eq!(called_by("interpolated normals"), "mesh[0] \"triangles\"");
    assert_eq!(called_by("emission"), "material \"matte\"");
    for (name, scene) in scenes() {
        let on = shade::explain(&scene).into_iter().filter(|call| call.on);
        let on: Vec<_> = on.map(|call| call.effect).collect();
        assert_eq!(on, Effects::of(&scene).names().collect::<Vec<_>>(), "{name}");
    }
    // A material that no triangle wears calls for nothing.
    let mut idle = octahedron();
    idle.materials.push(Material { ke: [1.0; 3], ..matte([1.0; 3]) });
    assert_eq!(Effects::of(&idle), Effects::NONE);
}

#[test]
fn terms_and_single_points_sum_to_the_pixel() {
    for (name, scene) in scenes() {
        let buffer = look(&scene);
        let shaded = shade::shade(&scene, &buffer, Effects::of(&scene), &|| ());
        for (index, pixel) in buffer.window.pixels().enumerate() {
            let Some(visible) = buffer.at(pixel) else { continue };
            let terms = shade::terms(&scene, pixel, visible, None);
            assert_eq!(bits(&[terms.sum()]), bits(&shaded.radiance[index..=index]), "{name}");
            let (_, material) = scene.material_of(visible.triangle);
            let alone = shade::shade_point(&scene, &terms.surface, material);
            assert_eq!(bits(&[alone]), bits(&shaded.radiance[index..=index]), "{name}");
            assert_eq!(terms.lights.len(), scene.lights.len());
        }
    }
}

#[test]
fn a_crop_is_a_part_of_the_picture() {
    use truecast::pixel::Window;
    let scene = busy_scene();
    let whole = look(&scene);
    let shaded = shade::shade(&scene, &whole, Effects::ALL, &|| ());
    let mut part = whole.clone();
    part.window = Window::new(scene.camera.resolution(), 3, 5, 12, 9).unwrap();
    part.visible = part.window.pixels().map(|pixel| whole.at(pixel).copied()).collect();
    let rows = std::sync::atomic::AtomicU32::new(0);
    let count = || {
        rows.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
    };
    let crop = shade::shade(&scene, &part, Effects::ALL, &count);
    assert_eq!(rows.into_inner(), 4);
    for (index, pixel) in part.window.pixels().enumerate() {
        assert_eq!(crop.radiance[index], shaded.radiance[whole.window.index(pixel)]);
    }
}
