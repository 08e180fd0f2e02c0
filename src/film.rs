//! The developed picture: named planes of samples over a window, ready to be written.
//!
//! A film knows nothing of scenes; it holds what files hold (f32 and u32) and nothing else.

use crate::pixel::{Resolution, Window};

/// The samples of one plane, row by row.
#[derive(Clone, Debug, PartialEq)]
pub enum Samples {
    /// 32-bit floats.
    Float(Vec<f32>),
    /// 32-bit unsigned integers; 0xFFFF_FFFF is "nothing" in id planes.
    Uint(Vec<u32>),
}

/// One named plane, as an EXR channel names it: `R`, `Z`, `N.X`, `id.prim` …
#[derive(Clone, Debug, PartialEq)]
pub struct Plane {
    /// Channel name.
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
}
