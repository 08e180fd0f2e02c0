//! Linear RGB, and its encoding to sRGB codes at the very end.
//!
//! Radiance is linear, unclamped and f64 until it is stored. No tone mapping lives here.

/// Linear radiance per channel (red, green, blue), Rec. 709 primaries.
pub type LinearRgb = [f64; 3];
