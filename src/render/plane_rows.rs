//! The planes of groups, made whole and filled row by row from many threads.
//!
//! Knows no meaning of any plane.

use super::PlaneGroup;
use crate::film::{Plane, Samples};

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

/// One row of the planes of a group.
#[derive(Default)]
pub(super) struct PlaneRow<'a> {
    floats: Vec<&'a mut [f32]>,
    uints: Vec<&'a mut [u32]>,
}

impl PlaneRow<'_> {
    /// One value per pixel and plane, rounded to f32.
    #[inline]
    pub(super) fn floats<const N: usize>(&mut self, pixels: impl Iterator<Item = [f64; N]>) {
        let Some(planes) = self.floats.first_chunk_mut::<N>() else { return };
        for (column, values) in pixels.enumerate() {
            for (plane, value) in planes.iter_mut().zip(values) {
                plane[column] = value as f32;
            }
        }
    }

    /// Likewise for integers.
    #[inline]
    pub(super) fn uints<const N: usize>(&mut self, pixels: impl Iterator<Item = [u32; N]>) {
        let Some(planes) = self.uints.first_chunk_mut::<N>() else { return };
        for (column, values) in pixels.enumerate() {
            for (plane, value) in planes.iter_mut().zip(values) {
                plane[column] = value;
            }
        }
    }
}

/// Per row of `width` pixels the row of every group's planes, which stand in the groups' order.
pub(super) fn cut_rows<'a>(
    groups: &[PlaneGroup],
    planes: &'a mut [Plane],
    width: usize,
) -> Vec<Vec<(PlaneGroup, PlaneRow<'a>)>> {
    let size = planes.first().map_or(0, |plane| plane.samples.len());
    let empty = || groups.iter().map(|&group| (group, PlaneRow::default())).collect();
    let mut rows: Vec<Vec<(PlaneGroup, PlaneRow<'a>)>> =
        (0..size.div_ceil(width)).map(|_| empty()).collect();
    let mut planes = planes.iter_mut();
    for (position, group) in groups.iter().enumerate() {
        for plane in planes.by_ref().take(group.planes().len()) {
            match &mut plane.samples {
                Samples::Float(values) => {
                    for (row, values) in rows.iter_mut().zip(values.chunks_mut(width)) {
                        row[position].1.floats.push(values);
                    }
                }
                Samples::Uint(values) => {
                    for (row, values) in rows.iter_mut().zip(values.chunks_mut(width)) {
                        row[position].1.uints.push(values);
                    }
                }
            }
        }
    }
    rows
}
