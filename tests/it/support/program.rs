//! The program, run as a user runs it.

use std::path::Path;
use std::process::Command;

/// Runs the program in a folder: its exit status, and what it wrote to stdout and stderr. It may
/// fail, but never panic.
pub(crate) fn truecast(folder: &Path, arguments: &[&str]) -> (i32, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_truecast"))
        .current_dir(folder)
        .args(arguments)
        .output()
        .unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    let (stdout, stderr) = (text(output.stdout), text(output.stderr));
    assert!(!stderr.contains("panicked"), "{stderr}");
    (output.status.code().expect("ended by itself"), stdout, stderr)
}
