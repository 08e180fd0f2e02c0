//! A column: plinth, turned base, fluted shaft, turned capital, abacus.
//!
//! Proportions are between the Doric and the Ionic order; the shaft has the Ionic 24 flutes.

use super::super::angle::{heading, turn};
use super::super::grid::Grid;
use super::super::smooth::{append_quad, append_smooth};
use super::SPRINGING;
use crate::scene::part::MeshPart;

/// Flutes around a shaft.
const FLUTES: u32 = 24;
/// Heights of the shaft's ends.
const SHAFT: [f64; 2] = [0.6, 4.4];
/// Radius of the shaft at its foot, and what it loses up to its head.
const RADIUS: f64 = 0.4;
const TAPER: f64 = 0.07;
/// Depth of a flute, and the share of the turn that the flat between flutes takes.
const FLUTE_DEPTH: f64 = 0.045;
const FILLET: f64 = 0.2;
/// Half the widths of plinth and abacus.
const HALF_PLINTH: f64 = 0.6;
const HALF_ABACUS: f64 = 0.58;

/// Triangles of a column: shaft, base, capital, and two boxes of twelve.
pub(super) const fn triangle_count(detail: u128) -> u128 {
    let around = 12 * detail;
    2 * (3 * detail) * (24 * detail)
        + 2 * (4 * detail + 3) * around
        + 2 * (3 * detail + 2) * around
        + 24
}

/// Appends a column whose axis is at x and z.
pub(super) fn append(part: &mut MeshPart, [x, z]: [f64; 2], detail: u32) {
    append_box(part, [x, z], HALF_PLINTH, [0.0, 0.25]);
    append_shaft(part, [x, z], detail);
    for profile in base(detail).iter().chain(&capital(detail)) {
        append_turned(part, [x, z], 12 * detail, profile);
    }
    append_box(part, [x, z], HALF_ABACUS, [4.75, SPRINGING]);
}

fn append_shaft(part: &mut MeshPart, [x, z]: [f64; 2], detail: u32) {
    let (rows, around) = (3 * detail, FLUTES * detail);
    append_smooth(part, &Grid::tube(rows, around), |row, column| {
        let up = f64::from(rows - row) / f64::from(rows);
        // The lower part hardly narrows: the swelling of classical shafts.
        let radius = RADIUS - TAPER * (up * up);
        // A channel of circular section between two flats.
        let place = f64::from(column % detail) / f64::from(detail);
        let across = (place - FILLET) / (1.0 - FILLET);
        let offset = 2.0 * across - 1.0;
        let depth = if across > 0.0 { (1.0 - offset * offset).max(0.0).sqrt() } else { 0.0 };
        let distance = radius - FLUTE_DEPTH * depth;
        let [cosine, sine] = heading(column, around);
        [x + distance * cosine, SHAFT[0] + (SHAFT[1] - SHAFT[0]) * up, z + distance * sine]
    });
}

/// Profiles of the base from above, as distances from the axis and heights, with sharp edges from
/// one to the next: two rolls and a hollow.
fn base(detail: u32) -> [Vec<[f64; 2]>; 4] {
    let (upper, lower) = (roll([0.42, 0.54], 0.06, detail), roll([0.46, 0.34], 0.09, detail));
    let top = vec![[0.3, SHAFT[0]], upper[0]];
    let hollow = vec![upper[upper.len() - 1], [0.425, 0.455], lower[0]];
    [top, upper, hollow, lower]
}

/// Profiles of the capital from above: a quarter round under the abacus, a neck, a roll.
fn capital(detail: u32) -> [Vec<[f64; 2]>; 4] {
    let quarter = (0..=detail).map(|index| turn(index, 4 * detail));
    let round: Vec<_> = quarter.map(|[c, s]| [0.36 + 0.2 * c, 4.75 - 0.2 * s]).collect();
    let ring = roll([0.35, 4.45], 0.04, detail);
    let neck = vec![round[round.len() - 1], ring[0]];
    let foot = vec![ring[ring.len() - 1], [0.28, SHAFT[1]]];
    [round, neck, ring, foot]
}

/// A half circle, bulging away from the axis, from above.
fn roll([distance, height]: [f64; 2], radius: f64, detail: u32) -> Vec<[f64; 2]> {
    let steps = (0..=2 * detail).map(|index| turn(index, 4 * detail));
    steps.map(|[down, out]| [distance + radius * out, height + radius * down]).collect()
}

/// Appends a profile carried around a vertical axis.
fn append_turned(part: &mut MeshPart, [x, z]: [f64; 2], around: u32, profile: &[[f64; 2]]) {
    let grid = Grid::tube(profile.len() as u32 - 1, around);
    append_smooth(part, &grid, |row, column| {
        let [distance, height] = profile[row as usize];
        let [cosine, sine] = heading(column, around);
        [x + distance * cosine, height, z + distance * sine]
    });
}

/// Appends an upright box of square section between two heights.
fn append_box(part: &mut MeshPart, [x, z]: [f64; 2], half: f64, [low, high]: [f64; 2]) {
    // Counter-clockwise seen from above.
    let ring = [[-half, half], [half, half], [half, -half], [-half, -half]];
    let [below, above] = [low, high].map(|y| ring.map(|[dx, dz]| [x + dx, y, z + dz]));
    append_quad(part, above);
    append_quad(part, [below[3], below[2], below[1], below[0]]);
    for edge in 0..4 {
        let next = (edge + 1) % 4;
        append_quad(part, [below[edge], below[next], above[next], above[edge]]);
    }
}
