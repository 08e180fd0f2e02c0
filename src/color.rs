//! Linear RGB, and its encoding to sRGB codes at the very end.
//!
//! Radiance is linear, unclamped and f64 until it is stored. No tone mapping lives here. 8-bit codes
//! come from tables of exact steps, so they are the same on every platform; 16-bit codes, which only
//! textures have, go through `libm`'s power function. The curve is that of IEC 61966-2-1.

mod srgb_buckets;
mod srgb_levels;
mod srgb_singles;
mod srgb_thresholds;

use srgb_levels::LEVELS;

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
    srgb_buckets::count_thresholds(linear)
}

/// [`srgb_code`] of an f32, the same code and several times as quick.
#[inline]
pub fn srgb_code_of_single(linear: f32) -> u8 {
    debug_assert!(!linear.is_nan(), "a picture value is not a number");
    srgb_singles::count_thresholds(linear)
}

/// The linear value, in [0, 1], of an 8-bit sRGB code: EOTF(code/255), rounded once.
pub fn srgb_decode(code: u8) -> f64 {
    LEVELS[usize::from(code)]
}

/// The linear value, in [0, 1], of a 16-bit sRGB code: EOTF(code/65535) by `libm::pow`, so the same
/// everywhere, to within a few units of its last place.
pub fn srgb_decode_16(code: u16) -> f64 {
    let encoded = f64::from(code) / 65_535.0;
    match encoded <= 0.04045 {
        true => encoded / 12.92,
        false => libm::pow((encoded + 0.055) / 1.055, 2.4),
    }
}

#[cfg(test)]
mod tests;
