//! Colours that are lit elsewhere than at the pixel: at the corners (Gouraud), at the centroid or at
//! the last corner (flat, in two of its meanings).
//!
//! Such a colour depends on the triangle and its facing alone, so neighbouring pixels share it.
//! Sources: Gouraud, "Continuous Shading of Curved Surfaces" (1971), by way of Curless, "Shading"
//! and IIT, "Gouraud Surface Rendering"; OpenGL's provoking vertex.

use super::frame::Frame;
use super::geometry::Geometry;
use super::surface;
use super::watch::Watch;
use crate::color::LinearRgb;
use crate::mesh::TriangleId;
use crate::visibility::{Facing, Visible};

/// The colours of the triangle that was shaded last.
#[derive(Default)]
pub(super) struct Memo {
    key: Option<(TriangleId, Facing)>,
    colors: [LinearRgb; 3],
}

impl Memo {
    /// The colours of a triangle, computed anew unless they are those of the last one; always anew
    /// where they depend on the pixel, as shadows do.
    pub(super) fn colors(
        &mut self,
        visible: &Visible,
        depends_on_pixel: bool,
        compute: impl FnOnce() -> [LinearRgb; 3],
    ) -> [LinearRgb; 3] {
        let key = Some((visible.triangle, visible.facing));
        if depends_on_pixel || self.key != key {
            self.colors = compute();
            self.key = key;
        }
        self.colors
    }
}

/// A corner as lights see it, with its own normal where `is_smooth`, else with the face's.
pub(super) fn at_corner<W: Watch>(
    frame: &Frame<'_>,
    visible: &Visible,
    corner: usize,
    is_smooth: bool,
    watch: &mut W,
) -> Geometry {
    let position = frame.scene.mesh.triangle(visible.triangle)[corner].map(f64::from);
    let normal = surface::corner_normal(frame.scene, visible, corner, is_smooth, watch);
    lit_point(frame, position, normal)
}

/// The centroid as lights see it.
pub(super) fn at_centroid<W: Watch>(
    frame: &Frame<'_>,
    visible: &Visible,
    watch: &mut W,
) -> Geometry {
    let [a, b, c] = frame.scene.mesh.triangle(visible.triangle).map(|v| v.map(f64::from));
    let centroid = std::array::from_fn(|k| (a[k] + b[k] + c[k]) / 3.0);
    let normal = surface::corner_normal(frame.scene, visible, 0, false, watch);
    lit_point(frame, centroid, normal)
}

fn lit_point(frame: &Frame<'_>, position: [f64; 3], normal: [f64; 3]) -> Geometry {
    let to_eye = surface::to_eye_from(frame.scene, position);
    Geometry { position, to_eye, normal, normal_length: 1.0, mixture: None }
}
