//! What is right at each pixel, before anything is timed.
//!
//! Where both paths agree their word counts, where they do not the arbiter's; it also looks at a
//! sample with a fixed seed, half of it beside a change of triangle, where errors live. A variant is
//! then wrong at a pixel if its triangle is another one, or its cover where it counts.

use crate::exact::{Arbiter, Shadows};
use crate::film::{Film, Samples};
use crate::mesh::TriangleId;
use crate::pixel::Window;
use crate::render::Progress;
use crate::scene::Scene;
use crate::scene::light_point::LightPoint;
use crate::visibility::{Cover, VisibilityBuffer};
use rayon::prelude::*;
use std::collections::BTreeSet;

/// Seed of the sample; any number does.
const SEED: u64 = 0x7472_7565_6265_6e63;

/// The id planes' mark of nothing.
const NOTHING: u32 = u32::MAX;

/// The right answer at every pixel of a window.
#[derive(Clone, Debug)]
pub struct Reference {
    window: Window,
    ids: Vec<Option<TriangleId>>,
    cover: Vec<Cover>,
    disputed: usize,
    audited: usize,
    /// Positions of the window, and whether what is visible there is in shadow.
    shadowed: Vec<(usize, bool)>,
}

impl Reference {
    /// Finds what is right from the answers of two independent paths, both with cover, for the same
    /// window.
    pub fn of(
        scene: &Scene,
        both: &[VisibilityBuffer; 2],
        audited_pixels: usize,
        progress: &dyn Progress,
    ) -> Self {
        let window = both[0].window;
        let mut ids: Vec<_> = both[0].visible.iter().map(|v| v.map(|v| v.triangle)).collect();
        let mut cover = both[0].cover.clone().unwrap_or_default();
        cover.resize(window.len(), Cover::default());
        let differ = |&index: &usize| {
            let id = |buffer: &VisibilityBuffer| buffer.visible[index].map(|v| v.triangle);
            let count = |buffer: &VisibilityBuffer| buffer.cover.as_ref().map(|all| all[index]);
            id(&both[0]) != id(&both[1]) || count(&both[0]) != count(&both[1])
        };
        let disputed: Vec<usize> = (0..window.len()).filter(differ).collect();
        let mut asked: BTreeSet<usize> = sample(window, &ids, audited_pixels);
        asked.extend(&disputed);
        let asked: Vec<usize> = asked.into_iter().collect();
        progress.begin("audit", asked.len());
        let arbiter = Arbiter::new(scene);
        let answers: Vec<_> = asked
            .par_iter()
            .map(|&index| {
                let answer = arbiter.answer(window.pixel(index));
                progress.step();
                answer
            })
            .collect();
        for (&index, answer) in asked.iter().zip(&answers) {
            ids[index] = answer.visible.map(|surface| surface.triangle);
            cover[index] = answer.cover;
        }
        let (disputed, audited) = (disputed.len(), asked.len());
        Self { window, ids, cover, disputed, audited, shadowed: Vec::new() }
    }

    /// Also says for up to `count` of the pixels at which something is visible whether anything
    /// stands between it and the light, in exact arithmetic alone.
    #[must_use]
    pub fn with_shadows(self, scene: &Scene, light: LightPoint, count: usize) -> Self {
        let shadows = Shadows::new(scene, light);
        let asked: Vec<_> = sample(self.window, &self.ids, count)
            .into_iter()
            .filter_map(|index| Some((index, self.ids[index]?)))
            .collect();
        let answer = |&(index, id): &(usize, TriangleId)| {
            let occluders = shadows.occluders(self.window.pixel(index), id, |_| true);
            (index, !occluders.is_empty())
        };
        Self { shadowed: asked.par_iter().map(answer).collect(), ..self }
    }

    /// At how many of the pixels that exact arithmetic looked at the answer about shadows is wrong;
    /// all of them if it is not for this window.
    pub fn wrong_shadows(&self, shadowed: &[bool]) -> usize {
        let is_wrong =
            |&&(index, expected): &&(usize, bool)| shadowed.get(index) != Some(&expected);
        self.shadowed.iter().filter(is_wrong).count()
    }

    /// Pixels at which a triangle is visible.
    pub fn covered_pixels(&self) -> usize {
        self.ids.iter().flatten().count()
    }

    /// Pixels at which the two paths differed.
    pub fn disputed_pixels(&self) -> usize {
        self.disputed
    }

    /// Pixels at which the arbiter was asked, the disputed ones among them.
    pub fn audited_pixels(&self) -> usize {
        self.audited
    }

    /// At how many pixels a buffer names another triangle or, if it counts, another cover; all of
    /// them if it is not for this window.
    pub fn wrong_pixels(&self, buffer: &VisibilityBuffer) -> usize {
        let counts = buffer.cover.as_ref();
        let fits = buffer.window == self.window
            && buffer.visible.len() == self.ids.len()
            && counts.is_none_or(|counts| counts.len() == self.ids.len());
        if !fits {
            return self.ids.len();
        }
        (0..self.ids.len())
            .filter(|&index| {
                buffer.visible[index].map(|visible| visible.triangle) != self.ids[index]
                    || counts.is_some_and(|counts| counts[index] != self.cover[index])
            })
            .count()
    }

    /// At how many pixels a film's plane `id.prim` names another triangle; all of them if it has no
    /// such plane for this window.
    pub fn wrong_pixels_of_film(&self, film: &Film) -> usize {
        match film.plane("id.prim") {
            Some(Samples::Uint(ids)) => self.wrong_ids(film.window, ids.iter().copied()),
            _ => self.ids.len(),
        }
    }

    /// At how many pixels of a window other ids than the right ones stand, row by row, with
    /// `u32::MAX` for nothing; all of them if it is another window.
    pub fn wrong_ids(&self, window: Window, ids: impl ExactSizeIterator<Item = u32>) -> usize {
        if window != self.window || ids.len() != self.ids.len() {
            return self.ids.len();
        }
        let expected = self.ids.iter().map(|id| id.map_or(NOTHING, TriangleId::get));
        ids.zip(expected).filter(|(found, expected)| found != expected).count()
    }
}

/// Up to `count` positions of the window, half of them beside a pixel with another triangle.
fn sample(window: Window, ids: &[Option<TriangleId>], count: usize) -> BTreeSet<usize> {
    if count >= window.len() {
        return (0..window.len()).collect();
    }
    let width = window.width() as usize;
    let is_edge = |&index: &usize| {
        (index % width > 0 && ids[index - 1] != ids[index])
            || (index >= width && ids[index - width] != ids[index])
    };
    let edges: Vec<usize> = (0..window.len()).filter(is_edge).collect();
    let mut chosen = BTreeSet::new();
    // Drawing may repeat a pixel; four draws per wanted one are enough wherever there are plenty.
    for draw in 0..4 * count as u64 {
        if chosen.len() >= count {
            break;
        }
        let below = |bound: usize| ((u128::from(random(draw)) * bound as u128) >> 64) as usize;
        chosen.insert(match edges.len() {
            many if many > 0 && draw % 2 == 0 => edges[below(many)],
            _ => below(window.len()),
        });
    }
    chosen
}

/// The finalizer of SplitMix64 over a counter: Steele, Lea and Flood, "Fast splittable
/// pseudorandom number generators" (2014).
fn random(number: u64) -> u64 {
    let mut z = SEED.wrapping_add(number.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15));
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}
