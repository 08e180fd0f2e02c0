//! Real roots of a polynomial in an interval, to the last bit that its values allow.
//!
//! Between two neighbouring roots of its derivative a polynomial is monotone and has at most one
//! root, which bisection finds; the derivative's roots come the same way, from the line upwards.
//! Roots at which the sign does not change may be missed: a ray that touches does not cross.

/// Coefficients from the constant on; roots ascending.
pub(super) fn roots(coefficients: &[f64], low: f64, high: f64) -> Vec<f64> {
    if coefficients.len() < 2 || low >= high {
        return Vec::new();
    }
    let derivative: Vec<f64> =
        coefficients.iter().enumerate().skip(1).map(|(power, c)| power as f64 * c).collect();
    let mut ends = vec![low];
    ends.extend(roots(&derivative, low, high));
    ends.push(high);
    ends.windows(2).filter_map(|pair| bisect(coefficients, pair[0], pair[1])).collect()
}

/// The root of a monotone stretch; `None` where the signs of its ends are equal. A root at the lower
/// end belongs to the stretch before.
fn bisect(coefficients: &[f64], mut low: f64, mut high: f64) -> Option<f64> {
    let value = |t: f64| coefficients.iter().rev().fold(0.0, |sum, c| sum * t + c);
    let rises = value(low) < 0.0;
    let is_past = |t: f64| if rises { value(t) >= 0.0 } else { value(t) <= 0.0 };
    if value(low) == 0.0 || !is_past(high) {
        return None;
    }
    loop {
        let middle = low + 0.5 * (high - low);
        if middle <= low || middle >= high {
            return Some(high);
        }
        if is_past(middle) { high = middle } else { low = middle }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_of_a_product_are_its_factors() {
        // (t − 1)(t − 2)(t − 4)(t + 3) = t⁴ − 4t³ − 7t² + 34t − 24.
        let found = roots(&[-24.0, 34.0, -7.0, -4.0, 1.0], -10.0, 10.0);
        assert_eq!(found.len(), 4);
        for (found, expected) in found.iter().zip([-3.0, 1.0, 2.0, 4.0]) {
            // Values are good to a few units in the last place of 100; the slopes are at least 10.
            assert!((found - expected).abs() < 1e-13, "{found} {expected}");
        }
        assert_eq!(roots(&[-24.0, 34.0, -7.0, -4.0, 1.0], 1.5, 3.0).len(), 1);
        assert!(roots(&[1.0, 0.0, 1.0], -10.0, 10.0).is_empty());
        assert!(roots(&[3.0], -10.0, 10.0).is_empty());
    }
}
