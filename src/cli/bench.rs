//! `truecast bench`: scenes in, times of right answers out.

use super::arguments::BenchArguments;
use super::failure::Failure;
use super::obj_scene::{is_mesh, scene_of};
use super::output::{self, Writing};
use super::progress::Bar;
use super::render::DEFAULT_SCENE;
use super::{DIFFERENCE, OK, on_threads};
use std::path::{Path, PathBuf};
use truecast::bench::baseline::{Baseline, BaselineError};
use truecast::bench::machine::Machine;
use truecast::bench::peers::PeerError;
use truecast::bench::report::{
    growth_drawing, growths, reading, to_csv, to_drawing, to_json, to_table,
};
use truecast::bench::{BenchError, Report, Subject, bench};
use truecast::film::FilmError;
use truecast::scene::{Overrides, Scene};
use truecast::simd::SimdLevel;

/// What a report can be written as.
#[derive(Clone, Copy)]
enum Format {
    Json,
    Csv,
    Svg,
}

pub(super) fn run(arguments: &BenchArguments, writing: &Writing) -> Result<u8, Failure> {
    let targets = targets(&arguments.output)?;
    let growth = targets_of_growth(arguments.growth.as_deref())?;
    let options = arguments.options();
    let levels = match arguments.simd.is_empty() {
        true => vec![SimdLevel::best()],
        false => arguments.simd.clone(),
    };
    let scenes = load(arguments)?;
    let mut runs = Vec::new();
    for (scene, name) in &scenes {
        for &threads in &arguments.threads {
            let count = on_threads(threads, rayon::current_num_threads)?;
            for &simd in &levels {
                runs.push((scene, Subject::new(name.clone(), scene, count, simd)));
            }
        }
    }
    if growth.is_some()
        && scenes.iter().all(|(scene, _)| scene.mesh.len() == scenes[0].0.mesh.len())
    {
        let message = "--growth: give scenes that differ in their number of triangles";
        return Err(Failure::Input(message.to_owned()));
    }
    let machine = Machine::here();
    let baseline = arguments.baseline.as_deref().map(read_baseline).transpose()?;
    if let (Some(baseline), Some(path)) = (&baseline, &arguments.baseline) {
        // Before anything is timed.
        for (_, subject) in &runs {
            baseline.admit(subject).map_err(|error| unfit(path, &error))?;
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
    let bar = Bar::new(arguments.quiet);
    let mut measured = Vec::new();
    for (scene, subject) in runs {
        let outcome = on_threads(subject.threads, || bench(scene, subject, &options, &bar));
        bar.finish();
        measured.push(outcome?.map_err(failure)?);
    }
    let comparison = match (&baseline, &arguments.baseline) {
        (Some(baseline), Some(path)) => {
            let mut all = Vec::new();
            for measured in &measured {
                all.extend(baseline.compare(measured).map_err(|error| unfit(path, &error))?);
            }
            Some(all)
        }
        _ => None,
    };
    let report = Report { machine, rounds: arguments.rounds, scenes: measured, comparison };
    for (path, format) in targets {
        let text = match format {
            Format::Json => format!("{:#}\n", to_json(&report)),
            Format::Csv => to_csv(&report),
            Format::Svg => to_drawing(&report).to_svg(),
        };
        output::save(writing, path, text.as_bytes())?;
    }
    let growths = growths(&report);
    if let Some(path) = growth {
        output::save(writing, path, growth_drawing(&growths).to_svg().as_bytes())?;
    }
    if arguments.json {
        output::print_json(&to_json(&report));
    } else if !arguments.quiet {
        let mut text = to_table(&report);
        if growth.is_some() {
            text += "\ngrowth\n";
            reading(&growths).iter().for_each(|line| text += &format!("{line}\n"));
        }
        output::print(&text);
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
            Some("svg") => Ok(Format::Svg),
            _ => Err(Failure::usage(format!(
                "{}: the name does not say what to write; end it in .json, .csv or .svg",
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

/// The file for the plot of growth, which is an SVG.
fn targets_of_growth(path: Option<&Path>) -> Result<Option<&Path>, Failure> {
    let Some(path) = path else { return Ok(None) };
    if path.extension().is_none_or(|extension| !extension.eq_ignore_ascii_case("svg")) {
        let message = format!("{}: the plot of --growth is an SVG; end it in .svg", path.display());
        return Err(Failure::usage(message));
    }
    output::check_target(path)?;
    Ok(Some(path))
}

fn load(arguments: &BenchArguments) -> Result<Vec<(Scene, String)>, Failure> {
    let overrides = Overrides { resolution: arguments.size, ..Overrides::default() };
    let mut scenes = Vec::new();
    for path in &arguments.scenes {
        let scene = match is_mesh(path) {
            true => scene_of(path, arguments.view(), arguments.size)?,
            false => Scene::load(path, &overrides)?,
        };
        scenes.push((scene, path.display().to_string()));
    }
    if scenes.is_empty() {
        let name = "default.toml";
        let scene = Scene::from_toml(DEFAULT_SCENE, Path::new(name), Path::new("."), &overrides)?;
        scenes.push((scene, name.to_owned()));
    }
    if !arguments.quiet {
        scenes.iter().for_each(|(scene, _)| output::print_warnings(&scene.warnings));
    }
    Ok(scenes)
}

fn failure(error: BenchError) -> Failure {
    match error {
        BenchError::Peer(PeerError::Embree { path, reason }) => {
            FilmError::Read { path: path.into(), reason }.into()
        }
        error => Failure::Input(error.to_string()),
    }
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
