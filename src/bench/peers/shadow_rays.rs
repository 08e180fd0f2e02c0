//! Rays from what is visible to a light as peers want them: f32, with room at both ends.

use crate::pixel::Window;
use crate::scene::Scene;
use crate::scene::light_point::LightPoint;
use crate::visibility::{VisibilityBuffer, Visible};

/// Share of the largest coordinate of a ray's start that it leaves out there and before the light, so
/// that it does not meet the surface that it leaves: rounding to f32 moves the start by 2^-24 of it, and
/// what renderers take is some hundred times that.
const ROOM: f64 = 1e-4;

/// A ray: a unit vector, and where it begins and ends.
#[derive(Clone, Copy, Debug)]
pub(super) struct ShadowRay {
    pub(super) origin: [f32; 3],
    pub(super) direction: [f32; 3],
    pub(super) near: f32,
    pub(super) far: f32,
}

/// Up to one ray per pixel.
pub struct ShadowRays {
    pub(super) window: Window,
    /// Row by row; `None` where nothing is visible.
    pub(super) rays: Vec<Option<ShadowRay>>,
}

impl ShadowRays {
    /// From the visible points to the light.
    pub fn new(scene: &Scene, nearest: &VisibilityBuffer, light: LightPoint) -> Self {
        let ray = |visible: &Visible| {
            let p = point(scene.mesh.triangle(visible.triangle), visible);
            let to_light = match light {
                LightPoint::Position(l) => [0, 1, 2].map(|k| l[k] - p[k]),
                LightPoint::Direction(d) => d,
            };
            let length = to_light.iter().map(|c| c * c).sum::<f64>().sqrt();
            let room = ROOM * p.iter().fold(0.0_f64, |most, c| most.max(c.abs()));
            ShadowRay {
                origin: p.map(|c| c as f32),
                direction: to_light.map(|c| (c / length) as f32),
                near: room as f32,
                far: match light {
                    LightPoint::Position(_) => (length - room) as f32,
                    LightPoint::Direction(_) => f32::INFINITY,
                },
            }
        };
        let rays = nearest.visible.iter().map(|visible| visible.as_ref().map(ray)).collect();
        Self { window: nearest.window, rays }
    }

    /// Number of rays.
    pub(super) fn len(&self) -> usize {
        self.rays.iter().flatten().count()
    }
}

/// The visible point.
fn point(corners: [[f32; 3]; 3], visible: &Visible) -> [f64; 3] {
    let [u, v, w] = visible.barycentric.0;
    let [a, b, c] = corners;
    [0, 1, 2].map(|k| u * f64::from(a[k]) + v * f64::from(b[k]) + w * f64::from(c[k]))
}
