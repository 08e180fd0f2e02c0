//! `sources.json`: which mesh, file and line each triangle comes from.

use crate::scene::{Scene, Source};
use serde::Serialize;
use std::io::{self, Write};

#[derive(Serialize)]
struct Sources<'a> {
    schema: &'a str,
    meshes: Vec<Mesh<'a>>,
}

/// One `[[mesh]]`: the triangles `first..first + count`.
#[derive(Serialize)]
struct Mesh<'a> {
    first: u32,
    count: u32,
    name: &'a str,
    /// `null` for a generated shape.
    file: Option<String>,
    /// 1-based line of each triangle's face; empty for a generated shape.
    lines: &'a [u32],
}

/// Writes the file, on one line.
pub(super) fn write(scene: &Scene, mut file: &mut impl Write) -> io::Result<()> {
    let meshes = scene.objects.iter().map(|object| {
        let (path, lines) = match &object.source {
            Source::Shape(_) => (None, &[][..]),
            Source::File { path, lines } => (Some(path.display().to_string()), &lines[..]),
        };
        let name = &object.name;
        Mesh {
            first: object.triangles.start,
            count: object.triangles.end - object.triangles.start,
            name,
            file: path,
            lines,
        }
    });
    let sources = Sources { schema: "truecast/sources/1", meshes: meshes.collect() };
    serde_json::to_writer(&mut file, &sources)?;
    file.write_all(b"\n")
}
