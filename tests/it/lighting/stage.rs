//! Small scenes on a camera of whole numbers, and a ray test of the tests' own.

use truecast::accel::BuildPreset;
use truecast::mesh::{Barycentric, TriangleId};
use truecast::pixel::{Pixel, Resolution};
use truecast::render::{Answerer, Unwatched, VisibilityPath};
use truecast::scene::Scene;
use truecast::scene::camera::PinholeCamera;
use truecast::scene::light::{
    AmbientLight, DirectionalLight, HemisphereLight, Light, LightColors, PointLight, SpotLight,
};
use truecast::shade::{self, Effects};
use truecast::visibility::{Counting, Facing, Level, LevelCounts, VisibilityBuffer, Visible};

/// Half the side of the picture: pixel (HALF + x, HALF − y) looks at the point (x, y, 0).
pub(super) const HALF: u32 = 8;

pub(super) type V3 = [f64; 3];

/// 17×17 pixels, eye (0, 0, 8), looking along −z: the ray of pixel (i, j) meets the plane z = 0 at
/// the whole-numbered point (i − 8, 8 − j) with t = 1, without any rounding.
pub(super) fn camera() -> PinholeCamera {
    let resolution = Resolution::new(2 * HALF + 1, 2 * HALF + 1).unwrap();
    let half = f64::from(HALF) + 0.5;
    let (dx, dy) = ([1.0, 0.0, 0.0], [0.0, -1.0, 0.0]);
    PinholeCamera::exact(resolution, [0.0, 0.0, 8.0], [-half, half, -8.0], dx, dy).unwrap()
}

/// The pixel that looks at (x, y, 0).
pub(super) fn pixel_at(x: i32, y: i32) -> Pixel {
    let half = HALF as i32;
    Pixel { x: (half + x) as u32, y: (half - y) as u32 }
}

/// The plane z = 0 seen from its front, covering every pixel (two triangles).
pub(super) fn floor() -> Scene {
    let s = 64.0;
    Scene::from_triangles(
        camera(),
        &[[[-s, -s, 0.0], [s, -s, 0.0], [s, s, 0.0]], [[-s, -s, 0.0], [s, s, 0.0], [-s, s, 0.0]]],
    )
}

/// An octahedron of radius 6: eight differently inclined faces, four of them seen.
pub(super) fn octahedron() -> Scene {
    let r = 6.0;
    let mut triangles = Vec::new();
    for (sx, sy, sz) in [
        (1.0, 1.0, 1.0),
        (-1.0, 1.0, 1.0),
        (-1.0, -1.0, 1.0),
        (1.0, -1.0, 1.0),
        (1.0, 1.0, -1.0),
        (-1.0, 1.0, -1.0),
        (-1.0, -1.0, -1.0),
        (1.0, -1.0, -1.0),
    ] {
        let (x, y, z) = ([sx * r, 0.0, 0.0], [0.0, sy * r, 0.0], [0.0, 0.0, sz * r]);
        triangles.push(if sx * sy * sz > 0.0 { [x, y, z] } else { [x, z, y] });
    }
    Scene::from_triangles(camera(), &triangles)
}

/// The octahedron with the unit corner normals of the sphere around it.
pub(super) fn smooth_octahedron() -> Scene {
    let mut scene = octahedron();
    scene.mesh.normals =
        scene.mesh.positions.iter().map(|p| p.map(|c| f64::from(c) / 6.0)).collect();
    scene.mesh.corner_normals = scene.mesh.corners.clone();
    scene
}

pub(super) fn colors(ambient: V3, diffuse: V3, specular: V3) -> LightColors {
    LightColors { ambient, diffuse, specular }
}

/// White diffuse and specular light, no ambient.
pub(super) fn white() -> LightColors {
    colors([0.0; 3], [1.0; 3], [1.0; 3])
}

pub(super) fn ambient(ambient: V3) -> Light {
    Light::Ambient(AmbientLight { ambient })
}

pub(super) fn hemisphere(up: V3, top: V3, bottom: V3) -> Light {
    Light::Hemisphere(HemisphereLight { up: unit(up), top, bottom })
}

pub(super) fn directional(aim: V3, colors: LightColors) -> Light {
    Light::Directional(DirectionalLight { aim: unit(aim), colors, shadows: false })
}

pub(super) fn point(position: V3, attenuation: V3, colors: LightColors) -> Light {
    Light::Point(PointLight { position, attenuation, colors, shadows: false })
}

pub(super) fn spot(position: V3, aim: V3, cutoff_deg: f64, exponent: f64) -> SpotLight {
    SpotLight {
        position,
        aim: unit(aim),
        attenuation: [1.0, 0.0, 0.0],
        cutoff_deg,
        exponent,
        colors: white(),
        shadows: false,
    }
}

pub(super) fn unit(a: V3) -> V3 {
    let length = dot(a, a).sqrt();
    a.map(|c| c / length)
}

pub(super) fn dot(a: V3, b: V3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn cross(a: V3, b: V3) -> V3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// What is visible, by f64 triple products over all triangles: good for whole-numbered scenes.
pub(super) fn look(scene: &Scene) -> VisibilityBuffer {
    let window = scene.camera.resolution().window();
    let visible = window.pixels().map(|pixel| look_at(scene, pixel)).collect();
    VisibilityBuffer { window, visible, cover: None, levels: LevelCounts::default() }
}

pub(super) fn look_at(scene: &Scene, pixel: Pixel) -> Option<Visible> {
    let (camera, [x, y]) = (&scene.camera, pixel.sample());
    let d = std::array::from_fn(|k| camera.d0()[k] + x * camera.dx()[k] + y * camera.dy()[k]);
    let mut nearest: Option<Visible> = None;
    for triangle in scene.mesh.ids() {
        let corners = scene.mesh.triangle(triangle);
        let a: [V3; 3] =
            corners.map(|v| std::array::from_fn(|k| f64::from(v[k]) - camera.eye()[k]));
        let volume = dot(a[0], cross(a[1], a[2]));
        let w: V3 = std::array::from_fn(|i| dot(cross(a[(i + 1) % 3], a[(i + 2) % 3]), d));
        let sum = w[0] + w[1] + w[2];
        if volume == 0.0 || sum == 0.0 || w.iter().any(|w| w * volume < 0.0) {
            continue;
        }
        let t = volume / sum;
        if nearest.as_ref().is_none_or(|best| t < best.t_lo) {
            nearest = Some(Visible {
                triangle,
                facing: if volume < 0.0 { Facing::Front } else { Facing::Back },
                level: Level::Double,
                tie: false,
                barycentric: Barycentric(w.map(|w| w / sum)),
                t_lo: t,
                t_hi: t,
            });
        }
    }
    nearest
}

/// What one of the program's own paths sees, with the counts of crossed triangles.
pub(super) fn answer(scene: &Scene, path: VisibilityPath) -> VisibilityBuffer {
    let window = scene.camera.resolution().window();
    let answerer = Answerer::new(scene, path, BuildPreset::Medium, &Unwatched);
    answerer.see(scene, window, Counting::All, &Unwatched)
}

/// The program's picture: [`answer`] by rays, shaded.
pub(super) fn program_picture(scene: &Scene) -> Vec<V3> {
    let buffer = answer(scene, VisibilityPath::Cast);
    shade::shade(scene, &buffer, Effects::of(scene), &|| ()).radiance
}

/// A point of a triangle, by weights chosen by hand; t is that of the plane z = 0.
pub(super) fn seen(triangle: u32, barycentric: V3) -> Visible {
    Visible {
        triangle: TriangleId::new(triangle),
        facing: Facing::Front,
        level: Level::Double,
        tie: false,
        barycentric: Barycentric(barycentric),
        t_lo: 1.0,
        t_hi: 1.0,
    }
}

/// The picture with the effects that the scene calls for.
pub(super) fn picture(scene: &Scene) -> Vec<V3> {
    shade::shade(scene, &look(scene), Effects::of(scene), &|| ()).radiance
}

/// Radiance at the pixel that looks at (x, y, 0).
pub(super) fn radiance_at(scene: &Scene, x: i32, y: i32) -> V3 {
    picture(scene)[scene.camera.resolution().window().index(pixel_at(x, y))]
}

/// The bits of a picture, for comparisons that no tolerance softens.
pub(super) fn bits(radiance: &[V3]) -> Vec<[u64; 3]> {
    radiance.iter().map(|rgb| rgb.map(f64::to_bits)).collect()
}
