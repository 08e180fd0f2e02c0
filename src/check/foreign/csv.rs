//! The findings about another program's picture as CSV, the worst first.

use super::{Finding, Theirs};
use crate::scene::Scene;
use std::fmt::Write;

/// Column names, in order. Ids are empty where nothing is visible; `theirs` is a number of our
/// counting, or the file's own where no triangle has it.
const HEADER: &str = "x,y,class,exact_id,their_id,exact_source,their_source,gap_relative,\
exact_depth,their_depth,depth_error_relative";

/// Writes a header and one line per finding.
pub fn to_csv(scene: &Scene, findings: &[Finding]) -> String {
    let mut text = String::from(HEADER);
    text.push('\n');
    for finding in findings {
        let (id, source) = match finding.theirs {
            None | Some(Theirs::Nothing) => (String::new(), String::new()),
            Some(Theirs::Triangle(id)) => (id.get().to_string(), scene.describe_source(id)),
            Some(Theirs::Unknown(word)) => (word.to_string(), "no such triangle".to_owned()),
        };
        // Writing to a String cannot fail.
        let _ = writeln!(
            text,
            "{},{},{},{},{id},{},{},{},{},{},{}",
            finding.pixel.x,
            finding.pixel.y,
            finding.class.name(),
            finding.ours.map_or_else(String::new, |id| id.get().to_string()),
            quoted(&finding.ours.map_or_else(String::new, |id| scene.describe_source(id))),
            quoted(&source),
            number(finding.gap),
            number(finding.depth.map(|depth| depth.exact)),
            number(finding.depth.map(|depth| depth.theirs)),
            number(finding.depth.map(|depth| depth.relative)),
        );
    }
    text
}

fn number(value: Option<f64>) -> String {
    value.map_or_else(String::new, |value| format!("{value:e}"))
}

/// A file name may hold commas and quotes (RFC 4180).
fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}
