//! The oracle bundle: triangles, camera and the exact answer of every pixel, as files that any
//! program in any language can read and test itself against.
//!
//! | file | holds |
//! |---|---|
//! | `triangles.npy` | (n, 3, 3) f32: the corners of each triangle, world space, by id |
//! | `camera.json` | `eye`, `d0`, `dx`, `dy`, `width`, `height`; numbers read back bit for bit |
//! | `prim.npy` | (h, w) u32: id of the visible triangle, 0xFFFF_FFFF where nothing is |
//! | `t_lo.npy`, `t_hi.npy` | (h, w) f64: certain bounds of the ray parameter, 0 where nothing is |
//! | `cover.npy` | (h, w) u32: how many triangles the ray crosses, at any depth |
//! | `facing.npy` | (h, w) i8: +1 counter-clockwise as seen, −1 clockwise, 0 where nothing is |
//! | `tie.npy` | (h, w) u8: 1 where the sample lies on an edge or at a shared depth: the tie rule decided |
//! | `stable.npy` | (h, w) u8: 1 where the answer is certainly the same within ±1/256 pixel |
//! | `sources.json` | per mesh: its range of ids, its name, its file and the line of each triangle |
//!
//! The ray of pixel (i, j), column and row from the top left, is eye + t·d, t > 0, with
//! d = d0 + (i + ½)·dx + (j + ½)·dy, and no operation of that rounds in f64. All arrays are little
//! endian and in C order. A bundle is the caster's answer; it asks neither the rasterizer nor the
//! arbiter (that is `check`), and it does not shade.

mod folder;
mod planes;
mod sources;
mod spool;

pub use folder::check_folder;

use crate::accel::{Accelerator, BuildPreset};
use crate::film::FilmError;
use crate::render::Progress;
use crate::scene::Scene;
use folder::Failing;
use spool::Spool;
use std::io::Write as _;
use std::path::Path;

/// The files of a bundle.
pub const FILES: [&str; 10] = [
    "triangles.npy",
    "camera.json",
    "prim.npy",
    "t_lo.npy",
    "t_hi.npy",
    "cover.npy",
    "facing.npy",
    "tie.npy",
    "stable.npy",
    "sources.json",
];

/// What the pixels of a bundle hold.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PixelCounts {
    /// Pixels at which a triangle is visible.
    pub covered: u64,
    /// Pixels that the tie rule decided.
    pub tied: u64,
    /// Pixels that are not stable.
    pub unstable: u64,
}

/// A bundle that is complete but has no place yet. Its files have no names: should the program
/// end here, however it does, nothing is left behind.
#[derive(Debug)]
pub struct Bundle {
    files: Vec<Spool>,
    /// What the pixels hold.
    pub counts: PixelCounts,
}

/// Answers every pixel of the scene's frame and spools the bundle beside `folder`, where it will
/// go. Pixels are answered in bands, so memory does not grow with the picture.
///
/// # Errors
/// [`FilmError::Write`] when files cannot be written there.
pub fn assemble(
    scene: &Scene,
    folder: &Path,
    progress: &dyn Progress,
) -> Result<Bundle, FilmError> {
    let failing = Failing::new(folder);
    let create = |name| Spool::create(name, folder);
    let mut files = Vec::new();
    // Write what does not depend on the answer.
    let mut triangles = create("triangles.npy")?;
    triangles
        .write_array(&[scene.mesh.len() as u64, 3, 3], "<f4", |array| {
            scene.mesh.ids().try_for_each(|id| {
                array.extend(scene.mesh.triangle(id).as_flattened().iter().copied())
            })
        })
        .map_err(|error| failing.because(&error))?;
    files.push(triangles);
    let mut camera = create("camera.json")?;
    let text = format!("{:#}\n", describe_camera(scene));
    camera.file().write_all(text.as_bytes()).map_err(|error| failing.because(&error))?;
    files.push(camera);
    let mut sources = create("sources.json")?;
    sources::write(scene, sources.file()).map_err(|error| failing.because(&error))?;
    files.push(sources);
    // Answer the pixels.
    progress.begin("build", 1);
    let accelerator = Accelerator::build(&scene.mesh, BuildPreset::Medium);
    progress.step();
    let mut spools = planes::NAMES.map(create).into_iter().collect::<Result<Vec<_>, _>>()?;
    let counts = planes::write(scene, &accelerator, &mut spools, progress)
        .map_err(|error| failing.because(&error))?;
    files.extend(spools);
    Ok(Bundle { files, counts })
}

impl Bundle {
    /// Puts the bundle in its place, in one step, and hands back the number of bytes.
    ///
    /// An empty folder and a former bundle are replaced; between the removal of a former bundle
    /// and the arrival of the new one, two renames apart, there is neither.
    ///
    /// # Errors
    /// [`FilmError::Write`], as [`check_folder`]; then everything is as before.
    pub fn place(self, folder: &Path) -> Result<u64, FilmError> {
        folder::place(self.files, folder)
    }
}

/// `camera.json`. serde_json writes the shortest text that reads back as the same f64.
fn describe_camera(scene: &Scene) -> serde_json::Value {
    let camera = &scene.camera;
    serde_json::json!({
        "schema": "truecast/camera/1",
        "eye": camera.eye(),
        "d0": camera.d0(),
        "dx": camera.dx(),
        "dy": camera.dy(),
        "width": camera.resolution().width(),
        "height": camera.resolution().height(),
    })
}
