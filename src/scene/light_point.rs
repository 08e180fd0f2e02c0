//! A light as a shadow sees it: a place or a direction, without colour, cone or attenuation.

/// The homogeneous point (l, w) of a light. The numbers count as exactly what they are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightPoint {
    /// w = 1: the light is at this position, world space. Any finite numbers.
    Position([f64; 3]),
    /// w = 0: the light is infinitely far away in this direction, which points towards it. Any
    /// finite numbers, not all 0; a unit vector keeps the shadow's arithmetic fast.
    Direction([f64; 3]),
}
