//! The planes of surface points: position, normals, texture coordinates.
//!
//! A row's surface points are set up once for all groups that are asked for.

use super::PlaneGroup;
use super::plane_rows::PlaneRow;
use crate::pixel::Pixel;
use crate::scene::Scene;
use crate::shade::{SurfacePoint, surface_point};
use crate::visibility::Visible;

/// The surface points of a row; nothing where nothing is visible.
#[derive(Default)]
pub(super) struct SurfaceRow(Vec<Option<SurfacePoint>>);

impl SurfaceRow {
    /// Sets up the points of the row that begins at a pixel, unless that was done.
    pub(super) fn set_up(
        &mut self,
        scene: &Scene,
        (x0, y): (u32, u32),
        visible: &[Option<Visible>],
    ) {
        if self.0.is_empty() {
            self.0.extend((x0..).zip(visible).map(|(x, visible)| {
                visible.as_ref().map(|visible| surface_point(scene, Pixel { x, y }, visible).0)
            }));
        }
    }

    /// Fills the planes of a group of surface points.
    pub(super) fn lay_out(&self, group: PlaneGroup, plane: &mut PlaneRow<'_>) {
        match group {
            PlaneGroup::Position => self.each(plane, |point| point.position),
            PlaneGroup::FaceNormal => self.each(plane, |point| point.face_normal),
            PlaneGroup::ShadingNormal => self.each(plane, |point| point.shading_normal),
            PlaneGroup::TextureCoordinates => {
                self.each(plane, |point| point.uv.unwrap_or([0.0; 2]));
            }
            _ => {}
        }
    }

    fn each<const N: usize>(
        &self,
        plane: &mut PlaneRow<'_>,
        value: impl Fn(&SurfacePoint) -> [f64; N],
    ) {
        plane.floats(self.0.iter().map(|point| point.as_ref().map_or([0.0; N], &value)));
    }
}
