//! Linear RGB, and its encoding to sRGB codes at the very end.
//!
//! Radiance is linear, unclamped and f64 until it is stored. No tone mapping lives here, and no
//! power function either: codes come from tables of exact steps, so they are the same on every
//! platform. The curve is that of IEC 61966-2-1.

mod srgb_levels;
mod srgb_thresholds;

use srgb_levels::LEVELS;
use srgb_thresholds::THRESHOLDS;

/// Linear radiance per channel (red, green, blue), Rec. 709 primaries.
pub type LinearRgb = [f64; 3];

/// The 8-bit sRGB code of a linear value: the code c whose interval
/// [EOTF((c − ½)/255), EOTF((c + ½)/255)) holds `linear`, exactly, for every f64.
///
/// Values at or below 0 give 0, values at or above 1 (and +∞) give 255; the function is monotone
/// and `srgb_code(srgb_decode(c)) == c`. A NaN is a fault of the caller: it stops a debug build and
/// gives 0 in a release build.
pub fn srgb_code(linear: f64) -> u8 {
    debug_assert!(!linear.is_nan(), "a picture value is not a number");
    // There are 255 thresholds, so their count fits a u8.
    THRESHOLDS.partition_point(|&threshold| threshold <= linear) as u8
}

/// The linear value, in [0, 1], of an 8-bit sRGB code: EOTF(code/255), rounded once.
pub fn srgb_decode(code: u8) -> f64 {
    LEVELS[usize::from(code)]
}

#[cfg(test)]
mod tests;
