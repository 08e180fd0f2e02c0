//! Every answer at a sample that is right under some tie rule, not only under ours.
//!
//! A tie rule is either *closed* (an edge belongs to both of its triangles, and the nearest that
//! touches wins) or moves the sample by infinitely little in some direction, as ours does. The
//! directions fall into sectors between the edges that pass through the sample, and the answer is
//! the same all over a sector. So a gap that a program leaves on an edge inside a mesh is no tie:
//! every sector around it is covered.

use super::contact::{Contact, Ray};
use super::rational::sign;
use crate::mesh::TriangleId;
use dashu_ratio::Relaxed;
use std::cmp::Ordering;

/// What may be seen at a sample under some tie rule.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TieAnswers {
    /// Triangles, in the order of ids.
    pub triangles: Vec<TriangleId>,
    /// Whether nothing may be visible.
    pub nothing: bool,
}

/// A direction in the image plane, exact: right and down.
type Direction = [Relaxed; 2];

/// The answers over all tie rules, from the triangles that touch the sample.
pub(super) fn answers(contacts: &[Contact], ray: &Ray) -> TieAnswers {
    // The closed rule: whatever touches, covers.
    let all: Vec<&Contact> = contacts.iter().collect();
    let mut triangles = nearest(&all);
    let mut nothing = contacts.is_empty();
    // The moved samples: one for each sector.
    let edges: Vec<Vec<Direction>> = contacts.iter().map(|contact| contact.boundary(ray)).collect();
    for direction in sector_directions(edges.iter().flatten()) {
        let covering: Vec<&Contact> = contacts
            .iter()
            .zip(&edges)
            .filter(|(_, edges)| edges.iter().all(|edge| sign(&dot(edge, &direction)) > 0))
            .map(|(contact, _)| contact)
            .collect();
        nothing |= covering.is_empty();
        triangles.extend(nearest(&covering));
    }
    triangles.sort_unstable();
    triangles.dedup();
    TieAnswers { triangles, nothing }
}

/// All contacts that are as deep as the nearest.
fn nearest(contacts: &[&Contact]) -> Vec<TriangleId> {
    let Some(first) = contacts.iter().min_by(|a, b| a.depth_order(b)) else { return Vec::new() };
    contacts.iter().filter(|c| c.is_as_deep_as(first)).map(|c| c.triangle).collect()
}

/// One direction strictly inside each sector between the lines on which `edges` (gradients of edge
/// functions that are 0 at the sample) vanish; none without edges, where the closed rule says all.
fn sector_directions<'a>(edges: impl Iterator<Item = &'a Direction>) -> Vec<Direction> {
    // Both ends of every line, by angle.
    let mut rays: Vec<Direction> =
        edges.flat_map(|[a, b]| [[-b.clone(), a.clone()], [b.clone(), -a.clone()]]).collect();
    rays.sort_by(by_angle);
    rays.dedup_by(|a, b| by_angle(a, b).is_eq());
    // Opposite ends are both there, so no gap is wider than half a turn.
    (0..rays.len())
        .map(|i| {
            let ([px, py], [qx, qy]) = (&rays[i], &rays[(i + 1) % rays.len()]);
            match sign(&(px * qy - py * qx)) {
                // Half a turn: a quarter turn from its beginning lies inside.
                0 => [-py.clone(), px.clone()],
                // Less: a sum of both with positive weights lies inside.
                _ => [px + qx, py + qy],
            }
        })
        .collect()
}

/// Order by angle from the positive x axis, a full turn.
fn by_angle(p: &Direction, q: &Direction) -> Ordering {
    let half = |[x, y]: &Direction| match (sign(y), sign(x)) {
        (1, _) | (0, 1) => 0,
        _ => 1,
    };
    let turn = || sign(&(&p[0] * &q[1] - &p[1] * &q[0]));
    half(p).cmp(&half(q)).then_with(|| 0.cmp(&turn()))
}

fn dot(a: &Direction, b: &Direction) -> Relaxed {
    &a[0] * &b[0] + &a[1] * &b[1]
}
