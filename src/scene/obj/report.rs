//! Faults and remarks collected while a file is read.
//!
//! Both are bounded: a broken file of a million lines gives a page of errors, not a million.

use crate::scene::error::{Place, SceneError};
use std::path::{Path, PathBuf};

/// Errors that are kept with their text; about a screenful. Further ones are counted.
const MAX_ERRORS: usize = 20;

/// Kinds of warnings that are kept apart; far more than this reader has of its own, so that only
/// files with many unknown statements reach it. Further kinds are counted together.
const MAX_WARNING_KINDS: usize = 32;

/// Characters of the user's text that a message repeats; the rest becomes `…`.
const MAX_QUOTED_CHARACTERS: usize = 40;

/// Errors and warnings in the order of their first occurrence.
#[derive(Clone, Debug, Default)]
pub(super) struct Report {
    errors: Vec<SceneError>,
    suppressed_errors: u64,
    warnings: Vec<Warning>,
    further_warnings: Option<Warning>,
}

/// One kind of remark: where it first applied and how often it does.
#[derive(Clone, Debug)]
struct Warning {
    sentence: String,
    file: PathBuf,
    line: u32,
    count: u64,
}

impl Report {
    /// Notes a fault.
    pub(super) fn error(&mut self, error: SceneError) {
        self.error_with(|| error);
    }

    /// Notes a fault whose description costs time, which is spent only if it is kept.
    pub(super) fn error_with(&mut self, describe: impl FnOnce() -> SceneError) {
        if self.errors.len() < MAX_ERRORS {
            self.errors.push(describe());
        } else {
            self.suppressed_errors += 1;
        }
    }

    /// Notes a remark; equal sentences about the same file are merged. Line 0 is the whole file.
    pub(super) fn warn(&mut self, file: &Path, line: u32, sentence: &str) {
        let known = self.warnings.iter_mut().find(|w| w.sentence == sentence && w.file == file);
        if let Some(warning) = known {
            warning.count += 1;
        } else if self.warnings.len() < MAX_WARNING_KINDS {
            self.warnings.push(Warning::new(sentence, file, line));
        } else if let Some(warning) = &mut self.further_warnings {
            warning.count += 1;
        } else {
            self.further_warnings = Some(Warning::new("more remarks of other kinds", file, line));
        }
    }

    /// Whether a fault was noted.
    pub(super) fn has_errors(&self) -> bool {
        !self.errors.is_empty()
    }

    /// The errors, with a last one that counts those left out.
    pub(super) fn into_errors(mut self) -> Vec<SceneError> {
        if self.suppressed_errors > 0 {
            let file = self.errors.last().map_or_else(PathBuf::new, |e| e.place.file.clone());
            let message = format!("{} more errors", self.suppressed_errors);
            self.errors.push(SceneError::scene(Place::file(&file), message));
        }
        self.errors
    }

    /// The warnings as sentences, each with the place of its first occurrence.
    pub(super) fn into_warnings(self) -> Vec<String> {
        self.warnings.iter().chain(&self.further_warnings).map(Warning::to_sentence).collect()
    }
}

impl Warning {
    fn new(sentence: &str, file: &Path, line: u32) -> Self {
        Self { sentence: sentence.to_owned(), file: file.to_owned(), line, count: 1 }
    }

    fn to_sentence(&self) -> String {
        let place = Place::at(&self.file, self.line, 0);
        match self.count {
            1 => format!("{place}: {}", self.sentence),
            count => format!("{place}: {} ({count} times; this is the first)", self.sentence),
        }
    }
}

/// The user's text between backquotes: control characters escaped, long text cut.
pub(super) fn quote(text: &str) -> String {
    let mut quoted = String::from("`");
    for (position, character) in text.chars().enumerate() {
        if position == MAX_QUOTED_CHARACTERS {
            quoted.push('…');
            break;
        }
        if character.is_control() {
            quoted.extend(character.escape_default());
        } else {
            quoted.push(character);
        }
    }
    quoted.push('`');
    quoted
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_remarks_are_counted_and_kinds_are_bounded() {
        let mut report = Report::default();
        let file = Path::new("a.obj");
        for line in 1..=3 {
            report.warn(file, line, "same");
        }
        for line in 0..100 {
            report.warn(file, line, &format!("kind {line}"));
        }
        let warnings = report.into_warnings();
        assert_eq!(warnings.len(), MAX_WARNING_KINDS + 1);
        assert_eq!(warnings[0], "a.obj:1: same (3 times; this is the first)");
        assert_eq!(warnings[1], "a.obj: kind 0");
        assert!(warnings[MAX_WARNING_KINDS].contains("(69 times"), "{}", warnings.last().unwrap());
    }

    #[test]
    fn errors_are_bounded_and_the_rest_is_counted() {
        let mut report = Report::default();
        for line in 1..=25 {
            report.error(SceneError::scene(Place::at(Path::new("a.obj"), line, 1), "bad"));
        }
        let errors = report.into_errors();
        assert_eq!(errors.len(), MAX_ERRORS + 1);
        assert_eq!(errors[MAX_ERRORS].message, "5 more errors");
    }

    #[test]
    fn quoting_cuts_and_escapes() {
        assert_eq!(quote("a\u{7}b"), "`a\\u{7}b`");
        assert_eq!(quote(&"x".repeat(50)), format!("`{}…`", "x".repeat(40)));
    }
}
