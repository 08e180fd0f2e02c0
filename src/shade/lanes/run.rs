//! A run of neighbouring pixels as lanes read it: their weights side by side, and the segments that
//! see the same triangle.

use super::face::Face;
use super::products::Products;
use super::single::SingleProducts;
use super::vector::{self, Mask};
use super::{LANES, Stretch};
use crate::mesh::TriangleId;
use crate::pixel::Pixel;
use crate::shade::coefficients::{self, Coefficients};
use crate::shade::frame::Frame;
use crate::shade::reach::{Bounds, RUN};
use crate::shade::watch::Nobody;
use crate::visibility::{Facing, Visible};
use fearless_simd::prelude::*;

/// Numbers of a run: as many as it has pixels, and what the last lanes reach beyond.
const WIDTH: usize = RUN + 2 * LANES;

/// Neighbouring pixels that see the same side of a triangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Segment {
    pub(super) start: usize,
    pub(super) end: usize,
    pub(super) triangle: TriangleId,
    /// Position in the run's faces.
    pub(super) face: usize,
}

impl Segment {
    /// Its pixels, as bits.
    pub(super) fn pixels(&self) -> u32 {
        (((1_u64 << (self.end - self.start)) - 1) << self.start) as u32
    }

    /// Which of eight lanes from `start` on belong to it, as bits.
    pub(super) fn lanes_from(&self, start: usize) -> u32 {
        let count = (self.end - start).min(LANES);
        (1 << count) - 1
    }
}

/// The pixels of a run. One is kept per row and gathered anew for each of its runs.
pub(in crate::shade) struct Run {
    pub(super) weights: [[f64; WIDTH]; 3],
    pub(super) t_low: [f64; WIDTH],
    pub(super) t_high: [f64; WIDTH],
    pub(super) position: [[f64; WIDTH]; 3],
    pub(super) normal: [[f64; WIDTH]; 3],
    /// Normals of `single`.
    pub(super) mean_normal: [[f32; WIDTH]; 3],
    pub(super) segments: Vec<Segment>,
    pub(super) faces: [Face; RUN + 1],
    /// Which of the faces was set last, and whose it is.
    last: usize,
    last_seen: Option<(TriangleId, Facing)>,
    /// The pixels of the segments, as bits.
    pub(super) live: u32,
    /// The pixels at which nothing is visible, as bits.
    pub(super) empty: u32,
    /// Those of them that the scalar kernel must look at.
    pub(super) doubtful: u32,
    pub(super) products: Products,
    pub(super) single_products: SingleProducts,
    /// Per light of the frame, whether it may reach the run; all true where nobody asks.
    pub(super) reaches: Vec<bool>,
}

impl Run {
    pub(in crate::shade) fn new(frame: &Frame<'_>) -> Self {
        Self {
            weights: [[0.0; WIDTH]; 3],
            t_low: [0.0; WIDTH],
            t_high: [0.0; WIDTH],
            position: [[0.0; WIDTH]; 3],
            normal: [[0.0; WIDTH]; 3],
            mean_normal: [[0.0; WIDTH]; 3],
            segments: Vec::with_capacity(RUN),
            faces: [Face::default(); RUN + 1],
            last: 0,
            last_seen: None,
            live: 0,
            empty: 0,
            doubtful: 0,
            products: Products::default(),
            single_products: SingleProducts::default(),
            reaches: vec![true; frame.lights.len()],
        }
    }

    /// Takes in the pixels that lanes know.
    pub(super) fn gather(&mut self, frame: &Frame<'_>, stretch: &Stretch<'_>) {
        self.segments.clear();
        (self.live, self.empty, self.doubtful) = (0, 0, 0);
        // A run often begins with the face that the one before it ended with.
        if self.last != 0 {
            self.faces[0] = self.faces[self.last];
            self.last = 0;
        }
        let visible = stretch.visible;
        let mut end = 0;
        while let Some(first) = visible.get(end) {
            let start = end;
            let Some(first) = first else {
                self.empty |= 1 << start;
                end += 1;
                continue;
            };
            let key = (first.triangle, first.facing);
            let is_same = |seen: &&Option<Visible>| {
                seen.as_ref().is_some_and(|seen| (seen.triangle, seen.facing) == key)
            };
            end += visible[start..].iter().take_while(is_same).count();
            if self.last_seen != Some(key) {
                // At most one per pixel and the one of the run before.
                let next = self.last + 1;
                if !self.faces[next].become_seen(frame, first) {
                    continue;
                }
                (self.last, self.last_seen) = (next, Some(key));
            }
            let segment = Segment { start, end, triangle: first.triangle, face: self.last };
            self.segments.push(segment);
            self.live |= segment.pixels();
            let [w0, w1, w2] = &mut self.weights;
            let weights =
                w0[start..end].iter_mut().zip(&mut w1[start..end]).zip(&mut w2[start..end]);
            let bounds = self.t_low[start..end].iter_mut().zip(&mut self.t_high[start..end]);
            let seen = &visible[start..end];
            for ((((w0, w1), w2), (low, high)), seen) in weights.zip(bounds).zip(seen) {
                let Some(seen) = seen else { continue };
                [*w0, *w1, *w2] = seen.barycentric.0;
                (*low, *high) = (seen.t_lo, seen.t_hi);
            }
        }
    }

    /// Finds the coefficients of the live pixels: those of one material, or of each pixel.
    pub(super) fn color(&mut self, frame: &Frame<'_>, stretch: &Stretch<'_>) {
        let live = self.live;
        let is_live = |segment: &&Segment| segment.pixels() & live != 0;
        let mut segments = self.segments.iter().filter(is_live);
        let Some(first) = segments.next() else { return };
        let Face { material, is_textured, .. } = self.faces[first.face];
        let is_uniform =
            !is_textured && segments.all(|segment| self.faces[segment.face].material == material);
        if is_uniform {
            self.products.be_uniform(frame, material);
            return;
        }
        self.color_pixels(frame, stretch, live);
        self.products.be_varying();
    }

    /// Finds the coefficients of each of the pixels in `wanted`.
    pub(super) fn color_pixels(&mut self, frame: &Frame<'_>, stretch: &Stretch<'_>, wanted: u32) {
        for segment in self.segments.iter().filter(|segment| segment.pixels() & wanted != 0) {
            let face = &self.faces[segment.face];
            let material = &frame.scene.materials[face.material as usize];
            let plain = Coefficients::of(material, frame.rules);
            for i in (segment.start..segment.end).filter(|i| wanted >> i & 1 != 0) {
                let coefficients = match &stretch.visible[i] {
                    Some(visible) if face.is_textured => {
                        let pixel = Pixel { x: stretch.first.x + i as u32, ..stretch.first };
                        coefficients::at_pixel(frame, pixel, visible, material, &mut Nobody)
                    }
                    _ => plain,
                };
                self.products.set(i, &coefficients);
            }
        }
    }

    /// The pixels of `left` that wear the same material as the first of them, as bits, and one of
    /// their faces.
    pub(super) fn wearing_one(&self, left: u32) -> Option<(u32, &Face)> {
        let mut segments = self.segments.iter().filter(|segment| segment.pixels() & left != 0);
        let first = segments.next()?;
        let face = &self.faces[first.face];
        let mut pixels = first.pixels();
        for segment in segments {
            if self.faces[segment.face].material == face.material {
                pixels |= segment.pixels();
            }
        }
        Some((pixels & left, face))
    }

    /// A box around the positions of the live pixels.
    #[inline(always)]
    pub(super) fn bounds<S: Simd>(&self, simd: S) -> Bounds {
        let mut low = vector::splat(simd, [f64::INFINITY; 3]);
        let mut high = vector::splat(simd, [f64::NEG_INFINITY; 3]);
        for start in (0..RUN).step_by(LANES) {
            let live = self.live >> start & 0xff;
            if live == 0 {
                continue;
            }
            let live = Mask::from_bitmask(simd, u64::from(live));
            for k in 0..3 {
                let position = vector::load(simd, &self.position[k], start);
                low[k] = low[k].min(live.select(position, low[k]));
                high[k] = high[k].max(live.select(position, high[k]));
            }
        }
        Bounds {
            low: low.map(|low| low.to_array().into_iter().fold(f64::INFINITY, f64::min)),
            high: high.map(|high| high.to_array().into_iter().fold(f64::NEG_INFINITY, f64::max)),
        }
    }
}
