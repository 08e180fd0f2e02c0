//! Writing results: printing to stdout, saving files, and being interrupted without leaving any.

use super::INTERRUPTED;
use super::failure::Failure;
use serde_json::Value;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};
use truecast::film::{AtomicFile, FilmError, check_writable};

/// Files that are being written and do not show yet. Held while one is created or shown, so that an
/// interruption, which removes them, misses none.
pub(super) type Writing = Arc<Mutex<Vec<PathBuf>>>;

/// Makes an interruption end the program with status 130, and leave no part of a file.
pub(super) fn exit_on_interrupt() -> Writing {
    let writing = Writing::default();
    let held = Arc::clone(&writing);
    let installed = ctrlc::set_handler(move || {
        let unfinished = held.lock();
        for path in unfinished.iter().flat_map(|paths| paths.iter()) {
            let _ = std::fs::remove_file(path);
        }
        std::process::exit(i32::from(INTERRUPTED));
    });
    if let Err(error) = installed {
        anstream::eprintln!("warning: cannot handle interruptions: {error}");
    }
    writing
}

/// Begins a file.
pub(super) fn begin(writing: &Writing, path: &Path) -> Result<AtomicFile, FilmError> {
    let unfinished = writing.lock();
    let file = AtomicFile::create(path)?;
    if let Ok(mut unfinished) = unfinished {
        unfinished.push(file.unfinished().to_owned());
    }
    Ok(file)
}

/// Shows a file.
pub(super) fn finish(writing: &Writing, file: AtomicFile) -> Result<(), FilmError> {
    let unfinished = writing.lock();
    let path = file.unfinished().to_owned();
    file.commit()?;
    if let Ok(mut unfinished) = unfinished {
        unfinished.retain(|other| *other != path);
    }
    Ok(())
}

/// Writes a file in one step.
pub(super) fn save(writing: &Writing, path: &Path, bytes: &[u8]) -> Result<(), FilmError> {
    let mut file = begin(writing, path)?;
    file.with(|file| file.write_all(bytes))?;
    finish(writing, file)
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
