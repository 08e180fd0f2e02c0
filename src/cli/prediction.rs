//! What `render` picks where no path is asked for, in words and numbers.

use serde_json::{Value, json};
use truecast::accel::BuildPreset;
use truecast::render::{Prediction, VisibilityPath};

/// The word of `--path`.
pub(super) fn path_name(path: VisibilityPath) -> &'static str {
    match path {
        VisibilityPath::Cast => "cast",
        VisibilityPath::Raster => "raster",
    }
}

/// A preset's name.
pub(super) fn preset_name(preset: BuildPreset) -> &'static str {
    match preset {
        BuildPreset::Fastest => "fastest",
        BuildPreset::Fast => "fast",
        BuildPreset::Medium => "medium",
        BuildPreset::Slow => "slow",
        BuildPreset::VerySlow => "very slow",
    }
}

/// The ways to render, the quickest first: a line each.
pub(super) fn lines(ways: &[Prediction]) -> String {
    let line = |(position, way): (usize, &Prediction)| {
        let tree = way.preset.map_or_else(String::new, |preset| {
            let build = milliseconds(way.build);
            format!(", of them {build:.1} for a BVH ({})", preset_name(preset))
        });
        format!(
            "{:<11}{:<6} {:.1} ms of one core predicted{tree}{}\n",
            if position == 0 { "path" } else { "" },
            path_name(way.path),
            milliseconds(way.total()),
            if position == 0 { "; render picks it, for all answer the same" } else { "" },
        )
    };
    ways.iter().enumerate().map(line).collect()
}

/// The same for programs.
pub(super) fn predictions_document(ways: &[Prediction]) -> Value {
    let document = |way: &Prediction| {
        json!({
            "path": path_name(way.path),
            "preset": way.preset.map(preset_name),
            "build_ms": milliseconds(way.build),
            "rays_ms": milliseconds(way.rays),
            "total_ms": milliseconds(way.total()),
        })
    };
    ways.iter().map(document).collect()
}

/// Core milliseconds, rounded to microseconds.
fn milliseconds(seconds: f64) -> f64 {
    (1e6 * seconds).round() / 1e3
}
