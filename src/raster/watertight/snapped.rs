//! A triangle on the fixed-point grid, its integer edge functions and its f32 depth.
//!
//! Coordinates count half steps of the grid, so that a sample, (i + ½)·2^N steps, is an integer for
//! N = 0 too. **Sizes**: the guard band lets coordinates reach from −2^16 to 2^15 + 2^16 pixels,
//! below 2^17 in magnitude and in difference; in half steps of N ≤ 12 bits below 2^30. An edge
//! function A·(x − x_i) + B·(y − y_i) has |A|, |B| and its distances at most 2^30: below 2^61.
//! No coverage is decided by anything but these integers.

use super::SubpixelBits;
use super::clip::clipped;
use super::projection::Projector;
use crate::mesh::TriangleId;
use crate::pixel::{Pixel, Window};
use crate::raster::bounds::Rectangle;

/// A triangle, or a part of a clipped one, on the grid.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    pub(super) id: TriangleId,
    /// x and y of the corners, in half steps of the grid.
    corners: [[i32; 2]; 3],
    /// `Projector::far` over w at the corners.
    depths: [f32; 3],
    /// Of a clipped triangle: the weights of its own corners at the piece's corners.
    weights: Option<Box<[[f64; 3]; 3]>>,
}

/// A triangle on the grid; the parts of its fan if it is clipped.
pub(super) fn pieces(
    projector: &Projector<'_>,
    id: TriangleId,
    corners: [[f32; 3]; 3],
) -> impl Iterator<Item = Piece> {
    let points = corners.map(|corner| projector.clip_point(corner));
    let polygon = clipped(points, &projector.clip_planes);
    let whole = polygon.is_none().then(|| piece(projector, id, points, None));
    let polygon = polygon.unwrap_or_default();
    let parts = (2..polygon.len()).map(move |k| {
        let fan = [polygon[0], polygon[k - 1], polygon[k]];
        let weights = Some(Box::new(fan.map(|corner| corner.weights)));
        piece(projector, id, fan.map(|corner| corner.position), weights)
    });
    whole.into_iter().chain(parts.collect::<Vec<_>>())
}

fn piece(
    projector: &Projector<'_>,
    id: TriangleId,
    points: [[f64; 3]; 3],
    weights: Option<Box<[[f64; 3]; 3]>>,
) -> Piece {
    let steps = f64::from(1_u32 << projector.subpixel_bits.get());
    Piece {
        id,
        // Round to the nearest step, ties to even, and count half steps.
        corners: points
            .map(|[x, y, w]| [x, y].map(|c| 2 * (c / w * steps).round_ties_even() as i32)),
        depths: points.map(|[_, _, w]| (projector.far / w) as f32),
        weights,
    }
}

/// An edge function a·x + b·y + c, not negative inside.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge {
    pub(super) a: i64,
    pub(super) b: i64,
    c: i64,
    /// Least value of a covered sample: 0 for a left edge (the inside lies to the right) and for a
    /// top edge (horizontal, the inside lies below), 1 for the others.
    pub(super) least: i64,
}

impl Edge {
    fn between([x0, y0]: [i64; 2], [x1, y1]: [i64; 2], sign: i64) -> Self {
        let (a, b) = (sign * (y0 - y1), sign * (x1 - x0));
        let has_ties = a > 0 || (a == 0 && b > 0);
        Self { a, b, c: -(a * x0 + b * y0), least: i64::from(!has_ties) }
    }

    /// Its value at a sample.
    pub(super) fn at(&self, [x, y]: [i64; 2]) -> i64 {
        self.a * x + self.b * y + self.c
    }
}

/// A piece ready to be scanned.
pub(super) struct Scannable<'a> {
    pub(super) piece: &'a Piece,
    /// Edges opposite corners 0, 1, 2.
    pub(super) edges: [Edge; 3],
    /// sgn V, ±1, of the snapped triangle.
    pub(super) volume_sign: i32,
    /// 1 over the sum of the three edge functions.
    inverse_area: f32,
}

impl Piece {
    /// The edge functions; `None` when the snapped triangle has no area.
    pub(super) fn scannable(&self, orientation: i32) -> Option<Scannable<'_>> {
        let [p0, p1, p2] = self.corners.map(|corner| corner.map(i64::from));
        let area = (p1[0] - p0[0]) * (p2[1] - p0[1]) - (p1[1] - p0[1]) * (p2[0] - p0[0]);
        let sign = area.signum();
        (sign != 0).then(|| Scannable {
            piece: self,
            edges: [
                Edge::between(p1, p2, sign),
                Edge::between(p2, p0, sign),
                Edge::between(p0, p1, sign),
            ],
            // For positive w, sgn V = sgn det(P) times the orientation in the image.
            volume_sign: sign as i32 * orientation,
            inverse_area: 1.0 / (area.abs() as f32),
        })
    }

    /// The pixels of a window whose samples its bounding box holds.
    pub(super) fn pixels(&self, bits: SubpixelBits, window: Window) -> Option<Rectangle> {
        let range = |axis: usize, first: u32, end: u32| -> Option<(u32, u32)> {
            let values = self.corners.map(|corner| corner[axis]);
            let low = values.into_iter().fold(i32::MAX, i32::min);
            let high = values.into_iter().fold(i32::MIN, i32::max);
            // Sample i lies at (2i + 1)·half, half a pixel of 2^N half steps.
            let half = 1_i32 << bits.get();
            // The least i with (2i + 1)·half ≥ low is ⌈(low − half)/(2·half)⌉.
            let from = -(half - low).div_euclid(2 * half);
            let to = (high - half).div_euclid(2 * half);
            let (from, to) = (from.max(first as i32), to.min(end as i32 - 1));
            (from <= to).then_some((from as u32, to as u32 + 1))
        };
        let (x0, x1) = range(0, window.x0(), window.x1())?;
        let (y0, y1) = range(1, window.y0(), window.y1())?;
        Some(Rectangle { x0, y0, x1, y1 })
    }
}

/// A sample in half steps of the grid.
pub(super) fn sample(bits: SubpixelBits, pixel: Pixel) -> [i64; 2] {
    [pixel.x, pixel.y].map(|i| (2 * i64::from(i) + 1) << bits.get())
}

impl Scannable<'_> {
    /// Weights of the piece's corners in the image.
    fn shares(&self, values: [i64; 3]) -> [f32; 3] {
        values.map(|value| value as f32 * self.inverse_area)
    }

    /// The interpolated depth for the values of the edge functions: 1/w is linear in the image.
    pub(super) fn depth(&self, values: [i64; 3]) -> f32 {
        let ([s0, s1, s2], [d0, d1, d2]) = (self.shares(values), self.piece.depths);
        s0 * d0 + s1 * d1 + s2 * d2
    }

    /// Weights of the triangle's own corners in space: shares over w, made to add up to 1.
    pub(super) fn weights(&self, values: [i64; 3]) -> [f64; 3] {
        let (shares, depths) = (self.shares(values), self.piece.depths);
        let weights = [0, 1, 2].map(|k| f64::from(shares[k] * depths[k]));
        let sum = weights[0] + weights[1] + weights[2];
        let weights = weights.map(|weight| weight / sum);
        match &self.piece.weights {
            None => weights,
            Some(corners) => [0, 1, 2].map(|k| (0..3).map(|c| weights[c] * corners[c][k]).sum()),
        }
    }
}
