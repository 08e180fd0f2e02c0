//! A run of neighbouring pixels as lanes read it: their weights side by side, and the segments that
//! see the same triangle.

use super::face::Face;
use super::products::Products;
use super::vector::{self, Mask};
use super::{LANES, Stretch};
use crate::pixel::Pixel;
use crate::shade::coefficients::{self, Coefficients};
use crate::shade::frame::Frame;
use crate::shade::reach::{Bounds, RUN};
use crate::shade::watch::Nobody;
use fearless_simd::prelude::*;

/// Numbers of a run: as many as it has pixels, and what the last lanes reach beyond.
const WIDTH: usize = RUN + 2 * LANES;

/// Neighbouring pixels that see the same side of a triangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Segment {
    pub(super) start: usize,
    pub(super) end: usize,
    pub(super) face: Face,
}

impl Segment {
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
    /// The pixels of the segments, as bits.
    pub(super) live: u32,
    /// Those of them that the scalar kernel must look at.
    pub(super) doubtful: u32,
    pub(super) products: Products,
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
            live: 0,
            doubtful: 0,
            products: Products::default(),
            reaches: vec![true; frame.lights.len()],
        }
    }

    /// Takes in the pixels that lanes know.
    pub(super) fn gather(&mut self, frame: &Frame<'_>, stretch: &Stretch<'_>) {
        self.segments.clear();
        (self.live, self.doubtful) = (0, 0);
        let mut last = None;
        let mut is_known = false;
        for (i, visible) in stretch.visible.iter().enumerate() {
            let Some(visible) = visible else {
                last = None;
                continue;
            };
            let key = Some((visible.triangle, visible.facing));
            if key != last {
                last = key;
                is_known = match Face::of(frame, visible) {
                    Some(face) => {
                        self.segments.push(Segment { start: i, end: i, face });
                        true
                    }
                    None => false,
                };
            }
            if !is_known {
                continue;
            }
            if let Some(segment) = self.segments.last_mut() {
                segment.end = i + 1;
            }
            self.live |= 1 << i;
            let [w0, w1, w2] = visible.barycentric.0;
            (self.weights[0][i], self.weights[1][i], self.weights[2][i]) = (w0, w1, w2);
            (self.t_low[i], self.t_high[i]) = (visible.t_lo, visible.t_hi);
        }
        self.color(frame, stretch);
    }

    /// Finds the coefficients of the run: those of one material, or of each pixel.
    fn color(&mut self, frame: &Frame<'_>, stretch: &Stretch<'_>) {
        let Some(first) = self.segments.first() else { return };
        let material = first.face.material;
        let is_uniform = self
            .segments
            .iter()
            .all(|segment| segment.face.material == material && !segment.face.is_textured);
        if is_uniform {
            self.products.be_uniform(frame, material);
            return;
        }
        for segment in &self.segments {
            let material = &frame.scene.materials[segment.face.material as usize];
            let plain = Coefficients::of(material, frame.rules);
            for i in segment.start..segment.end {
                let coefficients = match &stretch.visible[i] {
                    Some(visible) if segment.face.is_textured => {
                        let pixel = Pixel { x: stretch.first.x + i as u32, ..stretch.first };
                        coefficients::at_pixel(frame, pixel, visible, material, &mut Nobody)
                    }
                    _ => plain,
                };
                self.products.set(i, &coefficients);
            }
        }
        self.products.be_varying();
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
