//! Two answers for the same pixels, compared: which pixels differ, and in what.
//!
//! No opinion about who is right: that is `blame`.

use super::tolerance::{compare_radiance, weights_agree};
use crate::color::LinearRgb;
use crate::pixel::Pixel;
use crate::scene::Scene;
use crate::visibility::{Cover, VisibilityBuffer, Visible};

/// One path's answer, shaded.
#[derive(Clone, Debug, PartialEq)]
pub struct Answered {
    /// What is visible, with cover counts.
    pub buffer: VisibilityBuffer,
    /// Radiance per pixel of the buffer.
    pub radiance: Vec<LinearRgb>,
}

/// The first thing in which two answers differ at a pixel; later ones follow from it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Kind {
    /// One sees a triangle and the other none.
    Coverage,
    /// They see different triangles.
    Surface,
    /// They see different sides of it.
    Facing,
    /// They count different numbers of crossed triangles.
    CoverCount,
    /// Their signed counts differ.
    SignedCount,
    /// One says that the tie rule decided and the other does not.
    Tie,
    /// Their certain intervals of the ray parameter have nothing in common.
    Depth,
    /// Their corner weights differ.
    Weights,
    /// Their radiance differs.
    Radiance,
}

impl Kind {
    /// Every kind, in the order in which they are looked for.
    pub const ALL: [Self; 9] = [
        Self::Coverage,
        Self::Surface,
        Self::Facing,
        Self::CoverCount,
        Self::SignedCount,
        Self::Tie,
        Self::Depth,
        Self::Weights,
        Self::Radiance,
    ];

    /// The word in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Coverage => "coverage",
            Self::Surface => "surface",
            Self::Facing => "facing",
            Self::CoverCount => "cover-count",
            Self::SignedCount => "signed-count",
            Self::Tie => "tie",
            Self::Depth => "depth",
            Self::Weights => "weights",
            Self::Radiance => "radiance",
        }
    }
}

/// A pixel at which two answers differ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    /// Where.
    pub pixel: Pixel,
    /// In what.
    pub kind: Kind,
}

/// What a comparison found.
#[derive(Clone, Debug)]
pub(super) struct Comparison {
    /// Differing pixels, row by row.
    pub(super) differences: Vec<Difference>,
    /// Largest radiance difference within tolerance.
    pub(super) largest_tolerated_radiance: f64,
}

/// Compares two answers for the same window.
pub(super) fn compare(scene: &Scene, a: &Answered, b: &Answered) -> Comparison {
    let window = a.buffer.window;
    let mut differences = Vec::new();
    let mut largest_tolerated_radiance = 0.0_f64;
    for (index, pixel) in window.pixels().enumerate() {
        let kind = visibility_difference(
            (a.buffer.visible[index].as_ref(), cover_at(&a.buffer, index)),
            (b.buffer.visible[index].as_ref(), cover_at(&b.buffer, index)),
        )
        .or_else(|| {
            let ns = a.buffer.visible[index]
                .map_or(0.0, |visible| scene.material_of(visible.triangle).1.ns);
            let (largest, within) = compare_radiance(a.radiance[index], b.radiance[index], ns);
            if within {
                largest_tolerated_radiance = largest_tolerated_radiance.max(largest);
                None
            } else {
                Some(Kind::Radiance)
            }
        });
        differences.extend(kind.map(|kind| Difference { pixel, kind }));
    }
    Comparison { differences, largest_tolerated_radiance }
}

/// The cover counts at a pixel of a buffer that was asked for them.
pub(super) fn cover_at(buffer: &VisibilityBuffer, index: usize) -> Cover {
    buffer.cover.as_ref().map_or_else(Cover::default, |cover| cover[index])
}

/// The first thing in which two answers about visibility differ.
pub(super) fn visibility_difference(
    a: (Option<&Visible>, Cover),
    b: (Option<&Visible>, Cover),
) -> Option<Kind> {
    let counts = || {
        if a.1.crossed != b.1.crossed {
            Some(Kind::CoverCount)
        } else if a.1.signed != b.1.signed {
            Some(Kind::SignedCount)
        } else {
            None
        }
    };
    match (a.0, b.0) {
        (None, None) => counts(),
        (Some(_), None) | (None, Some(_)) => Some(Kind::Coverage),
        (Some(a), Some(b)) if a.triangle != b.triangle => Some(Kind::Surface),
        (Some(a), Some(b)) if a.facing != b.facing => Some(Kind::Facing),
        (Some(a), Some(b)) => counts().or_else(|| evaluation_difference(a, b)),
    }
}

/// The first thing in which two evaluations of the same visible triangle differ.
fn evaluation_difference(a: &Visible, b: &Visible) -> Option<Kind> {
    if a.tie != b.tie {
        return Some(Kind::Tie);
    }
    // Written so that NaN differs.
    if !(a.t_lo <= b.t_hi && b.t_lo <= a.t_hi) {
        return Some(Kind::Depth);
    }
    let weights_differ = (0..3).any(|i| !weights_agree(a.barycentric.0[i], b.barycentric.0[i]));
    weights_differ.then_some(Kind::Weights)
}
