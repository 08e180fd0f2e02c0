//! A tile of samples cast at once: the cone of its rays walks the wide tree, and the triangles that
//! it meets are drawn into the tile with certain bounds.
//!
//! One triangle costs a set-up in f64 and then a few f32 operations per 16 samples; what these leave
//! open, one sample in 10⁴ to 10⁵, goes to the same decisions that single rays take. The kernels
//! are compiled for every instruction set; no answer depends on it, because only certain
//! comparisons count. Cone traversal: A. Reshetov, A. Soupikov, J. Hurley, *Multi-level ray tracing
//! algorithm*, 2005; edge functions over a tile: J. Pineda, 1988. Here no cover is counted and no
//! weight computed.

#[cfg(test)]
mod audit;
mod cone;
mod cull;
mod draw;
mod frame;
mod list;
mod rows;
mod settle;
mod small;
mod state;

pub(super) use frame::{Frame, SIDE};
pub(super) use settle::Memory;
pub(super) use state::{BLOCK, NOTHING, Samples, lane_of};

use super::counts::WalkCounts;
use crate::accel::{Leaf, Link, Linked, WIDTH};
use crate::pixel::Window;
use crate::simd::SimdLevel;
use cone::Cone;
use cull::{Cull, Live};
use fearless_simd::{
    Bytes, Level, Select, Simd, SimdBase, SimdMask, SimdNarrow, SimdWiden, dispatch, f32x16, f64x8,
    u32x16,
};
use frame::Lattice;
use list::Scratch;
use rows::Batch;
use state::BLOCKS;

/// A thread's memory for its tiles.
pub(super) struct Work {
    samples: Samples,
    live: Live,
    batch: Batch,
    scratch: Scratch,
    /// Subtrees that wait: the bits of the lower bound of t' above, the link below.
    waiting: Vec<u64>,
    counts: WalkCounts,
}

impl Work {
    pub(super) fn new() -> Box<Self> {
        Box::new(Self {
            samples: Samples::EMPTY,
            live: Live::EMPTY,
            batch: Batch::EMPTY,
            scratch: Scratch::EMPTY,
            waiting: Vec::new(),
            counts: WalkCounts::default(),
        })
    }
}

/// Finds the nearest triangle at every sample of `window`, at most [`SIDE`] on a side; `None` where
/// no triangle shows at all. Without `CERTAIN` by the same kernel without its bounds: f32 is believed.
pub(super) fn cast_tile<'a, const CERTAIN: bool>(
    frame: &Frame<'_>,
    window: Window,
    level: SimdLevel,
    work: &'a mut Work,
    memory: &mut Memory<'_>,
) -> Option<&'a Samples> {
    work.samples.begin();
    dispatch!(level.dispatched(), simd => {
        walk::<_, CERTAIN, false>(simd, frame, window, work, memory);
    });
    work.samples.drawn.then_some(&work.samples)
}

/// Does what [`cast_tile`] does, and counts it.
pub(super) fn count_tile(
    frame: &Frame<'_>,
    window: Window,
    work: &mut Work,
    memory: &mut Memory<'_>,
) -> Option<WalkCounts> {
    work.samples.begin();
    work.counts = WalkCounts::default();
    match SimdLevel::Baseline.dispatched() {
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        Level::Sse2(simd) => walk::<_, true, true>(simd, frame, window, work, memory),
        #[cfg(target_arch = "aarch64")]
        Level::Neon(simd) => walk::<_, true, true>(simd, frame, window, work, memory),
        _ => return None,
    }
    Some(work.counts)
}

/// Largest width of an interval of z, relative to its lower end, whose middle is good enough: 2^-18.
const T_WIDTH: f32 = 1.0 / (1 << 18) as f32;

/// The t of what is visible, for the camera's own direction, by block and lane: to 2^-18; infinite
/// where nothing is.
#[inline(always)]
fn write_t<S: Simd, const CERTAIN: bool>(
    simd: S,
    frame: &Frame<'_>,
    window: Window,
    samples: &mut Samples,
) {
    let scale = f64x8::splat(simd, 2.0 * frame.t_per_inverse_z);
    for block in 0..BLOCKS {
        let low = f32x16::load_array_ref(simd, &samples.z_lo[block]);
        let high = if CERTAIN { f32x16::load_array_ref(simd, &samples.z_hi[block]) } else { low };
        let narrow = (high - low).simd_le(low * f32x16::splat(simd, T_WIDTH));
        let (low_a, low_b) = low.widen();
        let (high_a, high_b) = high.widen();
        let both = (scale / (low_a + high_a)).narrow(scale / (low_b + high_b));
        let ids = u32x16::load_array_ref(simd, &samples.ids[block]);
        let nothing = ids.simd_eq(u32x16::splat(simd, NOTHING));
        let t = nothing.select(f32x16::splat(simd, f32::INFINITY), both);
        t.store_array(&mut samples.t[block]);
        let wide = !(narrow | nothing).to_bitmask() as u16 & samples.inside[block];
        if CERTAIN && wide != 0 {
            settle::refine_t(frame, window, samples, block, wide);
        }
    }
}

#[inline(always)]
fn walk<S: Simd, const CERTAIN: bool, const COUNTS: bool>(
    simd: S,
    frame: &Frame<'_>,
    window: Window,
    work: &mut Work,
    memory: &mut Memory<'_>,
) {
    let lattice = Lattice::new(frame, window);
    let cone = Cone::new(frame, &lattice);
    let cull = Cull::new(frame, &lattice);
    work.waiting.clear();
    work.waiting.extend(frame.tree.roots.iter().map(|link| u64::from(link.0)));
    while let Some(next) = work.waiting.pop() {
        if f32::from_bits((next >> 32) as u32) > work.samples.reach {
            continue;
        }
        match Link(next as u32).target() {
            Linked::Node(index) => {
                let node = &frame.tree.nodes[index];
                if COUNTS {
                    work.counts.nodes += 1;
                    work.counts.boxes += u64::from(node.count);
                }
                let (met, keys) = cone.meet(simd, node);
                let keys = keys.bitcast::<u32x16<S>>();
                push(simd, frame, met, keys, &node.children, work);
            }
            Linked::Leaf(leaf) => {
                draw_leaf::<S, CERTAIN, COUNTS>(simd, frame, &lattice, &cull, leaf, work, memory);
            }
        }
    }
    if work.samples.drawn {
        write_t::<S, CERTAIN>(simd, frame, window, &mut work.samples);
    }
}

/// Puts children on the stack, the nearest on top.
#[inline(always)]
fn push<S: Simd>(
    simd: S,
    frame: &Frame<'_>,
    met: u32,
    keys: u32x16<S>,
    children: &[u32; WIDTH],
    work: &mut Work,
) {
    let mask = simd.from_bitmask_mask32x16(u64::from(met));
    let keys = simd.compress_u32x16(keys, mask);
    let links = simd.compress_u32x16(u32x16::load_array_ref(simd, children), mask);
    let bottom = work.waiting.len();
    for i in 0..met.count_ones() as usize {
        let (key, link) = (keys.as_slice()[i], links.as_slice()[i]);
        frame.tree.prefetch(Link(link));
        // Non-negative floats order as their bits do.
        let entry = u64::from(key) << 32 | u64::from(link);
        work.waiting.push(entry);
        let mut at = work.waiting.len() - 1;
        while at > bottom && work.waiting[at - 1] < entry {
            work.waiting[at] = work.waiting[at - 1];
            at -= 1;
        }
        work.waiting[at] = entry;
    }
}

/// Draws the triangles of a leaf.
#[inline(always)]
fn draw_leaf<S: Simd, const CERTAIN: bool, const COUNTS: bool>(
    simd: S,
    frame: &Frame<'_>,
    lattice: &Lattice,
    cull: &Cull,
    leaf: Leaf,
    work: &mut Work,
    memory: &mut Memory<'_>,
) {
    let Work { samples, live, batch, scratch, counts, .. } = work;
    live.count = 0;
    cull::survivors(simd, cull, frame.tree, leaf, samples.reach, live);
    if COUNTS {
        counts.leaves += 1;
        counts.leaf_triangles += leaf.count as u64;
        counts.set_up += live.count as u64;
    }
    let mut first = 0;
    while first < live.count {
        rows::set_up::<S, CERTAIN>(simd, frame, lattice, live, first, samples.least_z, batch);
        if batch.live != 0 {
            samples.clear(lattice.window);
            draw::draw::<S, CERTAIN>(simd, frame, lattice.window, batch, scratch, samples, memory);
        }
        first += crate::accel::GROUP;
    }
}
