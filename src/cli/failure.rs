//! What ends a command early, how it is shown, and its exit status.

use super::{READ_WRITE, SCENE, USAGE};
use miette::{Diagnostic, GraphicalReportHandler, LabeledSpan, NamedSource, SourceCode};
use std::fmt;
use std::io::IsTerminal;
use truecast::film::FilmError;
use truecast::scene::SceneErrors;
use truecast::scene::error::{Fault, SceneError};

/// Why a command ended early.
#[derive(Debug)]
pub(super) enum Failure {
    /// The command line asks for something impossible.
    Usage(String),
    /// The scene is wrong or cannot be read.
    Scene(SceneErrors),
    /// A file does not fit the scene.
    Input(String),
    /// A file could not be written or read.
    Film(FilmError),
}

impl Failure {
    pub(super) fn usage(message: impl Into<String>) -> Self {
        Self::Usage(message.into())
    }

    /// The exit status that it means. A scene that could not be read at all outranks its faults.
    pub(super) fn status(&self) -> u8 {
        match self {
            Self::Usage(_) => USAGE,
            Self::Scene(errors) if errors.0.iter().all(|e| e.fault == Fault::Reading) => READ_WRITE,
            Self::Scene(_) | Self::Input(_) => SCENE,
            Self::Film(_) => READ_WRITE,
        }
    }

    /// Prints it to stderr.
    pub(super) fn print(&self) {
        match self {
            Self::Usage(message) | Self::Input(message) => anstream::eprintln!("error: {message}"),
            Self::Film(error) => anstream::eprintln!("error: {error}"),
            Self::Scene(errors) => errors.0.iter().for_each(print_scene_error),
        }
    }
}

impl From<SceneErrors> for Failure {
    fn from(errors: SceneErrors) -> Self {
        Self::Scene(errors)
    }
}

impl From<FilmError> for Failure {
    fn from(error: FilmError) -> Self {
        Self::Film(error)
    }
}

/// Prints `error: file:line:column: message`, on a terminal with the line itself below it.
fn print_scene_error(error: &SceneError) {
    anstream::eprintln!("error: {error}");
    if std::io::stderr().is_terminal()
        && let Some(excerpt) = Excerpt::of(error)
    {
        let mut text = String::new();
        if GraphicalReportHandler::new().render_report(&mut text, &excerpt).is_ok() {
            anstream::eprint!("{text}");
        }
    }
    if let Some(help) = &error.help {
        anstream::eprintln!("  help: {help}");
    }
}

/// The line of a file that an error points to, in the shape that miette draws.
#[derive(Debug)]
struct Excerpt {
    message: String,
    source: NamedSource<String>,
    offset: usize,
    length: usize,
}

impl Excerpt {
    /// Reads the file again; `None` when it cannot be shown.
    fn of(error: &SceneError) -> Option<Self> {
        let place = &error.place;
        let text = std::fs::read_to_string(&place.file).ok()?;
        let line_start: usize = text
            .split_inclusive('\n')
            .take(place.line.checked_sub(1)? as usize)
            .map(str::len)
            .sum();
        let line = text.get(line_start..)?.lines().next()?;
        let before: usize =
            line.chars().take(place.column.saturating_sub(1) as usize).map(char::len_utf8).sum();
        let rest = &line[before..];
        let length =
            rest.find(|c: char| c.is_whitespace() || c == '=').unwrap_or(rest.len()).max(1);
        Some(Self {
            message: error.message.clone(),
            offset: line_start + before,
            length: length.min(text.len() - line_start - before),
            source: NamedSource::new(place.file.display().to_string(), text),
        })
    }
}

impl fmt::Display for Excerpt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Excerpt {}

impl Diagnostic for Excerpt {
    fn source_code(&self) -> Option<&dyn SourceCode> {
        Some(&self.source)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        Some(Box::new(std::iter::once(LabeledSpan::at(
            self.offset..self.offset + self.length,
            "here",
        ))))
    }
}
