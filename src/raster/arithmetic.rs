//! With which arithmetic a tile's kernels decide, chosen once per frame.
//!
//! Only names and flags: one kernel body serves all, and the compiler leaves of each what it takes.

use super::watertight::DepthBuffer;

/// What decides, as a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Kernel {
    /// [`Certain`].
    Certain,
    /// [`Double`].
    Double,
    /// [`Single`].
    Single,
    /// [`Stored`]: in this depth buffer, with so much depth along the view axis per unit of t.
    Stored(DepthBuffer, f64),
}

/// What decides, as a type.
pub(super) trait Arithmetic {
    /// Whether f32 decides only what its bounds make certain.
    const CERTIFIED: bool;
    /// Whether somebody is believed in the end: there is no exact stage and no hard triangle.
    const BELIEVED: bool;
    /// Whether f64 decides all that the certain f32 bounds of blocks leave.
    const DOUBLE: bool = false;
    /// Whether depths are compared as a depth buffer stores them.
    const STORED: bool = false;
}

/// f32 with bounds; what it leaves open, f64 with bounds and exact arithmetic decide.
pub(super) struct Certain;

impl Arithmetic for Certain {
    const CERTIFIED: bool = true;
    const BELIEVED: bool = false;
}

/// f32 with bounds discards blocks, f64 without bounds decides samples.
pub(super) struct Double;

impl Arithmetic for Double {
    const CERTIFIED: bool = true;
    const BELIEVED: bool = true;
    const DOUBLE: bool = true;
}

/// f32 without bounds.
pub(super) struct Single;

impl Arithmetic for Single {
    const CERTIFIED: bool = false;
    const BELIEVED: bool = true;
}

/// f32 without bounds, with a depth buffer of few bits.
pub(super) struct Stored;

impl Arithmetic for Stored {
    const CERTIFIED: bool = false;
    const BELIEVED: bool = true;
    const STORED: bool = true;
}
