//! The kinds of structured scenes: `count` triangles, more or less, and an eye that suits them.
//!
//! The camera looks along +z with samples at whole numbers; vertices are on whole numbers where
//! ties are wanted.

use crate::support::rays::Random;
use crate::support::scenes::{Triangle, rectangle};

/// A kind of structure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Grid,
    Fan,
    Decals,
    Sheets,
    MixedScales,
    EyeOnPlanes,
    ClosedMesh,
    Soup,
}

const ORIGIN: [f64; 3] = [0.0; 3];

/// How far corners lie apart: large sets keep to short edges, or every sample crosses all of them.
fn reach_of(count: usize) -> i32 {
    if count > 500 { 1 } else { 8 }
}

/// About `count` triangles of that kind, and the eye.
pub(super) fn triangles_of(
    kind: Kind,
    count: usize,
    random: &mut Random,
) -> (Vec<Triangle>, [f64; 3]) {
    match kind {
        Kind::Grid => (grids(count, random), ORIGIN),
        Kind::Fan => (fans(count, random), ORIGIN),
        Kind::Decals => (decals(count, random), ORIGIN),
        Kind::Sheets => (sheets(count, random), ORIGIN),
        Kind::MixedScales => (mixed_scales(count, random), ORIGIN),
        Kind::EyeOnPlanes => eye_on_planes(count, random),
        Kind::ClosedMesh => closed_mesh(count, random),
        Kind::Soup => (soup(count, random), ORIGIN),
    }
}

/// Squares whose corners are seen at pixel centres, in layers at depths 8, 16, 24 …; in each layer
/// some squares are missing or turned round.
fn grids(count: usize, random: &mut Random) -> Vec<Triangle> {
    let mut triangles = Vec::new();
    let mut layer = 1.0;
    while triangles.len() < count {
        let cell = if count > 500 { 1 } else { 1 + random.below(6) } as f32 * layer;
        let half = (32.0 * layer / cell).floor();
        let mut y = -half * cell;
        while y < half * cell && triangles.len() < count {
            let mut x = -half * cell;
            while x < half * cell && triangles.len() < count {
                let [mut a, b] = rectangle([x, y], [x + cell, y + cell], 8.0 * layer);
                if random.below(3) == 0 {
                    a.swap(0, 1);
                }
                match random.below(8) {
                    0 => {}
                    1 => triangles.push(b),
                    _ => triangles.extend([a, b]),
                }
                x += cell;
            }
            y += cell;
        }
        layer += 1.0;
    }
    triangles
}

/// Fans around hubs that are seen at pixel centres, with rims on whole numbers or beside them.
fn fans(count: usize, random: &mut Random) -> Vec<Triangle> {
    let mut triangles = Vec::new();
    while triangles.len() < count {
        let blades = (3 + random.below(60)).min(count - triangles.len() + 2);
        let z = 8.0 * (1 + random.below(4)) as f32;
        let hub = [random.integer(20), random.integer(12), z];
        let radius = if count > 500 { 1.0 + random.unit() } else { 2.0 + 10.0 * random.unit() };
        let on_whole_numbers = random.below(2) == 0;
        let rim = |k: usize| {
            let angle = std::f64::consts::TAU * (k % blades) as f64 / blades as f64;
            let [x, y] = [angle.cos(), angle.sin()].map(|c| (radius * c) as f32);
            let [x, y] = if on_whole_numbers { [x.round(), y.round()] } else { [x, y] };
            [hub[0] + x, hub[1] + y, z]
        };
        triangles.extend((0..blades).map(|k| [hub, rim(k), rim(k + 1)]));
    }
    triangles
}

/// Triangles of whole numbers in few planes: x + 2y + 3z = c, z = c, and copies.
fn decals(count: usize, random: &mut Random) -> Vec<Triangle> {
    let mut triangles: Vec<Triangle> = Vec::with_capacity(count);
    let reach = reach_of(count);
    while triangles.len() < count {
        let plane = 8.0 * (1 + random.below(3)) as f32;
        let tilted = random.below(2) == 0;
        let middle = [random.integer(24), random.integer(12), random.integer(6)];
        let corner = |random: &mut Random| {
            let [x, y, z] = middle.map(|c| c + random.integer(reach));
            match tilted {
                true => [3.0 * plane - 2.0 * y - 3.0 * z, y, z],
                false => [x, y, plane],
            }
        };
        let triangle = [corner(random), corner(random), corner(random)];
        triangles.push(triangle);
        if random.below(4) == 0 {
            let [a, b, c] = triangle;
            triangles.push([[b, c, a], [a, c, b], [c, a, b]][random.below(3)]);
        }
    }
    triangles
}

/// Parallel and slanted sheets whose depths are neighbouring floats, in random order.
fn sheets(count: usize, random: &mut Random) -> Vec<Triangle> {
    let mut triangles = Vec::with_capacity(count);
    let slant = random.integer(3);
    for _ in 0..count.div_ceil(2) {
        let steps = random.below(40) as u32;
        let depth = |z: f32| f32::from_bits(z.to_bits() + steps);
        let reach = 400.0;
        let [near, far] = [1000.0 - 100.0 * slant, 1000.0 + 100.0 * slant].map(depth);
        // A window of the sheet, so that large stacks stay cheap: a few columns each.
        let x = random.integer(300);
        let corner = |x: f32, y: f32| [x, y, if y < 0.0 { near } else { far }];
        let wide = if count < 100 { 3000.0 } else { 40.0 };
        let [a, b, c, d] = [
            corner(x - wide, -reach),
            corner(x + wide, -reach),
            corner(x + wide, reach),
            corner(x - wide, reach),
        ];
        triangles.extend([[a, b, c], [a, c, d]]);
    }
    triangles
}

/// Every triangle has a size of its own between 2^-100 and 2^100, and lies where it is seen.
fn mixed_scales(count: usize, random: &mut Random) -> Vec<Triangle> {
    (0..count)
        .map(|_| {
            let size = 2.0_f64.powi(random.below(201) as i32 - 100);
            let reach = if count > 1000 { 0.05 } else { 2.0 };
            let center = [random.integer(20), random.integer(12), 8.0].map(f64::from);
            [0; 3]
                .map(|_| center.map(|c| ((c + reach * (2.0 * random.unit() - 1.0)) * size) as f32))
        })
        .collect()
}

/// Whole-number triangles seen from an eye that lies in the planes of many and on some.
fn eye_on_planes(count: usize, random: &mut Random) -> (Vec<Triangle>, [f64; 3]) {
    let eye = [random.integer(2), random.integer(2), random.integer(2)];
    let mut triangles: Vec<Triangle> = Vec::with_capacity(count);
    let reach = reach_of(count);
    while triangles.len() < count {
        let middle = [random.integer(12), random.integer(8), random.integer(12)];
        let mut corner = || middle.map(|c| c + random.integer(reach));
        let [a, b, c] = [corner(), corner(), corner()];
        // The eye, a, and a combination of both with b: their plane holds the eye.
        let through: [f32; 3] = std::array::from_fn(|k| 2.0 * eye[k] - a[k]);
        // Every sample meets the box of a triangle around the eye: few of those in large sets.
        triangles.push(match random.below(if count > 500 { 600 } else { 6 }) {
            0 => [a, b, through],
            1 => [a, b, std::array::from_fn(|k| a[k] + b[k] - eye[k])],
            2 => [eye, a, b],
            3 => [[eye[0], b[1], b[2]], [eye[0], c[1], c[2]], a],
            _ => [a, b, c],
        });
    }
    (triangles, eye.map(f64::from))
}

/// Closed spheres of random whole-number corners, and an eye in the halves that lies on none of
/// their planes.
fn closed_mesh(count: usize, random: &mut Random) -> (Vec<Triangle>, [f64; 3]) {
    let eye = [0.5, -0.5, -30.5];
    let mut triangles: Vec<Triangle> = Vec::new();
    // Large meshes are finer, not more crowded: a ring grid with corners jittered about a sphere.
    let segments = ((count as f64 / 2.0).sqrt() as usize).clamp(3, 223);
    let reach = 20.0;
    let corner = |ring: usize, segment: usize, random: &mut Random| -> [f32; 3] {
        let polar = std::f64::consts::PI * (ring as f64 + 1.0) / (segments as f64 + 1.0);
        let around = std::f64::consts::TAU * segment as f64 / segments as f64;
        let on_sphere = [polar.sin() * around.cos(), polar.cos(), polar.sin() * around.sin()];
        on_sphere.map(|c| (c * reach).round() as f32 + random.integer(2))
    };
    let rings: Vec<Vec<[f32; 3]>> = (0..segments)
        .map(|ring| (0..segments).map(|segment| corner(ring, segment, random)).collect())
        .collect();
    let poles = [[0.0, reach as f32, 0.0], [0.0, -reach as f32, 0.0]];
    for k in 0..segments {
        let next = (k + 1) % segments;
        triangles.push([poles[0], rings[0][k], rings[0][next]]);
        for pair in rings.windows(2) {
            triangles.push([pair[0][k], pair[1][k], pair[1][next]]);
            triangles.push([pair[0][k], pair[1][next], pair[0][next]]);
        }
        triangles.push([rings[segments - 1][k], poles[1], rings[segments - 1][next]]);
    }
    (triangles, eye)
}

/// Triangles that grow across each other's edges, on whole numbers, without any order.
fn soup(count: usize, random: &mut Random) -> Vec<Triangle> {
    let mut triangles: Vec<Triangle> = Vec::with_capacity(count);
    let step = reach_of(count);
    while triangles.len() < count {
        if triangles.is_empty() || random.below(12) == 0 {
            let at = [random.integer(24), random.integer(16), 4.0 + random.integer(12)];
            let other = |random: &mut Random| at.map(|c| c + random.integer(step));
            triangles.push([at, other(random), other(random)]);
            continue;
        }
        let [a, b, c] = triangles[random.below(triangles.len())];
        let [a, b] = [[a, b], [b, c], [c, a]][random.below(3)];
        let tip = a.map(|c| c + random.integer(step));
        triangles.push(if random.below(2) == 0 { [b, a, tip] } else { [a, b, tip] });
    }
    triangles
}
