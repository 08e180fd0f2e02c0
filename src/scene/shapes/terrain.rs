//! A square of hills: several octaves of value noise, for scenes of many triangles.
//!
//! Value noise after Perlin ("An image synthesizer", SIGGRAPH 1985) in its simplest form: a random
//! height at every point of an integer lattice, and the quintic 6t⁵ − 15t⁴ + 10t³ between them
//! (Perlin, "Improving noise", 2002). No erosion, no levels of detail, no skirt.

use super::angle::centred;
use super::grid::Grid;
use super::limits::{ShapeError, check_count_within, check_length};
use super::splitmix::unit;
use crate::scene::part::MeshPart;

pub(super) const NAME: &str = "terrain";

/// Most cells along an edge: 2 · 2896² = 16 773 632 triangles, just below 2^24.
const MAX_CELLS: u32 = 2896;

/// Octaves, each of half the height and half the wavelength of the one before.
const OCTAVES: u32 = 9;

/// Lattice steps of the first octave along an edge.
const COARSEST: f64 = 4.0;

/// Square of hills about the y axis, heights within 0…`height`. Texture coordinates as for a
/// plane: s grows with x, t with −z.
///
/// The surface depends on `size`, `height` and `seed` alone; `cells` says how finely it is sampled.
/// Normals are those of central differences between neighbouring samples.
#[derive(Clone, Debug, PartialEq)]
pub struct Terrain {
    /// Extent along x and along z, in object units, 1e-18…1e18; default 20.
    pub size: f64,
    /// Upper bound of the heights, in object units, 1e-18…1e18; default 4.
    pub height: f64,
    /// Cells along each edge, 1…2896: 2 · cells² triangles; default 256.
    pub cells: u32,
    /// Which hills, any number; default 1.
    pub seed: u32,
}

impl Default for Terrain {
    fn default() -> Self {
        Self { size: 20.0, height: 4.0, cells: 256, seed: 1 }
    }
}

impl Terrain {
    pub(super) fn build(&self) -> Result<MeshPart, ShapeError> {
        let Self { size, height, cells, seed } = *self;
        check_length(NAME, "size", size)?;
        check_length(NAME, "height", height)?;
        check_count_within(NAME, "cells", cells, 1, MAX_CELLS)?;

        let grid = Grid::open(cells, cells);
        let side = cells as usize + 1;
        let mut heights = Vec::with_capacity(side * side);
        grid.fill_points(&mut heights, |row, column| {
            let along = |index: u32| COARSEST * f64::from(index) / f64::from(cells);
            height * octaves(seed, along(column), along(row))
        });
        let at = |row: u32, column: u32| heights[row as usize * side + column as usize];

        let mut part = MeshPart::default();
        part.positions.reserve_exact(side * side);
        part.normals.reserve_exact(side * side);
        part.uvs.reserve_exact(side * side);
        part.polygons.reserve_exact(2 * cells as usize * cells as usize);
        let points = grid.fill_points(&mut part.positions, |row, column| {
            [centred(column, cells, size), at(row, column), centred(row, cells, size)]
        });
        grid.append_cells(&mut part, points);
        let step = size / f64::from(cells);
        // The difference between the samples before and after, or at an edge the one that is there.
        let neighbours = |index: u32| (index.saturating_sub(1), (index + 1).min(cells));
        grid.fill_points(&mut part.normals, |row, column| {
            let (left, right) = neighbours(column);
            let (back, front) = neighbours(row);
            let along_x = (at(row, right) - at(row, left)) / (f64::from(right - left) * step);
            let along_z = (at(front, column) - at(back, column)) / (f64::from(front - back) * step);
            let length = (along_x * along_x + along_z * along_z + 1.0).sqrt();
            [0.0 - along_x / length, 1.0 / length, 0.0 - along_z / length]
        });
        part.corner_normals = part.corners.clone();
        grid.fill_texture_points(&mut part.uvs);
        part.corner_uvs = part.corners.clone();
        Ok(part)
    }
}

/// The sum of the octaves at a point of the first octave's lattice, 0…1.
fn octaves(seed: u32, mut x: f64, mut y: f64) -> f64 {
    let (mut sum, mut weight) = (0.0, 0.5);
    for octave in 0..OCTAVES {
        sum += weight * noise(seed, octave, x, y);
        weight *= 0.5;
        // Turn by the angle of the 3-4-5 triangle, so that no lattice's lines lie on another's.
        (x, y) = (2.0 * (0.8 * x - 0.6 * y), 2.0 * (0.6 * x + 0.8 * y));
    }
    // The weights add up to 1 − 2^-9.
    sum
}

/// Value noise at a point, 0…1.
fn noise(seed: u32, octave: u32, x: f64, y: f64) -> f64 {
    let (column, row) = (x.floor(), y.floor());
    // Coordinates stay below 4 · √2 · 2^9: 24 bits each, signed, beside the octave's number.
    let corner = |right: i64, down: i64| {
        let (a, b) = (column as i64 + right, row as i64 + down);
        unit(seed, (u64::from(octave) << 32) | (a as u64 & 0xff_ffff), b as u64)
    };
    let ease = |t: f64| t * t * t * (t * (6.0 * t - 15.0) + 10.0);
    let (s, t) = (ease(x - column), ease(y - row));
    let mix = |a: f64, b: f64, share: f64| a + (b - a) * share;
    mix(mix(corner(0, 0), corner(1, 0), s), mix(corner(0, 1), corner(1, 1), s), t)
}
