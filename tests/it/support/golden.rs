//! The golden scenes: 17 × 17 pixels each, with the id, the cover count and the signed count of
//! every pixel, computed in rational arithmetic by a program of its own, not by this crate.

use serde::Deserialize;
use truecast::pixel::Resolution;
use truecast::scene::Scene;
use truecast::scene::camera::PinholeCamera;

/// A scene with its known answers, row by row.
pub(crate) struct Golden {
    pub(crate) name: String,
    pub(crate) scene: Scene,
    /// The visible triangle.
    pub(crate) ids: Vec<Option<u32>>,
    /// How many triangles cover the sample.
    pub(crate) cover: Vec<u32>,
    /// Σ sgn V over them.
    pub(crate) signed: Vec<i32>,
}

#[derive(Deserialize)]
struct Written {
    name: String,
    width: u32,
    height: u32,
    camera: WrittenCamera,
    triangles: Vec<[[f64; 3]; 3]>,
    ids: Vec<i64>,
    cover_count: Vec<u32>,
    signed_count: Vec<i32>,
}

#[derive(Deserialize)]
struct WrittenCamera {
    eye: [f64; 3],
    d0: [f64; 3],
    dx: [f64; 3],
    dy: [f64; 3],
}

/// All golden scenes.
pub(crate) fn scenes() -> Vec<Golden> {
    let written: Vec<Written> = serde_json::from_str(include_str!("../golden/visibility.json"))
        .expect("the golden scenes are well formed");
    written.into_iter().map(read).collect()
}

/// The golden scene of that name.
pub(crate) fn scene(name: &str) -> Golden {
    scenes().into_iter().find(|golden| golden.name == name).expect("a golden scene of that name")
}

fn read(written: Written) -> Golden {
    let WrittenCamera { eye, d0, dx, dy } = written.camera;
    let resolution = Resolution::new(written.width, written.height).unwrap();
    let camera = PinholeCamera::exact(resolution, eye, d0, dx, dy).unwrap();
    assert_eq!((camera.d0(), camera.dx(), camera.dy()), (d0, dx, dy), "lies on the lattice");
    let triangles: Vec<_> =
        written.triangles.iter().map(|corners| corners.map(|v| v.map(single))).collect();
    let pixels = resolution.window().len();
    let lengths = [written.ids.len(), written.cover_count.len(), written.signed_count.len()];
    assert_eq!(lengths, [pixels; 3], "{}", written.name);
    Golden {
        scene: Scene::from_triangles(camera, &triangles),
        ids: written.ids.iter().map(|&id| u32::try_from(id).ok()).collect(),
        cover: written.cover_count,
        signed: written.signed_count,
        name: written.name,
    }
}

/// The f32 that was written: the reader of the text may miss the last bit of the f64 (2^-52), far
/// less than half a step of f32 (2^-25).
fn single(value: f64) -> f32 {
    let single = value as f32;
    assert!(
        (f64::from(single) - value).abs() <= value.abs() * 2.0_f64.powi(-50),
        "an f32: {value}"
    );
    single
}
