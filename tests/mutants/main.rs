//! The mutation table: for every planted mistake, the hard case that catches it.
//!
//! `cargo test --release --features mutants --test mutants` plants each mistake of
//! [`truecast::mutant`] and lets the answerers that hold it loose on the case that its row names:
//! without the mistake every pixel must be right, with it at least one must be wrong, and the
//! answerers that do not hold it must stay right. A mistake that no pixel shows has survived, and
//! the run fails; so it does for a mistake without a row. The last rows are a control: an empty
//! mistake, which must be reported as a survivor.
//!
//! No test harness: the mistakes are planted process-wide, one after the other.

mod cases;
#[allow(dead_code, reason = "shared with the other tests, which use the rest")]
#[path = "../it/support/golden.rs"]
mod golden;
mod judge;
mod rows;
#[allow(dead_code, reason = "shared with the other tests, which use the rest")]
#[path = "../it/support/scenes.rs"]
mod scenes;

use judge::{Bench, Path};
use rows::{CONTROL, ROWS, Row};
use std::collections::BTreeMap;
use std::io::Write;
use std::process::ExitCode;
use std::time::Instant;
use truecast::mutant::{Mutant, plant};

/// A row's outcome on one path.
struct Line {
    mutant: Mutant,
    path: Path,
    case: &'static str,
    wrong: usize,
    pixels: usize,
}

fn main() -> ExitCode {
    let start = Instant::now();
    let mut benches = BTreeMap::new();
    let mut failures = Vec::new();
    let mut lines = Vec::new();
    for row in ROWS {
        lines.extend(judged(row, &mut benches, &mut failures));
    }
    for line in lines.iter().filter(|line| line.wrong == 0) {
        failures.push(format!("`{}` survives {} in {}", line.mutant.name(), line.case, line.path));
    }
    for mutant in Mutant::ALL {
        if *mutant != CONTROL.mutant && !ROWS.iter().any(|row| row.mutant == *mutant) {
            failures.push(format!("`{}` has no row", mutant.name()));
        }
    }
    // The control: a survivor is seen as one.
    let control = judged(&CONTROL, &mut benches, &mut failures);
    if control.iter().any(|line| line.wrong != 0) {
        failures.push("the control, which changes nothing, was caught".to_owned());
    }
    let report = report(&lines, &control, &failures, start.elapsed().as_secs_f64());
    let written = std::io::stdout().write_all(report.as_bytes());
    if failures.is_empty() && written.is_ok() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// Plants a row's mistake and counts wrong pixels on each of its paths; the other paths must not
/// notice it.
fn judged(
    row: &Row,
    benches: &mut BTreeMap<&'static str, Bench>,
    failures: &mut Vec<String>,
) -> Vec<Line> {
    let Row { mutant, case, .. } = *row;
    let bench = benches.entry(case).or_insert_with(|| {
        let bench = cases::bench(case);
        for path in Path::ALL {
            let wrong = bench.wrong_pixels(path);
            if wrong != 0 {
                failures.push(format!("{case}: {wrong} pixels wrong in {path} without a mistake"));
            }
        }
        bench
    });
    let mut lines = Vec::new();
    plant(Some(mutant));
    for path in Path::ALL {
        let wrong = bench.wrong_pixels(path);
        if row.paths.contains(&path) {
            lines.push(Line { mutant, path, case, wrong, pixels: bench.pixels() });
        } else if wrong != 0 && !ROWS.iter().any(|r| r.mutant == mutant && r.paths.contains(&path))
        {
            failures.push(format!("`{}` also shows in {path}, on {case}", mutant.name()));
        }
    }
    plant(None);
    lines
}

/// The table, what failed, and a summary.
fn report(lines: &[Line], control: &[Line], failures: &[String], seconds: f64) -> String {
    let mut text = format!(
        "{:20} {:6} {:42} {:>13}  what is broken\n",
        "mutant", "where", "killed by", "pixels wrong"
    );
    for line in lines.iter().chain(control) {
        let Line { mutant, path, case, wrong, pixels } = line;
        let killer = if *wrong == 0 { format!("SURVIVES {case}") } else { (*case).to_owned() };
        text += &format!(
            "{:20} {:6} {killer:42} {:>13}  {}\n",
            mutant.name(),
            path.to_string(),
            format!("{wrong}/{pixels}"),
            mutant.breaks()
        );
    }
    let mutants = Mutant::ALL.len() - 1;
    let killed = lines.iter().filter(|line| line.wrong != 0).count();
    text += &format!(
        "\n{mutants} mutants in {} places: {killed} killed, {} survive; the control survives in {} of {}; {seconds:.1} s\n",
        lines.len(),
        lines.len() - killed,
        control.iter().filter(|line| line.wrong == 0).count(),
        control.len(),
    );
    for failure in failures {
        text += &format!("FAILED: {failure}\n");
    }
    text
}
