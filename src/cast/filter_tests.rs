//! A hunt for wrong signs: both filters and the certificate against 128-bit integers.
//!
//! Coordinates are integers (vertices of 24 bits, the eye of 28 with two of them below 1), the
//! direction of 53 bits, all times powers of two: W has at most 29 + 29 + 53 + 3 = 114 bits. Rays
//! are aimed at corners and edges and nudged by steps of 2^-53 up to 2^-16, so that W lies on
//! both sides of every level's bound.

use super::coverage;
use super::exact::{self, Vertices};
use super::filter::Relative;
use super::ray::Ray;
use super::single::{Edges, ShearedRay};
use super::unrounded;
use crate::accel::LeafTriangle;
use crate::mesh::TriangleId;
use crate::visibility::Level;

const CASES: usize = 1_000_000;

/// SplitMix64.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ z >> 31
    }

    /// An integer below 2^bits in magnitude.
    fn signed(&mut self, bits: u32) -> i64 {
        (self.next() as i64) >> (63 - bits)
    }

    fn below(&mut self, count: u64) -> u64 {
        self.next() % count
    }
}

/// A case in integers: vertices and eye in quarters, the direction in 2^-53.
struct Case {
    vertices: [[i64; 3]; 3],
    eye: [i64; 3],
    direction: [i64; 3],
    /// Coordinates are integers · 2^scale.
    scale: i32,
}

impl Case {
    fn aimed(random: &mut Random) -> Self {
        // Sizes from a needle's to the scene's, near the origin or far from it.
        let place = 2 + random.below(21) as u32;
        let size = 1 + random.below(u64::from(place)) as u32;
        let center: [i64; 3] = std::array::from_fn(|_| random.signed(place));
        let vertices =
            std::array::from_fn(|_| std::array::from_fn(|k| 4 * (center[k] + random.signed(size))));
        let near_eye = random.below(3) == 0;
        let eye = std::array::from_fn(|k| match (near_eye, random.below(8)) {
            (_, 0) => vertices[0][k],
            (true, _) => 4 * center[k] + random.signed(size + 2),
            (false, _) => random.signed(place + 2),
        });
        // Through a corner or a point of an edge, in 2^-53 of the largest component.
        let (from, to) = (vertices[0], vertices[1 + random.below(2) as usize]);
        let share = random.below(9) as f64 / 8.0;
        let aim: [f64; 3] =
            std::array::from_fn(|k| (from[k] - eye[k]) as f64 + (to[k] - from[k]) as f64 * share);
        let largest = aim.iter().fold(1.0_f64, |m, c| m.max(c.abs()));
        // As it is (few bits) or scaled to all 53 (rounded, hence beside its aim).
        let unit = if random.below(2) == 0 {
            2.0_f64.powi(52 - largest.log2().ceil() as i32)
        } else {
            (1_u64 << 52) as f64 / largest
        };
        let step = 1_i64 << random.below(38);
        let nudged = random.below(4) != 0;
        let direction = std::array::from_fn(|k| {
            (aim[k] * unit).round() as i64 + i64::from(nudged) * random.signed(2) * step
        });
        let scale = match random.below(4) {
            0 => random.below(240) as i32 - 147,
            _ => -2,
        };
        Self { vertices, eye, direction, scale }
    }

    fn ray(&self) -> Ray {
        let power = 2.0_f64.powi(self.scale);
        let direction = self.direction.map(|c| c as f64 / (1_u64 << 53) as f64);
        Ray {
            eye: self.eye.map(|c| c as f64 * power),
            directions: [direction, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        }
    }

    fn triangle(&self) -> LeafTriangle {
        let power = 2.0_f64.powi(self.scale);
        let vertices = self.vertices.map(|v| v.map(|c| (c as f64 * power) as f32));
        LeafTriangle { vertices, id: TriangleId::new(0), copies: 1 }
    }

    /// Signs of W_0, W_1, W_2 and of V.
    fn signs(&self) -> ([i8; 3], i8) {
        let a: [[i128; 3]; 3] = self
            .vertices
            .map(|v| std::array::from_fn(|k| i128::from(v[k]) - i128::from(self.eye[k])));
        let cross = |a: [i128; 3], b: [i128; 3]| -> [i128; 3] {
            std::array::from_fn(|k| {
                let (i, j) = ((k + 1) % 3, (k + 2) % 3);
                a[i] * b[j] - a[j] * b[i]
            })
        };
        let dot = |a: [i128; 3], b: [i128; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let d = self.direction.map(i128::from);
        let w =
            std::array::from_fn(|i| dot(cross(a[(i + 1) % 3], a[(i + 2) % 3]), d).signum() as i8);
        (w, dot(a[0], cross(a[1], a[2])).signum() as i8)
    }
}

/// What a run saw of one filter: enough to know that the hunt was one.
#[derive(Debug, Default)]
struct Seen {
    certain: usize,
    /// Values whose own sign is wrong, all of them within the bound.
    misleading: usize,
    /// The largest of them, as a share of the bound.
    closest: f64,
}

impl Seen {
    fn check(&mut self, value: f64, bound: f64, sign: i8, case: &Case) {
        let computed = i8::from(value > 0.0) - i8::from(value < 0.0);
        let wrong = computed != sign;
        if value.abs() > bound {
            self.certain += 1;
            assert!(
                !wrong,
                "{value:e} beyond {bound:e} has the wrong sign: {:?} {:?} {:?} 2^{}",
                case.vertices, case.eye, case.direction, case.scale
            );
        } else if wrong && bound.is_finite() {
            self.misleading += 1;
            self.closest = self.closest.max(value.abs() / bound);
        }
    }
}

#[test]
fn no_filter_certifies_a_wrong_sign() {
    let mut random = Random(1);
    let mut seen: [Seen; 3] = Default::default();
    let mut unrounded_zeros = 0;
    for _ in 0..CASES {
        let case = Case::aimed(&mut random);
        if case.direction == [0; 3] {
            continue;
        }
        let (ray, triangle) = (case.ray(), case.triangle());
        let v: Vertices = triangle.vertices.map(|v| v.map(f64::from));
        let (signs, plane) = case.signs();
        // f32.
        let sheared = ShearedRay::new(&ray);
        let (w, bound) = sheared.edge_functions(&triangle);
        let depth_sign = sheared.depth_sign();
        for i in 0..3 {
            seen[0].check(f64::from(w[i]), f64::from(bound), signs[i] * depth_sign, &case);
        }
        match sheared.edges(&triangle) {
            Edges::Apart => assert!(signs.contains(&1) && signs.contains(&-1)),
            Edges::Agree(sign) => assert_eq!(signs, [sign; 3]),
            Edges::Open => {}
        }
        // f64, crude and tight, and V.
        let relative = Relative::new(ray.eye, &v);
        let (w, bound) = relative.edge_functions(&ray);
        for i in 0..3 {
            seen[1].check(w[i], bound, signs[i], &case);
            seen[2].check(w[i], relative.tight_edge_bound(&ray, i), signs[i], &case);
            // Without rounding, or not at all.
            if let Some(signed) = unrounded::edge_sign(&ray, &v, i) {
                assert_eq!(signed.zero, signs[i] == 0);
                assert!(signed.zero || signed.sign == signs[i]);
                unrounded_zeros += usize::from(signed.zero);
            }
        }
        if let Some(sign) = relative.plane_and_speed(&ray)[0].sign() {
            assert_eq!(sign, plane);
        }
        if let Some(sign) = unrounded::plane_sign(&ray, &v) {
            assert_eq!(sign, plane);
        }
        // The whole decision, where no tie needs DX and DY.
        if !signs.contains(&0) {
            let (covering, _) = coverage::decide(&ray, &sheared, &triangle);
            assert_eq!(covering.is_some(), plane != 0 && signs == [plane; 3]);
            if let Some(covering) = covering {
                let by_single = sheared.edges(&triangle) != Edges::Open;
                assert_eq!(covering.level == Level::Single, by_single);
            }
        }
    }
    // The hunt came close: values with a wrong sign, at a fair share of each bound.
    for (seen, share) in seen.iter().zip([0.02, 0.02, 0.05]) {
        assert!(seen.certain > CASES / 2, "{seen:?}");
        assert!(seen.misleading > CASES / 100, "{seen:?}");
        assert!(seen.closest > share && seen.closest < 1.0, "{seen:?}");
    }
    assert!(unrounded_zeros > CASES / 100, "{unrounded_zeros}");
}

/// `sgn*` without rounding is that of the expansions, ties along DX and DY included, and so is the
/// order of two planes.
#[test]
fn on_grids_nothing_rounds_and_ties_are_decided() {
    let mut random = Random(2);
    let (mut zeros, mut planes, mut shared_corners) = (0, 0, 0);
    for _ in 0..50_000 {
        let mut point = || -> [f64; 3] { std::array::from_fn(|_| random.signed(3) as f64) };
        let (a, eye) = ([point(), point(), point()], point());
        let (b, directions) = ([point(), point(), point()], [point(), point(), point()]);
        let mut ray = Ray { eye, directions };
        // Half of the rays through a corner.
        let through_corner = random.below(2) == 0;
        if through_corner {
            ray.directions[0] = std::array::from_fn(|k| a[0][k] - eye[k]);
        }
        for i in 0..3 {
            let signed = unrounded::edge_sign(&ray, &a, i).expect("few bits");
            assert_eq!(signed, exact::edge_sign(&ray, &a, i));
            zeros += usize::from(signed.zero);
            let value = unrounded::edge_value(&ray, &a, i).expect("few bits");
            assert_eq!(value.abs(), exact::edge_magnitude(&ray, &a, i));
        }
        // B in A's plane, or beside A at its first corner, or anywhere.
        let b = match random.below(3) {
            0 => [a[1], a[2], sum(a[0], a[1], a[2])],
            1 => [a[0], b[1], b[2]],
            _ => b,
        };
        let signs = [&a, &b].map(|v| exact::plane_sign(&ray, v));
        assert_eq!(unrounded::plane_sign(&ray, &a), Some(signs[0]));
        if signs.contains(&0) {
            continue;
        }
        let f = unrounded::depth_sign(&ray, (&a, signs[0]), (&b, signs[1])).expect("few bits");
        assert_eq!(f, exact::depth_sign(&ray, (&a, signs[0]), (&b, signs[1])));
        planes += usize::from(f.sign == 0);
        shared_corners += usize::from(f.zero && f.sign != 0);
    }
    assert!(
        zeros > 5000 && planes > 5000 && shared_corners > 5000,
        "{zeros} {planes} {shared_corners}"
    );
}

/// a + b − c.
fn sum(c: [f64; 3], a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| a[k] + b[k] - c[k])
}
