//! Our own strict reading of an OBJ text: what each statement is, where it is, and whether every
//! index exists. Makes no triangles and reads no material library.
//!
//! Files are long and plain: `plain` reads stretches of the text on all threads, and only what it
//! leaves is read statement by statement (`strict`). Numbers are what `f64::from_str` reads, which is
//! correctly rounded.

mod plain;
mod strict;

use crate::scene::obj::report::Report;
use crate::scene::obj::scanned::Scan;
use crate::scene::obj::statement::Statements;
use plain::{Before, Stretch};
use rayon::prelude::*;
use std::ops::Range;
use std::path::Path;
use strict::State;

/// Bytes of a stretch of text, at least: a millisecond's work.
const STRETCH: usize = 1 << 18;

/// Reads all statements. Faults go to the report; with any, the result is incomplete.
/// With `skip_bad`, faces with a position that is not finite are no fault and left out.
pub(super) fn scan(text: &str, file: &Path, skip_bad: bool, report: &mut Report) -> Scan {
    let before = report.clone();
    scan_stretches(text, file, skip_bad, report, STRETCH).unwrap_or_else(|| {
        *report = before;
        scan_strictly(text, file, skip_bad, report)
    })
}

/// Reads statement by statement.
fn scan_strictly(text: &str, file: &Path, skip_bad: bool, report: &mut Report) -> Scan {
    let mut state = State::new(skip_bad);
    let mut walk = Statements::new(text, file);
    while walk.advance() {
        if let Err(error) = state.read(&walk, file, report) {
            report.error(error);
        }
    }
    state.finish(&walk, file, report)
}

/// Reads stretches of about `size` bytes in parallel and joins them in the order of the file. `None`
/// where statements do not end with their stretch, or plain faces use what does not exist, which
/// must be told with its place.
fn scan_stretches(
    text: &str,
    file: &Path,
    skip_bad: bool,
    report: &mut Report,
    size: usize,
) -> Option<Scan> {
    let ranges = cut(text.as_bytes(), size);
    let stretches: Vec<Stretch> =
        ranges.into_par_iter().map(|range| plain::read(text, file, range)).collect();
    if stretches.iter().any(|stretch| stretch.is_torn) {
        return None;
    }
    let mut state = State::new(skip_bad);
    state.reserve(&stretches);
    let mut line = 1;
    for stretch in &stretches {
        let mut from = Before::default();
        for other in &stretch.others {
            state.append(stretch, from, other.before, line);
            from = other.before;
            let mut walk = Statements::resume(text, file, other.position, line + other.line);
            walk.advance();
            if let Err(error) = state.read(&walk, file, report) {
                report.error(error);
            }
        }
        state.append(stretch, from, stretch.size(), line);
        line += stretch.lines;
    }
    for (kind, &count) in state.scan.counts.iter().enumerate() {
        if stretches.iter().any(|stretch| stretch.reach[kind] > count) {
            return None;
        }
    }
    Some(state.finish(&Statements::new(text, file), file, report))
}

/// Cuts a text behind line ends, into ranges of at least `size` bytes but the last; never behind a
/// line that goes on.
fn cut(bytes: &[u8], size: usize) -> Vec<Range<usize>> {
    let mut ranges = Vec::new();
    let mut start = 0;
    let mut from = size;
    while let Some(offset) = bytes.get(from..).and_then(|r| r.iter().position(|&b| b == b'\n')) {
        let end = from + offset + 1;
        let line = bytes[start..end].trim_ascii_end();
        if line.ends_with(b"\\") {
            from = end;
        } else {
            ranges.push(start..end);
            (start, from) = (end, end + size);
        }
    }
    ranges.push(start..bytes.len());
    ranges
}

#[cfg(test)]
mod tests;
