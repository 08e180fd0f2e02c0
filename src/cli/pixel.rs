//! `truecast pixel`: one pixel explained by exact arithmetic — every candidate in depth order, the
//! winner, and every light's term there.

use super::arguments::PixelArguments;
use super::failure::Failure;
use super::{OK, output};
use serde_json::{Value, json};
use truecast::check::{exact_terms, visible_of};
use truecast::exact::{Answer, Arbiter, Candidate};
use truecast::pixel::Pixel;
use truecast::render::expose::Blend;
use truecast::scene::{Overrides, Scene};
use truecast::shade::Terms;
use truecast::visibility::Visible;

/// Everything that is said about a pixel.
struct Explained {
    pixel: Pixel,
    direction: [f64; 3],
    candidates: Vec<Candidate>,
    /// Per candidate, the share of it in the pixel's radiance.
    shares: Vec<f64>,
    answer: Answer,
    visible: Option<(Visible, Terms)>,
}

pub(super) fn run(arguments: &PixelArguments) -> Result<u8, Failure> {
    let scene = Scene::load(
        &arguments.scene,
        &Overrides {
            resolution: arguments.size,
            skip_bad: arguments.skip_bad,
            ..Overrides::default()
        },
    )?;
    output::print_warnings(&scene.warnings);
    let frame = scene.camera.resolution();
    let pixel = Pixel { x: arguments.x, y: arguments.y };
    if !frame.window().contains(pixel) {
        return Err(Failure::usage(format!(
            "pixel ({}, {}) is outside the {}x{} frame",
            pixel.x,
            pixel.y,
            frame.width(),
            frame.height()
        )));
    }
    let explained = explain(&scene, pixel);
    if arguments.json {
        output::print_json(&document(arguments, &scene, &explained));
    } else {
        output::print(&text(arguments, &scene, &explained));
    }
    Ok(OK)
}

fn explain(scene: &Scene, pixel: Pixel) -> Explained {
    let arbiter = Arbiter::new(scene);
    let answer = arbiter.answer(pixel);
    let visible =
        visible_of(&answer).0.map(|visible| (visible, exact_terms(scene, pixel, &visible)));
    let [x, y] = pixel.sample();
    let camera = &scene.camera;
    // Exact: the camera is on its lattice.
    let direction =
        std::array::from_fn(|k| camera.d0()[k] + x * camera.dx()[k] + y * camera.dy()[k]);
    let candidates = arbiter.candidates(pixel);
    let shares = shares(scene, &candidates);
    Explained { pixel, direction, candidates, shares, answer, visible }
}

/// T·o of each candidate, front to back; 0 for one that does not cover the sample.
fn shares(scene: &Scene, candidates: &[Candidate]) -> Vec<f64> {
    let mut blend = Blend::START;
    let mut share = |candidate: &Candidate| {
        let opacity = opacity(scene, candidate);
        let share = blend.share(opacity);
        blend.add([0.0; 3], opacity);
        share
    };
    candidates.iter().map(|c| if c.covers { share(c) } else { 0.0 }).collect()
}

fn opacity(scene: &Scene, candidate: &Candidate) -> f64 {
    scene.material_of(candidate.triangle).1.opacity
}

fn text(arguments: &PixelArguments, scene: &Scene, explained: &Explained) -> String {
    let [x, y] = explained.pixel.sample();
    let frame = scene.camera.resolution();
    let mut text = format!(
        "pixel ({}, {}) of {} ({}x{}), sample ({x}, {y})\n",
        explained.pixel.x,
        explained.pixel.y,
        arguments.scene.display(),
        frame.width(),
        frame.height()
    );
    text += &format!("ray: eye {:?}, direction {:?}\n", scene.camera.eye(), explained.direction);
    text += &format!(
        "cover {}, signed count {}\n",
        explained.answer.cover.crossed, explained.answer.cover.signed
    );
    if explained.candidates.is_empty() {
        text += "no triangle covers or touches this sample\n";
    } else {
        text += "candidates, nearest first (edge signs: + inside, 0 on the edge; then moved by the \
                 tie rule):\n";
    }
    let winner = explained.visible.as_ref().map(|(visible, _)| visible.triangle);
    let all_opaque = explained.candidates.iter().all(|c| scene.is_opaque(c.triangle));
    for (candidate, &share) in explained.candidates.iter().zip(&explained.shares) {
        let mark = if Some(candidate.triangle) == winner {
            "visible"
        } else if share > 0.0 {
            "seen through"
        } else if candidate.covers {
            "hidden"
        } else {
            "only touched"
        };
        text += &format!(
            "  triangle {} ({}): {mark}; facing {:+}, edges {} -> {}, t in [{:?}, {:?}]{}\n",
            candidate.triangle.get(),
            scene.describe_source(candidate.triangle),
            candidate.facing.sign(),
            signs(candidate.edge_signs),
            signs(candidate.moved_signs),
            candidate.t_lo,
            candidate.t_hi,
            match all_opaque {
                true => String::new(),
                false => format!("; opacity {:?}, share {share:?}", opacity(scene, candidate)),
            },
        );
    }
    match &explained.visible {
        None => text += &format!("nothing is visible: background {:?}\n", scene.background),
        Some((visible, terms)) => text += &shading_text(scene, visible, terms),
    }
    text
}

fn shading_text(scene: &Scene, visible: &Visible, terms: &Terms) -> String {
    let surface = &terms.surface;
    let (_, material) = scene.material_of(visible.triangle);
    let mut text = format!(
        "visible: triangle {} ({}), weights {:?}, t {:?}{}\n",
        visible.triangle.get(),
        scene.describe_source(visible.triangle),
        visible.barycentric.0,
        visible.t(),
        if visible.tie { ", decided by the tie rule" } else { "" }
    );
    text += &format!(
        "surface: P {:?}, V {:?}, face normal {:?}, shading normal {:?}\n",
        surface.position, surface.to_eye, surface.face_normal, surface.shading_normal
    );
    text += &format!(
        "material {}: ka {:?}, kd {:?}, ks {:?}, ns {}, ke {:?}\n",
        material.name, material.ka, material.kd, material.ks, material.ns, material.ke
    );
    text += &format!("radiance, linear:\n  emission {:?}\n", terms.emission);
    for (index, light) in terms.lights.iter().enumerate() {
        text += &format!(
            "  light {index}: {}; ambient {:?}, diffuse {:?}, specular {:?}{}\n",
            light.outcome.describe(),
            light.ambient,
            light.diffuse,
            light.specular,
            [
                ("r", light.distance),
                ("N·L", light.n_dot_l),
                ("f", light.factor),
                ("N·H", light.n_dot_h)
            ]
            .iter()
            .filter_map(|(name, value)| value.map(|value| format!(", {name} {value:?}")))
            .collect::<String>()
        );
    }
    text += &format!("  sum {:?}\n", terms.sum());
    text
}

fn signs(signs: [i8; 3]) -> String {
    signs
        .map(|sign| match sign {
            0 => '0',
            1.. => '+',
            _ => '-',
        })
        .iter()
        .collect()
}

fn document(arguments: &PixelArguments, scene: &Scene, explained: &Explained) -> Value {
    let candidates: Vec<_> = explained
        .candidates
        .iter()
        .zip(&explained.shares)
        .map(|(candidate, share)| {
            json!({
                "id": candidate.triangle.get(),
                "source": scene.describe_source(candidate.triangle),
                "covers": candidate.covers,
                "facing": candidate.facing.sign(),
                "edge_signs": candidate.edge_signs,
                "moved_signs": candidate.moved_signs,
                "t_lo": candidate.t_lo,
                "t_hi": candidate.t_hi,
                "weights": candidate.barycentric.0,
                "opacity": opacity(scene, candidate),
                "share": share,
            })
        })
        .collect();
    let visible = explained.visible.as_ref().map(|(visible, terms)| {
        let lights: Vec<_> = terms
            .lights
            .iter()
            .map(|light| {
                json!({
                    "outcome": light.outcome.describe(),
                    "ambient": light.ambient,
                    "diffuse": light.diffuse,
                    "specular": light.specular,
                    "distance": light.distance,
                    "n_dot_l": light.n_dot_l,
                    "factor": light.factor,
                    "n_dot_h": light.n_dot_h,
                    "gate": light.gate(),
                })
            })
            .collect();
        json!({
            "id": visible.triangle.get(),
            "source": scene.describe_source(visible.triangle),
            "object": scene.object_of(visible.triangle).0,
            "material": scene.material_of(visible.triangle).1.name,
            "facing": visible.facing.sign(),
            "tie": visible.tie,
            "t": visible.t(),
            "t_lo": visible.t_lo,
            "t_hi": visible.t_hi,
            "Z": visible.t() * scene.camera.z_per_t(),
            "weights": visible.barycentric.0,
            "P": terms.surface.position,
            "V": terms.surface.to_eye,
            "N": terms.surface.face_normal,
            "Ns": terms.surface.shading_normal,
            "uv": terms.surface.uv,
            "emission": terms.emission,
            "lights": lights,
            "radiance": terms.sum(),
        })
    });
    json!({
        "schema": "truecast/pixel/1",
        "scene": arguments.scene.display().to_string(),
        "x": explained.pixel.x,
        "y": explained.pixel.y,
        "sample": explained.pixel.sample(),
        "eye": scene.camera.eye(),
        "direction": explained.direction,
        "cover": explained.answer.cover.crossed,
        "signed_count": explained.answer.cover.signed,
        "candidates": candidates,
        "visible": visible,
        "background": scene.background,
    })
}
