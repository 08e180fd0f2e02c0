//! What a scene file means: defaults, every form of the camera, lights, materials and transforms.

mod meshes;

use std::path::Path;
use truecast::mesh::TriangleId;
use truecast::scene::camera::PinholeCamera;
use truecast::scene::light::{
    AmbientLight, DirectionalLight, Light, LightColors, PointLight, SpotLight,
};
use truecast::scene::switches::Switches;
use truecast::scene::{Overrides, Scene, Shading, Sides, Source};

const HEAD: &str = "version = 1\n\
    [image]\nwidth = 4\nheight = 3\n\
    [camera]\neye = [0, 0, 5]\ntarget = [0, 0, 0]\nup = [0, 1, 0]\nfov_y_deg = 45\n";

#[track_caller]
fn load_in(base: &Path, text: &str) -> Scene {
    match Scene::from_toml(text, Path::new("test.toml"), base, &Overrides::default()) {
        Ok(scene) => scene,
        Err(errors) => panic!("{errors}"),
    }
}

#[track_caller]
fn load(text: &str) -> Scene {
    load_in(Path::new(""), text)
}

/// The example of the format's description, with a shape in place of the OBJ file.
const COMPLETE: &str = r#"version = 1
dialect = "curless"                # curless | angel | iit | cs315 | opengl

[image]
width = 960
height = 540
background = [0.02, 0.02, 0.03]

[camera]
eye = [0.0, 1.2, 4.0]
target = [0.0, 0.4, 0.0]
up = [0.0, 1.0, 0.0]
fov_y_deg = 40.0

[[material]]
name = "brass"
ka = [0.33, 0.22, 0.03]
kd = [0.78, 0.57, 0.11]
ks = [0.99, 0.94, 0.81]
ns = 27.9
ke = [0.0, 0.0, 0.0]

[[mesh]]
shape = { torus = { major = 1.0, minor = 0.35, around = 96, across = 64 } }
material = "brass"                 # without it, the OBJ's own MTL materials
shading = "phong"                  # phong | gouraud | flat
translate = [0.0, 0.0, 0.0]        # or rotate_deg, scale, or matrix (row-major 4x4)

[[light]]
type = "spot"                      # spot | point | directional | ambient | hemisphere
position = [2.0, 4.0, 3.0]
target = [0.0, 0.4, 0.0]           # or aim = direction
intensity = [1.0, 0.95, 0.9]       # sets diffuse and specular
attenuation = [1.0, 0.0, 0.02]     # a, b, c of 1/(a + b r + c r²)
cutoff_deg = 25.0
exponent = 8.0
"#;

#[test]
fn the_complete_example() {
    let scene = load(COMPLETE);
    let (width, height) = (scene.camera.resolution().width(), scene.camera.resolution().height());
    assert_eq!((width, height), (960, 540));
    assert_eq!(scene.background, [0.02, 0.02, 0.03]);
    assert_eq!(scene.mesh.len(), 2 * 96 * 64);
    assert_eq!(scene.objects[0].triangles, 0..2 * 96 * 64);
    assert_eq!(scene.materials.len(), 1);
    assert_eq!(scene.materials[0].ns, 27.9);
    assert_eq!(scene.material_of(TriangleId::new(5)).1.name, "brass");
    assert_eq!(scene.describe_source(TriangleId::new(5)), "torus#5");
    let Light::Spot(spot) = &scene.lights[0] else { panic!("{:?}", scene.lights) };
    assert_eq!((spot.cutoff_deg, spot.exponent), (25.0, 8.0));
    assert_eq!(spot.attenuation, [1.0, 0.0, 0.02]);
    assert_eq!(spot.colors.diffuse, [1.0, 0.95, 0.9]);
    assert_eq!(spot.colors.specular, [1.0, 0.95, 0.9]);
    assert_eq!(spot.colors.ambient, [0.0; 3]);
    assert!(spot.aim[0] < 0.0 && spot.aim[1] < 0.0 && spot.aim[2] < 0.0);
    assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
}

#[test]
fn defaults() {
    let scene = load(&format!(
        "{HEAD}[[material]]\nname = \"m\"\nkd = [0.1, 0.2, 0.3]\n[[material]]\nname = \"n\"\n\
         [[mesh]]\nshape = {{ plane = {{}} }}\n"
    ));
    assert_eq!(scene.background, [0.0; 3]);
    assert_eq!(scene.switches, Switches::default());
    let [m, n, default] = &scene.materials[..] else { panic!("{:?}", scene.materials) };
    assert_eq!((m.ka, m.kd, m.ks, m.ke, m.ns), ([0.1, 0.2, 0.3], m.ka, [0.0; 3], [0.0; 3], 32.0));
    assert_eq!((n.ka, n.kd), ([0.8; 3], [0.8; 3]));
    assert_eq!((default.name.as_str(), default.kd), ("default", [0.8; 3]));
    assert_eq!(scene.triangle_materials, [2, 2]);
    let plane = &scene.objects[0];
    assert_eq!((plane.shading, plane.sides), (Shading::Phong, Sides::Single));
    assert!(matches!(&plane.source, Source::Shape(name) if name == "plane"));
    assert!(scene.lights.is_empty());
    // A scene without a bare mesh has no default material, and a scene may be empty.
    assert!(load(HEAD).materials.is_empty());
}

#[test]
fn neutral_values_of_what_is_not_simulated_are_fine() {
    let head = HEAD.replace("height = 3\n", "height = 3\nsamples = 1\n");
    let scene = load(&format!(
        "dialect = \"curless\"\n{head}\
         [[material]]\nname = \"m\"\nopacity = 1.0\n\
         [[mesh]]\nshape = {{ plane = {{}} }}\nshading = \"phong\"\nsides = \"double\"\n\
         [[light]]\ntype = \"point\"\nposition = [0, 1, 0]\nambient = [1, 1, 1]\nshadows = false\n\
         [switches]\nbacklit_specular = \"le0\"\nattenuate_ambient = false\nka = \"own\"\n\
         specular = \"blinn\"\nspecular_cosine = false\nviewer = \"local\"\n\
         interpolation = \"perspective\"\nrenormalize = true\nflat = \"face-normal\"\n\
         fragment_vectors = \"recompute\"\nhemisphere = \"cosine\"\nnaive_normals = false\n"
    ));
    assert_eq!(scene.switches, Switches::default());
    assert_eq!(scene.objects[0].sides, Sides::Double);
}

#[test]
fn the_four_forms_of_the_camera() {
    let head = "version = 1\n[image]\nwidth = 4\nheight = 2\n";
    let look = load(&format!(
        "{head}[camera]\neye = [0, 0, 5]\ntarget = [0, 0, 0]\nup = [0, 1, 0]\nfov_y_deg = 90\n"
    ));
    let exact = load(&format!(
        "{head}[camera.exact]\neye = [0, 0, 5]\nd0 = [-2, 1, -1]\ndx = [1, 0, 0]\ndy = [0, -1, 0]\n"
    ));
    let opencv = load(&format!(
        "{head}[camera.opencv]\nK = [[1, 0, 2], [0, 1, 1], [0, 0, 1]]\n\
         R = [1, 0, 0, 0, -1, 0, 0, 0, -1]\nt = [0, 0, 5]\n"
    ));
    let gl = load(&format!(
        "{head}[camera.gl]\nview = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, -5], [0, 0, 0, 1]]\n\
         projection = [[0.5, 0, 0, 0], [0, 1, 0, 0], [0, 0, -1, -0.2], [0, 0, -1, 0]]\n"
    ));
    let numbers = |camera: &PinholeCamera| (camera.eye(), camera.d0(), camera.dx(), camera.dy());
    let expected = ([0.0, 0.0, 5.0], [-2.0, 1.0, -1.0], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0]);
    assert_eq!(numbers(&exact.camera), expected);
    assert_eq!(numbers(&opencv.camera), expected);
    assert_eq!(numbers(&gl.camera), expected);
    // tan 45° is rounded; the lattice of this frame has steps of 2^-41.
    for k in 0..3 {
        assert!((look.camera.d0()[k] - expected.1[k]).abs() <= 4.0 * 2.0_f64.powi(-41));
    }
}

#[test]
fn every_light() {
    let scene = load(&format!(
        "{HEAD}[[light]]\ntype = \"ambient\"\nambient = [1, 2, 3]\n\
         [[light]]\ntype = \"directional\"\naim = [0, -2, 0]\ndiffuse = [1, 0, 0]\nambient = [0, 0, 1]\n\
         [[light]]\ntype = \"point\"\nposition = [1, 2, 3]\nintensity = [1, 1, 1]\nattenuation = [0, 0, 1]\n\
         [[light]]\ntype = \"spot\"\nposition = [0, 3, 0]\ntarget = [0, 1, 0]\ncutoff_deg = 180\n\
         exponent = 2\nspecular = [0, 1, 0]\n\
         [[light]]\ntype = \"spot\"\nposition = [0, 3, 0]\naim = [1e-320, 0, 0]\ncutoff_deg = 30\nintensity = [1, 1, 1]\n"
    ));
    let colors = |ambient, diffuse, specular| LightColors { ambient, diffuse, specular };
    let (black, white) = ([0.0; 3], [1.0; 3]);
    let expected = [
        Light::Ambient(AmbientLight { ambient: [1.0, 2.0, 3.0] }),
        Light::Directional(DirectionalLight {
            aim: [0.0, -1.0, 0.0],
            colors: colors([0.0, 0.0, 1.0], [1.0, 0.0, 0.0], black),
            shadows: false,
        }),
        Light::Point(PointLight {
            position: [1.0, 2.0, 3.0],
            attenuation: [0.0, 0.0, 1.0],
            colors: colors(black, white, white),
            shadows: false,
        }),
        Light::Spot(SpotLight {
            position: [0.0, 3.0, 0.0],
            aim: [0.0, -1.0, 0.0],
            attenuation: [1.0, 0.0, 0.0],
            cutoff_deg: 180.0,
            exponent: 2.0,
            colors: colors(black, black, [0.0, 1.0, 0.0]),
            shadows: false,
        }),
        Light::Spot(SpotLight {
            position: [0.0, 3.0, 0.0],
            aim: [1.0, 0.0, 0.0],
            attenuation: [1.0, 0.0, 0.0],
            cutoff_deg: 30.0,
            exponent: 0.0,
            colors: colors(black, white, white),
            shadows: false,
        }),
    ];
    assert_eq!(scene.lights, expected);
    assert_eq!(
        scene.warnings,
        ["test.toml:28:12: `exponent` has no effect: a cutoff of 180° is no cone"]
    );
}

#[test]
fn a_scene_file_is_read_with_paths_beside_it() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    write("t.toml", &format!("{HEAD}[[mesh]]\nfile = \"t.obj\"\n"));
    let scene = Scene::load(&folder.path().join("t.toml"), &Overrides::default()).unwrap();
    assert_eq!(scene.mesh.len(), 1);
    std::fs::write(folder.path().join("bad.toml"), b"version = 1\nname = \"\xff\"\n").unwrap();
    let errors = Scene::load(&folder.path().join("bad.toml"), &Overrides::default()).unwrap_err();
    assert_eq!((errors.0[0].place.line, errors.0[0].place.column), (2, 9));
}
