//! Three-vectors of f64 as shading needs them: no allocation, no fused operation.

/// a − b.
#[inline]
pub(super) fn sub(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// a + b.
#[inline]
pub(super) fn add(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// k·a.
#[inline]
pub(super) fn scaled(a: [f64; 3], k: f64) -> [f64; 3] {
    a.map(|c| c * k)
}

/// a · b, summed from x to z.
#[inline]
pub(super) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// a × b.
#[inline]
pub(super) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// |a|², which under- and overflows; for vectors of length about 1.
#[inline]
pub(super) fn squared_length(a: [f64; 3]) -> f64 {
    dot(a, a)
}

/// max |a_i|.
#[inline]
pub(super) fn largest_component(a: [f64; 3]) -> f64 {
    a.iter().fold(0.0_f64, |m, c| m.max(c.abs()))
}

/// A vector with its length, for every finite vector but zero.
#[derive(Clone, Copy)]
pub(super) struct Measured {
    /// The vector times a power of two, so that squares stay in range. No bit of it is rounded
    /// (components below 2^-1022 of the largest one may be), so a dot product with it has the sign
    /// that the vector itself would give.
    pub(super) scaled: [f64; 3],
    /// Length of `scaled`.
    pub(super) scaled_length: f64,
    /// Length of the vector itself; at most f64::MAX.
    pub(super) length: f64,
}

/// Largest components between these bounds need no scaling: squares lie in 2^-800 … 2^1000, and
/// three of them add up without overflow.
const UNSCALED: std::ops::RangeInclusive<f64> =
    f64::from_bits((1023 - 400) << 52)..=f64::from_bits((1023 + 500) << 52);

/// Measures a vector without NaN; `None` when it is zero or infinite.
#[inline(always)]
pub(super) fn measure(a: [f64; 3]) -> Option<Measured> {
    let largest = largest_component(a);
    if UNSCALED.contains(&largest) {
        let length = squared_length(a).sqrt();
        return Some(Measured { scaled: a, scaled_length: length, length });
    }
    measure_scaled(a, largest)
}

/// [`measure`] of what needs scaling, out of the way of what does not.
#[cold]
#[inline(never)]
fn measure_scaled(a: [f64; 3], largest: f64) -> Option<Measured> {
    if largest == 0.0 || largest == f64::INFINITY {
        return None;
    }
    let exponent = libm::ilogb(largest);
    let scaled = a.map(|c| libm::scalbn(c, -exponent));
    let scaled_length = squared_length(scaled).sqrt();
    // √3 · f64::MAX does not exist; a distance beyond the range is the end of the range.
    let length = libm::scalbn(scaled_length, exponent).min(f64::MAX);
    Some(Measured { scaled, scaled_length, length })
}

impl Measured {
    /// The unit vector. By one quotient and three products, each of which is rounded once: the
    /// direction is as good as by three quotients, the length is off by 2^-53 more.
    #[inline]
    pub(super) fn unit(self) -> [f64; 3] {
        let inverse = self.inverse();
        self.scaled.map(|c| c * inverse)
    }

    /// 1 / `scaled_length`.
    #[inline]
    pub(super) fn inverse(self) -> f64 {
        1.0 / self.scaled_length
    }
}

/// The unit vector along `a`; `None` when `a` is zero or infinite.
#[inline]
pub(super) fn unit(a: [f64; 3]) -> Option<[f64; 3]> {
    measure(a).map(Measured::unit)
}

#[cfg(test)]
mod tests {
    use super::*;

    // C7: f32 gives (0,0,0) at 5e19 and NaN at 5e-24; here the range is that of f64.
    #[test]
    fn c7_every_length_normalises() {
        for scale in [1.0, 1e19, 1e-24, 1e150, 1e-150, 1e300, 1e-300, 2.0_f64.powi(-1070)] {
            let [x, y, z] = unit([3.0 * scale, 4.0 * scale, 0.0]).unwrap();
            assert!((x - 0.6).abs() <= 2e-16 && (y - 0.8).abs() <= 2e-16 && z == 0.0, "{scale:e}");
            let length = measure([3.0 * scale, 4.0 * scale, 0.0]).unwrap().length;
            assert!((length / (5.0 * scale) - 1.0).abs() <= 3e-16, "{scale:e}");
        }
        assert_eq!(unit([0.0, -0.0, 0.0]), None);
        assert_eq!(unit([f64::INFINITY, 1.0, 0.0]), None);
    }

    #[test]
    fn a_length_beyond_the_range_is_its_end() {
        let corner = measure([f64::MAX; 3]).unwrap();
        assert_eq!(corner.length, f64::MAX);
        assert!((corner.unit()[0] - 1.0 / 3.0_f64.sqrt()).abs() < 1e-15);
    }
}
