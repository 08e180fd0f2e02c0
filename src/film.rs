//! The developed picture: named planes of samples over a window, and the files it is written to.
//!
//! A film knows nothing of scenes; it holds what files hold (f32 and u32) and nothing else. EXR
//! keeps every plane bit for bit, PNG the colours as 8-bit sRGB, NPY the triangle ids.

mod check;
mod deflate;
mod error;
mod exr;
mod npy;
mod png;
mod read;
mod write;

pub use self::error::FilmError;
pub use self::exr::{ExrLayout, ExrRows, ExrWriter, decode_exr, encode_exr};
pub use self::npy::encode_npy_ids;
pub use self::png::{ClipCount, append_codes, encode_picture, encode_png, srgb_picture};
pub use self::read::{NumberPlane, Numbers, PackedOrder, load_numbers};
pub use self::write::{
    AtomicFile, Format, check_target, check_writable, format_of, load_exr, save, write_atomic,
};

use crate::pixel::{Resolution, Window};

/// The samples of one plane, row by row.
#[derive(Clone, Debug, PartialEq)]
pub enum Samples {
    /// 32-bit floats.
    Float(Vec<f32>),
    /// 32-bit unsigned integers; 0xFFFF_FFFF is "nothing" in id planes.
    Uint(Vec<u32>),
}

impl Samples {
    /// Number of samples.
    pub fn len(&self) -> usize {
        match self {
            Self::Float(values) => values.len(),
            Self::Uint(values) => values.len(),
        }
    }

    /// Whether there is no sample.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// One named plane, as an EXR channel names it: `R`, `Z`, `N.X`, `id.prim` …
#[derive(Clone, Debug, PartialEq)]
pub struct Plane {
    /// Channel name: 1 to 255 bytes, without a zero byte.
    pub name: String,
    /// One sample per pixel of the film's window.
    pub samples: Samples,
}

/// A picture: planes over a window of a frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Film {
    /// The full frame (EXR display window).
    pub resolution: Resolution,
    /// The pixels at hand (EXR data window).
    pub window: Window,
    /// Planes, in any order; names are unique.
    pub planes: Vec<Plane>,
    /// Canonical JSON that says how the picture was made.
    pub description: String,
}

impl Film {
    /// The plane of that name.
    pub fn plane(&self, name: &str) -> Option<&Samples> {
        self.planes.iter().find(|plane| plane.name == name).map(|plane| &plane.samples)
    }

    /// How many pixels are brighter than f32 can hold: infinite in `R`, `G` or `B`.
    pub fn infinite_pixels(&self) -> usize {
        let colors: Vec<&[f32]> = ["R", "G", "B"]
            .into_iter()
            .filter_map(|name| match self.plane(name) {
                Some(Samples::Float(values)) => Some(values.as_slice()),
                _ => None,
            })
            .collect();
        // Hardly any picture has one: whole planes are looked at, many values at a time.
        if !colors.iter().any(|values| has_infinite(values)) {
            return 0;
        }
        let is_infinite = |index: &usize| {
            colors.iter().any(|values| values.get(*index).is_some_and(|value| value.is_infinite()))
        };
        (0..self.window.len()).filter(is_infinite).count()
    }
}

fn has_infinite(values: &[f32]) -> bool {
    values.iter().fold(false, |any, value| any | value.is_infinite())
}
