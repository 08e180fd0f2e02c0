//! Rounds: every variant is checked, then all take turns, and each answer is checked again.
//!
//! Variants take turns so that a machine that is busy for a while is so for all of them. Only the
//! variant's own work is timed; comparing its answer and freeing it are not.

use super::reference::Reference;
use super::workload::{Amount, Answer, Variant, Work};
use crate::render::Progress;
use crate::statistics::Statistics;
use crate::visibility::LevelCounts;
use std::time::{Duration, Instant};

/// What is known of a variant in the end.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The variant.
    pub name: String,
    /// What kind of work it is.
    pub work: Work,
    /// What it works through.
    pub amount: Amount,
    /// The other program whose work it is; `None` for ours.
    pub program: Option<String>,
    /// Whether its answers are promised to be exact.
    pub is_exact: bool,
    /// Pixels at which its answer was wrong, the most in any run; `None` for a variant that answers
    /// no question of visibility.
    pub wrong_pixels: Option<usize>,
    /// Its times; `None` if a promise was broken. Where nothing is promised they stand beside the
    /// errors.
    pub times: Option<Statistics>,
    /// Decisions per level of arithmetic, where the variant reports them.
    pub levels: Option<LevelCounts>,
}

impl Row {
    /// Whether an answer that is promised to be exact was wrong, which is an error of this program
    /// and leaves no time.
    pub fn has_failed(&self) -> bool {
        self.is_exact && self.wrong_pixels.is_some_and(|wrong| wrong > 0)
    }
}

/// Checks every variant, then times those that have not failed `rounds` times, at least once. A
/// variant that has failed in any run has no times.
pub fn take_turns(
    variants: &[Variant<'_>],
    reference: &Reference,
    rounds: usize,
    progress: &dyn Progress,
) -> Vec<Row> {
    let rounds = rounds.max(1);
    progress.begin("bench", variants.len() * (rounds + 1));
    // This run also warms caches and the allocator, and its time does not count.
    let mut rows: Vec<Row> = variants
        .iter()
        .map(|variant| {
            let answer = variant.run();
            progress.step();
            Row {
                name: variant.name.clone(),
                work: variant.work,
                amount: variant.amount,
                program: variant.program.clone(),
                is_exact: variant.is_exact,
                wrong_pixels: wrong_pixels(&answer, reference),
                times: None,
                levels: match &answer {
                    Answer::Visibility(buffer) => Some(buffer.levels),
                    Answer::Nearest(buffer) => Some(buffer.borrow().levels),
                    _ => None,
                },
            }
        })
        .collect();
    let mut times: Vec<Vec<Duration>> = vec![Vec::new(); variants.len()];
    for _ in 0..rounds {
        for ((variant, row), times) in variants.iter().zip(&mut rows).zip(&mut times) {
            if !row.has_failed() {
                let started = Instant::now();
                let answer = variant.run();
                times.push(started.elapsed());
                row.wrong_pixels = row.wrong_pixels.max(wrong_pixels(&answer, reference));
            }
            progress.step();
        }
    }
    for (row, times) in rows.iter_mut().zip(&times) {
        if !row.has_failed() {
            row.times = Statistics::of(times);
        }
    }
    rows
}

fn wrong_pixels(answer: &Answer, reference: &Reference) -> Option<usize> {
    match answer {
        Answer::Visibility(buffer) => Some(reference.wrong_pixels(buffer)),
        Answer::Nearest(buffer) => {
            let buffer = buffer.borrow();
            Some(reference.wrong_ids(buffer.window, buffer.ids.iter().copied()))
        }
        Answer::Film(film) => Some(reference.wrong_pixels_of_film(film)),
        Answer::Hits(hits) => Some(reference.wrong_ids(hits.window, hits.ids())),
        Answer::Shadowed(shadowed) => Some(reference.wrong_shadows(shadowed)),
        Answer::Unchecked => None,
    }
}
