//! A report as tables for a terminal.

use crate::bench::baseline::Compared;
use crate::bench::kernels::{PROVEN, UNPROVEN};
use crate::bench::rivalry::{price_of_proof, rivalries};
use crate::bench::rounds::Row;
use crate::bench::{Measured, Report};
use crate::statistics::NOISY_SPREAD;
use std::fmt::Write;

/// The tables of every scene, what is noise among them, and the comparison. Writing to a String
/// cannot fail, so results of `write!` are dropped.
pub fn to_table(report: &Report) -> String {
    let machine = &report.machine;
    let mut text = format!(
        "truecast {} ({}, commit {}), {} rounds; {}, {} logical cores\n",
        machine.version,
        machine.rustc.unwrap_or("unknown compiler"),
        machine.commit.unwrap_or("not told"),
        report.rounds,
        machine.cpu.as_deref().unwrap_or("unknown processor"),
        machine.logical_cores.map_or_else(|| "?".to_owned(), |cores| cores.to_string()),
    );
    for measured in &report.scenes {
        scene(&mut text, measured);
    }
    if let Some(comparison) = &report.comparison {
        compare(&mut text, comparison);
    }
    text
}

fn scene(text: &mut String, measured: &Measured) {
    let subject = &measured.subject;
    let _ = writeln!(
        text,
        "\n{}: {}x{} pixels, {} triangles, {} pixels covered; threads: {}, SIMD: {}",
        subject.name,
        subject.resolution.width(),
        subject.resolution.height(),
        measured.triangles,
        measured.covered_pixels,
        subject.threads,
        subject.simd,
    );
    let _ = writeln!(
        text,
        "answers held against both paths at every pixel and exact arithmetic at {} ({} in dispute)",
        measured.audited_pixels, measured.disputed_pixels,
    );
    let _ = writeln!(
        text,
        "{:<27} {:>12} {:>10} {:>12} {:>22} {:>12}",
        "", "median ms", "MAD ms", "min ms", "rate", "wrong pixels"
    );
    measured.rows.iter().for_each(|row| time(text, row));
    for rivalry in rivalries(&measured.rows) {
        let _ = writeln!(
            text,
            "closest hit: {} is {:.2} times as fast as {}, the best of {} ({:.2} by least times)",
            rivalry.ours, rivalry.ratio, rivalry.theirs, rivalry.program, rivalry.ratio_of_least,
        );
    }
    if let Some(price) = price_of_proof(&measured.rows) {
        let _ = writeln!(text, "proof: {PROVEN} takes {price:.2} of the time of {UNPROVEN}");
    }
    for left_out in &measured.left_out {
        let _ = writeln!(text, "{left_out}");
    }
    let noisy: Vec<&str> = measured.rows.iter().filter(|r| is_noisy(r)).map(|r| &*r.name).collect();
    if !noisy.is_empty() {
        let _ = writeln!(
            text,
            "noisy, MAD above {:.0} % of the median: {}; let the machine rest or raise --rounds",
            100.0 * NOISY_SPREAD,
            noisy.join("; "),
        );
    }
    let _ = writeln!(
        text,
        "{:<27} {:>12} {:>10} {:>12} {:>22}",
        "tree", "inner nodes", "depth", "B/triangle", "area cost, tests/ray"
    );
    for tree in &measured.trees {
        let cost = tree.surface_area_cost.map_or_else(|| "-".to_owned(), |c| format!("{c:.2}"));
        let _ = writeln!(
            text,
            "{:<27} {:>12} {:>10} {:>12.1} {:>22}",
            tree.preset, tree.nodes, tree.depth, tree.bytes_per_triangle, cost
        );
    }
    count(text, measured);
    let _ = writeln!(
        text,
        "{:<27} {:>12} {:>10} {:>12} {:>22}",
        "decisions", "f32", "f64", "exact", "all, per pixel"
    );
    for row in &measured.rows {
        let Some(levels) = row.levels else { continue };
        let all = (levels.single + levels.double + levels.exact) as f64;
        if all == 0.0 {
            continue;
        }
        let _ = writeln!(
            text,
            "{:<27} {:>12} {:>10} {:>12} {:>22.2}",
            row.name,
            levels.single,
            levels.double,
            levels.exact,
            all / subject.resolution.window().len() as f64
        );
    }
}

/// What kernels do, per pixel of the frame.
fn count(text: &mut String, measured: &Measured) {
    let pixels = measured.subject.resolution.window().len() as f64;
    let _ = writeln!(text, "per pixel, counted on the lowest instruction set");
    for counters in &measured.counters {
        let counts = counters.counts.iter();
        let per_pixel: Vec<String> =
            counts.map(|&(what, count)| format!("{:.3} {what}", count as f64 / pixels)).collect();
        let _ = writeln!(text, "{:<27} {}", counters.name, per_pixel.join(", "));
    }
}

fn is_noisy(row: &Row) -> bool {
    row.times.is_some_and(|times| times.is_noisy())
}

fn time(text: &mut String, row: &Row) {
    let wrong = row.wrong_pixels.map_or_else(|| "-".to_owned(), |wrong| wrong.to_string());
    let Some(times) = &row.times else {
        let _ = writeln!(
            text,
            "{:<27} {:>12} {:>10} {:>12} {:>22} {wrong:>12}",
            row.name, "-", "-", "-", "wrong, so no time"
        );
        return;
    };
    let rate = times.millions_per_second(row.amount.count);
    let rate = rate.map_or_else(String::new, |r| format!("{r:.3} {}", row.amount.unit.rate()));
    let _ = writeln!(
        text,
        "{:<27} {:>12.3} {:>10.3} {:>12.3} {rate:>22} {wrong:>12}",
        row.name,
        1e3 * times.median,
        1e3 * times.deviation,
        1e3 * times.least,
    );
}

fn compare(text: &mut String, comparison: &[Compared]) {
    let slower: Vec<&Compared> = comparison.iter().filter(|c| c.is_regression()).collect();
    let _ = writeln!(
        text,
        "\nbaseline: {} rows compared, {} slower beyond noise",
        comparison.len(),
        slower.len()
    );
    for compared in slower {
        let _ = writeln!(
            text,
            "slower: {}, {}: {:.3} ms, was {:.3} ms ({:.2} times)",
            compared.scene,
            compared.name,
            1e3 * compared.new.median,
            1e3 * compared.old.median,
            compared.ratio(),
        );
    }
}
