//! The golden pictures: ids, cover counts and signed counts of 26 scenes of 17 × 17 pixels.

use super::Triangles;
use serde_json::Value;
use truecast::pixel::Resolution;
use truecast::scene::Scene;
use truecast::scene::camera::PinholeCamera;

/// A scene and what is to be seen in it, row by row; id −1 is nothing.
pub(crate) struct Golden {
    pub(crate) name: String,
    pub(crate) scene: Scene,
    pub(crate) triangles: Triangles,
    pub(crate) ids: Vec<i64>,
    pub(crate) cover: Vec<i64>,
    pub(crate) signed: Vec<i64>,
}

/// Pictures computed by rational arithmetic in a program of its own.
pub(crate) fn goldens() -> Vec<Golden> {
    let text = include_str!("../golden/visibility.json");
    let scenes: Vec<Value> = serde_json::from_str(text).unwrap();
    let vector = |v: &Value| -> [f64; 3] { [0, 1, 2].map(|k| v[k].as_f64().unwrap()) };
    let integers = |v: &Value| v.as_array().unwrap().iter().map(|i| i.as_i64().unwrap()).collect();
    scenes
        .iter()
        .map(|s| {
            let frame = Resolution::new(
                s["width"].as_u64().unwrap() as u32,
                s["height"].as_u64().unwrap() as u32,
            );
            let [eye, d0, dx, dy] = ["eye", "d0", "dx", "dy"].map(|k| vector(&s["camera"][k]));
            let camera = PinholeCamera::exact(frame.unwrap(), eye, d0, dx, dy).unwrap();
            let triangles: Triangles = s["triangles"]
                .as_array()
                .unwrap()
                .iter()
                .map(|t| [0, 1, 2].map(|k| vector(&t[k]).map(|c| c as f32)))
                .collect();
            Golden {
                name: s["name"].as_str().unwrap().to_owned(),
                scene: Scene::from_triangles(camera, &triangles),
                triangles,
                ids: integers(&s["ids"]),
                cover: integers(&s["cover_count"]),
                signed: integers(&s["signed_count"]),
            }
        })
        .collect()
}
