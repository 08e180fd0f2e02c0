//! Which cases of a list the tests in the sources are named after.

use std::fs;
use std::path::{Path, PathBuf};

/// The folder of these tests.
pub(crate) fn tests_folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/it")
}

/// The cases that the tests of a source are named after: `h51_h52_boxes` is of two. `is_case` knows
/// their form.
pub(crate) fn tested(source: &str, is_case: fn(&str) -> bool) -> Vec<String> {
    let mut cases = Vec::new();
    for (attribute, next) in source.lines().zip(source.lines().skip(1)) {
        let Some(name) = next.trim().strip_prefix("fn ").filter(|_| attribute.trim() == "#[test]")
        else {
            continue;
        };
        cases.extend(name.split('_').take_while(|part| is_case(part)).map(str::to_owned));
    }
    cases
}

/// Every Rust source below a folder.
pub(crate) fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            files.extend(rust_files(&path));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
    files
}
