//! Wavefront OBJ and MTL files: polygons, normals, texture coordinates, materials.
//!
//! Every statement is read by a strict scan of our own, which knows lines and columns. The crate
//! tobj, which knows neither and repeats the previous index where a corner has none, would read the
//! same text again with the same `f64::from_str`, and take 15 times as long as the scan; only the
//! tests hold the two together. Nothing is dropped without a warning. Textures are only named here, for `resolve` to read;
//! curves, lines and points are not read.
//!
//! Format: Wavefront, "Advanced Visualizer Manual", appendix B1 (OBJ), and Ramey, Rose and
//! Tyerman, "MTL material format".

mod assembly;
mod color;
mod corner;
mod indexing;
mod materials;
mod mtl;
mod polygon;
mod report;
mod scan;
mod scanned;
mod smooth;
mod statement;

use crate::scene::error::{Place, SceneError};
use crate::scene::material::Material;
use crate::scene::part::MeshPart;
use crate::scene::texture::TextureRequests;
pub use polygon::Polygons;
use report::Report;
use std::io;
use std::path::Path;

/// What an OBJ file and its material libraries hold.
#[derive(Clone, Debug, PartialEq)]
pub struct ObjFile {
    /// The triangles in file order; polygons are cut as [`Polygons`] says. Positions are
    /// those that faces use, in order of first use.
    pub part: MeshPart,
    /// One material per entry of `part.material_names`, with that name. Names that no library
    /// defines have the default coefficients.
    pub materials: Vec<Material>,
    /// The textures that each material asks for; none was opened.
    pub textures: Vec<TextureRequests>,
    /// What a user should know: sentences that begin with file and line. Bounded in number.
    pub warnings: Vec<String>,
}

/// How a file is read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct ObjOptions {
    /// How polygons become triangles.
    pub polygons: Polygons,
    /// Leave out, with a warning, the faces that use a position which is not finite; otherwise such
    /// a position is an error. One that no face uses is then no fault at all.
    pub skip_bad: bool,
}

/// Reads an OBJ file and the libraries that it names, which are looked for beside it.
///
/// # Errors
/// A file that cannot be read ([`crate::scene::error::Fault::Reading`]), or what [`parse`] finds.
pub fn load(path: &Path, options: ObjOptions) -> Result<ObjFile, Vec<SceneError>> {
    let bytes = read(path).map_err(|error| {
        let message = match error.kind() {
            io::ErrorKind::NotFound => "the file does not exist".to_owned(),
            io::ErrorKind::IsADirectory => "this is a folder, not an OBJ file".to_owned(),
            _ => format!("the file cannot be read: {error}"),
        };
        vec![SceneError::reading(Place::file(path), message)]
    })?;
    parse(&bytes, path, options, &read)
}

/// Reads OBJ text. `path` names the file in messages and the folder of its libraries; `open`
/// gives a library's bytes.
///
/// # Errors
/// Faults of the text and of its libraries, each with its place; at most a screenful. A library
/// that `open` cannot give is a warning.
pub fn parse(
    bytes: &[u8],
    path: &Path,
    options: ObjOptions,
    open: &dyn Fn(&Path) -> io::Result<Vec<u8>>,
) -> Result<ObjFile, Vec<SceneError>> {
    let mut report = Report::default();
    let text = statement::decode(bytes, path, &mut report).map_err(|error| vec![error])?;
    let scan = scan::scan(&text, path, options.skip_bad, &mut report);
    let (materials, textures) = materials::resolve(&scan, path, open, &mut report);
    if report.has_errors() {
        return Err(report.into_errors());
    }
    let indexed = indexing::index(&scan);
    let part = assembly::assemble(&scan, indexed, options.polygons, path, &mut report);
    if report.has_errors() {
        return Err(report.into_errors());
    }
    Ok(ObjFile { part, materials, textures, warnings: report.into_warnings() })
}

/// The bytes of a file; folders are refused with the same error on every platform.
fn read(path: &Path) -> io::Result<Vec<u8>> {
    if path.is_dir() {
        return Err(io::Error::new(io::ErrorKind::IsADirectory, "it is a folder"));
    }
    read_side_by_side(path).map_or_else(|| std::fs::read(path), Ok)
}

/// Bytes that a thread reads at once.
const READ_BYTES: usize = 1 << 20;

/// Reads a long file on all threads: bringing bytes into fresh memory costs as much as parsing half of
/// them. `None` where that is not possible, or the file is short or changes meanwhile.
#[cfg(unix)]
fn read_side_by_side(path: &Path) -> Option<Vec<u8>> {
    use rayon::prelude::*;
    use std::os::unix::fs::FileExt as _;
    let file = std::fs::File::open(path).ok()?;
    let found = file.metadata().ok().filter(std::fs::Metadata::is_file)?;
    let length = usize::try_from(found.len()).ok().filter(|&length| length > READ_BYTES)?;
    let mut bytes = vec![0; length];
    let chunks = bytes.par_chunks_mut(READ_BYTES).enumerate();
    let results =
        chunks.map(|(chunk, bytes)| file.read_exact_at(bytes, (chunk * READ_BYTES) as u64));
    results.collect::<io::Result<()>>().ok()?;
    let is_same = file.metadata().is_ok_and(|now| now.len() == found.len());
    is_same.then_some(bytes)
}

#[cfg(not(unix))]
fn read_side_by_side(_path: &Path) -> Option<Vec<u8>> {
    None
}
