//! The lines of OBJ and MTL files as statements: comments cut, `\` continuations joined, every
//! token with its place.
//!
//! Knows no keyword; see `scan` and `mtl`.

use crate::scene::error::{Place, SceneError};
use crate::scene::obj::report::{Report, quote};
use std::borrow::Cow;
use std::path::Path;

/// The file's bytes as text. A byte order mark is dropped; bytes that are not UTF-8 are replaced
/// with a warning, because old exporters write Latin-1 into comments and names.
///
/// # Errors
/// UTF-16, and NUL bytes, which no OBJ text holds.
pub(super) fn decode<'a>(
    bytes: &'a [u8],
    file: &Path,
    report: &mut Report,
) -> Result<Cow<'a, str>, SceneError> {
    if bytes.starts_with(&[0xFE, 0xFF]) || bytes.starts_with(&[0xFF, 0xFE]) {
        let error = SceneError::scene(Place::file(file), "the file is UTF-16 text");
        return Err(error.with_help("save it as UTF-8"));
    }
    let bytes = bytes.strip_prefix(&[0xEF, 0xBB, 0xBF]).unwrap_or(bytes);
    if bytes.contains(&0)
        && let Some(position) = bytes.iter().position(|&byte| byte == 0)
    {
        let place = Place::at(file, line_of(bytes, position), 0);
        let error = SceneError::scene(place, "a NUL byte: this is not a text file");
        return Err(error.with_help("if it is UTF-16 text, save it as UTF-8"));
    }
    match std::str::from_utf8(bytes) {
        Ok(text) => Ok(Cow::Borrowed(text)),
        Err(error) => {
            let line = line_of(bytes, error.valid_up_to());
            report.warn(file, line, "the file holds bytes that are not UTF-8; they are replaced");
            Ok(String::from_utf8_lossy(bytes))
        }
    }
}

/// 1-based line of a byte: one more than the line ends before it.
fn line_of(bytes: &[u8], position: usize) -> u32 {
    let ends = (0..position).filter(|&i| match bytes[i] {
        b'\n' => true,
        b'\r' => bytes.get(i + 1) != Some(&b'\n'),
        _ => false,
    });
    1 + ends.count() as u32
}

/// A word between blanks.
#[derive(Clone, Copy, Debug)]
pub(super) struct Token<'a> {
    /// Its characters.
    pub(super) text: &'a str,
    /// 1-based line.
    pub(super) line: u32,
    /// Byte position in the file's text.
    start: usize,
}

/// Walks over the statements of a text.
#[derive(Debug)]
pub(super) struct Statements<'a> {
    text: &'a str,
    file: &'a Path,
    position: usize,
    line: u32,
    tokens: Vec<Token<'a>>,
    end: usize,
}

impl<'a> Statements<'a> {
    /// Starts before the first statement.
    pub(super) fn new(text: &'a str, file: &'a Path) -> Self {
        Self { text, file, position: 0, line: 1, tokens: Vec::new(), end: 0 }
    }

    /// Starts at a byte position, the start of a line, whose number is given.
    pub(super) fn resume(text: &'a str, file: &'a Path, position: usize, line: u32) -> Self {
        Self { position, line, ..Self::new(text, file) }
    }

    /// Byte position behind the current statement and its line's end.
    pub(super) fn position(&self) -> usize {
        self.position
    }

    /// Number of the line that begins there.
    pub(super) fn line(&self) -> u32 {
        self.line
    }

    /// Moves to the next statement; false at the end of the text.
    pub(super) fn advance(&mut self) -> bool {
        while self.position < self.text.len() {
            self.read_logical_line();
            if !self.tokens.is_empty() {
                return true;
            }
        }
        false
    }

    /// The current statement's first word.
    pub(super) fn keyword(&self) -> Token<'a> {
        self.tokens[0]
    }

    /// The words after it.
    pub(super) fn values(&self) -> &[Token<'a>] {
        &self.tokens[1..]
    }

    /// Everything after the keyword as one trimmed name, `#` included: names may hold it.
    pub(super) fn name(&self) -> String {
        self.name_behind(0)
    }

    /// Everything after the keyword and the first `count` values, likewise.
    pub(super) fn name_behind(&self, count: usize) -> String {
        let Some(before) = self.tokens.get(count) else { return String::new() };
        let raw = &self.text[before.start + before.text.len()..self.end];
        if self.tokens.last().is_some_and(|token| token.line != before.line) {
            let words: Vec<&str> = self.values()[count..].iter().map(|token| token.text).collect();
            return words.join(" ");
        }
        raw.trim_end_matches('\\').trim().to_owned()
    }

    /// The place of a token. The column is counted in characters, here and only for messages.
    pub(super) fn place(&self, token: &Token<'_>) -> Place {
        let before = &self.text[..token.start];
        let line_start = before.rfind(['\n', '\r']).map_or(0, |position| position + 1);
        let column = before[line_start..].chars().count() as u32 + 1;
        Place::at(self.file, token.line, column)
    }

    /// A token as a finite number.
    ///
    /// # Errors
    /// Not a number, not finite, or beyond the range of f64.
    pub(super) fn number(&self, token: &Token<'_>) -> Result<f64, SceneError> {
        match token.text.parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(value),
            Ok(_) => {
                let message = format!("{} is not a finite number", quote(token.text));
                Err(SceneError::scene(self.place(token), message))
            }
            Err(_) => {
                let message = format!("{} is not a number", quote(token.text));
                let error = SceneError::scene(self.place(token), message);
                Err(match token.text.contains(',') {
                    true => error.with_help("write decimals with a point"),
                    false => error,
                })
            }
        }
    }

    /// Reads up to the end of a line that is not continued.
    fn read_logical_line(&mut self) {
        self.tokens.clear();
        let bytes = self.text.as_bytes();
        loop {
            match bytes.get(self.position) {
                None => {
                    self.end = self.position;
                    return;
                }
                Some(b'\n' | b'\r') => {
                    self.end = self.position;
                    self.pass_line_end();
                    return;
                }
                Some(b' ' | b'\t' | 0x0B | 0x0C) => self.position += 1,
                Some(b'#') => self.pass_comment(),
                Some(b'\\') if self.is_continued(self.position) => {
                    // Blanks may stand between the backslash and the end of the line: they are
                    // invisible in an editor.
                    while !matches!(bytes.get(self.position), None | Some(b'\n' | b'\r')) {
                        self.position += 1;
                    }
                    self.pass_line_end();
                }
                Some(_) => self.read_token(),
            }
        }
    }

    /// Reads a word: up to a blank, a comment, a line end or a continuation.
    fn read_token(&mut self) {
        let bytes = self.text.as_bytes();
        let start = self.position;
        while let Some(&byte) = bytes.get(self.position) {
            match byte {
                b'\n' | b'\r' | b' ' | b'\t' | 0x0B | 0x0C | b'#' => break,
                b'\\' if self.is_continued(self.position) => break,
                _ => self.position += 1,
            }
        }
        let text = &self.text[start..self.position];
        self.tokens.push(Token { text, line: self.line, start });
    }

    /// Whether only blanks follow a backslash on its line.
    fn is_continued(&self, backslash: usize) -> bool {
        let rest = &self.text.as_bytes()[backslash + 1..];
        let next = rest.iter().find(|byte| !matches!(byte, b' ' | b'\t'));
        matches!(next, None | Some(b'\n' | b'\r'))
    }

    /// A comment ends with its line, backslash or not: comments quote Windows paths.
    fn pass_comment(&mut self) {
        let rest = &self.text.as_bytes()[self.position..];
        let length = rest.iter().position(|byte| matches!(byte, b'\n' | b'\r'));
        self.position += length.unwrap_or(rest.len());
    }

    /// Steps over `\n`, `\r\n` or a lone `\r`.
    fn pass_line_end(&mut self) {
        let rest = &self.text.as_bytes()[self.position..];
        self.position += match rest {
            [b'\r', b'\n', ..] => 2,
            [] => return,
            _ => 1,
        };
        self.line += 1;
    }
}

/// A name without the comment behind it: cut at the first `#` that follows a blank.
pub(super) fn without_comment(name: &str) -> &str {
    let mut hashes = name.match_indices('#').map(|(position, _)| &name[..position]);
    match hashes.find(|before| before.is_empty() || before.ends_with(char::is_whitespace)) {
        Some(before) => before.trim_end(),
        None => name,
    }
}

#[cfg(test)]
mod tests;
