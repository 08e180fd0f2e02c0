//! Ear clipping in the plane, beginning at corner 0.
//!
//! The walk keeps its place after a cut, so that a convex run becomes a fan. Corners that repeat a
//! position, as the bridges of polygons with holes do, do not block ears at that position.

use super::{STRAIGHT, Triangle, turn};

/// How strictly a corner must be an ear.
#[derive(Clone, Copy, PartialEq)]
enum Rule {
    /// A left turn, and nothing inside the ear or on its rim.
    Clear = 0,
    /// Straight is enough, and other corners may lie on the rim.
    Touching = 1,
}

/// What is left of the polygon, as a ring of corners.
struct Ring<'a> {
    plane: &'a [[f64; 2]],
    next: Vec<u32>,
    previous: Vec<u32>,
    /// Corners that turned right at the start and are still there: only these lie in others' ears.
    reflex: Vec<u32>,
    /// Per corner and rule: known to be no ear until a neighbour goes.
    refused: Vec<[bool; 2]>,
}

/// Appends triangles that cover the polygon (counter-clockwise, at least 3 corners); false, with
/// some triangles appended, when it is not simple.
pub(super) fn clip(plane: &[[f64; 2]], triangles: &mut Vec<Triangle>) -> bool {
    let count = plane.len() as u32;
    let mut ring = Ring {
        plane,
        next: (0..count).map(|i| (i + 1) % count).collect(),
        previous: (0..count).map(|i| (i + count - 1) % count).collect(),
        reflex: Vec::new(),
        refused: vec![[false; 2]; plane.len()],
    };
    ring.reflex = (0..count).filter(|&corner| ring.turn_at(corner) < -STRAIGHT).collect();
    let mut anchor = 0;
    let mut rule = Rule::Clear;
    let mut misses = 0;
    for left in (4..=count).rev() {
        // Find the next ear; once around without one, look for a touching one.
        loop {
            let tip = ring.next[anchor as usize];
            if ring.is_ear(tip, rule) {
                break;
            }
            anchor = tip;
            misses += 1;
            if misses == left {
                if rule == Rule::Touching {
                    return false;
                }
                rule = Rule::Touching;
                misses = 0;
            }
        }
        // Cut it off.
        let tip = ring.next[anchor as usize];
        triangles.push([anchor, tip, ring.next[tip as usize]]);
        ring.remove(tip);
        rule = Rule::Clear;
        misses = 0;
    }
    let tip = ring.next[anchor as usize];
    triangles.push([anchor, tip, ring.next[tip as usize]]);
    // The cuts keep the signed area, so a crossing shows as a last triangle turned over.
    ring.turn_at(tip) >= -STRAIGHT
}

impl Ring<'_> {
    fn corners_at(&self, tip: u32) -> [u32; 3] {
        [self.previous[tip as usize], tip, self.next[tip as usize]]
    }

    fn turn_at(&self, tip: u32) -> f64 {
        let [a, b, c] = self.corners_at(tip).map(|corner| self.plane[corner as usize]);
        turn(a, b, c)
    }

    fn is_ear(&mut self, tip: u32, rule: Rule) -> bool {
        if self.refused[tip as usize][rule as usize] {
            return false;
        }
        let turns = match rule {
            Rule::Clear => self.turn_at(tip) > STRAIGHT,
            Rule::Touching => self.turn_at(tip) >= -STRAIGHT,
        };
        let is_ear = turns && !self.reflex.iter().any(|&corner| self.blocks(corner, tip, rule));
        self.refused[tip as usize][rule as usize] = !is_ear;
        is_ear
    }

    /// Whether a corner lies in the ear at `tip`, or on its rim where the rule forbids that.
    fn blocks(&self, corner: u32, tip: u32, rule: Rule) -> bool {
        let p = self.plane[corner as usize];
        let ear = self.corners_at(tip).map(|corner| self.plane[corner as usize]);
        if ear.contains(&p) {
            return false;
        }
        let [a, b, c] = ear;
        let smallest = turn(a, b, p).min(turn(b, c, p)).min(turn(c, a, p));
        match rule {
            Rule::Clear => smallest >= -STRAIGHT,
            Rule::Touching => smallest > STRAIGHT,
        }
    }

    fn remove(&mut self, tip: u32) {
        let [before, _, after] = self.corners_at(tip);
        self.next[before as usize] = after;
        self.previous[after as usize] = before;
        self.refused[before as usize] = [false; 2];
        self.refused[after as usize] = [false; 2];
        if let Some(position) = self.reflex.iter().position(|&corner| corner == tip) {
            self.reflex.swap_remove(position);
        }
    }
}
