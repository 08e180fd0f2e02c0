//! Prices as one JSON document with stable keys.

use crate::cost::{Knob, Prices, Report, Setting};
use serde_json::{Value, json};

/// The value of the document's key `schema`.
pub const SCHEMA: &str = "truecast/cost/1";

/// The document. Times are in milliseconds, depths and radiances in the scene's units, all unrounded.
pub fn to_json(report: &Report) -> Value {
    json!({
        "schema": SCHEMA,
        "version": report.machine.version,
        "machine": {
            "logical_cores": report.machine.logical_cores,
            "cpu": report.machine.cpu,
            "rustc": report.machine.rustc,
            "commit": report.machine.commit,
        },
        "threads": report.threads,
        "rounds": report.rounds,
        "scenes": report.scenes.iter().map(scene).collect::<Vec<_>>(),
    })
}

fn scene(prices: &Prices) -> Value {
    json!({
        "scene": prices.scene,
        "width": prices.resolution.width(),
        "height": prices.resolution.height(),
        "triangles": prices.triangles,
        "covered_pixels": prices.covered_pixels,
        "knobs": prices.knobs.iter().map(knob).collect::<Vec<_>>(),
        "left_out": prices.left_out,
    })
}

fn knob(knob: &Knob) -> Value {
    json!({
        "knob": knob.name,
        "timed": knob.timed,
        "against": knob.against,
        "measure": knob.measure.name(),
        "reading": knob.reading,
        "settings": knob.settings.iter().map(setting).collect::<Vec<_>>(),
    })
}

fn setting(setting: &Setting) -> Value {
    json!({
        "name": setting.name,
        "family": setting.family,
        "triangles": setting.triangles,
        "n": setting.times.n,
        "median_ms": 1e3 * setting.times.median,
        "mad_ms": 1e3 * setting.times.deviation,
        "min_ms": 1e3 * setting.times.least,
        "max_ms": 1e3 * setting.times.most,
        "spread": setting.times.spread(),
        "noisy": setting.times.is_noisy(),
        "baseline": setting.baseline,
        "ratio": setting.ratio,
        "wrong_pixels": setting.errors.wrong_pixels,
        "max_depth_error": setting.errors.depth_max,
        "max_radiance_error": setting.errors.radiance_max,
        "rms_radiance_error": setting.errors.radiance_rms,
        "frontier": setting.is_on_frontier,
    })
}
