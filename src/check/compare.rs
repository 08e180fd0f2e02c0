//! Two answers for the same pixels, compared: which pixels differ, and in what.
//!
//! No opinion about who is right: that is `blame`.

use super::tolerance::{compare_radiance, weights_agree};
use crate::color::LinearRgb;
use crate::pixel::{Pixel, Window};
use crate::scene::Scene;
use crate::scene::sampling::SampleGrid;
use crate::shade::doubt::NEAR_TERMINATOR;
use crate::shade::{Effects, doubts};
use crate::visibility::{Cover, Layers, LevelCounts, VisibilityBuffer, Visible};

/// One path's answer, shaded.
#[derive(Clone, Debug, PartialEq)]
pub struct Answered {
    /// What is visible, with cover counts.
    pub buffer: VisibilityBuffer,
    /// What lies behind the see-through surfaces of the buffer.
    pub layers: Layers,
    /// Radiance per pixel of the buffer.
    pub radiance: Vec<LinearRgb>,
    /// Alpha per pixel of the buffer.
    pub alpha: Vec<f64>,
}

impl Answered {
    /// Whether something is seen through the nearest surface at a pixel.
    pub fn is_layered(&self, pixel: Pixel) -> bool {
        !self.layers.of(self.buffer.window.index(pixel)).is_empty()
    }
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
    /// They see different surfaces behind a see-through one, or the same ones differently.
    Layers,
    /// Their alpha differs: at some sample they see different surfaces.
    Alpha,
    /// Their radiance differs.
    Radiance,
}

impl Kind {
    /// Every kind, in the order in which they are looked for.
    pub const ALL: [Self; 11] = [
        Self::Coverage,
        Self::Surface,
        Self::Facing,
        Self::CoverCount,
        Self::SignedCount,
        Self::Tie,
        Self::Depth,
        Self::Weights,
        Self::Layers,
        Self::Alpha,
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
            Self::Layers => "layers",
            Self::Alpha => "alpha",
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
    /// Pixels whose radiance differs because rounding decides on which side of a light's terminator
    /// they are.
    pub(super) terminator_pixels: usize,
}

/// Compares two answers for the same window.
pub(super) fn compare(scene: &Scene, a: &Answered, b: &Answered) -> Comparison {
    let window = a.buffer.window;
    let mut differences = Vec::new();
    let mut largest_tolerated_radiance = 0.0_f64;
    let mut terminator_pixels = 0;
    for (index, pixel) in window.pixels().enumerate() {
        let kind = visibility_difference(
            (a.buffer.visible[index].as_ref(), cover_at(&a.buffer, index)),
            (b.buffer.visible[index].as_ref(), cover_at(&b.buffer, index)),
        )
        .or_else(|| layers_differ(a.layers.of(index), b.layers.of(index)).then_some(Kind::Layers))
        // Both blend the same surfaces of the same samples in one order.
        .or_else(|| (a.alpha[index] != b.alpha[index]).then_some(Kind::Alpha))
        .or_else(|| {
            let ns = largest_exponent(scene, a, index);
            let (largest, within) = compare_radiance(a.radiance[index], b.radiance[index], ns);
            if within {
                largest_tolerated_radiance = largest_tolerated_radiance.max(largest);
                None
            } else if is_at_terminator(scene, a, index) {
                terminator_pixels += 1;
                None
            } else {
                Some(Kind::Radiance)
            }
        });
        differences.extend(kind.map(|kind| Difference { pixel, kind }));
    }
    Comparison { differences, largest_tolerated_radiance, terminator_pixels }
}

/// Whether the colour of a pixel hangs on the sign of an N·L below 1e-13, which the two paths'
/// weights need not agree on: the specular part jumps there. Only where the pixel's colour is that
/// of one surface at its centre.
fn is_at_terminator(scene: &Scene, answered: &Answered, index: usize) -> bool {
    let Pixel { x, y } = answered.buffer.window.pixel(index);
    let is_one_surface = answered.layers.of(index).is_empty();
    let window = Window::new(scene.camera.resolution(), x, y, x + 1, y + 1);
    let (Some(window), true, SampleGrid::CENTRE) = (window, is_one_surface, scene.samples) else {
        return false;
    };
    let pixel = VisibilityBuffer {
        window,
        visible: vec![answered.buffer.visible[index]],
        cover: None,
        levels: LevelCounts::default(),
    };
    doubts(scene, &pixel, Effects::of(scene))[0] & NEAR_TERMINATOR != 0
}

/// The largest specular exponent that the radiance of a pixel can hold.
pub(super) fn largest_exponent(scene: &Scene, answered: &Answered, index: usize) -> f64 {
    if scene.samples != SampleGrid::CENTRE {
        return scene.materials.iter().fold(0.0, |largest, material| material.ns.max(largest));
    }
    let nearest = answered.buffer.visible[index].iter();
    let surfaces = nearest.chain(answered.layers.of(index));
    surfaces.fold(0.0, |largest, surface| scene.material_of(surface.triangle).1.ns.max(largest))
}

/// Whether two answers about the surfaces behind the nearest differ.
pub(super) fn layers_differ(a: &[Visible], b: &[Visible]) -> bool {
    a.len() != b.len()
        || a.iter().zip(b).any(|(a, b)| {
            (a.triangle, a.facing) != (b.triangle, b.facing)
                || evaluation_difference(a, b).is_some()
        })
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
