//! More polygons against better shading: error (A46) and outline (A47) of spheres of growing
//! tessellation against the analytic sphere.

use super::stage::{V3, ambient, answer, directional, dot, unit, white};
use std::fmt::Write as _;
use std::path::Path;
use truecast::pixel::Pixel;
use truecast::render::VisibilityPath;
use truecast::scene::material::Material;
use truecast::scene::{Overrides, Scene, Shading};
use truecast::shade::{self, Effects, SurfacePoint};
use truecast::visibility::VisibilityBuffer;

const SIDE: u32 = 96;

/// Columns and rings of the spheres.
const LEVELS: [[u32; 2]; 4] = [[12, 6], [24, 12], [48, 24], [96, 48]];

fn sphere([around, rings]: [u32; 2]) -> Scene {
    let mut text = String::new();
    writeln!(
        text,
        "version = 1\n[image]\nwidth = {SIDE}\nheight = {SIDE}\n[camera]\neye = [1.5, 2, 5]\n\
         target = [0, 0, 0]\nup = [0, 1, 0]\nfov_y_deg = 28\n[[mesh]]\n\
         shape = {{ uv_sphere = {{ around = {around}, rings = {rings} }} }}"
    )
    .unwrap();
    let mut scene =
        Scene::from_toml(&text, Path::new("t.toml"), Path::new(""), &Overrides::default()).unwrap();
    scene.materials =
        vec![Material { ks: [0.3; 3], ns: 10.0, ..Material::default_named("plastic") }];
    scene.triangle_materials.fill(0);
    scene.lights = vec![directional([-1.0, -2.0, -3.0], white()), ambient([0.1; 3])];
    scene
}

/// The point of the unit sphere at a pixel.
fn on_sphere(scene: &Scene, pixel: Pixel) -> Option<V3> {
    let (camera, [x, y]) = (&scene.camera, pixel.sample());
    let way =
        unit(std::array::from_fn(|k| camera.d0()[k] + x * camera.dx()[k] + y * camera.dy()[k]));
    let eye = camera.eye();
    let along = dot(eye, way);
    let discriminant = along * along - (dot(eye, eye) - 1.0);
    (discriminant >= 0.0)
        .then(|| -along - discriminant.sqrt())
        .map(|t| std::array::from_fn(|k| eye[k] + t * way[k]))
}

fn analytic(scene: &Scene, position: V3) -> f64 {
    let to_eye = unit(std::array::from_fn(|k| scene.camera.eye()[k] - position[k]));
    let point = SurfacePoint {
        position,
        to_eye,
        face_normal: position,
        shading_normal: position,
        uv: None,
        barycentric: truecast::mesh::Barycentric([1.0, 0.0, 0.0]),
    };
    shade::shade_point(scene, &point, &scene.materials[0])[0]
}

/// Root of the mean square of the differences, over the pixels that both spheres cover.
fn error(scene: &Scene, buffer: &VisibilityBuffer, shading: Shading) -> f64 {
    let mut drawn = scene.clone();
    drawn.objects[0].shading = shading;
    let radiance = shade::shade(&drawn, buffer, Effects::of(&drawn), &|| ()).radiance;
    let (mut sum, mut count) = (0.0, 0.0);
    for (index, visible) in buffer.visible.iter().enumerate() {
        let point = on_sphere(scene, buffer.window.pixel(index));
        let (Some(_), Some(point)) = (visible, point) else { continue };
        sum += (radiance[index][0] - analytic(scene, point)).powi(2);
        count += 1.0;
    }
    assert!(count > 1000.0);
    f64::sqrt(sum / count)
}

#[test]
fn a46_errors_fall_with_tessellation_and_phong_is_best_at_each_level() {
    let mut before = [f64::INFINITY; 3];
    for level in LEVELS {
        let scene = sphere(level);
        let buffer = answer(&scene, VisibilityPath::Cast);
        let errors = [Shading::Flat, Shading::Gouraud, Shading::Phong]
            .map(|shading| error(&scene, &buffer, shading));
        let [flat, gouraud, phong] = errors;
        assert!(phong < gouraud && gouraud < flat, "{level:?}: {errors:?}");
        for (now, before) in errors.iter().zip(before) {
            assert!(*now < before, "{level:?}: {errors:?} after {before:?}");
        }
        before = errors;
    }
    // Sixty-four times the triangles of the coarsest mesh; flat shading is still the worst.
    assert!(before[0] > 10.0 * before[2], "{before:?}");
}

#[test]
fn a47_no_interpolation_mends_the_outline() {
    let mut before = usize::MAX;
    for level in LEVELS {
        let scene = sphere(level);
        let wrong = [Shading::Flat, Shading::Gouraud, Shading::Phong].map(|shading| {
            let mut drawn = scene.clone();
            drawn.objects[0].shading = shading;
            drawn.background = [-1.0; 3];
            let buffer = answer(&drawn, VisibilityPath::Cast);
            let picture = shade::shade(&drawn, &buffer, Effects::of(&drawn), &|| ()).radiance;
            let missed = |(index, rgb): (usize, &V3)| {
                let inside = on_sphere(&scene, buffer.window.pixel(index)).is_some();
                inside != (rgb[0] >= 0.0)
            };
            picture.iter().enumerate().filter(|&pixel| missed(pixel)).count()
        });
        assert!(wrong[0] == wrong[1] && wrong[1] == wrong[2], "{level:?}: {wrong:?}");
        assert!(wrong[0] < before, "{level:?}: {wrong:?} after {before}");
        before = wrong[0];
    }
}
