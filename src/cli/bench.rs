//! `truecast bench`: scenes in, times of right answers out.

use super::arguments::BenchArguments;
use super::failure::Failure;
use super::output::{self, Writing};
use super::progress::Bar;
use super::render::DEFAULT_SCENE;
use super::{DIFFERENCE, OK, on_threads};
use std::path::{Path, PathBuf};
use truecast::bench::baseline::{Baseline, BaselineError};
use truecast::bench::machine::Machine;
use truecast::bench::report::{to_csv, to_json, to_table};
use truecast::bench::{BenchOptions, Report, Subject, bench};
use truecast::film::FilmError;
use truecast::scene::{Overrides, Scene};

/// What a report can be written as.
#[derive(Clone, Copy)]
enum Format {
    Json,
    Csv,
}

pub(super) fn run(arguments: &BenchArguments, writing: &Writing) -> Result<u8, Failure> {
    let targets = targets(&arguments.output)?;
    let threads = on_threads(arguments.threads, rayon::current_num_threads)?;
    let scenes = load(arguments)?;
    let machine = Machine::here();
    let baseline = arguments.baseline.as_deref().map(read_baseline).transpose()?;
    if let (Some(baseline), Some(path)) = (&baseline, &arguments.baseline) {
        // Before anything is timed.
        for (_, subject) in &scenes {
            baseline.admit(subject, threads).map_err(|error| unfit(path, &error))?;
        }
        if let (Some(old), Some(new)) = (baseline.cpu(), &machine.cpu)
            && old != new
            && !arguments.quiet
        {
            output::print_warnings(&[format!(
                "{}: measured on another processor ({old}), so differences may be the machine's",
                path.display()
            )]);
        }
    }
    let options = BenchOptions { rounds: arguments.rounds, ..BenchOptions::default() };
    let bar = Bar::new(arguments.quiet);
    let mut measured = Vec::new();
    for (scene, subject) in scenes {
        let outcome = on_threads(arguments.threads, || bench(&scene, subject, options, &bar));
        bar.finish();
        measured.push(outcome?.map_err(|error| Failure::Input(error.to_string()))?);
    }
    let comparison = match (&baseline, &arguments.baseline) {
        (Some(baseline), Some(path)) => {
            let mut all = Vec::new();
            for measured in &measured {
                let compared = baseline.compare(measured, threads);
                all.extend(compared.map_err(|error| unfit(path, &error))?);
            }
            Some(all)
        }
        _ => None,
    };
    let report =
        Report { machine, threads, rounds: arguments.rounds, scenes: measured, comparison };
    for (path, format) in targets {
        let text = match format {
            Format::Json => format!("{:#}\n", to_json(&report)),
            Format::Csv => to_csv(&report),
        };
        output::save(writing, path, text.as_bytes())?;
    }
    if arguments.json {
        output::print_json(&to_json(&report));
    } else if !arguments.quiet {
        output::print(&to_table(&report));
    }
    Ok(if report.has_failed() { DIFFERENCE } else { OK })
}

/// The files to write with their formats; refuses what cannot be written before any work is done.
fn targets(paths: &[PathBuf]) -> Result<Vec<(&Path, Format)>, Failure> {
    let target = |path: &'_ PathBuf| {
        let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase());
        match extension.as_deref() {
            Some("json") => Ok(Format::Json),
            Some("csv") => Ok(Format::Csv),
            _ => Err(Failure::usage(format!(
                "{}: the name does not say what to write; end it in .json or .csv",
                path.display()
            ))),
        }
    };
    let mut targets = Vec::new();
    for path in paths {
        targets.push((path.as_path(), target(path)?));
        output::check_target(path)?;
    }
    Ok(targets)
}

fn load(arguments: &BenchArguments) -> Result<Vec<(Scene, Subject)>, Failure> {
    let overrides = Overrides { resolution: arguments.size, ..Overrides::default() };
    let mut scenes = Vec::new();
    for path in &arguments.scenes {
        let scene = Scene::load(path, &overrides)?;
        let subject = Subject::new(path.display().to_string(), &scene);
        scenes.push((scene, subject));
    }
    if scenes.is_empty() {
        let name = "default.toml";
        let scene = Scene::from_toml(DEFAULT_SCENE, Path::new(name), Path::new("."), &overrides)?;
        let subject = Subject::new(name.to_owned(), &scene);
        scenes.push((scene, subject));
    }
    if !arguments.quiet {
        scenes.iter().for_each(|(scene, _)| output::print_warnings(&scene.warnings));
    }
    Ok(scenes)
}

fn read_baseline(path: &Path) -> Result<Baseline, Failure> {
    let unreadable = |error: std::io::Error| FilmError::Read {
        path: path.to_owned(),
        reason: error.to_string(),
    };
    let bytes = std::fs::read(path).map_err(unreadable)?;
    Baseline::parse(&String::from_utf8_lossy(&bytes)).map_err(|error| unfit(path, &error))
}

fn unfit(path: &Path, error: &BaselineError) -> Failure {
    Failure::Input(format!("{}: {error}", path.display()))
}
