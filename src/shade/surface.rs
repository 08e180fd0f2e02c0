//! The visible surface at a pixel: where it is, how it lies, and which normal shading uses.
//!
//! Visibility is over here: the triangle, its facing and its weights are taken as found. The eye
//! direction comes from the camera's exact ray, never from a difference of points.

use super::vector;
use super::watch::{Note, Notes, Watch};
use crate::mesh::Barycentric;
use crate::pixel::Pixel;
use crate::scene::{Scene, Shading, Sides};
use crate::visibility::{Facing, Visible};

/// Below this |Σ b·n|², for unit corner normals n, the interpolated normal has cancelled: its
/// direction is an accident of the weights (at 1e-6 of a unit length, weights that are good to
/// 2^-48 still give it to 4e-9; far below, to nothing), and the face normal is used instead.
const CANCELLED_SQUARED: f64 = 1e-12;

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
/// ([`Notes::cancelled_normals`], [`Notes::missing_normals`]).
pub fn surface_point(scene: &Scene, pixel: Pixel, visible: &Visible) -> (SurfacePoint, Notes) {
    let mut notes = Notes::default();
    let weights = visible.barycentric.0;
    let point = SurfacePoint {
        position: position(scene, pixel, visible),
        to_eye: to_eye(scene, pixel),
        face_normal: scene.mesh.face_normal(visible.triangle),
        shading_normal: shading_normal::<true, _>(scene, visible, &mut notes),
        uv: scene.mesh.uvs_of(visible.triangle).map(|uvs| {
            std::array::from_fn(|k| {
                weights[0] * uvs[0][k] + weights[1] * uvs[1][k] + weights[2] * uvs[2][k]
            })
        }),
        barycentric: visible.barycentric,
    };
    (point, notes)
}

/// The direction of a pixel's ray, exact in f64 by the camera's lattice, not unit.
fn ray_direction(scene: &Scene, pixel: Pixel) -> [f64; 3] {
    let camera = &scene.camera;
    let ([x, y], d0, dx, dy) = (pixel.sample(), camera.d0(), camera.dx(), camera.dy());
    std::array::from_fn(|k| d0[k] + x * dx[k] + y * dy[k])
}

/// V: the unit vector against the pixel's ray.
pub(super) fn to_eye(scene: &Scene, pixel: Pixel) -> [f64; 3] {
    // A lattice camera has no zero direction (its three vectors span space), so the fallback
    // stands for nothing.
    vector::unit(ray_direction(scene, pixel)).map_or([0.0; 3], |d| d.map(|c| -c))
}

/// The world position: the better of two points that are equal in exact arithmetic.
///
/// On the ray, e + t·d is off by the rounding of its size and by half of t's interval; on the
/// triangle, v0 + b1(v1 − v0) + b2(v2 − v0) by the rounding of v0 and by the weights' 2^-48 of the
/// triangle's size. The ray wins on a floor of 1e8 units seen from above, the triangle wins on a
/// small mesh seen from afar, or where t is known only coarsely.
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

/// N: the interpolated corner normal made unit where `INTERPOLATE` is on and the triangle has
/// corner normals, else the face normal; turned on double-sided meshes whose face points away from
/// the eye (by the exact facing, so it cannot disagree with visibility).
pub(super) fn shading_normal<const INTERPOLATE: bool, W: Watch>(
    scene: &Scene,
    visible: &Visible,
    watch: &mut W,
) -> [f64; 3] {
    let (_, object) = scene.object_of(visible.triangle);
    let corner_normals = match object.shading {
        Shading::Phong if INTERPOLATE => scene.mesh.normals_of(visible.triangle),
        Shading::Phong => None,
    };
    let interpolated =
        corner_normals.and_then(|normals| interpolate(normals, visible.barycentric, watch));
    let normal = interpolated.unwrap_or_else(|| {
        let face = scene.mesh.face_normal(visible.triangle);
        if face == [0.0; 3] {
            watch.note(Note::MissingNormal);
        }
        face
    });
    match (object.sides, visible.facing) {
        (Sides::Double, Facing::Back) => normal.map(|c| -c),
        _ => normal,
    }
}

fn interpolate<W: Watch>(
    normals: [[f64; 3]; 3],
    Barycentric(b): Barycentric,
    watch: &mut W,
) -> Option<[f64; 3]> {
    watch.evaluated(super::effects::Effects::INTERPOLATED_NORMALS);
    let [n0, n1, n2] = normals;
    let sum = std::array::from_fn(|k| b[0] * n0[k] + b[1] * n1[k] + b[2] * n2[k]);
    if vector::squared_length(sum) < CANCELLED_SQUARED {
        watch.note(Note::CancelledNormal);
        return None;
    }
    vector::unit(sum)
}
