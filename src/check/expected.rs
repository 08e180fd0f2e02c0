//! What a pixel should hold by the arbiter's word: what lies behind its nearest surface, and its
//! radiance and alpha, shaded and blended from exact surfaces at every sample.

use super::blame::visible_from;
use crate::color::LinearRgb;
use crate::exact::{Arbiter, Shadows};
use crate::pixel::Pixel;
use crate::render::expose::Blend;
use crate::render::shadows::light_point;
use crate::scene::Scene;
use crate::shade::{self, Asker, Terms, terms};
use crate::visibility::Visible;
use rayon::prelude::*;

/// The surfaces behind a see-through nearest one at the pixel's centre, up to and including the
/// first opaque one.
pub(super) fn layers(scene: &Scene, arbiter: &Arbiter<'_>, pixel: Pixel) -> Vec<Visible> {
    let mut seen = seen(scene, arbiter, pixel, [0; 2]);
    if !seen.is_empty() {
        seen.remove(0);
    }
    seen
}

/// Radiance and alpha of each pixel.
pub(super) fn exposures(
    scene: &Scene,
    arbiter: &Arbiter<'_>,
    pixels: &[Pixel],
) -> Vec<(LinearRgb, f64)> {
    let mut sums = vec![([0.0; 3], 0.0); pixels.len()];
    if pixels.is_empty() {
        return sums;
    }
    let mut shifted = scene.clone();
    for offset in scene.samples.offsets() {
        shifted.camera = scene.camera.shifted(offset);
        let shadows = shadows(&shifted);
        sums.par_iter_mut().zip(pixels).for_each(|((color, alpha), &pixel)| {
            let seen = seen(scene, arbiter, pixel, offset);
            let (more, more_alpha) = exposure(&shifted, &shadows, pixel, &seen);
            *color = std::array::from_fn(|k| color[k] + more[k]);
            *alpha += more_alpha;
        });
    }
    let count = f64::from(scene.samples.count());
    sums.into_iter().map(|(color, alpha)| (color.map(|sum| sum / count), alpha / count)).collect()
}

/// The surfaces that are seen at a sample, nearest first: the last is the first opaque one, if any
/// is.
fn seen(scene: &Scene, arbiter: &Arbiter<'_>, pixel: Pixel, steps: [i32; 2]) -> Vec<Visible> {
    let mut surfaces: Vec<Visible> =
        arbiter.surfaces(pixel, steps).iter().map(visible_from).collect();
    let opaque = surfaces.iter().position(|surface| scene.is_opaque(surface.triangle));
    if let Some(opaque) = opaque {
        surfaces.truncate(opaque + 1);
    }
    surfaces
}

/// The arbiter's shadows of each light; none of lights that cast none.
fn shadows(scene: &Scene) -> Vec<Option<Shadows<'_>>> {
    let lights = scene.lights.iter();
    lights.map(|light| light_point(light).map(|light| Shadows::new(scene, light))).collect()
}

/// Every light's term at a visible pixel, with the arbiter's shadows.
pub fn exact_terms(scene: &Scene, pixel: Pixel, visible: &Visible) -> Terms {
    let shadows = shadows(scene);
    terms(scene, pixel, visible, Some(&|| asker(scene, &shadows)))
}

fn asker<'a>(scene: &'a Scene, shadows: &'a [Option<Shadows<'a>>]) -> Asker<'a> {
    Box::new(|pixel, visible, light| {
        shadows[light].as_ref().is_some_and(|shadows| {
            let opaque = |id| scene.is_opaque(id);
            !shadows.occluders(pixel, visible.triangle, opaque).is_empty()
        })
    })
}

fn exposure(
    scene: &Scene,
    shadows: &[Option<Shadows<'_>>],
    pixel: Pixel,
    seen: &[Visible],
) -> (LinearRgb, f64) {
    let radiance = |surface: &Visible| {
        shade::shade_visible(scene, pixel, surface, Some(&|| asker(scene, shadows)))
    };
    match seen {
        [] => (scene.background, 0.0),
        [nearest] if scene.is_opaque(nearest.triangle) => (radiance(nearest), 1.0),
        layered => {
            let mut blend = Blend::START;
            for surface in layered {
                blend.add(radiance(surface), scene.material_of(surface.triangle).1.opacity);
            }
            blend.over(scene.background)
        }
    }
}
