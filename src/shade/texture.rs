//! The value of a texture at texture coordinates.
//!
//! Texel (i, j), column from the left and row from the bottom, covers [i, i + 1)/width ×
//! [j, j + 1)/height of the uv square, and its value stands at the middle. All arithmetic is f64 in
//! a fixed order with `libm`'s functions. For all uv, however large, the value is finite and between
//! the smallest and the largest texel. Which surface point has which uv is decided elsewhere.

use super::footprint::Footprint;
use crate::color::LinearRgb;
use crate::scene::texture::{Filter, Level, Texture, TextureRef, Wrap};

/// The texture's value at the uv of a surface.
///
/// `footprint` chooses the levels of [`Filter::Mip`]; without one, and for the other filters, the
/// image itself is looked up.
pub fn sample(
    texture: &Texture,
    reference: &TextureRef,
    uv: [f64; 2],
    footprint: Option<Footprint>,
) -> LinearRgb {
    let uv = texture_uv(reference, uv);
    let base = texture.base();
    match (reference.filter, footprint) {
        (Filter::Nearest, _) => nearest(base, reference.wrap, uv),
        (Filter::Bilinear, _) | (Filter::Mip, None) => bilinear(base, reference.wrap, uv),
        (Filter::Mip, Some(footprint)) => {
            let lambda = level_of_detail(base, reference, footprint);
            trilinear(&texture.levels, reference.wrap, uv, lambda)
        }
    }
}

/// The texture's own coordinates, uv·scale + offset; never NaN, never infinite.
pub fn texture_uv(reference: &TextureRef, uv: [f64; 2]) -> [f64; 2] {
    std::array::from_fn(|k| {
        let moved = uv[k] * reference.scale[k] + reference.offset[k];
        if moved.is_nan() { 0.0 } else { moved.clamp(f64::MIN, f64::MAX) }
    })
}

/// λ: the binary logarithm of how many texels of the image a pixel steps over, along the column or
/// along the row, whichever is more. Isotropic, as in OpenGL 4.6, section 8.14.1.
pub fn level_of_detail(base: &Level, reference: &TextureRef, footprint: Footprint) -> f64 {
    let size = [base.width(), base.height()].map(f64::from);
    let texels = |change: [f64; 2]| {
        let [du, dv]: [f64; 2] = std::array::from_fn(|k| change[k] * reference.scale[k] * size[k]);
        libm::hypot(du, dv)
    };
    libm::log2(texels(footprint.per_column).max(texels(footprint.per_row)))
}

/// The value of the texel that holds the point.
fn nearest(level: &Level, wrap: Wrap, uv: [f64; 2]) -> LinearRgb {
    let column = nearest_index(wrap, uv[0], level.width());
    let row = nearest_index(wrap, uv[1], level.height());
    level.texel(column, row)
}

/// Steps per texel to which a point is rounded before its texel is chosen: 2^24. A uv is good to a
/// few 2^-50 of the largest corner's, so that a point that lies on a texel's edge in exact numbers
/// may come out on either side of it, and on different sides by different weights; rounded to the
/// step it lies on the edge again, as long as uv times the texels stays below 2^24.
const STEPS: f64 = (1 << 24) as f64;

/// The index of the texel that holds a point, whose left (lower) edge belongs to it.
fn nearest_index(wrap: Wrap, coordinate: f64, length: u32) -> u32 {
    let position = wrapped(wrap, coordinate) * f64::from(length);
    let index = ((position * STEPS).round() / STEPS).floor() as u32;
    match wrap {
        // A point just below the right rim is rounded to it: there the left one begins.
        Wrap::Repeat => index % length,
        Wrap::Clamp => index.min(length - 1),
    }
}

/// The four nearest texels, weighted by distance along each axis.
fn bilinear(level: &Level, wrap: Wrap, uv: [f64; 2]) -> LinearRgb {
    let ([left, right], across) = neighbours(wrap, uv[0], level.width());
    let ([below, above], upwards) = neighbours(wrap, uv[1], level.height());
    let row = |row| mixed(level.texel(left, row), level.texel(right, row), across);
    mixed(row(below), row(above), upwards)
}

/// The two texels whose middles enclose a coordinate, and the weight of the second.
fn neighbours(wrap: Wrap, coordinate: f64, length: u32) -> ([u32; 2], f64) {
    // Middles are at the halves: −½ … length − ½.
    let position = wrapped(wrap, coordinate) * f64::from(length) - 0.5;
    let before = position.floor();
    let [first, second] = [before, before + 1.0].map(|index| {
        let last = length - 1;
        match wrap {
            Wrap::Repeat if index < 0.0 => last,
            Wrap::Repeat if index > f64::from(last) => 0,
            _ => (index.max(0.0) as u32).min(last),
        }
    });
    ([first, second], position - before)
}

/// Bilinear in the two levels around λ, weighted by it.
fn trilinear(levels: &[Level], wrap: Wrap, uv: [f64; 2], lambda: f64) -> LinearRgb {
    let last = levels.len() - 1;
    // −∞ for a footprint of 0, and +∞ for one beyond the range.
    let lambda = lambda.max(0.0).min(last as f64);
    let finer = lambda.floor() as usize;
    let weight = lambda - finer as f64;
    let fine = bilinear(&levels[finer], wrap, uv);
    match levels.get(finer + 1) {
        Some(coarser) if weight > 0.0 => mixed(fine, bilinear(coarser, wrap, uv), weight),
        _ => fine,
    }
}

/// The coordinate inside the unit interval, both ends included: a coordinate just below a whole
/// number may be rounded to 1, and stands for the right rim.
fn wrapped(wrap: Wrap, coordinate: f64) -> f64 {
    match wrap {
        Wrap::Repeat => coordinate.rem_euclid(1.0),
        Wrap::Clamp => coordinate.clamp(0.0, 1.0),
    }
}

/// From `a` (weight 0) to `b` (weight 1) per channel; rounding does not leave the two.
fn mixed(a: LinearRgb, b: LinearRgb, weight: f64) -> LinearRgb {
    std::array::from_fn(|channel| {
        let (a, b) = (a[channel], b[channel]);
        (a + weight * (b - a)).clamp(a.min(b), a.max(b))
    })
}
