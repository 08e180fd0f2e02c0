//! How visibility is decided: exactly, or in a way that others have, to be compared with it.
//!
//! Only the words; the paths hold the arithmetic.

use crate::raster::{DepthBuffer, SubpixelBits};

/// How visibility is decided.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub enum Accuracy {
    /// Every pixel is the exact answer.
    #[default]
    Exact,
    /// The rasterizer of graphics processors: no holes, but vertices moved to a fixed-point grid
    /// and depths in f32.
    Watertight {
        /// Bits of the grid below the pixel.
        subpixel_bits: SubpixelBits,
        /// How depths are stored; `None` keeps the interpolated f32 1/w.
        depth_buffer: Option<DepthBuffer>,
    },
}

impl Accuracy {
    /// The word for it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Exact => "exact",
            Self::Watertight { .. } => "watertight",
        }
    }
}
