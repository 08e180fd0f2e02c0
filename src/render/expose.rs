//! Radiance and alpha of each pixel: surfaces seen one behind the other, samples side by side.
//!
//! Every surface is shaded by `shade`, which knows neither. Layers are peeled: the k-th surface of
//! every pixel makes a buffer of its own. Front to back over a pixel's surfaces, with T = 1 at the
//! eye: C += T·o·radiance and T *= 1 − o; at the end C += T·background, A = 1 − T (T. Porter,
//! T. Duff, *Compositing Digital Images*, 1984: "over", from the front). Every sum is f64 in a
//! fixed order, so that no thread changes a bit.

use super::answerer::Answerer;
use super::progress::Progress;
use super::shadows::shade_shadowed;
use super::subsamples::for_each_subsample;
use crate::accel::{Accelerator, BuildPreset};
use crate::color::LinearRgb;
use crate::mesh::TriangleId;
use crate::pixel::Window;
use crate::scene::Scene;
use crate::shade::{Effects, Notes, ShadeOptions};
use crate::visibility::{Layers, LevelCounts, VisibilityBuffer, Visible};

/// What a film sees at each pixel of a window, row by row.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Exposure {
    /// Linear, unclamped radiance: the mean over the samples of a pixel, the background where
    /// nothing is visible.
    pub radiance: Vec<LinearRgb>,
    /// How much of the pixel surfaces take, 0…1: the mean over its samples of 1 − T.
    pub alpha: Vec<f64>,
    /// Doubtful cases that shading met, over all surfaces and samples.
    pub notes: Notes,
}

/// Exposes the pixels of `nearest`, `answerer`'s answer at pixel centres, with what lies behind
/// them in `layers`. Several samples per pixel are asked for anew; of `nearest` only the window
/// counts then.
pub fn expose(
    scene: &Scene,
    answerer: &Answerer,
    (nearest, layers): (&VisibilityBuffer, &Layers),
    effects: Effects,
    progress: &dyn Progress,
) -> Exposure {
    let built = occluders(answerer, effects, || {
        progress.begin("build", 1);
        let built = Accelerator::build(&scene.mesh, BuildPreset::Medium);
        progress.step();
        built
    });
    let mut exposure = Exposure::default();
    let occluders = built.of(answerer);
    let seen = (nearest, Some(layers));
    let options = ShadeOptions::new(effects);
    expose_into(scene, answerer, occluders, seen, &options, &mut exposure, progress);
    exposure
}

/// A tree for shadows, where the path that answers has none.
pub(super) struct Occluders(Option<Accelerator>);

impl Occluders {
    /// The tree that shadow rays go through: the path's own, or this. Without proof there is no point
    /// on a surface that they could leave from with certainty, and so no shadow.
    pub(super) fn of<'a>(&'a self, answerer: &'a Answerer) -> Option<&'a Accelerator> {
        match answerer {
            Answerer::Cast(accelerator) => Some(accelerator),
            Answerer::CastUnproven(..) => None,
            Answerer::Raster | Answerer::RasterUnproven(_) => self.0.as_ref(),
        }
    }
}

/// Shadows need a BVH, whichever path found what is visible.
pub(super) fn occluders(
    answerer: &Answerer,
    effects: Effects,
    build: impl FnOnce() -> Accelerator,
) -> Occluders {
    let is_needed = matches!(answerer, Answerer::Raster) && effects.has(Effects::SHADOWS);
    Occluders(is_needed.then(build))
}

/// [`expose`] with a tree for shadows at hand, if there are any, in memory that was used before;
/// without `layers` nothing lies behind anything.
pub(super) fn expose_into(
    scene: &Scene,
    answerer: &Answerer,
    occluders: Option<&Accelerator>,
    (nearest, layers): (&VisibilityBuffer, Option<&Layers>),
    options: &ShadeOptions,
    exposure: &mut Exposure,
    progress: &dyn Progress,
) {
    if !options.effects.has(Effects::SUPERSAMPLING) {
        progress.begin("shade", nearest.window.height() as usize);
        let seen = (nearest, layers);
        return expose_sample(scene, occluders, seen, options, exposure, &|| progress.step());
    }
    let mut sum = Sum::new(nearest.window);
    let mut sample = Exposure::default();
    let stage = ("supersample", progress);
    let offsets = scene.samples.offsets();
    for_each_subsample(scene, answerer, nearest.window, offsets, stage, |shifted, answer| {
        let layers = match options.effects.has(Effects::OPACITY) {
            true => Some(answerer.layers(shifted, answer, &|| ())),
            false => None,
        };
        let seen = (answer, layers.as_ref());
        expose_sample(shifted, occluders, seen, options, &mut sample, &|| ());
        sum.add(answer.window, &sample);
    });
    *exposure = sum.mean(f64::from(scene.samples.count()));
}

/// Sums over the samples of each pixel, in the order in which samples are added.
struct Sum {
    window: Window,
    total: Exposure,
}

impl Sum {
    fn new(window: Window) -> Self {
        let (radiance, alpha) = (vec![[0.0; 3]; window.len()], vec![0.0; window.len()]);
        Self { window, total: Exposure { radiance, alpha, notes: Notes::default() } }
    }

    /// Adds one sample of each pixel of a band: whole rows of the window.
    fn add(&mut self, band: Window, sample: &Exposure) {
        let first = self.window.index(band.pixel(0));
        let radiance = self.total.radiance[first..].iter_mut().zip(&sample.radiance);
        for (sum, sample) in radiance {
            *sum = std::array::from_fn(|k| sum[k] + sample[k]);
        }
        let alpha = self.total.alpha[first..].iter_mut().zip(&sample.alpha);
        alpha.for_each(|(sum, sample)| *sum += sample);
        self.total.notes.add(sample.notes);
    }

    fn mean(self, samples: f64) -> Exposure {
        let Exposure { radiance, alpha, notes } = self.total;
        Exposure {
            radiance: radiance.into_iter().map(|sum| sum.map(|sum| sum / samples)).collect(),
            alpha: alpha.into_iter().map(|sum| sum / samples).collect(),
            notes,
        }
    }
}

/// Exposes one sample per pixel: the nearest surfaces as they are, and where these are see-through
/// what lies behind them.
fn expose_sample(
    scene: &Scene,
    occluders: Option<&Accelerator>,
    (nearest, layers): (&VisibilityBuffer, Option<&Layers>),
    options: &ShadeOptions,
    exposure: &mut Exposure,
    done: &(dyn Fn() + Sync),
) {
    exposure.radiance.resize(nearest.window.len(), [0.0; 3]);
    exposure.notes =
        shade_shadowed(scene, nearest, options, occluders, &mut exposure.radiance, done);
    let alpha = nearest.visible.iter().map(|visible| f64::from(u8::from(visible.is_some())));
    exposure.alpha.clear();
    exposure.alpha.extend(alpha);
    if let Some(layers) = layers.filter(|_| options.effects.has(Effects::OPACITY)) {
        blend(scene, occluders, (nearest, layers), options, exposure);
    }
}

/// Replaces the radiance and alpha of every pixel whose nearest surface is see-through.
fn blend(
    scene: &Scene,
    occluders: Option<&Accelerator>,
    (nearest, layers): (&VisibilityBuffer, &Layers),
    options: &ShadeOptions,
    exposure: &mut Exposure,
) {
    let mut blends: Vec<(usize, Blend)> = Vec::new();
    for (index, visible) in nearest.visible.iter().enumerate() {
        if let Some(visible) = visible.filter(|visible| !scene.is_opaque(visible.triangle)) {
            let mut blend = Blend::START;
            blend.add(exposure.radiance[index], opacity(scene, visible.triangle));
            blends.push((index, blend));
        }
    }
    // Peel: the k-th surfaces behind the nearest, all at once.
    for k in 0..layers.most() {
        let Some(peel) = peel(scene, layers, k) else { break };
        let mut radiance = vec![[0.0; 3]; peel.window.len()];
        let notes = shade_shadowed(scene, &peel, options, occluders, &mut radiance, &|| ());
        exposure.notes.add(notes);
        for (index, blend) in &mut blends {
            if let Some(visible) = layers.of(*index).get(k) {
                let place = peel.window.index(layers.window.pixel(*index));
                blend.add(radiance[place], opacity(scene, visible.triangle));
            }
        }
    }
    for (index, blend) in blends {
        (exposure.radiance[index], exposure.alpha[index]) = blend.over(scene.background);
    }
}

fn opacity(scene: &Scene, triangle: TriangleId) -> f64 {
    scene.material_of(triangle).1.opacity
}

/// The k-th surfaces behind the nearest, in the rows that have any.
fn peel(scene: &Scene, layers: &Layers, k: usize) -> Option<VisibilityBuffer> {
    let whole = layers.window;
    let width = whole.width() as usize;
    let has_any = |row: &u32| {
        let first = (row - whole.y0()) as usize * width;
        (first..first + width).any(|index| layers.of(index).len() > k)
    };
    let first = (whole.y0()..whole.y1()).find(has_any)?;
    let last = (whole.y0()..whole.y1()).rfind(has_any)?;
    let frame = scene.camera.resolution();
    let window = Window::new(frame, whole.x0(), first, whole.x1(), last + 1)?;
    let surface = |pixel| -> Option<Visible> { layers.of(whole.index(pixel)).get(k).copied() };
    Some(VisibilityBuffer {
        window,
        visible: window.pixels().map(surface).collect(),
        cover: None,
        levels: LevelCounts::default(),
    })
}

/// Surfaces of one sample blended front to back.
#[derive(Clone, Copy, Debug)]
pub struct Blend {
    color: LinearRgb,
    /// T: how much of what lies behind still reaches the eye.
    through: f64,
}

impl Blend {
    /// Before the first surface.
    pub const START: Self = Self { color: [0.0; 3], through: 1.0 };

    /// The share T·o that a surface of this opacity would have, as the next one.
    pub fn share(&self, opacity: f64) -> f64 {
        self.through * opacity
    }

    /// Adds the next surface.
    pub fn add(&mut self, radiance: LinearRgb, opacity: f64) {
        self.add_share(radiance, self.share(opacity));
        self.through *= 1.0 - opacity;
    }

    /// Radiance and alpha over a background.
    pub fn over(mut self, background: LinearRgb) -> (LinearRgb, f64) {
        self.add_share(background, self.through);
        (self.color, 1.0 - self.through)
    }

    /// What has no share has no part either, not even an infinite one.
    fn add_share(&mut self, radiance: LinearRgb, share: f64) {
        if share > 0.0 {
            self.color = std::array::from_fn(|k| self.color[k] + share * radiance[k]);
        }
    }
}
