//! Runs of neighbouring pixels, and the boxes around their surface points that lights are held
//! against; see `lanes::cones` for which lights certainly miss one.

/// Pixels of a run: long enough that the test per light costs little, short enough that a run's
/// surface points lie close together.
pub(super) const RUN: usize = 32;

/// A box around surface points.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    pub(super) low: [f64; 3],
    pub(super) high: [f64; 3],
}

impl Bounds {
    pub(super) const EMPTY: Self = Self { low: [f64::INFINITY; 3], high: [f64::NEG_INFINITY; 3] };

    pub(super) fn add(&mut self, point: [f64; 3]) {
        self.low = std::array::from_fn(|k| self.low[k].min(point[k]));
        self.high = std::array::from_fn(|k| self.high[k].max(point[k]));
    }
}
