//! `truecast explain --measure`: what each effect costs, in words and numbers.

use serde_json::{Value, json};
use truecast::accel::BuildPreset;
use truecast::render::{self, Answerer, EffectTime, ShadingTimes, Unwatched, VisibilityPath};
use truecast::scene::Scene;
use truecast::shade::Effects;
use truecast::visibility::Counting;

/// How often each time is taken: an odd number, so that the median is one of them.
const ROUNDS: usize = 7;

/// Sees the scene once and times its shading.
pub(super) fn measure(scene: &Scene) -> Option<ShadingTimes> {
    let path = VisibilityPath::default();
    let answerer = Answerer::new(scene, path, BuildPreset::Medium, &Unwatched);
    let window = scene.camera.resolution().window();
    let nearest = answerer.see(scene, window, Counting::Nearest, &Unwatched);
    let layers = answerer.see_through(scene, &nearest, &Unwatched);
    render::measure(scene, &answerer, (&nearest, &layers), ROUNDS)
}

/// The effect's cell of the table's column "share of shading".
pub(super) fn column(times: &ShadingTimes, effect: &str) -> String {
    let share = time_of(times, effect).map(|time| format!("{:.1} %", 100.0 * time.share));
    format!("{:>16}  ", share.unwrap_or_else(|| "-".to_owned()))
}

/// The line below the table.
pub(super) fn summary(times: &ShadingTimes, scene: &Scene) -> String {
    let frame = scene.camera.resolution();
    let mut line = format!(
        "\nshading    {:.2} ms (+-{:.2}), {:.2} Mpixel/s at {}x{}",
        milliseconds(times.all.median),
        milliseconds(times.all.deviation),
        megapixels_per_second(scene, times).unwrap_or(f64::INFINITY),
        frame.width(),
        frame.height()
    );
    if times.all != times.one_sample {
        let one = milliseconds(times.one_sample.median);
        line += &format!("; {one:.2} ms with one sample per pixel, of which the shares are");
    }
    line + &format!("; median of {ROUNDS} rounds\n")
}

/// Adds the numbers of an effect that is on to its entry.
pub(super) fn add_to_effect(times: &ShadingTimes, effect: &str, entry: &mut Value) {
    if let Some(time) = time_of(times, effect) {
        entry["share"] = json!(time.share);
        entry["median_ms"] = json!(milliseconds(time.without.median));
        entry["mad_ms"] = json!(milliseconds(time.without.deviation));
    }
}

/// The numbers of the whole.
pub(super) fn document(times: &ShadingTimes, scene: &Scene) -> Value {
    json!({
        "median_ms": milliseconds(times.all.median),
        "mad_ms": milliseconds(times.all.deviation),
        "one_sample_median_ms": milliseconds(times.one_sample.median),
        "one_sample_mad_ms": milliseconds(times.one_sample.deviation),
        "megapixels_per_second": megapixels_per_second(scene, times),
        "rounds": ROUNDS,
    })
}

fn time_of<'a>(times: &'a ShadingTimes, effect: &str) -> Option<&'a EffectTime> {
    let (wanted, _) = Effects::NAMED.into_iter().find(|(_, name)| *name == effect)?;
    times.effects.iter().find(|time| time.effect == wanted)
}

fn megapixels_per_second(scene: &Scene, times: &ShadingTimes) -> Option<f64> {
    times.all.millions_per_second(scene.camera.resolution().window().len())
}

fn milliseconds(seconds: f64) -> f64 {
    1e3 * seconds
}
