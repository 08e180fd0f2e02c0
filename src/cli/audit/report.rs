//! What an audit found, as text and as JSON.

use super::Audited;
use serde_json::{Value, json};
use truecast::check::foreign::depth::DEPTH_TOLERANCE_RELATIVE;
use truecast::check::foreign::stability::UNSTABLE_HALF_WIDTH_PIXELS;
use truecast::check::foreign::{Class, Finding, ForeignOutcome, Theirs};
use truecast::mesh::TriangleId;

/// Errors that the text names one by one, each with its way to look closer.
const NAMED_ERRORS: usize = 10;

/// Findings that the JSON document lists; --csv lists all.
const LISTED_FINDINGS: usize = 1000;

pub(super) fn text(audited: &Audited<'_>) -> String {
    let report = &audited.report;
    let errors = report.findings.iter().filter(|finding| finding.class.is_error()).count();
    let verdict = match report.outcome() {
        ForeignOutcome::Agreement => "no error in their picture".to_owned(),
        ForeignOutcome::Errors => format!("{errors} errors in their picture"),
        ForeignOutcome::NothingToCheck => {
            "nothing to check: neither sees a triangle anywhere".to_owned()
        }
    };
    let mut text = format!("{}: {verdict}\n", audited.path.display());
    text += &format!(
        "  {}x{} pixels, {} triangles, {} pixels covered; {:.2} s\n",
        report.window.width(),
        report.window.height(),
        audited.scene.mesh.len(),
        report.covered_pixels,
        audited.time.as_secs_f64(),
    );
    let counts: Vec<String> = Class::ALL
        .iter()
        .rev()
        .map(|&class| format!("{} {}", class.name(), report.count(class)))
        .collect();
    text += &format!("  {}\n", counts.join(", "));
    if report.count(Class::Unstable) > 0 {
        text += &format!(
            "  unstable: right for a sample at most 1/{:.0} px beside the centre\n",
            1.0 / UNSTABLE_HALF_WIDTH_PIXELS
        );
    }
    let close = |finding: &&Finding| {
        let gap = finding.gap.is_some_and(|gap| gap.abs() <= DEPTH_TOLERANCE_RELATIVE);
        gap && finding.class == Class::Wrong
    };
    let close = report.findings.iter().filter(close).count();
    if close > 0 {
        text += &format!(
            "  {close} of the wrong ones lie within {DEPTH_TOLERANCE_RELATIVE:.1e} of the visible \
             depth, relative: single precision hardly tells them apart\n"
        );
    }
    if let Some(diagnosis) = &report.diagnosis {
        text += &format!(
            "  diagnosis: {} (of {} pixels that differ, about {} would remain)\n",
            diagnosis.sentence, diagnosis.differing, diagnosis.remaining
        );
    }
    let worst = report.findings.iter().filter(|finding| finding.class.is_error());
    worst.take(NAMED_ERRORS).for_each(|finding| text += &lines(audited, finding));
    if errors > NAMED_ERRORS {
        text += &format!("  and {} more; --csv FILE lists all\n", errors - NAMED_ERRORS);
    }
    text
}

/// One finding, with both triangles and the way to look closer.
fn lines(audited: &Audited<'_>, finding: &Finding) -> String {
    let (x, y) = (finding.pixel.x, finding.pixel.y);
    let named =
        |id: TriangleId| format!("triangle {} ({})", id.get(), audited.scene.describe_source(id));
    let ours = finding.ours.map_or_else(|| "nothing".to_owned(), named);
    let mut text = format!("  ({x}, {y}) {}: ", finding.class.name());
    match finding.theirs {
        None => text += &format!("exact {ours}"),
        Some(Theirs::Nothing) => text += &format!("exact {ours}, theirs nothing"),
        Some(Theirs::Triangle(id)) if Some(id) == finding.ours => text += &ours,
        Some(Theirs::Triangle(id)) => text += &format!("exact {ours}, theirs {}", named(id)),
        Some(Theirs::Unknown(word)) => {
            text += &format!("exact {ours}, theirs {}", unknown(word));
        }
    }
    if let Some(gap) = finding.gap.filter(|gap| gap.is_finite()) {
        let side = if gap < 0.0 { "in front" } else { "behind" };
        text += &format!(", whose plane lies {:.1e} {side}", gap.abs());
    }
    if let Some(depth) = finding.depth {
        text += &format!(
            "; depth {}, exact {}, relative error {:.1e}",
            depth.theirs, depth.exact, depth.relative
        );
    }
    let size = audited
        .arguments
        .size
        .map_or_else(String::new, |size| format!(" --size {}x{}", size.width(), size.height()));
    text += &format!("\n    truecast pixel {} {x} {y}{size}\n", audited.path.display());
    text
}

fn unknown(word: i64) -> String {
    match word {
        i64::MIN => "no finite number".to_owned(),
        word => format!("{word}, which is no triangle"),
    }
}

pub(super) fn document(audited: &Audited<'_>) -> Value {
    let report = &audited.report;
    let counts: serde_json::Map<String, Value> = Class::ALL
        .iter()
        .map(|&class| (class.name().replace(' ', "_"), json!(report.count(class))))
        .collect();
    let theirs = |theirs: Option<Theirs>| match theirs {
        None | Some(Theirs::Nothing) => Value::Null,
        Some(Theirs::Triangle(id)) => json!(id.get()),
        Some(Theirs::Unknown(word)) => json!({ "no_triangle": word }),
    };
    let source = |id: Option<TriangleId>| id.map(|id| audited.scene.describe_source(id));
    let triangle = |theirs: Option<Theirs>| match theirs {
        Some(Theirs::Triangle(id)) => Some(id),
        _ => None,
    };
    json!({
        "schema": "truecast/audit/1",
        "scene": audited.path.display().to_string(),
        "ids": audited.arguments.foreign.ids.as_ref().map(|path| path.display().to_string()),
        "depth": audited.arguments.foreign.depth.as_ref().map(|path| path.display().to_string()),
        "outcome": match report.outcome() {
            ForeignOutcome::Agreement => "agreement",
            ForeignOutcome::Errors => "errors",
            ForeignOutcome::NothingToCheck => "nothing to check",
        },
        "window": [report.window.x0(), report.window.y0(), report.window.x1(), report.window.y1()],
        "triangles": audited.scene.mesh.len(),
        "covered_pixels": report.covered_pixels,
        "counts": counts,
        "unstable_half_width_pixels": UNSTABLE_HALF_WIDTH_PIXELS,
        "depth_tolerance_relative": audited.options.depth_tolerance,
        "diagnosis": report.diagnosis.as_ref().map(|diagnosis| json!({
            "sentence": diagnosis.sentence,
            "differing": diagnosis.differing,
            "remaining": diagnosis.remaining,
        })),
        "findings": report.findings.iter().take(LISTED_FINDINGS).map(|finding| json!({
            "x": finding.pixel.x,
            "y": finding.pixel.y,
            "class": finding.class.name(),
            "exact_id": finding.ours.map(TriangleId::get),
            "their_id": theirs(finding.theirs),
            "exact_source": source(finding.ours),
            "their_source": source(triangle(finding.theirs)),
            "gap_relative": finding.gap,
            "depth": finding.depth.map(|depth| json!({
                "theirs": depth.theirs,
                "exact": depth.exact,
                "relative": depth.relative,
            })),
        })).collect::<Vec<_>>(),
        "time_s": audited.time.as_secs_f64(),
    })
}
