//! The interval test that throws out triangles which certainly do not cross a shadow's segment.
//!
//! The planes through a light and the edges of each triangle, turned so that the inside is
//! positive, are enclosed once per light; a surface point that is certainly outside one of them
//! is not occluded by that triangle. Whatever is not certain is kept.

use super::Light;
use crate::exact::interval::{Interval, cross, dot};
use crate::exact::rational::{self, exact_vector};
use crate::mesh::{TriangleId, TriangleMesh};
use crate::scene::light_point::LightPoint;

/// Enclosures of the planes of one triangle.
#[derive(Clone, Debug)]
struct Screen {
    triangle: TriangleId,
    /// Normals, for edges 01, 12, 20: positive for a point behind the triangle, seen from the light.
    planes: [[Interval; 3]; 3],
    /// A point of all three: the light, or (for a direction) the first corner of each edge.
    points: [[f64; 3]; 3],
}

/// The screens of all triangles that can cast a shadow.
#[derive(Clone, Debug, Default)]
pub(super) struct Screens(Vec<Screen>);

/// Where intervals stay finite: positions up to 2^200 make planes below 2^402.
const RANGE: f64 = f64::from_bits((1023 + 200) << 52);

impl Screens {
    /// Encloses the planes of every triangle; those with τ = 0 are left out for good.
    pub(super) fn of(mesh: &TriangleMesh, light: LightPoint) -> Self {
        Self(mesh.ids().filter_map(|id| screen(mesh, id, light)).collect())
    }

    /// The triangles that a point within these bounds may have between itself and the light, in
    /// the order of ids.
    pub(super) fn near(&self, bounds: [(f64, f64); 3]) -> Vec<TriangleId> {
        self.0
            .iter()
            .filter(|screen| {
                screen.planes.iter().zip(&screen.points).all(|(plane, point)| {
                    let from_point = [0, 1, 2].map(|k| Interval {
                        lower: (bounds[k].0 - point[k]).next_down(),
                        upper: (bounds[k].1 - point[k]).next_up(),
                    });
                    dot(*plane, from_point).sign() != Some(-1)
                })
            })
            .map(|screen| screen.triangle)
            .collect()
    }
}

fn screen(mesh: &TriangleMesh, triangle: TriangleId, light: LightPoint) -> Option<Screen> {
    let corners = mesh.triangle(triangle).map(|v| v.map(f64::from));
    let v = corners.map(exact_vector);
    let n = rational::cross(&rational::subtract(&v[1], &v[0]), &rational::subtract(&v[2], &v[0]));
    let tau = Light::new(light).side(&n, &v[0]);
    if tau == 0 {
        return None;
    }
    let minus = |a: [f64; 3], b: [f64; 3]| [0, 1, 2].map(|k| Interval::difference(a[k], b[k]));
    let (LightPoint::Position(l) | LightPoint::Direction(l)) = light;
    // A light so far away that bounds would overflow: planes of 0 discard nothing.
    if l.iter().any(|c| c.abs() > RANGE) {
        let zero = Interval { lower: 0.0, upper: 0.0 };
        return Some(Screen { triangle, planes: [[zero; 3]; 3], points: [corners[0]; 3] });
    }
    let edges = [(0, 1), (1, 2), (2, 0)];
    let planes = edges.map(|(j, k)| {
        let plane = match light {
            LightPoint::Position(l) => cross(minus(corners[j], l), minus(corners[k], l)),
            LightPoint::Direction(l) => {
                cross(minus(corners[k], corners[j]), l.map(|c| Interval { lower: c, upper: c }))
            }
        };
        // The inside has the sign of −τ.
        if tau > 0 { plane.map(Interval::negated) } else { plane }
    });
    let points = edges.map(|(j, _)| match light {
        LightPoint::Position(l) => l,
        LightPoint::Direction(_) => corners[j],
    });
    Some(Screen { triangle, planes, points })
}
