//! Shading: the radiance of each visible surface point under the scene's lights.
//!
//! Local illumination only: light, surface, eye. What is visible was decided before; nothing here
//! casts a ray. Radiance is linear, unclamped f64, and the same bits on every platform (`libm`'s
//! functions and `power`'s, fixed order of sums), one pixel after the other or several at once. Read `equation` for the equation, `effects` for what a scene
//! calls for, `surface` for the point that is lit.

pub mod blinn_phong;
mod calls;
mod coefficients;
mod corners;
pub mod doubt;
pub mod effects;
mod equation;
mod falloff;
mod flat_faults;
pub mod footprint;
mod frame;
mod geometry;
pub mod hemisphere;
mod kernel;
mod kernel_effects;
mod lanes;
mod lights;
mod method;
mod options;
mod power;
mod reach;
pub mod reflection;
mod specular;
pub mod surface;
pub mod terms;
pub mod texture;
mod vector;
pub mod watch;
mod weights;

pub use calls::{Call, explain};
pub use doubt::doubts;
pub use effects::Effects;
pub use flat_faults::{FlatFault, flat_faults};
pub use frame::{Asker, Occlusion};
pub use options::{Precision, ShadeOptions, single_error};
pub use surface::{SurfacePoint, surface_point};
pub use terms::{LightTerm, Outcome, Terms};
pub use watch::{Evaluations, Notes};

use crate::color::LinearRgb;
use crate::pixel::{self, Pixel};
use crate::scene::Scene;
use crate::scene::material::Material;
use crate::visibility::{VisibilityBuffer, Visible};
use coefficients::Coefficients;
use equation::Lighting;
use frame::Frame;
use geometry::Geometry;
use kernel::RowKernel;
use kernel_effects::KernelEffects;
use method::Method;
use std::sync::Mutex;
use watch::{Nobody, Ungated, Watch};
use weights::weights;

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
/// row, from any thread. The buffer must be an answer about this scene. Nothing casts a shadow; see
/// [`shade_with_shadows`].
pub fn shade(
    scene: &Scene,
    buffer: &VisibilityBuffer,
    effects: Effects,
    done: &(dyn Fn() + Sync),
) -> Shaded {
    shade_with(scene, buffer, &ShadeOptions::new(effects), None, done)
}

/// As [`shade`] and, with somebody to ask, [`shade_with_shadows`], by instructions of choice.
pub fn shade_with<'a>(
    scene: &'a Scene,
    buffer: &VisibilityBuffer,
    options: &ShadeOptions,
    occlusion: Option<Occlusion<'a>>,
    done: &(dyn Fn() + Sync),
) -> Shaded {
    let mut radiance = vec![[0.0; 3]; buffer.window.len()];
    let notes = shade_into(scene, buffer, options, occlusion, &mut radiance, done);
    Shaded { radiance, notes }
}

/// As [`shade_with`], into a picture that is there already: one number triple per pixel of the
/// buffer's window.
pub fn shade_into<'a>(
    scene: &'a Scene,
    buffer: &VisibilityBuffer,
    options: &ShadeOptions,
    occlusion: Option<Occlusion<'a>>,
    radiance: &mut [LinearRgb],
    done: &(dyn Fn() + Sync),
) -> Notes {
    assert_eq!(radiance.len(), buffer.window.len(), "one number triple per pixel");
    let frame = Frame::new(scene, options.effects, occlusion);
    let frame = match options.simd {
        Some(level) => frame.in_lanes(level, options.precision),
        None => frame,
    };
    let kernel = kernel::row_kernel::<Notes>(options.effects);
    shade_frame(&frame, kernel, buffer, radiance, done, Notes::add)
}

/// As [`shade`], with the shadows of the lights that cast some: `occlusion` makes an
/// asker for each row, which is asked whether a light is hidden only where the light would reach
/// the surface.
pub fn shade_with_shadows<'a>(
    scene: &'a Scene,
    buffer: &VisibilityBuffer,
    effects: Effects,
    occlusion: Occlusion<'a>,
    done: &(dyn Fn() + Sync),
) -> Shaded {
    shade_with(scene, buffer, &ShadeOptions::new(effects), Some(occlusion), done)
}

/// How often each effect's term is computed when `buffer` is shaded with `effects`.
pub fn count_evaluations(
    scene: &Scene,
    buffer: &VisibilityBuffer,
    effects: Effects,
) -> Evaluations {
    let frame = Frame::new(scene, effects, None);
    let kernel = kernel::row_kernel::<Evaluations>(effects);
    let mut radiance = vec![[0.0; 3]; buffer.window.len()];
    shade_frame(&frame, kernel, buffer, &mut radiance, &|| (), Evaluations::add)
}

/// The picture of [`shade`], bit for bit, with every effect forced on: every surface is set up in
/// full and every term of every light is evaluated, even where no colour, no light kind or no
/// exponent calls for it. It shows what is saved by evaluating only what a scene calls for, and that
/// the rest is neutral; nothing else should use it. Nothing casts a shadow.
pub fn shade_ungated(scene: &Scene, buffer: &VisibilityBuffer) -> Vec<LinearRgb> {
    let frame = Frame::ungated(scene);
    let kernel = kernel::row_kernel::<Ungated>(Effects::ALL);
    let mut radiance = vec![[0.0; 3]; buffer.window.len()];
    shade_frame(&frame, kernel, buffer, &mut radiance, &|| (), |_, _| ());
    radiance
}

/// Shades all rows, each with a watcher of its own; the watchers are added up, in any order.
fn shade_frame<W: Watch + Default + Copy + Send>(
    frame: &Frame<'_>,
    shade_row: RowKernel<W>,
    buffer: &VisibilityBuffer,
    radiance: &mut [LinearRgb],
    done: &(dyn Fn() + Sync),
    add: fn(&mut W, W),
) -> W {
    let window = buffer.window;
    let width = window.width() as usize;
    let total = Mutex::new(W::default());
    pixel::for_each_row(radiance, width, done, |row, out| {
        let mut watch = W::default();
        let visible = &buffer.visible[row * width..][..out.len()];
        shade_row(frame, window, window.y0() + row as u32, visible, out, &mut watch);
        // A poisoned lock means that another row panicked; its panic is the one to report.
        if let Ok(mut total) = total.lock() {
            add(&mut total, watch);
        }
    });
    match total.into_inner() {
        Ok(total) => total,
        Err(poisoned) => poisoned.into_inner(),
    }
}

/// The radiance of one surface point under all lights of the scene, with every effect on and
/// nothing between it and the lights.
pub fn shade_point(scene: &Scene, point: &SurfacePoint, material: &Material) -> LinearRgb {
    let frame = Frame::new(scene, Effects::ALL, None);
    let coefficients = Coefficients::of(material, frame.rules);
    let geometry = Geometry {
        position: point.position,
        to_eye: point.to_eye,
        normal: point.shading_normal,
        normal_length: 1.0,
        mixture: None,
    };
    equation::radiance_of::<{ KernelEffects::ALL }, _>(
        &frame,
        &coefficients,
        Some(&geometry),
        Lighting::OPEN,
        &mut Nobody,
    )
}

/// The radiance of one visible pixel, as [`shade_with_shadows`] computes it.
pub fn shade_visible<'a>(
    scene: &'a Scene,
    pixel: Pixel,
    visible: &Visible,
    occlusion: Option<Occlusion<'a>>,
) -> LinearRgb {
    terms(scene, pixel, visible, occlusion).sum()
}

/// Every light's term at a visible pixel; their sum is the shaded pixel bit for bit.
pub fn terms<'a>(
    scene: &'a Scene,
    pixel: Pixel,
    visible: &Visible,
    occlusion: Option<Occlusion<'a>>,
) -> Terms {
    const ALL: u8 = KernelEffects::ALL;
    let (surface, _) = surface_point(scene, pixel, visible);
    let (object, _) = scene.object_of(visible.triangle);
    let (_, material) = scene.material_of(visible.triangle);
    let frame = Frame::new(scene, Effects::ALL, occlusion);
    let coefficients = coefficients::at_pixel(&frame, pixel, visible, material, &mut Nobody);
    let asker = frame.asker();
    let is_hidden = |light| frame::is_hidden(&asker, pixel, visible, light);
    let lights_at = |geometry: Option<&Geometry>| {
        let mut lights = vec![LightTerm::DARK; scene.lights.len()];
        let lighting = Lighting { reaches: &[], is_hidden: &is_hidden };
        equation::radiance_of::<ALL, _>(&frame, &coefficients, geometry, lighting, &mut lights);
        lights
    };
    if let Some(color) = kernel::unlit_color(&frame, visible, &coefficients, &mut Nobody) {
        let lights = vec![LightTerm::DARK; scene.lights.len()];
        return Terms { surface, emission: color, lights, elsewhere: Vec::new() };
    }
    let method = frame.methods[object];
    let mut elsewhere = Vec::new();
    let lights = match method {
        Method::VertexColors => vec![LightTerm::DARK; scene.lights.len()],
        Method::SmoothPixel | Method::FlatPixel => {
            let is_smooth = method == Method::SmoothPixel;
            let geometry = geometry::geometry_at_pixel::<ALL, _>(
                &frame,
                &geometry::Seen { pixel, visible, position: None },
                is_smooth,
                &coefficients,
                &mut Nobody,
            );
            lights_at(geometry.as_ref())
        }
        Method::SmoothCorners | Method::FlatCorners => {
            let weights = weights(scene, visible, &mut Nobody);
            let is_smooth = method == Method::SmoothCorners;
            elsewhere.extend(weights.into_iter().enumerate().map(|(corner, weight)| {
                let point = corners::at_corner(&frame, visible, corner, is_smooth, &mut Nobody);
                (weight, lights_at(Some(&point)))
            }));
            elsewhere[2].1.clone()
        }
        Method::Centroid | Method::LastCorner => {
            let point = match method {
                Method::Centroid => corners::at_centroid(&frame, visible, &mut Nobody),
                _ => corners::at_corner(&frame, visible, 2, true, &mut Nobody),
            };
            elsewhere.push((1.0, lights_at(Some(&point))));
            elsewhere[0].1.clone()
        }
    };
    Terms { surface, emission: coefficients.emission, lights, elsewhere }
}
