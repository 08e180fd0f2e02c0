//! Where a pixel is sampled: one sample at its centre, or a regular grid of them.
//!
//! Only positions. They lie on multiples of 1/256 pixel, on which the camera's directions are
//! exact, so that every sub-sample is as exact as a centre.

/// Steps of the camera's lattice per pixel.
const STEPS_PER_PIXEL: i64 = 256;

/// A regular grid of N × N samples in a pixel, N = 1…16.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct SampleGrid(u32);

impl SampleGrid {
    /// Largest N.
    pub const MOST: u32 = 16;

    /// One sample, at the centre.
    pub const CENTRE: Self = Self(1);

    /// The grid of `side` × `side`; `None` unless `side` is 1…16.
    pub const fn new(side: u32) -> Option<Self> {
        if side >= 1 && side <= Self::MOST { Some(Self(side)) } else { None }
    }

    /// N.
    pub const fn side(self) -> u32 {
        self.0
    }

    /// N².
    pub const fn count(self) -> u32 {
        self.0 * self.0
    }

    /// Where the samples lie, from the pixel's centre, in 1/256 pixel, row by row.
    pub fn offsets(self) -> impl Iterator<Item = [i32; 2]> {
        let side = self.0;
        (0..side).flat_map(move |n| (0..side).map(move |m| [offset(side, m), offset(side, n)]))
    }
}

impl Default for SampleGrid {
    fn default() -> Self {
        Self::CENTRE
    }
}

/// (2k + 1 − N)/(2N) pixel in 1/256 pixel, rounded to nearest, ties away from 0: symmetric about
/// the centre, which is the middle one for odd N. A rounding moves a sample by 1/512 pixel at most,
/// and none where N is a power of two.
fn offset(side: u32, k: u32) -> i32 {
    let side = i64::from(side);
    let numerator = (2 * i64::from(k) + 1 - side) * STEPS_PER_PIXEL;
    let magnitude = (numerator.abs() + side) / (2 * side);
    (numerator.signum() * magnitude) as i32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grids_are_symmetric_ascending_and_inside_the_pixel() {
        for side in 1..=16 {
            let row: Vec<i32> = (0..side).map(|k| offset(side, k)).collect();
            let mirrored: Vec<i32> = row.iter().rev().map(|step| -step).collect();
            assert_eq!(row, mirrored, "{side}");
            assert!(row.is_sorted() && row.windows(2).all(|pair| pair[0] < pair[1]), "{side}");
            assert!(row.iter().all(|step| step.abs() < 128), "{side}");
            assert_eq!(side % 2 == 1, row.contains(&0), "{side}");
            for (k, step) in row.iter().enumerate() {
                let exact = 128.0 * (2.0 * k as f64 + 1.0 - f64::from(side)) / f64::from(side);
                assert_eq!(f64::from(*step), exact.round(), "{side}, {k}");
            }
            assert_eq!(SampleGrid::new(side).unwrap().offsets().count(), (side * side) as usize);
        }
        assert_eq!((0..3).map(|k| offset(3, k)).collect::<Vec<_>>(), [-85, 0, 85]);
        assert_eq!((0..2).map(|k| offset(2, k)).collect::<Vec<_>>(), [-64, 64]);
        assert!(SampleGrid::new(0).is_none() && SampleGrid::new(17).is_none());
    }

    #[test]
    fn rows_come_one_after_the_other() {
        let offsets: Vec<_> = SampleGrid::new(2).unwrap().offsets().collect();
        assert_eq!(offsets, [[-64, -64], [64, -64], [-64, 64], [64, 64]]);
    }
}
