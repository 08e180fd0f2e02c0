//! Vertices in clip space: homogeneous image coordinates (x·w, y·w, w) in f64, and the planes that
//! bound what can be snapped.
//!
//! Nothing is divided here; `snapped` divides, `clip` cuts.

use super::SubpixelBits;
use crate::mesh::TriangleMesh;
use crate::raster::dyadic::Scaled;
use crate::raster::image_plane::ImagePlane;
use crate::raster::rows::Homogeneous;
use rayon::prelude::*;

/// The near plane lies at this part of the depth of the scene's farthest vertex. Depth is a
/// floating-point 1/w, so it costs no precision to have it this close; 2^-40 keeps every corner's
/// depth between 1 and 2^40 in f32, and the coordinates that a cut at it gives inside f64.
const NEAR: f64 = 1.0 / (1_u64 << 40) as f64;

/// Vertices are placed at most this far from the frame's centre along x and y, in pixels; the
/// largest frame reaches half as far.
const GUARD_BAND: f64 = 65_536.0;

/// A linear condition on a clip-space point: `normal`·point + `offset` ≥ 0.
#[derive(Clone, Copy)]
pub(super) struct ClipPlane {
    normal: [f64; 3],
    offset: f64,
}

impl ClipPlane {
    /// How far inside a point is.
    pub(super) fn at(&self, p: [f64; 3]) -> f64 {
        self.normal[0] * p[0] + self.normal[1] * p[1] + self.normal[2] * p[2] + self.offset
    }
}

/// The camera's transform, the clip planes and the snapping grid.
pub(super) struct Projector<'a> {
    plane: &'a ImagePlane,
    /// Near plane first, which alone keeps w positive.
    pub(super) clip_planes: [ClipPlane; 5],
    pub(super) subpixel_bits: SubpixelBits,
    /// A power of two at least as large as any vertex' w: a corner's depth is this over w.
    pub(super) far: f64,
    /// sgn det(P), ±1: turns an orientation in the image into one in space.
    pub(super) orientation: i32,
    /// t = w·`ray_parameter`.
    ray_parameter: Scaled,
}

impl<'a> Projector<'a> {
    /// Reads the camera, and looks for the farthest vertex.
    pub(super) fn new(
        plane: &'a ImagePlane,
        mesh: &TriangleMesh,
        subpixel_bits: SubpixelBits,
    ) -> Self {
        let farthest = mesh
            .positions
            .par_iter()
            .map(|&position| clip_point(plane, position)[2])
            .reduce(|| f64::MIN_POSITIVE, f64::max);
        // w is between 2^-202 and 2^237 (`image_plane`): the power of two above it is a normal
        // number. If nothing is before the eye, everything is clipped.
        let far = 2.0_f64.powi(farthest.log2().ceil() as i32 + 1);
        let [centre_x, centre_y] = plane.extent.map(|side| side / 2.0);
        let within = |normal: [f64; 3], offset: f64| ClipPlane { normal, offset };
        // With X = det(P)·(x·w, y·w, w) of the integer lattice, t = w in units of that lattice.
        let determinant = Scaled::from_integer(&plane.exact.determinant);
        Self {
            plane,
            clip_planes: [
                within([0.0, 0.0, 1.0], -far * NEAR),
                within([1.0, 0.0, GUARD_BAND - centre_x], 0.0),
                within([-1.0, 0.0, GUARD_BAND + centre_x], 0.0),
                within([0.0, 1.0, GUARD_BAND - centre_y], 0.0),
                within([0.0, -1.0, GUARD_BAND + centre_y], 0.0),
            ],
            subpixel_bits,
            far,
            orientation: if plane.orientation < 0.0 { -1 } else { 1 },
            ray_parameter: Scaled {
                mantissa: 1.0 / determinant.mantissa.abs(),
                exponent: -determinant.exponent - plane.exact.lattice_exponent,
            },
        }
    }

    /// A vertex in clip space.
    pub(super) fn clip_point(&self, position: [f32; 3]) -> [f64; 3] {
        clip_point(self.plane, position)
    }

    /// The ray parameter of an interpolated depth.
    pub(super) fn ray_parameter(&self, depth: f32) -> f64 {
        // far/depth stays in range; the unit may not, so it goes on piece by piece.
        let mantissa = self.far / f64::from(depth) * self.ray_parameter.mantissa;
        Scaled { mantissa, exponent: self.ray_parameter.exponent }.value()
    }
}

/// det(P)·(x·w, y·w, w), turned so that w is positive before the eye. The same vertex gives the
/// same bits in every triangle, on which the shared edges rely.
fn clip_point(plane: &ImagePlane, position: [f32; 3]) -> [f64; 3] {
    let from_eye = std::array::from_fn(|k| f64::from(position[k]) - plane.eye[k]);
    Homogeneous::new(plane, from_eye).value.map(|c| c * plane.orientation)
}
