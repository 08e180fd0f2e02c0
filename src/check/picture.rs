//! The difference picture: expected | difference | actual, side by side.
//!
//! Triangles are shown in colours made from their ids. The middle panel shows the expected picture
//! darkened, and each differing pixel in the colour of its blame.

use super::blame::{Blame, Judged};
use super::compare::Answered;
use crate::mesh::TriangleId;
use crate::pixel::Pixel;
use image::{Rgb, RgbImage};
use std::collections::HashMap;

/// Columns of dark grey between two panels.
pub(super) const GAP: u32 = 4;
pub(super) const GAP_COLOR: Rgb<u8> = Rgb([48, 48, 48]);
const NOTHING_COLOR: Rgb<u8> = Rgb([0, 0, 0]);

/// The colour in which a pixel of that blame is marked.
pub const fn blame_color(blame: Blame) -> [u8; 3] {
    match blame {
        Blame::Cast => [255, 64, 64],
        Blame::Raster => [255, 208, 0],
        Blame::Both => [255, 0, 255],
        Blame::Neither => [0, 224, 255],
    }
}

/// Draws the three panels. "Expected" is the exact answer where the arbiter spoke and the common
/// answer elsewhere; "actual" is the answer of the path that carries the blame.
pub fn difference_picture(differences: &[Judged], answers: &[Answered; 2]) -> RgbImage {
    let window = answers[0].buffer.window;
    let judged: HashMap<Pixel, &Judged> =
        differences.iter().map(|judged| (judged.difference.pixel, judged)).collect();
    let (width, height) = (window.width(), window.height());
    let mut picture = RgbImage::from_pixel(3 * width + 2 * GAP, height, GAP_COLOR);
    for (index, pixel) in window.pixels().enumerate() {
        let seen = |path: usize| answers[path].buffer.visible[index].map(|v| v.triangle);
        let (expected, actual, mark) = match judged.get(&pixel) {
            None => (seen(0), seen(0), None),
            Some(judged) => {
                let exact = judged.exact.visible.as_ref().map(|surface| surface.triangle);
                let blamed = usize::from(judged.blame != Blame::Cast);
                (exact, seen(blamed), Some(judged.blame))
            }
        };
        let (x, y) = (pixel.x - window.x0(), pixel.y - window.y0());
        let middle = match mark {
            Some(blame) => Rgb(blame_color(blame)),
            None => Rgb(id_color(expected).0.map(|code| code / 4)),
        };
        picture.put_pixel(x, y, id_color(expected));
        picture.put_pixel(width + GAP + x, y, middle);
        picture.put_pixel(2 * (width + GAP) + x, y, id_color(actual));
    }
    picture
}

/// A colour of middle brightness per id, far from that of its neighbours: the bits of the id times
/// the golden ratio (Knuth's multiplicative hash).
pub(super) fn id_color(id: Option<TriangleId>) -> Rgb<u8> {
    match id {
        None => NOTHING_COLOR,
        Some(id) => {
            let hash = id.get().wrapping_add(1).wrapping_mul(0x9e37_79b9);
            let code = |shift: u32| 64 + ((hash >> shift) & 0x7f) as u8;
            Rgb([code(25), code(18), code(11)])
        }
    }
}
