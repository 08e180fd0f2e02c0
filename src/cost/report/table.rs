//! Prices as tables for a terminal.

use crate::cost::{Knob, Prices, Report};
use crate::statistics::NOISY_SPREAD;
use std::fmt::Write;

/// A table per knob and scene, each with its reading. Writing to a String cannot fail, so results of
/// `write!` are dropped.
pub fn to_table(report: &Report) -> String {
    let machine = &report.machine;
    let mut text = format!(
        "truecast {}, threads: {}, {} rounds; {}\n",
        machine.version,
        report.threads,
        report.rounds,
        machine.cpu.as_deref().unwrap_or("unknown processor"),
    );
    for prices in &report.scenes {
        scene(&mut text, prices);
    }
    text
}

fn scene(text: &mut String, prices: &Prices) {
    let _ = writeln!(
        text,
        "\n{}: {}x{} pixels, {} triangles, {} pixels covered",
        prices.scene,
        prices.resolution.width(),
        prices.resolution.height(),
        prices.triangles,
        prices.covered_pixels,
    );
    prices.knobs.iter().for_each(|own| knob(text, own));
    for left_out in &prices.left_out {
        let _ = writeln!(text, "\n{left_out}");
    }
}

fn knob(text: &mut String, knob: &Knob) {
    let _ = writeln!(text, "\n{}: time of {}", knob.name, knob.timed);
    let _ = writeln!(text, "errors against {}", knob.against);
    let width = knob.settings.iter().map(|s| s.name.chars().count()).max().unwrap_or(0).max(8);
    let _ = writeln!(
        text,
        "  {:<width$} {:>10} {:>10} {:>8} {:>7} {:>8} {:>10} {:>10} {:>10}",
        "",
        "triangles",
        "median ms",
        "MAD ms",
        "ratio",
        "wrong",
        "max depth",
        "max rad.",
        "RMS rad."
    );
    for setting in &knob.settings {
        let errors = &setting.errors;
        let _ = writeln!(
            text,
            "{} {:<width$} {:>10} {:>10.3} {:>8.3} {:>7.2} {:>8} {:>10} {:>10} {:>10}",
            if setting.is_on_frontier { '*' } else { ' ' },
            setting.name,
            setting.triangles,
            1e3 * setting.times.median,
            1e3 * setting.times.deviation,
            setting.ratio,
            errors.wrong_pixels,
            error(errors.depth_max),
            error(errors.radiance_max),
            error(errors.radiance_rms),
        );
    }
    let mut baselines: Vec<&str> = knob.settings.iter().map(|s| &*s.baseline).collect();
    baselines.dedup();
    let _ = writeln!(
        text,
        "*: no other is as fast and as right by {}; ratio: to {}; wrong: pixels; errors of depth and \
         radiance: the scene's units",
        knob.measure.name(),
        baselines.join(", or "),
    );
    let noisy: Vec<&str> =
        knob.settings.iter().filter(|s| s.times.is_noisy()).map(|s| &*s.name).collect();
    if !noisy.is_empty() {
        let _ = writeln!(
            text,
            "noisy, MAD above {:.0} % of the median: {}; let the machine rest or raise --rounds",
            100.0 * NOISY_SPREAD,
            noisy.join("; "),
        );
    }
    let _ = writeln!(text, "{}", knob.reading);
}

fn error(value: f64) -> String {
    if value == 0.0 { "0".to_owned() } else { format!("{value:.2e}") }
}
