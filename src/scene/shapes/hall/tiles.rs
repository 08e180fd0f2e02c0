//! A rectangle of raised or sunk tiles with bevelled joints: floor, walls and coffered ceilings.

use super::super::smooth::append_quad;
use super::super::vector::{cross, made_unit};
use crate::scene::part::MeshPart;

/// A rectangle cut into equal tiles.
pub(super) struct Tiles {
    /// The corner at the bottom left, seen from the front.
    pub(super) origin: [f64; 3],
    /// The whole edge to the right.
    pub(super) right: [f64; 3],
    /// The whole edge upwards, square on `right`.
    pub(super) up: [f64; 3],
    /// Tiles to the right and upwards.
    pub(super) counts: [u32; 2],
    /// Width of the bevel along each edge of a tile, as a share of the tile's edge.
    pub(super) joint: f64,
    /// Height of a tile's face before the rectangle; negative behind it.
    pub(super) relief: f64,
}

impl Tiles {
    pub(super) fn triangle_count(&self) -> u128 {
        10 * u128::from(self.counts[0]) * u128::from(self.counts[1])
    }

    pub(super) fn append(&self, part: &mut MeshPart) {
        let front = made_unit(cross(self.right, self.up));
        // Corners at the same place have the same bits: they are formed from the same integers.
        let at = |[across, inset_across]: [f64; 2], [along, inset_along]: [f64; 2], raise: f64| {
            let s = (across + inset_across * self.joint) / f64::from(self.counts[0]);
            let t = (along + inset_along * self.joint) / f64::from(self.counts[1]);
            [0, 1, 2].map(|k: usize| {
                self.origin[k] + (s * self.right[k] + t * self.up[k]) + raise * front[k]
            })
        };
        for row in (0..self.counts[1]).map(f64::from) {
            for column in (0..self.counts[0]).map(f64::from) {
                // Counter-clockwise from the bottom left.
                let places = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
                let outer = places.map(|[s, t]| at([column + s, 0.0], [row + t, 0.0], 0.0));
                let inner = places.map(|[s, t]| {
                    at([column + s, 1.0 - 2.0 * s], [row + t, 1.0 - 2.0 * t], self.relief)
                });
                append_quad(part, inner);
                for edge in 0..4 {
                    let next = (edge + 1) % 4;
                    append_quad(part, [outer[edge], outer[next], inner[next], inner[edge]]);
                }
            }
        }
    }
}
