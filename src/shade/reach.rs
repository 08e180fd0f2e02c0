//! Which spotlights cannot reach a run of neighbouring pixels, so that they are not asked there.
//!
//! A light is left out only where its contribution is certainly 0: outside its cone at every
//! surface point of the run, by a sphere around them. Nothing is left out for being dim: an
//! attenuated light is never exactly dark.

use super::lights::{Cone, Origin, PreparedLight};
use super::vector;

/// Pixels of a run: long enough that the test per light costs little, short enough that a run's
/// surface points lie close together.
pub(super) const RUN: usize = 32;

/// Angles that are closer than this, in radians, are not told apart: the two arc functions and the
/// quotient are good to 1e-15 and the cone's own rim has a slack of 1e-15 rad up to 120°, and of
/// 3e-8 rad towards 180°, where a chord says little about the angle.
const ANGLE_SLACK: f64 = 1e-6;

/// Relative slack of the sphere's radius: its centre and radius are off by a few 2^-53 of the
/// largest coordinate.
const RADIUS_SLACK: f64 = 1e-12;

/// A box around surface points.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    low: [f64; 3],
    high: [f64; 3],
}

impl Bounds {
    pub(super) const EMPTY: Self = Self { low: [f64::INFINITY; 3], high: [f64::NEG_INFINITY; 3] };

    pub(super) fn add(&mut self, point: [f64; 3]) {
        self.low = std::array::from_fn(|k| self.low[k].min(point[k]));
        self.high = std::array::from_fn(|k| self.high[k].max(point[k]));
    }

    /// Whether a cone with its apex at `position` misses every point. False in doubt, and for
    /// numbers beyond the range.
    fn escape(&self, position: [f64; 3], cone: &Cone) -> bool {
        let Some(cutoff) = cone.cutoff else { return false };
        // Wrap the box into a sphere.
        let centre: [f64; 3] = std::array::from_fn(|k| 0.5 * self.low[k] + 0.5 * self.high[k]);
        let half = std::array::from_fn(|k| 0.5 * self.high[k] - 0.5 * self.low[k]);
        let size = [centre, half, position].map(vector::largest_component);
        let Some(way) = vector::measure(vector::sub(centre, position)) else { return false };
        let radius = vector::measure(half).map_or(0.0, |half| half.length)
            + RADIUS_SLACK * (size[0] + size[1] + size[2]);
        // NaN and infinities are not outside.
        let is_outside = radius < way.length && way.length.is_finite();
        if !is_outside {
            return false;
        }
        // Compare the angle of the nearest direction with the cutoff.
        let from_axis = way.unit().map(|c| -c);
        let cosine = vector::dot(from_axis, cone.axis);
        let sine = vector::squared_length(vector::cross(from_axis, cone.axis)).sqrt();
        let nearest = libm::atan2(sine, cosine) - libm::asin(radius / way.length);
        nearest > cutoff + ANGLE_SLACK
    }
}

/// Marks the lights that reach some of the points.
pub(super) fn mark(lights: &[PreparedLight], bounds: &Bounds, reaches: &mut [bool]) {
    for (light, reaches) in lights.iter().zip(reaches) {
        *reaches = match &light.origin {
            Origin::Position(at) => {
                !at.cone.as_ref().is_some_and(|cone| bounds.escape(at.position, cone))
            }
            Origin::Nowhere | Origin::Direction { .. } | Origin::Hemisphere(_) => true,
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cone(cutoff_deg: f64) -> Cone {
        Cone {
            axis: [0.0, 1.0, 0.0],
            largest_squared_chord: None,
            cutoff: Some(cutoff_deg.to_radians()),
            exponent: None,
        }
    }

    #[test]
    fn only_certainly_dark_points_are_left_out() {
        // A lamp at height 10 that looks down: at 45° it lights a disc of radius 10.
        let escapes = |from: f64, to: f64, cutoff| {
            let mut bounds = Bounds::EMPTY;
            bounds.add([from, 0.0, 0.0]);
            bounds.add([to, 0.0, 0.0]);
            bounds.escape([0.0, 10.0, 0.0], &cone(cutoff))
        };
        assert!(escapes(10.001, 10.001, 45.0) && escapes(12.0, 13.0, 45.0));
        assert!(
            !escapes(10.0, 10.0, 45.0) && !escapes(9.0, 13.0, 45.0) && !escapes(-3.0, 3.0, 1.0)
        );
        assert!(!escapes(12.0, 13.0, 60.0));
        // Behind the lamp, wide cones, the lamp among the points, and nonsense.
        let mut above = Bounds::EMPTY;
        above.add([0.0, 12.0, 0.0]);
        assert!(above.escape([0.0, 10.0, 0.0], &cone(179.0)));
        above.add([0.0, 8.0, 0.0]);
        assert!(!above.escape([0.0, 10.0, 0.0], &cone(1.0)));
        assert!(!Bounds::EMPTY.escape([0.0; 3], &cone(1.0)));
        let mut far = Bounds::EMPTY;
        far.add([f64::MAX, -f64::MAX, 0.0]);
        far.add([-f64::MAX, f64::MAX, f64::MAX]);
        assert!(!far.escape([f64::MAX; 3], &cone(1.0)));
    }
}
