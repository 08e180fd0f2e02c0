//! A triangle cut at the near plane and the guard band, in homogeneous f64 coordinates.
//!
//! Source: Sutherland & Hodgman, "Reentrant polygon clipping" (1974). A cut edge's new vertex is
//! always computed from its inner end to its outer end, so that two triangles which share the edge
//! get the same bits, whichever way round they run along it.

use super::projection::ClipPlane;

/// A corner of a clipped polygon: its place in clip space, and the weights of the triangle's three
/// corners there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ClipCorner {
    pub(super) position: [f64; 3],
    pub(super) weights: [f64; 3],
}

/// Most corners of a triangle cut by five planes: each adds at most one.
const MOST_CORNERS: usize = 8;

/// The part of a triangle inside all planes; `None` when the whole triangle is inside.
pub(super) fn clipped(points: [[f64; 3]; 3], planes: &[ClipPlane]) -> Option<Vec<ClipCorner>> {
    let is_inside = |plane: &ClipPlane| points.iter().all(|&point| plane.at(point) >= 0.0);
    if planes.iter().all(is_inside) {
        return None;
    }
    let mut polygon: Vec<ClipCorner> = (0..3)
        .map(|k| {
            let mut weights = [0.0; 3];
            weights[k] = 1.0;
            ClipCorner { position: points[k], weights }
        })
        .collect();
    let mut kept = Vec::with_capacity(MOST_CORNERS);
    for plane in planes {
        kept.clear();
        for (k, corner) in polygon.iter().enumerate() {
            let next = &polygon[(k + 1) % polygon.len()];
            let (here, there) = (plane.at(corner.position), plane.at(next.position));
            if here >= 0.0 {
                kept.push(*corner);
            }
            if here >= 0.0 && there < 0.0 {
                kept.push(cut(corner, here, next, there));
            } else if here < 0.0 && there >= 0.0 {
                kept.push(cut(next, there, corner, here));
            }
        }
        std::mem::swap(&mut polygon, &mut kept);
    }
    Some(polygon)
}

/// Where an edge leaves a plane that `inner` is `inside` of and `outer` `outside` (negative).
fn cut(inner: &ClipCorner, inside: f64, outer: &ClipCorner, outside: f64) -> ClipCorner {
    let share = inside / (inside - outside);
    let between = |a: [f64; 3], b: [f64; 3]| [0, 1, 2].map(|k| a[k] + share * (b[k] - a[k]));
    ClipCorner {
        position: between(inner.position, outer.position),
        weights: between(inner.weights, outer.weights),
    }
}
