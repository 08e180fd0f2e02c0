//! What each effect costs: exposing with all effects that a scene calls for, and without each.
//!
//! Wall-clock times, so never the same twice. The variants take turns, so that a machine that is
//! busy for a while is so for all of them, and the median of the rounds counts. Finding what is
//! visible at the pixel centres is not timed.

use super::answerer::Answerer;
use super::expose::expose;
use super::progress::Unwatched;
use crate::scene::Scene;
use crate::shade::Effects;
use crate::statistics::Statistics;
use crate::visibility::{Layers, VisibilityBuffer};
use std::hint::black_box;
use std::time::Instant;

/// What leaving one effect out saves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EffectTime {
    /// The effect.
    pub effect: Effects,
    /// Exposing with the other effects.
    pub without: Statistics,
    /// The part of the time that the effect takes, 0…1: 1 − without/with. Shares do not add up to
    /// 1: effects share set-up, and a light kind takes the terms of its lights with it.
    pub share: f64,
}

/// What exposing a frame costs.
#[derive(Clone, Debug, PartialEq)]
pub struct ShadingTimes {
    /// With all effects that the scene calls for.
    pub all: Statistics,
    /// With all of them but supersampling: the time that the shares of the others are parts of.
    pub one_sample: Statistics,
    /// Each effect that the scene calls for.
    pub effects: Vec<EffectTime>,
}

/// Times exposing in `rounds` rounds, after one that does not count; `None` for no round.
///
/// `answerer` and its answer are those of [`expose`].
pub fn measure(
    scene: &Scene,
    answerer: &Answerer,
    (nearest, layers): (&VisibilityBuffer, &Layers),
    rounds: usize,
) -> Option<ShadingTimes> {
    let needed = Effects::of(scene);
    let one_sample = needed.without(Effects::SUPERSAMPLING);
    let called: Vec<_> =
        Effects::NAMED.map(|(effect, _)| effect).into_iter().filter(|&e| needed.has(e)).collect();
    let mut variants = vec![one_sample];
    variants.extend(called.iter().map(|&effect| match effect {
        Effects::SUPERSAMPLING => needed,
        _ => one_sample.without(effect),
    }));
    let mut times = vec![Vec::new(); variants.len()];
    for round in 0..=rounds {
        for (times, &effects) in times.iter_mut().zip(&variants) {
            let started = Instant::now();
            black_box(expose(scene, answerer, (nearest, layers), effects, &Unwatched));
            if round > 0 {
                times.push(started.elapsed());
            }
        }
    }
    let times: Option<Vec<_>> = times.iter().map(|times| Statistics::of(times)).collect();
    let times = times?;
    let base = times[0];
    let mut all = base;
    let effects = called.into_iter().zip(&times[1..]).map(|(effect, &other)| {
        let (with, without) = match effect {
            Effects::SUPERSAMPLING => {
                all = other;
                (other, base)
            }
            _ => (base, other),
        };
        EffectTime { effect, without, share: share(with.median, without.median) }
    });
    let effects = effects.collect();
    Some(ShadingTimes { all, one_sample: base, effects })
}

/// 1 − without/with; an effect that measures as less than nothing takes nothing.
fn share(with: f64, without: f64) -> f64 {
    if with > 0.0 { (1.0 - without / with).clamp(0.0, 1.0) } else { 0.0 }
}
