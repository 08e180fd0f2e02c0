//! Streams are read back by a decoder that shares nothing with the encoder.

use super::*;
use std::io::Read as _;

const NEAR: [usize; DISTANCES] = [2, 5, 12, 300];

fn assert_comes_back(bytes: &[u8], distances: [usize; DISTANCES]) -> usize {
    let mut room = Room::default();
    let stream = zlib(bytes, distances, &mut room).to_vec();
    let mut back = Vec::new();
    flate2::read::ZlibDecoder::new(&stream[..]).read_to_end(&mut back).unwrap();
    assert!(back == bytes, "{} bytes, {distances:?}", bytes.len());
    // What the room held before does not show.
    room.out.fill(0xa5);
    assert!(zlib(bytes, distances, &mut room) == stream, "{} bytes", bytes.len());
    stream.len()
}

/// Bytes without any order (xorshift64).
fn noise(count: usize) -> Vec<u8> {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    let step = |_| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 56) as u8
    };
    (0..count).map(step).collect()
}

#[test]
fn every_length_comes_back() {
    let noise = noise(3 * BLOCK + 1);
    for count in (0..600).chain([BLOCK - 1, BLOCK, BLOCK + 1, 2 * BLOCK, 3 * BLOCK + 1]) {
        assert_comes_back(&vec![7; count], NEAR);
        assert_comes_back(&noise[..count], NEAR);
        let bytes: Vec<u8> = (0..count).map(|i| noise[i % 300] & 31).collect();
        assert_comes_back(&bytes, NEAR);
    }
}

#[test]
fn noise_is_stored_and_repeats_are_found_at_every_distance() {
    let count = 100_000;
    let stored = assert_comes_back(&noise(count), NEAR);
    assert!((count..count + 50).contains(&stored), "{stored}");
    for distance in [1, 2, 3, 4, 5, 6, 7, 24, 25, 257, 4096, 4097, FARTHEST - 1, FARTHEST] {
        let period = noise(distance);
        let bytes: Vec<u8> = period.iter().copied().cycle().take(4 * FARTHEST).collect();
        let length = assert_comes_back(&bytes, [2, 3840, 11520, distance]);
        assert!(length < distance + 4000, "{distance}: {length}");
    }
}

#[test]
fn counts_that_grow_like_fibonacci_numbers_keep_within_the_longest_code() {
    let (mut bytes, mut counts) = (Vec::new(), (1, 1));
    for symbol in 0..20 {
        bytes.extend(std::iter::repeat_n([symbol, symbol ^ 0x55], counts.0).flatten());
        counts = (counts.1, counts.0 + counts.1);
    }
    // No distance at which they repeat: all of them are literals.
    assert_comes_back(&bytes, [FARTHEST; DISTANCES]);
    let counts = std::array::from_fn(|symbol| if symbol < 30 { 1_u32 << symbol } else { 0 });
    let lengths: [u8; SYMBOLS] = huffman::lengths_of(&counts);
    assert!(lengths.iter().all(|&length| length <= 12));
    // Kraft's sum is 1: the code is complete.
    let sum: u32 = lengths.iter().filter(|&&length| length > 0).map(|&l| 1 << (12 - l)).sum();
    assert_eq!(sum, 1 << 12);
}
