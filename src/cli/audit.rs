//! `truecast check --ids FILE --depth FILE`: another program's picture, held against the exact
//! answer.

mod read;
mod report;

use super::arguments::CheckArguments;
use super::failure::Failure;
use super::output::{self, Writing};
use super::progress::Bar;
use super::{DIFFERENCE, OK, SCENE, on_threads};
use std::path::Path;
use std::time::{Duration, Instant};
use truecast::check::foreign::{
    Convention, ForeignOptions, ForeignOutcome, ForeignReport, audit_foreign, class_picture, to_csv,
};
use truecast::film::encode_picture;
use truecast::scene::{Overrides, Scene};

/// One audited picture.
struct Audited<'a> {
    arguments: &'a CheckArguments,
    path: &'a Path,
    scene: Scene,
    options: ForeignOptions,
    report: ForeignReport,
    time: Duration,
}

pub(super) fn run(arguments: &CheckArguments, writing: &Writing) -> Result<u8, Failure> {
    let [path] = arguments.scenes.as_slice() else {
        return Err(Failure::usage("--ids and --depth belong to one scene; name one"));
    };
    for path in arguments.diff.iter().chain(&arguments.csv) {
        output::check_target(path)?;
    }
    let scene = Scene::load(
        path,
        &Overrides {
            resolution: arguments.size,
            skip_bad: arguments.skip_bad,
            ..Overrides::default()
        },
    )?;
    let input = read::foreign(arguments, &scene)?;
    if !arguments.quiet {
        output::print_warnings(&scene.warnings);
        output::print_warnings(&input.warnings);
    }
    let convention =
        Convention { base: arguments.foreign.id_base, background: arguments.foreign.background };
    let options = ForeignOptions { convention, depth_tolerance: arguments.foreign.depth_tolerance };
    let bar = Bar::new(arguments.quiet);
    let started = Instant::now();
    let report =
        on_threads(arguments.threads, || audit_foreign(&scene, &input.foreign, &options, &bar))?;
    bar.finish();
    let audited = Audited { arguments, path, scene, options, report, time: started.elapsed() };
    if let Some(diff) = &arguments.diff {
        output::save(writing, diff, &encode_picture(&class_picture(&audited.report))?)?;
    }
    if let Some(csv) = &arguments.csv {
        let text = to_csv(&audited.scene, &audited.report.findings);
        output::save(writing, csv, text.as_bytes())?;
    }
    if arguments.json {
        output::print_json(&report::document(&audited));
    } else if !arguments.quiet {
        output::print(&report::text(&audited));
    }
    Ok(match audited.report.outcome() {
        ForeignOutcome::Agreement => OK,
        ForeignOutcome::Errors => DIFFERENCE,
        ForeignOutcome::NothingToCheck => SCENE,
    })
}
