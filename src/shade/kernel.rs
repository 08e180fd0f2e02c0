//! Kernels over rows of pixels, compiled from one body for sets of effects, and the table that
//! picks one.
//!
//! The body of the equation is in `equation`; only the loop and the set-up of surfaces are here.

use super::effects::Effects;
use super::equation::{Geometry, KernelEffects, radiance_of};
use super::lights::{self, Origin, PreparedLight, is_black};
use super::surface;
use super::watch::{Note, Watch};
use crate::color::LinearRgb;
use crate::pixel::{Pixel, Window};
use crate::scene::Scene;
use crate::visibility::Visible;

/// What is the same at every pixel.
pub(super) struct Frame<'a> {
    pub(super) scene: &'a Scene,
    pub(super) effects: Effects,
    pub(super) lights: Vec<PreparedLight>,
    /// Whether any light has a direction: without one no surface is set up.
    directed: bool,
}

impl<'a> Frame<'a> {
    pub(super) fn new(scene: &'a Scene, effects: Effects) -> Self {
        let lights = lights::prepare(&scene.lights, effects);
        let directed = lights.iter().any(|light| !matches!(light.origin, Origin::Nowhere));
        Self { scene, effects, lights, directed }
    }
}

/// Shades one row of a window: `visible` and `radiance` hold its pixels.
pub(super) type RowKernel<W> =
    fn(&Frame<'_>, Window, u32, &[Option<Visible>], &mut [LinearRgb], &mut W);

/// The kernel for a set of effects: entry n of the table is compiled for set n.
pub(super) fn row_kernel<W: Watch>(effects: Effects) -> RowKernel<W> {
    let table: [RowKernel<W>; 16] = [
        shade_row::<0, W>,
        shade_row::<1, W>,
        shade_row::<2, W>,
        shade_row::<3, W>,
        shade_row::<4, W>,
        shade_row::<5, W>,
        shade_row::<6, W>,
        shade_row::<7, W>,
        shade_row::<8, W>,
        shade_row::<9, W>,
        shade_row::<10, W>,
        shade_row::<11, W>,
        shade_row::<12, W>,
        shade_row::<13, W>,
        shade_row::<14, W>,
        shade_row::<15, W>,
    ];
    table[KernelEffects::of(effects).index()]
}

fn shade_row<const E: u8, W: Watch>(
    frame: &Frame<'_>,
    window: Window,
    y: u32,
    visible: &[Option<Visible>],
    radiance: &mut [LinearRgb],
    watch: &mut W,
) {
    for ((x, visible), out) in (window.x0()..).zip(visible).zip(radiance) {
        *out = match visible {
            Some(visible) => shade_pixel::<E, W>(frame, Pixel { x, y }, visible, watch),
            None => frame.scene.background,
        };
        if !out.iter().all(|value| value.is_finite()) {
            watch.note(Note::NonFinite);
        }
    }
}

fn shade_pixel<const E: u8, W: Watch>(
    frame: &Frame<'_>,
    pixel: Pixel,
    visible: &Visible,
    watch: &mut W,
) -> LinearRgb {
    let effects = const { KernelEffects(E) };
    let (_, material) = frame.scene.material_of(visible.triangle);
    // Set up the surface only where a light can see it.
    let reflects =
        !is_black(material.kd) || effects.has(KernelEffects::SPECULAR) && !is_black(material.ks);
    let geometry = (frame.directed && reflects).then(|| Geometry {
        position: if effects.has(KernelEffects::POSITIONAL) {
            surface::position(frame.scene, pixel, visible)
        } else {
            [0.0; 3]
        },
        to_eye: if effects.has(KernelEffects::SPECULAR) {
            surface::to_eye(frame.scene, pixel)
        } else {
            [0.0; 3]
        },
        normal: if effects.has(KernelEffects::NORMALS) {
            surface::shading_normal::<true, W>(frame.scene, visible, watch)
        } else {
            surface::shading_normal::<false, W>(frame.scene, visible, watch)
        },
    });
    radiance_of::<E, W>(frame, material, geometry.as_ref(), watch)
}
