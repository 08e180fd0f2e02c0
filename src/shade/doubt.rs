//! Doubtful cases pixel by pixel: which of them shading met at a pixel's centre, as bits.
//!
//! The counts over a whole picture are [`super::Notes`]; the pixel's own colour is not looked at.

use super::effects::Effects;
use super::frame::Frame;
use super::kernel;
use super::watch::{Note, Watch};
use crate::pixel;
use crate::scene::Scene;
use crate::visibility::VisibilityBuffer;

/// A light lies at the surface point: [`super::Notes::lights_at_surface`].
pub const LIGHT_AT_SURFACE: u32 = 1;
/// A light's side of the terminator is in doubt: [`super::Notes::near_terminator`].
pub const NEAR_TERMINATOR: u32 = 1 << 1;
/// L = −V: [`super::Notes::opposite_view`].
pub const OPPOSITE_VIEW: u32 = 1 << 2;
/// The interpolated normal cancelled: [`super::Notes::cancelled_normals`].
pub const CANCELLED_NORMAL: u32 = 1 << 3;
/// The face has no normal in f64: [`super::Notes::missing_normals`].
pub const MISSING_NORMAL: u32 = 1 << 4;
/// Interpolated directions cancelled: [`super::Notes::cancelled_vectors`].
pub const CANCELLED_VECTORS: u32 = 1 << 5;
/// Weights stayed perspective-correct: [`super::Notes::perspective_kept`].
pub const PERSPECTIVE_KEPT: u32 = 1 << 6;
/// The radiance is beyond the range, of f32 in a file or of f64 before.
pub const BEYOND_RANGE: u32 = 1 << 7;

/// The bits of one pixel.
#[derive(Default)]
struct Doubts(u32);

impl Watch for Doubts {
    fn note(&mut self, note: Note) {
        self.0 |= match note {
            Note::LightAtSurface => LIGHT_AT_SURFACE,
            Note::NearTerminator => NEAR_TERMINATOR,
            Note::OppositeView => OPPOSITE_VIEW,
            Note::CancelledNormal => CANCELLED_NORMAL,
            Note::MissingNormal => MISSING_NORMAL,
            Note::CancelledVectors => CANCELLED_VECTORS,
            Note::PerspectiveKept => PERSPECTIVE_KEPT,
            Note::NonFinite => BEYOND_RANGE,
        };
    }
}

/// Per pixel of a buffer, the doubtful cases that shading it with `effects` meets; 0 where there is
/// none. A light counts where it is hidden too: shadows are not asked for.
///
/// A case at a corner, whose colour neighbouring pixels share, is met by every one of them, where
/// [`super::Notes`] count it as often as the colour is computed.
pub fn doubts(scene: &Scene, buffer: &VisibilityBuffer, effects: Effects) -> Vec<u32> {
    let window = buffer.window;
    let width = window.width() as usize;
    let frame = Frame::new(scene, effects, None);
    let shade_pixels = kernel::row_kernel::<Doubts>(effects);
    let mut bits = vec![0; window.len()];
    pixel::for_each_row(&mut bits, width, &|| (), |row, bits| {
        let visible = buffer.visible[row * width..].chunks(1);
        for (column, (visible, bits)) in visible.zip(bits).enumerate() {
            let pixel = window.pixel(row * width + column);
            let only = pixel::Window::new(
                scene.camera.resolution(),
                pixel.x,
                pixel.y,
                pixel.x + 1,
                pixel.y + 1,
            );
            let Some(only) = only else { continue };
            let (mut radiance, mut doubts) = ([[0.0; 3]], Doubts::default());
            shade_pixels(&frame, only, pixel.y, visible, &mut radiance, &mut doubts);
            *bits = doubts.0;
        }
    });
    bits
}
