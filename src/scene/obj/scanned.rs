//! What an OBJ text says, as the scan finds it and every later stage reads it.

use crate::color::LinearRgb;

/// What the text says, with file indices resolved to 0-based ones.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Scan {
    /// The numbers of each `v`.
    pub(super) positions: Vec<[f64; 3]>,
    /// Of each `vt`; 0 for a second number that is not there.
    pub(super) uvs: Vec<[f64; 2]>,
    /// Of each `vn`.
    pub(super) normals: Vec<[f64; 3]>,
    /// Colour of each `v`, white where it has none; empty when none has.
    pub(super) colors: Vec<LinearRgb>,
    /// How many `v`, `vt` and `vn` there are.
    pub(super) counts: [u32; 3],
    /// The corners of all faces, one after the other.
    pub(super) corners: Vec<Corner>,
    /// The faces in file order.
    pub(super) faces: Vec<Face>,
    /// Names that `mtllib` gives.
    pub(super) libraries: Vec<Name>,
    /// Names that `usemtl` gives to at least one face, in order of first use.
    pub(super) materials: Vec<Name>,
}

/// A corner's 0-based `v`, `vt` and `vn`; `NO_ATTRIBUTE` where it has none.
pub(super) type Corner = [u32; 3];

/// One `f` statement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Face {
    /// 1-based line.
    pub(super) line: u32,
    /// End of its corners in [`Scan::corners`]; they begin where the previous face's end.
    pub(super) corners_end: usize,
    /// Smoothing group; 0 is none.
    pub(super) group: u32,
    /// Position in [`Scan::materials`] or `NO_ATTRIBUTE`.
    pub(super) material: u32,
}

/// A name as written, and its line.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Name {
    pub(super) text: String,
    pub(super) line: u32,
}
