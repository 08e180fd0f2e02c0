//! The table of keys in the crate docs and the parser know the same keys.
//!
//! An unknown key's help lists what its table knows, and that list is what the parser asks for. So
//! a scene with an unknown key in every table tells all keys of the parser.

use std::collections::BTreeSet;
use std::path::Path;
use truecast::scene::{Overrides, Scene};

/// The module whose docs hold the table.
const SOURCE: &str = include_str!("../../src/scene/file.rs");

/// A key that resembles none.
const UNKNOWN: &str = "qqqq";

/// First column of the table.
fn documented() -> BTreeSet<String> {
    let rows = SOURCE.lines().filter_map(|line| line.strip_prefix("//! | `"));
    let keys: Vec<String> =
        rows.map(|row| row.split('`').next().unwrap_or_default().to_owned()).collect();
    let set: BTreeSet<String> = keys.iter().cloned().collect();
    assert_eq!(set.len(), keys.len(), "a key stands twice in the table");
    set
}

/// What the parser knows in the table under `path`, which is written as `header`.
fn known(path: &str, header: &str) -> BTreeSet<String> {
    let text = format!("{header}\n{UNKNOWN} = 0\n");
    let overrides = Overrides::default();
    let errors = Scene::from_toml(&text, Path::new("x"), Path::new(""), &overrides).unwrap_err().0;
    let unknown = |message: &str| message.starts_with(&format!("unknown key `{UNKNOWN}`"));
    let error = errors.iter().find(|error| unknown(&error.message)).expect("an unknown key");
    let list = error.help.as_deref().and_then(|help| help.strip_prefix("known here: "));
    let list = list.expect("a list of the known keys");
    list.split(", ").map(|key| format!("{path}{key}")).collect()
}

#[test]
fn the_documented_keys_are_the_known_keys() {
    let tables = [
        ("", ""),
        ("image.", "[image]"),
        ("camera.", "[camera]"),
        ("camera.exact.", "[camera.exact]"),
        ("camera.opencv.", "[camera.opencv]"),
        ("camera.gl.", "[camera.gl]"),
        ("material.", "[[material]]"),
        ("mesh.", "[[mesh]]"),
        ("light.", "[[light]]"),
        ("switches.", "[switches]"),
    ];
    let parsed: BTreeSet<String> =
        tables.iter().flat_map(|(path, header)| known(path, header)).collect();
    let documented = documented();
    let differences: Vec<_> = parsed.symmetric_difference(&documented).collect();
    assert!(differences.is_empty(), "only on one side: {differences:?}");
}
