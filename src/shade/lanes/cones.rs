//! The lights' cones side by side, and which of them certainly miss a box of points.
//!
//! A light is left out only where its contribution is certainly 0: outside its cone at every point,
//! by a sphere around them. Nothing is left out for being dim: an attenuated light is never exactly
//! dark.
//!
//! With a = w·aim and h = |w × aim| for the way w from the apex to a point, sinθ and cosθ of the
//! cutoff, δ = h·cosθ − a·sinθ is |w|·sin(φ − θ), φ the point's angle from the axis: the distance
//! from the line that the cone's side lies on, positive outside, for every cutoff in 0 … 180°. Over a
//! sphere it changes by the radius at most. So δ − radius > ε·(|w| + radius) at the centre makes φ
//! leave the cone by more than ε at every point of it.

use super::vector;
use super::{LANES, vector::Reals};
use crate::shade::lights::{Origin, PreparedLight};
use crate::shade::reach::Bounds;
use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch};

/// ε, in radians: the cone's own rim has a slack of 2.3e-15 rad up to 120°, and of 4e-8 rad towards
/// 180°, where a chord says little about the angle; centre, radius and δ are off by a few 2^-53 of
/// the largest coordinate, which [`SIZE_SLACK`] holds.
const ANGLE_SLACK: f64 = 1e-6;

/// Relative to the coordinates of box and apex: above the 30·2^-53 of their differences and of δ.
const SIZE_SLACK: f64 = 1e-12;

/// Eight cones.
#[derive(Clone, Debug)]
struct Block {
    apex: [[f64; LANES]; 3],
    aim: [[f64; LANES]; 3],
    sine: [f64; LANES],
    cosine: [f64; LANES],
}

impl Block {
    /// With sine and cosine 0, δ is 0: what is no cone reaches everything.
    const EVERYWHERE: Self = Self {
        apex: [[0.0; LANES]; 3],
        aim: [[0.0; LANES]; 3],
        sine: [0.0; LANES],
        cosine: [0.0; LANES],
    };
}

/// The cones of a frame's lights, in their order.
#[derive(Clone, Debug)]
pub(in crate::shade) struct Cones {
    blocks: Vec<Block>,
}

impl Cones {
    pub(in crate::shade) fn of(lights: &[PreparedLight]) -> Self {
        let mut blocks = vec![Block::EVERYWHERE; lights.len().div_ceil(LANES)];
        for (index, light) in lights.iter().enumerate() {
            let (block, lane) = (&mut blocks[index / LANES], index % LANES);
            let Origin::Position(at) = &light.origin else { continue };
            let Some(cone) = &at.cone else { continue };
            let Some([sine, cosine]) = cone.sine_cosine else { continue };
            for k in 0..3 {
                (block.apex[k][lane], block.aim[k][lane]) = (at.position[k], -cone.axis[k]);
            }
            (block.sine[lane], block.cosine[lane]) = (sine, cosine);
        }
        Self { blocks }
    }

    /// Sets in `reaches`, per light, whether it may reach a point of the box.
    pub(in crate::shade) fn mark(&self, level: Level, bounds: &Bounds, reaches: &mut [bool]) {
        dispatch!(level, simd => self.mark_with(simd, bounds, reaches));
    }

    /// [`Self::mark`] from inside a kernel.
    #[inline(always)]
    pub(super) fn mark_with<S: Simd>(&self, simd: S, bounds: &Bounds, reaches: &mut [bool]) {
        // Wrap the box into a sphere.
        let centre: [f64; 3] = std::array::from_fn(|k| 0.5 * bounds.low[k] + 0.5 * bounds.high[k]);
        let half = std::array::from_fn(|k| 0.5 * bounds.high[k] - 0.5 * bounds.low[k]);
        let size = crate::shade::vector::largest_component(centre)
            + crate::shade::vector::largest_component(half);
        let radius = crate::shade::vector::squared_length(half).sqrt();
        let centre = vector::splat(simd, centre);
        for (block, reaches) in self.blocks.iter().zip(reaches.chunks_mut(LANES)) {
            let apex = vector::load3(simd, &block.apex, 0);
            let aim = vector::load3(simd, &block.aim, 0);
            let way = vector::sub(centre, apex);
            let across = vector::squared_length(vector::cross(way, aim)).sqrt();
            let along = vector::dot(way, aim);
            let outside = across * Reals::load_array(simd, block.cosine)
                - along * Reals::load_array(simd, block.sine);
            let distance = vector::squared_length(way).sqrt();
            let slack = (distance + radius) * ANGLE_SLACK
                + (vector::largest_component(apex) + size) * SIZE_SLACK;
            // NaN and infinities are not outside.
            let escapes = outside.simd_gt(slack + radius) & outside.simd_lt(f64::INFINITY);
            let escapes = escapes.to_bitmask();
            for (lane, reaches) in reaches.iter_mut().enumerate() {
                *reaches = escapes >> lane & 1 == 0;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shade::effects::Effects;
    use crate::shade::lights::{Cone, Position};
    use crate::simd::SimdLevel;

    /// A lamp at height 10 that looks down.
    fn lamp(cutoff_deg: f64, height: f64) -> PreparedLight {
        let angle = cutoff_deg.to_radians();
        PreparedLight {
            index: 0,
            ambient: None,
            fades_ambient: false,
            shadows: false,
            diffuse: [1.0; 3],
            specular: [1.0; 3],
            origin: Origin::Position(Position {
                kind: Effects::SPOT,
                position: [0.0, height, 0.0],
                attenuation: None,
                cone: Some(Cone {
                    axis: [0.0, 1.0, 0.0],
                    sine_cosine: Some([libm::sin(angle), libm::cos(angle)]),
                    largest_squared_chord: None,
                    exponent: None,
                }),
            }),
        }
    }

    fn escapes(points: &[[f64; 3]], height: f64, cutoff_deg: f64) -> bool {
        let mut bounds = Bounds::EMPTY;
        points.iter().for_each(|point| bounds.add(*point));
        // Nine lights: in a block's first lane, in others, and in a block of its own.
        let lights = vec![lamp(cutoff_deg, height); 9];
        let answers = SimdLevel::available().into_iter().map(|level| {
            let mut reaches = [true; 9];
            Cones::of(&lights).mark(level.dispatched(), &bounds, &mut reaches);
            reaches
        });
        let answers: Vec<_> = answers.collect();
        let first = answers[0][0];
        assert!(answers.iter().flatten().all(|&reaches| reaches == first));
        !first
    }

    #[test]
    fn only_certainly_dark_points_are_left_out() {
        // At 45° the lamp lights a disc of radius 10.
        let along =
            |from: f64, to: f64, cutoff| escapes(&[[from, 0.0, 0.0], [to, 0.0, 0.0]], 10.0, cutoff);
        assert!(along(10.001, 10.001, 45.0) && along(12.0, 13.0, 45.0));
        assert!(!along(10.0, 10.0, 45.0) && !along(9.0, 13.0, 45.0) && !along(-3.0, 3.0, 1.0));
        assert!(!along(12.0, 13.0, 60.0));
        // Behind the lamp, wide cones, the lamp among the points, and nonsense.
        assert!(escapes(&[[0.0, 12.0, 0.0]], 10.0, 179.0));
        assert!(!escapes(&[[0.0, 12.0, 0.0], [0.0, 8.0, 0.0]], 10.0, 1.0));
        assert!(!escapes(&[], 0.0, 1.0));
        let far = [[f64::MAX, -f64::MAX, 0.0], [-f64::MAX, f64::MAX, f64::MAX]];
        assert!(!escapes(&far, f64::MAX, 1.0));
    }

    #[test]
    fn no_point_inside_a_cone_is_left_out() {
        // Boxes of a tenth around points near the side of a cone; the angle by the arc functions.
        let mut left_out = 0;
        for cutoff in [1e-6, 1.0, 30.0, 89.999, 90.0, 120.0, 179.9] {
            for i in 0..200 {
                let angle = (cutoff * (0.5 + f64::from(i) / 150.0)).min(180.0).to_radians();
                let [x, y] = [20.0 * libm::sin(angle), 10.0 - 20.0 * libm::cos(angle)];
                let corners = [[x - 0.1, y - 0.1, -0.1], [x + 0.1, y + 0.1, 0.1]];
                if escapes(&corners, 10.0, cutoff) {
                    left_out += 1;
                    for [x, y, z] in [[x - 0.1, y - 0.1, 0.1], [x - 0.1, y + 0.1, 0.1], [x, y, 0.0]]
                    {
                        let off = libm::atan2(libm::hypot(x, z), 10.0 - y);
                        assert!(off > f64::to_radians(cutoff), "{cutoff} {i}");
                    }
                }
            }
        }
        assert!(left_out > 200, "{left_out}");
    }
}
