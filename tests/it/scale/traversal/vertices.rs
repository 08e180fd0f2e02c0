//! H55 and H60 to H62: vertices that are small, huge or no numbers at all.

use crate::scale::{assert_covered_once, ids, triangles_of};
use crate::support::configurations::{agreed, assert_same};
use crate::support::golden;
use crate::support::scenes::{Triangle, pixel_grid, scaled, standard_scene};
use std::path::Path;
use truecast::mesh::TriangleId;
use truecast::scene::{Overrides, Scene, SceneErrors};

/// A scene of 10⁻⁵ is a scene, in powers of two and of ten.
#[test]
fn h55_small_scene() {
    let golden = golden::scene("grid_exact");
    let triangles = triangles_of(&golden.scene);
    assert_eq!(ids(&agreed(&standard_scene(&scaled(&triangles, 2.0_f32.powi(-17))))), golden.ids);
    let decimal = agreed(&standard_scene(&scaled(&triangles, 1e-5)));
    assert!(decimal.covered_pixels() > 200);
    assert_covered_once(&decimal);
}

/// A scene over the text of a mesh file `bad.obj`, with its folder.
fn scene_of_obj(obj: &str, skip_bad: bool) -> Result<Scene, SceneErrors> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("bad.obj"), obj).unwrap();
    let text = "version = 1\n[image]\nwidth = 17\nheight = 17\n[camera]\neye = [0, 0, 5]\n\
        target = [0.2, 0.3, 0]\nup = [0, 1, 0]\nfov_y_deg = 45\n[[mesh]]\nfile = \"bad.obj\"\n\
        scale = 2\n";
    let overrides = Overrides { skip_bad, ..Overrides::default() };
    Scene::from_toml(text, Path::new("t.toml"), folder.path(), &overrides)
}

/// Coordinates that no triangle may have; the last three are numbers, but out of range.
const BAD_COORDINATES: [&str; 10] =
    ["nan", "NaN", "inf", "-inf", "infinity", "1e999", "-1e400", "1e39", "-1e300", "8e37"];

/// A vertex that is no number or out of range is a fault of its line, or of the face that uses it.
#[test]
fn h60_nan_vertex() {
    let obj = |corner: &str| format!("v 0 0 0\nv 1 0 0\nv {corner}\nv 0 1 0\nf 1 2 4\nf 1 2 3\n");
    assert!(scene_of_obj(&obj("0 1 0"), false).is_ok());
    for word in BAD_COORDINATES {
        for corner in [format!("{word} 1 0"), format!("0 {word} 0"), format!("0 1 {word}")] {
            let errors = scene_of_obj(&obj(&corner), false).expect_err(&corner).0;
            let place = &errors[0].place;
            assert!(place.file.ends_with("bad.obj"), "{corner}: {place}");
            let line = if word.parse::<f64>().unwrap().is_finite() { 6 } else { 3 };
            assert_eq!(place.line, line, "{corner}: {}", errors[0]);
        }
    }
}

/// With bad triangles skipped the others keep their picture, whatever the bad ones are, wherever
/// they stand, and whether they share corners with the good ones.
#[test]
fn h60_skipped_vertices_leave_the_others_as_they_are() {
    // Vertices 1 to 4 are bad or not; the faces 11, 13, 15 and 16 use them, the others do not.
    let obj = |bad: [&str; 3], with_bad: bool| {
        let [a, b, c] = bad;
        let face = |text: &'static str| if with_bad { text } else { "" };
        format!(
            "v {a} 0.5 0\nv 0.5 {b} 0\nv 0.25 0.25 {c}\nv 9 9 9\nv -1 -1 0\nv 1 -1 0\nv 1 1 0.5\n\
             v -1 1 0\nv 0 0 1\nf 5 6 9\n{}f 6 7 9\n{}f 7 8 9\n{}{}f 8 5 9\nf 5 6 7 8\n",
            face("f 1 5 6\n"),
            face("f 5 2 6 7\n"),
            face("f 3 3 3\n"),
            face("f 6 7 8 9 3\n"),
        )
    };
    let good = scene_of_obj(&obj(["1"; 3], false), false).unwrap();
    let reference = agreed(&good);
    assert!(reference.covered_pixels() > 100, "{}", reference.covered_pixels());
    for word in BAD_COORDINATES {
        let scene = scene_of_obj(&obj([word; 3], true), true).expect(word);
        let buffer = agreed(&scene);
        assert_same(&reference, &buffer, word);
        assert_eq!(reference.cover, buffer.cover, "{word}");
        assert_eq!(scene.mesh.len(), good.mesh.len(), "{word}");
        assert!(scene.mesh.positions.iter().flatten().all(|c| c.abs() < 100.0), "{word}");
        // The warning counts the faces and names the first; what remains still knows its lines.
        let left_out = scene.warnings.iter().filter(|warning| warning.contains("left out"));
        let [warning] = left_out.collect::<Vec<_>>()[..] else {
            panic!("{word}: {:?}", scene.warnings)
        };
        let sentence = "is left out (4 times; this is the first)";
        assert!(
            warning.contains("bad.obj:11: a face ") && warning.ends_with(sentence),
            "{warning}"
        );
        let line = |id: u32| scene.describe_source(TriangleId::new(id));
        assert!(line(0).ends_with("bad.obj:10") && line(1).ends_with("bad.obj:12"), "{}", line(1));
    }
    // A position that no face uses is no fault; a mesh of nothing but bad faces is one.
    assert!(scene_of_obj("v nan 0 0\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 2 3 4\n", true).is_ok());
    let errors = scene_of_obj("v nan 0 0\nv 0 0 0\nv 1 0 0\nf 1 2 3\n", true).unwrap_err();
    assert!(errors.to_string().contains("no faces with finite corners"), "{errors}");
    // What is no number at all is a fault as before, and so is a normal that is not finite.
    assert!(scene_of_obj("v x 0 0\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 2 3 4\n", true).is_err());
    assert!(scene_of_obj("vn nan 0 0\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", true).is_err());
}

/// Every magnitude up to the largest position, 2^126, is built and seen; beyond it is a fault.
#[test]
fn h61_1e19_to_3e38() {
    for scale in [1e18, 1e19, 1e25, 1e30, 1e37, 2.0_f32.powi(122)] {
        let triangles: Vec<Triangle> = pixel_grid(17, 4, 8.0);
        let buffer = agreed(&standard_scene(&scaled(&triangles, scale)));
        assert!(buffer.covered_pixels() > 200, "{scale:e}");
        assert_covered_once(&buffer);
    }
    let scene = |corner: &str| {
        let folder = tempfile::tempdir().unwrap();
        let obj = format!("v 0 0 0\nv 1 0 0\nv 0 {corner} 0\nf 1 2 3\n");
        std::fs::write(folder.path().join("big.obj"), obj).unwrap();
        let text = "version = 1\n[image]\nwidth = 2\nheight = 2\n[camera]\neye = [0, 0, 5]\n\
            target = [0, 0, 0]\nup = [0, 1, 0]\nfov_y_deg = 45\n[[mesh]]\nfile = \"big.obj\"\n";
        Scene::from_toml(text, Path::new("t.toml"), folder.path(), &Overrides::default())
    };
    assert!(scene("85070591730234615865843651857942052864").is_ok(), "2^126");
    for beyond in ["8.51e37", "1e38", "3.4028235e38", "3e38", "-3e38", "1e39", "1e300"] {
        let errors = scene(beyond).expect_err(beyond).0;
        assert!(errors[0].to_string().contains("big.obj:"), "{beyond}: {}", errors[0]);
    }
}

/// A box from a vertex and rounded edges would begin at x = 0 or at 8: the ray at x = 1…2 tells.
#[test]
fn h62_box_from_edges() {
    let triangles = [
        [[1e8, 0.0, 8.0], [1.0, 0.0, 8.0], [1e8, 1e8, 8.0]],
        [[1e8, -1e8, 8.0], [1.0, 0.0, 8.0], [1e8, 0.0, 8.0]],
        [[-1e8, -1e8, 9.0], [-1e7, -1e8, 9.0], [-1e8, -1e7, 9.0]],
    ];
    let buffer = agreed(&standard_scene(&triangles));
    // From the corner (1, 0) on, every column to the right is covered between the diagonals.
    let row = &ids(&buffer)[8 * 17..9 * 17];
    assert!(row[..9].iter().all(Option::is_none));
    assert!(row[10..].iter().all(|id| *id == Some(0)), "{row:?}");
}
