//! The ways to shade a triangle: flat in its meanings (A40), its conditions (A41), Gouraud by both
//! paths (A42), Phong (A44), what Gouraud's method misses (A45), and the two pipelines (A56).

use super::stage::{
    V3, ambient, answer, bits, camera, directional, dot, floor, look, octahedron, pixel_at, point,
    program_picture, smooth_octahedron, unit, white,
};
use super::{ULP, shiny};
use std::collections::BTreeSet;
use truecast::check::tolerance::{compare_radiance, weights_agree};
use truecast::mesh::TriangleId;
use truecast::render::VisibilityPath;
use truecast::scene::switches::{SwitchValue, Switches};
use truecast::scene::{Scene, Shading};
use truecast::shade::{self, Effects, FlatFault, SurfacePoint};

fn glossy() -> truecast::scene::material::Material {
    shiny([0.5, 0.4, 0.3], [0.3, 0.4, 0.5], 8.0)
}

fn flat(scene: &Scene, meaning: &'static str, viewer: &'static str) -> Vec<V3> {
    let mut scene = scene.clone();
    scene.objects[0].shading = Shading::Flat;
    scene.switches = Switches::default()
        .with("flat", SwitchValue::Word(meaning))
        .with("viewer", SwitchValue::Word(viewer));
    program_picture(&scene)
}

#[test]
fn a40_flat_has_three_meanings_that_agree_from_afar() {
    let mut scene = octahedron();
    scene.materials = vec![glossy()];
    scene.lights = vec![directional([-1.0, -2.0, -4.0], white()), ambient([0.1; 3])];
    // Light and eye infinitely far: one evaluation per face, wherever it is made.
    let every_pixel = flat(&scene, "face-normal", "distant");
    assert_eq!(bits(&every_pixel), bits(&flat(&scene, "one-point", "distant")));
    let distinct: BTreeSet<[u64; 3]> = bits(&every_pixel).into_iter().collect();
    assert_eq!(distinct.len(), 5, "four faces and the background");
    // The third meaning interpolates three equal colours by weights that sum to 1 but for 2^-48.
    let corners = flat(&scene, "vertex-face-normal", "distant");
    for (a, b) in every_pixel.iter().zip(&corners) {
        assert!((0..3).all(|k| (a[k] - b[k]).abs() <= 16.0 * ULP * a[k]), "{a:?} {b:?}");
    }
    // A light nearby parts them.
    scene.lights = vec![point([2.0, 1.0, 9.0], [1.0, 0.0, 0.0], white())];
    let [a, b, c] = ["face-normal", "one-point", "vertex-face-normal"]
        .map(|meaning| flat(&scene, meaning, "local"));
    let differing =
        |a: &[V3], b: &[V3]| a.iter().zip(b).filter(|(a, b)| (a[0] - b[0]).abs() > 1e-3).count();
    let covered = look(&scene).covered_pixels();
    for (one, other) in [(&a, &b), (&b, &c), (&a, &c)] {
        assert!(differing(one, other) * 2 > covered, "{}", differing(one, other));
    }
}

#[test]
fn a41_the_conditions_of_flat_shading_are_told() {
    let faults = |scene: &Scene| -> Vec<FlatFault> {
        shade::flat_faults(scene).into_iter().flat_map(|(_, faults)| faults).collect()
    };
    // A polyhedron, a light and an eye infinitely far: nothing to say.
    let mut scene = octahedron();
    scene.objects[0].shading = Shading::Flat;
    scene.materials = vec![glossy()];
    scene.lights = vec![directional([0.0, 0.0, -1.0], white()), ambient([0.1; 3])];
    scene.light_names = vec!["sun".to_owned(), "air".to_owned()];
    scene.switches = Switches::of_dialect("opengl").unwrap();
    assert_eq!(faults(&scene), []);
    // Each condition alone.
    let mut near = scene.clone();
    near.lights[0] = point([0.0, 0.0, 9.0], [1.0, 0.0, 0.0], white());
    assert_eq!(faults(&near), [FlatFault::NearLight("sun".to_owned())]);
    let mut local = scene.clone();
    local.switches = Switches::default();
    assert_eq!(faults(&local), [FlatFault::NearViewer]);
    local.materials[0].ks = [0.0; 3];
    assert_eq!(faults(&local), [], "without a highlight the eye does not matter");
    let mut smooth = smooth_octahedron();
    (smooth.lights, smooth.light_names) = (scene.lights.clone(), scene.light_names.clone());
    smooth.switches = scene.switches.clone();
    smooth.objects[0].shading = Shading::Flat;
    assert_eq!(faults(&smooth), [FlatFault::CurvedSurface]);
    // A mesh that is not flat has no such conditions.
    smooth.objects[0].shading = Shading::Phong;
    assert_eq!(shade::flat_faults(&smooth), []);
}

#[test]
fn a41_explain_says_which_condition_fails() {
    let folder = tempfile::TempDir::new().unwrap();
    let path = folder.path().join("t.toml");
    let text = "version = 1\n[image]\nwidth = 8\nheight = 8\n[camera]\neye = [0, 0, 5]\n\
                target = [0, 0, 0]\nup = [0, 1, 0]\nfov_y_deg = 45\n[[mesh]]\n\
                shape = { uv_sphere = {} }\nshading = \"flat\"\n[[light]]\nname = \"lamp\"\n\
                type = \"point\"\nposition = [0, 3, 3]\nintensity = [1, 1, 1]\n";
    std::fs::write(&path, text).unwrap();
    let explain = |more: &[&str]| {
        let mut command = assert_cmd::Command::new(env!("CARGO_BIN_EXE_truecast"));
        let output = command.arg("explain").arg(&path).args(more).output().unwrap();
        assert!(output.status.success());
        String::from_utf8(output.stdout).unwrap()
    };
    let expected = "it stands for a curved surface; the light `lamp` is not infinitely far";
    assert!(explain(&[]).contains(&format!("flat shading of mesh 0 `uv_sphere`: {expected}\n")));
    let document: serde_json::Value = serde_json::from_str(&explain(&["--json"])).unwrap();
    let faults = &document["flat_faults"][0]["faults"];
    assert_eq!(faults.as_array().unwrap().len(), 2, "{faults}");
}

#[test]
fn a42_gouraud_by_rays_is_gouraud_by_the_rasterizer() {
    let mut scene = super::neutrality::busy_scene();
    scene.objects[0].shading = Shading::Gouraud;
    let [cast, raster] =
        [VisibilityPath::Cast, VisibilityPath::Raster].map(|path| answer(&scene, path));
    let shade = |buffer| shade::shade(&scene, buffer, Effects::of(&scene), &|| ()).radiance;
    // Ids and facings are the same; weights are each right to 2^-47, so colours agree to the
    // tolerance of `check` and not to the bit.
    let (by_rays, by_raster) = (shade(&cast), shade(&raster));
    for (index, (a, b)) in cast.visible.iter().zip(&raster.visible).enumerate() {
        let id = |v: &Option<truecast::visibility::Visible>| {
            v.as_ref().map(|v| (v.triangle, v.facing, v.tie))
        };
        assert_eq!(id(a), id(b));
        let ns = a.as_ref().map_or(0.0, |a| scene.material_of(a.triangle).1.ns);
        assert!(compare_radiance(by_rays[index], by_raster[index], ns).1);
        if let (Some(a), Some(b)) = (a, b) {
            let (a, b) = (a.barycentric.0, b.barycentric.0);
            assert!((0..3).all(|i| weights_agree(a[i], b[i])), "{a:?} {b:?}");
        }
    }
    assert!(cast.covered_pixels() > 50);
}

#[test]
fn a44_phong_interpolates_normals_and_makes_them_unit() {
    let scene = smooth_octahedron();
    assert_eq!(scene.objects[0].shading, Shading::Phong, "which is the default");
    let buffer = answer(&scene, VisibilityPath::Cast);
    let mut longest_step = 0.0_f64;
    for (pixel, visible) in buffer.window.pixels().zip(&buffer.visible) {
        let Some(visible) = visible else { continue };
        let normal = shade::surface_point(&scene, pixel, visible).0.shading_normal;
        let corners = scene.mesh.normals_of(visible.triangle).unwrap();
        let mean: V3 =
            std::array::from_fn(|k| (0..3).map(|i| visible.barycentric.0[i] * corners[i][k]).sum());
        longest_step = longest_step.max(1.0 - dot(mean, mean).sqrt());
        let expected = unit(mean);
        assert!((0..3).all(|k| (normal[k] - expected[k]).abs() <= 4.0 * ULP), "{pixel:?}");
    }
    assert!(longest_step > 0.2, "means are far from unit: {longest_step}");
}

/// Radiance along the row y = 0 from x = −5 to 5, by each method.
fn row(scene: &Scene, shading: Shading) -> Vec<f64> {
    let mut scene = scene.clone();
    scene.objects[0].shading = shading;
    let picture = program_picture(&scene);
    let window = scene.camera.resolution().window();
    (-5..=5).map(|x| picture[window.index(pixel_at(x, 0))][0]).collect()
}

#[test]
fn a45_gouraud_misses_highlights_and_makes_mach_bands() {
    // A lamp close to the middle of big triangles: the corners see nothing of its highlight.
    let mut scene = floor();
    scene.mesh.normals = vec![[0.0, 0.0, 1.0]];
    scene.mesh.corner_normals = vec![[0; 3]; 2];
    scene.materials = vec![shiny([0.1; 3], [0.9; 3], 40.0)];
    scene.lights = vec![point([0.0, 0.0, 4.0], [1.0, 0.0, 0.0], white())];
    let largest = |shading| row(&scene, shading).into_iter().fold(0.0, f64::max);
    let (gouraud, phong) = (largest(Shading::Gouraud), largest(Shading::Phong));
    assert!(phong > 0.99 && gouraud < 0.02, "{gouraud} {phong}");

    // Two faces that meet at x = 0; the normals lean by −30°, 0 and 30°.
    let lean = |degrees: f64| super::tilted(degrees);
    let (low, high) = (-9.0, 9.0);
    let corners = [-6.0, 0.0, 6.0].map(|x| [[x, low, 0.0], [x, high, 0.0]]).concat();
    let mut scene = Scene::from_triangles(camera(), &[[corners[0]; 3]; 4]);
    scene.mesh.positions = corners;
    scene.mesh.corners = vec![[0, 2, 1], [2, 3, 1], [2, 4, 3], [4, 5, 3]];
    scene.mesh.normals = vec![lean(-30.0), lean(0.0), lean(30.0)];
    scene.mesh.corner_normals = scene.mesh.corners.iter().map(|ids| ids.map(|v| v / 2)).collect();
    scene.materials = vec![shiny([1.0; 3], [0.0; 3], 1.0)];
    scene.lights = vec![directional(lean(20.0).map(|c| -c), white())];
    // The jump of the slope at x = 0, beyond the bend of the neighbouring pixels.
    let jump = |shading| {
        let row = row(&scene, shading);
        let bend = |i: usize| row[i - 1] - 2.0 * row[i] + row[i + 1];
        (bend(5) - 0.5 * (bend(4) + bend(6))).abs()
    };
    let (gouraud, phong) = (jump(Shading::Gouraud), jump(Shading::Phong));
    assert!(gouraud > 0.01 && phong < 0.05 * gouraud, "{gouraud} {phong}");
}

#[test]
fn a56_the_old_pipeline_lights_vertices_the_programmable_one_fragments() {
    let mut scene = smooth_octahedron();
    scene.materials = vec![glossy()];
    scene.lights = vec![point([2.0, 1.0, 9.0], [1.0, 0.0, 0.0], white())];
    let buffer = look(&scene);
    let lit = |position: V3, normal: V3| {
        let to_eye = unit(std::array::from_fn(|k| scene.camera.eye()[k] - position[k]));
        let point = SurfacePoint {
            position,
            to_eye,
            face_normal: normal,
            shading_normal: normal,
            uv: None,
            barycentric: truecast::mesh::Barycentric([1.0, 0.0, 0.0]),
        };
        shade::shade_point(&scene, &point, &scene.materials[0])
    };
    let attributes = |id: TriangleId| {
        let positions = scene.mesh.triangle(id).map(|corner| corner.map(f64::from));
        (positions, scene.mesh.normals_of(id).unwrap())
    };
    let mixed = |weights: V3, [a, b, c]: [V3; 3]| -> V3 {
        std::array::from_fn(|k| weights[0] * a[k] + weights[1] * b[k] + weights[2] * c[k])
    };
    for (shading, at_vertices) in [(Shading::Gouraud, true), (Shading::Phong, false)] {
        let mut drawn = scene.clone();
        drawn.objects[0].shading = shading;
        let radiance = shade::shade(&drawn, &buffer, Effects::ALL, &|| ()).radiance;
        for (visible, rgb) in buffer.visible.iter().zip(&radiance) {
            let Some(visible) = visible else { continue };
            let (positions, normals) = attributes(visible.triangle);
            let weights = visible.barycentric.0;
            let expected = if at_vertices {
                mixed(weights, [0, 1, 2].map(|i| lit(positions[i], normals[i])))
            } else {
                lit(mixed(weights, positions), unit(mixed(weights, normals)))
            };
            // Positions and normals of two evaluations, a power of 8.
            assert!((0..3).all(|k| (rgb[k] - expected[k]).abs() <= 64.0 * ULP), "{visible:?}");
        }
        // How often the light is evaluated: at three vertices per run of a row's pixels on one
        // triangle, or once at every pixel.
        let counts = shade::count_evaluations(&drawn, &buffer, Effects::of(&drawn));
        let mut runs = 0;
        for row in buffer.visible.chunks(17) {
            let mut last = None;
            for visible in row.iter().flatten() {
                runs += u64::from(last != Some(visible.triangle));
                last = Some(visible.triangle);
            }
        }
        let expected = if at_vertices { 3 * runs } else { buffer.covered_pixels() as u64 };
        assert_eq!(counts.of(Effects::POINT), expected, "{shading:?}");
    }
}
