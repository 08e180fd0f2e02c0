//! Proves both sRGB tables in rational arithmetic: x ≥ r^(12/5) is x⁵ ≥ r¹² for x, r > 0, which
//! needs no root and no rounding.

use super::srgb_thresholds::THRESHOLDS;
use super::*;
use dashu_int::{IBig, UBig};
use dashu_ratio::RBig;

fn fraction(numerator: i64, denominator: u64) -> RBig {
    RBig::from_parts(IBig::from(numerator), UBig::from(denominator))
}

fn rational(value: f64) -> RBig {
    RBig::try_from(value).unwrap()
}

/// Whether `linear` ≥ EOTF(`encoded`), for linear ≥ 0 and encoded ≥ 0.
fn reaches(linear: &RBig, encoded: &RBig) -> bool {
    if *encoded <= fraction(4045, 100_000) {
        return *linear >= encoded / fraction(1292, 100);
    }
    let base = (encoded + fraction(55, 1000)) / fraction(1055, 1000);
    linear.pow(5) >= base.pow(12)
}

#[test]
fn every_threshold_is_the_least_f64_at_or_above_the_true_step() {
    for (index, &threshold) in THRESHOLDS.iter().enumerate() {
        // (k − ½)/255 = (2k − 1)/510 with k = index + 1.
        let step = fraction(2 * index as i64 + 1, 510);
        assert!(reaches(&rational(threshold), &step), "threshold {} is too low", index + 1);
        let below = rational(threshold.next_down());
        assert!(!reaches(&below, &step), "threshold {} is too high", index + 1);
    }
}

#[test]
fn every_level_is_the_f64_nearest_to_the_true_value() {
    assert_eq!(LEVELS[0], 0.0);
    assert_eq!(LEVELS[255], 1.0);
    for code in 1..255_u8 {
        let level = LEVELS[usize::from(code)];
        let encoded = fraction(i64::from(code), 255);
        let half = fraction(1, 2);
        let middle_below = (rational(level.next_down()) + rational(level)) * &half;
        let middle_above = (rational(level.next_up()) + rational(level)) * &half;
        assert!(!reaches(&middle_below, &encoded), "level {code} is too high");
        assert!(reaches(&middle_above, &encoded), "level {code} is too low");
    }
}

#[test]
fn codes_step_exactly_at_the_thresholds() {
    for (index, &threshold) in THRESHOLDS.iter().enumerate() {
        assert_eq!(usize::from(srgb_code(threshold)), index + 1);
        assert_eq!(usize::from(srgb_code(threshold.next_down())), index);
    }
}

#[test]
fn codes_and_levels_are_inverse() {
    for code in 0..=255 {
        assert_eq!(srgb_code(srgb_decode(code)), code);
    }
}

#[test]
fn values_outside_the_unit_interval_end_at_its_ends() {
    for low in [-0.0, -1e-9, -1.0, f64::MIN, f64::NEG_INFINITY, 5e-324] {
        assert_eq!(srgb_code(low), 0);
    }
    for high in [1.0, 1.0_f64.next_up(), 1e30, f64::MAX, f64::INFINITY] {
        assert_eq!(srgb_code(high), 255);
    }
}

#[test]
fn sixteen_bit_codes_lie_on_the_curve_of_the_eight_bit_ones() {
    for code in 0..=255_u8 {
        let level = srgb_decode(code);
        let deep = srgb_decode_16(257 * u16::from(code));
        // Four units of the last place: the argument of pow is off by one, times 2.4, and pow by one.
        assert!((deep - level).abs() <= 4.0 * f64::EPSILON * level, "{code}");
    }
    for code in 1..=u16::MAX {
        assert!(srgb_decode_16(code - 1) < srgb_decode_16(code), "{code}");
    }
}
