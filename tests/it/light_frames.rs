//! `parent` of a light: the four ways of moving one (not at all, by its numbers, with the camera,
//! with an object).

use std::path::Path;
use truecast::render::{PlaneGroup, PlaneGroups, RenderOptions, Unwatched, render};
use truecast::scene::light::Light;
use truecast::scene::{Overrides, Scene};

type V3 = [f64; 3];

/// Relative difference of two pictures of one geometry written in two frames: positions are off by
/// some 2^-50 of their size, and f32 samples add 2^-24.
const RADIANCE_TOLERANCE: f32 = 1e-6;

/// Of a position or direction of size about 1 after a dozen f64 operations.
const FRAME_TOLERANCE: f64 = 1e-14;

const FRONT: &str = "eye = [0, 0, 5]\ntarget = [0, 0, 0]\nup = [0, 1, 0]\nfov_y_deg = 45\n";

const SPHERE: &str = "[[mesh]]\nshape = { uv_sphere = { around = 24, rings = 12 } }\n";

fn load(camera: &str, rest: &str) -> Result<Scene, String> {
    let text = format!(
        "version = 1\n[image]\nwidth = 32\nheight = 24\n[camera]\n{camera}\
         [[material]]\nname = \"m\"\nkd = [0.5, 0.5, 0.5]\nks = [0.5, 0.5, 0.5]\nns = 20\n{rest}"
    );
    Scene::from_toml(&text, Path::new("t.toml"), Path::new(""), &Overrides::default())
        .map_err(|errors| errors.to_string())
}

fn lights(camera: &str, rest: &str) -> Vec<Light> {
    load(camera, rest).unwrap_or_else(|errors| panic!("{errors}")).lights
}

fn picture(camera: &str, rest: &str) -> Vec<f32> {
    let scene = load(camera, rest).unwrap_or_else(|errors| panic!("{errors}"));
    let planes = PlaneGroups::default().with(PlaneGroup::Color);
    let options = RenderOptions { planes, ..RenderOptions::default() };
    let film = render(&scene, &options, &Unwatched).film;
    let plane = film.plane("G").unwrap();
    let truecast::film::Samples::Float(samples) = plane else { panic!("G is float") };
    samples.clone()
}

#[track_caller]
fn assert_alike(a: &[f32], b: &[f32]) {
    assert_eq!(a.len(), b.len());
    assert!(a.iter().any(|&sample| sample > 0.1), "something is lit");
    for (index, (a, b)) in a.iter().zip(b).enumerate() {
        assert!((a - b).abs() <= RADIANCE_TOLERANCE * a.abs().max(1.0), "{index}: {a} {b}");
    }
}

#[track_caller]
fn assert_close(a: V3, b: V3) {
    assert!((0..3).all(|k| (a[k] - b[k]).abs() <= FRAME_TOLERANCE), "{a:?} {b:?}");
}

fn point(parent: &str, position: V3) -> String {
    format!("[[light]]\ntype = \"point\"\n{parent}position = {position:?}\nintensity = [1, 1, 1]\n")
}

fn spot(parent: &str, position: V3, target: V3) -> String {
    format!(
        "[[light]]\ntype = \"spot\"\n{parent}position = {position:?}\ntarget = {target:?}\n\
         cutoff_deg = 30\nintensity = [1, 1, 1]\n"
    )
}

#[test]
fn a21_a_light_in_the_world_keeps_its_numbers() {
    let own = lights(FRONT, &point("", [0.1, -0.0, 3.0]));
    assert_eq!(own, lights(FRONT, &point("parent = \"world\"\n", [0.1, -0.0, 3.0])));
    let Light::Point(light) = &own[0] else { panic!("{own:?}") };
    assert_eq!(light.position.map(f64::to_bits), [0.1_f64, -0.0, 3.0].map(f64::to_bits));
}

#[test]
fn a21_a_lamp_follows_its_post() {
    // Turned by 90° about z, x goes to y and y to −x; then doubled before, and moved after.
    let post = "[[mesh]]\nname = \"post\"\nmaterial = \"m\"\nshape = { cylinder = { radius = 0.1 } }\n\
                scale = 2\nrotate_deg = [0, 0, 90]\ntranslate = [1, -1, 0.5]\n";
    let on_post = spot("parent = \"mesh:post\"\n", [0.5, 1.0, 2.0], [0.5, 0.0, 0.0]);
    // (0.5, 1, 2) → (1, 2, 4) → (−2, 1, 4) → (−1, 0, 4.5); the target (0.5, 0, 0) → (1, 0, 0.5).
    let by_hand = spot("", [-1.0, 0.0, 4.5], [1.0, 0.0, 0.5]);
    let rest = |light: &str| format!("{SPHERE}material = \"m\"\n{post}{light}");
    assert_eq!(lights(FRONT, &rest(&on_post)), lights(FRONT, &rest(&by_hand)));
    assert_alike(&picture(FRONT, &rest(&on_post)), &picture(FRONT, &rest(&by_hand)));
    // Moved with the post, it lights something else.
    let moved = rest(&on_post).replace("translate = [1, -1, 0.5]", "translate = [3, -1, 0.5]");
    assert_ne!(picture(FRONT, &moved), picture(FRONT, &rest(&on_post)));
}

#[test]
fn a21_directions_go_by_the_linear_part_and_become_unit() {
    let post = "[[mesh]]\nname = \"p\"\nshape = { plane = {} }\nscale = [2, 1, 1]\n\
                translate = [5, 6, 7]\n";
    let sun = "[[light]]\ntype = \"directional\"\nparent = \"mesh:p\"\naim = [1, -2, 0]\n\
               intensity = [1, 1, 1]\n";
    let own = lights(FRONT, &format!("{post}{sun}"));
    let Light::Directional(light) = &own[0] else { panic!("{own:?}") };
    assert_close(light.aim, [0.5_f64.sqrt(), -(0.5_f64.sqrt()), 0.0]);
}

#[test]
fn a21_a_camera_light_is_written_x_right_y_up_looking_along_minus_z() {
    // From +x towards the origin: right is −z, backwards is +x.
    let side = "eye = [5, 0, 0]\ntarget = [0, 0, 0]\nup = [0, 3, 0]\nfov_y_deg = 45\n";
    let lamp = spot("parent = \"camera\"\n", [1.0, 2.0, -3.0], [1.0, 2.0, -4.0]);
    for (camera, position, aim) in
        [(FRONT, [1.0, 2.0, 2.0], [0.0, 0.0, -1.0]), (side, [2.0, 2.0, -1.0], [-1.0, 0.0, 0.0])]
    {
        let own = lights(camera, &lamp);
        let Light::Spot(light) = &own[0] else { panic!("{own:?}") };
        assert_close(light.position, position);
        assert_close(light.aim, aim);
    }
    // The same frame from the camera's own vectors.
    let exact =
        "exact = { eye = [5, 0, 0], d0 = [-8, 12, 16], dx = [0, 0, -1], dy = [0, -1, 0] }\n";
    let own = lights(exact, &lamp);
    let Light::Spot(light) = &own[0] else { panic!("{own:?}") };
    assert_close(light.position, [2.0, 2.0, -1.0]);
    assert_close(light.aim, [-1.0, 0.0, 0.0]);
}

#[test]
fn a21_camera_and_object_moved_alike_keep_the_shading_of_a_camera_light() {
    let lamp = point("parent = \"camera\"\n", [1.0, 2.0, 0.0]);
    let front = picture(FRONT, &format!("{SPHERE}material = \"m\"\n{lamp}"));
    // All turned by 90° about y (z to x), and moved by (0.5, −2, 8), exact in f32.
    let camera = "eye = [5.5, -2, 8]\ntarget = [0.5, -2, 8]\nup = [0, 1, 0]\nfov_y_deg = 45\n";
    let place = "rotate_deg = [0, 90, 0]\ntranslate = [0.5, -2, 8]\n";
    let moved = picture(camera, &format!("{SPHERE}material = \"m\"\n{place}{lamp}"));
    // The mesh is rounded to f32 elsewhere now: edges may move over a sample, and normals by 2^-24
    // of the distance 8 over an edge of 0.26.
    let differing = front.iter().zip(&moved).filter(|(a, b)| (*a - *b).abs() > 1e-4).count();
    assert!(front.iter().any(|&sample| sample > 0.1) && differing <= 2, "{differing} pixels");
    // A light of the world would not have come along.
    let world = picture(
        camera,
        &format!("{SPHERE}material = \"m\"\n{place}{}", point("", [1.0, 2.0, 5.0])),
    );
    let differing = front.iter().zip(&world).filter(|(a, b)| (*a - *b).abs() > 1e-4).count();
    assert!(differing > 50, "{differing} pixels");
}

#[test]
fn a21_faults_have_a_place_and_a_remedy() {
    let refused = |rest: &str| load(FRONT, rest).unwrap_err();
    let post = "[[mesh]]\nname = \"lamp-post\"\nshape = { plane = {} }\n";
    let message = refused(&format!("{post}{}", point("parent = \"mesh:lamp-pots\"\n", [0.0; 3])));
    assert!(message.contains("there is no mesh `lamp-pots`"), "{message}");
    assert!(message.contains("did you mean `lamp-post`?"), "{message}");
    let message = refused(&point("parent = \"mesh:a\"\n", [0.0; 3]));
    assert!(message.contains("no `[[mesh]]` has a `name`"), "{message}");
    let message = refused(&point("parent = \"kamera\"\n", [0.0; 3]));
    assert!(message.contains("there is no frame `kamera`"), "{message}");
    assert!(message.contains("did you mean `camera`?"), "{message}");
    let message =
        refused("[[light]]\ntype = \"ambient\"\nparent = \"camera\"\nambient = [1, 1, 1]\n");
    assert!(message.contains("the type `ambient` has no use for `parent`"), "{message}");
    let message = refused(&format!("{post}{post}"));
    assert!(message.contains("the name `lamp-post` is taken by another mesh"), "{message}");
    let flat = "[[mesh]]\nname = \"a\"\nshape = { plane = {} }\nscale = [1, 0, 1]\n";
    let sun = "[[light]]\ntype = \"directional\"\nparent = \"mesh:a\"\naim = [0, -1, 0]\nintensity = [1, 1, 1]\n";
    let message = refused(&format!("{flat}{sun}"));
    assert!(message.contains("`aim` is a direction and must not have length 0"), "{message}");
    let far = "[[mesh]]\nname = \"a\"\nshape = { plane = {} }\nscale = 1e30\n";
    let message = refused(&format!("{far}{}", point("parent = \"mesh:a\"\n", [1e300, 0.0, 0.0])));
    assert!(message.contains("`position` is too far away"), "{message}");
}
