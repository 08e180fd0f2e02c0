//! The visible surface at a pixel: where it is, how it lies, and which normal shading uses.
//!
//! Visibility is over here: the triangle, its facing and its weights are taken as found. The eye
//! direction comes from the camera's exact ray, never from a difference of points.

use super::method::Method;
use super::vector;
use super::watch::{Note, Notes, Watch};
use super::weights::{mix, weights};
use crate::mesh::{Barycentric, TriangleId};
use crate::pixel::Pixel;
use crate::scene::{Scene, Sides};
use crate::visibility::{Facing, Visible};

/// Below this |Σ b·n|², for unit corner normals n, the interpolated normal has cancelled: its
/// direction is an accident of the weights (at 1e-6 of a unit length, weights that are good to
/// 2^-48 still give it to 4e-9; far below, to nothing), and the face normal is used instead.
pub(super) const CANCELLED_SQUARED: f64 = 1e-12;

/// A point of a visible surface, as shading sees it. Lengths in world units, f64.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// World position.
    pub position: [f64; 3],
    /// V: unit direction from the surface to the eye.
    pub to_eye: [f64; 3],
    /// Unit normal of the face by winding, never flipped; zero where a face has no normal in f64.
    pub face_normal: [f64; 3],
    /// N: the unit normal that shading uses, after turning on double-sided meshes.
    pub shading_normal: [f64; 3],
    /// Interpolated texture coordinates, where the triangle has any.
    pub uv: Option<[f64; 2]>,
    /// Weights of the triangle's corners, as visibility found them.
    pub barycentric: Barycentric,
}

/// The surface point that is visible at a pixel, and what happened on the way
/// ([`Notes::cancelled_normals`], [`Notes::missing_normals`], [`Notes::perspective_kept`]).
pub fn surface_point(scene: &Scene, pixel: Pixel, visible: &Visible) -> (SurfacePoint, Notes) {
    let mut notes = Notes::default();
    let (_, object) = scene.object_of(visible.triangle);
    let rules = scene.switches.rules();
    let weights = weights(scene, visible, &mut notes);
    let method = Method::of(object.shading, rules);
    let is_smooth = method.uses_corner_normals() && method != Method::LastCorner;
    let normal = shading_normal(scene, visible, weights, is_smooth, &mut notes);
    let point = SurfacePoint {
        position: position(scene, pixel, visible),
        to_eye: to_eye(scene, pixel),
        face_normal: scene.mesh.face_normal(visible.triangle),
        shading_normal: normal.unit,
        uv: scene.mesh.uvs_of(visible.triangle).map(|uvs| mix(weights, uvs)),
        barycentric: visible.barycentric,
    };
    (point, notes)
}

/// A normal as the equation takes it.
#[derive(Clone, Copy)]
pub(super) struct Normal {
    pub(super) unit: [f64; 3],
    /// 1, or what interpolation left where the scene does not make it unit again.
    pub(super) length: f64,
}

/// The direction of a pixel's ray, exact in f64 by the camera's lattice, not unit.
#[inline]
fn ray_direction(scene: &Scene, pixel: Pixel) -> [f64; 3] {
    let camera = &scene.camera;
    let ([x, y], d0, dx, dy) = (pixel.sample(), camera.d0(), camera.dx(), camera.dy());
    std::array::from_fn(|k| d0[k] + x * dx[k] + y * dy[k])
}

/// V at a pixel: the unit vector against its ray, or against the view axis for a distant viewer.
#[inline]
pub(super) fn to_eye(scene: &Scene, pixel: Pixel) -> [f64; 3] {
    if scene.switches.rules().distant_viewer {
        return scene.camera.axis().map(|c| -c);
    }
    // A lattice camera has no zero direction (its three vectors span space), so the fallback
    // stands for nothing.
    vector::unit(ray_direction(scene, pixel)).map_or([0.0; 3], |d| d.map(|c| -c))
}

/// V at a point of a surface.
pub(super) fn to_eye_from(scene: &Scene, point: [f64; 3]) -> [f64; 3] {
    if scene.switches.rules().distant_viewer {
        return scene.camera.axis().map(|c| -c);
    }
    // A triangle with a corner at the eye is never visible.
    vector::unit(vector::sub(scene.camera.eye(), point)).unwrap_or_default()
}

/// The world position: the better of two points that are equal in exact arithmetic.
///
/// On the ray, e + t·d is off by the rounding of its size and by half of t's interval; on the
/// triangle, v0 + b1(v1 − v0) + b2(v2 − v0) by the rounding of v0 and by the weights' 2^-48 of the
/// triangle's size. The ray wins on a floor of 1e8 units seen from above, the triangle wins on a
/// small mesh seen from afar, or where t is known only coarsely.
#[inline]
pub(super) fn position(scene: &Scene, pixel: Pixel, visible: &Visible) -> [f64; 3] {
    let (eye, d, t) = (scene.camera.eye(), ray_direction(scene, pixel), visible.t());
    let [v0, v1, v2] = scene.mesh.triangle(visible.triangle).map(|v| v.map(f64::from));
    let (e1, e2) = (vector::sub(v1, v0), vector::sub(v2, v0));
    // Bound both errors, per component.
    let reach = vector::largest_component(d);
    let ray_error = f64::EPSILON * (vector::largest_component(eye) + t * reach)
        + 0.5 * (visible.t_hi - visible.t_lo) * reach;
    let size = vector::largest_component(e1).max(vector::largest_component(e2));
    let corner_error = f64::EPSILON * vector::largest_component(v0) + 16.0 * f64::EPSILON * size;
    // Take the point with the smaller bound.
    if ray_error < corner_error {
        std::array::from_fn(|k| eye[k] + t * d[k])
    } else {
        let Barycentric([_, b1, b2]) = visible.barycentric;
        std::array::from_fn(|k| v0[k] + (b1 * e1[k] + b2 * e2[k]))
    }
}

/// N: the interpolated corner normal where `is_smooth` and the triangle has corner normals, else
/// the face normal; turned on double-sided meshes whose face points away from the eye (by the exact
/// facing, so it cannot disagree with visibility).
pub(super) fn shading_normal<W: Watch>(
    scene: &Scene,
    visible: &Visible,
    weights: [f64; 3],
    is_smooth: bool,
    watch: &mut W,
) -> Normal {
    let corners = if is_smooth { scene.mesh.normals_of(visible.triangle) } else { None };
    let interpolated = corners.and_then(|normals| {
        watch.evaluated(super::effects::Effects::INTERPOLATED_NORMALS);
        let sum = mix(weights, normals);
        let unit = unless_cancelled(sum);
        if unit.is_none() {
            watch.note(Note::CancelledNormal);
        }
        let is_unit = scene.switches.rules().renormalize;
        let length = if is_unit { 1.0 } else { vector::squared_length(sum).sqrt().min(1.0) };
        unit.map(|unit| Normal { unit, length })
    });
    let normal = interpolated.unwrap_or_else(|| face_normal(scene, visible.triangle, watch));
    Normal { unit: turned(scene, visible, normal.unit), ..normal }
}

/// The normal with which a corner is lit: its own where `is_smooth` and it has one, else the
/// face's; turned like that of a pixel.
pub(super) fn corner_normal<W: Watch>(
    scene: &Scene,
    visible: &Visible,
    corner: usize,
    is_smooth: bool,
    watch: &mut W,
) -> [f64; 3] {
    let corners = if is_smooth { scene.mesh.normals_of(visible.triangle) } else { None };
    let normal = match corners {
        Some(normals) => {
            watch.evaluated(super::effects::Effects::INTERPOLATED_NORMALS);
            normals[corner]
        }
        None => face_normal(scene, visible.triangle, watch).unit,
    };
    turned(scene, visible, normal)
}

fn face_normal<W: Watch>(scene: &Scene, triangle: TriangleId, watch: &mut W) -> Normal {
    let unit = scene.mesh.face_normal(triangle);
    if unit == [0.0; 3] {
        watch.note(Note::MissingNormal);
    }
    Normal { unit, length: 1.0 }
}

#[inline]
fn turned(scene: &Scene, visible: &Visible, normal: [f64; 3]) -> [f64; 3] {
    let (_, object) = scene.object_of(visible.triangle);
    match (object.sides, visible.facing) {
        (Sides::Double, Facing::Back) => normal.map(|c| -c),
        _ => normal,
    }
}

/// The unit vector along a mean of unit vectors; `None` where they cancelled.
#[inline(always)]
pub(super) fn unless_cancelled(mean: [f64; 3]) -> Option<[f64; 3]> {
    if vector::squared_length(mean) < CANCELLED_SQUARED {
        return None;
    }
    vector::unit(mean)
}
