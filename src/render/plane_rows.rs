//! The planes of groups, made whole and filled row by row from many threads.
//!
//! Knows no meaning of any plane.

use super::PlaneGroup;
use crate::film::Samples;

/// The planes of a group, all 0; none of a group that fills its planes elsewhere.
pub(super) fn empty_planes(group: PlaneGroup, size: usize) -> Vec<Samples> {
    let count = group.planes().len();
    match group {
        PlaneGroup::Stable | PlaneGroup::Invalid => Vec::new(),
        PlaneGroup::Identity | PlaneGroup::Cover | PlaneGroup::Verdict => {
            (0..count).map(|_| Samples::Uint(vec![0; size])).collect()
        }
        _ => (0..count).map(|_| Samples::Float(vec![0.0; size])).collect(),
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

/// Per row of `width` pixels the row of every group's planes.
pub(super) fn cut_rows<'a>(
    groups: &[PlaneGroup],
    samples: &'a mut [Vec<Samples>],
    width: usize,
) -> Vec<Vec<(PlaneGroup, PlaneRow<'a>)>> {
    let size = samples.iter().flatten().map(Samples::len).max().unwrap_or(0);
    let empty = || groups.iter().map(|&group| (group, PlaneRow::default())).collect();
    let mut rows: Vec<Vec<(PlaneGroup, PlaneRow<'a>)>> =
        (0..size.div_ceil(width)).map(|_| empty()).collect();
    for (position, planes) in samples.iter_mut().enumerate() {
        for plane in planes {
            match plane {
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
