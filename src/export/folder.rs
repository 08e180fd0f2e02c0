//! The bundle's folder: made beside its place and renamed into it, or refused.
//!
//! Nothing but an empty folder or a former bundle is ever replaced; a former bundle to which
//! anything was added is refused, for the addition is somebody's work.

use super::FILES;
use super::spool::Spool;
use crate::film::FilmError;
use std::fs;
use std::io::{Error, ErrorKind};
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// Files by which a former bundle is known.
const MARKS: [&str; 2] = ["camera.json", "prim.npy"];

/// A folder as the user named it, for what is said when it cannot be written.
#[derive(Clone, Copy, Debug)]
pub(super) struct Failing<'a> {
    folder: &'a Path,
}

impl<'a> Failing<'a> {
    pub(super) fn new(folder: &'a Path) -> Self {
        Self { folder }
    }

    fn refuse(self, reason: impl Into<String>, remedy: &'static str) -> FilmError {
        FilmError::Write { path: self.folder.to_owned(), reason: reason.into(), remedy }
    }

    /// The folder itself, or what it links to.
    pub(super) fn target(self) -> Result<PathBuf, FilmError> {
        match self.folder.canonicalize() {
            Ok(target) => Ok(target),
            Err(error) if error.kind() == ErrorKind::NotFound => Ok(self.folder.to_owned()),
            Err(error) => Err(self.because(&error)),
        }
    }

    /// Puts an error of the system into words.
    pub(super) fn because(self, error: &Error) -> FilmError {
        let parent = parent_of(self.folder).display();
        match error.kind() {
            ErrorKind::NotFound => {
                self.refuse(format!("there is no folder {parent}"), "create it first")
            }
            ErrorKind::NotADirectory => {
                self.refuse(format!("{parent} is not a folder"), "choose another folder")
            }
            ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem => self.refuse(
                format!("nothing can be created in {parent} ({error})"),
                "choose another folder or change its permissions",
            ),
            ErrorKind::StorageFull | ErrorKind::QuotaExceeded => self.refuse(
                format!("no space is left in {parent}"),
                "make space or choose another folder",
            ),
            _ => self.refuse(error.to_string(), "check the path"),
        }
    }
}

/// The folder that holds a folder; `.` for a bare name.
pub(super) fn parent_of(folder: &Path) -> &Path {
    match folder.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}

/// Checks, before any work is spent, that a bundle could be placed at `folder` now.
///
/// # Errors
/// [`FilmError::Write`] when a file or a folder that is neither empty nor a former bundle has this
/// name, or nothing can be created beside it.
pub fn check_folder(folder: &Path) -> Result<(), FilmError> {
    let failing = Failing::new(folder);
    let target = failing.target()?;
    check_replaceable(failing, &target)?;
    create_beside(failing, &target)?;
    Ok(())
}

/// Copies the files into a new folder beside `folder` and renames it there.
pub(super) fn place(files: Vec<Spool>, folder: &Path) -> Result<u64, FilmError> {
    let failing = Failing::new(folder);
    let target = failing.target()?;
    let beside = create_beside(failing, &target)?;
    let mut bytes = 0;
    for file in files {
        let path = beside.path().join(file.name());
        bytes += file.copy_to(&path).map_err(|error| failing.because(&error))?;
    }
    let is_former = check_replaceable(failing, &target)?;
    if is_former {
        // Move the former bundle out of the way; it goes back should the new one not arrive.
        let away = create_beside(failing, &target)?;
        let former = away.path().join("former");
        fs::rename(&target, &former).map_err(|error| failing.because(&error))?;
        if let Err(error) = fs::rename(beside.path(), &target) {
            let _ = fs::rename(&former, &target);
            return Err(failing.because(&error));
        }
    } else {
        fs::rename(beside.path(), &target).map_err(|error| failing.because(&error))?;
    }
    // It has left the place that would be removed.
    let _ = beside.keep();
    Ok(bytes)
}

/// Whether a former bundle is at `target`; an error if anything else is, save an empty folder.
fn check_replaceable(failing: Failing<'_>, target: &Path) -> Result<bool, FilmError> {
    let entries = match fs::read_dir(target) {
        Ok(entries) => entries,
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(false),
        Err(error) if error.kind() == ErrorKind::NotADirectory && target.exists() => {
            let reason = "a file has this name";
            return Err(failing.refuse(reason, "choose another name or remove the file"));
        }
        Err(error) => return Err(failing.because(&error)),
    };
    let mut names = Vec::new();
    for entry in entries {
        let entry = entry.map_err(|error| failing.because(&error))?;
        names.push(entry.file_name().to_string_lossy().into_owned());
    }
    names.sort();
    let is_former = MARKS.iter().all(|mark| names.iter().any(|name| name == mark));
    let strange = names.iter().find(|name| !is_former || !FILES.contains(&name.as_str()));
    match strange {
        None => Ok(is_former),
        Some(name) if is_former => Err(failing.refuse(
            format!("the bundle there also holds {name}, which would be lost"),
            "move it away or choose another folder",
        )),
        Some(_) => Err(failing.refuse(
            "a folder of this name exists, is not empty and holds no bundle",
            "choose another name or empty the folder",
        )),
    }
}

/// A temporary folder on the same disk, removed unless it is kept.
fn create_beside(failing: Failing<'_>, target: &Path) -> Result<TempDir, FilmError> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".truecast-").suffix(".part");
    // What an ordinary creation asks for; the process's mask takes away from it.
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt as _;
        builder.permissions(fs::Permissions::from_mode(0o777));
    }
    builder.tempdir_in(parent_of(target)).map_err(|error| failing.because(&error))
}
