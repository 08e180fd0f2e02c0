//! Which instruction set the vector kernels run on: the best of the machine, or a lower one for
//! tests and measurements.
//!
//! A kernel is written once, over vectors of a fixed number of lanes, and compiled for every level;
//! [`fearless_simd`] chooses at run time. No answer depends on the level: kernels decide
//! with bounds that hold with and without fused operations, and values that are stored are computed
//! without them.

mod prefetch;

pub(crate) use prefetch::prefetch;

use fearless_simd::Level;
use std::fmt;
use std::str::FromStr;

/// An instruction set, lowest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum SimdLevel {
    /// What every machine of the target has: SSE2 on x86-64, NEON on AArch64, else scalar code.
    Baseline,
    /// SSE4.2.
    Sse42,
    /// AVX2 with FMA.
    Avx2,
    /// AVX-512 as of Ice Lake.
    Avx512,
}

impl SimdLevel {
    /// Every level, lowest first.
    pub const ALL: [Self; 4] = [Self::Baseline, Self::Sse42, Self::Avx2, Self::Avx512];

    /// The best level of this machine.
    pub fn best() -> Self {
        Self::available().last().copied().unwrap_or(Self::Baseline)
    }

    /// The levels that this machine runs, lowest first; never empty.
    pub fn available() -> Vec<Self> {
        Self::ALL.into_iter().filter(|level| level.token().is_some()).collect()
    }

    /// The name: `baseline`, `sse4.2`, `avx2` or `avx512`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Baseline => "baseline",
            Self::Sse42 => "sse4.2",
            Self::Avx2 => "avx2",
            Self::Avx512 => "avx512",
        }
    }

    /// What `fearless_simd::dispatch!` takes. A level that the machine lacks is its best one.
    pub fn dispatched(self) -> Level {
        self.token().unwrap_or_else(Level::new)
    }

    /// The level's token, where the machine has it.
    fn token(self) -> Option<Level> {
        let best = Level::new();
        match self {
            Self::Baseline => Some(Level::baseline()),
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Self::Sse42 => best.as_sse4_2().map(Level::Sse4_2),
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Self::Avx2 => best.as_avx2().map(Level::Avx2),
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Self::Avx512 => best.as_avx512().map(Level::Avx512),
            #[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
            _ => {
                let _ = best;
                None
            }
        }
    }
}

impl fmt::Display for SimdLevel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A name that is no level's.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no instruction set is called \"{0}\"; there are baseline, sse4.2, avx2, avx512")]
pub struct UnknownLevel(pub String);

impl FromStr for SimdLevel {
    type Err = UnknownLevel;

    fn from_str(name: &str) -> Result<Self, UnknownLevel> {
        let named = Self::ALL.into_iter().find(|level| level.name() == name);
        named.ok_or_else(|| UnknownLevel(name.to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_are_read_by_their_names_and_the_best_is_available() {
        for level in SimdLevel::ALL {
            assert_eq!(level.name().parse(), Ok(level));
        }
        assert!("avx".parse::<SimdLevel>().is_err());
        let available = SimdLevel::available();
        assert_eq!(available[0], SimdLevel::Baseline);
        assert!(available.is_sorted());
        assert_eq!(Some(&SimdLevel::best()), available.last());
    }
}
