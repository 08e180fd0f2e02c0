//! Why a picture could not be written or read, with what to do about it.

use std::path::PathBuf;

/// A picture that could not be encoded, decoded, written or read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FilmError {
    /// The file name has no extension that names a format.
    #[error("{}: the name does not say which format to write; end it in .exr, .png or .npy", path.display())]
    UnknownFormat {
        /// The file as the user named it.
        path: PathBuf,
    },
    /// The file could not be written; nothing of it was left behind.
    #[error("cannot write {}: {reason}; {remedy}", path.display())]
    Write {
        /// The file as the user named it.
        path: PathBuf,
        /// What stands in the way.
        reason: String,
        /// What to do about it.
        remedy: &'static str,
    },
    /// The file could not be read.
    #[error("cannot read {}: {reason}", path.display())]
    Read {
        /// The file as the user named it.
        path: PathBuf,
        /// What stands in the way.
        reason: String,
    },
    /// The bytes are not an EXR picture that can be held in a film.
    #[error("not a readable EXR picture: {reason}")]
    Decode {
        /// What is wrong with the bytes, and what to do where there is a way.
        reason: String,
    },
    /// The format needs a plane that the film lacks, or holds in another type.
    #[error(
        "the {format} format needs the plane `{plane}` of {wanted}; render it too, or write .exr"
    )]
    Plane {
        /// The format asked for.
        format: &'static str,
        /// The plane's name.
        plane: &'static str,
        /// The sample type the format needs.
        wanted: &'static str,
    },
    /// The film breaks its own contract.
    #[error("the picture is inconsistent: {reason}")]
    Inconsistent {
        /// Which rule is broken, by which plane.
        reason: String,
    },
    /// A colour is infinite or not a number, so it has no 8-bit code.
    #[error(
        "the plane `{plane}` holds {value} at pixel ({x}, {y}), which PNG cannot hold; write .exr to look into it"
    )]
    NotFinite {
        /// The plane's name.
        plane: &'static str,
        /// Column in the full frame, in pixels.
        x: u32,
        /// Row in the full frame, in pixels.
        y: u32,
        /// The value found.
        value: f32,
    },
    /// An encoder refused.
    #[error("cannot encode {format}: {reason}")]
    Encode {
        /// The format asked for.
        format: &'static str,
        /// What the encoder says.
        reason: String,
    },
}
