//! OBJ and MTL files as users have them: every known way in which readers get them wrong.
//!
//! Small texts and folders only. What single pieces do is tested beside them.

use std::io;
use std::path::{Path, PathBuf};
use truecast::mesh::NO_ATTRIBUTE;
use truecast::scene::error::Fault;
use truecast::scene::material::Material;
use truecast::scene::obj::{ObjFile, ObjOptions, load, parse};

/// Four corners of the unit square.
const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

/// Opens nothing.
fn no_library(_: &Path) -> io::Result<Vec<u8>> {
    Err(io::ErrorKind::NotFound.into())
}

/// A text without faults, after the square's four corners.
#[track_caller]
fn read(text: &str) -> ObjFile {
    let text = format!("{SQUARE}{text}");
    match parse(text.as_bytes(), Path::new("t.obj"), ObjOptions::default(), &no_library) {
        Ok(file) => file,
        Err(errors) => panic!("{errors:?}"),
    }
}

/// The faults of a text after the square's four corners, as `file:line:column: message`.
#[track_caller]
fn faults(text: &str) -> Vec<String> {
    let text = format!("{SQUARE}{text}");
    match parse(text.as_bytes(), Path::new("t.obj"), ObjOptions::default(), &no_library) {
        Ok(file) => panic!("accepted: {file:?}"),
        Err(errors) => {
            assert!(errors.iter().all(|error| error.fault == Fault::Scene));
            errors.iter().map(ToString::to_string).collect()
        }
    }
}

/// A text with libraries given as (path, text).
#[track_caller]
fn read_with(text: &str, libraries: &[(&str, &str)]) -> ObjFile {
    let open = |path: &Path| {
        let found = libraries.iter().find(|(name, _)| Path::new(name) == path);
        found.map_or_else(|| no_library(path), |(_, text)| Ok(text.as_bytes().to_vec()))
    };
    let text = format!("{SQUARE}{text}");
    parse(text.as_bytes(), Path::new("folder/t.obj"), ObjOptions::default(), &open).unwrap()
}

/// The material of each triangle.
fn triangle_material(file: &ObjFile, triangle: usize) -> Option<&Material> {
    let index = *file.part.triangle_materials.get(triangle)?;
    file.materials.get(index as usize)
}

#[test]
fn a_plain_face_has_lines_and_no_attributes_of_its_own() {
    let file = read("s off\nf 1 2 3 4\n\nf 4 3 2\n");
    assert_eq!(file.warnings, [""; 0]);
    assert_eq!(file.part.positions[2], [1.0, 1.0, 0.0]);
    assert_eq!(file.part.corners, [[0, 1, 2], [0, 2, 3], [3, 2, 1]]);
    assert_eq!(file.part.lines, [6, 6, 8]);
    assert!(file.part.corner_normals.is_empty() && file.part.corner_uvs.is_empty());
    assert!(file.part.triangle_materials.is_empty() && file.materials.is_empty());
}

#[test]
fn positions_keep_all_digits_and_unused_ones_go() {
    let file = read("v 0.1 1e-300 -123456789.12345679\nf 5 2 3\n");
    assert_eq!(file.part.positions.len(), 3);
    assert_eq!(file.part.positions[0], [0.1, 1e-300, -123_456_789.123_456_79]);
}

#[test]
fn coordinates_that_are_no_finite_numbers_are_refused() {
    for bad in ["nan", "inf", "-infinity", "1e999"] {
        let expected = format!("t.obj:5:5: `{bad}` is not a finite number");
        assert_eq!(faults(&format!("v 0 {bad} 0\nf 1 2 5\n")), [expected]);
    }
    for bad in ["3.1+e2", "0x10", "1d5", "", "é"] {
        let found = faults(&format!("v 0 0 {bad}\nf 1 2 5\n"));
        let expected = match bad {
            "" => "t.obj:5:1: `v` has 2 numbers; it takes 3 or 4 or 6 or 7".to_owned(),
            bad => format!("t.obj:5:7: `{bad}` is not a number"),
        };
        assert_eq!(found, [expected]);
    }
    assert_eq!(faults("vn 0 nan 1\nf 1 2 3\n").len(), 1);
    assert_eq!(faults("vt nan\nf 1 2 3\n").len(), 1);
}

#[test]
fn a_weight_does_not_divide() {
    let file = read("v 2 0 0 2\nv 2 1 0 1\nv 3 1 0 1 0 0\nv 3 1 1 0.5 1 0 0\nf 5 6 7\nf 5 6 8\n");
    assert_eq!(file.part.positions[0], [2.0, 0.0, 0.0]);
    // The two kinds of remarks: the weights, and the vertices without a colour.
    assert_eq!(file.warnings.len(), 2, "{:?}", file.warnings);
    assert!(file.warnings[0].starts_with("t.obj:5: ") && file.warnings[0].contains("weight"));
    assert_eq!(faults("v 0 0 0 1 1\nf 1 2 3\n").len(), 1);
}

#[test]
fn texture_coordinates_of_one_to_three_numbers() {
    let file = read("vt 0.5\nvt 0.25 0.75\nvt 1 2 3\nf 1/1 2/2 3/-1\n");
    assert_eq!(file.part.uvs, [[0.5, 0.0], [0.25, 0.75], [1.0, 2.0]]);
    assert_eq!(file.part.corner_uvs, [[0, 1, 2]]);
}

#[test]
fn corners_without_texture_coordinates_stay_without() {
    let file = read("vt 0.5 0.5\nvt 1 1\nf 1 2/2 3/1\nf 1/1 3 4/2\n");
    let none = NO_ATTRIBUTE;
    assert_eq!(file.part.uvs, [[1.0, 1.0], [0.5, 0.5]]);
    assert_eq!(file.part.corner_uvs, [[none, 0, 1], [1, none, 0]]);
}

#[test]
fn indices_that_do_not_exist_are_refused_with_their_place() {
    assert_eq!(faults("f 1 2 0"), ["t.obj:5:7: index 0 in `0`: OBJ counts from 1"]);
    assert_eq!(faults("f 1 2 5"), ["t.obj:5:7: `v` 5 does not exist; 4 are in the file"]);
    assert_eq!(faults("f 1 2 -5"), ["t.obj:5:7: `v` -5 does not exist; 4 precede it"]);
    assert_eq!(
        faults("vn 0 0 1\nf 1//-9 2//1 3//1"),
        ["t.obj:6:3: `vn` -9 does not exist; 1 precede it"]
    );
    assert_eq!(faults("f 1/1 2 3"), ["t.obj:5:3: `vt` 1 does not exist; 0 are in the file"]);
    assert_eq!(faults("f 1 2 3x"), ["t.obj:5:7: `3x` is not a corner of a face"]);
    assert_eq!(faults("f 1 2 99999999999").len(), 1);
}

#[test]
fn negative_and_forward_indices_are_resolved() {
    let file = read("f -4 -3 -2\nf 1 2 5\nv 7 7 7\nf -1 1 2\n");
    assert_eq!(file.part.corners, [[0, 1, 2], [0, 1, 3], [3, 0, 1]]);
    assert_eq!(file.part.positions[3], [7.0; 3]);
}

#[test]
fn faces_of_fewer_than_three_corners_are_refused() {
    let expected: Vec<String> = (0..3)
        .map(|n| format!("t.obj:{}:1: a face of {n} corners; it needs at least 3", 5 + n))
        .collect();
    assert_eq!(faults("f\nf 1\nf 1 2\n"), expected);
}

#[test]
fn written_normals_are_made_unit_and_kept_per_corner() {
    let file = read("vn 0 0 7\nvn 3e-320 0 0\nvn 1e300 1e300 0\nf 1//1 2//2 3//3\n");
    let half = 0.5_f64.sqrt();
    assert_eq!(file.part.normals[..2], [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0]]);
    // One rounding of the root and one of the division.
    assert!((file.part.normals[2][0] - half).abs() <= f64::EPSILON);
    assert_eq!(file.part.corner_normals, [[0, 1, 2]]);
    assert_eq!(file.warnings, [""; 0]);
}

#[test]
fn mixed_corners_get_the_missing_normals_generated() {
    // The written normal lies along x, the generated one along z.
    let file = read("vn 1 0 0\nf 1//1 2 3\nf 1 3//1 4\n");
    let normal = |triangle: usize, corner: usize| {
        file.part.normals[file.part.corner_normals[triangle][corner] as usize]
    };
    let (x, z) = ([1.0, 0.0, 0.0], [0.0, 0.0, 1.0]);
    assert_eq!([0, 1, 2].map(|corner| normal(0, corner)), [x, z, z]);
    assert_eq!([0, 1, 2].map(|corner| normal(1, corner)), [z, x, z]);
}

#[test]
fn a_normal_of_length_zero_counts_as_missing() {
    let file = read("vn 0 -0.0 0\ns off\nf 1//1 2//1 3//1\n");
    assert!(file.part.corner_normals.is_empty() && file.part.normals.is_empty());
    assert_eq!(file.warnings, ["t.obj:5: a normal of length 0 counts as missing"]);
    let file = read("vn 0 0 0\nvn 1 0 0\nf 1//2 2//1 3//2\n");
    assert_eq!(file.part.normals, [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]);
    assert_eq!(file.part.corner_normals, [[0, 1, 0]]);
}

#[test]
fn smoothing_groups_decide_who_shares_a_normal() {
    // Two faces at a right angle; corners 1 and 2 are shared.
    let wall = "v 0 0 -1\n";
    let normal_of = |file: &ObjFile, triangle: usize| {
        let index = *file.part.corner_normals.get(triangle)?.first()?;
        file.part.normals.get(index as usize).copied()
    };
    let smooth = read(&format!("{wall}f 1 2 3\nf 1 5 2\n"));
    let [x, y, z] = normal_of(&smooth, 0).unwrap();
    assert!(x == 0.0 && y < -0.7 && z > 0.7, "{x} {y} {z}");
    assert_eq!(normal_of(&smooth, 1), Some([x, y, z]));
    let apart = read(&format!("{wall}s 1\nf 1 2 3\ns 2\nf 1 5 2\n"));
    assert_eq!(normal_of(&apart, 0), Some([0.0, 0.0, 1.0]));
    assert_eq!(normal_of(&apart, 1), Some([0.0, -1.0, 0.0]));
    // Before the first statement there is no group in a file that has some.
    let late = read(&format!("{wall}f 1 2 3\ns on\nf 1 5 2\n"));
    assert_eq!(late.part.corner_normals[0], [NO_ATTRIBUTE; 3]);
    assert_eq!(normal_of(&late, 1), Some([0.0, -1.0, 0.0]));
    for off in ["s off", "s 0"] {
        assert!(read(&format!("{wall}{off}\nf 1 2 3\nf 1 5 2\n")).part.corner_normals.is_empty());
    }
    assert_eq!(faults("s maybe\nf 1 2 3"), ["t.obj:5:3: `maybe` is not a smoothing group"]);
}

#[test]
fn polygons_are_cut_by_their_shape() {
    // A dart whose reflex corner is the last, so that a fan from the first would be wrong.
    let file = read("v 2 1 0\nv 0 2 0\nf 1 5 6 3\n");
    assert_eq!(file.part.corners, [[1, 2, 3], [1, 3, 0]]);
    let bow_tie = read("f 1 2 4 3\nf 1 2 4 3\n");
    assert_eq!(bow_tie.part.corners.len(), 4);
    assert_eq!(
        bow_tie.warnings,
        ["t.obj:5: a polygon crosses itself; it is cut into a fan (2 times; this is the first)"]
    );
    let flat = read("f 1 2 3\nf 1 2 2\nf 1 1 2 3\n");
    assert_eq!(flat.part.lines, [5, 6, 7, 7]);
    assert!(flat.warnings.len() == 1, "{:?}", flat.warnings);
    assert!(flat.warnings[0].starts_with("t.obj:6: a triangle has no area"));
    assert!(flat.warnings[0].ends_with("(2 times; this is the first)"));
}

#[test]
fn polylines_points_and_curves_make_no_triangles() {
    let file = read("l 1 2 3\nl 1 2 3 4\np 1\ncurv 0 1 1 2\nvp 1 2\nf 1 2 3\nlod 3\nfoo\n");
    assert_eq!(file.part.corners.len(), 1);
    assert_eq!(
        file.warnings,
        [
            "t.obj:5: lines (`l`) are no surfaces and left out (2 times; this is the first)",
            "t.obj:7: points (`p`) are no surfaces and left out",
            "t.obj:8: free-form curves and surfaces are left out (2 times; this is the first)",
            "t.obj:11: `lod` statements have no effect here",
            "t.obj:12: unknown statements `foo` are left out",
        ]
    );
}

#[test]
fn groups_objects_comments_continuations_tabs_and_line_ends() {
    let file = read(
        "o thing # 1\r\n  g a b\r\ng\r\nf\t1  2 3 # c \\\r\n\tf 1 \\\r\n 3 \\ \n 4#x\rf 1 2 4\r\n#",
    );
    assert_eq!(file.warnings, [""; 0]);
    assert_eq!(file.part.lines, [8, 9, 12]);
    assert_eq!(file.part.corners, [[0, 1, 2], [0, 2, 3], [0, 1, 3]]);
}

#[test]
fn bytes_that_are_not_utf8_warn_and_utf16_is_refused() {
    let mut bytes = format!("{SQUARE}# caf").into_bytes();
    bytes.extend(b"\xE9\nf 1 2 3\n");
    let file = parse(&bytes, Path::new("t.obj"), ObjOptions::default(), &no_library).unwrap();
    assert_eq!(file.part.corners.len(), 1);
    assert!(file.warnings.len() == 1 && file.warnings[0].starts_with("t.obj:5: "));
    let utf16: Vec<u8> =
        [0xFF, 0xFE].into_iter().chain(SQUARE.bytes().flat_map(|b| [b, 0])).collect();
    let errors = parse(&utf16, Path::new("t.obj"), ObjOptions::default(), &no_library).unwrap_err();
    assert_eq!(errors[0].to_string(), "t.obj: the file is UTF-16 text");
    let errors =
        parse(&utf16[2..], Path::new("t.obj"), ObjOptions::default(), &no_library).unwrap_err();
    assert_eq!(errors[0].place.line, 1);
    let marked = [b"\xEF\xBB\xBF".as_slice(), SQUARE.as_bytes(), b"f 1 2 3"].concat();
    assert_eq!(
        parse(&marked, Path::new("t.obj"), ObjOptions::default(), &no_library).unwrap().warnings,
        [""; 0]
    );
}

#[test]
fn files_without_faces_are_refused() {
    assert_eq!(faults("l 1 2 3\n"), ["t.obj: the file holds no faces"]);
    for text in ["", "\n", "# nothing\n", "\\"] {
        let errors = parse(text.as_bytes(), Path::new("t.obj"), ObjOptions::default(), &no_library)
            .unwrap_err();
        assert_eq!(errors[0].message, "the file holds no faces");
    }
}

#[test]
fn a_broken_file_gives_a_screenful() {
    assert_eq!(faults(&"f 1 2 9\n".repeat(1000)).len(), 21);
    let file = read(&format!("f 1 2 3\n{}", "foo\n".repeat(1000)));
    assert_eq!(file.warnings.len(), 1);
}

#[test]
fn materials_are_found_whatever_the_order() {
    let library = [("folder/a.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n")];
    let file = read_with(
        "f 1 2 3\nusemtl blue\nusemtl red\nf 1 2 3\nusemtl\tred # c\nf 1 2 3\nmtllib a.mtl\n\
         usemtl\nf 1 2 3\nusemtl blue\nf 1 2 3\n",
        &library,
    );
    let kd: Vec<_> = (0..5).map(|t| triangle_material(&file, t).map(|m| m.kd)).collect();
    let (red, blue) = ([1.0, 0.0, 0.0], [0.0, 0.0, 1.0]);
    assert_eq!(kd, [None, Some(red), Some(red), None, Some(blue)]);
    let names: Vec<&String> = file.materials.iter().map(|m| &m.name).collect();
    assert_eq!(names, file.part.material_names.iter().collect::<Vec<_>>());
    let expected = "folder/t.obj:12: `usemtl` names no material; the default one is used";
    assert_eq!(file.warnings, [expected]);
}

#[test]
fn unknown_materials_and_missing_libraries_are_warnings() {
    let file = read_with("mtllib no.mtl\nusemtl x\nf 1 2 3\nusemtl y\nf 1 2 3\n", &[]);
    assert_eq!(file.materials, [Material::default_named("x"), Material::default_named("y")]);
    assert_eq!(file.warnings.len(), 2, "{:?}", file.warnings);
    assert!(file.warnings[0].starts_with("folder/t.obj:5: the material library "));
    assert!(file.warnings[0].contains("no.mtl"), "{}", file.warnings[0]);
    assert_eq!(
        file.warnings[1],
        "folder/t.obj:6: no library defines `x`, `y`; the default coefficients are used"
    );
    let many: String = (0..100).map(|i| format!("usemtl m{i}\nf 1 2 3\n")).collect();
    let file = read_with(&many, &[]);
    assert!(file.warnings.len() == 1 && file.warnings[0].contains("and 92 more"));
}

#[test]
fn one_statement_may_name_several_libraries_or_one_with_blanks() {
    let (red, blue) = ("newmtl red\nKd 1 0 0\n", "newmtl blue\nKd 0 0 1\n");
    let uses = "usemtl red\nf 1 2 3\nusemtl blue\nf 1 2 3\n";
    for (statement, libraries) in [
        ("mtllib a.mtl b.mtl", vec![("folder/a.mtl", red), ("folder/b.mtl", blue)]),
        ("mtllib a.mtl # both\nmtllib b.mtl", vec![("folder/a.mtl", red), ("folder/b.mtl", blue)]),
        (
            "mtllib both of them.mtl\nmtllib sub\\b.mtl",
            vec![("folder/both of them.mtl", red), ("folder/sub/b.mtl", blue)],
        ),
    ] {
        let file = read_with(&format!("{statement}\n{uses}"), &libraries);
        assert_eq!(file.warnings, [""; 0], "{statement}");
        assert_eq!(file.materials[0].kd, [1.0, 0.0, 0.0], "{statement}");
        assert_eq!(file.materials[1].kd, [0.0, 0.0, 1.0], "{statement}");
    }
    // One of two is missing: the other counts, and the missing one is told.
    let file = read_with(&format!("mtllib a.mtl b.mtl\n{uses}"), &[("folder/a.mtl", red)]);
    assert_eq!(file.materials[0].kd, [1.0, 0.0, 0.0]);
    assert!(file.warnings[0].contains("b.mtl"), "{:?}", file.warnings);
}

#[test]
fn a_library_fault_has_its_own_file_and_line() {
    let open = |_: &Path| Ok(b"newmtl a\nKd 0.8\nKs -1\n".to_vec());
    let text = format!("mtllib a.mtl\n{SQUARE}f 1 2 3\n");
    let errors = parse(text.as_bytes(), Path::new("folder/t.obj"), ObjOptions::default(), &open)
        .unwrap_err();
    assert_eq!(errors.len(), 1);
    assert_eq!(errors[0].place.file, PathBuf::from("folder").join("a.mtl"));
    assert_eq!((errors[0].place.line, errors[0].place.column), (3, 4));
}

#[test]
fn files_are_loaded_with_the_libraries_beside_them() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("square.obj");
    std::fs::write(&path, format!("mtllib m.mtl\n{SQUARE}usemtl a\nf 1 2 3 4\n")).unwrap();
    std::fs::write(folder.path().join("m.mtl"), "newmtl a\nKd 0.25\nTf 0.5\n").unwrap();
    let file = load(&path, ObjOptions::default()).unwrap();
    assert_eq!(file.materials[0].kd, [0.25; 3]);
    assert_eq!(file.part.triangle_materials, [0, 0]);
    assert_eq!(file.part.lines, [7, 7]);
    assert!(file.warnings.len() == 1 && file.warnings[0].contains("m.mtl:3: "));
    // A folder in the library's place is a warning; in the file's place, an error.
    std::fs::remove_file(folder.path().join("m.mtl")).unwrap();
    std::fs::create_dir(folder.path().join("m.mtl")).unwrap();
    assert!(load(&path, ObjOptions::default()).unwrap().warnings[0].contains("folder"));
    for (path, said) in [(folder.path(), "folder"), (&folder.path().join("no.obj"), "exist")] {
        let errors = load(path, ObjOptions::default()).unwrap_err();
        assert_eq!((errors.len(), errors[0].fault), (1, Fault::Reading));
        assert!(errors[0].message.contains(said), "{}", errors[0]);
    }
}
