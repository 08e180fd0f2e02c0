//! What f32 lanes ask of a frame: its lights in f32, relative to the eye, and whether its numbers
//! are such as f32 takes.

use super::{EXPONENTS, NEAREST, NUMBERS, RIM, SOFTEST, SQUARED_DISTANCES, WIDEST_CHORD};
use crate::color::LinearRgb;
use crate::scene::Scene;
use crate::shade::lights::{Cone, Origin, PreparedLight};

/// Up to so many lights are asked at every pixel: a light whose cone misses leaves soon, and finding
/// out for a run which ones do costs as much as four of them.
const FEW_LIGHTS: usize = 4;

/// A light in f32.
#[derive(Clone, Copy, Debug)]
pub(super) struct SingleLight {
    /// Position in the scene's lights.
    pub(super) index: usize,
    /// Whether somebody is asked what hides it.
    pub(super) shadows: bool,
    /// Whether it has a directed part.
    pub(super) is_directed: bool,
    /// Unit, towards it; zero for a light at a point.
    pub(super) to_light: [f32; 3],
    /// Its position minus the eye's, for a light at a point.
    pub(super) position: Option<[f32; 3]>,
    /// |position|²/`NEAREST` and the smallest squared distance: its part of the squared distance
    /// from which a point is far enough.
    pub(super) nearness: f32,
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
    pub(super) rim: Rim,
    /// e.
    pub(super) exponent: Option<f32>,
}

/// By what a cone tells inside from outside; neither is certain in between.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Rim {
    /// L·S, where it has digits enough.
    Cosine {
        /// From here on certainly inside.
        inside: f32,
        /// Up to here certainly outside, or without light.
        outside: f32,
    },
    /// 1 − L·S = |L − S|²/2, for narrow cones and for steep falloffs.
    Chord {
        /// Up to here certainly inside.
        inside: f32,
        /// From here on certainly outside, or without light.
        outside: f32,
    },
}

impl SingleCone {
    fn of(cone: &Cone) -> Self {
        let exponent = cone.exponent.filter(|&e| e != 0.0);
        let chord = cone.largest_squared_chord.map(f64::sqrt);
        let is_narrow = chord.is_some_and(|chord| chord < WIDEST_CHORD);
        let is_steep = exponent.is_some_and(|e| e > SOFTEST.into());
        let rim = if is_narrow || is_steep {
            let q = |chord: f64| (0.5 * chord * chord) as f32;
            let (inside, outside) = match chord {
                Some(chord) => (q((chord - RIM).max(0.0)), q(chord + RIM)),
                None => (f32::INFINITY, f32::INFINITY),
            };
            // Where a falloff has an end, nothing is lit beyond it.
            Rim::Chord {
                inside,
                outside: if exponent.is_some() { outside.min(1.0) } else { outside },
            }
        } else {
            let (inside, outside) = match chord {
                Some(chord) => {
                    let cosine = 1.0 - 0.5 * chord * chord;
                    ((cosine + RIM) as f32, (cosine - RIM) as f32)
                }
                None => (f32::NEG_INFINITY, f32::NEG_INFINITY),
            };
            Rim::Cosine {
                inside,
                outside: if exponent.is_some() { outside.max(0.0) } else { outside },
            }
        };
        Self { axis: cone.axis.map(|c| c as f32), rim, exponent: exponent.map(|e| e as f32) }
    }
}

/// The lights of a frame in f32.
#[derive(Clone, Debug)]
pub(in crate::shade) struct SingleFrame {
    pub(super) lights: Vec<SingleLight>,
    /// Whether it pays to find first which lights reach a run.
    pub(super) selects_lights: bool,
}

impl SingleFrame {
    /// `None` where a number of the scene is not such as f32 takes.
    pub(in crate::shade) fn of(
        scene: &Scene,
        lights: &[PreparedLight],
        selects_lights: bool,
    ) -> Option<Self> {
        let selects_lights = selects_lights && lights.len() > FEW_LIGHTS;
        let eye = scene.camera.eye();
        let materials = scene.materials.iter();
        let has_room = materials.clone().all(|material| {
            [material.ke, material.ka, material.kd, material.ks].into_iter().all(is_color)
                && is_exponent(material.ns)
        });
        let lights: Option<Vec<_>> = lights.iter().map(|light| single(light, eye)).collect();
        lights.filter(|_| has_room).map(|lights| Self { lights, selects_lights })
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
        index: light.index,
        shadows: light.shadows,
        is_directed: true,
        to_light: [0.0; 3],
        position: None,
        nearness: 0.0,
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
            let [nearest, farthest] = SQUARED_DISTANCES;
            if squared > farthest.into() {
                return None;
            }
            single.position = Some(narrowed(way));
            single.nearness = (squared as f32) / NEAREST + nearest;
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
                single.cone = Some(SingleCone::of(cone));
            }
        }
    }
    Some(single)
}
