//! Signed integers of a fixed number of 64-bit limbs, for the numbers of visible triangles: a few
//! hundred bits, without memory of their own.
//!
//! Sizes are the caller's matter: nothing here checks that a result fits.

/// An integer as sign and magnitude, lowest limb first; 0 may have either sign.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wide<const N: usize> {
    negative: bool,
    limbs: [u64; N],
}

impl<const N: usize> Wide<N> {
    /// 0.
    pub(super) const ZERO: Self = Self { negative: false, limbs: [0; N] };

    /// A number of at most 128 bits; N is at least 2.
    pub(super) fn from_i128(value: i128) -> Self {
        let magnitude = value.unsigned_abs();
        let mut limbs = [0; N];
        (limbs[0], limbs[1]) = (magnitude as u64, (magnitude >> 64) as u64);
        Self { negative: value < 0, limbs }
    }

    /// −1, 0 or 1.
    pub(super) fn sign(&self) -> i32 {
        match self.bits() {
            0 => 0,
            _ if self.negative => -1,
            _ => 1,
        }
    }

    /// −self, if that is asked for.
    pub(super) fn negated_if(mut self, negate: bool) -> Self {
        self.negative ^= negate;
        self
    }

    /// self + other.
    pub(super) fn plus(&self, other: &Self) -> Self {
        if self.negative == other.negative {
            let mut carry = false;
            let mut limbs = [0; N];
            for ((sum, &a), &b) in limbs.iter_mut().zip(&self.limbs).zip(&other.limbs) {
                let (partial, first) = a.overflowing_add(b);
                let (whole, second) = partial.overflowing_add(u64::from(carry));
                (*sum, carry) = (whole, first | second);
            }
            return Self { negative: self.negative, limbs };
        }
        // The larger magnitude keeps its sign.
        let larger_first = self.limbs.iter().rev().ge(other.limbs.iter().rev());
        let (large, small) = if larger_first { (self, other) } else { (other, self) };
        let mut borrow = false;
        let mut limbs = [0; N];
        for ((difference, &a), &b) in limbs.iter_mut().zip(&large.limbs).zip(&small.limbs) {
            let (partial, first) = a.overflowing_sub(b);
            let (whole, second) = partial.overflowing_sub(u64::from(borrow));
            (*difference, borrow) = (whole, first | second);
        }
        Self { negative: large.negative, limbs }
    }

    /// self · other, in M limbs.
    pub(super) fn times<const K: usize, const M: usize>(&self, other: &Wide<K>) -> Wide<M> {
        let mut limbs = [0; M];
        for (i, &a) in self.limbs.iter().enumerate() {
            let mut carry = 0_u128;
            for (j, &b) in other.limbs.iter().enumerate() {
                let Some(place) = limbs.get_mut(i + j) else { break };
                let sum = u128::from(a) * u128::from(b) + u128::from(*place) + carry;
                (*place, carry) = (sum as u64, sum >> 64);
            }
            if let Some(place) = limbs.get_mut(i + K) {
                *place = carry as u64;
            }
        }
        Wide { negative: self.negative != other.negative, limbs }
    }

    /// Bits of the magnitude.
    pub(super) fn bits(&self) -> usize {
        match self.limbs.iter().rposition(|&limb| limb != 0) {
            Some(top) => top * 64 + 64 - self.limbs[top].leading_zeros() as usize,
            None => 0,
        }
    }

    /// Zeros below the lowest bit, or `None` for 0.
    pub(super) fn trailing_zeros(&self) -> Option<usize> {
        let low = self.limbs.iter().position(|&limb| limb != 0)?;
        Some(low * 64 + self.limbs[low].trailing_zeros() as usize)
    }

    /// self / 2^`drop`, cut towards zero; at most 127 bits must be left.
    pub(super) fn truncated(&self, drop: usize) -> i128 {
        let limb = |index: usize| u128::from(self.limbs.get(index).copied().unwrap_or(0));
        let (index, shift) = (drop / 64, drop % 64);
        let mut magnitude = (limb(index) | limb(index + 1) << 64) >> shift;
        if shift > 0 {
            magnitude |= limb(index + 2) << (128 - shift);
        }
        if self.negative { -(magnitude as i128) } else { magnitude as i128 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::dyadic::{sign, truncated};
    use dashu_int::IBig;
    use dashu_int::ops::BitTest;

    fn big<const N: usize>(value: &Wide<N>) -> IBig {
        let magnitude = value.limbs.iter().rev().fold(IBig::ZERO, |sum, &l| (sum << 64) + l);
        if value.negative { -magnitude } else { magnitude }
    }

    #[test]
    fn sums_products_and_cuts_are_those_of_big_integers() {
        let numbers: Vec<i128> = (0..40_u32)
            .map(|k| {
                let digits =
                    0x0123_4567_89ab_cdef_i128.wrapping_mul(0x9e37_79b9_7f4a_7c15 + i128::from(k));
                (digits >> (k * 3 % 70) << (k * 7 % 50)) * if k % 3 == 0 { -1 } else { 1 }
            })
            .chain([0, 1, -1, 1 << 64, -(1 << 64), i128::MAX >> 1])
            .collect();
        for &a in &numbers {
            for &b in &numbers {
                let (wide_a, wide_b) = (Wide::<3>::from_i128(a), Wide::<3>::from_i128(b));
                let sum = wide_a.plus(&wide_b);
                assert_eq!(big(&sum), IBig::from(a) + IBig::from(b));
                let product: Wide<5> = wide_a.times(&wide_b);
                let expected = IBig::from(a) * IBig::from(b);
                assert_eq!(big(&product), expected);
                assert_eq!(product.sign(), sign(&expected));
                assert_eq!(product.bits(), expected.bit_len());
                let drop = product.bits().saturating_sub(100);
                assert_eq!(product.truncated(drop), truncated(&expected, drop), "{a} {b}");
                let twice: Wide<9> = product.times(&sum);
                assert_eq!(big(&twice), &expected * (IBig::from(a) + IBig::from(b)));
                let zeros = twice.trailing_zeros();
                assert_eq!(zeros, big(&twice).trailing_zeros());
            }
        }
    }
}
