//! The shapes for scenes of many triangles: counts, bits, attributes, and what they promise.

use super::super::topology::{check_attributes, weld};
use super::super::*;
use sha2::{Digest, Sha256};

fn built(shape: &Shape) -> MeshPart {
    build(shape).expect("in range")
}

fn samples() -> Vec<Shape> {
    vec![
        Shape::Terrain(Terrain::default()),
        Shape::Terrain(Terrain { size: 3.0, height: 1.0, cells: 1, seed: 0 }),
        Shape::Terrain(Terrain { cells: 33, seed: u32::MAX, ..Terrain::default() }),
        Shape::Soup(Soup::default()),
        Shape::Soup(Soup { count: 1000, size: 4.0, extent: 4.0, seed: 5 }),
        Shape::Soup(Soup { count: 1000, size: 1e-5, extent: 1.0, seed: 6 }),
        Shape::Hall(Hall { columns: 1, detail: 1 }),
        Shape::Hall(Hall { columns: 3, detail: 3 }),
        Shape::Hall(Hall::default()),
        Shape::TeapotField(TeapotField { columns: 3, rows: 2, ..TeapotField::default() }),
    ]
}

#[test]
fn attributes_are_whole_and_no_triangle_is_empty() {
    // Vertex normals of rough hills and of coarse mouldings lean away from their triangles; that
    // they stay on their side is asked where the shape is fine enough for it.
    for shape in samples() {
        let part = built(&shape);
        let least = check_attributes(&part);
        assert!(part.uvs.iter().flatten().all(|c| (0.0..=1.0).contains(c)), "{shape:?}");
        let coarse = matches!(&shape, Shape::Hall(hall) if hall.detail < 8);
        assert!(coarse || least > 0.0, "{shape:?}: {least}");
    }
}

#[test]
fn rounded_to_f32_no_triangle_is_empty_either() {
    for shape in samples() {
        let part = built(&shape);
        for corners in &part.corners {
            let [a, b, c] = corners.map(|k| part.positions[k as usize].map(|v| v as f32));
            assert!(a != b && b != c && c != a, "{shape:?}: {a:?}");
        }
    }
}

#[test]
fn counts_are_those_documented() {
    let count = |shape: Shape| built(&shape).corners.len();
    assert_eq!(count(Shape::Terrain(Terrain { cells: 37, ..Terrain::default() })), 2 * 37 * 37);
    assert_eq!(count(Shape::Soup(Soup { count: 1234, ..Soup::default() })), 1234);
    let field = TeapotField { columns: 3, rows: 2, spacing: 7.0, level: 1 };
    assert_eq!(count(Shape::TeapotField(field)), 6 * (256 * 4 - 16 * 2));
    let default = count(Shape::Hall(Hall::default()));
    assert!((400_000..500_000).contains(&default), "{default}");
}

#[test]
fn the_hall_knows_its_number_of_triangles_before_it_is_made() {
    for (columns, detail) in [(1, 1), (4, 1), (1, 5), (3, 4), (8, 8)] {
        let hall = Hall { columns, detail };
        let expected = hall.triangle_count();
        assert_eq!(built(&Shape::Hall(hall)).corners.len() as u128, expected);
    }
}

/// The first 16 digits of the SHA-256 of positions, normals and corners.
fn digest(part: &MeshPart) -> String {
    let mut hash = Sha256::new();
    for vector in part.positions.iter().chain(&part.normals) {
        vector.iter().for_each(|c| hash.update(c.to_le_bytes()));
    }
    part.corners.iter().flatten().for_each(|index| hash.update(index.to_le_bytes()));
    hash.finalize().iter().take(8).map(|byte| format!("{byte:02x}")).collect()
}

#[test]
fn the_bits_are_the_same_everywhere() {
    // No outside source has these meshes; the digests hold every platform to the same bits.
    let pinned = [
        (Shape::Terrain(Terrain::default()), "99ddcc23bd4c272d"),
        (Shape::Soup(Soup::default()), "cfe9efd864d33cea"),
        (Shape::Hall(Hall { columns: 2, detail: 3 }), "563d279869001ab6"),
        (Shape::TeapotField(TeapotField::default()), "f999d6098368ef6b"),
    ];
    let found: Vec<_> = pinned.iter().map(|(shape, _)| digest(&built(shape))).collect();
    let expected: Vec<_> = pinned.iter().map(|(_, digest)| *digest).collect();
    assert_eq!(found, expected);
}

#[test]
fn the_seed_decides_and_nothing_else() {
    let hills = |seed| built(&Shape::Terrain(Terrain { cells: 16, seed, ..Terrain::default() }));
    assert_ne!(hills(1).positions, hills(2).positions);
    let soup = |seed, count| built(&Shape::Soup(Soup { count, seed, ..Soup::default() }));
    assert_ne!(soup(1, 9).positions, soup(2, 9).positions);
    // A longer soup begins as the shorter one; finer hills pass through the coarser ones' points.
    assert_eq!(soup(1, 9).positions[..], soup(1, 20).positions[..27]);
    let fine = built(&Shape::Terrain(Terrain { cells: 32, seed: 1, ..Terrain::default() }));
    assert!(hills(1).positions.iter().all(|point| fine.positions.contains(point)));
}

#[test]
fn terrain_is_one_sheet_of_heights_within_its_bound() {
    let terrain = Terrain::default();
    let part = built(&Shape::Terrain(terrain.clone()));
    let welded = weld(&part);
    assert_eq!((welded.euler, welded.boundary), (1, 4 * terrain.cells as usize));
    let heights = || part.positions.iter().map(|p| p[1]);
    assert!(heights().all(|y| (0.0..=terrain.height).contains(&y)));
    let range = heights().fold(0.0, f64::max) - heights().fold(f64::INFINITY, f64::min);
    assert!(range > 0.4 * terrain.height, "{range}");
}

#[test]
fn the_soup_keeps_to_its_cube_and_its_sizes() {
    // Sums of numbers up to 5 with a few roundings each.
    const ROUNDING: f64 = 8.0 * f64::EPSILON * 5.0;
    let soup = Soup::default();
    let part = built(&Shape::Soup(soup.clone()));
    let inside = |c: &f64| c.abs() <= 0.5 * soup.extent + ROUNDING;
    assert!(part.positions.iter().flatten().all(inside));
    for triangle in part.positions.chunks(3) {
        for (a, b) in [(0, 1), (1, 2), (2, 0)] {
            let squares = (0..3).map(|k| (triangle[a][k] - triangle[b][k]).powi(2));
            let side = squares.sum::<f64>().sqrt();
            // Two radii of at least size/4 at 80 degrees or more: 2 · sin 40° · size/4.
            assert!((0.32 * soup.size..=soup.size + ROUNDING).contains(&side), "{side}");
        }
    }
}

#[test]
fn parameters_of_their_own_ranges_are_refused_by_name() {
    let refused = [
        (Shape::Terrain(Terrain { cells: 0, ..Terrain::default() }), "cells"),
        (Shape::Terrain(Terrain { cells: 2897, ..Terrain::default() }), "cells"),
        (Shape::Soup(Soup { count: 0, ..Soup::default() }), "count"),
        (Shape::Soup(Soup { count: (1 << 24) + 1, ..Soup::default() }), "count"),
        (Shape::Soup(Soup { size: 10.1, ..Soup::default() }), "size"),
        (Shape::Soup(Soup { size: 9e-5, ..Soup::default() }), "size"),
    ];
    for (shape, parameter) in refused {
        assert_eq!(build(&shape).expect_err(parameter).parameter, parameter);
    }
    let both = Hall { columns: u32::MAX, detail: u32::MAX };
    assert!(build(&Shape::Hall(both)).is_err());
    let all = TeapotField { columns: u32::MAX, rows: u32::MAX, level: u32::MAX, spacing: 7.0 };
    assert!(build(&Shape::TeapotField(all)).is_err());
}
