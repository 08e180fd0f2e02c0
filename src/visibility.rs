//! The shape of an answer: what is visible at each pixel, as both paths write it.
//!
//! Only types and their layout live here: no predicate, no evaluation. Each path fills every
//! field by its own arithmetic, so that comparing two buffers compares two computations.

use crate::mesh::{Barycentric, TriangleId};
use crate::pixel::{Pixel, Window};
use rayon::prelude::*;

/// Which side of the triangle the eye sees.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Facing {
    /// The corners run counter-clockwise as seen from the eye; V < 0.
    Front,
    /// The corners run clockwise as seen from the eye; V > 0.
    Back,
}

impl Facing {
    /// +1 for the front, −1 for the back: −sgn V.
    pub const fn sign(self) -> i8 {
        match self {
            Self::Front => 1,
            Self::Back => -1,
        }
    }
}

/// The arithmetic that the visible triangle's own coverage needed at a sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Level {
    /// Certified by an f32 filter, or far enough from every edge for one.
    Single = 0,
    /// Certified by an f64 filter, or computed in f64 without any rounding.
    Double = 1,
    /// Decided in arithmetic beyond f64, or a tie, however it was found.
    Exact = 2,
}

/// The visible triangle at a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Visible {
    /// Which triangle.
    pub triangle: TriangleId,
    /// Which of its sides the eye sees.
    pub facing: Facing,
    /// Level of its coverage decision; [`Level::Exact`] too where `tie` is set.
    pub level: Level,
    /// The sample lies exactly on one of its edges, or another covering triangle lies at exactly
    /// the same depth there: the tie rule decided.
    pub tie: bool,
    /// Weights of its corners at the sample; relative error at most a few 2^-50.
    pub barycentric: Barycentric,
    /// Certain lower bound of the ray parameter t (t > 0, finite).
    pub t_lo: f64,
    /// Certain upper bound of the ray parameter t (finite).
    pub t_hi: f64,
}

impl Visible {
    /// The ray parameter: the middle of its certain interval.
    pub fn t(&self) -> f64 {
        self.t_lo + (self.t_hi - self.t_lo) * 0.5
    }
}

/// All triangles that cross a sample's ray, at any depth.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Cover {
    /// How many cover the sample.
    pub crossed: u32,
    /// Σ sgn V over them: on a closed mesh, the winding number of the eye at every sample.
    pub signed: i32,
}

/// How many decisions each level of arithmetic took, coverage and depth together, and how many
/// pixels needed no more than it. A decision counts at the level whose arithmetic ended it: an
/// equality that f64 finds without any rounding is a `double`, and so is an order in a plane that
/// an earlier pixel found to be shared.
/// They depend on the order of the work and are reported, never stored in a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LevelCounts {
    /// Decisions that an f32 filter certified.
    pub single: u64,
    /// Decisions that an f64 filter certified, or f64 without any rounding.
    pub double: u64,
    /// Decisions that took arithmetic beyond f64.
    pub exact: u64,
    /// Pixels at which f32 made every decision. Pixels without any decision count nowhere; a path
    /// that does not work pixel by pixel leaves these three 0.
    pub pixels_single: u64,
    /// Pixels whose highest level was f64.
    pub pixels_double: u64,
    /// Pixels at which some decision took arithmetic beyond f64.
    pub pixels_exact: u64,
}

impl LevelCounts {
    /// Nothing was decided.
    pub const NONE: Self = Self {
        single: 0,
        double: 0,
        exact: 0,
        pixels_single: 0,
        pixels_double: 0,
        pixels_exact: 0,
    };

    /// Adds another tile's counts.
    pub fn add(&mut self, other: Self) {
        self.single += other.single;
        self.double += other.double;
        self.exact += other.exact;
        self.pixels_single += other.pixels_single;
        self.pixels_double += other.pixels_double;
        self.pixels_exact += other.pixels_exact;
    }
}

/// What a visibility path is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Counting {
    /// Only the visible triangle.
    #[default]
    Nearest,
    /// Also [`Cover`] at every pixel, which forbids culling by depth.
    All,
}

/// The answer for every pixel of a window, row by row.
#[derive(Clone, Debug, PartialEq)]
pub struct VisibilityBuffer {
    /// Which pixels.
    pub window: Window,
    /// What is visible there; `None` where nothing is.
    pub visible: Vec<Option<Visible>>,
    /// Counts over all crossed triangles, when they were asked for.
    pub cover: Option<Vec<Cover>>,
    /// Decisions per level.
    pub levels: LevelCounts,
}

/// The nearest triangle of every pixel of a window and its ray parameter, row by row: what a z-buffer
/// holds, and no more.
#[derive(Clone, Debug, PartialEq)]
pub struct NearestBuffer {
    /// Which pixels.
    pub window: Window,
    /// The visible triangle's id, exact; `u32::MAX` where nothing is visible.
    pub ids: Vec<u32>,
    /// The ray parameter t, to a relative 2^-18; +∞ where nothing is visible.
    pub t: Vec<f32>,
    /// Decisions per level.
    pub levels: LevelCounts,
}

/// What lies behind the nearest surface, for every pixel of a window whose nearest is see-through:
/// all surfaces in exact depth order, ties by id, up to and including the first opaque one.
#[derive(Clone, Debug, PartialEq)]
pub struct Layers {
    /// Which pixels.
    pub window: Window,
    /// Per pixel, row by row, where its surfaces begin in `surfaces`; one more for the end.
    starts: Vec<usize>,
    surfaces: Vec<Visible>,
}

impl Layers {
    /// Nothing lies behind anything.
    pub fn none(window: Window) -> Self {
        Self { window, starts: vec![0; window.len() + 1], surfaces: Vec::new() }
    }

    /// Puts tiles together that cover `window` exactly once; each comes with the surfaces of its
    /// pixels, row by row. A tile in which nothing lies behind anything may come without any.
    pub fn from_tiles(window: Window, tiles: &[(Window, Vec<Vec<Visible>>)]) -> Self {
        let mut of_pixels: Vec<&[Visible]> = vec![&[]; window.len()];
        for (tile, lists) in tiles {
            for (index, list) in lists.iter().enumerate() {
                of_pixels[window.index(tile.pixel(index))] = list;
            }
        }
        let mut layers = Self { window, starts: vec![0], surfaces: Vec::new() };
        for list in of_pixels {
            layers.surfaces.extend_from_slice(list);
            layers.starts.push(layers.surfaces.len());
        }
        layers
    }

    /// The surfaces behind the nearest at a row-major position of the window, nearest first.
    pub fn of(&self, index: usize) -> &[Visible] {
        &self.surfaces[self.starts[index]..self.starts[index + 1]]
    }

    /// Whether nothing lies behind anything.
    pub fn is_empty(&self) -> bool {
        self.surfaces.is_empty()
    }

    /// Number of pixels at which something lies behind a see-through surface.
    pub fn layered_pixels(&self) -> usize {
        self.starts.windows(2).filter(|pair| pair[0] < pair[1]).count()
    }

    /// The largest number of surfaces behind the nearest.
    pub fn most(&self) -> usize {
        self.starts.windows(2).map(|pair| pair[1] - pair[0]).max().unwrap_or(0)
    }
}

/// One tile's part of a [`VisibilityBuffer`].
#[derive(Clone, Debug)]
pub struct VisibilityTile {
    /// Which pixels.
    pub window: Window,
    /// As in [`VisibilityBuffer`].
    pub visible: Vec<Option<Visible>>,
    /// As in [`VisibilityBuffer`]; empty when not asked for.
    pub cover: Vec<Cover>,
    /// As in [`VisibilityBuffer`].
    pub levels: LevelCounts,
}

impl VisibilityTile {
    /// A tile in which nothing is visible yet.
    pub fn empty(window: Window, counting: Counting) -> Self {
        let cover = match counting {
            Counting::Nearest => Vec::new(),
            Counting::All => vec![Cover::default(); window.len()],
        };
        Self { window, visible: vec![None; window.len()], cover, levels: LevelCounts::default() }
    }
}

impl VisibilityBuffer {
    /// A buffer for a window that is still to be seen; it has room for no pixel yet.
    pub const fn unseen(window: Window) -> Self {
        Self { window, visible: Vec::new(), cover: None, levels: LevelCounts::NONE }
    }

    /// Takes another window, with one entry per pixel: the memory stays, and so does what it holds,
    /// until the whole window is written.
    pub fn turn_to(&mut self, window: Window) {
        self.window = window;
        self.levels = LevelCounts::default();
        self.cover = None;
        if self.visible.len() >= window.len() {
            self.visible.truncate(window.len());
            return;
        }
        // Fresh memory costs as much as what is written there: all threads share it.
        self.visible = (0..window.len()).into_par_iter().map(|_| None).collect();
    }

    /// Puts tiles together that cover `window` exactly once.
    pub fn from_tiles(window: Window, counting: Counting, tiles: Vec<VisibilityTile>) -> Self {
        let mut visible = vec![None; window.len()];
        let mut cover = match counting {
            Counting::Nearest => None,
            Counting::All => Some(vec![Cover::default(); window.len()]),
        };
        let mut levels = LevelCounts::default();
        for tile in tiles {
            levels.add(tile.levels);
            let width = tile.window.width() as usize;
            for row in 0..tile.window.height() {
                let first = Pixel { x: tile.window.x0(), y: tile.window.y0() + row };
                let to = window.index(first);
                let from = row as usize * width;
                visible[to..to + width].copy_from_slice(&tile.visible[from..from + width]);
                if let Some(cover) = &mut cover {
                    cover[to..to + width].copy_from_slice(&tile.cover[from..from + width]);
                }
            }
        }
        Self { window, visible, cover, levels }
    }

    /// What is visible at a pixel of the window.
    pub fn at(&self, pixel: Pixel) -> Option<&Visible> {
        self.visible[self.window.index(pixel)].as_ref()
    }

    /// Number of pixels at which a triangle is visible.
    pub fn covered_pixels(&self) -> usize {
        self.visible.iter().filter(|visible| visible.is_some()).count()
    }
}
