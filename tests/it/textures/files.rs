//! Textures of scene files: what is read, for whom, and what is wrong with it.

use super::*;
use truecast::scene::hash::content_hash;

const MATERIAL: &str = "[[material]]\nname = \"m\"\nkd_map = \"four.png\"\n";

#[test]
fn a_map_stands_for_its_coefficient_and_the_defaults_are_filled_in() {
    let folder = folder(&[]);
    let scene = load(folder.path(), &format!("{MATERIAL}{PLANE}")).unwrap();
    let material = &scene.materials[0];
    assert_eq!((material.kd, material.ka, material.ks), ([1.0; 3], [1.0; 3], [0.0; 3]));
    assert_eq!(material.kd_map, Some(reference(Filter::Bilinear, Wrap::Repeat)));
    assert_eq!(material.ks_map, None);
    let [texture] = &scene.textures[..] else { panic!("one texture") };
    assert_eq!(texture.path, folder.path().join("four.png"));
    assert_eq!((texture.levels.len(), texture.base().width()), (1, 2));
    // The bottom row first: blue, white, red, green.
    let colors = [[0.0, 0.0, 1.0], [1.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    assert_eq!(texture.base().texels(), colors);
    assert_eq!(scene.warnings, [""; 0]);
    let text = "[[material]]\nname = \"m\"\nkd = [0.5, 0.5, 0.5]\nkd_map = \"four.png\"\n\
        ks_map = \"./four.png\"\nfilter = \"mip\"\nwrap = \"clamp\"\n";
    let scene = load(folder.path(), &format!("{text}{PLANE}")).unwrap();
    let material = &scene.materials[0];
    assert_eq!((material.kd, material.ks), ([0.5; 3], [1.0; 3]));
    assert_eq!(material.kd_map.unwrap().filter, Filter::Mip);
    assert_eq!(material.ks_map.unwrap().wrap, Wrap::Clamp);
}

#[test]
fn each_file_is_read_once_and_smaller_levels_are_made_only_where_they_are_asked_for() {
    let folder = folder(&[]);
    std::fs::copy(folder.path().join("four.png"), folder.path().join("other.png")).unwrap();
    let text = "[[material]]\nname = \"m\"\nkd_map = \"four.png\"\nks_map = \"other.png\"\n\
        [[material]]\nname = \"n\"\nkd_map = \"other.png\"\nfilter = \"mip\"\n\
        [[mesh]]\nshape = { plane = {} }\nmaterial = \"n\"\n";
    let scene = load(folder.path(), &format!("{text}{PLANE}")).unwrap();
    assert_eq!(scene.textures.iter().map(|t| t.levels.len()).collect::<Vec<_>>(), [1, 2]);
    assert_eq!(scene.materials[0].ks_map.unwrap().texture, 1);
    assert_eq!(scene.materials[1].kd_map.unwrap().texture, 1);
    // A clone shares the texels.
    let clone = scene.clone();
    assert!(std::ptr::eq(clone.textures[0].base(), scene.textures[0].base()));
}

#[test]
fn what_nothing_shows_is_not_opened() {
    let text = "[[material]]\nname = \"unused\"\nkd_map = \"no-such.png\"\n\
        [[material]]\nname = \"m\"\n";
    let scene = load(Path::new("no-such-folder"), &format!("{text}{PLANE}")).unwrap();
    assert!(scene.textures.is_empty() && scene.warnings.is_empty());
    assert_eq!((scene.materials[0].kd, scene.materials[0].kd_map), ([1.0; 3], None));
}

/// The first fault of a material on a plane, with the help, and whose it is.
fn fault(base: &Path, keys: &str) -> (String, Fault) {
    let text = format!("[[material]]\nname = \"m\"\n{keys}{PLANE}");
    let errors = load(base, &text).unwrap_err();
    assert_eq!(errors.0.len(), 1, "{errors}");
    (errors.to_string(), errors.fault())
}

#[test]
fn faults_have_a_place_a_file_and_a_reason() {
    let folder = folder(&[("text.png", "no picture"), ("cut.png", "")]);
    let whole = std::fs::read(folder.path().join("four.png")).unwrap();
    std::fs::write(folder.path().join("cut.png"), &whole[..50]).unwrap();
    let base = folder.path();
    let path = |name: &str| base.join(name).display().to_string();
    let (message, whose) = fault(base, "kd_map = \"gone.png\"\n");
    let start = format!("test.toml:12:10: the texture `{}` cannot be read: ", path("gone.png"));
    assert!(message.starts_with(&start), "{message}");
    assert_eq!(whose, Fault::Reading);
    assert_eq!(
        fault(base, "ks_map = \"\"\n"),
        (
            format!("test.toml:12:10: the texture `{}` cannot be read: it is a folder", path("")),
            Fault::Reading
        )
    );
    let kind = format!(
        "test.toml:12:10: the texture `{}` is neither a PNG nor a JPEG image\n  \
         save it as a PNG or JPEG image",
        path("text.png")
    );
    assert_eq!(fault(base, "ks_map = \"text.png\"\n"), (kind, Fault::Scene));
    let (message, whose) = fault(base, "kd_map = \"cut.png\"\n");
    assert!(message.contains("cut.png` cannot be decoded: "), "{message}");
    assert_eq!(whose, Fault::Scene);
    // The same missing file twice is one fault.
    fault(base, "kd_map = \"gone.png\"\nks_map = \"gone.png\"\n");
}

#[test]
fn unknown_words_get_a_suggestion() {
    let folder = folder(&[]);
    let map = "kd_map = \"four.png\"\n";
    let message = |keys: &str| fault(folder.path(), &format!("{map}{keys}")).0;
    assert_eq!(
        message("filter = \"bilinar\"\n"),
        "test.toml:13:10: there is no filter \"bilinar\"\n  did you mean `bilinear`?"
    );
    assert_eq!(
        message("wrap = \"mirror\"\n"),
        "test.toml:13:8: there is no wrap \"mirror\"\n  known here: repeat, clamp"
    );
    assert_eq!(
        fault(folder.path(), "filter = \"mip\"\n").0,
        "test.toml:12:10: `filter` has no use without `kd_map` or `ks_map`"
    );
}

#[test]
fn a_mesh_without_coordinates_is_told_once() {
    let bare = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\n";
    let half = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\nf 3 2 1\n";
    let folder = folder(&[("bare.obj", bare), ("half.obj", half)]);
    let text = format!(
        "{MATERIAL}{PLANE}[[mesh]]\nfile = \"bare.obj\"\nmaterial = \"m\"\n\
         [[mesh]]\nfile = \"half.obj\"\nmaterial = \"m\"\n[[mesh]]\nfile = \"bare.obj\"\n"
    );
    let scene = load(folder.path(), &text).unwrap();
    let rest = "of its triangles have a texture but no texture coordinates; they are drawn without \
        it";
    assert_eq!(
        scene.warnings,
        [
            format!("test.toml:16:1: mesh `bare.obj`: 2 {rest}"),
            format!("test.toml:19:1: mesh `half.obj`: 1 {rest}")
        ]
    );
}

#[test]
fn the_digest_follows_texels_and_how_they_are_used() {
    let folder = folder(&[]);
    let digest = |keys: &str| {
        let scene = load(folder.path(), &format!("{MATERIAL}{keys}{PLANE}")).unwrap();
        content_hash(&scene)
    };
    let plain = digest("");
    assert_eq!(digest("filter = \"bilinear\"\n"), plain);
    for other in ["filter = \"nearest\"\n", "wrap = \"clamp\"\n", "ks_map = \"four.png\"\n"] {
        assert_ne!(digest(other), plain, "{other}");
    }
    let mut picture = image::open(folder.path().join("four.png")).unwrap().into_rgb8();
    picture.put_pixel(0, 0, Rgb([254, 0, 0]));
    picture.save(folder.path().join("four.png")).unwrap();
    assert_ne!(digest(""), plain);
}

#[test]
fn the_picture_of_the_project_is_a_checker() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let scene = Scene::load(&root.join("perspective-texture.toml"), &Overrides::default()).unwrap();
    let [texture] = &scene.textures[..] else { panic!("one texture") };
    let base = texture.base();
    assert_eq!((base.width(), base.height()), (64, 64));
    let colors = [base.texel(0, 0), base.texel(8, 0)];
    assert_ne!(colors[0], colors[1]);
    for row in 0..64 {
        for column in 0..64 {
            let square = (row / 8 + column / 8) % 2;
            assert_eq!(base.texel(column, row), colors[square as usize], "{column} {row}");
        }
    }
}
