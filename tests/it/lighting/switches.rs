//! Every switch changes exactly the pixels that the texts say, and nothing else: for each of the
//! twelve, scenes with the set of pixels that must change, and scenes where no bit may. Switches of
//! the equation here; those of normals, weights and where it is evaluated in `surfaces`.

mod surfaces;

use super::stage::{
    V3, ambient, answer, bits, colors, directional, dot, floor, octahedron, point, program_picture,
    smooth_octahedron, spot, unit, white,
};
use super::{matte, shiny};
use std::fs;
use std::path::Path;
use truecast::pixel::Pixel;
use truecast::render::VisibilityPath;
use truecast::scene::Scene;
use truecast::scene::light::Light;
use truecast::scene::material::Material;
use truecast::scene::switches::{SWITCHES, SwitchValue, Switches};
use truecast::shade;
use truecast::visibility::Visible;

const ON: SwitchValue = SwitchValue::Is(true);
const OFF: SwitchValue = SwitchValue::Is(false);

const fn word(word: &'static str) -> SwitchValue {
    SwitchValue::Word(word)
}

/// The scene with one switch of the default dialect set.
fn switched(scene: &Scene, name: &str, value: SwitchValue) -> Scene {
    let switches = Switches::default().with(name, value);
    assert_eq!(switches.get(name), Some(value), "{name} is a switch and knows the value");
    Scene { switches, ..scene.clone() }
}

/// Sets a switch; the pixels that change are those, by visible surface, that `expected` names.
#[track_caller]
fn assert_changes(
    scene: &Scene,
    name: &str,
    value: SwitchValue,
    expected: impl Fn(Pixel, &Visible) -> bool,
) {
    let set = switched(scene, name, value);
    assert_pictures_differ(scene, &set, expected);
}

#[track_caller]
fn assert_pictures_differ(scene: &Scene, set: &Scene, expected: impl Fn(Pixel, &Visible) -> bool) {
    let buffer = answer(scene, VisibilityPath::Cast);
    let (before, after) = (bits(&program_picture(scene)), bits(&program_picture(set)));
    let mut counts = [0, 0];
    for (index, visible) in buffer.visible.iter().enumerate() {
        let pixel = buffer.window.pixel(index);
        let must = visible.as_ref().is_some_and(|visible| expected(pixel, visible));
        assert_eq!(before[index] != after[index], must, "{pixel:?} {visible:?}");
        counts[usize::from(must)] += 1;
    }
    assert!(counts[0] > 0 && counts[1] > 0, "the scene has pixels of both kinds: {counts:?}");
}

#[track_caller]
fn assert_changes_nothing(scene: &Scene, name: &str, value: SwitchValue) {
    let after = program_picture(&switched(scene, name, value));
    let before = program_picture(scene);
    assert!(before.iter().any(|rgb| rgb.iter().any(|value| *value > 0.0)), "something is lit");
    assert_eq!(bits(&before), bits(&after), "{name} {value}");
}

/// The normal that shades a pixel.
fn normal(scene: &Scene, pixel: Pixel, visible: &Visible) -> V3 {
    shade::surface_point(scene, pixel, visible).0.shading_normal
}

/// An octahedron, smooth, of one material, under one light.
fn ball(material: Material, lights: Vec<Light>) -> Scene {
    let mut scene = smooth_octahedron();
    scene.materials = vec![material];
    scene.lights = lights;
    scene
}

fn sun() -> Light {
    directional([-3.0, 0.0, 1.0], white())
}

/// The way to [`sun`].
fn to_sun() -> V3 {
    unit([3.0, 0.0, -1.0])
}

/// Where a point is lit by [`sun`] and a gate at N·L decides.
fn is_lit(scene: &Scene, pixel: Pixel, visible: &Visible) -> bool {
    dot(normal(scene, pixel, visible), to_sun()) > 0.0
}

fn glossy() -> Material {
    shiny([0.5, 0.4, 0.3], [0.3, 0.4, 0.5], 2.0)
}

#[test]
fn backlit_specular_changes_only_what_is_turned_away() {
    let scene = ball(glossy(), vec![sun()]);
    assert_changes(&scene, "backlit_specular", word("none"), |pixel, visible| {
        let point = shade::surface_point(&scene, pixel, visible).0;
        let half: V3 = std::array::from_fn(|k| to_sun()[k] + point.to_eye[k]);
        !is_lit(&scene, pixel, visible) && dot(point.shading_normal, half) > 0.0
    });
    // `lt0` is about N·L = 0 alone: half a floor is lit exactly along its surface.
    assert_changes_nothing(&scene, "backlit_specular", word("lt0"));
    let mut scene = floor();
    scene.materials = vec![glossy(), matte([0.5; 3])];
    scene.triangle_materials = vec![0, 1];
    scene.lights = vec![directional([1.0, 0.0, 0.0], white()), sun(), ambient([0.1; 3])];
    scene.materials[1].ka = [0.5; 3];
    for value in ["lt0", "none"] {
        assert_changes(&scene, "backlit_specular", word(value), |_, visible| {
            visible.triangle.get() == 0
        });
    }
    // No highlight, no change; nor where everything faces the light.
    let value = |value| ("backlit_specular", word(value));
    let facing = directional([0.0, 0.0, -1.0], white());
    for (name, value) in [value("lt0"), value("none")] {
        assert_changes_nothing(&ball(matte([0.5; 3]), vec![sun()]), name, value);
        assert_changes_nothing(&ball(glossy(), vec![facing.clone()]), name, value);
    }
}

#[test]
fn attenuate_ambient_changes_only_ambient_parts_of_lights_that_fade() {
    let lamp = colors([0.3, 0.2, 0.1], [0.5; 3], [0.5; 3]);
    let mut cone = spot([0.0, 0.0, 8.0], [0.0, 0.0, -1.0], 20.0, 0.0);
    cone.colors = lamp;
    let mut scene = floor();
    scene.materials = vec![Material { ka: [0.5; 3], ..glossy() }];
    scene.lights = vec![Light::Spot(cone), ambient([0.1; 3]), directional([0.0, 0.3, -1.0], lamp)];
    // Inside the cone f is 1; outside it is 0, and with it the lamp's own ambient part.
    assert_changes(&scene, "attenuate_ambient", ON, |pixel, _| {
        let [x, y] = [pixel.x, pixel.y].map(|c| f64::from(c) - 8.0);
        x.hypot(y) > 8.0 * 20.0_f64.to_radians().tan()
    });
    // A lamp that fades with distance: only the material that reflects ambient light.
    scene.lights[0] = point([0.0, 0.0, 2.0], [1.0, 0.0, 0.1], lamp);
    scene.materials.push(Material { ka: [0.0; 3], ..glossy() });
    scene.triangle_materials = vec![0, 1];
    assert_changes(&scene, "attenuate_ambient", ON, |_, visible| visible.triangle.get() == 0);
    // Ambient light of the scene, and of lights that do not fade, stays.
    scene.lights[0] = point([0.0, 0.0, 2.0], [1.0, 0.0, 0.1], white());
    assert_changes_nothing(&scene, "attenuate_ambient", ON);
    scene.lights[0] = point([0.0, 0.0, 2.0], [1.0, 0.0, 0.0], lamp);
    assert_changes_nothing(&scene, "attenuate_ambient", ON);
}

#[test]
fn ka_changes_only_ambient_parts_of_materials_with_another_kd() {
    let mut scene = octahedron();
    scene.materials = vec![
        Material { ka: [0.5, 0.25, 0.1], ..matte([0.5, 0.25, 0.1]) },
        Material { ka: [0.5, 0.25, 0.1], ..matte([0.5, 0.25, 0.2]) },
    ];
    scene.triangle_materials = vec![0, 1, 0, 1, 0, 0, 0, 0];
    scene.lights = vec![ambient([0.2; 3]), sun()];
    assert_changes(&scene, "ka", word("kd"), |_, visible| {
        scene.material_of(visible.triangle).0 == 1
    });
    scene.lights.remove(0);
    assert_changes_nothing(&scene, "ka", word("kd"));
}

/// The floor's pixels by how a highlight that depends on the eye changes them: half of it is matte.
fn half_glossy_floor(ns: f64) -> Scene {
    let mut scene = floor();
    scene.materials = vec![shiny([0.5; 3], [0.5; 3], ns), matte([0.5; 3])];
    scene.triangle_materials = vec![0, 1];
    scene.lights = vec![directional([-3.0, 0.0, -4.0], white())];
    scene
}

fn is_glossy(visible: &Visible) -> bool {
    visible.triangle.get() == 0
}

#[test]
fn specular_changes_only_highlights() {
    // L = (0.6, 0, 0.8) meets the mirror direction at no pixel of whole numbers but x = 6, y = 0.
    let scene = half_glossy_floor(2.0);
    assert_changes(&scene, "specular", word("phong"), |pixel, visible| {
        is_glossy(visible) && (pixel.x, pixel.y) != (14, 8)
    });
    assert_changes_nothing(&half_glossy_floor(0.0), "specular", word("phong"));
    assert_changes_nothing(&ball(matte([0.5; 3]), vec![sun()]), "specular", word("phong"));
}

#[test]
fn specular_cosine_changes_only_highlights_of_slanted_light() {
    assert_changes(&half_glossy_floor(2.0), "specular_cosine", ON, |_, visible| is_glossy(visible));
    let mut upright = half_glossy_floor(2.0);
    upright.lights = vec![directional([0.0, 0.0, -1.0], white())];
    assert_changes_nothing(&upright, "specular_cosine", ON);
    assert_changes_nothing(&ball(matte([0.5; 3]), vec![sun()]), "specular_cosine", ON);
}

#[test]
fn viewer_changes_only_highlights_beside_the_axis() {
    // V is the axis at the middle pixel anyway, which lies on the diagonal of the floor.
    let mut scene = half_glossy_floor(2.0);
    scene.triangle_materials = vec![0, 0];
    assert_changes(&scene, "viewer", word("distant"), |pixel, _| (pixel.x, pixel.y) != (8, 8));
    assert_changes(&half_glossy_floor(2.0), "viewer", word("distant"), |pixel, visible| {
        is_glossy(visible) && (pixel.x, pixel.y) != (8, 8)
    });
    assert_changes_nothing(&half_glossy_floor(0.0), "viewer", word("distant"));
    assert_changes_nothing(&ball(matte([0.5; 3]), vec![sun()]), "viewer", word("distant"));
}

#[test]
fn no_switch_is_without_a_test() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/it/lighting");
    let source = ["switches.rs", "switches/surfaces.rs"]
        .map(|file| fs::read_to_string(folder.join(file)).unwrap())
        .concat();
    for switch in SWITCHES {
        assert!(source.contains(&format!("fn {}_change", switch.name)), "{}", switch.name);
    }
}
