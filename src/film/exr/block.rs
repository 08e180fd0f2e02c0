//! Rows of planes to the bytes of one ZIP block, and these compressed.
//!
//! A block's bytes stand row by row, within a row plane by plane, little endian. ZIP takes them
//! apart: first all bytes at even places, then those at odd ones; every byte but the first becomes its
//! difference from the one before, plus 128; a zlib stream of that is the block. A block that this
//! would not make shorter stands as it is. Source: `ImfZip.cpp` of OpenEXR.

use std::ops::Range;

use super::super::deflate::{self, FARTHEST, zlib};
use super::super::{Plane, Samples};

/// Memory that is used for one block after the other.
#[derive(Debug, Default)]
pub(super) struct Room {
    halves: Vec<u8>,
    zlib: deflate::Room,
}

/// Compresses some rows of planes that are `width` wide, behind `out`.
pub(super) fn compress(
    planes: &[&Plane],
    width: usize,
    rows: Range<usize>,
    room: &mut Room,
    out: &mut Vec<u8>,
) {
    let Room { halves, zlib: room } = room;
    halves.resize(rows.len() * planes.len() * width * size_of::<u32>(), 0);
    separate(planes, width, rows.clone(), halves);
    to_differences(halves);
    let compressed = zlib(halves, distances(planes.len(), width), room);
    if compressed.len() < halves.len() {
        out.extend_from_slice(compressed);
    } else {
        append_interleaved(planes, width, rows, out);
    }
}

/// Where bytes repeat: a sample has two in each half; constant planes repeat them. Planes that
/// follow each other may be equal (grey colours), and so may `N` and `Ns` (flat faces), which are
/// three planes apart; a row may equal the one above. What is too far away is looked for one sample
/// back, as the first is.
fn distances(planes: usize, width: usize) -> [usize; 4] {
    let plane = 2 * width;
    [2, plane, 3 * plane, planes * plane].map(|far| if far <= FARTHEST { far } else { 2 })
}

/// Fills both halves.
fn separate(planes: &[&Plane], width: usize, rows: Range<usize>, bytes: &mut [u8]) {
    let (even, odd) = bytes.split_at_mut(rows.len() * planes.len() * width * 2);
    let mut places = even.chunks_exact_mut(2 * width).zip(odd.chunks_exact_mut(2 * width));
    for row in rows {
        for (plane, (even, odd)) in planes.iter().zip(&mut places) {
            let range = row * width..(row + 1) * width;
            match &plane.samples {
                Samples::Float(values) => {
                    let bits = values[range].iter().map(|value| value.to_bits());
                    separate_row(bits, even, odd);
                }
                Samples::Uint(values) => separate_row(values[range].iter().copied(), even, odd),
            }
        }
    }
}

/// One row of one plane. Of a sample's bytes 0 to 3, 0 and 2 are even.
#[inline]
fn separate_row(row: impl Iterator<Item = u32>, even: &mut [u8], odd: &mut [u8]) {
    let (even, _) = even.as_chunks_mut::<2>();
    let (odd, _) = odd.as_chunks_mut::<2>();
    for ((bits, even), odd) in row.zip(even).zip(odd) {
        // As numbers of 16 bits, which the compiler packs many at a time.
        *even = ((bits & 0xff | bits >> 8 & 0xff00) as u16).to_le_bytes();
        *odd = ((bits >> 8 & 0xff | bits >> 16 & 0xff00) as u16).to_le_bytes();
    }
}

/// Every byte but the first less the one before it, plus 128.
fn to_differences(bytes: &mut [u8]) {
    /// Bytes that are worked on at a time, from a copy, so that none waits for another.
    const CHUNK: usize = 64;
    // Less 128 and plus 128: the first byte stays.
    let mut before = 128;
    let (chunks, rest) = bytes.as_chunks_mut::<CHUNK>();
    for chunk in chunks {
        let copy = *chunk;
        chunk[0] = copy[0].wrapping_sub(before).wrapping_add(128);
        for (byte, before) in chunk[1..].iter_mut().zip(&copy) {
            *byte = byte.wrapping_sub(*before).wrapping_add(128);
        }
        before = copy[CHUNK - 1];
    }
    for byte in rest {
        (*byte, before) = (byte.wrapping_sub(before).wrapping_add(128), *byte);
    }
}

/// The rows as they are, little endian.
fn append_interleaved(planes: &[&Plane], width: usize, rows: Range<usize>, bytes: &mut Vec<u8>) {
    for row in rows {
        for plane in planes {
            let range = row * width..(row + 1) * width;
            match &plane.samples {
                Samples::Float(values) => {
                    bytes.extend(values[range].iter().flat_map(|value| value.to_le_bytes()));
                }
                Samples::Uint(values) => {
                    bytes.extend(values[range].iter().flat_map(|value| value.to_le_bytes()));
                }
            }
        }
    }
}
