//! Files: wholly or not at all, and errors that say what to do.

use std::fs;
use std::path::Path;

use truecast::film::{
    FilmError, Format, check_target, encode_exr, format_of, load_exr, save, write_atomic,
};

use super::specimen;

fn names_in(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn the_extension_picks_the_format() {
    for (name, format) in [
        ("a.exr", Format::Exr),
        ("folder.png/A.EXR", Format::Exr),
        ("x.y.Png", Format::Png),
        ("ids.nPy", Format::Npy),
    ] {
        assert_eq!(format_of(Path::new(name)).unwrap(), format);
    }
    for name in ["a.jpg", "png", "folder.png/a", ".exr", "a.exr ", "", "a.exr.gz"] {
        let error = format_of(Path::new(name)).unwrap_err().to_string();
        assert!(error.contains(".exr, .png or .npy"), "{error}");
    }
}

#[test]
fn a_saved_film_is_the_only_file_and_replaces_the_old_one() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("picture.exr");
    let film = specimen([0, 0, 40, 37]);
    fs::write(&path, "old").unwrap();
    save(&film, &path).unwrap();
    assert_eq!(names_in(folder.path()), ["picture.exr"]);
    assert!(fs::read(&path).unwrap() == encode_exr(&film).unwrap());
    assert_eq!(load_exr(&path).unwrap().description, film.description);

    let ids = folder.path().join("ids.npy");
    save(&film, &ids).unwrap();
    assert_eq!(&fs::read(&ids).unwrap()[1..6], b"NUMPY");
}

#[test]
fn what_cannot_be_encoded_leaves_the_old_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("picture.png");
    fs::write(&path, "old").unwrap();
    let error = save(&specimen([0, 0, 40, 37]), &path).unwrap_err();
    assert!(matches!(error, FilmError::NotFinite { .. }));
    assert_eq!(fs::read(&path).unwrap(), b"old");
    assert_eq!(names_in(folder.path()), ["picture.png"]);
}

#[test]
fn unwritable_targets_are_named_with_a_remedy_and_leave_nothing() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("taken.png")).unwrap();
    fs::write(folder.path().join("file.txt"), "text").unwrap();
    let before = names_in(folder.path());
    for (name, reason, remedy) in [
        ("taken.png", "a folder has this name", "name of a file"),
        ("missing/x.png", "there is no folder", "create it first"),
        ("file.txt/x.png", "is not a folder", "choose another folder"),
    ] {
        let path = folder.path().join(name);
        for error in [write_atomic(&path, b"bytes").unwrap_err(), check_target(&path).unwrap_err()]
        {
            assert!(matches!(error, FilmError::Write { .. }));
            let message = error.to_string();
            assert!(message.contains(name), "{message}");
            assert!(message.contains(reason) && message.contains(remedy), "{message}");
        }
    }
    assert_eq!(names_in(folder.path()), before);
    // A name longer than any file system takes.
    let endless = folder.path().join(format!("{}.png", "x".repeat(5000)));
    assert!(write_atomic(&endless, b"bytes").is_err());
    assert_eq!(names_in(folder.path()), before);
}

#[test]
fn a_checked_target_stays_as_it_was() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("picture.exr");
    assert_eq!(check_target(&path).unwrap(), Format::Exr);
    assert!(names_in(folder.path()).is_empty());
    fs::write(&path, "old").unwrap();
    assert_eq!(check_target(&path).unwrap(), Format::Exr);
    assert_eq!(fs::read(&path).unwrap(), b"old");
}

#[cfg(unix)]
#[test]
fn a_written_file_has_ordinary_permissions_and_links_are_followed() {
    use std::os::unix::fs::{PermissionsExt as _, symlink};
    let folder = tempfile::tempdir().unwrap();
    let mode = |name: &str| fs::metadata(folder.path().join(name)).unwrap().permissions().mode();
    fs::write(folder.path().join("ordinary"), "").unwrap();
    write_atomic(&folder.path().join("ours"), b"new").unwrap();
    assert_eq!(mode("ours"), mode("ordinary"));

    fs::create_dir(folder.path().join("elsewhere")).unwrap();
    fs::write(folder.path().join("elsewhere/real.png"), "old").unwrap();
    symlink("elsewhere/real.png", folder.path().join("link.png")).unwrap();
    write_atomic(&folder.path().join("link.png"), b"new").unwrap();
    assert!(folder.path().join("link.png").is_symlink());
    assert_eq!(fs::read(folder.path().join("elsewhere/real.png")).unwrap(), b"new");

    let error = write_atomic(Path::new("/dev/null"), b"bytes").unwrap_err().to_string();
    assert!(error.contains("device"), "{error}");
}

#[test]
fn an_unreadable_file_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("no.exr");
    assert!(load_exr(&path).unwrap_err().to_string().contains("no.exr"));
    fs::write(&path, "not a picture").unwrap();
    let error = load_exr(&path).unwrap_err().to_string();
    assert!(error.contains("no.exr") && error.contains("not a readable EXR"), "{error}");
}
