//! Curless, "Shading": the pass-through shaders and the five iterations of the shading equation,
//! at each fragment, as the programmable pipeline of the text has it. The position and the normal
//! are varyings. Corrected in iteration four: the cutoff is β (printed b), (N·H) is (N·H)_+, and
//! the sum covers the whole bracket.

use super::super::stage::{V3, dot};
use super::configuration::{Attributes, Light, Uniforms};
use super::gl::{Doubts, add, minus, mult, normalize, scale, sub, transform, varying};

/// "GLSL: Anatomy of a Vertex Shader", "… of a Fragment Shader".
pub(super) fn pass_through(
    _: &Uniforms,
    attributes: &[Attributes; 3],
    weights: V3,
    _: &mut Doubts,
) -> V3 {
    let color = attributes.each_ref().map(|attribute| attribute.color);
    varying(weights, color)
}

/// What a fragment shader is given.
struct Fragment {
    position: V3,
    normal: V3,
    viewer: V3,
}

fn fragment(
    uniforms: &Uniforms,
    attributes: &[Attributes; 3],
    weights: V3,
    doubts: &mut Doubts,
) -> Fragment {
    let view = &uniforms.model_view;
    let v_e = varying(weights, attributes.each_ref().map(|a| transform(view, a.position, 1.0)));
    let n_e = varying(weights, attributes.each_ref().map(|a| transform(view, a.normal, 0.0)));
    Fragment { position: v_e, viewer: normalize(minus(v_e)), normal: doubts.normalize(n_e) }
}

/// I = k_e.
pub(super) fn iteration_0(uniforms: &Uniforms, _: &[Attributes; 3], _: V3, _: &mut Doubts) -> V3 {
    uniforms.material.emission
}

/// I = k_e + k_a I_La.
pub(super) fn iteration_1(
    uniforms: &Uniforms,
    attributes: &[Attributes; 3],
    weights: V3,
    doubts: &mut Doubts,
) -> V3 {
    let before = iteration_0(uniforms, attributes, weights, doubts);
    add(before, mult(uniforms.material.ambient, uniforms.lights[0].ambient))
}

/// I = k_e + k_a I_La + k_d I_L B (N·L).
pub(super) fn iteration_2(
    uniforms: &Uniforms,
    attributes: &[Attributes; 3],
    weights: V3,
    doubts: &mut Doubts,
) -> V3 {
    let before = iteration_1(uniforms, attributes, weights, doubts);
    let fragment = fragment(uniforms, attributes, weights, doubts);
    let (light, n) = (&uniforms.lights[0], fragment.normal);
    let l = direction_to(light, fragment.position).0;
    let b = gate(light, dot(n, l), doubts);
    add(before, scale(b * dot(n, l), mult(uniforms.material.diffuse, light.diffuse)))
}

/// I = k_e + k_a I_La + I_L B [ k_d (N·L) + k_s (N·H)_+^ns ].
pub(super) fn iteration_3(
    uniforms: &Uniforms,
    attributes: &[Attributes; 3],
    weights: V3,
    doubts: &mut Doubts,
) -> V3 {
    let before = iteration_1(uniforms, attributes, weights, doubts);
    let fragment = fragment(uniforms, attributes, weights, doubts);
    let light = &uniforms.lights[0];
    let l = direction_to(light, fragment.position).0;
    add(before, mult(light.diffuse, bracket(uniforms, &fragment, light, l, doubts)))
}

/// I = k_e + Σ_j [ k_a I_La,j + f_j I_L,j B_j [ k_d (N·L_j) + k_s (N·H_j)_+^ns ] ] with
/// f_j = (L_j·S_j)^e β_j / (a_j + b_j r_j + c_j r_j²).
pub(super) fn iteration_4(
    uniforms: &Uniforms,
    attributes: &[Attributes; 3],
    weights: V3,
    doubts: &mut Doubts,
) -> V3 {
    let mut i = iteration_0(uniforms, attributes, weights, doubts);
    let fragment = fragment(uniforms, attributes, weights, doubts);
    for light in &uniforms.lights {
        let (l, r) = direction_to(light, fragment.position);
        let mut f = 1.0;
        if light.position[3] != 0.0 {
            let [a, b, c] = light.attenuation;
            f = 1.0 / (a + b * r + c * r * r);
        }
        if let Some(spot) = &light.spot {
            // L points to the light, so S is the direction against which it shines.
            let s = normalize(minus(spot.aim));
            let inside = doubts.rounded_gate(dot(l, s) - spot.cutoff_deg.to_radians().cos()) >= 0.0;
            f *= if inside { dot(l, s).powf(spot.exponent) } else { 0.0 };
        }
        let reflected =
            scale(f, mult(light.diffuse, bracket(uniforms, &fragment, light, l, doubts)));
        i = add(i, add(mult(uniforms.material.ambient, light.ambient), reflected));
    }
    i
}

/// B [ k_d (N·L) + k_s (N·H)_+^ns ].
fn bracket(
    uniforms: &Uniforms,
    fragment: &Fragment,
    light: &Light,
    l: V3,
    doubts: &mut Doubts,
) -> V3 {
    let (material, n) = (&uniforms.material, fragment.normal);
    let h = doubts.normalize(add(l, fragment.viewer));
    let b = gate(light, dot(n, l), doubts);
    let highlight = dot(n, h).max(0.0).powf(material.shininess);
    scale(b, add(scale(dot(n, l), material.diffuse), scale(highlight, material.specular)))
}

/// B. A fragment's position is rounded, and with it N·L of a light at a position.
fn gate(light: &Light, n_dot_l: f64, doubts: &mut Doubts) -> f64 {
    let is_infinitely_far = light.position[3] == 0.0;
    let n_dot_l =
        if is_infinitely_far { doubts.gate(n_dot_l) } else { doubts.rounded_gate(n_dot_l) };
    if n_dot_l > 0.0 { 1.0 } else { 0.0 }
}

/// L and r.
fn direction_to(light: &Light, position: V3) -> (V3, f64) {
    if light.position[3] == 0.0 {
        return (normalize(light.xyz()), 1.0);
    }
    let way = sub(light.xyz(), position);
    (normalize(way), dot(way, way).sqrt())
}
