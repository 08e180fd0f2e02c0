//! What is the same at every pixel of a frame: the prepared lights, the method of each mesh, and who
//! is asked about shadows.

use super::coefficients::Coefficients;
use super::effects::Effects;
use super::kernel_effects::KernelEffects;
use super::lanes::{Cones, Lanes};
use super::lights::{self, Origin, PreparedLight, is_black};
use super::method::Method;
use super::options::Precision;
use super::watch::Watch;
use crate::pixel::Pixel;
use crate::scene::Scene;
use crate::scene::switches::Rules;
use crate::simd::SimdLevel;
use crate::visibility::Visible;
use fearless_simd::Level;
use std::cell::RefCell;

/// Says whether an opaque surface hides the light at a position of the scene's list from the point
/// of a triangle that is visible at a pixel.
pub type Asker<'a> = Box<dyn FnMut(Pixel, &Visible, usize) -> bool + 'a>;

/// Makes an [`Asker`] for each row that is shaded, on the thread that shades it.
pub type Occlusion<'a> = &'a (dyn Fn() -> Asker<'a> + Sync);

/// The asker of a row, if anything casts shadows.
pub(super) type RowAsker<'a> = Option<RefCell<Asker<'a>>>;

/// What is the same at every pixel.
pub(super) struct Frame<'a> {
    pub(super) scene: &'a Scene,
    pub(super) rules: &'a Rules,
    pub(super) effects: Effects,
    pub(super) lights: Vec<PreparedLight>,
    pub(super) methods: Vec<Method>,
    /// Whether any light has a direction: without one no surface is set up.
    pub(super) directed: bool,
    /// Whether any light casts shadows.
    pub(super) shadowed: bool,
    /// Whether it is worth asking which lights reach a run of pixels.
    pub(super) selects_lights: bool,
    /// The cones of `lights`.
    pub(super) cones: Cones,
    /// The instruction set of what is vectorised.
    pub(super) level: Level,
    /// Whether several pixels are shaded at once.
    pub(super) lanes: Option<Lanes>,
    occlusion: Option<Occlusion<'a>>,
}

impl<'a> Frame<'a> {
    pub(super) fn new(
        scene: &'a Scene,
        effects: Effects,
        occlusion: Option<Occlusion<'a>>,
    ) -> Self {
        let rules = scene.switches.rules();
        // Without anybody to ask, nothing casts a shadow.
        let effects = match occlusion {
            Some(_) => effects,
            None => effects.without(Effects::SHADOWS),
        };
        let lights = lights::prepare(&scene.lights, rules, effects);
        let directed = lights.iter().any(|light| !matches!(light.origin, Origin::Nowhere));
        let shadowed = lights.iter().any(|light| light.shadows);
        let methods = Method::of_objects(scene);
        let has_cone = |light: &PreparedLight| match &light.origin {
            Origin::Position(at) => at.cone.as_ref().is_some_and(|cone| cone.sine_cosine.is_some()),
            _ => false,
        };
        // One cone is tested as quickly as a run's bounds are found; and directions that are mixed
        // from the corners are tested before the cone.
        let cones = lights.iter().filter(|light| has_cone(light)).count();
        let selects_lights = cones > 1 && !rules.interpolate_vectors;
        let cones = Cones::of(&lights);
        Self {
            scene,
            rules,
            effects,
            lights,
            methods,
            directed,
            shadowed,
            selects_lights,
            cones,
            level: Level::baseline(),
            lanes: None,
            occlusion,
        }
    }

    /// The same frame with several pixels shaded at once where that is possible.
    pub(super) fn in_lanes(self, level: SimdLevel, precision: Precision) -> Self {
        let level = level.dispatched();
        let selects = self.selects_lights;
        let lanes = Lanes::of(self.scene, self.rules, &self.lights, selects, level, precision);
        Self { level, lanes, ..self }
    }

    /// Whoever answers for shadows while a row is shaded.
    pub(super) fn asker(&self) -> RowAsker<'a> {
        self.occlusion.filter(|_| self.shadowed).map(|make| RefCell::new(make()))
    }

    /// A frame for [`Watch::UNGATED`]: every surface is set up, every light is asked everywhere.
    pub(super) fn ungated(scene: &'a Scene) -> Self {
        let lights = lights::prepare_ungated(&scene.lights, scene.switches.rules());
        Self {
            lights,
            directed: true,
            selects_lights: false,
            ..Self::new(scene, Effects::ALL, None)
        }
    }
}

/// Whether a light is hidden from the surface at a pixel.
pub(super) fn is_hidden(
    asker: &RowAsker<'_>,
    pixel: Pixel,
    visible: &Visible,
    light: usize,
) -> bool {
    asker.as_ref().is_some_and(|asker| (*asker.borrow_mut())(pixel, visible, light))
}

impl Frame<'_> {
    /// Whether some light's direction matters to a surface with these coefficients.
    pub(super) fn sees<W: Watch>(
        &self,
        coefficients: &Coefficients,
        effects: KernelEffects,
    ) -> bool {
        let reflects = W::UNGATED
            || !is_black(coefficients.diffuse)
            || effects.has(KernelEffects::SPECULAR) && !is_black(coefficients.specular)
            || self.rules.attenuate_ambient && !is_black(coefficients.ambient);
        self.directed && reflects
    }
}
