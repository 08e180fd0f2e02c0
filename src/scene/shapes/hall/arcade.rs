//! One bay of an arcade: a wall with a round arch, from the axis of one column to the next.

use super::super::angle::turn;
use super::super::grid::Grid;
use super::super::smooth::{append_quad, append_smooth};
use super::{ARCADE_Z, BAY, EAVES, HALF_WALL, SPRINGING};
use crate::scene::part::MeshPart;

/// Radius of the arch.
const RADIUS: f64 = 0.5 * BAY - HALF_WALL;
/// Radius of the roll around the arch, and of the circle that it follows.
const ROLL: f64 = 0.09;
const ROLL_CIRCLE: f64 = RADIUS + 0.13;

/// Triangles of a bay: two faces of the wall and their rolls, the arch, and two ends of piers.
pub(super) const fn triangle_count(detail: u128) -> u128 {
    let steps = 6 * detail;
    2 * (2 * (steps + 2) + 2 * steps * detail) + 2 * steps + 4
}

/// Appends a bay centred on x; `side` is the sign of its z.
pub(super) fn append_bay(part: &mut MeshPart, x: f64, side: f64, detail: u32) {
    let steps = 6 * detail;
    // The arch from −x to +x.
    let arch = |index: u32, radius: f64| {
        let [cosine, sine] = turn(index, 2 * steps);
        [x - radius * cosine, SPRINGING + radius * sine]
    };
    for front in [-1.0, 1.0] {
        let z = side * ARCADE_Z + front * HALF_WALL;
        // Columns run to the right as seen from this face's front.
        let face = Grid::open(1, steps + 2);
        append_smooth(part, &face, |row, column| {
            let index = if front > 0.0 { column } else { steps + 2 - column };
            let [x, y] = match index {
                0 => [x - 0.5 * BAY, SPRINGING],
                _ if index == steps + 2 => [x + 0.5 * BAY, SPRINGING],
                _ => arch(index - 1, RADIUS),
            };
            [x, if row == 0 { EAVES } else { y }, z]
        });
        let roll = Grid::open(detail, steps);
        append_smooth(part, &roll, |row, column| {
            let index = if front > 0.0 { column } else { steps - column };
            let [out, forwards] = turn(row, 2 * detail);
            let [x, y] = arch(index, ROLL_CIRCLE + ROLL * out);
            [x, y, z + front * ROLL * forwards]
        });
    }
    let [back, front] = [-HALF_WALL, HALF_WALL].map(|z| side * ARCADE_Z + z);
    append_smooth(part, &Grid::open(1, steps), |row, column| {
        let [x, y] = arch(column, RADIUS);
        [x, y, if row == 0 { front } else { back }]
    });
    for [left, right] in [[x - 0.5 * BAY, x - RADIUS], [x + RADIUS, x + 0.5 * BAY]] {
        let at = |x: f64, z: f64| [x, SPRINGING, z];
        append_quad(part, [at(left, back), at(right, back), at(right, front), at(left, front)]);
    }
}
