//! `docs/figures.md` and its pictures: every sheet is shown, and is what its command makes.

use super::stage::{scenes, sheet};
use std::fs;
use std::path::{Path, PathBuf};
use truecast::render::Unwatched;
use truecast::sheet::compose;

/// Largest picture of the page, in bytes.
const LARGEST: u64 = 150_000;

fn docs() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("docs")
}

/// Names of the sheets among the scenes' files.
fn sheets() -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(scenes().join("sheets"))
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| fs::read_to_string(path).unwrap().contains("\n[[cell]]\n"))
        .map(|path| path.file_stem().unwrap().to_str().unwrap().to_owned())
        .collect();
    names.sort_unstable();
    names
}

#[test]
fn the_page_shows_every_sheet_with_its_command() {
    let page = fs::read_to_string(docs().join("figures.md")).unwrap();
    let names = sheets();
    assert!(names.len() >= 14, "{names:?}");
    for name in &names {
        let head = fs::read_to_string(scenes().join(format!("sheets/{name}.toml"))).unwrap();
        let command = format!("truecast sheet scenes/sheets/{name}.toml\n");
        assert!(head.starts_with("# ") && head.contains(&command), "{name} says how it is made");
        assert!(page.contains(&format!("$ {command}")), "{name}");
        assert!(page.contains(&format!("(figures/{name}.png)")), "{name}");
    }
    // And every picture that it shows is there, and no other.
    let mut shown: Vec<_> =
        page.split("](figures/").skip(1).map(|rest| rest.split(')').next().unwrap()).collect();
    shown.sort_unstable();
    let mut files = Vec::new();
    for entry in fs::read_dir(docs().join("figures")).unwrap() {
        let entry = entry.unwrap();
        assert!(entry.metadata().unwrap().len() <= LARGEST, "{:?}", entry.path());
        files.push(entry.file_name().into_string().unwrap());
    }
    files.sort_unstable();
    assert_eq!(shown, files);
}

#[test]
fn the_pages_pictures_are_what_their_commands_make() {
    for name in sheets() {
        let sheet = sheet(&name);
        assert_eq!(sheet.warnings, [""; 0], "{name}");
        let made = compose(&sheet, &sheet.render(&Unwatched).unwrap());
        let shown = image::open(docs().join(format!("figures/{name}.png"))).unwrap().to_rgb8();
        assert_eq!(made.dimensions(), shown.dimensions(), "{name}");
        let differing = made.pixels().zip(shown.pixels()).filter(|(a, b)| a != b).count();
        assert_eq!(differing, 0, "{name}: draw docs/figures/{name}.png anew");
    }
}
