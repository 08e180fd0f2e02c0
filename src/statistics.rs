//! A few times as numbers that one slow round does not move: median and median absolute deviation.
//!
//! The minimum stands beside them as the time of the least disturbed round. No mean, no standard
//! deviation: a machine that is busy for one round would own both. F. Hampel, "The influence curve
//! and its role in robust estimation" (1974).

use std::time::Duration;

/// A spread above this share of the median is called noise.
pub const NOISY_SPREAD: f64 = 0.05;

/// What is said about the times of a variant, in seconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Statistics {
    /// Number of times.
    pub n: usize,
    /// The median; of an even number of times the mean of the middle two.
    pub median: f64,
    /// The median absolute deviation from the median.
    pub deviation: f64,
    /// The smallest time.
    pub least: f64,
    /// The largest time.
    pub most: f64,
}

impl Statistics {
    /// Condenses times; `None` when there are none.
    pub fn of(times: &[Duration]) -> Option<Self> {
        let mut seconds: Vec<f64> = times.iter().map(Duration::as_secs_f64).collect();
        seconds.sort_unstable_by(f64::total_cmp);
        let (&least, &most) = seconds.first().zip(seconds.last())?;
        let median = middle(&seconds);
        let mut deviations: Vec<f64> = seconds.iter().map(|time| (time - median).abs()).collect();
        deviations.sort_unstable_by(f64::total_cmp);
        Some(Self { n: seconds.len(), median, deviation: middle(&deviations), least, most })
    }

    /// The deviation as a share of the median; 0 for times below the clock's resolution.
    pub fn spread(&self) -> f64 {
        if self.median > 0.0 { self.deviation / self.median } else { 0.0 }
    }

    /// Whether the times spread so far that small differences mean nothing.
    pub fn is_noisy(&self) -> bool {
        self.spread() > NOISY_SPREAD
    }

    /// `count` things in the median time, in millions a second; `None` for a median of 0.
    pub fn millions_per_second(&self, count: usize) -> Option<f64> {
        (self.median > 0.0).then(|| count as f64 / self.median / 1e6)
    }
}

/// The median of sorted numbers, at least one.
fn middle(sorted: &[f64]) -> f64 {
    let half = sorted.len() / 2;
    match sorted.len() % 2 {
        1 => sorted[half],
        _ => (sorted[half - 1] + sorted[half]) / 2.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Quarters of a second, exact in f64.
    fn quarters(counts: &[u64]) -> Vec<Duration> {
        counts.iter().map(|&count| Duration::from_millis(250 * count)).collect()
    }

    #[test]
    fn an_odd_number_of_times() {
        // Sorted 1 2 4 8 100; deviations from 4: 0 2 3 4 96.
        let of = Statistics::of(&quarters(&[100, 2, 4, 1, 8])).unwrap();
        assert_eq!((of.n, of.median, of.deviation), (5, 1.0, 0.75));
        assert_eq!((of.least, of.most, of.spread()), (0.25, 25.0, 0.75));
        assert!(of.is_noisy());
        assert_eq!(of.millions_per_second(2_000_000), Some(2.0));
    }

    #[test]
    fn an_even_number_of_times() {
        // Sorted 2 4 6 20, median 5; deviations 3 1 1 15, sorted 1 1 3 15, median 2.
        let of = Statistics::of(&quarters(&[20, 6, 2, 4])).unwrap();
        assert_eq!((of.n, of.median, of.deviation), (4, 1.25, 0.5));
    }

    #[test]
    fn noise_begins_above_a_twentieth() {
        let at = |spread| Statistics {
            n: 9,
            median: 2.0,
            deviation: 2.0 * spread,
            least: 1.0,
            most: 3.0,
        };
        assert!(!at(0.05).is_noisy());
        assert!(at(0.0501).is_noisy());
    }

    #[test]
    fn no_time_says_nothing() {
        assert_eq!(Statistics::of(&[]), None);
        let zero = Statistics::of(&[Duration::ZERO]).unwrap();
        assert_eq!((zero.spread(), zero.millions_per_second(7)), (0.0, None));
    }
}
