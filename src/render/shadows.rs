//! Shadows for a shaded frame: the caster's predicate, asked about the scene's lights.
//!
//! The one place that joins `shade`, which says where a light would reach a surface, and `cast`,
//! which says whether something opaque stands between. Both visibility paths are shaded this way;
//! the check holds the pictures against the arbiter's own shadows.

use crate::accel::Accelerator;
use crate::cast::shadow::ShadowCaster;
use crate::color::LinearRgb;
use crate::scene::Scene;
use crate::scene::light::Light;
use crate::scene::light_point::LightPoint;
use crate::shade::{Asker, Effects, Notes, ShadeOptions, shade_into};
use crate::visibility::VisibilityBuffer;

/// Where a light that casts shadows stands.
pub fn light_point(light: &Light) -> Option<LightPoint> {
    match light {
        _ if !light.casts_shadows() => None,
        Light::Directional(light) => Some(LightPoint::Direction(light.aim.map(|c| -c))),
        Light::Point(light) => Some(LightPoint::Position(light.position)),
        Light::Spot(light) => Some(LightPoint::Position(light.position)),
        Light::Ambient(_) | Light::Hemisphere(_) => None,
    }
}

/// Shades a buffer, one number triple per pixel, with the shadows that the options have, by rays through
/// `accelerator`; without one nothing casts a shadow. `done` is called once per finished row, from any
/// thread.
pub(super) fn shade_shadowed(
    scene: &Scene,
    buffer: &VisibilityBuffer,
    options: &ShadeOptions,
    accelerator: Option<&Accelerator>,
    radiance: &mut [LinearRgb],
    done: &(dyn Fn() + Sync),
) -> Notes {
    let Some(accelerator) = accelerator.filter(|_| options.effects.has(Effects::SHADOWS)) else {
        return shade_into(scene, buffer, options, None, radiance, done);
    };
    let lights: Vec<Option<LightPoint>> = scene.lights.iter().map(light_point).collect();
    let asker = || -> Asker<'_> {
        let mut caster = ShadowCaster::new(scene, accelerator);
        let lights = &lights;
        Box::new(move |pixel, visible, light| {
            lights[light].is_some_and(|light| {
                caster.occluder(pixel, visible, light, |id| scene.is_opaque(id)).is_some()
            })
        })
    };
    shade_into(scene, buffer, options, Some(&asker), radiance, done)
}
