//! What f32 leaves open, sample by sample: the caster's own f64 and exact decisions.
//!
//! Rare: one sample in 10⁴ to 10⁵, except where triangles lie in one plane. Whether two do is asked
//! of exact arithmetic once per pair ([`SamePlane`]); from then on their ids decide.

use super::frame::Frame;
use super::state::{self, NOTHING, Samples};
use crate::accel::LeafTriangle;
use crate::cast::candidate::{self, Candidate};
use crate::cast::coverage;
use crate::cast::filter::{Plane, Relative};
use crate::cast::memo::SamePlane;
use crate::cast::ray::Ray;
use crate::cast::single::ShearedRay;
use crate::mesh::TriangleId;
use crate::pixel::Window;
use crate::visibility::{Level, LevelCounts};

/// Largest width of an interval of t, relative to its lower end, whose middle is good enough.
const T_WIDTH: f64 = super::T_WIDTH as f64;

/// What a thread keeps between its decisions.
pub(in crate::cast) struct Memory<'a> {
    pub(in crate::cast) same_plane: SamePlane<'a>,
    pub(in crate::cast) levels: LevelCounts,
}

/// Samples of a block that a triangle may be the nearest at.
#[derive(Clone, Copy, Debug)]
pub(super) struct Open {
    pub(super) triangle: u32,
    pub(super) block: usize,
    /// Samples to decide, and those that the triangle certainly covers.
    pub(super) lanes: u16,
    pub(super) covered: u16,
}

/// Decides them.
#[cold]
#[inline(never)]
pub(super) fn settle(
    frame: &Frame<'_>,
    window: Window,
    samples: &mut Samples,
    memory: &mut Memory<'_>,
    open: Open,
) {
    let Open { triangle, block, lanes, covered } = open;
    let mut left = lanes & samples.inside[block];
    let mut planes = Planes { eye: frame.view.eye(), known: [None; 2] };
    while left != 0 {
        let lane = left.trailing_zeros() as usize;
        let nearest = samples.ids[block][lane];
        // Two that certainly cover the sample: by the ids where they are known to lie in one plane,
        // everywhere at once; else by bounds of f64. Exact arithmetic and its memory come last.
        if covered >> lane & 1 != 0 && nearest != NOTHING {
            let [own, others] = [triangle, nearest].map(TriangleId::new);
            if memory.same_plane.knows(own, others) {
                left &= !order_by_id(samples, memory, open, left & covered, nearest);
                continue;
            }
            let place = [block, lane];
            if order_in_double(frame, window, samples, place, triangle, &mut planes) {
                left &= left - 1;
                samples.double[block] |= 1 << lane;
                memory.levels.double += 1;
                continue;
            }
            let [a, b] = [own, others].map(|id| frame.mesh.triangle(id));
            if memory.same_plane.learns([own, others], [&a, &b]) {
                continue;
            }
        }
        left &= left - 1;
        match decide(frame, window, samples, memory, [block, lane], triangle) {
            Level::Single => {}
            Level::Double => samples.double[block] |= 1 << lane,
            Level::Exact => samples.exact[block] |= 1 << lane,
        }
    }
}

/// Orders a triangle and the nearest, in whose plane it lies, at those of `lanes` where that is the
/// nearest; these lanes.
fn order_by_id(
    samples: &mut Samples,
    memory: &mut Memory<'_>,
    open: Open,
    lanes: u16,
    nearest: u32,
) -> u16 {
    let Open { triangle, block, .. } = open;
    let alike = lanes & samples.lanes_of(block, nearest);
    if triangle < nearest {
        for (lane, id) in samples.ids[block].iter_mut().enumerate() {
            *id = if alike >> lane & 1 != 0 { triangle } else { *id };
        }
    }
    samples.ties[block] |= alike;
    samples.double[block] |= alike;
    memory.levels.double += u64::from(alike.count_ones());
    alike
}

/// The planes of the two triangles in question, computed once for a block.
struct Planes {
    eye: [f64; 3],
    /// By id: the triangle's own, and that of its last rival.
    known: [Option<(u32, Plane)>; 2],
}

impl Planes {
    #[inline(always)]
    fn of(&mut self, frame: &Frame<'_>, place: usize, id: u32) -> Plane {
        match self.known[place] {
            Some((known, plane)) if known == id => plane,
            _ => {
                let vertices = frame.mesh.triangle(TriangleId::new(id)).map(|v| v.map(f64::from));
                let plane = Relative::new(self.eye, &vertices).plane();
                self.known[place] = Some((id, plane));
                plane
            }
        }
    }
}

/// Orders a triangle that certainly covers a sample and its nearest by the bounds of t that f64 has;
/// whether they are enough.
fn order_in_double(
    frame: &Frame<'_>,
    window: Window,
    samples: &mut Samples,
    [block, lane]: [usize; 2],
    triangle: u32,
    planes: &mut Planes,
) -> bool {
    let nearest = samples.ids[block][lane];
    let ray = frame.view.ray(state::pixel(window, block, lane));
    let own = candidate::plane_interval(&ray, &planes.of(frame, 0, triangle));
    let others = candidate::plane_interval(&ray, &planes.of(frame, 1, nearest));
    let (Some(own), Some(others)) = (own, others) else { return false };
    match candidate::separated(own, others) {
        None => return false,
        Some(false) => {}
        Some(true) => {
            samples.ids[block][lane] = triangle;
            [samples.z_lo[block][lane], samples.z_hi[block][lane]] = z_bounds(frame, own);
            samples.ties[block] &= !(1 << lane);
        }
    }
    true
}

/// Computes t where the bounds of z are too far apart to give it.
#[cold]
#[inline(never)]
pub(super) fn refine_t(
    frame: &Frame<'_>,
    window: Window,
    samples: &mut Samples,
    block: usize,
    lanes: u16,
) {
    let mut planes = Planes { eye: frame.view.eye(), known: [None; 2] };
    for lane in (0..16).filter(|lane| lanes >> lane & 1 != 0) {
        let id = samples.ids[block][lane];
        let ray = frame.view.ray(state::pixel(window, block, lane));
        let crude = candidate::plane_interval(&ray, &planes.of(frame, 0, id));
        let [lo, hi] = match crude.filter(|[lo, hi]| hi - lo <= lo * T_WIDTH) {
            Some(bounds) => bounds,
            None => match covering(frame, &ray, &ShearedRay::new(&ray), id).0 {
                Some(mut found) => found.narrow(&ray).t,
                None => continue,
            },
        };
        samples.t[block][lane] = frame.view.camera_t(lo + (hi - lo) * 0.5) as f32;
    }
}

/// Decides one sample; the highest level that it took.
fn decide(
    frame: &Frame<'_>,
    window: Window,
    samples: &mut Samples,
    memory: &mut Memory<'_>,
    [block, lane]: [usize; 2],
    triangle: u32,
) -> Level {
    let ray = frame.view.ray(state::pixel(window, block, lane));
    let sheared = ShearedRay::new(&ray);
    let bit = 1 << lane;
    let (found, level) = covering(frame, &ray, &sheared, triangle);
    super::super::count(&mut memory.levels, level);
    let Some(mut found) = found else { return level };
    let nearest = samples.ids[block][lane];
    let mut highest = level;
    let best = (nearest != NOTHING).then(|| covering(frame, &ray, &sheared, nearest).0).flatten();
    let tie = samples.ties[block] & bit != 0;
    let (winner, tie) = match best {
        None => {
            let tie = found.covering.on_edge;
            (found, tie)
        }
        Some(mut best) => {
            let (nearer, level) = found.precedes(&mut best, &ray, &mut memory.same_plane);
            super::super::count(&mut memory.levels, level);
            highest = highest.max(level);
            if nearer {
                let tie = found.covering.on_edge || (found.shared && best.shared);
                (found, tie)
            } else {
                (best, tie || (found.shared && best.shared))
            }
        }
    };
    let [lo, hi] = z_bounds(frame, [winner.nearest_t(), winner.reach()]);
    samples.ids[block][lane] = winner.triangle.id.get();
    samples.z_lo[block][lane] = lo;
    samples.z_hi[block][lane] = hi;
    samples.ties[block] = samples.ties[block] & !bit | u16::from(tie) << lane;
    highest
}

/// A triangle as a candidate at a sample, if it covers it. Copies are looked up at the end, so
/// nothing is shared yet.
fn covering(
    frame: &Frame<'_>,
    ray: &Ray,
    sheared: &ShearedRay,
    triangle: u32,
) -> (Option<Candidate>, Level) {
    let id = TriangleId::new(triangle);
    let triangle = LeafTriangle { vertices: frame.mesh.triangle(id), id, copies: 1 };
    let (covering, level) = coverage::decide(ray, sheared, &triangle);
    (covering.map(|covering| Candidate::new(ray, &triangle, covering)), level)
}

/// Bounds of σ/t in f32: each quotient rounds once in f64 and once to f32, and a step of f32 covers
/// both. A t of 0, the crudest lower bound, gives +∞.
fn z_bounds(frame: &Frame<'_>, [t_lo, t_hi]: [f64; 2]) -> [f32; 2] {
    let z = |t: f64| (frame.sigma / t) as f32;
    [z(t_hi).next_down(), z(t_lo).next_up()]
}
