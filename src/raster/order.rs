//! A tile's triangles from near to far, roughly: what lies behind is then mostly hidden before it is
//! set up.
//!
//! The order decides nothing but the time taken. Keys are the upper halves of f32, 128 steps per
//! octave, and a counting sort puts them into a few dozen classes.

/// Classes of distance.
const CLASSES: usize = 64;

/// Fewer triangles than this are left as they come.
const FEW: usize = 32;

/// The key of a least w: positive f32 are in the order of their bits. What has no certain w has key 0,
/// before everything.
#[inline(always)]
pub(super) fn key(least_w: f32) -> u16 {
    (least_w.to_bits() >> 16) as u16
}

/// A list of triangles with keys, and the same from near to far.
#[derive(Default)]
pub(super) struct Order {
    ids: Vec<u32>,
    keys: Vec<u16>,
    sorted: Vec<u32>,
    /// Class k is `sorted[ends[k − 1]..ends[k]]`, and no key in it is below `least + (k << shift)`.
    ends: Vec<u32>,
    least: u16,
    shift: u32,
}

impl Order {
    /// Forgets what was listed.
    pub(super) fn clear(&mut self) {
        self.ids.clear();
        self.keys.clear();
    }

    /// Lists triangles.
    pub(super) fn extend(&mut self, ids: &[u32], keys: &[u16]) {
        self.ids.extend_from_slice(ids);
        self.keys.extend_from_slice(keys);
    }

    /// Lists triangles that come first.
    pub(super) fn extend_first(&mut self, ids: &[u32]) {
        self.ids.extend_from_slice(ids);
        self.keys.resize(self.ids.len(), 0);
    }

    /// Leaves them in the order of ids, in one class.
    pub(super) fn keep(&mut self) {
        self.ids.sort_unstable();
        self.ends.clear();
        self.ends.push(self.ids.len() as u32);
        (self.least, self.shift) = (0, 0);
        std::mem::swap(&mut self.sorted, &mut self.ids);
    }

    /// Sorts them.
    pub(super) fn sort(&mut self) {
        let (least, most) = self
            .keys
            .iter()
            .fold((u16::MAX, 0), |(least, most), &key| (key.min(least), key.max(most)));
        self.ends.clear();
        if self.ids.len() < FEW || least >= most {
            (self.least, self.shift) = (0, 0);
            self.ends.push(self.ids.len() as u32);
            std::mem::swap(&mut self.sorted, &mut self.ids);
            return;
        }
        // The least shift that leaves `CLASSES` classes.
        let range = u32::from(most - least);
        let shift = (u32::BITS - range.leading_zeros()).saturating_sub(CLASSES.ilog2());
        let class = |key: u16| usize::from((key - least) >> shift) & (CLASSES - 1);
        let mut counts = [0_u32; CLASSES];
        for &key in &self.keys {
            counts[class(key)] += 1;
        }
        let mut next = 0;
        let mut starts = counts.map(|count| {
            next += count;
            next - count
        });
        self.sorted.clear();
        self.sorted.resize(self.ids.len(), 0);
        for (&id, &key) in self.ids.iter().zip(&self.keys) {
            let place = &mut starts[class(key)];
            self.sorted[*place as usize] = id;
            *place += 1;
        }
        self.ends.extend_from_slice(&starts);
        (self.least, self.shift) = (least, shift);
    }

    /// The triangles.
    pub(super) fn sorted(&self) -> &[u32] {
        &self.sorted
    }

    /// A bound below every w from a position of `sorted` on, for triangles that have a certain w;
    /// `class` is the class of an earlier position, 0 at first.
    pub(super) fn least_w(&self, position: usize, class: &mut usize) -> f32 {
        while self.ends.get(*class).is_some_and(|&end| end as usize <= position) {
            *class += 1;
        }
        f32::from_bits((u32::from(self.least) + ((*class as u32) << self.shift)) << 16)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn near_comes_before_far_and_nothing_is_nearer_than_its_bound() {
        let mut order = Order::default();
        for count in [0, 1, 31, 32, 33, 1000] {
            order.clear();
            let w = |id: u32| 0.5 + (id.wrapping_mul(2_654_435_761) >> 8) as f32 / 9999.0;
            for id in 0..count {
                order.extend(&[id], &[key(w(id))]);
            }
            order.extend_first(&[count]);
            order.sort();
            let sorted = order.sorted();
            assert_eq!(sorted.len(), count as usize + 1);
            let mut class = 0;
            let mut before = 0.0;
            for (position, _) in sorted.iter().enumerate() {
                let least = order.least_w(position, &mut class);
                assert!(least >= before);
                before = least;
                assert!(sorted[position..].iter().all(|&id| id == count || w(id) >= least));
            }
            let mut ids = sorted.to_vec();
            ids.sort_unstable();
            assert!(ids.into_iter().eq(0..=count));
            assert!(count < 32 || before > 0.5, "{before}");
        }
    }
}
