//! Expansions against integers.

use super::*;
use dashu_int::IBig;
use proptest::prelude::*;

/// A finite f64 that is a multiple of 2^-800, times 2^800.
fn integer(value: f64) -> IBig {
    let bits = value.to_bits();
    let fraction = bits & ((1 << 52) - 1);
    let exponent = ((bits >> 52) & 0x7ff) as i64;
    let (mantissa, power) =
        if exponent == 0 { (fraction, -1074) } else { (fraction | 1 << 52, exponent - 1075) };
    let shift = power + 800;
    let magnitude = if shift >= 0 {
        IBig::from(mantissa) << shift as usize
    } else {
        let dropped = mantissa & ((1_u64 << (-shift).min(63)) - 1);
        assert_eq!(dropped, 0, "{value:e} is no multiple of 2^-800");
        IBig::from(mantissa >> (-shift).min(63))
    };
    if value < 0.0 { -magnitude } else { magnitude }
}

fn total(expansion: &Expansion) -> IBig {
    expansion.terms().iter().map(|&term| integer(term)).sum()
}

fn sign_of(value: &IBig) -> i8 {
    match value.cmp(&IBig::ZERO) {
        std::cmp::Ordering::Less => -1,
        std::cmp::Ordering::Equal => 0,
        std::cmp::Ordering::Greater => 1,
    }
}

/// Nonoverlapping: each term below the lowest set bit of the next.
fn assert_well_formed(expansion: &Expansion) {
    for pair in expansion.terms().windows(2) {
        let next = pair[1].abs();
        let trailing = (next.to_bits() | 1 << 52).trailing_zeros() as i32;
        let exponent = ((next.to_bits() >> 52) & 0x7ff) as i32 - 1075;
        assert!(pair[0] != 0.0 && pair[0].abs() < 2.0_f64.powi(exponent + trailing), "{pair:?}");
    }
}

/// Structured: f64 of very different sizes and of few bits, so that sums cancel.
fn number() -> impl Strategy<Value = f64> {
    (-(1_i64 << 53)..(1 << 53), -120..120_i32, 0..53_u32).prop_map(|(mantissa, exponent, drop)| {
        ((mantissa >> drop) << drop) as f64 * 2.0_f64.powi(exponent)
    })
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(512) })]

    #[test]
    fn sums_and_products_are_exact(numbers in prop::collection::vec(number(), 1..80), factor in number()) {
        let mut sum = Expansion::ZERO;
        let mut expected = IBig::ZERO;
        for &n in &numbers {
            sum.add(n);
            expected += integer(n);
        }
        assert_well_formed(&sum);
        prop_assert_eq!(total(&sum), expected.clone());
        prop_assert_eq!(sum.sign(), sign_of(&expected));
        let mut scaled = Expansion::ZERO;
        scaled.add_scaled(&sum, factor);
        prop_assert_eq!(total(&scaled) << 800, &expected * integer(factor));
        let mut square = Expansion::ZERO;
        square.add_product_of(&sum, &scaled);
        prop_assert_eq!(square.sign(), scaled.sign() * sum.sign());
        let mut compressed = sum;
        compressed.compress();
        prop_assert!(compressed.length <= 30);
        prop_assert_eq!(total(&compressed), expected);
    }

    /// A sum that is one unit of its last bit away from 0, hidden under products that cancel.
    #[test]
    fn near_zero_signs_are_right(
        numbers in prop::collection::vec((number(), number()), 1..12),
        residue in prop::sample::select(vec![-1.0, 0.0, 1.0]),
    ) {
        let tiny = residue * 2.0_f64.powi(-600);
        let mut sum = Expansion::ZERO;
        for &(a, b) in &numbers {
            sum.add_product(a, b);
        }
        sum.add(tiny);
        for &(a, b) in numbers.iter().rev() {
            sum.add_product(-b, a);
        }
        prop_assert_eq!(sum.sign(), residue as i8);
    }
}

#[test]
fn an_estimate_is_the_rounded_sum() {
    let mut sum = Expansion::ZERO;
    for term in [1.0, 2.0_f64.powi(-60), -1.0, 3.0 * 2.0_f64.powi(-200)] {
        sum.add(term);
    }
    let exact = 2.0_f64.powi(-60);
    assert!((sum.estimate() - exact).abs() <= exact * f64::EPSILON);
    assert_eq!(Expansion::ZERO.estimate(), 0.0);
}

/// The largest values in range: V·D of coordinates of ±2^126.
#[test]
fn extremes_stay_finite() {
    for magnitude in [2.0_f64.powi(127), 2.0_f64.powi(-149)] {
        let mut product = Expansion::ZERO;
        product.add(1.0);
        for factor in [magnitude; 5] {
            let mut next = Expansion::ZERO;
            next.add_scaled(&product, factor);
            next.add_scaled(&product, factor);
            product = next;
        }
        assert_eq!(product.estimate(), magnitude.powi(5) * 32.0);
        assert!(product.terms().iter().all(|t| t.is_finite()));
    }
}
