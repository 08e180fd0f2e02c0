//! From `mtllib` and `usemtl` to materials: finds the libraries, reads them, resolves the names.
//!
//! Names are resolved after the whole file was read, so the order of `mtllib` and `usemtl` does
//! not matter. What is missing is a warning, for meshes often travel without their libraries.

use crate::scene::material::Material;
use crate::scene::obj::mtl::{Library, read_library};
use crate::scene::obj::report::{Report, quote};
use crate::scene::obj::scanned::{Name, Scan};
use crate::scene::obj::statement::{decode, without_comment};
use crate::scene::texture::TextureRequests;
use std::collections::HashSet;
use std::io;
use std::path::{Path, PathBuf};

/// Missing materials that a warning names; the others are counted.
const MAX_NAMES: usize = 8;

/// One material per name that the scan's faces use, and the textures that it asks for, in the same
/// order.
pub(super) fn resolve(
    scan: &Scan,
    file: &Path,
    open: &dyn Fn(&Path) -> io::Result<Vec<u8>>,
    report: &mut Report,
) -> (Vec<Material>, Vec<TextureRequests>) {
    let library = load_libraries(scan, file, open, report);
    let mut missing: Vec<&Name> = Vec::new();
    let mut materials = Vec::with_capacity(scan.materials.len());
    let mut textures = Vec::with_capacity(scan.materials.len());
    for name in &scan.materials {
        let found = library.find(&name.text).cloned().unwrap_or_else(|| {
            missing.push(name);
            Material::default_named(&name.text)
        });
        materials.push(Material { name: name.text.clone(), ..found });
        textures.push(library.textures(&name.text).cloned().unwrap_or_default());
    }
    if let Some(first) = missing.first() {
        let names: Vec<String> = missing.iter().take(MAX_NAMES).map(|n| quote(&n.text)).collect();
        let further = match missing.len() - names.len() {
            0 => String::new(),
            count => format!(" and {count} more"),
        };
        let sentence = format!(
            "no library defines {}{further}; the default coefficients are used",
            names.join(", ")
        );
        report.warn(file, first.line, &sentence);
    }
    (materials, textures)
}

/// Reads every library once, in file order.
fn load_libraries(
    scan: &Scan,
    file: &Path,
    open: &dyn Fn(&Path) -> io::Result<Vec<u8>>,
    report: &mut Report,
) -> Library {
    let mut library = Library::default();
    let mut read: HashSet<String> = HashSet::new();
    for name in &scan.libraries {
        if !read.insert(name.text.clone()) {
            continue;
        }
        for (path, bytes) in open_libraries(&name.text, file, open) {
            let bytes = match bytes {
                Ok(bytes) => bytes,
                Err(error) => {
                    let shown = path.display();
                    let sentence = format!("the material library {shown} is left out: {error}");
                    report.warn(file, name.line, &sentence);
                    continue;
                }
            };
            match decode(&bytes, &path, report) {
                Ok(text) => read_library(&text, &path, &mut library, report),
                Err(error) => report.error(error),
            }
        }
    }
    library
}

/// A library's path and its bytes, or why they could not be read.
type Opened = (PathBuf, io::Result<Vec<u8>>);

/// `mtllib` may name one file with blanks in its name or several files, and a comment may follow:
/// the first reading that names an existing file counts, else every word is a file.
fn open_libraries(
    name: &str,
    file: &Path,
    open: &dyn Fn(&Path) -> io::Result<Vec<u8>>,
) -> Vec<Opened> {
    let folder = file.parent().unwrap_or(Path::new(""));
    let open = |name: &str| {
        let path = folder.join(name);
        let bytes = open(&path);
        (path, bytes)
    };
    // Windows exporters write folders with backslashes.
    let open = |name: &str| match open(name) {
        (_, Err(error)) if name.contains('\\') && error.kind() == io::ErrorKind::NotFound => {
            open(&name.replace('\\', "/"))
        }
        opened => opened,
    };
    let is_missing =
        |opened: &Opened| matches!(&opened.1, Err(e) if e.kind() == io::ErrorKind::NotFound);
    let bare = without_comment(name);
    let whole = open(name);
    if !is_missing(&whole) {
        return vec![whole];
    }
    if bare != name {
        let whole_bare = open(bare);
        if !is_missing(&whole_bare) {
            return vec![whole_bare];
        }
    }
    let words: Vec<&str> = bare.split_whitespace().collect();
    let opened: Vec<Opened> = words.iter().map(|word| open(word)).collect();
    match opened.iter().all(is_missing) {
        // Then the name as a whole is the likelier reading.
        true => vec![whole],
        false => opened,
    }
}
