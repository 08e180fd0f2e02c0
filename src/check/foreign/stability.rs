//! Is an answer right for some sample in the little box around a pixel's centre?
//!
//! Programs that snap vertices or rays to a grid, or round them to f32, answer for a sample a little
//! beside the centre; such an answer is no error. It takes a witness: a point of the box at which
//! the exact answer is theirs. Where two triangles tie at a point, either will do. Points are tried on the box's rim and wherever their triangle (or, if
//! they saw nothing, what lies beside our triangle) reaches into the box. A witness is proof; that
//! none was found is none, where their triangle is partly hidden inside the box.

use super::Theirs;
use super::sample::Sampler;
use crate::mesh::TriangleId;
use crate::pixel::Pixel;

/// Half the side of the box, in pixels: one step of the 1/256 pixel grid on which rasterizing
/// hardware snaps vertices (Direct3D 11 demands 8 bits; snapping moves an edge by at most half a
/// step, a program that snaps and rounds by less than one).
pub const UNSTABLE_HALF_WIDTH_PIXELS: f64 = 1.0 / 256.0;

/// The eight points on the rim of the box, in half widths.
const RIM: [[f64; 2]; 8] = [
    [-1.0, -1.0],
    [0.0, -1.0],
    [1.0, -1.0],
    [-1.0, 0.0],
    [1.0, 0.0],
    [-1.0, 1.0],
    [0.0, 1.0],
    [1.0, 1.0],
];

/// How much the box is enlarged to see whether a triangle reaches into it at all: far more than the
/// error of edge functions.
const REACH: f64 = 1.0 + 1.0 / 1024.0;

/// How far from a polygon's middle towards its corners points are tried.
const TOWARDS_CORNER: [f64; 2] = [0.5, 0.95];

/// The points of the rim around a pixel, in pixels of the frame.
pub(super) fn rim(pixel: Pixel) -> [[f64; 2]; 8] {
    RIM.map(|offset| beside(pixel, offset.map(|c| c * UNSTABLE_HALF_WIDTH_PIXELS)))
}

/// Whether their answer is the exact one for some point of the box around the centre of `pixel`,
/// at which the exact answer is `ours`.
pub(super) fn is_right_nearby(
    sampler: &Sampler<'_>,
    pixel: Pixel,
    ours: Option<TriangleId>,
    theirs: Theirs,
) -> bool {
    let wanted = match theirs {
        Theirs::Unknown(_) => return false,
        Theirs::Nothing => None,
        Theirs::Triangle(triangle) => Some(triangle),
    };
    // Where could it be right? An edge function without a sign leaves the rim only.
    let rows = wanted.or(ours).and_then(|triangle| sampler.edge_rows(triangle, pixel));
    let places: Vec<Polygon> = match (rows, wanted) {
        (None, _) => Vec::new(),
        (Some(rows), Some(_)) => vec![rows.iter().fold(square(), |part, &row| clip(&part, row))],
        (Some(rows), None) => rows.map(|row| clip(&square(), row.map(|value| -value))).to_vec(),
    };
    if rows.is_some() && places.iter().all(Vec::is_empty) {
        return false;
    }
    let is_right = |point: [f64; 2]| {
        let visible = sampler.visible_at(point);
        visible.map(|visible| visible.triangle) == wanted
            || visible.zip(wanted).is_some_and(|(visible, triangle)| {
                visible.tie && sampler.is_as_deep(triangle, point, &visible)
            })
    };
    rim(pixel).into_iter().any(is_right)
        || places.iter().flat_map(|place| points_in(place)).any(|o| is_right(beside(pixel, o)))
}

/// Whether a triangle may reach into the box: false is certain, and cheap.
pub(super) fn may_reach(sampler: &Sampler<'_>, pixel: Pixel, triangle: TriangleId) -> bool {
    let rows = sampler.edge_rows(triangle, pixel);
    rows.is_none_or(|rows| !rows.iter().fold(square(), |part, &row| clip(&part, row)).is_empty())
}

/// Corners in order, in pixels from the sample.
type Polygon = Vec<[f64; 2]>;

fn square() -> Polygon {
    let h = UNSTABLE_HALF_WIDTH_PIXELS * REACH;
    vec![[-h, -h], [h, -h], [h, h], [-h, h]]
}

/// The part of a convex polygon where an edge function is not negative (Sutherland and Hodgman,
/// "Reentrant polygon clipping", 1974).
fn clip(polygon: &[[f64; 2]], [c, a, b]: EdgeRow) -> Polygon {
    let value = |[x, y]: [f64; 2]| c + a * x + b * y;
    let mut part = Vec::new();
    for (i, &p) in polygon.iter().enumerate() {
        let q = polygon[(i + 1) % polygon.len()];
        let (at_p, at_q) = (value(p), value(q));
        if at_p >= 0.0 {
            part.push(p);
        }
        if (at_p < 0.0) != (at_q < 0.0) {
            let s = at_p / (at_p - at_q);
            part.push([p[0] + s * (q[0] - p[0]), p[1] + s * (q[1] - p[1])]);
        }
    }
    part
}

/// One edge function around the sample: constant, per pixel right, per pixel down.
type EdgeRow = [f64; 3];

/// The middle of a polygon and points between it and the corners.
fn points_in(polygon: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let count = polygon.len().max(1) as f64;
    let middle = [0, 1].map(|k| polygon.iter().map(|corner| corner[k]).sum::<f64>() / count);
    let mut points = if polygon.is_empty() { Vec::new() } else { vec![middle] };
    for corner in polygon {
        for s in TOWARDS_CORNER {
            points.push([0, 1].map(|k| middle[k] + s * (corner[k] - middle[k])));
        }
    }
    points
}

/// The point at `offset` from the centre of a pixel, kept inside the box.
fn beside(pixel: Pixel, offset: [f64; 2]) -> [f64; 2] {
    let h = UNSTABLE_HALF_WIDTH_PIXELS;
    let [x, y] = pixel.sample();
    [x + offset[0].clamp(-h, h), y + offset[1].clamp(-h, h)]
}
