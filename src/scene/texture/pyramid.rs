//! The smaller levels of a texture: each the area means of the one before, in linear light.
//!
//! A level of w texels is followed by one of max(1, ⌊w/2⌋), along each axis by itself. Texel i of
//! the smaller one covers [i, i + 1)·w/w′ of the larger one, and its value is the mean over exactly
//! that area: two texels where w is even; three where w = 2w′ + 1 is odd, the first and the last in
//! part, with weights (w′ − i, w′, i + 1)/w. So the mean of the whole is the same in every level.
//! Guthe and Heckbert, "Non-power-of-two mipmap creation", NVIDIA TR-01838-001, 2005.

use super::Level;

/// A level and everything smaller.
pub(super) fn levels(base: &Level) -> Vec<Level> {
    let mut levels = vec![base.clone()];
    while let Some(smaller) = levels.last().and_then(halved) {
        levels.push(smaller);
    }
    levels
}

/// The next smaller level; `None` where there is only one texel.
fn halved(level: &Level) -> Option<Level> {
    let (width, height) = (level.width, level.height);
    if (width, height) == (1, 1) {
        return None;
    }
    let (half_width, half_height) = ((width / 2).max(1), (height / 2).max(1));
    let mut texels = Vec::with_capacity(half_width as usize * half_height as usize);
    // The weights' sum is the area in texels, an integer; sums of integers times f32 are nearly
    // exact in f64, so equal texels keep their value through the one rounding to f32.
    let area = f64::from(width_of_cover(width)) * f64::from(width_of_cover(height));
    for row in 0..half_height {
        for column in 0..half_width {
            let mut sum = [0.0; 3];
            for (j, weight_v) in cover(row, height) {
                for (i, weight_u) in cover(column, width) {
                    let texel = level.texel(i, j);
                    let weight = weight_u * weight_v;
                    sum = std::array::from_fn(|channel| sum[channel] + weight * texel[channel]);
                }
            }
            texels.push(sum.map(|total| (total / area) as f32));
        }
    }
    Level::new(half_width, half_height, texels)
}

/// Which of `length` texels texel `index` of the next smaller level covers, and their weights.
fn cover(index: u32, length: u32) -> impl Iterator<Item = (u32, f64)> {
    let half = length / 2;
    let weights = match length {
        1 => [1, 0, 0],
        _ if length.is_multiple_of(2) => [1, 1, 0],
        _ => [half - index, half, index + 1],
    };
    let covered = weights.into_iter().enumerate().filter(|(_, weight)| *weight > 0);
    covered.map(move |(step, weight)| (2 * index + step as u32, f64::from(weight)))
}

/// The sum of the weights.
fn width_of_cover(length: u32) -> u32 {
    match length {
        1 => 1,
        _ if length.is_multiple_of(2) => 2,
        _ => length,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn level(width: u32, height: u32, value: impl Fn(u32, u32) -> f32) -> Level {
        let texels = (0..height).flat_map(|j| (0..width).map(move |i| (i, j)));
        let texels = texels.map(|(i, j)| [value(i, j), 1.0 - value(i, j), 0.25]).collect();
        Level::new(width, height, texels).unwrap()
    }

    fn mean(level: &Level) -> f64 {
        let sum: f64 = level.texels().iter().map(|texel| f64::from(texel[0])).sum();
        sum / level.texels().len() as f64
    }

    #[test]
    fn four_texels_become_their_mean() {
        let made = levels(&level(2, 2, |i, j| [[0.0, 1.0], [0.5, 0.25]][j as usize][i as usize]));
        assert_eq!(made.len(), 2);
        assert_eq!(made[1].texels(), [[0.4375, 0.5625, 0.25]]);
    }

    #[test]
    fn odd_sides_weigh_the_middle_by_area() {
        // Five texels become two: (2a + 2b + c)/5 and (c + 2d + 2e)/5, here without rounding.
        let made = levels(&level(5, 1, |i, _| [1.0, 0.5, 0.125, 0.0, 0.25][i as usize]));
        let sizes: Vec<_> = made.iter().map(|level| (level.width(), level.height())).collect();
        assert_eq!(sizes, [(5, 1), (2, 1), (1, 1)]);
        assert_eq!(made[1].texels().iter().map(|t| t[0]).collect::<Vec<_>>(), [0.625, 0.125]);
        assert_eq!(made[2].texels()[0][0], 0.375);
        // Three become one: each a third.
        let made = levels(&level(1, 3, |_, j| [0.75, 0.0, 0.0][j as usize]));
        assert_eq!(made[1].texels()[0][0], 0.25);
    }

    proptest! {
        #[test]
        fn the_mean_stays_and_one_colour_stays(
            width in 1_u32..40,
            height in 1_u32..40,
            seed in 0_u32..1000,
        ) {
            let noise = |i: u32, j: u32| {
                let bits = (seed + i * 7919 + j * 104_729).wrapping_mul(2_654_435_761);
                (bits >> 8) as f32 / (1 << 24) as f32
            };
            let made = levels(&level(width, height, noise));
            let last = made.last().unwrap();
            prop_assert_eq!((last.width(), last.height()), (1, 1));
            for smaller in &made {
                // At most five roundings to f32, each half of 2^-24 of a value below 1, and as
                // much again for the sums.
                prop_assert!((mean(smaller) - mean(&made[0])).abs() <= 10.0 * 2.0_f64.powi(-25));
            }
            let grey = 1.0 / (seed + 3) as f32;
            let constant = levels(&level(width, height, |_, _| grey));
            let first = constant[0].texels()[0];
            prop_assert!(constant.iter().all(|l| l.texels().iter().all(|&t| t == first)));
        }
    }
}
