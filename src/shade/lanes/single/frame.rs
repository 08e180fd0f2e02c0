//! What f32 lanes ask of a frame: its lights in f32, relative to the eye, and whether its numbers
//! are such as f32 takes.

use super::{EXPONENTS, NUMBERS, RIM};
use crate::color::LinearRgb;
use crate::scene::Scene;
use crate::shade::lights::{Origin, PreparedLight};

/// A light in f32.
#[derive(Clone, Copy, Debug)]
pub(super) struct SingleLight {
    /// Whether it has a directed part.
    pub(super) is_directed: bool,
    /// Unit, towards it; zero for a light at a point.
    pub(super) to_light: [f32; 3],
    /// Its position minus the eye's, for a light at a point.
    pub(super) position: Option<[f32; 3]>,
    /// 16 |position|², what `NEAREST` compares.
    pub(super) squared_distance: f32,
    /// a, b, c.
    pub(super) attenuation: Option<[f32; 3]>,
    pub(super) cone: Option<SingleCone>,
    pub(super) diffuse: [f32; 3],
    pub(super) specular: [f32; 3],
}

/// A cone in f32.
#[derive(Clone, Copy, Debug)]
pub(super) struct SingleCone {
    pub(super) axis: [f32; 3],
    /// 1 − L·S up to which a direction is certainly inside, and from which on certainly outside.
    pub(super) rim: Option<[f32; 2]>,
    /// e.
    pub(super) exponent: Option<f32>,
}

/// The lights of a frame in f32.
#[derive(Clone, Debug)]
pub(in crate::shade) struct SingleFrame {
    pub(super) lights: Vec<SingleLight>,
}

impl SingleFrame {
    /// `None` where a number of the scene is not such as f32 takes.
    pub(in crate::shade) fn of(scene: &Scene, lights: &[PreparedLight]) -> Option<Self> {
        let eye = scene.camera.eye();
        let materials = scene.materials.iter();
        let has_room = materials.clone().all(|material| {
            [material.ke, material.ka, material.kd, material.ks].into_iter().all(is_color)
                && is_exponent(material.ns)
        });
        let lights: Option<Vec<_>> = lights.iter().map(|light| single(light, eye)).collect();
        lights.filter(|_| has_room).map(|lights| Self { lights })
    }
}

fn is_color(color: LinearRgb) -> bool {
    color.iter().all(|&value| value == 0.0 || NUMBERS.contains(&value))
}

fn is_exponent(exponent: f64) -> bool {
    exponent == 0.0 || EXPONENTS.contains(&exponent)
}

fn single(light: &PreparedLight, eye: [f64; 3]) -> Option<SingleLight> {
    let narrowed = |v: [f64; 3]| v.map(|c| c as f32);
    let mut single = SingleLight {
        is_directed: true,
        to_light: [0.0; 3],
        position: None,
        squared_distance: 0.0,
        attenuation: None,
        cone: None,
        diffuse: narrowed(light.diffuse),
        specular: narrowed(light.specular),
    };
    let is_plain = is_color(light.diffuse)
        && is_color(light.specular)
        && is_color(light.ambient.unwrap_or_default());
    if !is_plain {
        return None;
    }
    match &light.origin {
        Origin::Nowhere => single.is_directed = false,
        Origin::Direction { to_light } => single.to_light = narrowed(*to_light),
        // Its colours are mixed by no product of theirs; no such scene is in need of f32.
        Origin::Hemisphere(_) => return None,
        Origin::Position(at) => {
            let way = [0, 1, 2].map(|k| at.position[k] - eye[k]);
            let squared = way.iter().map(|c| c * c).sum::<f64>();
            if squared > 1.0 / *NUMBERS.start() {
                return None;
            }
            single.position = Some(narrowed(way));
            single.squared_distance = squared as f32;
            if let Some(abc) = at.attenuation {
                if !is_color(abc) {
                    return None;
                }
                single.attenuation = Some(narrowed(abc));
            }
            if let Some(cone) = &at.cone {
                if !cone.exponent.is_none_or(is_exponent) {
                    return None;
                }
                // q = |L − S|²/2 at the rim, a little inside and a little outside.
                let rim = cone.largest_squared_chord.map(|squared| {
                    let chord = squared.sqrt();
                    [(chord - RIM).max(0.0), chord + RIM].map(|chord| (0.5 * chord * chord) as f32)
                });
                single.cone = Some(SingleCone {
                    axis: narrowed(cone.axis),
                    rim,
                    exponent: cone.exponent.filter(|&e| e != 0.0).map(|e| e as f32),
                });
            }
        }
    }
    Some(single)
}
