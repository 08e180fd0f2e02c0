//! The page and the inks that the reports' drawings share.

use super::Ink;

/// Width of a page, and the space that is left free around it, page units.
pub(crate) const WIDTH: u16 = 960;
pub(crate) const MARGIN: f64 = 16.0;

/// Words; words that explain; lines behind a plot.
pub(crate) const TEXT: Ink = [36, 41, 47];
pub(crate) const FAINT: Ink = [110, 118, 126];
pub(crate) const GRID: Ink = [222, 226, 230];
