//! 200 generated scenes made of structure, with fixed seeds: what random triangles never meet.
//!
//! Eight kinds, 25 scenes each, of 1 to 10⁵ triangles. Both paths agree on every decision at every
//! pixel, and the arbiter looks at a fixed sample. The kinds are in `structured::kinds`.

mod kinds;

use crate::support::configurations::{Breadth, NARROW, agreed_within};
use crate::support::rays::Random;
use kinds::{Kind, triangles_of};
use truecast::pixel::Resolution;
use truecast::scene::Scene;
use truecast::scene::camera::PinholeCamera;

/// Scenes of each kind.
const SCENES: usize = 25;

/// Frames that the scenes of a kind take turns over; small ones for large meshes.
const FRAMES: [[u32; 2]; 3] = [[65, 65], [129, 65], [33, 17]];

/// G(8) of any size: the sample of the middle pixel looks along (0, 0, 8), all others at whole
/// numbers beside it.
fn whole_number_camera([width, height]: [u32; 2], eye: [f64; 3]) -> PinholeCamera {
    let d0 = [-f64::from(width) / 2.0, -f64::from(height) / 2.0, 8.0];
    let frame = Resolution::new(width, height).unwrap();
    PinholeCamera::exact(frame, eye, d0, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]).unwrap()
}

/// All scenes of one kind; what they must have met for the test to mean something is asserted.
fn assert_kind(kind: Kind, most_triangles: f64, least_ties: usize) {
    let (mut ties, mut covered, mut largest) = (0, 0, 0);
    for number in 0..SCENES {
        let mut random = Random((kind as u64) << 32 | number as u64);
        // From 1 triangle to the most, by equal factors: a fifth of a decade up to 10⁵.
        let count = most_triangles.powf(number as f64 / (SCENES - 1) as f64).round() as usize;
        let frame = if count > 1000 { [33, 17] } else { FRAMES[number % FRAMES.len()] };
        let (triangles, eye) = triangles_of(kind, count, &mut random);
        let scene = Scene::from_triangles(whole_number_camera(frame, eye), &triangles);
        let audited_pixels = if count > 5000 { 8 } else { 30 };
        let breadth = Breadth { audited_pixels, ..NARROW };
        let name = format!("{kind:?} {number} of {} triangles", triangles.len());
        let buffer = agreed_within(&scene, &breadth, &name);
        ties += buffer.visible.iter().flatten().filter(|v| v.tie).count();
        covered += buffer.covered_pixels();
        largest = largest.max(triangles.len());
        if kind == Kind::ClosedMesh {
            let counts = buffer.cover.as_ref().unwrap();
            assert!(counts.iter().all(|c| c.signed == counts[0].signed), "{name}");
        }
    }
    assert!(largest as f64 >= 0.9 * most_triangles, "{kind:?}: {largest} triangles at most");
    assert!(covered > 1000, "{kind:?}: {covered} pixels are covered");
    assert!(ties >= least_ties, "{kind:?}: {ties} ties");
}

#[test]
fn grids_on_pixel_centres() {
    assert_kind(Kind::Grid, 1e5, 5000);
}

#[test]
fn fans_on_pixel_centres() {
    assert_kind(Kind::Fan, 1e5, 500);
}

#[test]
fn coplanar_decals() {
    assert_kind(Kind::Decals, 1e5, 5000);
}

#[test]
fn sheets_one_step_apart() {
    assert_kind(Kind::Sheets, 1e5, 0);
}

#[test]
fn scales_from_2_to_minus_100_to_2_to_100() {
    assert_kind(Kind::MixedScales, 1e5, 0);
}

#[test]
fn eyes_on_planes() {
    assert_kind(Kind::EyeOnPlanes, 1e5, 100);
}

#[test]
fn closed_integer_meshes() {
    assert_kind(Kind::ClosedMesh, 1e5, 100);
}

#[test]
fn soups_with_shared_edges() {
    assert_kind(Kind::Soup, 1e5, 500);
}
