//! A depth buffer as graphics processors have it: window depth between two planes, few bits.
//!
//! D = far/(far − near)·(1 − near/z), z the depth along the view axis; 0 at `near`, 1 at `far`,
//! held to that range, with nothing clipped. It is evaluated in f64 from the interpolated f32 1/w
//! and only then rounded to what is stored: the mode shows what the *storage* costs. A step of D is
//! one of z²·(far − near)/(far·near) in depth. Source: the projection matrix and the depth
//! conversion of Vulkan and Direct3D 11 (unorm: round to nearest).

/// How a depth is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum DepthFormat {
    /// 16-bit unorm.
    D16,
    /// 24-bit unorm.
    D24,
    /// f32.
    D32,
}

impl DepthFormat {
    /// The format of so many bits, which are 16, 24 or 32.
    pub const fn of_bits(bits: u32) -> Option<Self> {
        match bits {
            16 => Some(Self::D16),
            24 => Some(Self::D24),
            32 => Some(Self::D32),
            _ => None,
        }
    }

    /// Its bits.
    pub const fn bits(self) -> u32 {
        match self {
            Self::D16 => 16,
            Self::D24 => 24,
            Self::D32 => 32,
        }
    }
}

/// A depth buffer between two planes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DepthBuffer {
    format: DepthFormat,
    pub(in crate::raster) near: f64,
    pub(in crate::raster) far: f64,
}

impl DepthBuffer {
    /// Distance of the near plane that is taken where none is given.
    pub const STANDARD_NEAR: f64 = 0.1;

    /// Distance of the far plane that is taken where none is given.
    pub const STANDARD_FAR: f64 = 1000.0;

    /// A depth buffer; `None` unless 0 < near < far, both finite.
    pub fn new(format: DepthFormat, near: f64, far: f64) -> Option<Self> {
        (near > 0.0 && near < far && far.is_finite()).then_some(Self { format, near, far })
    }

    /// How depths are stored.
    pub const fn format(&self) -> DepthFormat {
        self.format
    }

    /// Depth along the view axis that is stored as 0.
    pub const fn near(&self) -> f64 {
        self.near
    }

    /// Depth along the view axis that is stored as 1.
    pub const fn far(&self) -> f64 {
        self.far
    }

    /// What is stored for a depth z along the view axis: a whole number of steps for D16 and D24,
    /// a number from 0 to 1 for D32.
    pub(in crate::raster) fn stored(&self, z: f64) -> f64 {
        let depth = self.far / (self.far - self.near) * (1.0 - self.near / z);
        let depth = depth.clamp(0.0, 1.0);
        match self.format {
            DepthFormat::D16 => (depth * 65_535.0).round_ties_even(),
            DepthFormat::D24 => (depth * 16_777_215.0).round_ties_even(),
            DepthFormat::D32 => f64::from(depth as f32),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn buffer(bits: u32) -> DepthBuffer {
        DepthBuffer::new(DepthFormat::of_bits(bits).unwrap(), 0.1, 1000.0).unwrap()
    }

    #[test]
    fn depths_run_from_near_to_far_and_stay_there() {
        for (bits, largest) in [(16, 65_535.0), (24, 16_777_215.0), (32, 1.0)] {
            let buffer = buffer(bits);
            assert_eq!([0.0, 0.05, 0.1].map(|z| buffer.stored(z)), [0.0; 3]);
            assert_eq!([1000.0, 1e5, f64::INFINITY].map(|z| buffer.stored(z)), [largest; 3]);
            let depths: Vec<f64> = (1..=1000).map(|z| buffer.stored(f64::from(z))).collect();
            assert!(depths.is_sorted());
            assert_eq!(buffer.format().bits(), bits);
        }
    }

    /// At z = 500: ×16 777 215 and ×65 535 of 0.9998999899989999, by hand; as f32 it is
    /// 16 775 538 steps of 2^-24.
    #[test]
    fn a_depth_of_500() {
        assert_eq!(buffer(24).stored(500.0), 16_775_537.0);
        assert_eq!(buffer(16).stored(500.0), 65_528.0);
        assert_eq!(buffer(32).stored(500.0), 16_775_538.0 / f64::from(1 << 24));
    }

    #[test]
    fn planes_out_of_order_make_no_buffer() {
        for (near, far) in
            [(0.0, 1.0), (-1.0, 1.0), (1.0, 1.0), (2.0, 1.0), (f64::NAN, 1.0), (1.0, f64::INFINITY)]
        {
            assert_eq!(DepthBuffer::new(DepthFormat::D24, near, far), None);
        }
        assert_eq!(DepthFormat::of_bits(8), None);
    }
}
