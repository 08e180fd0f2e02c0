//! The teapot: the published numbers, no cracks, the edges it should have, smooth normals.

use super::super::bezier::{self, Patch};
use super::super::teapot::Surface;
use super::super::topology::{check_attributes, dot, weld};
use super::super::*;
use std::collections::HashSet;

/// The parts, in order: body, lid, handle, spout.
fn surfaces() -> Vec<Surface> {
    Teapot::default().surfaces()
}

fn mesh_of(surface: &Surface, segments: u32) -> MeshPart {
    let mut part = MeshPart::default();
    surface.append(&mut part, segments);
    part
}

#[test]
fn the_control_points_are_the_published_ones() {
    // Counts and sums over the 32 × 16 control points of the data set as it is passed on, turned
    // to y up. The numbers are decimal fractions, so sums carry roundings of some 512 additions.
    const BOUND: f64 = 512.0 * f64::EPSILON * 2063.0;
    let surfaces = surfaces();
    let patches: Vec<&Patch> = surfaces.iter().flat_map(|s| s.bands.iter().flatten()).collect();
    assert_eq!(patches.len(), 32);
    let points: Vec<[f64; 3]> = patches.iter().copied().flatten().flatten().copied().collect();
    let distinct: HashSet<[u64; 3]> =
        points.iter().map(|p| p.map(|c| (c + 0.0).to_bits())).collect();
    assert_eq!(distinct.len(), 290);
    let sum = |term: fn(&[f64; 3]) -> f64| points.iter().map(term).sum::<f64>();
    let near = |found: f64, expected: f64| assert!((found - expected).abs() <= BOUND, "{found}");
    near(sum(|p| p[0]), 18.9);
    near(sum(|p| p[1]), 883.275);
    near(sum(|p| p[2]), 0.0);
    near(sum(|p| p[0] * p[0]), 1335.829272);
    near(sum(|p| p[1] * p[1]), 2062.79015625);
    near(sum(|p| p[2] * p[2]), 420.931572);
}

#[test]
fn patches_that_meet_share_their_normals() {
    // Tangents of length 0.2 or more from sums of 16 terms up to 3.5, a few roundings each.
    const BOUND: f64 = 1e-13;
    let steps = || (0..=8).map(|k| f64::from(k) / 8.0);
    let check = |a: [f64; 3], b: [f64; 3]| {
        assert!(a.into_iter().zip(b).all(|(a, b)| (a - b).abs() <= BOUND), "{a:?} {b:?}");
    };
    for surface in surfaces() {
        for band in &surface.bands {
            for (k, patch) in band.iter().enumerate() {
                let right = &band[(k + 1) % band.len()];
                for u in steps() {
                    assert_eq!(bezier::point(patch, u, 1.0), bezier::point(right, u, 0.0));
                    check(bezier::normal(patch, u, 1.0), bezier::normal(right, u, 0.0));
                }
            }
        }
        for bands in surface.bands.windows(2) {
            for (above, below) in bands[0].iter().zip(&bands[1]) {
                for v in steps() {
                    assert_eq!(bezier::point(above, 1.0, v), bezier::point(below, 0.0, v));
                    check(bezier::normal(above, 1.0, v), bezier::normal(below, 0.0, v));
                }
            }
        }
    }
}

#[test]
fn parts_are_whole_but_for_their_known_edges() {
    for segments in [2, 3, 7, 10] {
        // The body ends at the rim's inner edge, the lid at its lower one, tubes at both ends.
        let n = segments as usize;
        let expected = [(1, 4 * n), (1, 4 * n), (0, 4 * n), (0, 4 * n)];
        for (surface, expected) in surfaces().iter().zip(expected) {
            let welded = weld(&mesh_of(surface, segments));
            assert_eq!((welded.euler, welded.boundary), expected);
        }
        let open = Teapot { bottom: false, ..Teapot::default() }.surfaces();
        let welded = weld(&mesh_of(&open[0], segments));
        assert_eq!((welded.euler, welded.boundary), (0, 8 * n));

        // Together they share no edge, and one point: the handle's lower end touches the body.
        let whole = build(&Shape::Teapot(Teapot { segments, ..Teapot::default() })).expect("fits");
        assert_eq!(whole.corners.len(), 64 * n * n - 8 * n);
        let welded = weld(&whole);
        assert_eq!((welded.euler, welded.boundary), (2 - 1, 16 * n));
    }
}

#[test]
fn normals_are_unit_finite_and_on_the_side_of_the_winding() {
    for segments in [2, 3, 5, 6, 7, 10, 33] {
        for (number, surface) in surfaces().iter().enumerate() {
            let least = check_attributes(&mesh_of(surface, segments));
            // The lip folds back within a quarter of a patch: it takes 6 segments to follow. The
            // tip of the lid's knob takes 3.
            let enough = [2, 3, 2, 6][number];
            assert!(segments < enough || least > 0.0, "part {number} at {segments}: {least}");
        }
    }
}

#[test]
fn normals_at_the_poles_are_the_limit() {
    let part = build(&Shape::Teapot(Teapot::default())).expect("fits");
    let normal_at = |point: [f64; 3]| {
        let index = part.positions.iter().position(|p| *p == point).expect("a vertex");
        part.normals[index]
    };
    assert_eq!(normal_at([0.0, 3.15, 0.0]), [0.0, 1.0, 0.0]);
    assert_eq!(normal_at([0.0; 3]), [0.0, -1.0, 0.0]);
    let surfaces = surfaces();
    let [bottom, tip] = [surfaces[0].bands.last().expect("bands"), &surfaces[1].bands[0]];
    // Beside the tip the profile turns by 1.8 / 2.4 = 0.75 radians per unit of u, beside the
    // bottom's centre by 0.45 / 4.275: the normal turns by less than the step.
    const STEP: f64 = 1e-6;
    const BOUND: f64 = 0.5 * (STEP * STEP) + 4.0 * f64::EPSILON;
    for (patches, pole, beside) in [(tip, 0.0, STEP), (bottom, 1.0, 1.0 - STEP)] {
        for patch in patches {
            for v in [0.0, 0.3, 1.0] {
                let [a, b] = [pole, beside].map(|u| bezier::normal(patch, u, v));
                assert!(1.0 - dot(a, b) <= BOUND, "{a:?} {b:?}");
            }
        }
    }
}

#[test]
fn it_stands_upright_with_the_spout_towards_x_and_faces_outwards() {
    let part = build(&Shape::Teapot(Teapot { segments: 20, ..Teapot::default() })).expect("fits");
    let range = |axis: usize| {
        let fold =
            |f: fn(f64, f64) -> f64, start| part.positions.iter().map(|p| p[axis]).fold(start, f);
        [fold(f64::min, f64::INFINITY), fold(f64::max, -f64::INFINITY)]
    };
    assert_eq!(range(1), [0.0, 3.15]);
    assert_eq!(range(2), [-2.0, 2.0]);
    let [handle, spout] = range(0);
    assert!((-3.0..-2.8).contains(&handle) && (3.4..3.5).contains(&spout), "{handle} {spout}");

    // Where a part reaches furthest sideways, its outside looks that way.
    for surface in surfaces() {
        let part = mesh_of(&surface, 20);
        let vertices = part.positions.iter().zip(&part.normals);
        let (_, normal) = vertices.max_by(|a, b| a.0[2].total_cmp(&b.0[2])).expect("vertices");
        assert!(normal[2] > 0.9, "{normal:?}");
    }
}
