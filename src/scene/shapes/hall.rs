//! A hall of columns, seen from inside: fine round detail before large flat walls, the mixture of
//! sizes that architectural models have.
//!
//! A nave under a barrel vault between two arcades on fluted columns, and an aisle beyond each.
//! Own design after the classical orders, in metres. No outside, no windows, and the parts are not
//! one watertight surface: columns stand on the tiles, mouldings lie on the walls.

mod arcade;
mod column;
mod tiles;
mod vault;

use super::limits::{ShapeError, check_count, check_triangles};
use super::smooth::append_quad;
use crate::scene::part::MeshPart;
use tiles::Tiles;

pub(super) const NAME: &str = "hall";

/// Distance between the axes of neighbouring columns.
const BAY: f64 = 4.0;
/// z of the columns' axes, on either side.
const ARCADE_Z: f64 = 4.0;
/// Half the thickness of an arcade's wall, and half the width of its piers.
const HALF_WALL: f64 = 0.45;
/// z of the outer walls, on either side.
const WALL_Z: f64 = 7.5;
/// Height at which the columns end and the arches begin.
const SPRINGING: f64 = 5.0;
/// Height at which the arcades end: the vault and the aisles' ceilings begin.
const EAVES: f64 = 7.5;
/// Height of the end walls; the vault's crown is at 11.05.
const GABLE: f64 = 11.5;

/// Hall about the y axis on y = 0, its nave along x: 4 · (columns + 1) long, 15 wide, 11.05 high at
/// the crown of the vault; columns 5 high, 4 apart, in rows at z = ±4. Its surfaces face inwards: a
/// camera inside sees one of them in every direction.
///
/// Texture squares lie on every tile, and once around and along every turned part.
#[derive(Clone, Debug, PartialEq)]
pub struct Hall {
    /// Columns in each of the two rows, at least 1; default 8.
    pub columns: u32,
    /// Fineness of all that is round: a shaft has `detail` cells across each of its 24 flutes. At
    /// least 1; default 8, which makes about 430 000 triangles with 8 columns. Their number grows
    /// with the square.
    pub detail: u32,
}

impl Default for Hall {
    fn default() -> Self {
        Self { columns: 8, detail: 8 }
    }
}

impl Hall {
    pub(super) fn build(&self) -> Result<MeshPart, ShapeError> {
        let Self { columns, detail } = *self;
        check_count(NAME, "columns", columns, 1)?;
        check_count(NAME, "detail", detail, 1)?;
        let counts = format!("{columns} × {detail}");
        let triangles = self.triangle_count();
        check_triangles(NAME, "columns × detail", counts, triangles)?;

        let mut part = MeshPart::default();
        let triangles = triangles as usize;
        part.corners.reserve_exact(triangles);
        part.corner_normals.reserve_exact(triangles);
        part.corner_uvs.reserve_exact(triangles);
        part.polygons.reserve_exact(triangles);
        self.append_shell(&mut part);
        for side in [-1.0, 1.0] {
            for column in 0..columns {
                let x = BAY * (f64::from(column) - 0.5 * f64::from(columns - 1));
                column::append(&mut part, [x, side * ARCADE_Z], detail);
            }
            for bay in 0..=columns {
                let x = BAY * (f64::from(bay) - 0.5 * f64::from(columns));
                arcade::append_bay(&mut part, x, side, detail);
            }
            for end in [-1.0, 1.0] {
                append_respond(&mut part, end * 0.5 * self.length(), end, side);
            }
        }
        vault::append(&mut part, columns, detail);
        Ok(part)
    }

    /// Extent along x.
    fn length(&self) -> f64 {
        BAY * (f64::from(self.columns) + 1.0)
    }

    /// Floor, walls and aisle ceilings.
    fn append_shell(&self, part: &mut MeshPart) {
        self.shell().iter().for_each(|tiles| tiles.append(part));
    }

    fn shell(&self) -> [Tiles; 7] {
        let Self { columns, .. } = *self;
        let (length, half) = (self.length(), 0.5 * self.length());
        let bays = columns.saturating_add(1);
        let width = 2.0 * WALL_Z;
        let aisle = WALL_Z - ARCADE_Z - HALF_WALL;
        let (right, up, back) = ([length, 0.0, 0.0], [0.0, EAVES, 0.0], [0.0, 0.0, -width]);
        let floor = Tiles {
            origin: [-half, 0.0, WALL_Z],
            right,
            up: back,
            counts: [bays.saturating_mul(8), 30],
            joint: 0.03,
            relief: 0.006,
        };
        let wall = Tiles {
            origin: [-half, 0.0, -WALL_Z],
            right,
            up,
            counts: [bays.saturating_mul(4), 15],
            joint: 0.05,
            relief: 0.03,
        };
        let opposite = Tiles { origin: [half, 0.0, WALL_Z], right: [-length, 0.0, 0.0], ..wall };
        let gable = Tiles {
            origin: [-half, 0.0, WALL_Z],
            right: back,
            up: [0.0, GABLE, 0.0],
            counts: [15, 23],
            ..wall
        };
        let other_gable = Tiles { origin: [half, 0.0, -WALL_Z], right: [0.0, 0.0, width], ..gable };
        let ceiling = Tiles {
            origin: [-half, EAVES, -WALL_Z],
            right,
            up: [0.0, 0.0, aisle],
            counts: [bays.saturating_mul(4), 3],
            joint: 0.12,
            relief: -0.15,
        };
        let other_ceiling = Tiles { origin: [-half, EAVES, WALL_Z - aisle], ..ceiling };
        [floor, wall, opposite, gable, other_gable, ceiling, other_ceiling]
    }

    pub(super) fn triangle_count(&self) -> u128 {
        let [columns, detail] = [self.columns, self.detail].map(u128::from);
        let shell: u128 = self.shell().iter().map(Tiles::triangle_count).sum();
        // Three faces of two triangles each for the four responds.
        2 * columns * column::triangle_count(detail)
            + 2 * (columns + 1) * arcade::triangle_count(detail)
            + vault::triangle_count(columns, detail)
            + shell
            + 4 * 6
    }
}

/// Appends the half pier that carries an arcade's end at a wall: `end` is the sign of the wall's x.
fn append_respond(part: &mut MeshPart, wall_x: f64, end: f64, side: f64) {
    let x = [wall_x, wall_x - end * HALF_WALL];
    let z = [side * ARCADE_Z - HALF_WALL, side * ARCADE_Z + HALF_WALL];
    let quad = |from: [f64; 2], to: [f64; 2]| {
        let at = |[x, z]: [f64; 2], y: f64| [x, y, z];
        [at(from, 0.0), at(to, 0.0), at(to, SPRINGING), at(from, SPRINGING)]
    };
    // Around the pier, counter-clockwise seen from above, from the wall back to the wall.
    let mut around = [[x[0], z[0]], [x[1], z[0]], [x[1], z[1]], [x[0], z[1]]];
    if end < 0.0 {
        around.reverse();
    }
    for step in around.windows(2) {
        append_quad(part, quad(step[1], step[0]));
    }
}
