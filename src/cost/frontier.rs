//! Which settings are worth their price: those that no other one beats in time and in error.

use super::{Measure, Setting};

/// Marks every setting than which no other is at most as slow and at most as wrong, and less in one
/// of both.
pub(super) fn mark_frontier(settings: &mut [Setting], measure: Measure) {
    let figures: Vec<[f64; 2]> =
        settings.iter().map(|s| [s.times.median, measure.of(&s.errors)]).collect();
    for (setting, own) in settings.iter_mut().zip(&figures) {
        let beats = |other: &[f64; 2]| {
            other[0] <= own[0] && other[1] <= own[1] && (other[0] < own[0] || other[1] < own[1])
        };
        setting.is_on_frontier = !figures.iter().any(beats);
    }
}

#[cfg(test)]
mod tests {
    use super::super::Errors;
    use super::*;
    use crate::statistics::Statistics;
    use std::time::Duration;

    #[test]
    fn what_is_slower_and_no_better_is_beaten() {
        let setting = |milliseconds: u64, wrong_pixels: usize| Setting {
            name: String::new(),
            family: "",
            triangles: 1,
            times: Statistics::of(&[Duration::from_millis(milliseconds)]).unwrap(),
            baseline: String::new(),
            ratio: 1.0,
            errors: Errors { wrong_pixels, ..Errors::default() },
            is_on_frontier: false,
        };
        let mut settings =
            [setting(10, 0), setting(4, 9), setting(12, 0), setting(5, 9), setting(4, 9)];
        mark_frontier(&mut settings, Measure::WrongPixels);
        let marked: Vec<bool> = settings.iter().map(|s| s.is_on_frontier).collect();
        // Equals do not beat each other.
        assert_eq!(marked, [true, true, false, false, true]);
    }
}
