//! Settings take turns: each is run once and judged, then all are timed round by round.
//!
//! As in [`crate::bench::rounds`]; there an answer is right or wrong, here it is judged by how much.

use super::errors::Errors;
use super::frontier::mark_frontier;
use super::{Measure, Setting};
use crate::color::LinearRgb;
use crate::render::Progress;
use crate::statistics::Statistics;
use crate::visibility::{NearestBuffer, VisibilityBuffer};
use std::hint::black_box;
use std::time::{Duration, Instant};

/// What a candidate's timed work hands back.
pub(super) enum Output {
    /// Ids and t alone.
    Nearest(NearestBuffer),
    /// What is visible, and its colours.
    Picture(VisibilityBuffer, Vec<LinearRgb>),
}

/// A setting before it has a price.
pub(super) struct Candidate<'a> {
    pub(super) name: String,
    pub(super) family: &'static str,
    pub(super) triangles: usize,
    /// Name of the candidate that its time is divided by.
    pub(super) baseline: String,
    /// What is timed.
    pub(super) run: Box<dyn Fn() -> Output + 'a>,
    /// What is not: how far the output is from what is right.
    pub(super) judge: Box<dyn Fn(Output) -> Errors + 'a>,
}

/// Prices the candidates of a knob.
pub(super) fn take_turns(
    candidates: &[Candidate<'_>],
    measure: Measure,
    rounds: usize,
    (stage, progress): (&str, &dyn Progress),
) -> Vec<Setting> {
    let rounds = rounds.max(1);
    progress.begin(stage, candidates.len() * (rounds + 1));
    let judged = |candidate: &Candidate<'_>| {
        let errors = (candidate.judge)((candidate.run)());
        progress.step();
        errors
    };
    let errors: Vec<Errors> = candidates.iter().map(judged).collect();
    let mut times: Vec<Vec<Duration>> = vec![Vec::new(); candidates.len()];
    for _ in 0..rounds {
        for (candidate, times) in candidates.iter().zip(&mut times) {
            let started = Instant::now();
            let output = black_box((candidate.run)());
            times.push(started.elapsed());
            drop(output);
            progress.step();
        }
    }
    let times: Vec<Option<Statistics>> = times.iter().map(|times| Statistics::of(times)).collect();
    let median = |name: &str| {
        let index = candidates.iter().position(|candidate| candidate.name == name)?;
        Some(times[index]?.median)
    };
    let mut settings: Vec<Setting> = candidates
        .iter()
        .zip(&times)
        .zip(errors)
        .filter_map(|((candidate, times), errors)| {
            let times = (*times)?;
            Some(Setting {
                name: candidate.name.clone(),
                family: candidate.family,
                triangles: candidate.triangles,
                times,
                baseline: candidate.baseline.clone(),
                ratio: times.median / median(&candidate.baseline)?,
                errors,
                is_on_frontier: false,
            })
        })
        .collect();
    mark_frontier(&mut settings, measure);
    settings
}
