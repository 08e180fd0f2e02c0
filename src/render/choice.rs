//! Which path and which tree a frame takes, where nobody asks for one: those that are predicted to
//! take the least time.
//!
//! Both paths give the same answer (and numbers that differ in the noise of f64 at most), so that only
//! time is at stake, and a model of a few numbers will do: it must tell 5 ms from 50, not 5 from 6. It knows the scene and the options and neither the
//! machine nor the number of threads: the plane `verdict.level`, which tells how the path decided,
//! must not depend on them.

use super::VisibilityPath;
use crate::accel::BuildPreset;
use crate::pixel::Window;
use crate::scene::Scene;
use crate::shade::Effects;

/// Core seconds of each kind of work.
///
/// Measured as user and system time of `truecast render --threads 1 --aov rgba` on a Zen 5 core, on an
/// interior of 57 thousand triangles, an atrium of 66 thousand and a torus of a million, at 64 × 36 and
/// at 1920 × 1080, with `--path cast`, `--path raster` and a fresh `--bvh-cache` (which takes
/// [`BuildPreset::Medium`]); differences of these divided by triangles or pixels, to about a third.
/// On another machine all of them change by about the same factor, which changes no choice.
struct Costs {
    /// Building, per triangle, with [`BuildPreset::Fastest`] and [`BuildPreset::Medium`].
    build: [f64; 2],
    /// How much longer rays take in the tree of the first than in that of the second.
    slower_rays: f64,
    /// A ray from the eye, in the company of its neighbours.
    cast_ray: f64,
    /// What a triangle adds to a frame of such rays, as long as it is not much smaller than a pixel.
    cast_triangle: f64,
    /// A ray to a light, alone.
    shadow_ray: f64,
    /// A pixel of the rasterizer, with all that a buffer holds of it.
    raster_pixel: f64,
    /// A triangle of the rasterizer. One that shows costs several times as much as one that does not.
    raster_triangle: f64,
}

const COSTS: Costs = Costs {
    build: [4.5e-7, 7.0e-7],
    slower_rays: 1.1,
    cast_ray: 1.2e-8,
    cast_triangle: 2.0e-8,
    shadow_ray: 3.0e-7,
    raster_pixel: 1.5e-8,
    raster_triangle: 2.2e-7,
};

/// A way to make a frame, and what it is predicted to take.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prediction {
    /// The path.
    pub path: VisibilityPath,
    /// How its tree is built, or that of the shadows; `None` without any.
    pub preset: Option<BuildPreset>,
    /// Building it, in core seconds.
    pub build: f64,
    /// Finding what is visible and what is in shadow, in core seconds.
    pub rays: f64,
}

impl Prediction {
    /// Core seconds together.
    pub fn total(&self) -> f64 {
        self.build + self.rays
    }
}

/// The ways to render a window, the quickest first; equals in the order cast, raster.
pub fn predict(scene: &Scene, window: Window) -> Vec<Prediction> {
    let effects = Effects::of(scene);
    let pixels = window.len() as f64;
    let triangles = scene.mesh.len() as f64;
    // Centres are seen whether or not there are samples beside them.
    let passes = match effects.has(Effects::SUPERSAMPLING) {
        true => 1.0 + f64::from(scene.samples.count()),
        false => 1.0,
    };
    let shadowing = scene.lights.iter().filter(|light| light.casts_shadows()).count();
    let shadow_rays = match effects.has(Effects::SHADOWS) {
        true => pixels * passes * shadowing as f64,
        false => 0.0,
    };
    let presets = [(BuildPreset::Fastest, COSTS.slower_rays), (BuildPreset::Medium, 1.0)];
    let mut ways = Vec::new();
    for path in [VisibilityPath::Cast, VisibilityPath::Raster] {
        for ((preset, slower), build) in presets.into_iter().zip(COSTS.build) {
            let has_tree = path == VisibilityPath::Cast || shadow_rays > 0.0;
            let seeing = match path {
                // Most of many triangles hide behind others: no more are met than a pixel or two each.
                VisibilityPath::Cast => {
                    pixels * COSTS.cast_ray + triangles.min(2.0 * pixels) * COSTS.cast_triangle
                }
                VisibilityPath::Raster => {
                    pixels * COSTS.raster_pixel + triangles * COSTS.raster_triangle
                }
            };
            let seeing = if path == VisibilityPath::Cast { seeing * slower } else { seeing };
            let way = Prediction {
                path,
                preset: has_tree.then_some(preset),
                build: if has_tree { triangles * build } else { 0.0 },
                rays: passes * seeing + shadow_rays * COSTS.shadow_ray * slower,
            };
            if !ways.contains(&way) {
                ways.push(way);
            }
        }
    }
    // Stable: equals keep their order.
    ways.sort_by(|a, b| a.total().total_cmp(&b.total()));
    ways
}
