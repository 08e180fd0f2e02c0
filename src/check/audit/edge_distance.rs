//! How far a sample is from the nearest edge that it could fall on the wrong side of, in pixels.
//!
//! It only chooses which pixels are audited, so plain f64 will do: nothing is decided by it. With
//! W = c·d of an edge, c = a_i × a_j, the edge's line in the image is W(x, y) = 0, and W over the
//! length of its gradient is the signed distance from that line. No vertex is projected, so corners
//! behind the eye need no case of their own: what is seen of a triangle is where all three
//! W have the sign of V, a convex region whose boundary is as far from a sample inside as its
//! nearest line. From outside the farthest line counts, which is less than the true distance beyond
//! a sharp corner; such a sample is then looked at a little early.

use crate::mesh::TriangleId;
use crate::pixel::Pixel;
use crate::scene::Scene;
use crate::visibility::{Facing, VisibilityBuffer, Visible};

/// Distance in pixels from the sample to the nearest edge of the triangle that is visible there,
/// or of another one that is visible at a pixel beside it; infinite where neither exists.
pub(super) fn edge_distance(scene: &Scene, buffer: &VisibilityBuffer, pixel: Pixel) -> f64 {
    let own = buffer.at(pixel);
    let beside = [
        (pixel.x.wrapping_sub(1), pixel.y),
        (pixel.x + 1, pixel.y),
        (pixel.x, pixel.y.wrapping_sub(1)),
        (pixel.x, pixel.y + 1),
    ];
    let others = beside
        .into_iter()
        .map(|(x, y)| Pixel { x, y })
        .filter(|&other| buffer.window.contains(other))
        .filter_map(|other| buffer.at(other))
        .filter(|other| own.is_none_or(|own| own.triangle != other.triangle));
    let distance = |visible: &Visible| boundary(scene, visible.triangle, visible.facing, pixel);
    own.into_iter().chain(others).map(distance).fold(f64::INFINITY, f64::min)
}

/// Distance in pixels from the sample to the boundary of a triangle's image.
fn boundary(scene: &Scene, triangle: TriangleId, facing: Facing, pixel: Pixel) -> f64 {
    let camera = &scene.camera;
    let eye = camera.eye();
    let [x, y] = pixel.sample();
    let corners = scene.mesh.triangle(triangle).map(|corner| corner.map(f64::from));
    let relative = corners.map(|corner| sub(corner, eye));
    // sgn V: what is inside has all three W of this sign.
    let sign = -f64::from(facing.sign());
    let signed = |i: usize| {
        let j = (i + 1) % 3;
        // a_i × (v_j − v_i) is a_i × a_j with less cancellation for a small, far triangle.
        let c = cross(relative[i], sub(corners[j], corners[i]));
        let (along_x, along_y) = (dot(c, camera.dx()), dot(c, camera.dy()));
        sign * (dot(c, camera.d0()) + x * along_x + y * along_y) / along_x.hypot(along_y)
    };
    // An edge that runs through the eye has no line (0/0); `min` passes over its NaN.
    (0..3).map(signed).fold(f64::INFINITY, f64::min).abs()
}

fn sub(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
