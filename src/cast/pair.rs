//! Triple products in twice the precision of f64: for values, where a filter only gives signs.
//!
//! A vector is held as `[high, low]`, the exact sum of the two; coordinate differences are exact
//! in this form. Products keep their rounding errors once (Dekker), so a triple product comes out
//! with an error of about u² of its permanent, u = 2^-53; where that does not make the value good
//! to a few u, the caller takes expansions instead.

use super::expansion::{two_difference, two_product, two_sum};
use crate::mutant::{self, Mutant};

/// `[high, low]` per component: a vector that is the sum of the two, |low| ≤ u·|high|.
#[derive(Clone, Copy, Debug)]
pub(super) struct PairVector {
    pub(super) high: [f64; 3],
    pub(super) low: [f64; 3],
}

impl PairVector {
    /// a − b exactly.
    pub(super) fn difference(a: [f64; 3], b: [f64; 3]) -> Self {
        let pairs: [[f64; 2]; 3] = std::array::from_fn(|k| two_difference(a[k], b[k]));
        let low = pairs.map(|p| if mutant::is(Mutant::EyeTailDropped) { 0.0 } else { p[1] });
        Self { high: pairs.map(|p| p[0]), low }
    }

    /// A vector without low parts.
    pub(super) fn exact(high: [f64; 3]) -> Self {
        Self { high, low: [0.0; 3] }
    }

    /// The largest magnitude of a component.
    pub(super) fn largest(&self) -> f64 {
        largest(self.high)
    }
}

/// The largest magnitude of a component.
#[inline(always)]
pub(super) fn largest(v: [f64; 3]) -> f64 {
    let larger = |a: f64, b: f64| if a > b { a } else { b };
    larger(larger(v[0].abs(), v[1].abs()), v[2].abs())
}

/// A triple product below this part of the product of its vectors' largest components has no
/// certain relative error: 2^52·64·u²·6 = 384·2^-54, see [`triple_product`].
const UNCERTAIN: f64 = 384.0 / (1_u64 << 54) as f64;

/// (a × b)·c with a relative error of at most 3u, or `None` where that is not certain.
///
/// Error, with P the permanent (the sum of the magnitudes of the six products) and M the part of
/// it under one component of a × b:
/// - a component is s + tail; the tail adds terms of at most 4uM in all (error of the difference
///   uM, of the two products uM, the four high·low products 2uM), each rounded at most 5 times:
///   20u²M, and low·low is dropped: u²M;
/// - the sum over components adds terms of at most 5uP, each rounded at most 6 times: 30u²P, and
///   low·low is dropped: u²P.
///
/// Together 52u²P and terms in u³: below 64u²P, and P ≤ 6·A·B·C of the largest components. So
/// |value| ≥ 2^52·64u²·6·ABC leaves a relative error of u/2 · (1 + u), the sum's own rounding adds
/// u; 3u bounds it with room for the roundings of the bound itself.
pub(super) fn triple_product(a: &PairVector, b: &PairVector, c: &PairVector) -> Option<f64> {
    let value = dot(&cross(a, b), c);
    let bound = UNCERTAIN * (a.largest() * b.largest() * c.largest());
    (value.abs() > bound).then_some(value)
}

/// a × b, each component as a pair.
pub(super) fn cross(a: &PairVector, b: &PairVector) -> PairVector {
    let mut product = PairVector::exact([0.0; 3]);
    for k in 0..3 {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        let [p, p_error] = two_product(a.high[i], b.high[j]);
        let [q, q_error] = two_product(a.high[j], b.high[i]);
        let [s, s_error] = two_difference(p, q);
        let mixed = (a.high[i] * b.low[j] + a.low[i] * b.high[j])
            - (a.high[j] * b.low[i] + a.low[j] * b.high[i]);
        let [high, low] = two_sum(s, s_error + ((p_error - q_error) + mixed));
        (product.high[k], product.low[k]) = (high, low);
    }
    product
}

/// a·b, rounded once more.
fn dot(a: &PairVector, b: &PairVector) -> f64 {
    let mut products = [0.0; 3];
    let mut tails = [0.0; 3];
    for k in 0..3 {
        let [product, error] = two_product(a.high[k], b.high[k]);
        products[k] = product;
        tails[k] = error + (a.high[k] * b.low[k] + a.low[k] * b.high[k]);
    }
    let [s1, e1] = two_sum(products[0], products[1]);
    let [s2, e2] = two_sum(s1, products[2]);
    s2 + (((tails[0] + tails[1]) + tails[2]) + (e1 + e2))
}
