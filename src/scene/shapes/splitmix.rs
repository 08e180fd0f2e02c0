//! Numbers drawn by place: a hash of integers instead of a generator with a state, so that a value
//! depends on nothing but the seed and where it is asked for.
//!
//! The mixing step and its constants are those of SplitMix64 (Steele, Lea and Flood, "Fast
//! splittable pseudorandom number generators", OOPSLA 2014). No claim beyond looking irregular.

/// 2^64 divided by the golden ratio, odd.
const STEP: u64 = 0x9e37_79b9_7f4a_7c15;

/// 64 mixed bits of a seed and two integers.
pub(super) const fn hash(seed: u32, a: u64, b: u64) -> u64 {
    mix(mix(mix(seed as u64 ^ STEP) ^ a) ^ b)
}

/// A multiple of 2^-53 in 0…1, 1 excluded, of a seed and two integers.
pub(super) fn unit(seed: u32, a: u64, b: u64) -> f64 {
    const LAST_PLACE: f64 = 1.0 / (1_u64 << 53) as f64;
    (hash(seed, a, b) >> 11) as f64 * LAST_PLACE
}

const fn mix(state: u64) -> u64 {
    let state = state.wrapping_add(STEP);
    let state = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let state = (state ^ (state >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    state ^ (state >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mixing_step_is_that_of_the_published_generator() {
        // First outputs of SplitMix64 with the states 0 and 1234567.
        assert_eq!(mix(0), 0xe220_a839_7b1d_cdaf);
        assert_eq!(mix(1_234_567), 6_457_827_717_110_365_317);
    }

    #[test]
    fn units_fill_their_range_evenly() {
        // 10 000 draws into ten bins: 1000 each, standard deviation 30; five of them.
        const SPREAD: i64 = 150;
        let mut bins = [0_i64; 10];
        for index in 0..10_000 {
            let value = unit(7, index / 100, index % 100);
            assert!((0.0..1.0).contains(&value));
            bins[(value * 10.0) as usize] += 1;
        }
        assert!(bins.iter().all(|bin| (bin - 1000).abs() <= SPREAD), "{bins:?}");
    }
}
