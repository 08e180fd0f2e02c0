//! The interval test that throws out triangles which cannot touch a sample, so that an audit of a
//! real mesh finishes: it decides nothing else, and whatever it is not certain of it keeps.
//!
//! With c_i the cross product of the two corners of edge i, seen from the eye, the triangle touches
//! the sample only if all of c_i·d have the sign of V or are 0. The c_i, turned so that V > 0, are
//! enclosed once per triangle; per sample an upper bound of c_i·d below 0 discards.

use super::interval::{Interval, cross, dot};
use super::rational::{self, exact_vector};
use crate::mesh::{TriangleId, TriangleMesh};
use crate::mutant::{self, Mutant};

/// Enclosures of the edge planes of one triangle with V ≠ 0; 152 bytes.
#[derive(Clone, Debug)]
struct Outline {
    triangle: TriangleId,
    /// sgn V · (a_1 × a_2), sgn V · (a_2 × a_0), sgn V · (a_0 × a_1).
    edge_planes: [[Interval; 3]; 3],
}

/// The outlines of all triangles that can be visible at all.
#[derive(Clone, Debug)]
pub(super) struct Outlines(Vec<Outline>);

impl Outlines {
    /// Encloses the edge planes of every triangle; triangles with V = 0 are left out for good.
    pub(super) fn of(mesh: &TriangleMesh, eye: [f64; 3]) -> Self {
        Self(mesh.ids().filter_map(|id| outline(mesh, id, eye)).collect())
    }

    /// The triangles that may touch the ray of direction `direction`, in the order of ids.
    pub(super) fn near(&self, direction: [f64; 3]) -> Vec<TriangleId> {
        self.0
            .iter()
            .filter(|outline| outline.edge_planes.iter().all(|plane| may_see(plane, direction)))
            .map(|outline| outline.triangle)
            .collect()
    }
}

/// Whether c·d ≥ 0 is possible.
fn may_see(plane: &[Interval; 3], direction: [f64; 3]) -> bool {
    let [x, y, z] = [0, 1, 2].map(|k| plane[k].upper_times(direction[k]));
    ((x + y).next_up() + z).next_up() >= 0.0
}

fn outline(mesh: &TriangleMesh, triangle: TriangleId, eye: [f64; 3]) -> Option<Outline> {
    let corners = mesh.triangle(triangle).map(|corner| corner.map(f64::from));
    let a = corners.map(|v| [0, 1, 2].map(|k| Interval::difference(v[k], eye[k])));
    let planes = [cross(a[1], a[2]), cross(a[2], a[0]), cross(a[0], a[1])];
    // A volume too close to zero for intervals is decided exactly, once and for all samples.
    let sign = match dot(a[0], planes[0]).sign() {
        Some(sign) => sign,
        None => exact_volume_sign(corners, eye),
    };
    let edge_planes = match sign {
        0 if !mutant::is(Mutant::VolumeZeroHits) => return None,
        1 => planes,
        _ => planes.map(|plane| plane.map(Interval::negated)),
    };
    Some(Outline { triangle, edge_planes })
}

/// sgn V.
fn exact_volume_sign(corners: [[f64; 3]; 3], eye: [f64; 3]) -> i8 {
    let eye = exact_vector(eye);
    let a = corners.map(|v| rational::subtract(&exact_vector(v), &eye));
    rational::sign(&rational::dot(&a[0], &rational::cross(&a[1], &a[2])))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_touches_is_kept_and_what_lies_beside_is_not() {
        let corner = |x: f32, y: f32| [x, y, 8.0];
        let triangles = [
            // Inside, either way round; the sample on an edge, on a corner; beside; behind;
            // without area; edge-on.
            [corner(-1.0, -1.0), corner(1.0, -1.0), corner(0.0, 1.0)],
            [corner(0.0, 1.0), corner(1.0, -1.0), corner(-1.0, -1.0)],
            [corner(-1.0, 0.0), corner(1.0, 0.0), corner(0.0, 1.0)],
            [corner(0.0, 0.0), corner(1.0, 0.0), corner(0.0, 1.0)],
            [corner(0.001, -1.0), corner(1.0, -1.0), corner(1.0, 1.0)],
            [[-1.0, -1.0, -8.0], [1.0, -1.0, -8.0], [0.0, 1.0, -8.0]],
            [corner(0.0, 0.0), corner(0.0, 0.0), corner(0.0, 1.0)],
            [corner(0.0, -1.0), corner(0.0, 1.0), [0.0, 0.0, 9.0]],
        ];
        let mesh = TriangleMesh {
            positions: triangles.into_iter().flatten().collect(),
            corners: (0..8).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect(),
            ..TriangleMesh::default()
        };
        for scale in [2.0_f64.powi(-300), 1.0, 2.0_f64.powi(300)] {
            let near = Outlines::of(&mesh, [0.0; 3]).near([0.0, 0.0, scale]);
            assert_eq!(near, [0, 1, 2, 3].map(TriangleId::new));
        }
    }
}
