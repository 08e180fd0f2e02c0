//! A report as CSV: one line per scene and variant.

use crate::bench::Report;
use crate::render::visible::csv_field;
use crate::statistics::Statistics;
use std::fmt::Write;

/// Column names. Times of a wrong variant, wrong pixels of one that answers no question of
/// visibility and decisions of one that reports none are empty.
const HEADER: &str = "scene,width,height,triangles,threads,simd,program,work,name,n,median_ms,mad_ms,min_ms,max_ms,\
rate,rate_unit,wrong_pixels,decisions_f32,decisions_f64,decisions_exact";

/// A header, and one line per scene and variant.
pub fn to_csv(report: &Report) -> String {
    let mut text = format!("{HEADER}\n");
    for measured in &report.scenes {
        let subject = &measured.subject;
        for row in &measured.rows {
            // Writing to a String cannot fail.
            let _ = write!(
                text,
                "{},{},{},{},{},{},{},{},{},{}",
                csv_field(&subject.name),
                subject.resolution.width(),
                subject.resolution.height(),
                measured.triangles,
                subject.threads,
                subject.simd,
                csv_field(row.program.as_deref().unwrap_or("truecast")),
                row.work.name(),
                csv_field(&row.name),
                row.times.map_or(0, |times| times.n),
            );
            let milliseconds: [fn(&Statistics) -> f64; 4] =
                [|t| t.median, |t| t.deviation, |t| t.least, |t| t.most];
            for time in milliseconds {
                field(&mut text, row.times.as_ref().map(|times| 1e3 * time(times)));
            }
            field(&mut text, row.times.and_then(|t| t.millions_per_second(row.amount.count)));
            field(&mut text, Some(row.amount.unit.rate()));
            field(&mut text, row.wrong_pixels);
            field(&mut text, row.levels.map(|levels| levels.single));
            field(&mut text, row.levels.map(|levels| levels.double));
            field(&mut text, row.levels.map(|levels| levels.exact));
            text.push('\n');
        }
    }
    text
}

/// One more field; empty where there is no value.
fn field(text: &mut String, value: Option<impl std::fmt::Display>) {
    text.push(',');
    if let Some(value) = value {
        let _ = write!(text, "{value}");
    }
}
