//! A sphere of a subdivided icosahedron: triangles of nearly equal size, no poles.

use super::limits::{ShapeError, check_length, check_triangles};
use crate::scene::part::MeshPart;
use std::f64::consts::TAU;

pub(super) const NAME: &str = "icosphere";

/// Sphere about the origin. Each level cuts every triangle in four; all vertices lie on the sphere.
/// Texture coordinates are longitude and latitude as for the UV sphere; in triangles across the
/// seam at +x, s goes on beyond 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Icosphere {
    /// Radius in object units, 1e-18…1e18; default 1.
    pub radius: f64,
    /// Times that each triangle is cut in four, 0…10: 20 · 4^level triangles; default 4. From
    /// level 1 on there are vertices on the axes.
    pub level: u32,
}

impl Default for Icosphere {
    fn default() -> Self {
        Self { radius: 1.0, level: 4 }
    }
}

/// The golden ratio, (1 + √5) / 2.
const GOLDEN: f64 = 1.618_033_988_749_895;

/// An icosahedron of edge 2: the corners of three golden rectangles.
#[rustfmt::skip]
const CORNERS: [[f64; 3]; 12] = [
    [-1.0, GOLDEN, 0.0], [1.0, GOLDEN, 0.0], [-1.0, -GOLDEN, 0.0], [1.0, -GOLDEN, 0.0],
    [0.0, -1.0, GOLDEN], [0.0, 1.0, GOLDEN], [0.0, -1.0, -GOLDEN], [0.0, 1.0, -GOLDEN],
    [GOLDEN, 0.0, -1.0], [GOLDEN, 0.0, 1.0], [-GOLDEN, 0.0, -1.0], [-GOLDEN, 0.0, 1.0],
];

/// Its faces, counter-clockwise seen from outside.
#[rustfmt::skip]
const FACES: [[u32; 3]; 20] = [
    [0, 11, 5], [0, 5, 1], [0, 1, 7], [0, 7, 10], [0, 10, 11],
    [1, 5, 9], [5, 11, 4], [11, 10, 2], [10, 7, 6], [7, 1, 8],
    [3, 9, 4], [3, 4, 2], [3, 2, 6], [3, 6, 8], [3, 8, 9],
    [4, 9, 5], [2, 4, 11], [6, 2, 10], [8, 6, 7], [9, 8, 1],
];

/// A triangulation that knows its edges, so that no search finds the middle of one.
struct Subdivision {
    /// Unit vectors.
    points: Vec<[f64; 3]>,
    /// End points of each edge.
    edges: Vec<[u32; 2]>,
    /// Per triangle its corners a, b, c and its edges ab, bc, ca.
    triangles: Vec<([u32; 3], [u32; 3])>,
}

impl Icosphere {
    pub(super) fn build(&self) -> Result<MeshPart, ShapeError> {
        check_length(NAME, "radius", self.radius)?;
        let count =
            4_u128.checked_pow(self.level).map_or(u128::MAX, |cuts| cuts.saturating_mul(20));
        check_triangles(NAME, "level", self.level, count)?;

        let mut sphere = Subdivision::icosahedron();
        for _ in 0..self.level {
            sphere = sphere.refined();
        }
        let corners: Vec<[u32; 3]> = sphere.triangles.iter().map(|(corners, _)| *corners).collect();
        let (uvs, corner_uvs) = spherical_uvs(&sphere.points, &corners);
        Ok(MeshPart {
            positions: sphere.points.iter().map(|p| p.map(|c| c * self.radius)).collect(),
            corner_normals: corners.clone(),
            corners,
            normals: sphere.points,
            uvs,
            corner_uvs,
            ..MeshPart::default()
        })
    }
}

impl Subdivision {
    fn icosahedron() -> Self {
        let mut edges: Vec<[u32; 2]> = Vec::with_capacity(30);
        let mut edge = |a: u32, b: u32| {
            let ends = [a.min(b), a.max(b)];
            let found = edges.iter().position(|known| *known == ends);
            found.unwrap_or_else(|| {
                edges.push(ends);
                edges.len() - 1
            }) as u32
        };
        let triangles =
            FACES.map(|[a, b, c]| ([a, b, c], [edge(a, b), edge(b, c), edge(c, a)])).to_vec();
        Self { points: CORNERS.map(unit).to_vec(), edges, triangles }
    }

    /// The same with every triangle cut in four by the middles of its edges, moved out to the
    /// sphere. Edge e has its middle at point P + e and its halves at edges 2e (from its first end)
    /// and 2e + 1; triangle t adds the edges 2E + 3t + 0, 1, 2, which cut off its corners a, b, c.
    fn refined(mut self) -> Self {
        let (old_points, old_edges) = (self.points.len() as u32, self.edges.len() as u32);

        // Cut the edges.
        let mut edges = Vec::with_capacity(2 * self.edges.len() + 3 * self.triangles.len());
        self.points.reserve_exact(self.edges.len());
        for (&[a, b], middle) in self.edges.iter().zip(old_points..) {
            let sum =
                [0, 1, 2].map(|axis| self.points[a as usize][axis] + self.points[b as usize][axis]);
            self.points.push(unit(sum));
            edges.extend([[a, middle], [middle, b]]);
        }
        let half = |edge: u32, end: u32| 2 * edge + u32::from(self.edges[edge as usize][0] != end);

        // Cut the triangles: three corners, then the middle.
        let mut triangles = Vec::with_capacity(4 * self.triangles.len());
        for (&([a, b, c], [ab, bc, ca]), t) in self.triangles.iter().zip(0..) {
            let [near_a, near_b, near_c] = [0, 1, 2].map(|k| 2 * old_edges + 3 * t + k);
            let [p, q, r] = [ab, bc, ca].map(|edge| old_points + edge);
            edges.extend([[p, r], [q, p], [r, q]]);
            triangles.extend([
                ([a, p, r], [half(ab, a), near_a, half(ca, a)]),
                ([p, b, q], [half(ab, b), half(bc, b), near_b]),
                ([r, q, c], [near_c, half(bc, c), half(ca, c)]),
                ([p, q, r], [near_b, near_c, near_a]),
            ]);
        }
        Self { points: self.points, edges, triangles }
    }
}

/// A vector made unit.
fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    v.map(|c| c / length)
}

/// Longitude and latitude of each point, and per triangle the points' coordinates, with further
/// ones where a triangle crosses the seam or has a corner on the y axis, which has no longitude.
fn spherical_uvs(points: &[[f64; 3]], corners: &[[u32; 3]]) -> (Vec<[f64; 2]>, Vec<[u32; 3]>) {
    let plain: Vec<[f64; 2]> = points.iter().map(|&p| longitude_latitude(p)).collect();
    let mut uvs = plain.clone();
    let mut append = |uv: [f64; 2]| {
        uvs.push(uv);
        uvs.len() as u32 - 1
    };
    let is_pole = |index: u32| points[index as usize][0] == 0.0 && points[index as usize][2] == 0.0;
    let corner_uvs = corners.iter().map(|triangle| {
        let mut s = triangle.map(|index| plain[index as usize][0]);

        // Move corners just after the seam to just before their own next turn.
        let last = (0..3).filter(|&k| !is_pole(triangle[k])).map(|k| s[k]).fold(0.0, f64::max);
        for value in &mut s {
            if last - *value > 0.5 {
                *value += 1.0;
            }
        }

        // Give a pole the middle longitude of the two other corners.
        if let Some(pole) = (0..3).find(|&k| is_pole(triangle[k])) {
            s[pole] = 0.5 * (s[(pole + 1) % 3] + s[(pole + 2) % 3]);
        }
        [0, 1, 2].map(|k| {
            let [own, t] = plain[triangle[k] as usize];
            if s[k] == own { triangle[k] } else { append([s[k], t]) }
        })
    });
    let corner_uvs = corner_uvs.collect();
    (uvs, corner_uvs)
}

/// Longitude as a fraction of a turn in [0, 1), counter-clockwise seen from above from +x, and
/// latitude from 0 at −y to 1 at +y.
fn longitude_latitude(p: [f64; 3]) -> [f64; 2] {
    let turns = libm::atan2(0.0 - p[2], p[0]) / TAU;
    let s = if turns < 0.0 { turns + 1.0 } else { turns };
    let t = 0.5 + libm::atan2(p[1], libm::hypot(p[0], p[2])) / (0.5 * TAU);
    [s, t.clamp(0.0, 1.0)]
}
