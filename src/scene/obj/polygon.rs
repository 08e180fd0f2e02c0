//! Polygons into triangles: convex ones as a fan, concave ones by clipping ears, or, where it is
//! asked for, all of them as a fan.
//!
//! Works in f64 with named bounds; which triangles result is a convention, not a proof. Newell's
//! normal after Sutherland, Sproull and Schumacker, "A Characterization of Ten Hidden-Surface
//! Algorithms"; ears after Meisters, "Polygons Have Ears".

mod ears;

/// How polygons become triangles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Polygons {
    /// Convex polygons as a fan, concave ones by clipping ears: every polygon is covered once.
    #[default]
    Ears,
    /// Every polygon as a fan around its first corner, as many programs do; of a concave polygon
    /// that covers other places than the polygon.
    Fan,
}

impl Polygons {
    /// Every way, with its word.
    pub const ALL: [(&'static str, Self); 2] = [("ears", Self::Ears), ("fan", Self::Fan)];
}

/// Corner numbers of one triangle within its polygon.
pub(super) type Triangle = [u32; 3];

/// Unit roundoff of f64.
const UNIT_ROUNDOFF: f64 = f64::EPSILON / 2.0;

/// A turn of at most this counts as straight, with corners scaled to differences of at most 1.
/// A projected component is off by less than 12 units of roundoff (difference, scaling, basis and
/// dot product), its differences are below 4 and off by 24, so a product of two is off by less
/// than 200 and the difference of two products by less than 512.
pub(super) const STRAIGHT: f64 = 512.0 * UNIT_ROUNDOFF;

/// Most corners of a concave polygon; ear clipping takes quadratic time (below 0.3 s at this size).
pub(super) const MAX_CONCAVE_CORNERS: usize = 8192;

/// What became of a polygon.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Outcome {
    /// Its triangles cover it once.
    Covered,
    /// It crosses itself, or has no plane: a fan was made of it.
    NotSimple,
    /// Concave and larger than [`MAX_CONCAVE_CORNERS`]: no triangles.
    TooLarge,
}

/// Corners relative to the first one and divided by the largest difference, so that no product
/// under- or overflows. All zero where all corners are equal.
pub(super) fn scale_corners(corners: impl Iterator<Item = [f64; 3]>, scaled: &mut Vec<[f64; 3]>) {
    scaled.clear();
    scaled.extend(corners);
    let Some(&first) = scaled.first() else { return };
    let extent = |points: &[[f64; 3]], origin: [f64; 3]| {
        let differences = points.iter().flat_map(|p| [0, 1, 2].map(|k| (p[k] - origin[k]).abs()));
        differences.fold(0.0, f64::max)
    };
    let mut origin = first;
    let mut largest = extent(scaled, origin);
    if largest.is_infinite() {
        // Differences of numbers near the end of f64's range; a quarter of each is exact.
        origin = origin.map(|c| c / 4.0);
        scaled.iter_mut().flatten().for_each(|c| *c /= 4.0);
        largest = extent(scaled, origin);
    }
    if largest == 0.0 {
        largest = 1.0;
    }
    for point in scaled {
        *point = [0, 1, 2].map(|k| (point[k] - origin[k]) / largest);
    }
}

/// Twice the vector area of a polygon of scaled corners: Newell's normal, not unit.
pub(super) fn vector_area(scaled: &[[f64; 3]]) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for pair in scaled.windows(2) {
        let product = cross(pair[0], pair[1]);
        sum = [0, 1, 2].map(|k| sum[k] + product[k]);
    }
    sum
}

/// Unit normal of a polygon of scaled corners; `None` where it has no area beyond rounding.
///
/// Of k corners, each component of each cross product is off by at most 12 units of roundoff
/// (scaled corners by 2, products by 5, their difference by 12), and each addition by the size of
/// the partial sum, at most 2k.
pub(super) fn unit_normal(scaled: &[[f64; 3]]) -> Option<[f64; 3]> {
    let area = vector_area(scaled);
    let count = scaled.len() as f64;
    let bound = count * (12.0 + 2.0 * count) * UNIT_ROUNDOFF;
    let largest = area.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
    (largest > bound).then(|| unit(area.map(|c| c / largest)))
}

/// Appends the triangles of a polygon of scaled corners, at least 3.
pub(super) fn triangulate(scaled: &[[f64; 3]], triangles: &mut Vec<Triangle>) -> Outcome {
    let Some(normal) = unit_normal(scaled) else {
        append_fan(scaled.len(), triangles);
        let has_area = |p: &[[f64; 3]]| unit_normal(&[scaled[0], p[0], p[1]]).is_some();
        return match scaled.windows(2).any(has_area) {
            true => Outcome::NotSimple,
            false => Outcome::Covered,
        };
    };
    let plane = project(scaled, normal);
    if is_convex(&plane) {
        append_fan(scaled.len(), triangles);
        return Outcome::Covered;
    }
    if scaled.len() > MAX_CONCAVE_CORNERS {
        return Outcome::TooLarge;
    }
    let start = triangles.len();
    if ears::clip(&plane, triangles) {
        return Outcome::Covered;
    }
    triangles.truncate(start);
    append_fan(scaled.len(), triangles);
    Outcome::NotSimple
}

/// (0,1,2), (0,2,3), …
pub(super) fn append_fan(count: usize, triangles: &mut Vec<Triangle>) {
    triangles.extend((2..count as u32).map(|corner| [0, corner - 1, corner]));
}

/// Coordinates in the plane across `normal`, counter-clockwise as seen from its tip.
fn project(scaled: &[[f64; 3]], normal: [f64; 3]) -> Vec<[f64; 2]> {
    // The axis that is farthest from the normal gives the best-conditioned basis.
    let smallest = (0..3).min_by(|&a, &b| normal[a].abs().total_cmp(&normal[b].abs()));
    let mut axis = [0.0; 3];
    axis[smallest.unwrap_or(0)] = 1.0;
    let right = unit(cross(axis, normal));
    let up = cross(normal, right);
    scaled.iter().map(|&point| [dot(point, right), dot(point, up)]).collect()
}

/// No right turn, and only one turn around: each direction along x is taken once. (The corners of
/// a pentagram turn left throughout as well, but go around twice.)
fn is_convex(plane: &[[f64; 2]]) -> bool {
    let count = plane.len();
    let at = |position: usize| plane[position % count];
    if (0..count).any(|i| turn(at(i), at(i + 1), at(i + 2)) < -STRAIGHT) {
        return false;
    }
    let mut changes = 0;
    let mut last = 0.0;
    let mut first = 0.0;
    for i in 0..count {
        let step = at(i + 1)[0] - at(i)[0];
        if step.abs() <= STRAIGHT {
            continue;
        }
        let direction = step.signum();
        if last == 0.0 {
            first = direction;
        } else if direction != last {
            changes += 1;
        }
        last = direction;
    }
    changes + usize::from(first != last) <= 2
}

/// Twice the signed area of a triangle; positive where its corners turn left.
fn turn(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Of a vector whose largest component is near 1.
fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = dot(v, v).sqrt();
    v.map(|c| c / length)
}

#[cfg(test)]
mod tests;
