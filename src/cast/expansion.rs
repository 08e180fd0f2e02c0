//! Exact sums and products of f64 as floating expansions.
//!
//! An expansion is an unevaluated sum of f64, nonoverlapping and of increasing magnitude: its last
//! term has the sign of the sum. Source: J. R. Shewchuk, *Adaptive Precision Floating-Point
//! Arithmetic and Fast Robust Geometric Predicates* (1997): Two-Sum, Veltkamp's split and Dekker's
//! Two-Product (theorems 7, 17, 18), Grow-Expansion (10) and Compress (23). No fused operation.
//!
//! Range: every predicate of the caster has degree at most 5 in coordinates (multiples of 2^-149,
//! below 2^127) and 1 in a direction (multiples of 2^-53, at most 1). So every term is a multiple
//! of 2^(−5·149−53) = 2^-798 and the sums stay below 2^645: no operation under- or overflows, and
//! splitting, which needs room up to 2^996, is safe.

/// Room for terms. Compress leaves each term at most an ulp of the next, so at least 52 binary
/// orders apart: at most (645 + 798)/52 + 2 < 30 terms, and there is always room after it.
const CAPACITY: usize = 64;

/// fl(a + b) and its rounding error, exactly.
#[inline(always)]
pub(super) fn two_sum(a: f64, b: f64) -> [f64; 2] {
    let sum = a + b;
    let b_part = sum - a;
    let a_part = sum - b_part;
    [sum, (a - a_part) + (b - b_part)]
}

/// fl(a − b) and its rounding error, exactly.
#[inline(always)]
pub(super) fn two_difference(a: f64, b: f64) -> [f64; 2] {
    two_sum(a, -b)
}

/// As [`two_sum`] where |a| ≥ |b|.
#[inline(always)]
fn fast_two_sum(a: f64, b: f64) -> [f64; 2] {
    let sum = a + b;
    [sum, b - (sum - a)]
}

/// fl(a · b) and its rounding error, exactly.
#[inline(always)]
pub(super) fn two_product(a: f64, b: f64) -> [f64; 2] {
    let product = a * b;
    let ([a_hi, a_lo], [b_hi, b_lo]) = (split(a), split(b));
    let error = ((a_hi * b_hi - product) + a_hi * b_lo + a_lo * b_hi) + a_lo * b_lo;
    [product, error]
}

/// Two halves of at most 26 bits each.
#[inline(always)]
fn split(a: f64) -> [f64; 2] {
    let scaled = a * f64::from((1 << 27) + 1);
    let hi = scaled - (scaled - a);
    [hi, a - hi]
}

/// An exact number.
#[derive(Clone, Copy, Debug)]
pub(super) struct Expansion {
    length: usize,
    terms: [f64; CAPACITY],
}

impl Expansion {
    pub(super) const ZERO: Self = Self { length: 0, terms: [0.0; CAPACITY] };

    fn terms(&self) -> &[f64] {
        &self.terms[..self.length]
    }

    /// Adds a number (Grow-Expansion, zero terms left out).
    pub(super) fn add(&mut self, b: f64) {
        if self.length == CAPACITY {
            self.compress();
        }
        let mut carry = b;
        let mut kept = 0;
        for i in 0..self.length {
            let [sum, error] = two_sum(carry, self.terms[i]);
            carry = sum;
            if error != 0.0 {
                self.terms[kept] = error;
                kept += 1;
            }
        }
        if carry != 0.0 {
            self.terms[kept] = carry;
            kept += 1;
        }
        self.length = kept;
    }

    /// Adds a · b.
    pub(super) fn add_product(&mut self, a: f64, b: f64) {
        if a == 0.0 || b == 0.0 {
            return;
        }
        let [product, error] = two_product(a, b);
        self.add(error);
        self.add(product);
    }

    /// Adds `other` · b.
    pub(super) fn add_scaled(&mut self, other: &Self, b: f64) {
        for &term in other.terms() {
            self.add_product(term, b);
        }
    }

    /// Adds a · b.
    pub(super) fn add_product_of(&mut self, a: &Self, b: &Self) {
        for &term in b.terms() {
            self.add_scaled(a, term);
        }
    }

    /// The same number with its sign changed.
    pub(super) fn negated(mut self) -> Self {
        for term in &mut self.terms[..self.length] {
            *term = -*term;
        }
        self
    }

    /// −1, 0 or 1.
    pub(super) fn sign(&self) -> i8 {
        match self.terms().last() {
            Some(&term) if term > 0.0 => 1,
            Some(_) => -1,
            None => 0,
        }
    }

    /// The number to less than one ulp of the result (relative error below 2u, u = 2^-53).
    pub(super) fn estimate(mut self) -> f64 {
        self.compress();
        self.terms().last().copied().unwrap_or(0.0)
    }

    /// The same number in few terms, the last of which is close to it (Compress).
    pub(super) fn compress(&mut self) {
        if self.length == 0 {
            return;
        }
        let mut sum = self.terms[self.length - 1];
        let mut bottom = self.length - 1;
        for i in (0..self.length - 1).rev() {
            let [high, low] = fast_two_sum(sum, self.terms[i]);
            sum = high;
            if low != 0.0 {
                self.terms[bottom] = high;
                bottom -= 1;
                sum = low;
            }
        }
        self.terms[bottom] = sum;
        let mut top = 0;
        for i in bottom + 1..self.length {
            let [high, low] = fast_two_sum(self.terms[i], sum);
            sum = high;
            if low != 0.0 {
                self.terms[top] = low;
                top += 1;
            }
        }
        self.terms[top] = sum;
        self.length = top + 1;
    }
}

#[cfg(test)]
#[path = "expansion_tests.rs"]
mod tests;
