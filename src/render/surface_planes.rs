//! The planes of surface points: position, normals, texture coordinates.
//!
//! A pixel's surface point is set up once for all groups that are asked for, in bands of rows so
//! that no second frame of points is held. Values are rounded to f32 once, here.

use super::{PlaneGroup, PlaneGroups};
use crate::film::Samples;
use crate::pixel::for_each_row;
use crate::scene::Scene;
use crate::shade::{SurfacePoint, surface_point};
use crate::visibility::VisibilityBuffer;

/// Groups whose planes are numbers of the surface point, and how many planes each has.
const OF_SURFACE: [(PlaneGroup, usize); 4] = [
    (PlaneGroup::Position, 3),
    (PlaneGroup::FaceNormal, 3),
    (PlaneGroup::ShadingNormal, 3),
    (PlaneGroup::TextureCoordinates, 2),
];

/// Rows whose surface points are held at once.
const BAND_ROWS: usize = 16;

/// The planes of surface points, which are set up once per pixel for all groups that are asked for.
pub(super) struct SurfacePlanes(Vec<(PlaneGroup, Vec<Vec<f32>>)>);

impl SurfacePlanes {
    pub(super) fn new(scene: &Scene, buffer: &VisibilityBuffer, groups: &PlaneGroups) -> Self {
        let asked = OF_SURFACE.into_iter().filter(|(group, _)| groups.has(*group));
        let size = buffer.window.len();
        let mut planes: Vec<_> =
            asked.map(|(group, count)| (group, vec![Vec::with_capacity(size); count])).collect();
        if planes.is_empty() {
            return Self(planes);
        }
        let width = buffer.window.width() as usize;
        let mut band = vec![[[0.0_f32; 3]; 4]; BAND_ROWS * width];
        for (number, visible) in buffer.visible.chunks(BAND_ROWS * width).enumerate() {
            // Set up the points of some rows, in parallel.
            let band = &mut band[..visible.len()];
            let first = number * BAND_ROWS * width;
            for_each_row(band, width, &|| (), |row, points| {
                let visible = &visible[row * width..][..points.len()];
                for (column, (point, visible)) in points.iter_mut().zip(visible).enumerate() {
                    *point = [[0.0; 3]; 4];
                    if let Some(visible) = visible {
                        let pixel = buffer.window.pixel(first + row * width + column);
                        let (surface, _) = surface_point(scene, pixel, visible);
                        let [u, v] = surface.uv.unwrap_or([0.0; 2]);
                        let SurfacePoint { position, face_normal, shading_normal, .. } = surface;
                        *point = [position, face_normal, shading_normal, [u, v, 0.0]]
                            .map(|vector| vector.map(|value| value as f32));
                    }
                }
            });
            // Lay them out by planes.
            for (group, planes) in &mut planes {
                let Some(place) = OF_SURFACE.iter().position(|(of, _)| of == group) else {
                    continue;
                };
                for (component, plane) in planes.iter_mut().enumerate() {
                    plane.extend(band.iter().map(|point| point[place][component]));
                }
            }
        }
        Self(planes)
    }

    /// Hands over the planes of a group that was asked for; there are none of any other.
    pub(super) fn take(&mut self, group: PlaneGroup) -> Vec<Samples> {
        match self.0.iter().position(|(of, _)| *of == group) {
            Some(place) => self.0.swap_remove(place).1.into_iter().map(Samples::Float).collect(),
            None => Vec::new(),
        }
    }
}
