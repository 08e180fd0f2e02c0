//! Derivatives of texture coordinates, against formulas of planes and against moved cameras.

use super::*;
use truecast::accel::{Accelerator, BuildPreset};
use truecast::cast::cast;
use truecast::pixel::Pixel;
use truecast::shade::footprint::{Footprint, footprint};
use truecast::shade::surface_point;
use truecast::visibility::{Counting, VisibilityBuffer};

fn answer(scene: &Scene) -> VisibilityBuffer {
    let accelerator = Accelerator::build(&scene.mesh, BuildPreset::Fast);
    let window = scene.camera.resolution().window();
    cast(scene, &accelerator, window, Counting::Nearest, &|| ())
}

fn pixels(scene: &Scene) -> impl Iterator<Item = Pixel> {
    let frame = scene.camera.resolution();
    (0..frame.height()).flat_map(move |y| (0..frame.width()).map(move |x| Pixel { x, y }))
}

/// A floor of side `size` at `height` seen from the origin, pixel (i, j) along (i − 8, j − 8, 8).
fn floor(size: &str, height: &str) -> Scene {
    let text = format!(
        "version = 1\n[image]\nwidth = 17\nheight = 17\n[camera.exact]\neye = [0, 0, 0]\n\
         d0 = [-8.5, -8.5, 8]\ndx = [1, 0, 0]\ndy = [0, 1, 0]\n\
         [[mesh]]\nshape = {{ plane = {{ width = {size}, depth = {size} }} }}\n\
         translate = [0, {height}, 0]\n"
    );
    Scene::from_toml(&text, Path::new("x"), Path::new(""), &Overrides::default()).unwrap()
}

/// The point of the floor in the direction (a, b, 8) is (a, b, 8)·h/b, and uv is (½ + x/s, ½ − z/s).
fn floor_footprint(pixel: Pixel, size: f64, height: f64) -> Footprint {
    let (a, b) = (f64::from(pixel.x) - 8.0, f64::from(pixel.y) - 8.0);
    let unit = height / size;
    Footprint { per_column: [unit / b, 0.0], per_row: [-unit * a / (b * b), unit * 8.0 / (b * b)] }
}

#[test]
fn on_a_floor_they_follow_the_formula() {
    // The last floor is 2^-20 below the eye and reaches to 10^8.
    let floors = [("64", "2.0"), ("3e5", "1024.0"), ("2e8", "9.5367431640625e-7")];
    for (size, height) in floors {
        let scene = floor(size, height);
        let buffer = answer(&scene);
        let mut seen = 0;
        for pixel in pixels(&scene) {
            let Some(visible) = buffer.at(pixel) else { continue };
            let found = footprint(&scene, pixel, visible).unwrap();
            let expected = floor_footprint(pixel, size.parse().unwrap(), height.parse().unwrap());
            for (found, expected) in
                [(found.per_column, expected.per_column), (found.per_row, expected.per_row)]
            {
                let largest = expected[0].abs().max(expected[1].abs());
                for k in 0..2 {
                    // A dozen roundings, relative to the vector.
                    let error = (found[k] - expected[k]).abs();
                    assert!(error <= 12.0 * f64::EPSILON * largest, "{size} {pixel:?}: {found:?}");
                }
            }
            seen += 1;
        }
        assert!(seen >= 100, "{size}: {seen} pixels");
    }
}

/// In a plane, uv is N/D with N and D linear along a row, and t is c/D: so
/// (uv(x + s) − uv(x))·t(x)/(t(x + s)·s) is the derivative at x without truncation.
#[test]
fn everywhere_they_are_the_differences_of_moved_cameras() {
    let text = format!(
        "{}[[mesh]]\nshape = {{ box = {{}} }}\nrotate_deg = [20, 30, 10]\n\
         [[mesh]]\nshape = {{ torus = {{ major = 1.2, minor = 0.3 }} }}\nscale = [1, 2, 1]\n",
        HEAD.replace("width = 4", "width = 48").replace("height = 3", "height = 36")
    );
    let load = Scene::from_toml(&text, Path::new("x"), Path::new(""), &Overrides::default());
    let scene = load.unwrap();
    let buffer = answer(&scene);
    const STEPS: i32 = 32;
    let step = f64::from(STEPS) / 256.0;
    let (mut compared, mut worst) = (0, 0.0_f64);
    for (axis, steps) in [[STEPS, 0], [0, STEPS]].into_iter().enumerate() {
        let moved = Scene { camera: scene.camera.shifted(steps), ..scene.clone() };
        let moved_buffer = answer(&moved);
        for pixel in pixels(&scene) {
            let (Some(here), Some(there)) = (buffer.at(pixel), moved_buffer.at(pixel)) else {
                continue;
            };
            if here.triangle != there.triangle {
                continue;
            }
            let uv = surface_point(&scene, pixel, here).0.uv.unwrap();
            let moved_uv = surface_point(&moved, pixel, there).0.uv.unwrap();
            let found = footprint(&scene, pixel, here).unwrap();
            let found = [found.per_column, found.per_row][axis];
            for k in 0..2 {
                let expected = (moved_uv[k] - uv[k]) * (here.t() / there.t()) / step;
                // uv below 1 is good to a few 2^-50, divided by the step of 1/8: a few 2^-46.
                let error = (found[k] - expected).abs();
                worst = worst.max(error);
                assert!(error <= 2.0_f64.powi(-44), "{pixel:?} {found:?} {expected}");
                compared += 1;
            }
        }
    }
    assert!(compared > 1000, "{compared}");
    assert!(worst > 0.0, "two computations");
}

#[test]
fn without_texture_coordinates_there_is_none() {
    let scene = crate::support::scenes::standard_scene(&[[
        [-6.0, -3.0, 8.0],
        [2.0, -3.0, 8.0],
        [-6.0, 5.0, 8.0],
    ]]);
    let buffer = answer(&scene);
    let pixel = pixels(&scene).find(|&pixel| buffer.at(pixel).is_some()).unwrap();
    assert_eq!(footprint(&scene, pixel, buffer.at(pixel).unwrap()), None);
}
