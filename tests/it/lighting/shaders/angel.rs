//! The three shaders of Angel, "Lighting and Shading", line by line, with their names. Corrected:
//! `vec4(vNormal, 0)` of a three-vector, and one spelling of each uniform.

use super::super::stage::{V3, dot};
use super::configuration::{Attributes, Uniforms};
use super::gl::{Doubts, add, minus, mult, normalize, reflect, scale, sub, transform, varying};

/// The colours of the application: light times material.
struct Products {
    ambient: V3,
    diffuse: V3,
    specular: V3,
}

fn products(uniforms: &Uniforms) -> Products {
    let (light, material) = (&uniforms.lights[0], &uniforms.material);
    Products {
        ambient: mult(light.ambient, material.ambient),
        diffuse: mult(light.diffuse, material.diffuse),
        specular: mult(light.specular, material.specular),
    }
}

/// "Per-Vertex Lighting Shaders (use halfway vector)".
pub(super) fn per_vertex_halfway(
    uniforms: &Uniforms,
    attributes: &[Attributes; 3],
    weights: V3,
    doubts: &mut Doubts,
) -> V3 {
    let colors = attributes.each_ref().map(|attribute| {
        let pos = transform(&uniforms.model_view, attribute.position, 1.0);
        let light = uniforms.lights[0].xyz();
        let l = normalize(sub(light, pos));
        let e = normalize(minus(pos));
        let h = doubts.normalize(add(l, e));
        let n = normalize(transform(&uniforms.model_view, attribute.normal, 0.0));
        let Products { ambient, diffuse, specular } = products(uniforms);
        let kd = dot(l, n).max(0.0);
        let diffuse = scale(kd, diffuse);
        let ks = dot(n, h).max(0.0).powf(uniforms.material.shininess);
        let mut specular = scale(ks, specular);
        if doubts.gate(dot(l, n)) < 0.0 {
            specular = [0.0, 0.0, 0.0];
        }
        add(add(ambient, diffuse), specular)
    });
    varying(weights, colors)
}

/// "Per-Fragment Lighting Shaders (use halfway vector)".
pub(super) fn per_fragment_halfway(
    uniforms: &Uniforms,
    attributes: &[Attributes; 3],
    weights: V3,
    doubts: &mut Doubts,
) -> V3 {
    let pos = attributes.each_ref().map(|a| transform(&uniforms.model_view, a.position, 1.0));
    let light = uniforms.lights[0].xyz();
    let l = pos.map(|pos| normalize(sub(light, pos)));
    let e = pos.map(|pos| normalize(minus(pos)));
    let n =
        attributes.each_ref().map(|a| normalize(transform(&uniforms.model_view, a.normal, 0.0)));

    let nn = doubts.normalize(varying(weights, n));
    let nl = doubts.normalize(varying(weights, l));
    let ne = doubts.normalize(varying(weights, e));
    let nh = doubts.normalize(add(nl, ne));
    let Products { ambient, diffuse, specular } = products(uniforms);
    let kd = dot(nl, nn).max(0.0);
    let diffuse = scale(kd, diffuse);
    let ks = dot(nn, nh).max(0.0).powf(uniforms.material.shininess);
    let mut specular = scale(ks, specular);
    if doubts.gate(dot(nl, nn)) < 0.0 {
        specular = [0.0, 0.0, 0.0];
    }
    add(add(ambient, diffuse), specular)
}

/// "Per-Vertex Lighting Shaders (use reflect vector)".
pub(super) fn per_vertex_reflect(
    uniforms: &Uniforms,
    attributes: &[Attributes; 3],
    weights: V3,
    doubts: &mut Doubts,
) -> V3 {
    let colors = attributes.each_ref().map(|attribute| {
        let pos = transform(&uniforms.model_view, attribute.position, 1.0);
        let light = uniforms.lights[0].xyz();
        let l = normalize(sub(light, pos));
        let e = normalize(minus(pos));
        let n = normalize(transform(&uniforms.model_view, attribute.normal, 0.0));
        let r = normalize(minus(reflect(l, n)));
        let Products { ambient, diffuse, specular } = products(uniforms);
        let kd = dot(l, n).max(0.0);
        let diffuse = scale(kd, diffuse);
        let ks = dot(e, r).max(0.0).powf(uniforms.material.shininess);
        let mut specular = scale(ks, specular);
        if doubts.gate(dot(l, n)) < 0.0 {
            specular = [0.0, 0.0, 0.0];
        }
        add(add(ambient, diffuse), specular)
    });
    varying(weights, colors)
}
