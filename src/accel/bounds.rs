//! Axis-aligned boxes in f32. Minimum, maximum and union of f32 do not round: a box is exact.

/// A closed box; empty while `lo > hi`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bounds {
    pub(super) lo: [f32; 3],
    pub(super) hi: [f32; 3],
}

impl Bounds {
    pub(super) const EMPTY: Self = Self { lo: [f32::INFINITY; 3], hi: [f32::NEG_INFINITY; 3] };

    pub(super) fn of_triangle(vertices: &[[f32; 3]; 3]) -> Self {
        vertices
            .iter()
            .fold(Self::EMPTY, |bounds, &point| bounds.union(Self { lo: point, hi: point }))
    }

    pub(super) fn union(self, other: Self) -> Self {
        Self {
            lo: std::array::from_fn(|k| self.lo[k].min(other.lo[k])),
            hi: std::array::from_fn(|k| self.hi[k].max(other.hi[k])),
        }
    }

    pub(super) fn contains(self, other: Self) -> bool {
        (0..3).all(|k| self.lo[k] <= other.lo[k] && other.hi[k] <= self.hi[k])
    }

    /// Twice the centre, exact to f64 rounding.
    pub(super) fn center2(self) -> [f64; 3] {
        std::array::from_fn(|k| f64::from(self.lo[k]) + f64::from(self.hi[k]))
    }

    /// Sides in f64.
    pub(super) fn sides(self) -> [f64; 3] {
        std::array::from_fn(|k| f64::from(self.hi[k]) - f64::from(self.lo[k]))
    }

    /// Whether the box is a point or a segment along an axis. A triangle in such a box has no
    /// area, so V = 0 from every eye and no sample is ever covered by it.
    pub(super) fn is_thinner_than_a_face(self) -> bool {
        (0..3).filter(|&k| self.lo[k] == self.hi[k]).count() >= 2
    }
}
