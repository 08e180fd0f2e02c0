//! The shaders of the texts, transcribed line by line in plain f64, against the renderer: 1,000
//! fixed configurations each (A60 to A65, and the five iterations of Curless).
//!
//! The transcriptions work as the texts do: in eye space, per vertex and per fragment, varyings by
//! window coordinates and 1/W, powers of cosines. The renderer shares none of that: world space,
//! exact visibility, lobes of 1 − cos. A scene per shader lies in `scenes`.

mod angel;
mod configuration;
mod cs315;
mod curless;
mod gl;
mod scene_text;

use super::stage::V3;
use crate::support::rays::Random;
use configuration::{Attributes, Configuration, Lights, Uniforms};
use gl::Doubts;
use tempfile::TempDir;
use truecast::accel::BuildPreset;
use truecast::render::{Answerer, Unwatched, VisibilityPath};
use truecast::shade::{self, Effects};
use truecast::visibility::Counting;

/// Largest difference of a channel, linear light, times (1 + |I|)(1 + √ns): some hundred roundings
/// of 2^-53 = 1.1e-16. The two lie some dozen roundings apart: weights of a triangle that fills
/// half a pixel or more of 9 × 9, distances up to 30 units, unit vectors of sums not below
/// [`SHORTEST`]. A power ns of a cosine multiplies the error of the angle by √ns at most; that of
/// the cosine's own rounding, by ns where it is near 1, is 100 · 2^-53 at most as well.
const RADIANCE_BOUND: f64 = 1e-14;

/// A number whose sign decides and which is nearer to 0 than this, but not 0, may have either sign.
const GATE: f64 = 1e-12;

/// Sums of unit vectors that are shorter than this have no direction to compare.
const SHORTEST: f64 = 0.1;

/// Configurations per shader.
const CONFIGURATIONS: usize = 1_000;

type Shader = fn(&Uniforms, &[Attributes; 3], V3, &mut Doubts) -> V3;

/// A shader and the scene settings that reproduce it.
struct Case {
    shader: Shader,
    head: &'static str,
    shading: &'static str,
    lights: Lights,
    /// Whether the model is transformed (unevenly, which naive normals show).
    moves_normals: bool,
}

/// What was met on the way, so that no kind of configuration is missing unnoticed.
#[derive(Default)]
struct Met {
    /// Pixels of configurations whose lights lie in the plane of the triangle.
    in_plane: usize,
    /// Pixels of configurations whose lights lie beside that plane.
    grazing: usize,
    /// Pixels where a light was behind the surface, as a gate saw it.
    back_lit: usize,
    /// By exponent 0, 1, 10, 100.
    exponents: [usize; 4],
}

fn compare(case: &Case, change: impl Fn(&mut Configuration, &mut Random)) -> Met {
    let folder = TempDir::new().unwrap();
    let mut random = Random(1971);
    let mut met = Met::default();
    let (mut compared, mut round) = (0, 0);
    while compared < CONFIGURATIONS {
        assert!(round < 3 * CONFIGURATIONS, "{compared} of {round} configurations have a pixel");
        let mut configuration =
            Configuration::of(round, case.lights, case.moves_normals, &mut random);
        change(&mut configuration, &mut random);
        let pixels = compare_one(case, &mut configuration, &folder, &mut met);
        match round % 4 {
            0 => met.in_plane += pixels,
            1 => met.grazing += pixels,
            _ => {}
        }
        let ns = configuration.uniforms.material.shininess;
        met.exponents[[0.0, 1.0, 10.0, 100.0].iter().position(|n| *n == ns).unwrap()] += pixels;
        compared += usize::from(pixels > 0);
        round += 1;
    }
    assert!(met.in_plane > 100 && met.grazing > 100);
    assert!(met.exponents.iter().all(|&count| count > 100));
    met
}

/// Compares every pixel that both call covered and that lies beside no jump.
fn compare_one(
    case: &Case,
    configuration: &mut Configuration,
    folder: &TempDir,
    met: &mut Met,
) -> usize {
    let scene = configuration.scene(case.head, case.shading, folder.path());
    configuration.set_model_view();
    let window = scene.camera.resolution().window();
    let answerer = Answerer::new(&scene, VisibilityPath::Cast, BuildPreset::Medium, &Unwatched);
    let buffer = answerer.see(&scene, window, Counting::Nearest, &Unwatched);
    let shaded = shade::shade(&scene, &buffer, Effects::of(&scene), &|| ());
    let corners = gl::window_positions(&scene.camera, configuration.corners());
    let ns = configuration.uniforms.material.shininess;
    let mut pixels = 0;
    for (index, radiance) in shaded.radiance.iter().enumerate() {
        let Some(weights) = gl::varying_weights(&corners, window.pixel(index)) else { continue };
        if buffer.visible[index].is_none() {
            continue;
        }
        let mut doubts = Doubts::NONE;
        let attributes = &configuration.attributes;
        let expected = (case.shader)(&configuration.uniforms, attributes, weights, &mut doubts);
        if doubts.gate < GATE || doubts.length < SHORTEST {
            continue;
        }
        for k in 0..3 {
            let difference = (radiance[k] - expected[k]).abs();
            let scale = (1.0 + expected[k].abs()) * (1.0 + ns.sqrt());
            assert!(
                difference <= RADIANCE_BOUND * scale,
                "{radiance:?} {expected:?} ns {ns}, weights {weights:?} {:?}, gate {} length {}, \
                 window {corners:?}
{scene:?}",
                buffer.visible[index],
                doubts.gate,
                doubts.length
            );
        }
        met.back_lit += usize::from(doubts.turned_away);
        pixels += 1;
    }
    pixels
}

const ANGEL: &str = "dialect = \"angel\"\nswitches = { naive_normals = true }";

#[test]
fn a60_angels_per_vertex_shader_with_the_halfway_vector() {
    let case = Case {
        shader: angel::per_vertex_halfway,
        head: ANGEL,
        shading: "gouraud",
        lights: Lights::OnePoint,
        moves_normals: true,
    };
    let met = compare(&case, |_, _| ());
    assert!(met.back_lit > 100);
}

#[test]
fn a61_angels_per_fragment_shader_interpolates_unit_vectors() {
    let case = Case {
        shader: angel::per_fragment_halfway,
        head: ANGEL,
        shading: "phong",
        lights: Lights::OnePoint,
        moves_normals: true,
    };
    let met = compare(&case, |_, _| ());
    assert!(met.back_lit > 100);
}

#[test]
fn a62_angels_per_vertex_shader_with_the_reflected_vector() {
    let case = Case {
        shader: angel::per_vertex_reflect,
        head: "dialect = \"angel\"\nswitches = { naive_normals = true, specular = \"phong\" }",
        shading: "gouraud",
        lights: Lights::OnePoint,
        moves_normals: true,
    };
    let met = compare(&case, |_, _| ());
    assert!(met.back_lit > 100);
}

const CS315: &str = "dialect = \"cs315\"\nswitches = { naive_normals = true }";

#[test]
fn a63_the_multi_light_shader_of_the_lab_with_its_attenuation() {
    let case = Case {
        shader: cs315::multi_light,
        head: CS315,
        shading: "gouraud",
        lights: Lights::Several,
        moves_normals: true,
    };
    compare(&case, |_, _| ());
}

#[test]
fn a64_the_hemisphere_shader_of_the_lab() {
    let case = Case {
        shader: cs315::hemisphere,
        head: CS315,
        shading: "gouraud",
        lights: Lights::Around,
        moves_normals: true,
    };
    compare(&case, |_, _| ());
}

#[test]
fn a65_the_pass_through_shaders_interpolate_vertex_colours() {
    let case = Case {
        shader: curless::pass_through,
        head: "",
        shading: "vertex-color",
        lights: Lights::Several,
        moves_normals: true,
    };
    compare(&case, |_, _| ());
}

fn compare_iteration(shader: Shader, lights: Lights, change: fn(&mut Configuration)) -> Met {
    let case = Case { shader, head: "", shading: "phong", lights, moves_normals: false };
    compare(&case, |configuration, random| {
        let material = &mut configuration.uniforms.material;
        material.emission = std::array::from_fn(|_| random.step());
        for light in &mut configuration.uniforms.lights {
            light.specular = light.diffuse;
        }
        change(configuration);
    })
}

#[test]
fn iteration_zero_of_curless() {
    compare_iteration(curless::iteration_0, Lights::None, |_| ());
}

#[test]
fn iteration_one_of_curless() {
    compare_iteration(curless::iteration_1, Lights::One, |configuration| {
        let material = &mut configuration.uniforms.material;
        (material.diffuse, material.specular) = ([0.0; 3], [0.0; 3]);
    });
}

#[test]
fn iteration_two_of_curless() {
    let met = compare_iteration(curless::iteration_2, Lights::One, |configuration| {
        configuration.uniforms.material.specular = [0.0; 3];
    });
    assert!(met.back_lit > 100);
}

#[test]
fn iteration_three_of_curless() {
    assert!(compare_iteration(curless::iteration_3, Lights::One, |_| ()).back_lit > 100);
}

#[test]
fn iteration_four_of_curless() {
    assert!(compare_iteration(curless::iteration_4, Lights::Spots, |_| ()).back_lit > 100);
}

#[test]
fn the_scenes_that_come_with_the_project_have_the_shaders_settings() {
    use truecast::scene::switches::{SwitchValue, Switches};
    use truecast::scene::{Overrides, Scene, Shading};
    let preset = |dialect: &str| Switches::of_dialect(dialect).unwrap();
    let naive = |dialect: &str| preset(dialect).with("naive_normals", SwitchValue::Is(true));
    let reflect = naive("angel").with("specular", SwitchValue::Word("phong"));
    for (name, switches, shading) in [
        ("a60-angel-per-vertex", naive("angel"), Shading::Gouraud),
        ("a61-angel-per-fragment", naive("angel"), Shading::Phong),
        ("a62-angel-reflect", reflect, Shading::Gouraud),
        ("a63-lab-multi-light", naive("cs315"), Shading::Gouraud),
        ("a64-lab-hemisphere", naive("cs315"), Shading::Gouraud),
        ("a65-pass-through", preset("curless"), Shading::VertexColor),
    ] {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
        let path = folder.join(format!("shader-{name}.toml"));
        let scene = Scene::load(&path, &Overrides::default()).unwrap();
        assert_eq!(scene.switches, switches, "{name}");
        assert!(scene.objects.iter().all(|object| object.shading == shading), "{name}");
    }
}
