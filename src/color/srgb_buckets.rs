//! Where to begin among the thresholds of sRGB codes: intervals of f64 that share their leading bits.
//!
//! A search among 255 thresholds takes eight steps that wait for each other; of an interval, one look
//! tells the code of its lower end, and few thresholds are left.

use super::srgb_thresholds::THRESHOLDS;

/// Leading bits of the fraction that tell intervals apart. Thresholds near 1 are 0.0087 apart, the
/// intervals there 2^-7 wide.
const FRACTION_BITS: u32 = 6;

/// Bits of a f64 that are the same within an interval.
const SHIFT: u32 = 52 - FRACTION_BITS;

/// Lower end of the first interval, below the first threshold.
const FIRST: f64 = 1.0 / 8192.0;

/// Number of intervals up to 1.
const INTERVALS: usize = interval(1.0);

/// The code at each interval's lower end.
const CODES: [u8; INTERVALS] = {
    let mut codes = [0; INTERVALS];
    let mut code = 0;
    let mut position = 0;
    while position < INTERVALS {
        while code < THRESHOLDS.len() && THRESHOLDS[code] <= lower_end(position) {
            code += 1;
        }
        codes[position] = code as u8;
        position += 1;
    }
    codes
};

/// Most thresholds that lie within an interval, beyond its lower end.
const MOST: usize = {
    let mut most = 0;
    let mut position = 0;
    while position < INTERVALS {
        let next =
            if position + 1 < INTERVALS { CODES[position + 1] as usize } else { THRESHOLDS.len() };
        if next - CODES[position] as usize > most {
            most = next - CODES[position] as usize;
        }
        position += 1;
    }
    most
};

const fn interval(linear: f64) -> usize {
    ((linear.to_bits() >> SHIFT) - (FIRST.to_bits() >> SHIFT)) as usize
}

const fn lower_end(interval: usize) -> f64 {
    f64::from_bits((interval as u64 + (FIRST.to_bits() >> SHIFT)) << SHIFT)
}

/// How many thresholds are at or below a number.
#[inline]
pub(super) fn count_thresholds(linear: f64) -> u8 {
    if linear >= 1.0 {
        return u8::MAX;
    }
    if linear.is_nan() || linear < FIRST {
        return 0;
    }
    let code = CODES[interval(linear)];
    let above = (0..MOST).filter(|&step| {
        THRESHOLDS.get(usize::from(code) + step).is_some_and(|&threshold| threshold <= linear)
    });
    code + above.count() as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counting_is_searching() {
        let search =
            |linear: f64| THRESHOLDS.partition_point(|&threshold| threshold <= linear) as u8;
        let near = |linear: f64| [linear.next_down(), linear, linear.next_up()];
        let ends = (0..INTERVALS).map(lower_end);
        let odd = [0.0, -0.0, -1.0, 1.0, 2.0, f64::INFINITY, f64::NEG_INFINITY, f64::NAN, 1e-300];
        for linear in THRESHOLDS.into_iter().chain(ends).flat_map(near).chain(odd) {
            assert_eq!(count_thresholds(linear), search(linear), "{linear}");
        }
        const { assert!(MOST <= 2) };
    }
}
