//! Films to files and back: the format by name, and writes that happen wholly or not at all.
//!
//! A file is written to a temporary file `.truecast-*.part` in the target's folder, then renamed over
//! the target. Whoever reads the target sees the old file or the new one, never a part. Every error
//! removes the temporary file. A program that is killed (or leaves through `process::exit` on another
//! thread) between creation and rename leaves that one file behind: [`AtomicFile::unfinished`] tells
//! which. Nothing is flushed to the disk's platters, so a power cut is not covered.

use std::ffi::OsStr;
use std::fs::File;
use std::io::{Error, ErrorKind, Write as _};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use super::{ClipCount, Film, FilmError, decode_exr, encode_exr, encode_npy_ids, encode_png};

/// The formats a film is written to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// All planes, bit for bit.
    Exr,
    /// The colours, as 8-bit sRGB.
    Png,
    /// The triangle ids.
    Npy,
}

/// The format that the extension names: `.exr`, `.png` or `.npy`, in any case.
///
/// # Errors
///
/// [`FilmError::UnknownFormat`] for any other name.
pub fn format_of(path: &Path) -> Result<Format, FilmError> {
    let extension = path.extension().and_then(OsStr::to_str).map(str::to_ascii_lowercase);
    match extension.as_deref() {
        Some("exr") => Ok(Format::Exr),
        Some("png") => Ok(Format::Png),
        Some("npy") => Ok(Format::Npy),
        _ => Err(FilmError::UnknownFormat { path: path.to_owned() }),
    }
}

/// Encodes the film as the extension of `path` says and writes it atomically. Says how much the
/// encoding clipped; EXR and NPY clip nothing.
///
/// # Errors
///
/// Those of [`format_of`], of the encoder and of [`write_atomic`]. The target is then as before.
pub fn save(film: &Film, path: &Path) -> Result<ClipCount, FilmError> {
    let (bytes, clipped) = match format_of(path)? {
        Format::Exr => (encode_exr(film)?, ClipCount::default()),
        Format::Png => encode_png(film)?,
        Format::Npy => (encode_npy_ids(film)?, ClipCount::default()),
    };
    write_atomic(path, &bytes)?;
    Ok(clipped)
}

/// Reads an EXR file as [`decode_exr`] does.
///
/// # Errors
///
/// [`FilmError::Read`], which names the file.
pub fn load_exr(path: &Path) -> Result<Film, FilmError> {
    let unreadable = |reason: String| FilmError::Read { path: path.to_owned(), reason };
    let bytes = std::fs::read(path).map_err(|error| unreadable(error.to_string()))?;
    decode_exr(&bytes).map_err(|error| unreadable(error.to_string()))
}

/// Writes `bytes` to `path` wholly or not at all, replacing a file of that name. A symbolic link is
/// followed. The file has the permissions of any newly created one.
///
/// # Errors
///
/// [`FilmError::Write`] when the target is a folder or a device, or its folder is missing, not a
/// folder, not writable or full. No partial file is left, and an old file is untouched.
pub fn write_atomic(path: &Path, bytes: &[u8]) -> Result<(), FilmError> {
    let mut file = AtomicFile::create(path)?;
    file.with(|file| file.write_all(bytes))?;
    file.commit()
}

/// A file that is being written and does not show yet.
#[derive(Debug)]
pub struct AtomicFile {
    file: NamedTempFile,
    path: PathBuf,
    target: PathBuf,
}

impl AtomicFile {
    /// Begins a file that will stand at `path`. It is removed when this is dropped.
    ///
    /// # Errors
    ///
    /// As [`write_atomic`].
    pub fn create(path: &Path) -> Result<Self, FilmError> {
        let target = resolve_target(path)?;
        let file = create_beside(path, &target)?;
        Ok(Self { file, path: path.to_owned(), target })
    }

    /// Where it stands meanwhile.
    pub fn unfinished(&self) -> &Path {
        self.file.path()
    }

    /// Does something with the file.
    ///
    /// # Errors
    ///
    /// [`FilmError::Write`] with what `write` gives.
    pub fn with<T>(
        &mut self,
        write: impl FnOnce(&mut File) -> std::io::Result<T>,
    ) -> Result<T, FilmError> {
        write(self.file.as_file_mut()).map_err(|error| unwritable(&self.path, &self.target, &error))
    }

    /// Shows it, in one step.
    ///
    /// # Errors
    ///
    /// As [`write_atomic`].
    pub fn commit(self) -> Result<(), FilmError> {
        let Self { file, path, target } = self;
        file.persist(&target).map_err(|refused| unwritable(&path, &target, &refused.error))?;
        Ok(())
    }
}

/// Checks, before any work is spent, that [`save`] could write a file of this name now.
///
/// # Errors
///
/// As [`format_of`] and [`write_atomic`].
pub fn check_target(path: &Path) -> Result<Format, FilmError> {
    let format = format_of(path)?;
    check_writable(path)?;
    Ok(format)
}

/// Checks that [`write_atomic`] could write a file of this name now.
///
/// # Errors
///
/// As [`write_atomic`].
pub fn check_writable(path: &Path) -> Result<(), FilmError> {
    let target = resolve_target(path)?;
    create_beside(path, &target)?;
    Ok(())
}

/// The file to replace: `path`, or what it links to. Folders and devices are refused: a rename
/// would fail on the one and replace the other.
fn resolve_target(path: &Path) -> Result<PathBuf, FilmError> {
    let refuse = |reason: &str, remedy| {
        Err(FilmError::Write { path: path.to_owned(), reason: reason.to_owned(), remedy })
    };
    match std::fs::metadata(path) {
        Ok(found) if found.is_dir() => {
            refuse("a folder has this name", "give the name of a file in it")
        }
        Ok(found) if !found.is_file() => {
            refuse("it is a device or a pipe", "give the name of an ordinary file")
        }
        Ok(_) => path.canonicalize().map_err(|error| unwritable(path, path, &error)),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(path.to_owned()),
        Err(error) => Err(unwritable(path, path, &error)),
    }
}

/// The folder of a file; `.` for a bare name.
fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

fn create_beside(path: &Path, target: &Path) -> Result<NamedTempFile, FilmError> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".truecast-").suffix(".part");
    // What an ordinary creation asks for; the process's mask takes away from it. The default of
    // temporary files, 0600, would hide the picture from everybody else.
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt as _;
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder_of(target)).map_err(|error| unwritable(path, target, &error))
}

/// Puts an error of the system into words, for the file as the user named it.
fn unwritable(path: &Path, target: &Path, error: &Error) -> FilmError {
    let folder = folder_of(target).display();
    let (reason, remedy) = match error.kind() {
        ErrorKind::NotFound => (format!("there is no folder {folder}"), "create it first"),
        ErrorKind::NotADirectory => (format!("{folder} is not a folder"), "choose another folder"),
        ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem => (
            format!("files cannot be created in {folder} ({error})"),
            "choose another folder or change its permissions",
        ),
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => {
            (format!("no space is left in {folder}"), "make space or choose another folder")
        }
        _ => (error.to_string(), "check the path"),
    };
    FilmError::Write { path: path.to_owned(), reason, remedy }
}
