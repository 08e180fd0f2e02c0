//! Another program's depths, and how far they may be off.

use super::sample::Sampler;
use super::stability::rim;
use super::{Class, Finding, ForeignOptions, Theirs};
use crate::scene::Scene;
use crate::visibility::{VisibilityBuffer, Visible};

/// Largest relative error of a depth, unless another is asked for: 2^-20, 16 half steps of f32.
/// A ray in f32 that meets a triangle squarely is off by a few half steps, one for each operation.
pub const DEPTH_TOLERANCE_RELATIVE: f64 = 1.0 / (1 << 20) as f64;

/// Depths from here on mean nothing is visible, as NaN, infinities and depths up to 0 do: 10^10 is
/// what Blender writes.
pub const NOTHING_FROM: f64 = 1e10;

/// Which depth a number is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DepthKind {
    /// Along the view axis.
    Z,
    /// The ray parameter of the scene's camera, whose directions are not unit vectors.
    RayParameter,
}

/// One depth per pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct DepthPlane {
    /// Which depth.
    pub kind: DepthKind,
    /// The depths.
    pub values: Vec<f64>,
}

/// A depth that is not within tolerance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DepthOff {
    /// Theirs.
    pub theirs: f64,
    /// The exact one, to f64.
    pub exact: f64,
    /// Theirs over the exact one, less 1; 0 where one of them is missing.
    pub relative: f64,
}

/// Whether a depth says that nothing is visible.
pub(super) fn is_nothing(depth: f64) -> bool {
    !(depth > 0.0 && depth < NOTHING_FROM)
}

/// Judges the depth at a pixel whose id, if they `given` one, is right.
pub(super) fn judge(
    sampler: &Sampler<'_>,
    reference: &VisibilityBuffer,
    plane: &DepthPlane,
    index: usize,
    given: Option<Theirs>,
    options: &ForeignOptions,
) -> Option<Finding> {
    let pixel = reference.window.pixel(index);
    let visible = reference.visible[index].as_ref();
    let theirs = plane.values[index];
    let exact = visible.map(|visible| depth_of(sampler.scene, plane.kind, visible));
    let finding = |class: Class, relative: f64| {
        let exact = exact.unwrap_or(0.0);
        let ours = visible.map(|visible| visible.triangle);
        let depth = Some(DepthOff { theirs, exact, relative });
        Some(Finding { pixel, class, ours, theirs: given, gap: None, depth })
    };
    // Depths as large as the mark of nothing are real where the exact one is as large.
    let sees_nothing = is_nothing(theirs) && !(theirs > 0.0 && exact >= Some(0.5 * NOTHING_FROM));
    let nearby = |is_right: &dyn Fn(Option<f64>) -> bool| {
        rim(pixel)
            .into_iter()
            .map(|point| sampler.visible_at(point))
            .any(|v| is_right(v.as_ref().map(|v| depth_of(sampler.scene, plane.kind, v))))
    };
    let near = |exact: f64| (theirs - exact).abs() <= options.depth_tolerance * exact;
    let class = |class: Class, unstable: bool| if unstable { Class::Unstable } else { class };
    match (exact, sees_nothing) {
        (None, true) => None,
        // Ids decide what is seen where they are given; depth buffers keep old values there.
        (None, false) if given.is_some() => None,
        (None, false) => finding(class(Class::Extra, nearby(&|e| e.is_some_and(near))), 0.0),
        (Some(_), true) => finding(class(Class::Missing, nearby(&|e| e.is_none())), 0.0),
        (Some(exact), false) if near(exact) => None,
        (Some(exact), false) => {
            // Between the exact depths at two points of the box, on one continuous surface or at
            // its rim, theirs is the depth of a sample in it.
            let is_between = || {
                let (mut low, mut high) = (exact, exact);
                for visible in rim(pixel).into_iter().filter_map(|p| sampler.visible_at(p)) {
                    if Some(visible.triangle) == reference.visible[index].map(|v| v.triangle) {
                        let depth = depth_of(sampler.scene, plane.kind, &visible);
                        (low, high) = (low.min(depth), high.max(depth));
                    }
                }
                let slack = options.depth_tolerance;
                theirs >= low * (1.0 - slack) && theirs <= high * (1.0 + slack)
            };
            let unstable = is_between() || nearby(&|e| e.is_some_and(near));
            finding(class(Class::DepthOff, unstable), theirs / exact - 1.0)
        }
    }
}

/// The depth of a visible surface.
fn depth_of(scene: &Scene, kind: DepthKind, visible: &Visible) -> f64 {
    match kind {
        DepthKind::Z => visible.t() * scene.camera.z_per_t(),
        DepthKind::RayParameter => visible.t(),
    }
}
