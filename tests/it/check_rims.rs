//! Where a rounding decides a colour: the check must neither cry wolf nor look away.

use std::path::Path;
use truecast::check::{CheckOptions, Outcome, Report, check};
use truecast::render::Unwatched;
use truecast::scene::{Overrides, Scene};

fn checked(text: &str) -> Report {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let scene =
        Scene::from_toml(text, Path::new("s.toml"), &scenes, &Overrides::default()).unwrap();
    check(&scene, &CheckOptions::default(), &Unwatched).0
}

/// Every sample lies on an edge between texels in exact numbers: uv is (4i + 2)/64 on a texture of
/// 64 texels. The paths' weights differ by roundings, and must choose the same texel.
#[test]
fn texels_whose_edges_run_through_samples_are_the_same_for_both_paths() {
    for (columns, rows, turn) in [(1, 1, 0), (3, 7, 90), (5, 3, 180), (11, 13, 270)] {
        let report = checked(&format!(
            "version = 1\n[image]\nwidth = 16\nheight = 16\n\
             [camera.exact]\neye = [0, 0, 64]\nd0 = [-8, 8, -64]\ndx = [1, 0, 0]\ndy = [0, -1, 0]\n\
             [[material]]\nname = \"m\"\nunlit = true\nkd_map = \"texture/checker.png\"\n\
             filter = \"nearest\"\n\
             [[mesh]]\nshape = {{ plane = {{ width = 16, depth = 16, columns = {columns}, rows = {rows} }} }}\n\
             material = \"m\"\nrotate_deg = [90, 0, {turn}]\n"
        ));
        assert_eq!(report.covered_pixels, 256);
        assert_eq!(report.outcome(), Outcome::Agreement, "{columns}x{rows}, {turn}°");
    }
}

/// A light in the plane of a floor with corner normals: N·L is 0 up to rounding, and on which side
/// it falls decides whether the highlight is there. Such pixels are counted, and are no difference.
#[test]
fn pixels_on_the_terminator_are_counted_and_not_blamed() {
    let mut counted = 0;
    for degrees in 1..40 {
        let angle = f64::from(degrees).to_radians();
        let (sine, cosine) = angle.sin_cos();
        let report = checked(&format!(
            "version = 1\n[image]\nwidth = 24\nheight = 24\n\
             [camera]\neye = [0.3, 4, 3]\ntarget = [0, 0, 0]\nup = [0, 1, 0]\nfov_y_deg = 40\n\
             [[material]]\nname = \"m\"\nks = [1, 1, 1]\nns = 1\n\
             [[mesh]]\nshape = {{ plane = {{ width = 3, depth = 3, columns = 3, rows = 3 }} }}\n\
             material = \"m\"\nrotate_deg = [0, 0, {degrees}]\n\
             [[light]]\ntype = \"directional\"\naim = [{cosine:?}, {sine:?}, 0]\nintensity = [1, 1, 1]\n"
        ));
        assert_eq!(report.outcome(), Outcome::Agreement, "{degrees}°");
        counted += report.terminator_pixels;
    }
    assert!(counted > 0, "no sign differed: the test tests nothing");
}
