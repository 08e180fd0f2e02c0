//! The two shaders of CS315, "Illumination 2", line by line, with their names; the first with the
//! attenuation of exercise 2, which multiplies the whole colour of each light.

use super::super::stage::{V3, dot};
use super::configuration::{Attributes, Light, Uniforms};
use super::gl::{Doubts, add, minus, mult, normalize, scale, sub, transform, varying};

/// "Multi-Light Shader with added Specular".
pub(super) fn multi_light(
    uniforms: &Uniforms,
    attributes: &[Attributes; 3],
    weights: V3,
    doubts: &mut Doubts,
) -> V3 {
    let colors = attributes.each_ref().map(|attribute| {
        let mv_position = transform(&uniforms.model_view, attribute.position, 1.0);
        let n = normalize(transform(&uniforms.model_view, attribute.normal, 0.0));
        let mut color = [0.0, 0.0, 0.0];
        for light in &uniforms.lights {
            color = add(color, light_calc(uniforms, light, mv_position, n, doubts));
        }
        color
    });
    varying(weights, colors)
}

fn light_calc(
    uniforms: &Uniforms,
    light: &Light,
    mv_position: V3,
    n: V3,
    doubts: &mut Doubts,
) -> V3 {
    let material = &uniforms.material;
    let l = if light.position[3] == 0.0 {
        normalize(light.xyz())
    } else {
        normalize(sub(light.xyz(), mv_position))
    };
    let e = minus(normalize(mv_position));
    let h = doubts.normalize(add(l, e));
    let ks = dot(n, h).max(0.0).powf(material.shininess);
    let kd = dot(l, n).max(0.0);
    let color = add(
        add(
            scale(ks, mult(material.specular, light.specular)),
            scale(kd, mult(material.diffuse, light.diffuse)),
        ),
        mult(material.ambient, light.ambient),
    );
    let mut attenuation = 1.0;
    if light.position[3] != 0.0 {
        let way = sub(light.xyz(), mv_position);
        let dist = dot(way, way).sqrt();
        let [constant, linear, quadratic] = light.attenuation;
        attenuation = 1.0 / (constant + linear * dist + quadratic * dist * dist);
    }
    scale(attenuation, color)
}

/// "Hemisphere Lighting Vertex Shader". The light's position is `global.direction`, its ambient
/// colour `global.top`, its diffuse one `global.bottom`.
pub(super) fn hemisphere(
    uniforms: &Uniforms,
    attributes: &[Attributes; 3],
    weights: V3,
    _: &mut Doubts,
) -> V3 {
    let (global, material) = (&uniforms.lights[0], &uniforms.material);
    let colors = attributes.each_ref().map(|attribute| {
        let n = normalize(transform(&uniforms.model_view, attribute.normal, 0.0));
        let l = normalize(global.xyz());
        let cos_theta = dot(l, n);
        let a = 0.5 + (0.5 * cos_theta);
        add(
            mult(scale(a, global.ambient), material.diffuse),
            mult(scale(1.0 - a, global.diffuse), material.diffuse),
        )
    });
    varying(weights, colors)
}
