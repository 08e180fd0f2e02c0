//! The text of a scene file: where a byte of it is, and the faults found in it so far.

use crate::scene::error::{Place, SceneError};
use std::ops::Range;
use std::path::Path;

/// Bytes of the text.
pub(crate) type Span = Range<usize>;

/// Collects the faults of one scene file, so that one run reports all of them.
pub(crate) struct Faults<'t> {
    /// The file's name, as it stands in front of every message.
    pub(crate) file: &'t Path,
    /// Its whole text.
    pub(crate) text: &'t str,
    /// What was found.
    pub(crate) errors: Vec<SceneError>,
    /// Things worth knowing that are no errors.
    pub(crate) warnings: Vec<String>,
}

impl<'t> Faults<'t> {
    pub(crate) fn new(file: &'t Path, text: &'t str) -> Self {
        Self { file, text, errors: Vec::new(), warnings: Vec::new() }
    }

    /// Line and column, 1-based and in characters, of the first byte of `span`.
    pub(crate) fn place(&self, span: &Span) -> Place {
        let (line, column) = line_and_column(self.text, span.start);
        Place::at(self.file, line, column)
    }

    /// A fault of what stands at `span`.
    pub(crate) fn at(&mut self, span: &Span, message: impl Into<String>) {
        let place = self.place(span);
        self.errors.push(SceneError::scene(place, message));
    }

    /// The same with advice.
    pub(crate) fn at_with_help(
        &mut self,
        span: &Span,
        message: impl Into<String>,
        help: impl Into<String>,
    ) {
        let place = self.place(span);
        self.errors.push(SceneError::scene(place, message).with_help(help));
    }

    /// A thing worth knowing about what stands at `span`.
    pub(crate) fn warn(&mut self, span: &Span, message: &str) {
        self.warnings.push(format!("{}: {message}", self.place(span)));
    }
}

/// 1-based line and column, in characters, of the byte at `offset`. A byte order mark takes no
/// column.
pub(crate) fn line_and_column(text: &str, offset: usize) -> (u32, u32) {
    let before = &text.as_bytes()[..offset.min(text.len())];
    let line = before.iter().filter(|&&byte| byte == b'\n').count();
    let start = before.iter().rposition(|&byte| byte == b'\n').map_or(0, |newline| newline + 1);
    // Every byte that does not continue a UTF-8 sequence begins a character.
    let begins = before[start..].iter().filter(|&&byte| byte & 0xC0 != 0x80).count();
    let mark = usize::from(start == 0 && before.starts_with("\u{feff}".as_bytes()));
    (line as u32 + 1, (begins - mark) as u32 + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_count_characters_and_lines_start_after_newlines() {
        let text = "äöü = 1\r\nb = 2\n";
        assert_eq!(line_and_column(text, 0), (1, 1));
        assert_eq!(line_and_column(text, text.find('=').unwrap()), (1, 5));
        assert_eq!(line_and_column(text, text.find('b').unwrap()), (2, 1));
        assert_eq!(line_and_column(text, text.len()), (3, 1));
        assert_eq!(line_and_column("\u{feff}a = 1", 3), (1, 1));
        assert_eq!(line_and_column("\u{feff}a = 1", 7), (1, 5));
    }
}
