//! Pairs of triangles that lie in one plane: asked of exact arithmetic once, not at every pixel.
//!
//! A small table per tile, each pair with one place in it, and behind it one set for the whole
//! picture. A pair that both have lost is asked again: memory changes the work, never an answer.

use crate::mesh::TriangleId;
use std::collections::HashSet;
use std::sync::{Mutex, PoisonError};

/// Places in a tile's table; 32 × 32 pixels seldom show more pairs than a few dozen.
const PLACES: usize = 256;

/// Most pairs of a picture, about a megabyte: thousands of sheets in one plane have millions.
const MOST_PAIRS: usize = 1 << 16;

/// A triangle's corners, as the mesh has them.
type Corners = [[f32; 3]; 3];

/// Lower id first.
type Pair = [TriangleId; 2];

/// The pairs of a picture, shared by its tiles.
#[derive(Debug, Default)]
pub(super) struct PicturePairs(Mutex<HashSet<Pair>>);

/// The pairs of a tile.
#[derive(Clone, Debug)]
pub(super) struct SamePlane<'a> {
    table: Vec<Option<Pair>>,
    picture: &'a PicturePairs,
}

impl<'a> SamePlane<'a> {
    /// Nothing is known but what `picture` knows.
    pub(super) const fn new(picture: &'a PicturePairs) -> Self {
        Self { table: Vec::new(), picture }
    }

    /// Whether this tile knows that the two lie in one plane.
    pub(super) fn knows(&self, a: TriangleId, b: TriangleId) -> bool {
        let pair = ordered(a, b);
        self.table.get(place(pair)).is_some_and(|known| *known == Some(pair))
    }

    /// Whether the corners show it at a glance, or another tile knew it, which takes a lock: asked only
    /// before exact arithmetic, and remembered.
    pub(super) fn learns(&mut self, [a, b]: [TriangleId; 2], corners: [&Corners; 2]) -> bool {
        let is_known = lie_across_an_axis(corners) || self.picture.pairs().contains(&ordered(a, b));
        if is_known {
            self.keep(ordered(a, b));
        }
        is_known
    }

    /// Remembers that the two lie in one plane.
    pub(super) fn remember(&mut self, a: TriangleId, b: TriangleId) {
        self.keep(ordered(a, b));
        let mut pairs = self.picture.pairs();
        if pairs.len() < MOST_PAIRS {
            pairs.insert(ordered(a, b));
        }
    }

    fn keep(&mut self, pair: Pair) {
        if self.table.is_empty() {
            self.table = vec![None; PLACES];
        }
        self.table[place(pair)] = Some(pair);
    }
}

impl PicturePairs {
    /// A set is whole after every insertion, whoever panicked meanwhile.
    fn pairs(&self) -> impl std::ops::DerefMut<Target = HashSet<Pair>> + '_ {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Whether one coordinate of all six corners is the same, which is proof of one plane; most panels that
/// lie in one are built so.
fn lie_across_an_axis([a, b]: [&Corners; 2]) -> bool {
    (0..3).any(|axis| a.iter().chain(b).all(|corner| corner[axis] == a[0][axis]))
}

fn ordered(a: TriangleId, b: TriangleId) -> Pair {
    [a.min(b), a.max(b)]
}

/// The high bits of a product with 2^64 over the golden ratio (Fibonacci hashing).
fn place([lower, upper]: Pair) -> usize {
    let key = u64::from(lower.get()) << 32 | u64::from(upper.get());
    (key.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 56) as usize % PLACES
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Corners that show nothing.
    const APART: [Corners; 2] = [
        [[0.0, 1.0, 2.0], [1.0, 2.0, 0.0], [2.0, 0.0, 1.0]],
        [[3.0, 4.0, 5.0], [4.0, 5.0, 3.0], [5.0, 3.0, 4.0]],
    ];

    #[test]
    fn six_equal_coordinates_are_one_plane_and_five_are_not() {
        let id = TriangleId::new;
        let picture = PicturePairs::default();
        let mut memo = SamePlane::new(&picture);
        let across = |axis: usize| {
            APART.map(|corners| {
                corners.map(|mut corner| {
                    corner[axis] = 0.5;
                    corner
                })
            })
        };
        for axis in 0..3 {
            let [a, mut b] = across(axis);
            let ids = [id(axis as u32), id(7)];
            b[2][axis] = 0.5_f32.next_up();
            assert!(!memo.learns(ids, [&a, &b]) && !memo.knows(ids[0], ids[1]));
            b[2][axis] = 0.5;
            assert!(memo.learns(ids, [&a, &b]) && memo.knows(ids[0], ids[1]));
        }
    }

    #[test]
    fn pairs_are_unordered_and_tiles_learn_from_each_other() {
        let id = TriangleId::new;
        let picture = PicturePairs::default();
        let [mut one, mut two] = [SamePlane::new(&picture), SamePlane::new(&picture)];
        assert!(!one.knows(id(0), id(1)) && !one.learns([id(0), id(1)], [&APART[0], &APART[1]]));
        one.remember(id(7), id(3));
        assert!(one.knows(id(3), id(7)) && one.knows(id(7), id(3)));
        assert!(!two.knows(id(7), id(3)));
        assert!(two.learns([id(7), id(3)], [&APART[0], &APART[1]]) && two.knows(id(3), id(7)));
        assert!(!two.learns([id(7), id(8)], [&APART[0], &APART[1]]));
    }

    #[test]
    fn a_lost_place_is_not_a_wrong_answer_and_memory_is_bounded() {
        let id = TriangleId::new;
        let picture = PicturePairs::default();
        let mut memo = SamePlane::new(&picture);
        memo.remember(id(3), id(7));
        for other in 10..100_000 {
            memo.remember(id(1), id(other));
            assert!(memo.knows(id(other), id(1)));
        }
        assert!(!memo.knows(id(1), id(9)) && !memo.learns([id(1), id(9)], [&APART[0], &APART[1]]));
        assert!(!memo.knows(id(3), id(7)), "its place was taken many times");
        assert!(memo.learns([id(3), id(7)], [&APART[0], &APART[1]]));
        assert_eq!(picture.pairs().len(), MOST_PAIRS);
    }
}
