//! No row is missing: the rows A01 to A79 of the lighting systems against the tests in the sources.

use crate::support::names::{rust_files, tested, tests_folder};
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

/// Rows whose test is named after them, wherever under `tests/it` it stands. The others, A49, A57,
/// A72, A74 and A76, are methods that are only named in the texts, history, and what needs a screen
/// and a mouse.
const ROWS: &str = "a01 a02 a03 a04 a05 a06 a07 a08 a09 a10 a11 a12 a13 a14 a15 a16 a17 a18 a19 \
                    a20 a21 a22 a23 a30 a31 a32 a33 a34 a35 a40 a41 a42 a43 a44 a45 a46 a47 a48 \
                    a50 a51 a52 a53 a54 a55 a56 a60 a61 a62 a63 a64 a65 a70 a71 a73 a75 a77 a78 \
                    a79";

#[test]
fn every_row_is_here() {
    let missing = missing(ROWS, &tests_folder());
    assert!(missing.is_empty(), "no test is named after {missing:?}");
}

fn missing<'a>(rows: &'a str, folder: &Path) -> Vec<&'a str> {
    let tested: BTreeSet<String> = rust_files(folder)
        .iter()
        .flat_map(|path| tested(&fs::read_to_string(path).unwrap(), is_row))
        .collect();
    rows.split_whitespace().filter(|row| !tested.contains(*row)).collect()
}

fn is_row(part: &str) -> bool {
    let [b'a', tens @ b'0'..=b'7', ones] = part.as_bytes() else { return false };
    tens.is_ascii_digit() && ones.is_ascii_digit()
}

#[test]
fn only_tests_count_as_rows() {
    let source = "#[test]\nfn a01_emission() {}\nfn a02_left_out() {}\n#[test]\nfn a50_a51_both() {}\n\
                  // #[test]\nfn a03_commented() {}\n#[test]\nfn a_plane() {}\n";
    assert_eq!(tested(source, is_row), ["a01", "a50", "a51"]);
}
