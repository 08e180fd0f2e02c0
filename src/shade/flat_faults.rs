//! Where flat shading is not what it stands for: the conditions under which one colour per face is
//! right, mesh by mesh.
//!
//! Sources: IIT, "Flat Surface Rendering" (a polyhedron, lights and viewer far away), and Curless,
//! "Shading with per-face normals". They are told, never acted on.

use super::lights::is_black;
use crate::scene::light::{Light, LightColors};
use crate::scene::{Object, Scene, Shading};
use std::fmt;

/// The cosine of the largest angle between a corner normal and its face for which the mesh counts
/// as a polyhedron: 0.08°, and with it every rounding of a file's six decimals.
const SAME_NORMAL: f64 = 1.0 - 1e-6;

/// A condition of flat shading that a mesh does not meet.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FlatFault {
    /// Its corner normals are not those of its faces: it stands for a curved surface.
    CurvedSurface,
    /// The light of that name is at a position: N·L and its attenuation vary over a face.
    NearLight(String),
    /// It has highlights, and V varies over a face.
    NearViewer,
}

impl fmt::Display for FlatFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::CurvedSurface => f.write_str("it stands for a curved surface"),
            Self::NearLight(name) => write!(f, "the light `{name}` is not infinitely far"),
            Self::NearViewer => f.write_str("the viewer of its highlights is not infinitely far"),
        }
    }
}

/// The meshes with flat shading, by position, that do not meet every condition. Linear in their
/// triangles.
pub fn flat_faults(scene: &Scene) -> Vec<(usize, Vec<FlatFault>)> {
    let flat = scene.objects.iter().enumerate();
    flat.filter(|(_, object)| object.shading == Shading::Flat)
        .map(|(index, object)| (index, faults_of(scene, object)))
        .filter(|(_, faults)| !faults.is_empty())
        .collect()
}

fn faults_of(scene: &Scene, object: &Object) -> Vec<FlatFault> {
    let mut faults = Vec::new();
    if is_curved(scene, object) {
        faults.push(FlatFault::CurvedSurface);
    }
    // A light that meets no coefficient of the mesh does not count.
    let range = object.triangles.start as usize..object.triangles.end as usize;
    let mut reflects = [false; 2];
    for &material in &scene.triangle_materials[range] {
        let material = &scene.materials[material as usize];
        reflects[0] |= !material.unlit && !is_black(material.kd);
        reflects[1] |= !material.unlit && !is_black(material.ks);
    }
    let mut has_highlight = false;
    for (index, light) in scene.lights.iter().enumerate() {
        let (LightColors { diffuse, specular, .. }, is_near) = match light {
            Light::Directional(light) => (&light.colors, false),
            Light::Point(light) => (&light.colors, true),
            Light::Spot(light) => (&light.colors, true),
            Light::Ambient(_) | Light::Hemisphere(_) => continue,
        };
        let shines = reflects[1] && !is_black(*specular);
        has_highlight |= shines;
        if is_near && (shines || reflects[0] && !is_black(*diffuse)) {
            let name = scene.light_names.get(index).cloned();
            faults.push(FlatFault::NearLight(name.unwrap_or_else(|| format!("light[{index}]"))));
        }
    }
    if has_highlight && !scene.switches.rules().distant_viewer {
        faults.push(FlatFault::NearViewer);
    }
    faults
}

fn is_curved(scene: &Scene, object: &Object) -> bool {
    object.triangles.clone().map(crate::mesh::TriangleId::new).any(|id| {
        let face = scene.mesh.face_normal(id);
        scene.mesh.normals_of(id).is_some_and(|normals| {
            face != [0.0; 3]
                && normals.iter().any(|&normal| super::vector::dot(face, normal) < SAME_NORMAL)
        })
    })
}
