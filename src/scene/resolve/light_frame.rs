//! The frames in which lights are written: the world, the camera, or a mesh.
//!
//! The four ways of moving a light: not at all, with the camera, with an object, or by its own
//! numbers. All of them end in world numbers here, in f64; nothing later knows of frames.

use crate::scene::camera::{PinholeCamera, cross, unit};
use crate::scene::file::text::Faults;
use crate::scene::file::{CameraForm, LightFile, SceneFile, suggestion};
use crate::scene::transform::Transform;

/// Beginning of a `parent` that is a mesh.
const MESH: &str = "mesh:";

/// A frame of points and directions.
#[derive(Clone, Debug)]
pub(super) enum Frame {
    /// World space: numbers stay as they are, bit for bit.
    World,
    /// Right-handed: x right, y up, z backwards.
    Camera {
        /// The eye.
        origin: [f64; 3],
        /// Unit vectors along x, y and z.
        axes: [[f64; 3]; 3],
    },
    /// Object space of a mesh.
    Mesh(Transform),
}

impl Frame {
    /// A point in world space.
    pub(super) fn position(&self, p: [f64; 3]) -> [f64; 3] {
        match self {
            Self::World => p,
            Self::Camera { origin, axes } => {
                let way = along(axes, p);
                std::array::from_fn(|k| origin[k] + way[k])
            }
            Self::Mesh(transform) => transform.position(p),
        }
    }

    /// A direction in world space; its length may change.
    pub(super) fn direction(&self, v: [f64; 3]) -> [f64; 3] {
        match self {
            Self::World => v,
            Self::Camera { axes, .. } => along(axes, v),
            Self::Mesh(transform) => transform.direction(v),
        }
    }
}

fn along([x, y, z]: &[[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| v[0] * x[k] + v[1] * y[k] + v[2] * z[k])
}

/// All frames of a scene.
pub(super) struct Frames<'a> {
    camera: Option<Frame>,
    /// Names and transforms of the meshes that have a name.
    meshes: Vec<(&'a str, &'a Transform)>,
    /// Whether a mesh had faults, and may be the one that is meant.
    meshes_lack: bool,
}

impl<'a> Frames<'a> {
    /// Collects the frames, and reports names that two meshes have.
    pub(super) fn new(
        file: &'a SceneFile,
        camera: Option<&PinholeCamera>,
        transforms: &'a [Transform],
        faults: &mut Faults<'_>,
    ) -> Self {
        let mut meshes: Vec<(&str, &Transform)> = Vec::new();
        for (mesh, transform) in file.meshes.iter().zip(transforms) {
            let Some(written) = &mesh.name else { continue };
            let name = written.get_ref().as_str();
            if meshes.iter().any(|(taken, _)| *taken == name) {
                let message = format!("the name `{name}` is taken by another mesh");
                faults.at(&written.span(), message);
            }
            meshes.push((name, transform));
        }
        let form = file.camera.as_ref().map(|camera| &camera.form);
        let camera = camera.zip(form).map(|(camera, form)| camera_frame(camera, form));
        Self { camera, meshes, meshes_lack: file.meshes_lack }
    }

    /// The frame in which a light is written; `None` where there is none, which was reported.
    pub(super) fn of(&self, light: &LightFile, faults: &mut Faults<'_>) -> Option<Frame> {
        let Some(parent) = &light.parent else { return Some(Frame::World) };
        let word = parent.get_ref().as_str();
        let Some(name) = word.strip_prefix(MESH) else {
            return match word {
                "world" => Some(Frame::World),
                "camera" => self.camera.clone(),
                other => {
                    let message = format!("there is no frame `{other}`");
                    let help = suggestion(other, &["world", "camera", "mesh:NAME"]);
                    faults.at_with_help(&parent.span(), message, help);
                    None
                }
            };
        };
        let found = self.meshes.iter().find(|(known, _)| *known == name);
        if found.is_none() && !self.meshes_lack {
            let message = format!("there is no mesh `{name}`");
            let known: Vec<&str> = self.meshes.iter().map(|(name, _)| *name).collect();
            let help = match known.is_empty() {
                true => "no `[[mesh]]` has a `name`".to_owned(),
                false => suggestion(name, &known),
            };
            faults.at_with_help(&parent.span(), message, help);
        }
        found.map(|(_, transform)| Frame::Mesh((*transform).clone()))
    }
}

/// A look-at camera's frame by its own numbers, which no size of the image changes; that of the
/// others by the directions of the rays.
fn camera_frame(camera: &PinholeCamera, form: &CameraForm) -> Frame {
    let (right, back) = match form {
        CameraForm::LookAt { eye, target, up, .. } => {
            let back = std::array::from_fn(|k| eye.get_ref()[k] - target.get_ref()[k]);
            let back = unit(back).unwrap_or(camera.axis().map(|c| -c));
            (unit(*up.get_ref()).and_then(|up| unit(cross(up, back))), back)
        }
        _ => (None, camera.axis().map(|c| -c)),
    };
    // DX of a camera has a direction.
    let right = right.or_else(|| unit(camera.dx())).unwrap_or([1.0, 0.0, 0.0]);
    Frame::Camera { origin: camera.eye(), axes: [right, cross(back, right), back] }
}
