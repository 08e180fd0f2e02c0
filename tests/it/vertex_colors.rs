//! `v x y z r g b`: colours of vertices, from the OBJ text to the scene's mesh.

use std::fs;
use std::io;
use std::path::Path;
use tempfile::TempDir;
use truecast::mesh::TriangleId;
use truecast::scene::hash::content_hash;
use truecast::scene::obj::{ObjFile, ObjOptions, parse};
use truecast::scene::{Overrides, Scene};

const RED: [f64; 3] = [1.0, 0.0, 0.0];
const GREEN: [f64; 3] = [0.0, 1.0, 0.0];
const BLUE: [f64; 3] = [0.0, 0.0, 1.0];
const WHITE: [f64; 3] = [1.0; 3];

fn read(text: &str) -> Result<ObjFile, Vec<String>> {
    let none = |_: &Path| Err(io::Error::from(io::ErrorKind::NotFound));
    parse(text.as_bytes(), Path::new("t.obj"), ObjOptions::default(), &none)
        .map_err(|errors| errors.iter().map(ToString::to_string).collect())
}

/// A scene of meshes `[[mesh]]\nfile = "m.obj"` … over one OBJ text.
fn scene(obj: &str, meshes: &str) -> Scene {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("m.obj"), obj).unwrap();
    let text = format!(
        "version = 1\n[image]\nwidth = 4\nheight = 4\n[camera]\neye = [0, 0, 5]\n\
         target = [0, 0, 0]\nup = [0, 1, 0]\nfov_y_deg = 45\n{meshes}"
    );
    Scene::from_toml(&text, Path::new("t.toml"), folder.path(), &Overrides::default()).unwrap()
}

const TRIANGLE: &str = "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nf 1 2 3\n";

#[test]
fn a20_corners_have_the_written_colours_and_the_centroid_their_mean() {
    let scene = scene(TRIANGLE, "[[mesh]]\nfile = \"m.obj\"\n");
    let corners = scene.mesh.colors_of(TriangleId::new(0)).unwrap();
    assert_eq!(corners, [RED, GREEN, BLUE]);
    let centroid: [f64; 3] =
        std::array::from_fn(|k| (corners[0][k] + corners[1][k] + corners[2][k]) / 3.0);
    assert_eq!(centroid, [1.0 / 3.0; 3]);
}

#[test]
fn a20_colours_follow_their_positions_through_order_of_use_and_mirrors() {
    // Used backwards, and one vertex not at all; the seven-number form has its weight before.
    let text = "v 9 9 9 0.5 0.5 0.5\nv 0 0 0 1 0 0\nv 1 0 0 1 0 1 0\nv 0 1 0 0 0 1\nf 4 2 3\n";
    let file = read(text).unwrap();
    assert_eq!(file.part.colors, [BLUE, RED, GREEN]);
    assert_eq!(file.warnings, [""; 0]);
    let scene = scene(TRIANGLE, "[[mesh]]\nfile = \"m.obj\"\nscale = [-1, 1, 1]\n");
    assert_eq!(scene.mesh.triangle(TriangleId::new(0))[1], [0.0, 1.0, 0.0]);
    assert_eq!(scene.mesh.colors_of(TriangleId::new(0)), Some([RED, BLUE, GREEN]));
}

#[test]
fn a20_vertices_without_a_colour_are_white_with_one_warning() {
    let file = read("v 0 0 0\nv 1 0 0 0 1 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\n").unwrap();
    assert_eq!(file.part.colors, [WHITE, GREEN, WHITE, WHITE]);
    assert_eq!(file.warnings, ["t.obj: 3 of 4 vertices have no colour; they are white"]);
    assert!(read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap().part.colors.is_empty());
    let file = read(&TRIANGLE.replace("1 0 0 0 1 0", "1 0 0 0 255 0")).unwrap();
    assert_eq!(file.warnings, ["t.obj:2: a vertex colour exceeds 1; it is used as written"]);
}

#[test]
fn a20_meshes_without_colours_beside_those_with() {
    let plane = "[[mesh]]\nshape = { plane = {} }\n";
    let file = "[[mesh]]\nfile = \"m.obj\"\n";
    let mixed = scene(TRIANGLE, &format!("{plane}{file}{plane}"));
    assert_eq!(mixed.mesh.colors.len(), mixed.mesh.positions.len());
    for (id, expected) in [(0, [WHITE; 3]), (2, [RED, GREEN, BLUE]), (4, [WHITE; 3])] {
        assert_eq!(mixed.mesh.colors_of(TriangleId::new(id)), Some(expected), "{id}");
    }
    assert_eq!(scene(TRIANGLE, plane).mesh.colors_of(TriangleId::new(0)), None);
}

#[test]
fn a20_bad_colours_have_a_place() {
    let refused = |colour: &str| {
        let text = format!("v 0 0 0 {colour}\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
        read(&text).unwrap_err()
    };
    assert_eq!(refused("0 -0.5 0"), ["t.obj:1:11: a vertex colour is negative: `-0.5`"]);
    assert_eq!(refused("0 0 nan"), ["t.obj:1:13: `nan` is not a finite number"]);
    assert_eq!(refused("1e999 0 0"), ["t.obj:1:9: `1e999` is not a finite number"]);
    assert_eq!(refused("red 0 0"), ["t.obj:1:9: `red` is not a number"]);
}

#[test]
fn a20_the_digest_follows_the_colours() {
    let mesh = "[[mesh]]\nfile = \"m.obj\"\n";
    let digest = |text: &str| content_hash(&scene(text, mesh));
    let bare = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    assert_eq!(digest(TRIANGLE), digest(&format!("# the same\n{TRIANGLE}")));
    assert_ne!(digest(TRIANGLE), digest(bare));
    assert_ne!(digest(TRIANGLE), digest(&TRIANGLE.replace("0 0 0 1 0 0", "0 0 0 0.5 0 0")));
}
