//! A Huffman code over literals and lengths (RFC 1951, 3.2.2 and 3.2.7).
//!
//! D. A. Huffman, "A Method for the Construction of Minimum-Redundancy Codes", 1952.

use super::symbols::{BitWriter, DISTANCE_SYMBOLS};

/// Literals, the end and lengths.
pub(super) const SYMBOLS: usize = 286;

/// Longest code: four of them and the 7 bits that a writer may still hold are 63 bits, so that four
/// literals are written at once. The format would allow 15.
const DEEPEST: u8 = 14;

/// Counts of at least this share of all make no code longer than [`DEEPEST`]: a tree of depth d weighs
/// at least F(d + 2) of its lightest leaf, F being Fibonacci's numbers (M. Buro, "On the maximum
/// length of Huffman codes", 1993). Raised so, 286 counts sum up to at most (1 + 286/1024) of what
/// they were, 1310 of the lightest, which is less than F(17) = 1597.
const LEAST_SHARE: u32 = 1024;

/// Symbols of the code that tells code lengths.
const LENGTH_SYMBOLS: usize = 19;

/// Bits of a code's description: what follows the block's three bits.
pub(super) const DESCRIPTION_BITS: u64 =
    5 + 5 + 4 + 3 * LENGTH_SYMBOLS as u64 + 4 * (SYMBOLS + DISTANCE_SYMBOLS) as u64;

/// Per symbol its code, bits reversed as they are written, and its length in bits.
pub(super) struct Code([(u16, u8); SYMBOLS]);

impl Code {
    /// The code for symbols that occur so often.
    pub(super) fn new(counts: &[u32; SYMBOLS]) -> Self {
        let lengths = lengths_of(counts);
        // Canonical codes: by length, then by symbol.
        let mut of_length = [0_u16; 16];
        for &length in lengths.iter().filter(|&&length| length > 0) {
            of_length[usize::from(length)] += 1;
        }
        let mut next = [0_u16; 16];
        for length in 1..16 {
            next[length] = (next[length - 1] + of_length[length - 1]) << 1;
        }
        Self(lengths.map(|length| {
            if length == 0 {
                return (0, 0);
            }
            let code = &mut next[usize::from(length)];
            *code += 1;
            ((*code - 1).reverse_bits() >> (16 - length), length)
        }))
    }

    /// A symbol's code and its number of bits.
    #[inline]
    pub(super) fn of(&self, symbol: usize) -> (u64, u32) {
        let (word, bits) = self.0[symbol];
        (word.into(), bits.into())
    }

    /// Bits of all symbols together.
    pub(super) fn bits(&self, counts: &[u32; SYMBOLS]) -> u64 {
        let bits = |(count, (_, bits)): (&u32, &(u16, u8))| u64::from(*count) * u64::from(*bits);
        counts.iter().zip(&self.0).map(bits).sum()
    }

    /// Writes the description: the lengths of all codes, each in four bits, for sixteen symbols of
    /// equal length are a code of the lengths. (Coding them better would save about 100 bytes in a
    /// block of 65 535.)
    pub(super) fn describe(
        &self,
        distance_lengths: &[u8; DISTANCE_SYMBOLS],
        writer: &mut BitWriter<'_>,
    ) {
        writer.put(SYMBOLS as u64 - 257, 5);
        writer.put(DISTANCE_SYMBOLS as u64 - 1, 5);
        writer.put(LENGTH_SYMBOLS as u64 - 4, 4);
        // The symbols 16, 17 and 18, which stand first, tell repeats and have no code.
        for position in 0..LENGTH_SYMBOLS {
            writer.put(if position < 3 { 0 } else { 4 }, 3);
            writer.flush();
        }
        for &length in self.0.iter().map(|(_, length)| length).chain(distance_lengths) {
            writer.put(u64::from(length.reverse_bits() >> 4), 4);
            writer.flush();
        }
    }
}

/// Lengths of the codes, none above [`DEEPEST`]; 0 where a symbol does not occur.
pub(super) fn lengths_of(counts: &[u32; SYMBOLS]) -> [u8; SYMBOLS] {
    let lengths = tree(counts, 1);
    if lengths.iter().all(|&length| length <= DEEPEST) {
        return lengths;
    }
    tree(counts, counts.iter().sum::<u32>().div_ceil(LEAST_SHARE))
}

/// Depths of the leaves of Huffman's tree over the counts that are not 0, none taken for less than
/// `least`.
fn tree(counts: &[u32; SYMBOLS], least: u32) -> [u8; SYMBOLS] {
    let occurring = (0_u16..).zip(counts).filter(|&(_, &count)| count > 0);
    let mut leaves: Vec<(u32, u16)> = Vec::with_capacity(SYMBOLS + 1);
    leaves.extend(occurring.map(|(symbol, &count)| (count.max(least), symbol)));
    if leaves.len() == 1 {
        // A code of one symbol is not complete; a second makes it so.
        leaves.push((1, u16::from(leaves[0].1 == 0)));
    }
    leaves.sort_unstable();
    // Nodes: the leaves by weight, then the inner nodes, which come by weight too.
    let count = leaves.len();
    let mut weights: Vec<u32> = leaves.iter().map(|&(weight, _)| weight).collect();
    let mut parents = vec![0; 2 * count];
    let (mut leaf, mut inner) = (0, count);
    for next in count..2 * count - 1 {
        let mut sum = 0;
        for _ in 0..2 {
            let is_leaf = leaf < count && (inner >= next || weights[leaf] <= weights[inner]);
            let lightest = if is_leaf { &mut leaf } else { &mut inner };
            sum += weights[*lightest];
            parents[*lightest] = next;
            *lightest += 1;
        }
        weights.push(sum);
    }
    let mut depths = vec![0_u8; 2 * count];
    for node in (0..2 * count - 2).rev() {
        // Weights sum up to less than 2^32 < F(49): below 64 levels.
        depths[node] = depths[parents[node]] + 1;
    }
    let mut lengths = [0; SYMBOLS];
    for (&(_, symbol), &depth) in leaves.iter().zip(&depths) {
        lengths[usize::from(symbol)] = depth;
    }
    lengths
}
