//! The codes of f32, which is what pictures hold: without a branch, so that many are looked up at once.
//!
//! Intervals that share their leading bits hold one threshold at most: the code of an interval's lower
//! end is right or one too low, and one comparison tells. Thresholds are rounded up to f32: no f32 lies
//! between the two.

use super::srgb_thresholds::THRESHOLDS;

/// Leading bits of the fraction that tell intervals apart. Thresholds near 1 are 0.0087 apart, the
/// intervals there 2^-9 wide; near 0 they are 2.6 times as far apart, beside their value, as at 1.
const FRACTION_BITS: u32 = 8;

/// Bits of an f32 that are the same within an interval.
const SHIFT: u32 = 23 - FRACTION_BITS;

/// Lower end of the first interval, below the first threshold.
const FIRST: f32 = 1.0 / 8192.0;

/// Number of intervals up to 1.
const INTERVALS: usize = interval(1.0) + 1;

/// The code at each interval's lower end.
static CODES: [u8; INTERVALS] = {
    let mut codes = [0; INTERVALS];
    let mut code = 0;
    let mut position = 0;
    while position < INTERVALS {
        let before = code;
        while code < THRESHOLDS.len() && STEPS[code] <= lower_end(position) {
            code += 1;
        }
        assert!(code <= before + 1 || position == 0, "two thresholds in one interval");
        codes[position] = code as u8;
        position += 1;
    }
    codes
};

/// The least f32 of each code but 0; nothing has a code above 255.
static STEPS: [f32; 256] = {
    let mut steps = [f32::INFINITY; 256];
    let mut code = 0;
    while code < THRESHOLDS.len() {
        let nearest = THRESHOLDS[code] as f32;
        steps[code] = if (nearest as f64) < THRESHOLDS[code] { nearest.next_up() } else { nearest };
        code += 1;
    }
    steps
};

const fn interval(linear: f32) -> usize {
    ((linear.to_bits() >> SHIFT) - (FIRST.to_bits() >> SHIFT)) as usize
}

const fn lower_end(interval: usize) -> f32 {
    f32::from_bits((interval as u32 + (FIRST.to_bits() >> SHIFT)) << SHIFT)
}

/// How many thresholds are at or below a number; 0 for NaN.
#[inline]
pub(super) fn count_thresholds(linear: f32) -> u8 {
    // NaN gives the first.
    let linear = FIRST.max(linear).min(1.0);
    let code = CODES[interval(linear).min(INTERVALS - 1)];
    code + u8::from(STEPS[usize::from(code)] <= linear)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::srgb_buckets;

    #[test]
    fn singles_have_the_codes_of_doubles() {
        let near = |linear: f32| [linear.next_down(), linear, linear.next_up()];
        let ends = (0..INTERVALS).map(lower_end);
        let odd = [0.0, -0.0, -1.0, 2.0, f32::MAX, f32::INFINITY, f32::NEG_INFINITY, 1e-40];
        let steps = THRESHOLDS.into_iter().map(|threshold| threshold as f32);
        for linear in steps.chain(ends).flat_map(near).chain(odd).chain([f32::NAN]) {
            let code = srgb_buckets::count_thresholds(f64::from(linear));
            assert_eq!(count_thresholds(linear), code, "{linear}");
        }
    }
}
