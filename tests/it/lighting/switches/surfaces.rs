//! Switches of normals, of weights, and of where the equation is evaluated.

use super::super::matte;
use super::super::stage::{
    answer, bits, directional, floor, hemisphere, point, program_picture, white,
};
use super::{
    OFF, assert_changes, assert_changes_nothing, assert_pictures_differ, ball, glossy, normal,
    switched, word,
};
use std::fs;
use tempfile::TempDir;
use truecast::pixel::Pixel;
use truecast::render::VisibilityPath;
use truecast::scene::light::Light;
use truecast::scene::{Overrides, Scene, Shading};
use truecast::shade::{self, Outcome};
use truecast::visibility::Visible;

/// The octahedron's four visible faces: two in each of two objects with their own shading.
fn two_objects(shadings: [Shading; 2], lights: Vec<Light>) -> Scene {
    let mut scene = ball(glossy(), lights);
    let object = scene.objects[0].clone();
    scene.objects = [0..2, 2..8]
        .into_iter()
        .zip(shadings)
        .map(|(triangles, shading)| truecast::scene::Object {
            triangles,
            shading,
            ..object.clone()
        })
        .collect();
    scene
}

fn is_first_object(visible: &Visible) -> bool {
    visible.triangle.get() < 2
}

/// A light that all four visible faces see.
fn front() -> Light {
    directional([0.1, 0.05, -1.0], white())
}

/// Whether the only light reaches the surface.
fn is_reached(scene: &Scene, pixel: Pixel, visible: &Visible) -> bool {
    shade::terms(scene, pixel, visible, None).lights[0].outcome == Outcome::Lit
}

/// Nothing is mixed at a corner.
fn is_at_corner(visible: &Visible) -> bool {
    visible.barycentric.0.contains(&1.0)
}

#[test]
fn interpolation_changes_only_what_is_interpolated() {
    for shading in [Shading::Phong, Shading::Gouraud] {
        let scene = two_objects([shading, Shading::Flat], vec![front()]);
        let screen = switched(&scene, "interpolation", word("screen"));
        let buffer = answer(&scene, VisibilityPath::Cast);
        let (before, after) = (program_picture(&scene), program_picture(&screen));
        let mut changed = 0;
        for (index, visible) in buffer.visible.iter().enumerate() {
            let differs = bits(&before[index..=index]) != bits(&after[index..=index]);
            // On an edge between corners of equal depth both weights are the same.
            assert!(!differs || visible.as_ref().is_some_and(is_first_object));
            changed += usize::from(differs);
        }
        let seen = buffer.visible.iter().flatten().filter(|visible| is_first_object(visible));
        assert!(changed * 2 > seen.count(), "most pixels of the first object");
    }
    assert_changes_nothing(
        &two_objects([Shading::Flat; 2], vec![front()]),
        "interpolation",
        word("screen"),
    );
}

#[test]
fn renormalize_changes_only_normals_that_were_mixed() {
    let scene = two_objects([Shading::Phong, Shading::Flat], vec![front()]);
    assert_changes(&scene, "renormalize", OFF, |pixel, visible| {
        is_first_object(visible) && !is_at_corner(visible) && is_reached(&scene, pixel, visible)
    });
    for shading in [Shading::Gouraud, Shading::Flat] {
        let scene = two_objects([shading; 2], vec![front()]);
        assert_changes_nothing(&scene, "renormalize", OFF);
    }
}

#[test]
fn fragment_vectors_change_only_what_is_lit_at_fragments_from_near() {
    let lamp = || point([1.0, 2.0, 9.0], [1.0, 0.0, 0.0], white());
    let scene = two_objects([Shading::Phong, Shading::Gouraud], vec![lamp()]);
    let name = "fragment_vectors";
    let mixed = switched(&scene, name, word("interpolate"));
    assert_changes(&scene, name, word("interpolate"), |pixel, visible| {
        let is_reached = [&scene, &mixed].iter().any(|scene| is_reached(scene, pixel, visible));
        is_first_object(visible) && !is_at_corner(visible) && is_reached
    });
    let gouraud = two_objects([Shading::Gouraud; 2], vec![lamp()]);
    assert_changes_nothing(&gouraud, name, word("interpolate"));
    // Without a highlight the eye does not matter, and a light far away is the same everywhere.
    let matte = ball(matte([0.5; 3]), vec![front()]);
    assert_changes_nothing(&matte, name, word("interpolate"));
}

#[test]
fn flat_changes_only_flat_meshes() {
    let lamp = || point([1.0, 2.0, 9.0], [1.0, 0.0, 0.0], white());
    let scene = two_objects([Shading::Flat, Shading::Phong], vec![lamp()]);
    for value in ["one-point", "vertex-face-normal", "provoking"] {
        assert_changes(&scene, "flat", word(value), |_, visible| is_first_object(visible));
        let smooth = two_objects([Shading::Gouraud, Shading::Phong], vec![lamp()]);
        assert_changes_nothing(&smooth, "flat", word(value));
    }
}

#[test]
fn hemisphere_changes_only_slanted_normals_under_hemisphere_lights() {
    let around = || hemisphere([0.0, 0.0, 1.0], [0.9, 0.8, 0.7], [0.1, 0.2, 0.3]);
    let mut scene = ball(matte([0.5, 0.4, 0.3]), vec![around(), front()]);
    for value in ["sine", "linear"] {
        // The curves meet at the pole, which the middle pixel sees, and on the equator.
        assert_changes(&scene, "hemisphere", word(value), |pixel, visible| {
            let [_, _, cosine] = normal(&scene, pixel, visible);
            cosine != 0.0 && cosine != 1.0
        });
    }
    let mut upright = floor();
    upright.lights = vec![around()];
    scene.lights.remove(0);
    for value in ["sine", "linear"] {
        assert_changes_nothing(&upright, "hemisphere", word(value));
        assert_changes_nothing(&scene, "hemisphere", word(value));
    }
}

#[test]
fn naive_normals_change_only_meshes_of_uneven_scale() {
    let folder = TempDir::new().unwrap();
    let load = |naive: bool, scale: &str, x: &str| {
        let text = format!(
            "version = 1\nswitches = {{ naive_normals = {naive} }}\n[image]\nwidth = 32\n\
             height = 24\n[camera]\neye = [0, 0, 9]\ntarget = [0, 0, 0]\nup = [0, 1, 0]\n\
             fov_y_deg = 50\n[[mesh]]\nshape = {{ uv_sphere = {{}} }}\ntranslate = [-1.5, 0, 0]\n\
             [[mesh]]\nshape = {{ uv_sphere = {{}} }}\nscale = {scale}\ntranslate = [{x}, 0, 0]\n\
             [[light]]\ntype = \"directional\"\naim = [0.1, -0.2, -1]\nintensity = [1, 1, 1]\n"
        );
        fs::write(folder.path().join("t.toml"), &text).unwrap();
        Scene::load(&folder.path().join("t.toml"), &Overrides::default()).unwrap()
    };
    let uneven = "[1, 2, 0.5]";
    let (right, naive) = (load(false, uneven, "1.5"), load(true, uneven, "1.5"));
    let sphere = right.objects[0].triangles.clone();
    assert_pictures_differ(&right, &naive, |_, visible| !sphere.contains(&visible.triangle.get()));
    let (right, naive) = (load(false, "2", "2"), load(true, "2", "2"));
    assert_eq!(bits(&program_picture(&right)), bits(&program_picture(&naive)));
}
