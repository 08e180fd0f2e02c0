//! What is visible at any point of the image plane, not only at pixel centres.

use crate::accel::Accelerator;
use crate::cast::{CastOptions, cast_with};
use crate::mesh::TriangleId;
use crate::pixel::{Pixel, Resolution};
use crate::scene::Scene;
use crate::scene::camera::PinholeCamera;
use crate::visibility::{Counting, Visible};

/// Answers at any point, by the caster.
pub(super) struct Sampler<'a> {
    pub(super) scene: &'a Scene,
    pub(super) accelerator: &'a Accelerator,
}

/// Two depths in f64 that are the same where the caster says that there is a tie: 2^-40, thousands
/// of roundings, far below any gap that f32 vertices leave by intent.
const SAME_DEPTH_RELATIVE: f64 = 1.0 / (1_u64 << 40) as f64;

/// A triangle's edge functions around a pixel's sample, turned so that inside is positive:
/// w_i(x, y) = row[0] + row[1]·x + row[2]·y with (x, y) in pixels from the sample. In f64, with
/// edges instead of second vertices: off by about 2^-53·|d|/|DX| pixels, 1e-13 of them.
pub(super) type EdgeRows = [[f64; 3]; 3];

impl Sampler<'_> {
    /// What is visible at the point (x, y), in pixels of the scene's frame; t is as in the scene's
    /// own camera. The answer is exact for a point that is off by about 1e-13 pixels: a camera of
    /// one pixel is put on its own lattice around it.
    pub(super) fn visible_at(&self, point: [f64; 2]) -> Option<Visible> {
        let camera = &self.scene.camera;
        let (dx, dy) = (camera.dx(), camera.dy());
        let [x, y] = point.map(|c| c - 0.5);
        let d0 = std::array::from_fn(|k| camera.d0()[k] + x * dx[k] + y * dy[k]);
        let frame = Resolution::new(1, 1)?;
        // Fails for no point near a frame that has a camera.
        let camera = PinholeCamera::exact(frame, camera.eye(), d0, dx, dy).ok()?;
        // A ray alone takes triangles from the accelerator and the camera from the scene, which
        // needs no other part.
        let around = Scene::from_triangles(camera, &[]);
        let alone = CastOptions { tiles: false, ..CastOptions::default() };
        let window = frame.window();
        cast_with(&around, self.accelerator, window, Counting::Nearest, alone, &|| ()).visible[0]
    }

    /// Whether a triangle, which must reach to `point`, ties there with the visible one, where the
    /// caster says that there is a tie.
    pub(super) fn is_as_deep(
        &self,
        triangle: TriangleId,
        point: [f64; 2],
        visible: &Visible,
    ) -> bool {
        let pixel = Pixel { x: point[0] as u32, y: point[1] as u32 };
        let [x, y] = pixel.sample();
        let covers = |rows: EdgeRows| {
            rows.iter().all(|row| row[0] + row[1] * (point[0] - x) + row[2] * (point[1] - y) >= 0.0)
        };
        self.edge_rows(triangle, pixel).is_some_and(covers)
            && (self.t_at(triangle, point) / visible.t() - 1.0).abs() <= SAME_DEPTH_RELATIVE
    }

    /// The direction of the ray through a point; exact on the camera's grid of 1/256 pixel.
    fn direction(&self, [x, y]: [f64; 2]) -> [f64; 3] {
        let camera = &self.scene.camera;
        std::array::from_fn(|k| camera.d0()[k] + x * camera.dx()[k] + y * camera.dy()[k])
    }

    /// The corners of a triangle seen from the eye.
    fn corners(&self, triangle: TriangleId) -> [[f64; 3]; 3] {
        let eye = self.scene.camera.eye();
        let corners = self.scene.mesh.triangle(triangle);
        corners.map(|v| std::array::from_fn(|k| f64::from(v[k]) - eye[k]))
    }

    /// t at which a pixel's ray meets the plane of a triangle, in f64; infinite or NaN where it
    /// does not.
    pub(super) fn plane_t(&self, triangle: TriangleId, pixel: Pixel) -> f64 {
        self.t_at(triangle, pixel.sample())
    }

    fn t_at(&self, triangle: TriangleId, point: [f64; 2]) -> f64 {
        let [a, b, c] = self.corners(triangle);
        let normal = cross(subtract(b, a), subtract(c, a));
        dot(a, normal) / dot(self.direction(point), normal)
    }

    /// The edge functions of a triangle around a pixel; `None` where its volume has no sign in f64.
    pub(super) fn edge_rows(&self, triangle: TriangleId, pixel: Pixel) -> Option<EdgeRows> {
        let a = self.corners(triangle);
        let planes: [[f64; 3]; 3] = std::array::from_fn(|i| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            cross(a[j], subtract(a[k], a[j]))
        });
        let volume = dot(a[0], planes[0]);
        if volume == 0.0 {
            return None;
        }
        let d = self.direction(pixel.sample());
        let camera = &self.scene.camera;
        Some(
            planes.map(|plane| {
                [d, camera.dx(), camera.dy()].map(|v| volume.signum() * dot(plane, v))
            }),
        )
    }
}

fn subtract(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| a[k] - b[k])
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
