//! Rows of Utah teapots, each turned its own way: many small closed-up details behind each other.
//!
//! The teapots are copies, triangle by triangle; nothing is instanced.

use super::angle::{centred, heading};
use super::limits::{ShapeError, check_count, check_length, check_triangles};
use super::splitmix::hash;
use super::teapot::Teapot;
use super::vector::made_unit;
use crate::scene::part::MeshPart;

pub(super) const NAME: &str = "teapot_field";

/// Steps of the turn that a teapot is turned by.
const HEADINGS: u32 = 64;

/// Teapots on y = 0 in rows and columns about the y axis, each as the shape `teapot` makes it and
/// turned about its own axis by a multiple of 1/64 of a turn that depends on its place alone.
#[derive(Clone, Debug, PartialEq)]
pub struct TeapotField {
    /// Teapots along x, at least 1; default 5.
    pub columns: u32,
    /// Teapots along z, at least 1; default 5.
    pub rows: u32,
    /// Distance between the axes of neighbours, in object units, 1e-18…1e18; default 7. From 6.9 on,
    /// no teapot reaches another.
    pub spacing: f64,
    /// Fineness: a teapot has 2 · 2^level cells along each edge of a patch, 256 · 4^level − 16 ·
    /// 2^level triangles; default 2.
    pub level: u32,
}

impl Default for TeapotField {
    fn default() -> Self {
        Self { columns: 5, rows: 5, spacing: 7.0, level: 2 }
    }
}

impl TeapotField {
    pub(super) fn build(&self) -> Result<MeshPart, ShapeError> {
        let Self { columns, rows, spacing, level } = *self;
        check_count(NAME, "columns", columns, 1)?;
        check_count(NAME, "rows", rows, 1)?;
        check_length(NAME, "spacing", spacing)?;
        // From level 20 on, one teapot is too many; cut off there, the numbers fit.
        let cells = 2_u32 << level.min(20);
        let one = 64 * u128::from(cells) * u128::from(cells) - 8 * u128::from(cells);
        check_triangles(NAME, "level", level, one)?;
        let counts = format!("{columns} × {rows} at level {level}");
        let total = u128::from(columns) * u128::from(rows) * one;
        check_triangles(NAME, "columns × rows", counts, total)?;

        let teapot = Teapot { segments: cells, ..Teapot::default() }.build()?;
        let count = columns as usize * rows as usize;
        let mut part = MeshPart { uvs: teapot.uvs.clone(), ..MeshPart::default() };
        part.positions.reserve_exact(count * teapot.positions.len());
        part.normals.reserve_exact(count * teapot.normals.len());
        part.corners.reserve_exact(count * teapot.corners.len());
        part.corner_normals.reserve_exact(count * teapot.corners.len());
        part.polygons.reserve_exact(count * teapot.corners.len());
        for row in 0..rows {
            for column in 0..columns {
                let [x, z] = [centred(column, columns, 1.0), centred(row, rows, 1.0)];
                // Middles of the field's cells, half a spacing on from their corners.
                let x = spacing * (f64::from(columns) * x + 0.5);
                let z = spacing * (f64::from(rows) * z + 0.5);
                append_turned(&mut part, &teapot, [x, z], self.heading(column, row));
            }
        }
        part.corner_uvs = teapot.corner_uvs.repeat(count);
        Ok(part)
    }

    /// The x and z of the direction that the spout of a teapot points in.
    fn heading(&self, column: u32, row: u32) -> [f64; 2] {
        let drawn = hash(0, u64::from(column), u64::from(row)) % u64::from(HEADINGS);
        heading(drawn as u32, HEADINGS)
    }
}

/// Appends a copy whose +x points along `ahead`, moved to a place on the floor.
fn append_turned(part: &mut MeshPart, teapot: &MeshPart, place: [f64; 2], ahead: [f64; 2]) {
    let [cosine, sine] = ahead;
    let turned = |[x, y, z]: [f64; 3]| [x * cosine - z * sine, y, x * sine + z * cosine];
    let first_position = part.positions.len() as u32;
    let first_normal = part.normals.len() as u32;
    let first_polygon = part.polygons.last().map_or(0, |last| last + 1);
    part.positions.extend(teapot.positions.iter().map(|&p| {
        let [x, y, z] = turned(p);
        [place[0] + x, y, place[1] + z]
    }));
    part.normals.extend(teapot.normals.iter().map(|&n| made_unit(turned(n))));
    part.corners.extend(teapot.corners.iter().map(|t| t.map(|k| first_position + k)));
    part.corner_normals.extend(teapot.corner_normals.iter().map(|t| t.map(|k| first_normal + k)));
    part.polygons.extend(teapot.polygons.iter().map(|k| first_polygon + k));
}
