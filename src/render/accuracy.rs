//! How visibility is decided: exactly, or in a way that others have, to be compared with it.
//!
//! Only the words; the paths hold the arithmetic.

use super::VisibilityPath;
use crate::cast;
use crate::raster;

/// How visibility is decided.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub enum Accuracy {
    /// Every pixel is the exact answer.
    #[default]
    Exact,
    /// Rays, without proof.
    Cast(cast::Unproven),
    /// The z-buffer rasterizer, without proof.
    Raster(raster::Unproven),
}

impl Accuracy {
    /// The word for it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Exact => "exact",
            Self::Cast(unproven) => unproven.name(),
            Self::Raster(unproven) => unproven.name(),
        }
    }

    /// The path whose way it is; `None` where both paths give the same answer.
    pub const fn path(self) -> Option<VisibilityPath> {
        match self {
            Self::Exact => None,
            Self::Cast(_) => Some(VisibilityPath::Cast),
            Self::Raster(_) => Some(VisibilityPath::Raster),
        }
    }

    /// Whether all triangles that cross a pixel's ray can be counted.
    pub const fn counts_cover(self) -> bool {
        matches!(self, Self::Exact | Self::Raster(raster::Unproven::Watertight { .. }))
    }
}
