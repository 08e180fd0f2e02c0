//! A report as one JSON document with stable keys, which a later one can be compared with.

use crate::bench::baseline::Compared;
use crate::bench::counters::Counters;
use crate::bench::kernels::TreeFigures;
use crate::bench::rivalry::{Rivalry, price_of_proof, rivalries};
use crate::bench::rounds::Row;
use crate::bench::{Measured, Report};
use serde_json::{Value, json};

/// The value of the document's key `schema`.
pub const SCHEMA: &str = "truecast/bench/2";

/// The document. Times are in milliseconds and unrounded; a wrong variant's are `null`.
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
        "rounds": report.rounds,
        "scenes": report.scenes.iter().map(scene).collect::<Vec<_>>(),
        "comparison": report
            .comparison
            .as_ref()
            .map(|all| all.iter().map(compared).collect::<Vec<_>>()),
    })
}

fn scene(measured: &Measured) -> Value {
    let subject = &measured.subject;
    json!({
        "scene": subject.name,
        "digest": subject.digest,
        "width": subject.resolution.width(),
        "height": subject.resolution.height(),
        "threads": subject.threads,
        "simd": subject.simd.name(),
        "triangles": measured.triangles,
        "covered_pixels": measured.covered_pixels,
        "disputed_pixels": measured.disputed_pixels,
        "audited_pixels": measured.audited_pixels,
        "trees": measured.trees.iter().map(tree).collect::<Vec<_>>(),
        "rows": measured.rows.iter().map(|r| row(measured, r)).collect::<Vec<_>>(),
        "rivalries": rivalries(&measured.rows).iter().map(rivalry).collect::<Vec<_>>(),
        "price_of_proof": price_of_proof(&measured.rows),
        "counters": measured.counters.iter().map(counters).collect::<Vec<_>>(),
        "left_out": measured.left_out,
    })
}

fn tree(figures: &TreeFigures) -> Value {
    json!({
        "preset": figures.preset,
        "depth": figures.depth,
        "nodes": figures.nodes,
        "bytes": figures.bytes,
        "bytes_per_triangle": figures.bytes_per_triangle,
        "surface_area_cost": figures.surface_area_cost,
    })
}

fn counters(counters: &Counters) -> Value {
    let counts = counters.counts.iter();
    let counts = counts.map(|&(what, count)| (what.replace(' ', "_"), json!(count)));
    json!({ "name": counters.name, "counts": counts.collect::<serde_json::Map<_, _>>() })
}

fn row(measured: &Measured, row: &Row) -> Value {
    let pixels = measured.subject.resolution.window().len() as f64;
    let times = row.times.as_ref();
    json!({
        "name": row.name,
        "work": row.work.name(),
        "program": row.program,
        "exact": row.is_exact,
        "wrong_pixels": row.wrong_pixels,
        "n": times.map_or(0, |times| times.n),
        "median_ms": times.map(|times| 1e3 * times.median),
        "mad_ms": times.map(|times| 1e3 * times.deviation),
        "min_ms": times.map(|times| 1e3 * times.least),
        "max_ms": times.map(|times| 1e3 * times.most),
        "spread": times.map(|times| times.spread()),
        "noisy": times.map(|times| times.is_noisy()),
        "rate": times.and_then(|times| times.millions_per_second(row.amount.count)),
        "rate_unit": row.amount.unit.rate(),
        "decisions": row.levels.map(|levels| json!({
            "f32": levels.single,
            "f64": levels.double,
            "exact": levels.exact,
            "per_pixel": (levels.single + levels.double + levels.exact) as f64 / pixels,
        })),
    })
}

fn rivalry(rivalry: &Rivalry) -> Value {
    json!({
        "program": rivalry.program,
        "theirs": rivalry.theirs,
        "ours": rivalry.ours,
        "ratio": rivalry.ratio,
        "ratio_of_min": rivalry.ratio_of_least,
    })
}

fn compared(compared: &Compared) -> Value {
    json!({
        "scene": compared.scene,
        "name": compared.name,
        "old_median_ms": 1e3 * compared.old.median,
        "old_mad_ms": 1e3 * compared.old.deviation,
        "new_median_ms": 1e3 * compared.new.median,
        "new_mad_ms": 1e3 * compared.new.deviation,
        "ratio": compared.ratio(),
        "regression": compared.is_regression(),
    })
}
