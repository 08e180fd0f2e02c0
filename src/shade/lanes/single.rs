//! Sixteen pixels at once in f32: the equation as `light` has it, where an error of f32 is allowed.
//!
//! For pictures whose files hold f32 anyway. Decisions stay those of f64: a lane in which f32 cannot
//! tell the sign of N·L or the side of a cone's rim, or in which one of the conditions below fails,
//! is left to the lanes of f64. So is everything that these leave to the scalar kernel.
//!
//! Positions are relative to the eye, so that no coordinate's size matters: a point is t·d, and a
//! light is at its own position minus the eye's, both differences of f64.
//!
//! Error, in u = 2^-24, as lengths of difference vectors. N: 5u for the mean over |mean| ≥ ½, 4.5u
//! for the unit vector: 15u. Way to a light: u·(|l| + 3.3|p| + |way|), by [`NEAREST`] at most 15u of
//! its length r; r: 2.5u, 1/r: 5.5u; L, where it is made: 22u. V: 6u. N·L: 40u. Way + r·V: 28u of r, over
//! r·|L + V| ≥ r/2: with N 75u of angle. The lobe cos^n changes with the angle by 1.5√n at most for
//! n ≥ 1; the falloff by 22u of angle at most. Attenuation: 45u relative. A power is good to 12u.
//!
//! Up to [`SOFTEST`] a lobe is a power of the cosine as it is, and rounding of the cosine itself
//! counts n times. (N·H)² is off by 14u and, where N·H = c, by 6u/c: |N|² 9u, N·(L + V) 3u/c, its
//! square, |L + V|² 3u, the quotient; half of n times this times c^n is at most 10n·u. (L·S)² is off
//! by 7u and 6u/c, S being off by u: 6.5e·u. Above, cosines are 1 − c²/2 for the chord c, and neither
//! counts; a unit H is off by 4.5u more.
//!
//! With P_j = (kd·Id + ks·Is)/(a + b·r + c·r²), the light's radiance where everything else is 1, a
//! light is off by (119 + 33√e + 6.5e + 114√ns + 10ns)·u·P_j, without the terms in e and ns beyond
//! [`SOFTEST`] = 200, where 6.5e ≤ 92√e and 10ns ≤ 142√ns. Phong's R = 2(N·L)N − L is off by 126u,
//! which makes 201√ns of 114√ns and 10ns. Sums are off by a few u of the radiance itself: all at
//! most [`ERROR`]·(1 + √e + √ns)·P_j.

mod chunk;
mod frame;
mod light;
mod normals;
mod power;
mod products;
mod vector;

pub(super) use chunk::shade;
pub(super) use frame::SingleFrame;
pub(super) use products::SingleProducts;

/// Pixels at once.
const LANES: usize = 16;

/// Error of radiance per 1 + √e + √ns and P_j, see above; 2^-16, 256u.
pub(in crate::shade) const ERROR: f64 = 1.0 / 65_536.0;

/// A light is near where |l|² + |p|² > 16·|way|²: there |l| + 3.3|p| ≤ 3.45·4·|way|.
const NEAREST: f32 = 16.0;

/// Below this |N·L| its sign is asked of f64: above the 40u of its error; 2^-18.
const SMALLEST_COSINE: f32 = 1.0 / 262_144.0;

/// Closer to the rim than this, the side is asked of f64, by the chord, which is off by 22u, or by
/// the cosine, which is off by 33u; 2^-18.
const RIM: f64 = 1.0 / 262_144.0;

/// Up to this chord, 8° of cutoff, a rim is told by the chord: a cosine would leave too many pixels
/// in doubt.
const WIDEST_CHORD: f64 = 0.14;

/// Up to this exponent a lobe is a power of the cosine; see the head.
const SOFTEST: f32 = 200.0;

/// Smallest |L + V|² and |mean of the corner normals|² in f32.
const SMALLEST_MEAN: f32 = 0.25;

/// Largest half width of t's certain interval, relative to t: 2^-26, a quarter of u.
const T_WIDTH: f64 = 1.0 / 67_108_864.0;

/// Numbers of the scene that f32 takes: 0, or 2^-30 … 2^30. Products of the equation are then
/// 2^-133 at least, with an error below [`ERROR`]; what overflows is left to f64.
const NUMBERS: std::ops::RangeInclusive<f64> = 1.0 / 1_073_741_824.0..=1_073_741_824.0;

/// Squared distances from the eye and between light and point that f32 takes: 2^-40 … 2^40.
const SQUARED_DISTANCES: [f32; 2] = [1.0 / 1_099_511_627_776.0, 1_099_511_627_776.0];

/// Exponents that f32 takes: 0, or 1 … 2^24. Below 1 a lobe is steep where it ends.
const EXPONENTS: std::ops::RangeInclusive<f64> = 1.0..=16_777_216.0;
