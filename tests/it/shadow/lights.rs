//! Where lights are hard: on and above vertices, on edges, in planes, at the eye, along edges, and
//! at the ends of the range of numbers.

use crate::support::scenes::{Sequence, Triangle};
use truecast::scene::Scene;
use truecast::scene::light_point::LightPoint::{self, Direction, Position};

/// Lights that nothing lines up with; positions within `reach` of the origin.
pub(super) fn generic(reach: f64) -> Vec<LightPoint> {
    let mut random = Sequence(11);
    let mut point = || std::array::from_fn(|_| (random.next() - 0.5) * 2.0 * reach);
    let mut lights: Vec<_> = (0..2).map(|_| Position(point())).collect();
    lights.extend((0..2).map(|_| Direction(unit(point()))));
    lights
}

/// Lights aimed at what the triangle is made of, with the eye's own place.
pub(super) fn aimed(scene: &Scene, triangle: Triangle) -> Vec<LightPoint> {
    let [a, b, c] = triangle.map(|v| v.map(f64::from));
    let plus = |p: [f64; 3], q: [f64; 3], s: f64| std::array::from_fn(|k| p[k] + q[k] * s);
    let edge = |p: [f64; 3], q: [f64; 3]| plus(q, p, -1.0);
    let (ab, ac) = (edge(a, b), edge(a, c));
    let height = ab.iter().chain(&ac).fold(0.0_f64, |m, c| m.max(c.abs()));
    let above = |v: [f64; 3]| [v[0], v[1], v[2] - height];
    let mut lights = vec![
        Position(scene.camera.eye()),
        // On a vertex, on an edge, on the triangle, in its plane.
        Position(b),
        Position(plus(a, ab, 0.5)),
        Position(plus(plus(a, ab, 0.25), ac, 0.25)),
        Position(plus(plus(a, ab, 2.0), ac, 3.0)),
        // Above a vertex and above an edge; between the eye and a vertex.
        Position(above(a)),
        Position(plus(above(c), ab, 0.5)),
        Position(plus(scene.camera.eye(), edge(scene.camera.eye(), b), 0.5)),
    ];
    // Along edges, made unit or as they are, and along the axes.
    lights.extend([ab, edge(b, c), ab.map(|c| -c)].map(Direction));
    lights.push(Direction(unit(ac)));
    for axis in 0..3 {
        for sign in [1.0, -1.0] {
            lights.push(Direction(std::array::from_fn(|k| if k == axis { sign } else { 0.0 })));
        }
    }
    lights
}

/// Lights whose numbers leave the range of f64 products.
pub(super) fn extreme() -> Vec<LightPoint> {
    let at = |scale: f64| Position([0.3 * scale, -0.7 * scale, -1.1 * scale]);
    vec![
        at(2.0_f64.powi(100)),
        at(2.0_f64.powi(-100)),
        at(2.0_f64.powi(700)),
        at(1e308),
        at(5e-324),
        at(1e-300),
        Position([1e308, 5e-324, -3.0]),
        Direction([0.3e-200, -0.7, -1.1e-200]),
        Direction([1e300, 5e-324, -1e300]),
        Direction([5e-324, 5e-324, -5e-324]),
    ]
}

fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = v.iter().map(|c| c * c).sum::<f64>().sqrt();
    v.map(|c| c / length)
}
