//! How a case judges: the right answer at every pixel, and how many pixels of a path differ.

use std::fmt;
use truecast::accel::{Accelerator, BuildPreset};
use truecast::cast::shadow::ShadowCaster;
use truecast::cast::{CastOptions, cast_with};
use truecast::exact::{Answer, Arbiter};
use truecast::pixel::Pixel;
use truecast::raster::rasterize_in_tiles;
use truecast::scene::Scene;
use truecast::scene::light_point::LightPoint;
use truecast::visibility::{Counting, Cover, VisibilityBuffer, Visible};

/// Who answers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Path {
    /// The ray caster, with its accelerator.
    Cast,
    /// The rasterizer.
    Raster,
    /// The arbiter.
    Exact,
}

impl Path {
    pub(crate) const ALL: [Self; 3] = [Self::Cast, Self::Raster, Self::Exact];
}

impl fmt::Display for Path {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Cast => "cast",
            Self::Raster => "raster",
            Self::Exact => "exact",
        })
    }
}

/// A case's scenes with their right answers.
pub(crate) struct Bench(Vec<Judged>);

struct Judged {
    scene: Scene,
    answers: Vec<Answer>,
    /// A light, and whether each pixel's surface is in its shadow.
    shadow: Option<(LightPoint, Vec<Option<bool>>)>,
}

/// Tiles that are smaller than the frames of the cases, so that tiles have edges in the picture,
/// and tiles that hold them whole, so that rows are long.
const TILE_SIDES: [u32; 2] = [4, 32];

/// Largest difference of a barycentric weight from the exact one: both paths promise a few 2^-50.
const WEIGHT_TOLERANCE: f64 = 1.0 / (1_u64 << 45) as f64;

impl Bench {
    /// Asks the arbiter, while nothing is planted.
    pub(crate) fn new(scenes: Vec<Scene>) -> Self {
        let judged = |scene: Scene| Judged { answers: answers(&scene), scene, shadow: None };
        Self(scenes.into_iter().map(judged).collect())
    }

    /// As [`Self::new`], with one scene and its light.
    pub(crate) fn with_light(scene: Scene, light: LightPoint) -> Self {
        let shadow = Some((light, shadows(&scene, light)));
        Self(vec![Judged { answers: answers(&scene), scene, shadow }])
    }

    /// Pixels whose surface a light reaches, and those in its shadow.
    pub(crate) fn lit_and_dark(&self) -> [usize; 2] {
        [false, true].map(|dark| {
            let all = self.0.iter().filter_map(|judged| judged.shadow.as_ref());
            all.flat_map(|(_, dark)| dark).filter(|&&found| found == Some(dark)).count()
        })
    }

    /// The right answers of the first scene.
    pub(crate) fn answers(&self) -> &[Answer] {
        &self.0[0].answers
    }

    /// Pixels of all scenes.
    pub(crate) fn pixels(&self) -> usize {
        self.0.iter().map(|judged| judged.answers.len()).sum()
    }

    /// Pixels at which a triangle is visible.
    pub(crate) fn covered(&self) -> usize {
        let all = self.0.iter().flat_map(|judged| &judged.answers);
        all.filter(|answer| answer.visible.is_some()).count()
    }

    /// Pixels at which a path gives a wrong answer, in any of its ways of working.
    pub(crate) fn wrong_pixels(&self, path: Path) -> usize {
        self.0.iter().map(|judged| judged.wrong_pixels(path)).sum()
    }
}

impl Judged {
    fn wrong_pixels(&self, path: Path) -> usize {
        let Self { scene, answers: right, .. } = self;
        let window = scene.camera.resolution().window();
        let buffers: Vec<VisibilityBuffer> = match path {
            Path::Cast => {
                let tree = Accelerator::build(&scene.mesh, BuildPreset::Medium);
                [Counting::All, Counting::Nearest]
                    .into_iter()
                    .zip(TILE_SIDES)
                    .map(|(counting, side)| {
                        let options = CastOptions { side, ..CastOptions::default() };
                        cast_with(scene, &tree, window, counting, options, &|| ())
                    })
                    .collect()
            }
            Path::Raster => [Counting::All, Counting::Nearest]
                .into_iter()
                .zip(TILE_SIDES)
                .map(|(counting, side)| rasterize_in_tiles(scene, window, counting, side, &|| ()))
                .collect(),
            Path::Exact => {
                let found = answers(scene);
                let wrong = found.iter().zip(right).filter(|(found, right)| found != right).count();
                return wrong + self.wrong_shadows(|light| shadows(scene, light));
            }
        };
        let is_wrong = |index: &usize| {
            buffers.iter().any(|buffer| {
                let cover = buffer.cover.as_ref().map(|cover| cover[*index]);
                !is_right(buffer.visible[*index].as_ref(), cover, &right[*index])
            })
        };
        let wrong = (0..right.len()).filter(is_wrong).count();
        match path {
            Path::Cast => {
                wrong + self.wrong_shadows(|light| cast_shadows(scene, light, &buffers[0]))
            }
            _ => wrong,
        }
    }

    /// Pixels whose shadow is another than the right one, if the scene has a light.
    fn wrong_shadows(&self, found: impl FnOnce(LightPoint) -> Vec<Option<bool>>) -> usize {
        let Some((light, right)) = &self.shadow else { return 0 };
        found(*light).iter().zip(right).filter(|(found, right)| found != right).count()
    }
}

/// The arbiter's shadows.
fn shadows(scene: &Scene, light: LightPoint) -> Vec<Option<bool>> {
    let arbiter = Arbiter::new(scene);
    let pixels = scene.camera.resolution().window().pixels();
    pixels.map(|pixel| arbiter.is_shadowed(pixel, light, |_| true)).collect()
}

/// The caster's shadows of what it sees.
fn cast_shadows(scene: &Scene, light: LightPoint, seen: &VisibilityBuffer) -> Vec<Option<bool>> {
    let tree = Accelerator::build(&scene.mesh, BuildPreset::Medium);
    let mut caster = ShadowCaster::new(scene, &tree);
    let mut shadow = |pixel: Pixel| {
        let visible = seen.at(pixel)?;
        Some(caster.occluder(pixel, visible, light, |_| true).is_some())
    };
    seen.window.pixels().map(&mut shadow).collect()
}

fn answers(scene: &Scene) -> Vec<Answer> {
    let arbiter = Arbiter::new(scene);
    scene.camera.resolution().window().pixels().map(|pixel| arbiter.answer(pixel)).collect()
}

/// Whether a path's answer is the right one in every field.
fn is_right(found: Option<&Visible>, cover: Option<Cover>, right: &Answer) -> bool {
    let surface = match (found, &right.visible) {
        (None, None) => true,
        (Some(found), Some(right)) => {
            let weights = found.barycentric.0.iter().zip(right.barycentric.0);
            found.triangle == right.triangle
                && found.facing == right.facing
                && found.tie == right.tie
                && found.t_lo <= right.t_lo
                && right.t_hi <= found.t_hi
                && weights.into_iter().all(|(a, b)| (a - b).abs() <= WEIGHT_TOLERANCE)
        }
        _ => false,
    };
    surface && cover.is_none_or(|cover| cover == right.cover)
}
