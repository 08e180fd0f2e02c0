//! `truecast cost`: scenes in, what accuracy costs on them out.

use super::arguments::CostArguments;
use super::failure::Failure;
use super::output::{self, Writing};
use super::progress::Bar;
use super::{DIFFERENCE, OK, on_threads};
use std::path::{Path, PathBuf};
use truecast::bench::machine::Machine;
use truecast::cost::report::{to_csv, to_drawing, to_json, to_table};
use truecast::cost::{CostError, CostOptions, Prices, Report, Written, cost, standard};
use truecast::film::FilmError;

/// What prices can be written as.
#[derive(Clone, Copy)]
enum Format {
    Json,
    Csv,
    Svg,
}

pub(super) fn run(arguments: &CostArguments, writing: &Writing) -> Result<u8, Failure> {
    let targets = targets(&arguments.output)?;
    let threads = on_threads(arguments.threads, rayon::current_num_threads)?;
    let options = CostOptions { rounds: arguments.rounds, resolution: arguments.size };
    let mut all = arguments.scenes.iter().map(|path| read(path)).collect::<Result<Vec<_>, _>>()?;
    if all.is_empty() {
        all.push(standard());
    }
    // Every fault is reported before anything is timed.
    for written in &all {
        let scene = written.scene(&options)?;
        if !arguments.quiet {
            output::print_warnings(&scene.warnings);
        }
    }
    let bar = Bar::new(arguments.quiet);
    let mut scenes = Vec::new();
    for written in &all {
        let prices = on_threads(arguments.threads, || cost(written, &options, &bar));
        bar.finish();
        scenes.push(prices?.map_err(failure)?);
    }
    let report = Report { machine: Machine::here(), threads, rounds: arguments.rounds, scenes };
    for (path, format) in targets {
        let text = match format {
            Format::Json => format!("{:#}\n", to_json(&report)),
            Format::Csv => to_csv(&report),
            Format::Svg => to_drawing(&report).to_svg(),
        };
        output::save(writing, path, text.as_bytes())?;
    }
    if arguments.json {
        output::print_json(&to_json(&report));
    } else if !arguments.quiet {
        output::print(&to_table(&report));
    }
    Ok(if report.scenes.iter().any(Prices::has_failed) { DIFFERENCE } else { OK })
}

/// The files to write with their formats; refuses what cannot be written before any work is done.
fn targets(paths: &[PathBuf]) -> Result<Vec<(&Path, Format)>, Failure> {
    let mut targets = Vec::new();
    for path in paths {
        let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase());
        let format = match extension.as_deref() {
            Some("json") => Format::Json,
            Some("csv") => Format::Csv,
            Some("svg") => Format::Svg,
            _ => {
                return Err(Failure::usage(format!(
                    "{}: the name does not say what to write; end it in .json, .csv or .svg",
                    path.display()
                )));
            }
        };
        output::check_target(path)?;
        targets.push((path.as_path(), format));
    }
    Ok(targets)
}

fn read(path: &Path) -> Result<Written, Failure> {
    let unreadable = |error: std::io::Error| FilmError::Read {
        path: path.to_owned(),
        reason: error.to_string(),
    };
    let bytes = std::fs::read(path).map_err(unreadable)?;
    let text = String::from_utf8(bytes)
        .map_err(|_| Failure::Input(format!("{}: the scene file must be UTF-8", path.display())))?;
    let base = path.parent().unwrap_or(Path::new("")).to_owned();
    Ok(Written { name: path.to_owned(), text, base })
}

fn failure(error: CostError) -> Failure {
    match error {
        CostError::Scene(errors) => Failure::Scene(errors),
        error => Failure::Input(error.to_string()),
    }
}
