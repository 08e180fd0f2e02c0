//! Which pixels of a window a triangle can cover: a rectangle that is certain to hold them all.
//!
//! The projection's bounding box is used only where all three w are certainly positive; a triangle
//! that touches or crosses the eye's plane gets the whole window, and its edges sort it out.

use super::image_plane::ImagePlane;
use super::rows::{Homogeneous, POINT_ERROR, Projection, U};
use crate::mutant::{self, Mutant};
use crate::pixel::{Pixel, Window};

/// A non-empty rectangle of pixels, half open.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Rectangle {
    pub(super) x0: u32,
    pub(super) y0: u32,
    pub(super) x1: u32,
    pub(super) y1: u32,
}

impl Rectangle {
    /// A whole window.
    pub(super) fn of(window: Window) -> Self {
        Self { x0: window.x0(), y0: window.y0(), x1: window.x1(), y1: window.y1() }
    }

    /// What both rectangles hold, or `None`.
    pub(super) fn intersection(self, other: Self) -> Option<Self> {
        let (x0, y0) = (self.x0.max(other.x0), self.y0.max(other.y0));
        let (x1, y1) = (self.x1.min(other.x1), self.y1.min(other.y1));
        (x0 < x1 && y0 < y1).then_some(Self { x0, y0, x1, y1 })
    }

    /// Number of pixels.
    pub(super) fn len(self) -> u64 {
        u64::from(self.x1 - self.x0) * u64::from(self.y1 - self.y0)
    }

    /// The corner samples: least and greatest x and y.
    pub(super) fn samples(self) -> [[f64; 2]; 2] {
        [
            Pixel { x: self.x0, y: self.y0 }.sample(),
            Pixel { x: self.x1 - 1, y: self.y1 - 1 }.sample(),
        ]
    }
}

/// Which points of the image are asked about: around every pixel of a window its closed box of
/// half width `reach`; with reach 0 the samples alone.
#[derive(Clone, Copy, Debug)]
pub(super) struct Region {
    pub(super) window: Window,
    reach: f64,
}

/// Steps of a pixel in which a reach is kept: ½ + reach then has no rounding for a reach below
/// 2^32 pixels.
const REACH_STEPS: f64 = (1 << 20) as f64;

impl Region {
    /// The samples of a window.
    pub(super) fn samples(window: Window) -> Self {
        Self { window, reach: 0.0 }
    }

    /// The boxes around the samples of a window, or slightly larger ones; `half_width` is 0…2^17
    /// pixels.
    pub(super) fn boxes(window: Window, half_width: f64) -> Self {
        Self { window, reach: (half_width * REACH_STEPS).ceil() / REACH_STEPS }
    }
}

/// The pixels of the region in whose part of it the triangle can cover anything, or `None` when it
/// certainly covers nothing.
///
/// A triangle with all w_i ≤ 0 covers nothing: where it covers, Σ (W_i/V)·a_i = d with positive
/// weights W_i/V (at the sample moved by the tie rule); w is linear and w(d) = 1, so some w_i > 0.
/// A triangle with all w_i > 0 covers only samples inside the closed hull of its vertices' images:
/// moved samples lie strictly inside for all small ε, and the hull is closed.
pub(super) fn pixels_of(
    plane: &ImagePlane,
    projection: &Projection,
    region: Region,
) -> Option<Rectangle> {
    let points = &projection.points;
    // X_z = det(P)·w: turn it by sgn det(P), and bound it.
    let bounds = points.map(|p| w_bounds(plane, &p));
    if bounds.iter().all(|[_, high]| *high <= 0.0) {
        return None;
    }
    let whole = Rectangle::of(region.window);
    if !bounds.iter().all(|[low, _]| *low > 0.0) {
        return (!mutant::is(Mutant::EyePlaneRejected)).then_some(whole);
    }
    let range = |axis: usize, first: u32, end: u32| -> Option<(u32, u32)> {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for (point, w) in points.iter().zip(&bounds) {
            let [l, h] = image_bounds(plane, point, axis, *w);
            low = low.min(l);
            high = high.max(h);
        }
        // Pixel i has its box from i + ½ − reach to i + ½ + reach. Rounding to nearest is monotone
        // and keeps integers, so `ceil` cannot come out too high nor `floor` too low.
        let from = (low - (0.5 + region.reach)).ceil().max(f64::from(first));
        let mut to = (high - (0.5 - region.reach)).floor().min(f64::from(end) - 1.0);
        if mutant::is(Mutant::ShortBounds) {
            to -= 1.0;
        }
        (from <= to).then_some((from as u32, to as u32 + 1))
    };
    let (x0, x1) = range(0, whole.x0, whole.x1)?;
    let (y0, y1) = range(1, whole.y0, whole.y1)?;
    Some(Rectangle { x0, y0, x1, y1 })
}

/// Certain bounds of |det(P)|·w.
fn w_bounds(plane: &ImagePlane, point: &Homogeneous) -> [f64; 2] {
    let (w, error) = (point.value[2] * plane.orientation, POINT_ERROR * point.magnitude[2]);
    // The subtraction's rounding cannot change a sign, and `image_bounds` has room for it.
    [w - error, w + error]
}

/// Certain bounds of X/w, the image coordinate, for a certainly positive w.
fn image_bounds(plane: &ImagePlane, point: &Homogeneous, axis: usize, w: [f64; 2]) -> [f64; 2] {
    let value = point.value[axis] * plane.orientation;
    let error = POINT_ERROR * point.magnitude[axis];
    let (low, high) = (value - error, value + error);
    // A numerator's sign tells which end of w makes the quotient extreme.
    let low = low / if low >= 0.0 { w[1] } else { w[0] };
    let high = high / if high >= 0.0 { w[0] } else { w[1] };
    // Numerator, denominator and quotient round once each: 3u, and 4u are given.
    [low - low.abs() * (4.0 * U), high + high.abs() * (4.0 * U)]
}
