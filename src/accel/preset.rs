//! How much time a BVH build may take: our names for obvhs' parameter sets.
//!
//! `pre_split` is off in every preset: obvhs clips triangle boxes in floating point, and a clipped
//! box bounds nothing. A leaf is one primitive: testing a triangle costs more than testing two
//! boxes, so collapsing leaves as obvhs does makes rays slower (8 a leaf: 3 times the triangle
//! tests, 0.8 of the speed on a sphere of 72 000). Morton codes have 42 bits per axis everywhere, so that a model on a floor
//! 10⁸ times its size still gets a tree of its own.

use obvhs::BvhBuildParams;
use obvhs::ploc::SortPrecision;

/// Build time against traversal time. The picture is the same, bit for bit, for all of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum BuildPreset {
    /// Search distance 1, no reinsertion.
    Fastest,
    /// Search distance 6 and a little reinsertion.
    Fast,
    /// Search distance 14 and two passes of reinsertion.
    #[default]
    Medium,
    /// Search distance 24 and more reinsertion.
    Slow,
    /// Every node is a candidate for reinsertion. On a soup of overlapping triangles that takes
    /// hundreds of times as long as `Medium`.
    VerySlow,
}

impl BuildPreset {
    /// All presets, fastest build first.
    pub const ALL: [Self; 5] =
        [Self::Fastest, Self::Fast, Self::Medium, Self::Slow, Self::VerySlow];

    pub(super) fn parameters(self) -> BvhBuildParams {
        let parameters = match self {
            Self::Fastest => BvhBuildParams::fastest_build(),
            Self::Fast => BvhBuildParams::fast_build(),
            Self::Medium => BvhBuildParams::medium_build(),
            Self::Slow => BvhBuildParams::slow_build(),
            Self::VerySlow => BvhBuildParams::very_slow_build(),
        };
        BvhBuildParams {
            pre_split: false,
            max_prims_per_leaf: 1,
            sort_precision: SortPrecision::U128,
            ..parameters
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_preset_clips_boxes_or_merges_leaves() {
        for preset in BuildPreset::ALL {
            assert!(!preset.parameters().pre_split, "{preset:?}");
            assert_eq!(preset.parameters().max_prims_per_leaf, 1, "{preset:?}");
        }
    }
}
