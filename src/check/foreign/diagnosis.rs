//! Many pixels differ: which one convention would explain them?
//!
//! Candidates are ways to lay out the picture (mirrored, transposed, shifted by half and whole
//! pixels) times ways to number it (another first id, another mark of nothing, ids counted per
//! mesh). Each is scored on a sample of pixels by how many would still differ. The best is named if
//! it removes nine tenths of the differences; nothing is ever applied.

mod sentence;

use super::ids::{Convention, IdPlane, Theirs};
use super::sample::Sampler;
use crate::mesh::TriangleId;
use crate::pixel::Pixel;
use crate::scene::Scene;
use crate::visibility::VisibilityBuffer;
use rayon::prelude::*;
use std::collections::HashMap;

/// Fewest differing pixels that are looked into: fewer say too little about a convention.
const FEWEST: usize = 8;

/// Share of the pixels with a triangle that must differ: programs that round to f32 differ in less.
const SHARE: f64 = 1.0 / 200.0;

/// Share of the differences that may remain under the convention that is named.
const REMAINING: f64 = 0.1;

/// Differing pixels, and as many agreeing ones, on which candidates are scored.
const SAMPLED: usize = 1024;

/// Furthest shift that is tried, in half pixels: two pixels.
const FURTHEST_HALF_PIXELS: i32 = 4;

/// Where their pixel lies in our frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layout {
    /// Where it should.
    Same,
    /// Rows from the bottom up.
    FlippedRows,
    /// Columns from right to left.
    FlippedColumns,
    /// Both: turned by half a turn.
    Turned,
    /// Rows and columns exchanged.
    Transposed,
    /// Their pixel shows what lies this far to the right and below, in half pixels.
    Shifted([i32; 2]),
}

/// How their numbers name triangles.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Numbering {
    /// First id and mark of nothing.
    pub convention: Convention,
    /// For each mesh of the scene, what is added to the ids of its triangles; empty for nothing.
    pub mesh_offsets: Vec<i64>,
}

/// The convention that explains most differences.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnosis {
    /// Where their pixels lie.
    pub layout: Layout,
    /// How their numbers name triangles.
    pub numbering: Numbering,
    /// What it is, and what to do about it: one sentence.
    pub sentence: String,
    /// Pixels that differ as things are.
    pub differing: usize,
    /// Pixels that would still differ, estimated from the sample.
    pub remaining: usize,
}

/// Looks for the convention, where enough pixels differ.
pub(super) fn diagnose(
    sampler: &Sampler<'_>,
    plane: &IdPlane,
    assumed: Convention,
    reference: &VisibilityBuffer,
    disputed: &[usize],
) -> Option<Diagnosis> {
    let least = SHARE * reference.covered_pixels() as f64;
    if disputed.len() < FEWEST || (disputed.len() as f64) < least {
        return None;
    }
    let numberings = numberings(sampler.scene, plane, assumed, reference, disputed);
    // Score every layout under every numbering.
    let sample = Sample::of(reference, disputed);
    let scored: Vec<(usize, Layout, Vec<f64>)> = layouts(reference)
        .into_par_iter()
        .map(|layout| {
            let seen = |&index: &usize| seen_at(sampler, reference, layout, index);
            let seen = [sample.disputed.iter(), sample.agreeing.iter()]
                .map(|part| part.map(seen).collect::<Vec<_>>());
            let scores = numberings.iter().map(|numbering| {
                let differ = |part: &[usize], seen: &[Option<TriangleId>]| {
                    let differs = |&(&i, &ours): &(&usize, &Option<TriangleId>)| {
                        !numbering.explains(sampler.scene, plane.words[i], ours)
                    };
                    part.iter().zip(seen).filter(differs).count()
                };
                sample.estimate([
                    differ(&sample.disputed, &seen[0]),
                    differ(&sample.agreeing, &seen[1]),
                ])
            });
            (usize::from(layout != Layout::Same), layout, scores.collect())
        })
        .collect();
    // The simplest that explains enough; a less simple one must leave a tenth of what it leaves.
    let mut best: Option<(usize, f64, Layout, usize)> = None;
    let mut candidates: Vec<_> = scored
        .iter()
        .flat_map(|(steps, layout, scores)| {
            let numbered = scores.iter().enumerate();
            numbered.map(move |(n, &score)| (steps + usize::from(n > 0), score, *layout, n))
        })
        .collect();
    candidates.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    for candidate in candidates.into_iter().filter(|candidate| candidate.0 > 0) {
        let bound = match best {
            None => REMAINING * disputed.len() as f64,
            Some((steps, remaining, ..)) if candidate.0 > steps => REMAINING * remaining,
            Some(_) => continue,
        };
        if candidate.1 <= bound && best.is_none_or(|best| candidate.1 < best.1) {
            best = Some(candidate);
        }
    }
    let (_, remaining, layout, number) = best?;
    let numbering = numberings[number].clone();
    Some(Diagnosis {
        layout,
        sentence: sentence::sentence(layout, &numbering, assumed, sampler.scene),
        numbering,
        differing: disputed.len(),
        remaining: remaining.round() as usize,
    })
}

/// The pixels on which candidates are scored.
struct Sample {
    disputed: Vec<usize>,
    agreeing: Vec<usize>,
    /// How many pixels one of each stands for.
    weights: [f64; 2],
}

impl Sample {
    /// Evenly spread over both kinds.
    fn of(reference: &VisibilityBuffer, disputed: &[usize]) -> Self {
        let mut is_disputed = vec![false; reference.window.len()];
        disputed.iter().for_each(|&index| is_disputed[index] = true);
        let agreeing: Vec<usize> =
            (0..is_disputed.len()).filter(|&index| !is_disputed[index]).collect();
        let spread = |all: &[usize]| -> Vec<usize> {
            let count = all.len().min(SAMPLED);
            (0..count).map(|i| all[i * all.len() / count]).collect()
        };
        let parts = [spread(disputed), spread(&agreeing)];
        let weight = |all: usize, part: &[usize]| all as f64 / part.len().max(1) as f64;
        let weights = [weight(disputed.len(), &parts[0]), weight(agreeing.len(), &parts[1])];
        let [disputed, agreeing] = parts;
        Self { disputed, agreeing, weights }
    }

    /// Pixels of the picture that would differ, from those of the sample that do.
    fn estimate(&self, differing: [usize; 2]) -> f64 {
        differing[0] as f64 * self.weights[0] + differing[1] as f64 * self.weights[1]
    }
}

impl Numbering {
    /// Whether `word` stands for what we see.
    fn explains(&self, scene: &Scene, word: i64, ours: Option<TriangleId>) -> bool {
        match (ours, self.convention.read(word, TriangleId::MAX_COUNT)) {
            (None, theirs) => theirs == Theirs::Nothing,
            (Some(_), Theirs::Nothing) => false,
            (Some(id), _) => {
                let offset = match self.mesh_offsets.get(scene.object_of(id).0) {
                    Some(&offset) => offset,
                    None => 0,
                };
                word.checked_sub(offset) == Some(i64::from(id.get()) + self.convention.base)
            }
        }
    }
}

/// The layouts that make sense for the picture, the assumed one first.
fn layouts(reference: &VisibilityBuffer) -> Vec<Layout> {
    let window = reference.window;
    let mut layouts = vec![Layout::Same];
    // A part of a frame may come from anywhere in a mirrored one; it is not tried.
    if window.x0() == 0 && window.y0() == 0 {
        layouts.extend([Layout::FlippedRows, Layout::FlippedColumns, Layout::Turned]);
        if window.width() == window.height() {
            layouts.push(Layout::Transposed);
        }
    }
    let range = -FURTHEST_HALF_PIXELS..=FURTHEST_HALF_PIXELS;
    let shifts = range.clone().flat_map(|x| range.clone().map(move |y| [x, y]));
    layouts.extend(shifts.filter(|&shift| shift != [0, 0]).map(Layout::Shifted));
    layouts
}

/// The numberings that make sense, the assumed one first.
fn numberings(
    scene: &Scene,
    plane: &IdPlane,
    assumed: Convention,
    reference: &VisibilityBuffer,
    disputed: &[usize],
) -> Vec<Numbering> {
    let is_nothing = |&&index: &&usize| reference.visible[index].is_none();
    let background = most_common(disputed.iter().filter(is_nothing).map(|&i| plane.words[i]));
    let mut conventions = vec![assumed];
    let bases = if assumed.base == 0 { [0, 1] } else { [assumed.base, 0] };
    for base in bases {
        for background in [assumed.background, background] {
            conventions.push(Convention { base, background });
        }
    }
    let starts: Vec<i64> =
        scene.objects.iter().map(|object| -i64::from(object.triangles.start)).collect();
    let mut numberings = Vec::new();
    for mesh_offsets in [Vec::new(), starts, common_offsets(scene, plane, assumed, reference)] {
        for &convention in &conventions {
            let numbering = Numbering { convention, mesh_offsets: mesh_offsets.clone() };
            if !numberings.contains(&numbering) {
                numberings.push(numbering);
            }
        }
    }
    // Of one mesh, offsets say no more than the base.
    numberings.retain(|numbering| scene.objects.len() > 1 || numbering.mesh_offsets.is_empty());
    numberings
}

/// For each mesh, by how much their ids most often differ from ours.
fn common_offsets(
    scene: &Scene,
    plane: &IdPlane,
    assumed: Convention,
    reference: &VisibilityBuffer,
) -> Vec<i64> {
    let mut offsets = vec![Vec::new(); scene.objects.len()];
    for (visible, &word) in reference.visible.iter().zip(&plane.words) {
        if let Some(visible) = visible
            && assumed.read(word, TriangleId::MAX_COUNT) != Theirs::Nothing
        {
            let id = visible.triangle;
            let offset = word.saturating_sub(i64::from(id.get()) + assumed.base);
            offsets[scene.object_of(id).0].push(offset);
        }
    }
    offsets.into_iter().map(|offsets| most_common(offsets.into_iter()).unwrap_or(0)).collect()
}

/// The most common number; of several, the smallest.
fn most_common(numbers: impl Iterator<Item = i64>) -> Option<i64> {
    let mut counts: HashMap<i64, usize> = HashMap::new();
    numbers.for_each(|number| *counts.entry(number).or_default() += 1);
    counts.into_iter().max_by_key(|&(number, count)| (count, -i128::from(number))).map(|(n, _)| n)
}

/// What we see where their pixel at `index` lies under a layout.
fn seen_at(
    sampler: &Sampler<'_>,
    reference: &VisibilityBuffer,
    layout: Layout,
    index: usize,
) -> Option<TriangleId> {
    let window = reference.window;
    let Pixel { x, y } = window.pixel(index);
    let at = |x: u32, y: u32| reference.at(Pixel { x, y }).map(|visible| visible.triangle);
    let (last_x, last_y) = (window.x1() - 1, window.y1() - 1);
    match layout {
        Layout::Same => at(x, y),
        Layout::FlippedRows => at(x, last_y - y),
        Layout::FlippedColumns => at(last_x - x, y),
        Layout::Turned => at(last_x - x, last_y - y),
        Layout::Transposed => at(y, x),
        Layout::Shifted([right, down]) => {
            let [x, y] = Pixel { x, y }.sample();
            let point = [x + 0.5 * f64::from(right), y + 0.5 * f64::from(down)];
            sampler.visible_at(point).map(|visible| visible.triangle)
        }
    }
}
