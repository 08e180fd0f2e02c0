//! A scene for a mesh file that has none: a camera that sees all of it, or the one that was typed, and
//! the sun.

use super::failure::Failure;
use std::path::Path;
use truecast::pixel::Resolution;
use truecast::scene::camera::PinholeCamera;
use truecast::scene::{Overrides, Scene};

/// The frame of a mesh file unless another size is asked for.
const FRAME: (u32, u32) = (1920, 1080);

/// Angle of view unless another is asked for, degrees.
pub(super) const FIELD_OF_VIEW_DEG: f64 = 40.0;

/// Towards the eye from the middle of the mesh: a corner of the view, a little from above.
const FROM: [f64; 3] = [0.6, 0.45, 0.66];

/// Room about the sphere around the mesh's box.
const ROOM: f64 = 1.05;

/// Where from, where to.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    pub(super) eye_and_target: Option<[[f64; 3]; 2]>,
    pub(super) fov_y_deg: f64,
}

/// Whether a file is to be framed rather than read as a scene.
pub(super) fn is_mesh(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("obj"))
}

/// The scene of a mesh file.
pub(super) fn scene_of(
    path: &Path,
    view: View,
    resolution: Option<Resolution>,
) -> Result<Scene, Failure> {
    let (width, height) = resolution.map_or(FRAME, |size| (size.width(), size.height()));
    let file = toml::Value::from(path.display().to_string());
    let text = format!(
        "version = 1\n\
         image = {{ width = {width}, height = {height} }}\n\
         camera = {{ eye = [0, 0, 1], target = [0, 0, 0], up = [0, 1, 0], fov_y_deg = 40 }}\n\
         mesh = [{{ file = {file} }}]\n\
         light = [{{ type = \"directional\", aim = [-0.4, -1.0, -0.6], intensity = [1, 1, 1] }}]\n"
    );
    let mut scene = Scene::from_toml(&text, path, Path::new(""), &Overrides::default())?;
    let [eye, target] = view.eye_and_target.unwrap_or_else(|| around(&scene, view.fov_y_deg));
    let frame = scene.camera.resolution();
    scene.camera = PinholeCamera::look_at(frame, eye, target, [0.0, 1.0, 0.0], view.fov_y_deg)
        .map_err(|error| Failure::usage(format!("{}: {error}", path.display())))?;
    Ok(scene)
}

/// Eye and target of a view of the whole mesh.
fn around(scene: &Scene, fov_y_deg: f64) -> [[f64; 3]; 2] {
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for position in &scene.mesh.positions {
        for (k, &component) in position.iter().enumerate() {
            low[k] = low[k].min(f64::from(component));
            high[k] = high[k].max(f64::from(component));
        }
    }
    if scene.mesh.is_empty() {
        return [[0.0, 0.0, 1.0], [0.0; 3]];
    }
    let middle: [f64; 3] = std::array::from_fn(|k| 0.5 * low[k] + 0.5 * high[k]);
    let radius =
        (0..3).map(|k| (0.5 * high[k] - 0.5 * low[k]).powi(2)).sum::<f64>().sqrt().max(1e-9);
    let length = FROM.iter().map(|c| c * c).sum::<f64>().sqrt();
    let distance = ROOM * radius / (0.5 * fov_y_deg.to_radians()).sin();
    [std::array::from_fn(|k| middle[k] + distance * FROM[k] / length), middle]
}
