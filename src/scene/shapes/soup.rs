//! Triangles strewn through a cube, without order or neighbours: the worst case of a hierarchy.
//!
//! They pass through each other as it happens. No slivers: every triangle is well shaped.

use super::limits::{ShapeError, check_count_within, check_length};
use super::splitmix::unit;
use super::vector::{cross, dot, made_unit};
use crate::scene::part::MeshPart;
use std::f64::consts::TAU;

pub(super) const NAME: &str = "soup";

/// Most triangles.
const MAX_COUNT: u32 = 1 << 24;

/// Least of `size / extent`. Near the faces of the cube, neighbouring f32 are 3e-8…6e-8 of its side
/// apart, so at 1e-5 rounding moves a corner by about 1/300 of its triangle's size.
const LEAST_RATIO: f64 = 1e-5;

/// Triangles of random place and attitude in the cube about the origin, each in a ball of diameter
/// `size` of its own. One normal for each triangle; each has the lower left half of the texture
/// square.
#[derive(Clone, Debug, PartialEq)]
pub struct Soup {
    /// Number of triangles, 1…16777216; default 20000.
    pub count: u32,
    /// Diameter of the ball about each triangle, in object units: 0.00001…1 of `extent` and at
    /// least 1e-18; default 0.25.
    pub size: f64,
    /// Side of the cube, in object units, 1e-18…1e18; default 10.
    pub extent: f64,
    /// Which triangles, any number; default 1.
    pub seed: u32,
}

impl Default for Soup {
    fn default() -> Self {
        Self { count: 20_000, size: 0.25, extent: 10.0, seed: 1 }
    }
}

impl Soup {
    pub(super) fn build(&self) -> Result<MeshPart, ShapeError> {
        self.check()?;
        let count = self.count as usize;
        let mut part = MeshPart {
            positions: Vec::with_capacity(3 * count),
            normals: Vec::with_capacity(count),
            corners: (0..self.count).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect(),
            corner_normals: (0..self.count).map(|k| [k; 3]).collect(),
            uvs: vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]],
            corner_uvs: vec![[0, 1, 2]; count],
            ..MeshPart::default()
        };
        for index in 0..self.count {
            let (corners, normal) = self.triangle(index);
            part.positions.extend(corners);
            part.normals.push(normal);
        }
        Ok(part)
    }

    /// Corners and normal of one triangle.
    fn triangle(&self, index: u32) -> ([[f64; 3]; 3], [f64; 3]) {
        let draw = |number: u64| unit(self.seed, u64::from(index), number);

        // Draw the centre where the whole ball is in the cube.
        let centre = [0, 1, 2].map(|k| (draw(k) - 0.5) * (self.extent - self.size));

        // Draw a normal, evenly on the sphere: evenly in height and around (Archimedes).
        let height = 2.0 * draw(3) - 1.0;
        let across = (1.0 - height * height).max(0.0).sqrt();
        let around = TAU * draw(4);
        let normal = [across * libm::cos(around), height, across * libm::sin(around)];
        let normal = made_unit(normal);

        // Span the plane by two directions square on it and on each other.
        let away = if normal[1].abs() < 0.5 { [0.0, 1.0, 0.0] } else { [1.0, 0.0, 0.0] };
        let right = made_unit(cross(away, normal));
        let up = cross(normal, right);
        debug_assert!(dot(right, up).abs() < 1e-9);

        // Put a corner into each third of the turn, at 1/2…1 of the ball's radius. Neighbours are
        // 80…160 degrees apart, so the triangle winds counter-clockwise about its normal.
        let first = draw(5);
        let corners = [0_u32, 1, 2].map(|corner| {
            let own = u64::from(6 + 2 * corner);
            let angle = TAU * (first + (f64::from(corner) + (draw(own) - 0.5) / 3.0) / 3.0);
            let reach = 0.25 * self.size * (1.0 + draw(own + 1));
            let (x, y) = (reach * libm::cos(angle), reach * libm::sin(angle));
            [0, 1, 2].map(|k: usize| centre[k] + (x * right[k] + y * up[k]))
        });
        (corners, normal)
    }

    fn check(&self) -> Result<(), ShapeError> {
        check_count_within(NAME, "count", self.count, 1, MAX_COUNT)?;
        check_length(NAME, "extent", self.extent)?;
        check_length(NAME, "size", self.size)?;
        let (least, most) = (LEAST_RATIO * self.extent, self.extent);
        if !(least..=most).contains(&self.size) {
            return Err(ShapeError {
                shape: NAME,
                parameter: "size",
                value: self.size.to_string(),
                range: format!("from {least:e} to {most:e} where extent is {}", self.extent),
            });
        }
        Ok(())
    }
}
