//! What a tile knows so far: per sample the nearest triangle and certain bounds of its z = σ/t.
//!
//! Samples are kept by blocks of 4 × 4, row by row inside a block, blocks row by row: the lanes of
//! a vector are one block. Samples outside the tile's window lie nearer than everything, so that
//! nothing is drawn there.

use super::frame::SIDE;
use crate::accel::WIDTH;
use crate::pixel::{Pixel, Window};
use crate::visibility::LevelCounts;
use fearless_simd::{Simd, SimdBase, f32x16};

/// Side of a block, in pixels.
pub(in crate::cast) const BLOCK: usize = 4;
/// Blocks along a side of a tile.
pub(super) const ACROSS: usize = SIDE / BLOCK;
/// Blocks of a tile.
pub(in crate::cast) const BLOCKS: usize = ACROSS * ACROSS;

/// The id of a sample at which nothing is visible yet.
pub(in crate::cast) const NOTHING: u32 = u32::MAX;

/// The reach is 1/z, rounded up: two roundings of f32, and the key that it is compared with is good
/// to one more and to the inverse matrix' 2^-24.
const REACH_PADDING: f32 = 1.0 + 8.0 * f32::EPSILON;

/// A smaller least z bounds no reach: its reciprocal could overflow.
const LEAST_Z: f32 = 1.0 / (1_u128 << 120) as f32;

/// A tile's samples.
#[repr(align(64))]
pub(in crate::cast) struct Samples {
    /// Certain lower bounds of z; −∞ where nothing is visible yet, +∞ outside the window.
    pub(super) z_lo: [[f32; WIDTH]; BLOCKS],
    /// Certain upper bounds of z.
    pub(super) z_hi: [[f32; WIDTH]; BLOCKS],
    /// Ids of the nearest triangles, or [`NOTHING`].
    pub(in crate::cast) ids: [[u32; WIDTH]; BLOCKS],
    /// When all is drawn: t, see [`super::write_t`].
    pub(in crate::cast) t: [[f32; WIDTH]; BLOCKS],
    /// Per block, the least `z_lo`.
    pub(super) block_z: [f32; BLOCKS],
    /// Per block a bit per sample that lies in the window.
    pub(super) inside: [u16; BLOCKS],
    /// Samples on an edge of their nearest triangle, or at which another lies at the same depth.
    pub(super) ties: [u16; BLOCKS],
    /// Samples at which some decision took f64, and at which one took more.
    pub(super) double: [u16; BLOCKS],
    pub(super) exact: [u16; BLOCKS],
    /// The least `z_lo` of all.
    pub(super) least_z: f32,
    /// Certain upper bound of t' of what is visible: triangles beyond are not.
    pub(super) reach: f32,
    /// Whether anything has been drawn; the arrays hold nothing before.
    pub(super) drawn: bool,
}

impl Samples {
    pub(in crate::cast) const EMPTY: Self = Self {
        z_lo: [[f32::NEG_INFINITY; WIDTH]; BLOCKS],
        z_hi: [[f32::NEG_INFINITY; WIDTH]; BLOCKS],
        ids: [[NOTHING; WIDTH]; BLOCKS],
        t: [[f32::INFINITY; WIDTH]; BLOCKS],
        block_z: [f32::NEG_INFINITY; BLOCKS],
        inside: [u16::MAX; BLOCKS],
        ties: [0; BLOCKS],
        double: [0; BLOCKS],
        exact: [0; BLOCKS],
        least_z: f32::NEG_INFINITY,
        reach: f32::INFINITY,
        drawn: false,
    };

    /// The samples of a block at which this triangle is the nearest.
    pub(super) fn lanes_of(&self, block: usize, id: u32) -> u16 {
        let same = |lane: usize| u16::from(self.ids[block][lane] == id) << lane;
        (0..WIDTH).fold(0, |lanes, lane| lanes | same(lane))
    }

    /// Whether the nearest triangle has the sample on an edge, or shares its depth there.
    #[inline(always)]
    pub(in crate::cast) fn is_tie(&self, block: usize, lane: usize) -> bool {
        self.ties[block] >> lane & 1 != 0
    }

    /// Adds up at how many samples each level was the highest. A sample that is covered and has no
    /// other mark was decided by f32.
    pub(in crate::cast) fn count_levels(&self, levels: &mut LevelCounts) {
        for block in 0..BLOCKS {
            let exact = self.exact[block];
            let double = self.double[block] & !exact;
            let ids = &self.ids[block];
            let covered: u16 = (0..WIDTH).map(|lane| u16::from(ids[lane] != NOTHING) << lane).sum();
            levels.pixels_exact += u64::from(exact.count_ones());
            levels.pixels_double += u64::from(double.count_ones());
            levels.pixels_single += u64::from((covered & !double & !exact).count_ones());
        }
    }

    /// Before the first triangle: nothing is known, and what the arrays hold is of another tile.
    #[inline(always)]
    pub(super) fn begin(&mut self) {
        self.drawn = false;
        self.least_z = f32::NEG_INFINITY;
        self.reach = f32::INFINITY;
    }

    /// Nothing is visible yet in a window of at most a full tile; once per tile.
    #[inline(always)]
    pub(super) fn clear(&mut self, window: Window) {
        if self.drawn {
            return;
        }
        self.drawn = true;
        self.z_lo.as_flattened_mut().fill(f32::NEG_INFINITY);
        self.z_hi.as_flattened_mut().fill(f32::NEG_INFINITY);
        self.ids.as_flattened_mut().fill(NOTHING);
        self.block_z.fill(f32::NEG_INFINITY);
        self.inside.fill(u16::MAX);
        self.ties.fill(0);
        self.double.fill(0);
        self.exact.fill(0);
        if window.len() < SIDE * SIDE {
            self.close(window);
        }
    }

    /// Puts the samples outside the window nearer than everything.
    #[cold]
    fn close(&mut self, window: Window) {
        let (width, height) = (window.width() as usize, window.height() as usize);
        for block in 0..BLOCKS {
            for lane in 0..WIDTH {
                let [x, y] = place(block, lane);
                if x >= width || y >= height {
                    self.inside[block] &= !(1 << lane);
                    self.z_lo[block][lane] = f32::INFINITY;
                    self.z_hi[block][lane] = f32::INFINITY;
                }
            }
            self.block_z[block] = self.z_lo[block].into_iter().fold(f32::INFINITY, f32::min);
        }
    }

    /// Finds the least z and the reach anew.
    #[inline(always)]
    pub(super) fn narrow<S: Simd>(&mut self, simd: S) {
        let mut least = f32x16::from_slice(simd, &self.block_z[..WIDTH]);
        for q in 1..BLOCKS / WIDTH {
            let others = f32x16::from_slice(simd, &self.block_z[q * WIDTH..(q + 1) * WIDTH]);
            least = least.min(others);
        }
        let least = least.reduce_min();
        self.least_z = least;
        self.reach = if least > LEAST_Z { REACH_PADDING / least } else { f32::INFINITY };
    }
}

/// Column and row in the tile of a lane of a block.
#[inline(always)]
pub(super) fn place(block: usize, lane: usize) -> [usize; 2] {
    [block % ACROSS * BLOCK + lane % BLOCK, block / ACROSS * BLOCK + lane / BLOCK]
}

/// Block and lane of a column and row in the tile.
#[inline(always)]
pub(in crate::cast) fn lane_of(x: usize, y: usize) -> (usize, usize) {
    (y / BLOCK * ACROSS + x / BLOCK, y % BLOCK * BLOCK + x % BLOCK)
}

/// The pixel of a lane of a block.
pub(super) fn pixel(window: Window, block: usize, lane: usize) -> Pixel {
    let [x, y] = place(block, lane);
    Pixel { x: window.x0() + x as u32, y: window.y0() + y as u32 }
}
