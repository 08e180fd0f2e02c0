//! The command line: what was typed becomes a call of the library, and its outcome an exit status.
//!
//! stdout carries results only; warnings, errors and progress bars go to stderr.

mod arguments;
mod audit;
mod bench;
mod check;
mod cost;
mod explain;
mod export;
mod failure;
mod lobe;
mod obj_scene;
mod output;
mod pixel;
mod prediction;
mod progress;
mod render;
mod sheet;

use arguments::{Arguments, Command};
use clap::Parser;
use failure::Failure;
use std::process::ExitCode;

/// Exit status: everything went well.
const OK: u8 = 0;
/// Exit status: a check found a difference.
const DIFFERENCE: u8 = 1;
/// Exit status: the command line is wrong.
const USAGE: u8 = 2;
/// Exit status: bad scene or mesh, or nothing to check.
const SCENE: u8 = 3;
/// Exit status: reading or writing failed.
const READ_WRITE: u8 = 4;
/// Exit status: interrupted.
const INTERRUPTED: u8 = 130;

/// Parses, runs, reports.
pub(crate) fn run() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(error) => {
            // Help and version are results; everything else is a usage error. A closed pipe is
            // nothing to report.
            let _ = error.print();
            return ExitCode::from(if error.use_stderr() { USAGE } else { OK });
        }
    };
    let writing = output::exit_on_interrupt();
    let status = match arguments.command {
        Command::Render(arguments) => render::run(&arguments, &writing),
        Command::Check(arguments) => check::run(&arguments, &writing),
        Command::Export(arguments) => export::run(&arguments, &writing),
        Command::Pixel(arguments) => pixel::run(&arguments),
        Command::Explain(arguments) => explain::run(&arguments),
        Command::Sheet(arguments) => sheet::run(&arguments, &writing),
        Command::Bench(arguments) => bench::run(&arguments, &writing),
        Command::Cost(arguments) => cost::run(&arguments, &writing),
        Command::Lobe(arguments) => lobe::run(&arguments, &writing),
    };
    match status {
        Ok(status) => ExitCode::from(status),
        Err(failure) => {
            failure.print();
            ExitCode::from(failure.status())
        }
    }
}

/// Runs `work` on a pool of `threads` threads; 0 is one per core, or what `RAYON_NUM_THREADS` says.
fn on_threads<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> Result<T, Failure> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|error| Failure::usage(format!("cannot start {threads} threads: {error}")))?;
    Ok(pool.install(work))
}
