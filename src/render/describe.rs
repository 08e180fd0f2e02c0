//! What a picture was made of, as one canonical JSON document: the film's description.
//!
//! Only what decides the picture's bits: scene digest, camera lattice, switches, accuracy and
//! effects. Not threads or times, which change no bit, nor the path, unless the answer is one path's own.
//! Keys are sorted.

use super::{Accuracy, VisibilityPath};
use crate::raster::Unproven;
use crate::scene::Scene;
use crate::scene::hash::content_hash;
use crate::scene::sampling::SampleGrid;
use crate::shade;
use serde_json::{Value, json};

/// Schema of the document.
const SCHEMA: &str = "truecast/picture/1";

/// Describes how a picture of this scene is made.
pub fn describe(scene: &Scene, accuracy: Accuracy) -> Value {
    let camera = &scene.camera;
    let effects: Vec<_> =
        shade::explain(scene).into_iter().filter(|call| call.on).map(|call| call.effect).collect();
    let mut document = json!({
        "schema": SCHEMA,
        "scene_sha256": content_hash(scene),
        "accuracy": accuracy.name(),
        "camera": {
            "eye": camera.eye(),
            "d0": camera.d0(),
            "dx": camera.dx(),
            "dy": camera.dy(),
            "width": camera.resolution().width(),
            "height": camera.resolution().height(),
            "axis": camera.axis(),
            "z_per_t": camera.z_per_t(),
        },
        "dialect": scene.switches.dialect,
        "switches": scene.switches.table(),
        "effects": effects,
    });
    if scene.samples != SampleGrid::CENTRE {
        document["samples"] = json!(scene.samples.side());
    }
    if let Some(path) = accuracy.path() {
        document["path"] = json!(match path {
            VisibilityPath::Cast => "cast",
            VisibilityPath::Raster => "raster",
        });
    }
    if let Accuracy::Raster(unproven) = accuracy {
        if let Unproven::Watertight { subpixel_bits, .. } = unproven {
            document["subpixel_bits"] = json!(subpixel_bits.get());
        }
        if let Some(buffer) = unproven.depth_buffer() {
            document["depth_buffer"] = json!({
                "bits": buffer.format().bits(), "near": buffer.near(), "far": buffer.far(),
            });
        }
    }
    document
}
