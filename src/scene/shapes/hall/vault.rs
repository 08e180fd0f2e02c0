//! The barrel vault over the nave and its ribs, one above each pair of columns.

use super::super::angle::turn;
use super::super::grid::Grid;
use super::super::smooth::append_smooth;
use super::{ARCADE_Z, BAY, EAVES, HALF_WALL};
use crate::scene::part::MeshPart;

/// Radius of the vault: its feet stand on the arcades' inner faces.
const RADIUS: f64 = ARCADE_Z - HALF_WALL;
/// Radius of a rib.
const RIB: f64 = 0.16;

/// Triangles of the vault and of one rib for each column.
pub(super) const fn triangle_count(columns: u128, detail: u128) -> u128 {
    let steps = 6 * detail;
    2 * steps * 2 * detail * (columns + 1) + columns * 2 * steps * detail
}

pub(super) fn append(part: &mut MeshPart, columns: u32, detail: u32) {
    let steps = 6 * detail;
    // The arch from +z to −z.
    let arch = |index: u32, radius: f64| {
        let [cosine, sine] = turn(index, 2 * steps);
        [EAVES + radius * sine, radius * cosine]
    };
    let half = 0.5 * BAY * f64::from(columns + 1);
    let along = 2 * detail * (columns + 1);
    append_smooth(part, &Grid::open(steps, along), |row, column| {
        let [y, z] = arch(row, RADIUS);
        [half * (2.0 * f64::from(column) / f64::from(along) - 1.0), y, z]
    });
    for rib in 0..columns {
        let x = BAY * (f64::from(rib) - 0.5 * f64::from(columns - 1));
        append_smooth(part, &Grid::open(steps, detail), |row, column| {
            // Half of the tube is behind the vault and left out.
            let [back, inwards] = turn(column, 2 * detail);
            let [y, z] = arch(row, RADIUS - RIB * inwards);
            [x - RIB * back, y, z]
        });
    }
}
