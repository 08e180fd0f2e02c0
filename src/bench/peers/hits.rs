//! Where a peer writes what it hit: id and t of every pixel, kept between rounds.
//!
//! Stores are relaxed atomics, which on every processor of interest are plain moves: any thread may
//! write any pixel, without `unsafe`, without a copy.

use crate::pixel::Window;
use std::sync::atomic::{AtomicU32, Ordering};

/// Ids and ray parameters of the pixels of a window, row by row.
#[derive(Debug)]
pub struct Hits {
    /// Which pixels.
    pub window: Window,
    ids: Vec<AtomicU32>,
    /// Bits of f32.
    t: Vec<AtomicU32>,
}

impl Hits {
    /// The mark of nothing, as an id.
    pub const NOTHING: u32 = u32::MAX;

    /// No answer yet: nothing is visible anywhere.
    pub fn new(window: Window) -> Self {
        let fill = |bits| (0..window.len()).map(|_| AtomicU32::new(bits)).collect();
        Self { window, ids: fill(Self::NOTHING), t: fill(f32::INFINITY.to_bits()) }
    }

    /// Writes the answer at a row-major position of the window.
    #[inline(always)]
    pub fn store(&self, index: usize, id: u32, t: f32) {
        self.ids[index].store(id, Ordering::Relaxed);
        self.t[index].store(t.to_bits(), Ordering::Relaxed);
    }

    /// Forgets every answer.
    pub fn clear(&self) {
        for (id, t) in self.ids.iter().zip(&self.t) {
            id.store(Self::NOTHING, Ordering::Relaxed);
            t.store(f32::INFINITY.to_bits(), Ordering::Relaxed);
        }
    }

    /// The ids, row by row.
    pub fn ids(&self) -> impl ExactSizeIterator<Item = u32> {
        self.ids.iter().map(|id| id.load(Ordering::Relaxed))
    }
}
