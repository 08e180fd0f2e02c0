//! Shading: the radiance of each visible surface point under the scene's lights.
//!
//! Local illumination only: light, surface, eye. What is visible was decided before; nothing here
//! casts a ray. Radiance is linear, unclamped f64, and the same bits on every platform (`libm`'s
//! functions, fixed order of sums). Read `equation` for the equation, `effects` for what a scene
//! calls for, `surface` for the point that is lit.

pub mod blinn_phong;
mod calls;
pub mod effects;
mod equation;
pub mod footprint;
mod kernel;
mod lights;
pub mod reflection;
pub mod surface;
pub mod terms;
pub mod texture;
mod vector;
pub mod watch;

pub use calls::{Call, explain};
pub use effects::Effects;
pub use surface::{SurfacePoint, surface_point};
pub use terms::{LightTerm, Outcome, Terms};
pub use watch::{Evaluations, Notes};

use crate::color::LinearRgb;
use crate::pixel::{self, Pixel};
use crate::scene::Scene;
use crate::scene::material::Material;
use crate::visibility::{VisibilityBuffer, Visible};
use equation::{Geometry, KernelEffects};
use kernel::Frame;
use std::sync::Mutex;
use watch::{Nobody, Watch};

/// A shaded window.
#[derive(Clone, Debug, PartialEq)]
pub struct Shaded {
    /// Linear, unclamped radiance per pixel of the buffer's window, row by row; the scene's
    /// background where nothing is visible.
    pub radiance: Vec<LinearRgb>,
    /// Doubtful cases that were met.
    pub notes: Notes,
}

/// Shades every pixel of a visibility buffer, rows in parallel.
///
/// `effects` is what is evaluated: with every set that contains [`Effects::of`] the picture is
/// the same bit for bit, a smaller one leaves those terms out. `done` is called once per finished
/// row, from any thread. The buffer must be an answer about this scene.
pub fn shade(
    scene: &Scene,
    buffer: &VisibilityBuffer,
    effects: Effects,
    done: &(dyn Fn() + Sync),
) -> Shaded {
    let (radiance, notes) = shade_rows(scene, buffer, effects, done, Notes::add);
    Shaded { radiance, notes }
}

/// How often each effect's term is computed when `buffer` is shaded with `effects`.
pub fn count_evaluations(
    scene: &Scene,
    buffer: &VisibilityBuffer,
    effects: Effects,
) -> Evaluations {
    shade_rows(scene, buffer, effects, &|| (), Evaluations::add).1
}

/// Shades all rows, each with a watcher of its own; the watchers are added up, in any order.
fn shade_rows<W: Watch + Default + Copy + Send>(
    scene: &Scene,
    buffer: &VisibilityBuffer,
    effects: Effects,
    done: &(dyn Fn() + Sync),
    add: fn(&mut W, W),
) -> (Vec<LinearRgb>, W) {
    let window = buffer.window;
    let width = window.width() as usize;
    let frame = Frame::new(scene, effects);
    let shade_row = kernel::row_kernel::<W>(effects);
    let total = Mutex::new(W::default());
    let mut radiance = vec![[0.0; 3]; window.len()];
    pixel::for_each_row(&mut radiance, width, done, |row, out| {
        let mut watch = W::default();
        let visible = &buffer.visible[row * width..][..out.len()];
        shade_row(&frame, window, window.y0() + row as u32, visible, out, &mut watch);
        // A poisoned lock means that another row panicked; its panic is the one to report.
        if let Ok(mut total) = total.lock() {
            add(&mut total, watch);
        }
    });
    let total = match total.into_inner() {
        Ok(total) => total,
        Err(poisoned) => poisoned.into_inner(),
    };
    (radiance, total)
}

/// The radiance of one surface point under all lights of the scene, with every effect on.
pub fn shade_point(scene: &Scene, point: &SurfacePoint, material: &Material) -> LinearRgb {
    let frame = Frame::new(scene, Effects::ALL);
    equation::radiance_of::<{ KernelEffects::ALL }, _>(
        &frame,
        material,
        Some(&Geometry::of(point)),
        &mut Nobody,
    )
}

/// The radiance of one visible pixel, as [`shade`] computes it.
pub fn shade_visible(scene: &Scene, pixel: Pixel, visible: &Visible) -> LinearRgb {
    terms(scene, pixel, visible).sum()
}

/// Every light's term at a visible pixel; their sum is the shaded pixel bit for bit.
pub fn terms(scene: &Scene, pixel: Pixel, visible: &Visible) -> Terms {
    let (surface, _) = surface_point(scene, pixel, visible);
    let (_, material) = scene.material_of(visible.triangle);
    let frame = Frame::new(scene, Effects::ALL);
    let mut lights = vec![LightTerm::DARK; scene.lights.len()];
    let geometry = Geometry::of(&surface);
    equation::radiance_of::<{ KernelEffects::ALL }, _>(
        &frame,
        material,
        Some(&geometry),
        &mut lights,
    );
    Terms { surface, emission: material.ke, lights }
}

impl Geometry {
    fn of(point: &SurfacePoint) -> Self {
        Self { position: point.position, to_eye: point.to_eye, normal: point.shading_normal }
    }
}
