//! The planes of groups, made whole and filled row by row from many threads.
//!
//! Knows no meaning of any plane.

use super::PlaneGroup;
use crate::film::{Plane, Samples};
use crate::pixel::Window;

/// Samples of a group's planes, none yet.
pub(super) const fn no_samples(group: PlaneGroup) -> Samples {
    match group {
        PlaneGroup::Identity
        | PlaneGroup::Cover
        | PlaneGroup::Verdict
        | PlaneGroup::Stable
        | PlaneGroup::Invalid => Samples::Uint(Vec::new()),
        _ => Samples::Float(Vec::new()),
    }
}

/// Makes room for so many samples; what they are is not told.
pub(super) fn resize(samples: &mut Samples, size: usize) {
    match samples {
        Samples::Float(values) => values.resize(size, 0.0),
        Samples::Uint(values) => values.resize(size, 0),
    }
}

/// Most planes of a group.
const MOST: usize = 4;

/// A piece of one row of the planes of a group; nothing of planes that there are not.
#[derive(Default)]
pub(super) struct PlaneRow<'a> {
    floats: [&'a mut [f32]; MOST],
    uints: [&'a mut [u32]; MOST],
}

impl PlaneRow<'_> {
    /// One value per pixel and plane, rounded to f32.
    #[inline]
    pub(super) fn floats<const N: usize>(
        &mut self,
        pixels: impl Iterator<Item = [f64; N]> + Clone,
    ) {
        // Plane by plane: what is not asked of a pixel is not computed, and nothing is in the way of
        // several at once.
        for (position, plane) in self.floats.iter_mut().enumerate().take(N) {
            for (place, values) in plane.iter_mut().zip(pixels.clone()) {
                *place = values[position] as f32;
            }
        }
    }

    /// Likewise for integers, of all planes at once.
    #[inline]
    pub(super) fn uints<const N: usize>(&mut self, pixels: impl Iterator<Item = [u32; N]>) {
        for (column, values) in pixels.enumerate() {
            for (plane, value) in self.uints.iter_mut().zip(values) {
                if let Some(place) = plane.get_mut(column) {
                    *place = value;
                }
            }
        }
    }
}

/// Per row of `piece` every group's planes there; `planes` cover `whole` and stand in the groups' order.
pub(super) fn cut_rows<'a>(
    groups: &[PlaneGroup],
    planes: &'a mut [Plane],
    whole: Window,
    piece: Window,
) -> Vec<Vec<(PlaneGroup, PlaneRow<'a>)>> {
    let empty = || groups.iter().map(|&group| (group, PlaneRow::default())).collect();
    let mut rows: Vec<Vec<(PlaneGroup, PlaneRow<'a>)>> =
        (0..piece.height()).map(|_| empty()).collect();
    let mut planes = planes.iter_mut();
    for (position, group) in groups.iter().enumerate() {
        for (number, plane) in planes.by_ref().take(group.planes().len()).enumerate() {
            match &mut plane.samples {
                Samples::Float(values) => {
                    for (row, values) in rows.iter_mut().zip(cut(values, whole, piece)) {
                        row[position].1.floats[number] = values;
                    }
                }
                Samples::Uint(values) => {
                    for (row, values) in rows.iter_mut().zip(cut(values, whole, piece)) {
                        row[position].1.uints[number] = values;
                    }
                }
            }
        }
    }
    rows
}

/// The rows of a piece in a plane.
pub(super) fn cut<T>(
    plane: &mut [T],
    whole: Window,
    piece: Window,
) -> impl Iterator<Item = &mut [T]> {
    let width = whole.width() as usize;
    let first = (piece.x0() - whole.x0()) as usize;
    let rows = plane.chunks_mut(width).skip((piece.y0() - whole.y0()) as usize);
    rows.map(move |row| &mut row[first..first + piece.width() as usize])
}
