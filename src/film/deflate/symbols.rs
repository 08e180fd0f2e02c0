//! The alphabet of DEFLATE, and bits into bytes (RFC 1951, 3.2.5).

use super::DISTANCES;

/// Symbol of a block's end.
pub(super) const END: usize = 256;

/// Symbol of the shortest repeat; symbols below [`END`] are bytes.
pub(super) const FIRST_LENGTH: usize = 257;

/// Length of the shortest repeat that the format knows.
const LEAST: usize = 3;

/// Length of the longest repeat that one symbol tells.
pub(super) const LONGEST: usize = 258;

/// Number of distance symbols.
pub(super) const DISTANCE_SYMBOLS: usize = 30;

/// Per length its symbol, the number of bits that follow, and their value.
pub(super) const LENGTHS: [(u16, u8, u16); LONGEST + 1] = {
    let mut table = [(0, 0, 0); LONGEST + 1];
    let mut length = LEAST;
    while length <= LONGEST {
        // Four symbols per number of bits, eight with none.
        let offset = length - LEAST;
        let bits = if offset < 8 { 0 } else { offset.ilog2() as usize - 2 };
        let symbol = FIRST_LENGTH + 4 * bits + (offset >> bits);
        table[length] = (symbol as u16, bits as u8, (offset & ((1 << bits) - 1)) as u16);
        length += 1;
    }
    table[LONGEST] = (285, 0, 0);
    table
};

/// Cuts the length of a repeat into lengths that have symbols; 0 into none.
#[inline]
pub(super) fn for_each_length(mut length: usize, mut each: impl FnMut(usize)) {
    while length >= LONGEST + LEAST {
        each(LONGEST);
        length -= LONGEST;
    }
    if length > LONGEST {
        each(length - LEAST);
        length = LEAST;
    }
    if length > 0 {
        each(length);
    }
}

/// What is written for each of the distances: symbol and further bits in one word.
pub(super) struct DistanceCodes {
    words: [(u64, u32); DISTANCES],
    lengths: [u8; DISTANCE_SYMBOLS],
}

impl DistanceCodes {
    /// A code over the symbols of these distances, which may share one. It does not follow the
    /// counts: a repeat is long, and its distance takes a few bits.
    pub(super) fn new(distances: [usize; DISTANCES]) -> Self {
        let symbols = distances.map(distance_symbol);
        let mut distinct: Vec<usize> = symbols.iter().map(|&(symbol, ..)| symbol).collect();
        distinct.sort_unstable();
        distinct.dedup();
        // Canonical codes, bits reversed as they are written. One symbol alone takes a bit too.
        let codes: &[(u64, u32)] = match distinct.len() {
            1 => &[(0, 1)],
            2 => &[(0, 1), (1, 1)],
            3 => &[(0b0, 1), (0b01, 2), (0b11, 2)],
            _ => &[(0b00, 2), (0b10, 2), (0b01, 2), (0b11, 2)],
        };
        let mut lengths = [0; DISTANCE_SYMBOLS];
        for (&symbol, &(_, bits)) in distinct.iter().zip(codes) {
            lengths[symbol] = bits as u8;
        }
        let words = symbols.map(|(symbol, bits, value)| {
            let place = distinct.iter().position(|&other| other == symbol).unwrap_or(0);
            let (word, length) = codes[place];
            (word | value << length, length + bits)
        });
        Self { words, lengths }
    }

    /// The word of the distance at a position of the list, and its number of bits, at most 15.
    #[inline]
    pub(super) fn of(&self, position: usize) -> (u64, u32) {
        self.words[position]
    }

    /// Per symbol the length of its code.
    pub(super) fn lengths(&self) -> &[u8; DISTANCE_SYMBOLS] {
        &self.lengths
    }
}

/// A distance's symbol, the number of bits that follow, and their value.
fn distance_symbol(distance: usize) -> (usize, u32, u64) {
    // Two symbols per number of bits, four with none.
    let offset = distance - 1;
    let bits = if offset < 4 { 0 } else { offset.ilog2() - 1 };
    (2 * bits as usize + (offset >> bits), bits, (offset & ((1 << bits) - 1)) as u64)
}

/// Writes bits, lowest first, into bytes that are there.
pub(super) struct BitWriter<'a> {
    bytes: &'a mut [u8],
    at: usize,
    held: u64,
    count: u32,
}

impl<'a> BitWriter<'a> {
    /// Writes from byte `at` on.
    pub(super) fn new(bytes: &'a mut [u8], at: usize) -> Self {
        Self { bytes, at, held: 0, count: 0 }
    }

    /// Adds bits. Up to 56 fit between two calls of [`Self::flush`].
    #[inline]
    pub(super) fn put(&mut self, value: u64, count: u32) {
        self.held |= value << self.count;
        self.count += count;
    }

    /// Hands on the whole bytes; fewer than 8 bits stay.
    #[inline]
    pub(super) fn flush(&mut self) {
        // The eight bytes are there: `OVERHEAD` counts them.
        let place = self.bytes.get_mut(self.at..).and_then(|rest| rest.first_chunk_mut());
        if let Some(place) = place {
            *place = self.held.to_le_bytes();
        }
        let whole = self.count / 8;
        self.at += whole as usize;
        // At most 63 bits are held: 7 bytes are whole.
        self.held >>= 8 * whole;
        self.count -= 8 * whole;
    }

    /// A stored block: its bytes as they are, from a byte's start.
    pub(super) fn store(&mut self, block: &[u8], is_last: bool) {
        self.put(u64::from(is_last), 3);
        self.align();
        let length = block.len() as u64;
        self.put(length | (length ^ 0xffff) << 16, 32);
        self.flush();
        self.bytes[self.at..][..block.len()].copy_from_slice(block);
        self.at += block.len();
    }

    /// Fills up the last byte; says where the next would stand.
    pub(super) fn finish(mut self) -> usize {
        self.align();
        self.at
    }

    fn align(&mut self) {
        self.flush();
        if self.count > 0 {
            self.count = 8;
            self.flush();
        }
    }
}
