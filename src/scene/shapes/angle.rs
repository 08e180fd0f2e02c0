//! Fractions of a turn and centred subdivisions of a length, exact where they can be.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_4};

/// Cosine and sine of `index / count` of a turn.
///
/// The angle is reduced by whole eighths in integers, so quarter turns give exactly 0 and ±1,
/// eighths give equal magnitudes, and points that mirror each other have the same digits.
/// No result is a negative zero. `count` is at least 1.
pub(super) fn turn(index: u32, count: u32) -> [f64; 2] {
    // Split the turn into eighths and a rest of rest / count eighths.
    let count = u64::from(count);
    let eighths = 8 * (u64::from(index) % count);
    let (octant, rest) = (eighths / count, eighths % count);

    // Measure from the nearest quarter turn: forwards in even octants, backwards in odd ones.
    let backwards = octant % 2 == 1;
    let quarter = octant.div_ceil(2) % 4;
    let away = if backwards { count - rest } else { rest };
    let angle = away as f64 / count as f64 * FRAC_PI_4;
    let (cosine, sine) = if away == count {
        (FRAC_1_SQRT_2, FRAC_1_SQRT_2)
    } else {
        (libm::cos(angle), libm::sin(angle))
    };
    let sine = if backwards { -sine } else { sine };

    // Turn by whole quarters; adding 0 makes every zero positive.
    let [x, y] = match quarter {
        0 => [cosine, sine],
        1 => [-sine, cosine],
        2 => [-cosine, -sine],
        _ => [sine, -cosine],
    };
    [x + 0.0, y + 0.0]
}

/// The direction at `index / count` of a turn about the y axis, counter-clockwise seen from above,
/// starting at +x: components x and z.
pub(super) fn heading(index: u32, count: u32) -> [f64; 2] {
    let [cosine, sine] = turn(index, count);
    [cosine, 0.0 - sine]
}

/// Point `index` of `count` equal steps over a length centred on 0; both ends and the middle are
/// exact and the halves mirror each other.
pub(super) fn centred(index: u32, count: u32, length: f64) -> f64 {
    let steps = 2 * i64::from(index) - i64::from(count);
    steps as f64 / f64::from(count) * (0.5 * length)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn quarter_turns_are_exact_and_mirrors_share_their_digits() {
        for count in [4, 8, 12, 48, 1000] {
            assert_eq!(turn(0, count), [1.0, 0.0]);
            assert_eq!(turn(count / 4, count), [0.0, 1.0]);
            assert_eq!(turn(count / 2, count), [-1.0, 0.0]);
            assert_eq!(turn(3 * count / 4, count), [0.0, -1.0]);
            for index in 0..=count {
                let [c, s] = turn(index, count);
                assert_eq!(turn(count - index, count), [c, 0.0 - s]);
                assert_eq!(turn(index + count / 4, count), [0.0 - s, c]);
                assert!(![c, s].iter().any(|v| *v == 0.0 && v.is_sign_negative()));
            }
        }
        assert_eq!(turn(1, 8), [FRAC_1_SQRT_2; 2]);
    }

    #[test]
    fn a_turn_is_near_its_definition() {
        // The naive argument carries up to 3 roundings of a number up to 2π, slope at most 1.
        const BOUND: f64 = 4.0 * f64::EPSILON * TAU;
        for count in [1, 3, 5, 7, 97] {
            for index in 0..=2 * count {
                let angle = TAU * f64::from(index % count) / f64::from(count);
                let [c, s] = turn(index, count);
                assert!((c - libm::cos(angle)).abs() <= BOUND, "{index}/{count}");
                assert!((s - libm::sin(angle)).abs() <= BOUND, "{index}/{count}");
            }
        }
    }

    #[test]
    fn centred_points_mirror_each_other() {
        for count in [1, 2, 3, 10, 49] {
            assert_eq!(centred(0, count, 0.7), -0.35);
            for index in 0..=count {
                assert_eq!(centred(index, count, 0.7), 0.0 - centred(count - index, count, 0.7));
            }
        }
    }
}
