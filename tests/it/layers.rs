//! Who may use whom: the floors of the crate, held against every path in `src`.
//!
//! `cast`, `raster` and `exact` answer the same question and must not know each other, or their
//! agreement would prove nothing. Paths count wherever they stand, in tests too; comments and
//! strings do not.

mod arithmetic;
mod paths;
mod samples;
mod tokens;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// A top-level module, and the modules that it may name besides itself.
/// [`EVERYTHING`] stands for no restriction.
type Allowed = (&'static str, &'static [&'static str]);

const EVERYTHING: &[&str] = &["*"];

/// From the ground floor up. `lib` is the crate's root file.
const ALLOWED: &[Allowed] = &[
    ("pixel", &[]),
    ("color", &[]),
    ("mesh", &["color"]),
    ("drawing", &[]),
    ("statistics", &[]),
    ("simd", &[]),
    ("mutant", &[]),
    ("scene", &["pixel", "color", "mesh"]),
    ("visibility", &["pixel", "mesh"]),
    ("film", &["pixel", "color"]),
    ("accel", &["pixel", "mesh", "simd", "mutant", "visibility"]),
    ("cast", &["pixel", "mesh", "simd", "mutant", "scene", "visibility", "accel"]),
    ("raster", &["pixel", "mesh", "simd", "mutant", "scene", "visibility"]),
    ("exact", &["pixel", "mesh", "mutant", "scene", "visibility"]),
    ("shade", &["pixel", "color", "mesh", "simd", "scene", "visibility", "film"]),
    ("lobe", &["color", "drawing", "scene", "shade"]),
    (
        "render",
        &[
            "pixel",
            "color",
            "mesh",
            "simd",
            "scene",
            "visibility",
            "film",
            "accel",
            "cast",
            "raster",
            "shade",
            "statistics",
        ],
    ),
    (
        "check",
        &[
            "pixel",
            "color",
            "mesh",
            "simd",
            "scene",
            "visibility",
            "film",
            "accel",
            "cast",
            "raster",
            "exact",
            "shade",
            "render",
        ],
    ),
    (
        "bench",
        &[
            "pixel",
            "mesh",
            "simd",
            "statistics",
            "scene",
            "visibility",
            "film",
            "accel",
            "cast",
            "raster",
            "exact",
            "shade",
            "render",
            "drawing",
        ],
    ),
    (
        "export",
        &[
            "pixel",
            "color",
            "mesh",
            "scene",
            "visibility",
            "film",
            "accel",
            "cast",
            "raster",
            "exact",
            "shade",
            "render",
        ],
    ),
    (
        "cost",
        &[
            "pixel",
            "color",
            "mesh",
            "drawing",
            "statistics",
            "simd",
            "scene",
            "visibility",
            "film",
            "accel",
            "cast",
            "raster",
            "shade",
            "render",
            "bench",
        ],
    ),
    ("sheet", &["pixel", "color", "drawing", "scene", "film", "render"]),
    ("cli", EVERYTHING),
    ("main", EVERYTHING),
    ("lib", EVERYTHING),
];

/// What is wrong with one file that is the module `module` (its first name is the top-level
/// module).
fn violations(source: &str, module: &[String]) -> Vec<String> {
    let own = module[0].as_str();
    let Some((_, allowed)) = ALLOWED.iter().find(|(name, _)| *name == own) else {
        return vec![format!("`{own}` is missing from the table of floors")];
    };
    if *allowed == EVERYTHING {
        return Vec::new();
    }
    let found = paths::references(&tokens::tokens(source), module);
    let mut wrong = Vec::new();
    for path in &found.paths {
        match path.first() {
            None => wrong.push(format!("`{own}` names the whole crate")),
            Some(used) if used == own || allowed.contains(&used.as_str()) => {}
            Some(_) => wrong.push(format!("`{own}` may not use `crate::{}`", path.join("::"))),
        }
    }
    if found.includes_source {
        wrong.push(format!("`{own}` includes source text"));
    }
    for (file, _) in found.moved_modules.iter().filter(|(file, _)| !is_file_name(file)) {
        wrong.push(format!("`{own}` takes a module from `{file}`"));
    }
    wrong
}

/// Whether a `#[path]` stays in its folder.
fn is_file_name(file: &str) -> bool {
    !file.contains(['/', '\\'])
}

/// Every file of `src` with its text.
fn sources() -> BTreeMap<PathBuf, String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut folders = vec![root.clone()];
    let mut sources = BTreeMap::new();
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                let text = std::fs::read_to_string(&path).unwrap();
                sources.insert(path.strip_prefix(&root).unwrap().to_owned(), text);
            }
        }
    }
    sources
}

/// `exact/interval.rs` is the module exact::interval.
fn module_of(file: &Path) -> Vec<String> {
    file.with_extension("")
        .components()
        .map(|component| component.as_os_str().to_str().unwrap().to_owned())
        .collect()
}

#[test]
fn every_module_uses_only_the_floors_below_it() {
    let sources = sources();
    assert!(sources.len() > 10, "the sources were found");
    let mut modules: BTreeMap<PathBuf, Vec<String>> =
        sources.keys().map(|file| (file.clone(), module_of(file))).collect();
    // Files that a `#[path]` hangs elsewhere are the modules they are declared as.
    for (file, text) in &sources {
        let found = paths::references(&tokens::tokens(text), &module_of(file));
        for (moved, module) in found.moved_modules {
            modules.insert(file.with_file_name(moved), module);
        }
    }
    let mut wrong = Vec::new();
    for (file, text) in &sources {
        for violation in violations(text, &modules[file]) {
            wrong.push(format!("src/{}: {violation}", file.display()));
        }
    }
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

#[test]
fn the_three_answerers_do_not_know_each_other() {
    let answerers = ["cast", "raster", "exact"];
    for (module, allowed) in ALLOWED.iter().filter(|(name, _)| answerers.contains(name)) {
        assert!(answerers.iter().all(|name| !allowed.contains(name)), "{module}");
        assert_eq!(allowed.contains(&"accel"), *module == "cast", "{module}");
    }
    // A row names only rows above it, so there are no cycles.
    for (row, (module, allowed)) in ALLOWED.iter().enumerate() {
        let below: Vec<&str> = ALLOWED[..row].iter().map(|(name, _)| *name).collect();
        let is_downward = allowed.iter().all(|name| *name == "*" || below.contains(name));
        assert!(is_downward, "{module}");
    }
}

/// The file that speaks to a C library, if the program is built with it, and the one that asks for
/// memory ahead.
const UNSAFE: [&str; 2] = ["bench/peers/embree_sys.rs", "simd/prefetch.rs"];

#[test]
fn unsafe_stands_in_two_files() {
    let speaks = |text: &str| {
        let tokens = tokens::tokens(text);
        tokens.iter().any(|token| token.is_word("unsafe") || token.is_word("unsafe_code"))
    };
    let files: Vec<PathBuf> =
        sources().into_iter().filter(|(_, t)| speaks(t)).map(|f| f.0).collect();
    assert_eq!(files, UNSAFE.map(Path::new));
}
