//! What is wrong with a scene or a mesh file, where, and what to do about it.
//!
//! For faults of what the user wrote. Faults of ours are assertions.

use std::fmt;
use std::path::{Path, PathBuf};

/// A position in a text file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// The file as the user named it.
    pub file: PathBuf,
    /// 1-based line; 0 when the fault is the file as a whole.
    pub line: u32,
    /// 1-based column in characters; 0 when the fault is the line as a whole.
    pub column: u32,
}

impl Place {
    /// The file as a whole.
    pub fn file(file: &Path) -> Self {
        Self { file: file.to_owned(), line: 0, column: 0 }
    }

    /// A position in a file.
    pub fn at(file: &Path, line: u32, column: u32) -> Self {
        Self { file: file.to_owned(), line, column }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.file.display())?;
        if self.line > 0 {
            write!(f, ":{}", self.line)?;
        }
        if self.column > 0 {
            write!(f, ":{}", self.column)?;
        }
        Ok(())
    }
}

/// Whose fault an error is; decides the exit status.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// The scene or mesh is wrong.
    Scene,
    /// A file could not be read.
    Reading,
}

/// One fault of a scene or mesh file.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{place}: {message}")]
pub struct SceneError {
    /// Whose fault.
    pub fault: Fault,
    /// Where.
    pub place: Place,
    /// What is wrong.
    pub message: String,
    /// What to do about it.
    pub help: Option<String>,
}

impl SceneError {
    /// A fault of what the file says.
    pub fn scene(place: Place, message: impl Into<String>) -> Self {
        Self { fault: Fault::Scene, place, message: message.into(), help: None }
    }

    /// A file that could not be read.
    pub fn reading(place: Place, message: impl Into<String>) -> Self {
        Self { fault: Fault::Reading, place, message: message.into(), help: None }
    }

    /// The same error with advice.
    #[must_use]
    pub fn with_help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }
}
