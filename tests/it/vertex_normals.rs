//! `vertex_normals` and `crease_deg`, from a scene file to the corners of the mesh.

use std::fs;
use std::path::Path;
use tempfile::TempDir;
use truecast::scene::{Overrides, Scene};

type V3 = [f64; 3];

/// A dozen roundings of numbers of at most 1.
const UNIT_TOLERANCE: f64 = 16.0 * f64::EPSILON;

const HEAD: &str = "version = 1\n[image]\nwidth = 4\nheight = 4\n[camera]\neye = [0, 0, 5]\n\
                    target = [0, 0, 0]\nup = [0, 1, 0]\nfov_y_deg = 45\n";

fn load(mesh: &str, obj: &str) -> Result<Scene, String> {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("m.obj"), obj).unwrap();
    let text = format!("{HEAD}[[mesh]]\n{mesh}");
    Scene::from_toml(&text, Path::new("t.toml"), folder.path(), &Overrides::default())
        .map_err(|errors| errors.to_string())
}

/// Of each corner of each triangle its place, the face normal and the corner's normal.
fn corners(scene: &Scene) -> Vec<(V3, V3, Option<V3>)> {
    let of = |id| {
        let normals = scene.mesh.normals_of(id);
        let face = scene.mesh.face_normal(id);
        let places = scene.mesh.triangle(id).map(|place| place.map(f64::from));
        [0, 1, 2].map(|k| (places[k], face, normals.map(|normals| normals[k])))
    };
    scene.mesh.ids().flat_map(of).collect()
}

/// The one normal of all corners at a place.
#[track_caller]
fn normal_at(scene: &Scene, place: V3) -> V3 {
    let mut found = corners(scene).into_iter().filter(|corner| corner.0 == place);
    let first = found.next().expect("a corner there").2.expect("a normal there");
    assert!(found.all(|corner| corner.2 == Some(first)), "one normal at {place:?}");
    first
}

fn from_obj(keys: &str, obj: &str) -> Scene {
    load(&format!("file = \"m.obj\"\n{keys}"), obj).unwrap_or_else(|errors| panic!("{errors}"))
}

fn shape(shape: &str, keys: &str) -> Scene {
    let mesh = format!("shape = {{ {shape} }}\n{keys}");
    load(&mesh, "").unwrap_or_else(|errors| panic!("{errors}"))
}

#[track_caller]
fn assert_unit(actual: V3, direction: V3) {
    let length = direction.iter().map(|c| c * c).sum::<f64>().sqrt();
    let close = |k: usize| (actual[k] - direction[k] / length).abs() <= UNIT_TOLERANCE;
    assert!((0..3).all(close), "{actual:?} is not along {direction:?}");
}

/// Four quads that meet in the apex (0, 0, 1); none of them is a triangle, so that a count of
/// triangles would show. Each leans outwards by another slope.
const PYRAMID: &str = "v 0 0 1\n\
    v 1 0 0\nv 1 1 -1\nv 0 1 0\nv -1 1 -2\nv -1 0 -1\nv -1 -1 -2\nv 0 -1 0\nv 1 -1 -1\n\
    vn 1 0 0\nf 1//1 2//1 3//1 4//1\nf 1//1 4//1 5//1 6//1\nf 1//1 6//1 7//1 8//1\nf 1//1 8//1 9//1 2//1\n";

/// The unit normals of its quads, by their diagonals: (1,1,1)/√3, (−2,1,1)/√6, (−2,−1,1)/√6 and
/// (1,−1,1)/√3.
fn pyramid_normals() -> [V3; 4] {
    let unit = |v: V3| {
        let length = v.iter().map(|c| c * c).sum::<f64>().sqrt();
        v.map(|c| c / length)
    };
    [[1.0, 1.0, 1.0], [-2.0, 1.0, 1.0], [-2.0, -1.0, 1.0], [1.0, -1.0, 1.0]].map(unit)
}

#[test]
fn a33_the_apex_of_four_quads_has_the_unit_sum_of_their_normals() {
    let scene = from_obj("vertex_normals = \"uniform\"\n", PYRAMID);
    assert_eq!(scene.warnings, [""; 0]);
    let normals = pyramid_normals();
    let sum = std::array::from_fn(|k| normals.iter().map(|n| n[k]).sum());
    assert_unit(normal_at(&scene, [0.0, 0.0, 1.0]), sum);
    // By default, and by "file", the file's own normals stay.
    for keys in ["", "vertex_normals = \"file\"\n"] {
        assert_eq!(normal_at(&from_obj(keys, PYRAMID), [0.0, 0.0, 1.0]), [1.0, 0.0, 0.0]);
    }
    // Of a file without normals, the default is the same mean.
    let bare = PYRAMID.replace("//1", "").replace("vn 1 0 0\n", "");
    assert_unit(normal_at(&from_obj("", &bare), [0.0, 0.0, 1.0]), sum);
}

/// Two triangles at a right angle along x, of areas ½ and 2 and angles 45° and atan 4 at (1, 0, 0);
/// both have 90° at the origin.
const ROOF: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 -4\nf 1 2 3\nf 1 4 2\n";

#[test]
fn a33_weights_by_area_and_angle() {
    let (up, out) = (0.25 * std::f64::consts::PI, 4.0_f64.atan());
    for (word, at_origin, at_end) in [
        ("uniform", [0.0, -1.0, 1.0], [0.0, -1.0, 1.0]),
        ("area", [0.0, -4.0, 1.0], [0.0, -4.0, 1.0]),
        ("angle", [0.0, -1.0, 1.0], [0.0, -out, up]),
    ] {
        let scene = from_obj(&format!("vertex_normals = \"{word}\"\n"), ROOF);
        assert_unit(normal_at(&scene, [0.0; 3]), at_origin);
        assert_unit(normal_at(&scene, [1.0, 0.0, 0.0]), at_end);
    }
}

#[test]
fn a33_opposite_faces_leave_the_face_normal_and_a_warning() {
    let both = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 3 2\n";
    for word in ["uniform", "area", "angle"] {
        let scene = from_obj(&format!("vertex_normals = \"{word}\"\n"), both);
        assert!(corners(&scene).iter().all(|corner| corner.2.is_none()));
        assert!(scene.mesh.normals.is_empty() && scene.mesh.corner_normals.is_empty());
        let [warning] = &scene.warnings[..] else { panic!("{:?}", scene.warnings) };
        assert!(warning.contains("6 corners get no vertex normal"), "{warning}");
    }
    // Apart by 180°, they do not meet under a smaller crease.
    let scene = from_obj("crease_deg = 179\n", both);
    assert!(corners(&scene).iter().all(|corner| corner.2 == Some(corner.1)));
}

#[test]
fn a33_smoothing_groups_keep_apart_and_a_crease_ignores_them() {
    let groups = ROOF.replace("f 1 2 3", "s 1\nf 1 2 3").replace("f 1 4 2", "s 2\nf 1 4 2");
    let scene = from_obj("vertex_normals = \"area\"\n", &groups);
    assert!(corners(&scene).iter().all(|corner| corner.2 == Some(corner.1)));
    let scene = from_obj("vertex_normals = \"area\"\ncrease_deg = 90\n", &groups);
    assert_unit(normal_at(&scene, [0.0; 3]), [0.0, -4.0, 1.0]);
    let off = ROOF.replace("f 1 2 3", "s off\nf 1 2 3").replace("f 1 4 2", "s 1\nf 1 4 2");
    let scene = from_obj("vertex_normals = \"uniform\"\n", &off);
    let found = corners(&scene);
    assert!(found[..3].iter().all(|corner| corner.2.is_none()));
    assert!(found[3..].iter().all(|corner| corner.2 == Some(corner.1)));
    // Faces without a group are not missing their normals.
    assert_eq!(scene.warnings, [""; 0]);
}

#[test]
fn a33_the_crease_is_inclusive_and_its_ends_are_flat_and_uniform() {
    let at_origin = |keys: &str| corners(&from_obj(keys, ROOF))[0].2.unwrap();
    for (crease, together) in
        [("0", false), ("89.9999", false), ("90", true), ("90.0001", true), ("180", true)]
    {
        let direction = if together { [0.0, -1.0, 1.0] } else { [0.0, 0.0, 1.0] };
        assert_unit(at_origin(&format!("crease_deg = {crease}\n")), direction);
    }
    let flat = from_obj("crease_deg = 0\n", PYRAMID);
    let uniform = from_obj("vertex_normals = \"uniform\"\n", PYRAMID);
    let smooth = from_obj("crease_deg = 180\n", PYRAMID);
    for (id, (corner, same)) in corners(&smooth).into_iter().zip(corners(&uniform)).enumerate() {
        assert_eq!(corner, same, "{id}");
    }
    for (_, face, normal) in corners(&flat) {
        assert_unit(normal.unwrap(), face);
    }
}

#[test]
fn a33_a_cube_keeps_its_edges_under_a_crease_of_60_degrees() {
    for word in ["uniform", "area", "angle"] {
        let keys = format!("vertex_normals = \"{word}\"\ncrease_deg = 60\n");
        let scene = shape("box = { segments = 3 }", &keys);
        assert!(corners(&scene).iter().all(|corner| corner.2 == Some(corner.1)), "{word}");
        // Without a crease its corners look along its diagonals: three faces, one quad each.
        let scene = shape("box = {}", &format!("vertex_normals = \"{word}\"\n"));
        for (place, _, normal) in corners(&scene) {
            assert_unit(normal.unwrap(), place);
        }
    }
}

#[test]
fn a33_a_cylinder_is_smooth_around_and_flat_on_top() {
    let scene = shape("cylinder = { around = 16, stacks = 2 }", "crease_deg = 60\n");
    let (mut side, mut caps) = (0, 0);
    for ([x, _, z], face, normal) in corners(&scene) {
        let normal = normal.unwrap();
        if face[1].abs() > 0.5 {
            assert_unit(normal, [0.0, face[1], 0.0]);
            caps += 1;
        } else {
            // Positions are f32: 2^-24 of the radius.
            let exact = [x, 0.0, z];
            assert!((0..3).all(|k| (normal[k] - exact[k]).abs() <= 1e-7), "{normal:?} {exact:?}");
            side += 1;
        }
    }
    assert_eq!((side, caps), (3 * 2 * 2 * 16, 3 * 2 * 16));
    assert_eq!(scene.warnings, [""; 0]);
}

#[test]
fn a33_remade_normals_of_a_sphere_are_near_those_of_the_surface() {
    for kind in ["uv_sphere = {}", "icosphere = {}", "torus = {}"] {
        let exact = shape(kind, "");
        for word in ["uniform", "area", "angle"] {
            let remade = shape(kind, &format!("vertex_normals = \"{word}\"\n"));
            assert_eq!(remade.mesh.corners, exact.mesh.corners);
            for (corner, same) in corners(&remade).into_iter().zip(corners(&exact)) {
                let (a, b) = (corner.2.unwrap(), same.2.unwrap_or(corner.1));
                let cosine: f64 = (0..3).map(|k| a[k] * b[k]).sum();
                // A quarter of a cell of 360° / 32 or more apart would be a wrong polygon's normal.
                let is_pole = corner.0[0].abs() < 1e-6 && corner.0[2].abs() < 1e-6;
                assert!(is_pole || cosine > 2.8_f64.to_radians().cos(), "{kind} {word}: {cosine}");
            }
        }
    }
}

/// A planar pentagon around the tip (0, 0, 1) of a fan with two more faces, cut in other ways.
fn cut_fan(faces: &str) -> String {
    format!("v 0 0 0\nv 4 0 0\nv 5 2 0\nv 3 4 0\nv 0 3 0\nv 0 0 -3\n{faces}f 1 5 6\nf 1 6 2\n")
}

#[test]
fn a33_area_and_angle_do_not_depend_on_how_a_polygon_is_cut() {
    let cuts = [
        "f 1 2 3 4 5\n",
        "f 1 2 3\nf 1 3 4\nf 1 4 5\n",
        "f 1 2 5\nf 2 3 5\nf 3 4 5\n",
        "f 1 2 4 5\nf 2 3 4\n",
    ];
    let places = [[0.0; 3], [4.0, 0.0, 0.0], [0.0, 3.0, 0.0]];
    let normals = |word: &str, cut: &str| {
        let scene = from_obj(&format!("vertex_normals = \"{word}\"\n"), &cut_fan(cut));
        places.map(|place| normal_at(&scene, place))
    };
    // Angles: at every corner, whatever the cut.
    let whole = normals("angle", cuts[0]);
    for cut in &cuts[1..] {
        for (a, b) in normals("angle", cut).into_iter().zip(whole) {
            assert_unit(a, b);
        }
    }
    // Areas: where the whole polygon's pieces meet, as in the fan around the vertex.
    assert_unit(normals("area", cuts[1])[0], normals("area", cuts[0])[0]);
    // Unweighted, the pieces count singly.
    assert_ne!(normals("uniform", cuts[1])[0], normals("uniform", cuts[0])[0]);
}

#[test]
fn a33_one_polygon_counts_once_however_it_is_cut_by_the_reader() {
    // The corner (0, 0, 0) is in three triangles of the pentagon's fan.
    let scene = from_obj("vertex_normals = \"uniform\"\n", &cut_fan("f 1 2 3 4 5\n"));
    // The others look along −x and −y.
    assert_unit(normal_at(&scene, [0.0; 3]), [-1.0, -1.0, 1.0]);
}

#[test]
fn a33_mirrors_keep_the_normals_outside() {
    let scene =
        shape("icosphere = { level = 2 }", "vertex_normals = \"angle\"\nscale = [-1, 1, 1]\n");
    for (_, face, normal) in corners(&scene) {
        let normal = normal.unwrap();
        assert!((0..3).map(|k| face[k] * normal[k]).sum::<f64>() > 0.9);
    }
}

#[test]
fn a33_faults_have_a_place_and_a_remedy() {
    let refused = |keys: &str| load(&format!("file = \"m.obj\"\n{keys}"), ROOF).unwrap_err();
    let message = refused("vertex_normals = \"aria\"\n");
    assert!(message.contains("t.toml:12:18: there are no vertex normals \"aria\""), "{message}");
    assert!(message.contains("did you mean `area`?"), "{message}");
    for angle in ["-1", "180.5"] {
        let message = refused(&format!("crease_deg = {angle}\n"));
        assert!(message.contains("`crease_deg` must be from 0 to 180"), "{message}");
    }
    // 20 000 triangles around one vertex.
    let mut fan = "v 0 0 1\n".to_owned();
    for k in 0..20_000 {
        let angle = f64::from(k) / 20_000.0 * std::f64::consts::TAU;
        fan += &format!("v {} {} 0\n", angle.cos(), angle.sin());
    }
    for k in 0..20_000 {
        fan += &format!("f 1 {} {}\n", k + 2, (k + 1) % 20_000 + 2);
    }
    let message = load("file = \"m.obj\"\ncrease_deg = 30\n", &fan).unwrap_err();
    assert!(message.contains("20000 faces meet in one vertex"), "{message}");
    assert!(load("file = \"m.obj\"\nvertex_normals = \"angle\"\n", &fan).is_ok());
}
