//! Polygons with known answers: which triangles, that they cover the area, and what is refused.

use super::*;

/// Scales plane corners, put at height `x + 2 y` so that no axis is special.
fn scaled(plane: &[[f64; 2]]) -> Vec<[f64; 3]> {
    let mut out = Vec::new();
    scale_corners(plane.iter().map(|p| [p[0], p[1], p[0] + 2.0 * p[1]]), &mut out);
    out
}

fn split(plane: &[[f64; 2]]) -> (Outcome, Vec<Triangle>) {
    let mut triangles = Vec::new();
    let outcome = triangulate(&scaled(plane), &mut triangles);
    (outcome, triangles)
}

/// Demands `n − 2` triangles, none turned over, that add up to the polygon's area. With no
/// overlap possible at equal sums of unsigned areas, this is a triangulation.
#[track_caller]
fn assert_covers(plane: &[[f64; 2]], triangles: &[Triangle]) {
    assert_eq!(triangles.len(), plane.len() - 2);
    let areas: Vec<f64> = triangles
        .iter()
        .map(|t| {
            let [a, b, c] = t.map(|corner| plane[corner as usize]);
            turn(a, b, c)
        })
        .collect();
    let shoelace: f64 = (0..plane.len())
        .map(|i| {
            let (a, b) = (plane[i], plane[(i + 1) % plane.len()]);
            a[0] * b[1] - a[1] * b[0]
        })
        .sum();
    // Rounding of a sum of n terms of size area: n units of roundoff; 1e-12 is over 1000 of them.
    assert!(areas.iter().all(|&area| area >= -1e-12 * shoelace), "{areas:?}");
    assert!((areas.iter().sum::<f64>() - shoelace).abs() <= 1e-12 * shoelace, "{areas:?}");
}

#[test]
fn convex_polygons_are_fans() {
    let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    assert_eq!(split(&square), (Outcome::Covered, vec![[0, 1, 2], [0, 2, 3]]));
    // A straight corner keeps the fan, and with it a triangle without area.
    let straight = [[0.0, 0.0], [0.5, 0.0], [1.0, 0.0], [1.0, 1.0]];
    assert_eq!(split(&straight), (Outcome::Covered, vec![[0, 1, 2], [0, 2, 3]]));
    let circle: Vec<[f64; 2]> = (0..100_000)
        .map(|i| f64::from(i) * 1e-5 * std::f64::consts::TAU)
        .map(|a| [a.cos(), a.sin()])
        .collect();
    let (outcome, triangles) = split(&circle);
    assert_eq!((outcome, triangles.len()), (Outcome::Covered, 99_998));
    assert_eq!(triangles[50_000], [0, 50_001, 50_002]);
}

#[test]
fn a_dart_is_cut_through_its_reflex_corner_wherever_it_starts() {
    let dart = [[0.0, 0.0], [2.0, 1.0], [0.0, 2.0], [1.0, 1.0]];
    for shift in 0..4 {
        let mut turned = dart;
        turned.rotate_left(shift);
        let (outcome, triangles) = split(&turned);
        assert_eq!(outcome, Outcome::Covered);
        assert_covers(&turned, &triangles);
    }
    assert_eq!(split(&dart).1, [[1, 2, 3], [1, 3, 0]]);
}

#[test]
fn concave_polygons_are_covered() {
    let comb: Vec<[f64; 2]> = (0..200)
        .map(|i| [f64::from(200 - i), if i % 2 == 0 { 1.0 } else { 5.0 }])
        .chain([[0.0, 0.0], [200.0, 0.0]])
        .collect();
    let ell = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
    // A square with a square hole, joined by a bridge that is walked twice.
    let bridged = [
        [0.0, 0.0],
        [4.0, 0.0],
        [4.0, 4.0],
        [0.0, 4.0],
        [0.0, 0.0],
        [1.0, 1.0],
        [1.0, 3.0],
        [3.0, 3.0],
        [3.0, 1.0],
        [1.0, 1.0],
    ];
    for polygon in [comb.as_slice(), &ell, &bridged] {
        for shift in 0..polygon.len() {
            let mut turned = polygon.to_vec();
            turned.rotate_left(shift);
            let (outcome, triangles) = split(&turned);
            assert_eq!(outcome, Outcome::Covered, "shift {shift}");
            assert_covers(&turned, &triangles);
        }
    }
}

#[test]
fn a_spiral_of_many_corners_is_covered_in_time() {
    let arm = |i: u32, width: f64| {
        let angle = f64::from(i) * 0.05;
        let radius = angle + width;
        [radius * angle.cos(), radius * angle.sin()]
    };
    let spiral: Vec<[f64; 2]> =
        (20..2020).map(|i| arm(i, 2.0)).chain((20..2020).rev().map(|i| arm(i, 0.0))).collect();
    let (outcome, triangles) = split(&spiral);
    assert_eq!(outcome, Outcome::Covered);
    assert_covers(&spiral, &triangles);
}

#[test]
fn crossing_polygons_are_told() {
    let bow_tie = [[0.0, 0.0], [2.0, 0.0], [0.0, 1.0], [2.0, 1.0]];
    let uneven = [[0.0, 0.0], [2.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    let star: Vec<[f64; 2]> = (0..5)
        .map(|i| f64::from(i) * 0.8 * std::f64::consts::PI)
        .map(|angle| [angle.cos(), angle.sin()])
        .collect();
    for polygon in [bow_tie.as_slice(), &uneven, &star] {
        let (outcome, triangles) = split(polygon);
        assert_eq!(outcome, Outcome::NotSimple, "{polygon:?}");
        assert_eq!(triangles.len(), polygon.len() - 2);
        assert_eq!(triangles[0], [0, 1, 2]);
    }
}

#[test]
fn polygons_without_area_are_fans() {
    let line = [[0.0, 0.0], [1.0, 1.0], [2.0, 2.0], [3.0, 3.0]];
    assert_eq!(split(&line), (Outcome::Covered, vec![[0, 1, 2], [0, 2, 3]]));
    let point = [[7.0, 7.0]; 5];
    assert_eq!(split(&point).0, Outcome::Covered);
}

#[test]
fn a_concave_polygon_beyond_the_limit_is_refused() {
    let saw: Vec<[f64; 2]> = (0..MAX_CONCAVE_CORNERS as u32)
        .map(|i| [-f64::from(i), f64::from(i % 2)])
        .chain([[-1e5, -1e5]])
        .collect();
    assert_eq!(split(&saw), (Outcome::TooLarge, vec![]));
}

#[test]
fn no_scale_under_or_overflows() {
    for scale in [f64::MAX, 1e300, 1.0, 1e-300, 1e-320] {
        let mut out = Vec::new();
        let corners = [[-scale, -scale, 0.0], [scale, -scale, 0.0], [scale, scale, 0.0]];
        scale_corners(corners.into_iter(), &mut out);
        assert_eq!(unit_normal(&out), Some([0.0, 0.0, 1.0]), "{scale}");
    }
}
