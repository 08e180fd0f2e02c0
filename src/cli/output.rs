//! Writing results: printing to stdout, saving files, and being interrupted without leaving any.

use super::INTERRUPTED;
use super::failure::Failure;
use serde_json::Value;
use std::fs::File;
use std::io::Write;
use std::path::Path;
use std::sync::{Arc, Mutex};
use truecast::film::{FilmError, check_writable, write_atomic, write_atomic_with};

/// Held while a file is written, so that an interruption waits for the rename instead of leaving a
/// temporary file.
pub(super) type Writing = Arc<Mutex<()>>;

/// Makes an interruption end the program with status 130, never in the middle of a write.
pub(super) fn exit_on_interrupt() -> Writing {
    let writing = Writing::default();
    let held = Arc::clone(&writing);
    let installed = ctrlc::set_handler(move || {
        let _wait = held.lock();
        std::process::exit(i32::from(INTERRUPTED));
    });
    if let Err(error) = installed {
        anstream::eprintln!("warning: cannot handle interruptions: {error}");
    }
    writing
}

/// Writes a file in one step.
pub(super) fn save(writing: &Writing, path: &Path, bytes: &[u8]) -> Result<(), FilmError> {
    let _held = writing.lock();
    write_atomic(path, bytes)
}

/// Writes a file piece by piece, which shows in one step; says how long it became.
pub(super) fn save_with(
    writing: &Writing,
    path: &Path,
    write: impl FnOnce(&mut File) -> std::io::Result<()>,
) -> Result<usize, FilmError> {
    let _held = writing.lock();
    let mut length = 0;
    write_atomic_with(path, |file| {
        write(file)?;
        length = file.metadata()?.len();
        Ok(())
    })?;
    Ok(usize::try_from(length).unwrap_or(usize::MAX))
}

/// Prints text to stdout. A reader that closed the pipe has what it wanted.
pub(super) fn print(text: &str) {
    let _ = anstream::stdout().write_all(text.as_bytes());
}

/// Prints one JSON document.
pub(super) fn print_json(document: &Value) {
    print(&format!("{document:#}\n"));
}

/// Prints the warnings of a scene to stderr.
pub(super) fn print_warnings(warnings: &[String]) {
    for warning in warnings {
        anstream::eprintln!("warning: {warning}");
    }
}

/// Refuses a path that cannot be written before any work is done.
pub(super) fn check_target(path: &Path) -> Result<(), Failure> {
    check_writable(path).map_err(Failure::from)
}
