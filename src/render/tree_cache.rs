//! Trees that are kept in a folder between runs, each under the digest of what it was built from.
//!
//! A file is used only if it is whole and a tree over exactly this mesh; else the tree is built
//! anew, which is told, and the file replaced in one step. Nothing here can fail a render, and
//! nothing is ever deleted.

use crate::accel::{Accelerator, BuildPreset, TreeKey};
use crate::film::write_atomic;
use crate::mesh::TriangleMesh;
use std::io::{self, Read as _};
use std::path::{Path, PathBuf};

/// Where a tree came from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TreeSource {
    /// It was built.
    Built,
    /// It was built and kept.
    Kept,
    /// It was kept before.
    Loaded,
}

/// A tree, where it came from, and what is to be told about its file.
#[derive(Clone, Debug)]
pub struct CachedTree {
    /// The tree.
    pub accelerator: Accelerator,
    /// Where it came from.
    pub source: TreeSource,
    /// Why a file was not used or not written, if there is a reason to tell.
    pub remark: Option<String>,
}

/// The tree of a mesh: from a file in `folder` if there is one, else built, and kept there.
pub fn cached_tree(mesh: &TriangleMesh, preset: BuildPreset, folder: Option<&Path>) -> CachedTree {
    let Some(folder) = folder else {
        let accelerator = Accelerator::build(mesh, preset);
        return CachedTree { accelerator, source: TreeSource::Built, remark: None };
    };
    let key = TreeKey::new(mesh, preset);
    let path = path_of(folder, key);
    let refused = match load(&path, key, mesh) {
        Ok(accelerator) => {
            return CachedTree { accelerator, source: TreeSource::Loaded, remark: None };
        }
        Err(None) => None,
        Err(Some(why)) => {
            Some(format!("{} is not used: {why}; the BVH is built anew", path.display()))
        }
    };
    let accelerator = Accelerator::build(mesh, preset);
    let kept = std::fs::create_dir_all(folder)
        .map_err(|error| format!("the folder {} cannot be made: {error}", folder.display()))
        .and_then(|()| {
            let bytes = accelerator.to_bytes(key);
            write_atomic(&path, &bytes).map_err(|error| error.to_string())
        });
    let (source, unkept) = match kept {
        Ok(()) => (TreeSource::Kept, None),
        Err(why) => (TreeSource::Built, Some(format!("the BVH is not kept: {why}"))),
    };
    let remarks: Vec<String> = refused.into_iter().chain(unkept).collect();
    let remark = (!remarks.is_empty()).then(|| remarks.join("; "));
    CachedTree { accelerator, source, remark }
}

fn path_of(folder: &Path, key: TreeKey) -> PathBuf {
    folder.join(format!("{}.bvh", key.to_hex()))
}

/// Reads a file; `Err(None)` where there is none, else why it is not used.
fn load(path: &Path, key: TreeKey, mesh: &TriangleMesh) -> Result<Accelerator, Option<String>> {
    let told = |error: io::Error| Some(error.to_string());
    let file = match std::fs::File::open(path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Err(None),
        opened => opened.map_err(told)?,
    };
    // A longer file is no tree of this mesh, however long it is: nothing is spent on it.
    let most = Accelerator::most_bytes(mesh.len()) as u64;
    let mut bytes = Vec::new();
    file.take(most + 1).read_to_end(&mut bytes).map_err(told)?;
    if bytes.len() as u64 > most {
        return Err(Some("it is too long".to_owned()));
    }
    Accelerator::from_bytes(&bytes, key, mesh).map_err(|fault| Some(fault.to_string()))
}
