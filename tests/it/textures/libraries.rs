//! Textures that material libraries bring along.

use super::*;
use std::io;
use truecast::scene::obj::{ObjFile, ObjOptions, parse};
use truecast::scene::texture::TextureRequest;

const TRIANGLE: &str = "mtllib m.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\n\
    vt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n";

/// The triangle's file with this library.
#[track_caller]
fn read(library: &str) -> Result<ObjFile, String> {
    let open = |path: &Path| match path == Path::new("folder/m.mtl") {
        true => Ok(format!("newmtl a\n{library}\n").into_bytes()),
        false => Err(io::ErrorKind::NotFound.into()),
    };
    parse(TRIANGLE.as_bytes(), Path::new("folder/t.obj"), ObjOptions::default(), &open)
        .map_err(|errors| errors.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"))
}

/// What `map_Kd` with these words asks for, and the warnings.
#[track_caller]
fn kd_map(words: &str) -> (TextureRequest, Vec<String>) {
    let file = read(&format!("map_Kd {words}")).unwrap();
    (file.textures[0].kd.clone().unwrap(), file.warnings)
}

#[test]
fn options_come_before_the_name() {
    let (request, warnings) = kd_map("wood.png");
    assert_eq!(request.paths[0], Path::new("folder/wood.png"));
    assert_eq!((request.scale, request.offset), ([1.0; 2], [0.0; 2]));
    assert_eq!((request.filter, request.wrap), (Filter::Bilinear, Wrap::Repeat));
    assert_eq!(request.place.to_string(), "folder/m.mtl:2");
    assert!(!request.required && warnings.is_empty(), "{warnings:?}");

    let (request, warnings) = kd_map("-clamp on -s 2 3 4 -o -0.5 0.25 my wood.png");
    assert_eq!(request.paths[0], Path::new("folder/my wood.png"));
    assert_eq!((request.scale, request.offset), ([2.0, 3.0], [-0.5, 0.25]));
    assert_eq!(request.wrap, Wrap::Clamp);
    assert!(warnings.is_empty(), "{warnings:?}");

    // Fewer numbers, a name that is one, a name that begins like an option.
    let (request, _) = kd_map("-s 2 -o 1 7");
    assert_eq!((request.scale, request.offset), ([2.0, 1.0], [1.0, 0.0]));
    assert_eq!(request.paths[0], Path::new("folder/7"));
    assert_eq!(kd_map("-wood.png").0.paths[0], Path::new("folder/-wood.png"));
}

#[test]
fn options_that_are_not_simulated_are_named_unless_they_change_nothing() {
    let quiet = "-blendu on -blendv on -cc off -mm 0 1 -bm 1 -boost 0 -t 0 0 0 -clamp off x.png";
    let (request, warnings) = kd_map(quiet);
    assert_eq!((request.paths[0].as_path(), warnings.len()), (Path::new("folder/x.png"), 0));
    let loud = ["-blendu off", "-blendv off", "-cc on", "-mm 0.1 2", "-bm 0.5", "-boost 3"];
    for option in loud.into_iter().chain(["-t 1 1", "-texres 256", "-imfchan r"]) {
        let (request, warnings) = kd_map(&format!("{option} x.png"));
        assert_eq!(request.paths[0], Path::new("folder/x.png"), "{option}");
        let name = option.split(' ').next().unwrap();
        let expected = format!("folder/m.mtl:2: `{name}` of a map is not simulated; left out");
        assert_eq!(warnings, [expected]);
    }
}

#[test]
fn names_with_backslashes_hashes_and_comments() {
    let paths = |words: &str| -> Vec<String> {
        let (request, _) = kd_map(words);
        request.paths.iter().map(|path| path.display().to_string()).collect()
    };
    assert!(paths(r"maps\wood.png").contains(&"folder/maps/wood.png".to_owned()));
    let both = paths("wood #3.png # a comment");
    assert_eq!(both, ["folder/wood #3.png # a comment", "folder/wood"]);
    assert_eq!(paths("wood.png # a comment")[1], "folder/wood.png");
}

#[test]
fn faults_of_options_have_a_place() {
    let fault = |words: &str| read(&format!("map_Kd {words}")).unwrap_err();
    assert_eq!(fault(""), "folder/m.mtl:2:1: `map_Kd` names no file");
    assert_eq!(fault("-clamp on"), "folder/m.mtl:2:1: `map_Kd` names no file");
    assert_eq!(fault("-s x.png"), "folder/m.mtl:2:8: `-s` lacks a number");
    assert_eq!(fault("-s 1e999 x.png"), "folder/m.mtl:2:11: `1e999` is not a finite number");
    assert_eq!(
        fault("-clamp maybe x.png"),
        "folder/m.mtl:2:15: `-clamp` is on or off, not `maybe`"
    );
    assert_eq!(fault("-clamp"), "folder/m.mtl:2:8: `-clamp` lacks a word");
}

#[test]
fn other_maps_are_named_once() {
    let others = ["map_Ka", "map_Ns", "map_d", "map_Bump", "bump", "disp", "refl", "norm"];
    for word in others.into_iter().chain(["map_Ke", "map_Pr", "map_Pm", "decal"]) {
        let file = read(&format!("{word} x.png\n{word} y.png")).unwrap();
        let expected = format!(
            "folder/m.mtl:2: `{word}` is not simulated by this version; left out (2 times; this is \
             the first)"
        );
        assert_eq!(file.warnings, [expected]);
    }
}

#[test]
fn a_map_alone_is_the_whole_coefficient() {
    let material = |library: &str| {
        let file = read(library).unwrap();
        (file.materials[0].clone(), file.textures[0].ks.is_some())
    };
    let (alone, has_ks) = material("map_Kd x.png\nmap_Ks y.png");
    assert_eq!((alone.kd, alone.ka, alone.ks, has_ks), ([1.0; 3], [1.0; 3], [1.0; 3], true));
    let (both, _) = material("map_Kd x.png\nKd 0.25");
    assert_eq!(both.kd, [0.25; 3]);
    // Model 1 has no specular reflection.
    assert!(!material("map_Ks y.png\nillum 1").1);
}

/// A folder with the triangle and a library whose material is `library`, and its scene.
fn scene(library: &str) -> (tempfile::TempDir, Result<Scene, SceneErrors>) {
    let library = format!("newmtl a\n{library}\n");
    let folder = folder(&[("t.obj", TRIANGLE), ("m.mtl", &library), ("x.tga", "a Targa")]);
    std::fs::create_dir(folder.path().join("maps")).unwrap();
    let four = folder.path().join("four.png");
    std::fs::copy(&four, folder.path().join("maps/my four.png")).unwrap();
    std::fs::copy(&four, folder.path().join("four#2.png")).unwrap();
    let cut = std::fs::read(four).unwrap()[..50].to_vec();
    std::fs::write(folder.path().join("cut.png"), cut).unwrap();
    let scene = load(folder.path(), "[[mesh]]\nfile = \"t.obj\"\n");
    (folder, scene)
}

#[test]
fn a_texture_is_found_however_its_name_is_written() {
    for name in [
        "four.png",
        r"maps\my four.png",
        "maps/my four.png # a comment",
        "four#2.png",
        "four.png # a comment",
    ] {
        let (_folder, scene) = scene(&format!("map_Kd -s 2 2 2 {name}"));
        let scene = scene.unwrap();
        assert_eq!(scene.warnings, [""; 0], "{name}");
        let map = scene.materials[0].kd_map.unwrap();
        assert_eq!((map.scale, scene.textures.len()), ([2.0; 2], 1));
    }
}

#[test]
fn a_texture_that_is_missing_is_told_and_left_out() {
    for (name, why) in [
        ("gone.png", "cannot be read: "),
        ("maps", "cannot be read: it is a folder"),
        ("x.tga", "is neither a PNG nor a JPEG image"),
    ] {
        let (folder, scene) = scene(&format!("Kd 0.5\nmap_Kd {name}"));
        let scene = scene.unwrap();
        let path = folder.path().join(name);
        let library = folder.path().join("m.mtl");
        let start = format!("{}:3: the texture `{}` {why}", library.display(), path.display());
        let [warning] = &scene.warnings[..] else { panic!("{:?}", scene.warnings) };
        assert!(warning.starts_with(&start) && warning.ends_with("; left out"), "{warning}");
        assert_eq!((scene.materials[0].kd, scene.materials[0].kd_map), ([0.5; 3], None));
    }
}

#[test]
fn without_its_texture_a_coefficient_that_is_not_written_is_the_default() {
    let coefficients = |library: &str| {
        let material = scene(library).1.unwrap().materials[0].clone();
        (material.ka[0], material.kd[0], material.ks[0])
    };
    assert_eq!(coefficients("map_Kd gone.png\nmap_Ks gone.png"), (0.8, 0.8, 0.0));
    assert_eq!(coefficients("map_Kd four.png\nmap_Ks gone.png"), (1.0, 1.0, 0.0));
    assert_eq!(coefficients("Ka 1\nmap_Kd gone.png\nmap_Ks four.png"), (1.0, 0.8, 1.0));
    assert_eq!(coefficients("Ks 0.5\nmap_Ks gone.png\nKd 0.25"), (0.25, 0.25, 0.5));
}

#[test]
fn a_texture_that_is_damaged_is_an_error_of_the_library() {
    let (folder, scene) = scene("map_Ks cut.png");
    let errors = scene.unwrap_err();
    let library = folder.path().join("m.mtl");
    assert_eq!(errors.0[0].place.to_string(), format!("{}:2", library.display()));
    assert_eq!(errors.fault(), Fault::Scene);
}
