//! What is evaluated when a buffer is shaded, by which instructions, and in which numbers.

use super::effects::Effects;
use super::lanes::single::ERROR;
use crate::simd::SimdLevel;

/// Which numbers the lanes of a vector hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum Precision {
    /// f64: the bits of one pixel after the other.
    #[default]
    Double,
    /// f32 where its error is bounded, with the decisions of f64: which side a light is on, whether
    /// a point lies in a cone, and whatever f32 leaves in doubt. The bits are the same at every
    /// instruction set and thread count, and within [`single_error`] of `Double`.
    Single,
}

/// What is evaluated, and how.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ShadeOptions {
    /// The effects that are evaluated; see [`super::shade`].
    pub effects: Effects,
    /// The instruction set that shades several pixels at once; `None` shades pixel by pixel, in f64.
    /// Which one changes time, never a bit.
    pub simd: Option<SimdLevel>,
    /// The numbers that it computes with.
    pub precision: Precision,
}

impl ShadeOptions {
    /// With the best instruction set of this machine, in f64.
    pub fn new(effects: Effects) -> Self {
        Self { effects, simd: Some(SimdLevel::best()), precision: Precision::Double }
    }
}

/// How far a pixel of [`Precision::Single`] may be from that of [`Precision::Double`]: this times
/// Σ_j P_j, where P_j = (kd·Id_j + ks·Is_j)/(a_j + b_j·r_j + c_j·r_j²) is the radiance that light j
/// would give straight on, plus 2^-20 of the pixel itself. `exponent` is ns, `falloff` the largest
/// exponent of the lights' cones.
pub fn single_error(exponent: f64, falloff: f64) -> f64 {
    ERROR * (1.0 + exponent.sqrt() + falloff.sqrt())
}
