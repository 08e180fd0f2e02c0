//! The ray caster against golden images, against a linear scan, and against its own settings.

mod aimed;
mod crowds;
mod golden;

use crate::support::closed::sphere;
use crate::support::scenes::{Sequence, Triangle, single_ray};
use truecast::accel::{Accelerator, BuildPreset};
use truecast::cast::{CastOptions, cast, cast_with};
use truecast::pixel::{Resolution, Window};
use truecast::scene::Scene;
use truecast::scene::camera::PinholeCamera;
use truecast::visibility::{Counting, Level, VisibilityBuffer, Visible};

/// A scene whose answers a program in rational arithmetic computed.
#[derive(serde::Deserialize)]
struct Golden {
    name: String,
    width: u32,
    height: u32,
    camera: Vectors,
    /// Exact doubles of f32 values in the file; read as f32, because serde_json may miss the
    /// last bit of a double, which rounding to f32 undoes.
    triangles: Vec<Triangle>,
    ids: Vec<i64>,
    cover_count: Vec<u32>,
    signed_count: Vec<i32>,
}

#[derive(serde::Deserialize)]
struct Vectors {
    eye: [f64; 3],
    d0: [f64; 3],
    dx: [f64; 3],
    dy: [f64; 3],
}

fn goldens() -> Vec<Golden> {
    serde_json::from_str(include_str!("golden/visibility.json")).unwrap()
}

impl Golden {
    fn scene(&self) -> Scene {
        let Vectors { eye, d0, dx, dy } = self.camera;
        let resolution = Resolution::new(self.width, self.height).unwrap();
        let camera = PinholeCamera::exact(resolution, eye, d0, dx, dy).unwrap();
        Scene::from_triangles(camera, &self.triangles)
    }
}

/// The standard camera G(f): 17 × 17 pixels, pixel (8, 8) looks along (0, 0, f).
fn standard_camera(f: f64) -> PinholeCamera {
    let resolution = Resolution::new(17, 17).unwrap();
    PinholeCamera::exact(resolution, [0.0; 3], [-8.5, -8.5, f], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0])
        .unwrap()
}

fn all(scene: &Scene, accelerator: &Accelerator) -> VisibilityBuffer {
    cast(scene, accelerator, scene.camera.resolution().window(), Counting::All, &|| ())
}

fn cast_in(
    scene: &Scene,
    accelerator: &Accelerator,
    window: Window,
    counting: Counting,
    side: u32,
) -> VisibilityBuffer {
    let options = CastOptions { side, ..CastOptions::default() };
    cast_with(scene, accelerator, window, counting, options, &|| ())
}

fn nearest(scene: &Scene, accelerator: &Accelerator) -> VisibilityBuffer {
    cast(scene, accelerator, scene.camera.resolution().window(), Counting::Nearest, &|| ())
}

/// The answer of the linear scan, after every preset gave the same, bit for bit, in both modes.
fn agreed(scene: &Scene) -> VisibilityBuffer {
    let reference = all(scene, &Accelerator::linear(&scene.mesh));
    for preset in BuildPreset::ALL {
        let accelerator = Accelerator::build(&scene.mesh, preset);
        let counted = all(scene, &accelerator);
        assert_same(&reference, &counted);
        assert_eq!(reference.cover, counted.cover, "{preset:?}");
        assert_same(&reference, &nearest(scene, &accelerator));
    }
    reference
}

fn bits(visible: &Visible) -> [u64; 5] {
    let [b0, b1, b2] = visible.barycentric.0;
    [b0, b1, b2, visible.t_lo, visible.t_hi].map(f64::to_bits)
}

/// Same answers, bit for bit; levels of work may differ.
fn assert_same(a: &VisibilityBuffer, b: &VisibilityBuffer) {
    for (index, (left, right)) in a.visible.iter().zip(&b.visible).enumerate() {
        assert_eq!(left, right, "pixel {index}");
        assert_eq!(left.as_ref().map(bits), right.as_ref().map(bits), "pixel {index}");
    }
    assert_eq!(a.visible.len(), b.visible.len());
}

fn ids(buffer: &VisibilityBuffer) -> Vec<i64> {
    buffer.visible.iter().map(|v| v.map_or(-1, |v| i64::from(v.triangle.get()))).collect()
}

fn covered(buffer: &VisibilityBuffer) -> usize {
    buffer.covered_pixels()
}

/// Finite, ordered bounds of t with a relative width of at most 2^-40, weights that sum to 1.
fn assert_finite(buffer: &VisibilityBuffer) {
    for visible in buffer.visible.iter().flatten() {
        assert!(visible.t_lo > 0.0 && visible.t_hi.is_finite());
        assert!(visible.t_lo <= visible.t_hi);
        assert!(visible.t_hi - visible.t_lo <= visible.t_hi * 2.0_f64.powi(-40), "{visible:?}");
        let sum: f64 = visible.barycentric.0.iter().sum();
        // Each weight is good to 2^-49, so is their sum.
        assert!((sum - 1.0).abs() <= 2.0_f64.powi(-49), "{visible:?}");
        assert!(visible.barycentric.0.iter().all(|b| b.is_sign_positive()));
        assert!(!visible.tie || visible.level == Level::Exact);
    }
}

fn quad(x: [f32; 2], y: [f32; 2], z: f32) -> [Triangle; 2] {
    let corner = |i: usize, j: usize| [x[i], y[j], z];
    [[corner(0, 0), corner(1, 0), corner(1, 1)], [corner(0, 0), corner(1, 1), corner(0, 1)]]
}
