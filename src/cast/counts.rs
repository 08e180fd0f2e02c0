//! How much the tiles' caster does for a window, in numbers without noise.
//!
//! Counted in a pass of its own over the same kernel, so that the one that is timed counts nothing;
//! always on the lowest instruction set, so that every machine of an architecture counts the same.

use super::memo::{PicturePairs, SamePlane};
use super::tile::{self, Frame, Memory, SIDE, Work};
use crate::accel::Accelerator;
use crate::pixel::Window;
use crate::scene::Scene;
use crate::visibility::LevelCounts;
use rayon::prelude::*;

/// What was done for all rays of a window together.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct WalkCounts {
    /// Inner nodes whose children's boxes were held against the rays of a tile.
    pub nodes: u64,
    /// Those boxes.
    pub boxes: u64,
    /// Leaves that were entered.
    pub leaves: u64,
    /// Lanes of triangles in them, those that fill up a leaf included.
    pub leaf_triangles: u64,
    /// Triangles that were set up to be drawn into a tile.
    pub set_up: u64,
    /// Samples that were drawn, as decisions of f32, and what these handed on.
    pub levels: LevelCounts,
}

impl WalkCounts {
    fn add(&mut self, other: Self) {
        self.nodes += other.nodes;
        self.boxes += other.boxes;
        self.leaves += other.leaves;
        self.leaf_triangles += other.leaf_triangles;
        self.set_up += other.set_up;
        self.levels.add(other.levels);
    }
}

/// Counts what [`super::cast_nearest`] does for a window; `None` on an architecture whose lowest
/// instruction set is not known here.
pub fn count_walk(scene: &Scene, accelerator: &Accelerator, window: Window) -> Option<WalkCounts> {
    let frame = Frame::new(scene, accelerator);
    let tiles = window.tiles(SIDE as u32);
    // Elsewhere tiles tell each other which planes are shared, as they come to it; here none does, so
    // that the order of the work has no say.
    let counts: Vec<Option<WalkCounts>> = tiles
        .into_par_iter()
        .map_init(Work::new, |work, window| {
            let pairs = PicturePairs::default();
            let mut memory =
                Memory { same_plane: SamePlane::new(&pairs), levels: LevelCounts::default() };
            let counts = tile::count_tile(&frame, window, work, &mut memory)?;
            Some(WalkCounts { levels: memory.levels, ..counts })
        })
        .collect();
    let mut total = WalkCounts::default();
    for counts in counts {
        total.add(counts?);
    }
    Some(total)
}
