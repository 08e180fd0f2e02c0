//! The same rows in i128, for triangles whose numbers are small enough: hand-written cameras and
//! vertices on a common grid, where many samples lie exactly on edges.
//!
//! The numbers are those of the wide way, bit for bit; a size test decides beforehand that nothing
//! can overflow.

use super::{ExactTriangle, ray_parameter};
use crate::mutant::{self, Mutant};
use crate::raster::dyadic::{Dyadic, sign};
use crate::raster::exact_row::ExactRow;
use crate::raster::image_plane::ImagePlane;
use dashu_int::IBig;

/// Most bits of |v − e| and of adj(P) together, s: X is a sum of three products, below 2^(s+2); an
/// edge row a difference of two products of X, below 2^(2s+5); the plane's row a sum of three,
/// below 2^(2s+7); twice its offset, below 2^(2s+8), must stay below 2^127.
const ROW_BITS: u32 = 59;

/// The same so that V, a sum of three products of X and a row, below 2^(3s+9), stays below 2^127.
const VOLUME_BITS: u32 = 39;

/// The rows, or `None` when they may not fit; `Some(None)` when V = 0.
pub(super) fn triangle(
    plane: &ImagePlane,
    corners: &[[Dyadic; 3]; 3],
    unit: i64,
) -> Option<Option<ExactTriangle>> {
    let exact = &plane.exact;
    // Corners seen from the eye.
    let mut a = [[0_i128; 3]; 3];
    for k in 0..3 {
        let eye = exact.eye[k].in_short_units(unit)?;
        for (corner, a) in corners.iter().zip(&mut a) {
            a[k] = corner[k].in_short_units(unit)? - eye;
        }
    }
    let size = bits(a.as_flattened()) + bits(exact.adjugate_short.as_flattened());
    if size > ROW_BITS {
        return None;
    }
    // X_i, edge rows and V, as in the wide way.
    let x = a.map(|a| exact.adjugate_short.map(|row| dot(&row, &a)));
    let edges = [cross(&x[1], &x[2]), cross(&x[2], &x[0]), cross(&x[0], &x[1])];
    let volume = if size <= VOLUME_BITS {
        IBig::from(dot(&x[0], &edges[0]))
    } else {
        (0..3).map(|k| IBig::from(x[0][k]) * IBig::from(edges[0][k])).sum()
    };
    let volume_sign = match sign(&volume) {
        0 if mutant::is(Mutant::VolumeZeroHits) => 1,
        sign => sign,
    };
    if volume_sign == 0 {
        return Some(None);
    }
    let flip = volume_sign * sign(&exact.determinant) < 0;
    let edges = edges.map(|row| if flip { row.map(|c| -c) } else { row });
    let sum = [0, 1, 2].map(|k| edges[0][k] + edges[1][k] + edges[2][k]);
    let volume = if volume_sign < 0 { -volume } else { volume };
    Some(Some(ExactTriangle {
        volume_sign,
        edges: edges.map(ExactRow::from_short),
        plane: ExactRow::from_short(sum),
        plane_wide: sum.map(IBig::from),
        ray_parameter: ray_parameter(plane, &volume, unit),
        volume,
        unit,
    }))
}

/// Bits of the largest magnitude.
fn bits(values: &[i128]) -> u32 {
    128 - values.iter().fold(0, |all, value| all | value.unsigned_abs()).leading_zeros()
}

fn dot(a: &[i128; 3], b: &[i128; 3]) -> i128 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: &[i128; 3], b: &[i128; 3]) -> [i128; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
