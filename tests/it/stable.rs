//! Stable shading, S01 to S35 by name: inputs at which a plain evaluation of the shading equation
//! breaks, through whole scenes, against values computed to 50 digits or by hand.
//!
//! One pixel looks at the origin, mostly along −z at a plate in z = 0 whose corners share one
//! normal, so that N, L and V are what the scene file says.

mod hemisphere;
mod interpolation;
mod invalid;
mod lights;
mod normals;
mod output;
mod specular;
mod sums;

use std::fs;
use std::path::Path;
use tempfile::TempDir;
use truecast::accel::BuildPreset;
use truecast::render::{Unwatched, VisibilityPath, see};
use truecast::scene::{Overrides, Scene};
use truecast::shade::{self, Effects, Shaded};
use truecast::visibility::{Counting, VisibilityBuffer};

type V3 = [f64; 3];

/// Relative, of a radiance: the digits that every value below is known to.
const TOLERANCE: f64 = 1e-9;

const UP: V3 = [0.0, 0.0, 1.0];

/// 17 × 17 pixels, eye (0, 0, 8): the ray of pixel (8 + x, 8 − y) meets z = 0 at (x, y, 0).
const GRID: &str = "width = 17\nheight = 17\n[camera.exact]\neye = [0.0, 0.0, 8.0]\n\
    d0 = [-8.5, 8.5, -8.0]\ndx = [1.0, 0.0, 0.0]\ndy = [0.0, -1.0, 0.0]\n";

/// A scene of one mesh, piece by piece as text.
#[derive(Clone)]
struct Setup {
    /// Size and camera.
    view: String,
    obj: String,
    /// Keys of the material.
    material: String,
    /// Further keys of the mesh.
    mesh: String,
    switches: String,
    /// Tables `[[light]]`.
    lights: String,
}

impl Setup {
    /// White and matte, seen from (0, 0, 8).
    fn plate(normal: V3) -> Self {
        Self::of(view([0.0, 0.0, 8.0], [0.0, 0.0, -8.0]), plate(normal))
    }

    fn of(view: String, obj: String) -> Self {
        Self {
            view,
            obj,
            material: "kd = [1, 1, 1]\nka = [0, 0, 0]\n".to_owned(),
            mesh: String::new(),
            switches: String::new(),
            lights: String::new(),
        }
    }

    /// No diffuse part, ks = 1.
    fn glossy(mut self, ns: f64) -> Self {
        self.material = format!("kd = [0, 0, 0]\nka = [0, 0, 0]\nks = [1, 1, 1]\nns = {ns:?}\n");
        self
    }

    fn lit(mut self, light: &str) -> Self {
        self.lights += &format!("[[light]]\n{light}\n");
        self
    }

    fn switched(mut self, switches: &str) -> Self {
        self.switches = switches.to_owned();
        self
    }

    fn seen(mut self, view: String) -> Self {
        self.view = view;
        self
    }

    fn meshed(mut self, mesh: &str) -> Self {
        self.mesh = mesh.to_owned();
        self
    }

    #[track_caller]
    fn scene(&self) -> Scene {
        let Self { view, obj, material, mesh, switches, lights } = self;
        let text = format!(
            "version = 1\n[image]\n{view}[switches]\n{switches}\n[[material]]\nname = \"m\"\n\
             {material}[[mesh]]\nfile = \"mesh.obj\"\nmaterial = \"m\"\n{mesh}{lights}"
        );
        load(&text, obj)
    }

    #[track_caller]
    fn shaded(&self) -> Shaded {
        shaded(&self.scene())
    }

    /// The red channel of the only pixel.
    #[track_caller]
    fn value(&self) -> f64 {
        let radiance = self.shaded().radiance;
        assert_eq!(radiance.len(), 1);
        radiance[0][0]
    }
}

#[track_caller]
fn load(text: &str, obj: &str) -> Scene {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("mesh.obj"), obj).unwrap();
    Scene::from_toml(text, Path::new("stable.toml"), folder.path(), &Overrides::default())
        .unwrap_or_else(|errors| panic!("{errors}\n{text}"))
}

/// What the caster sees; the plate must be there.
#[track_caller]
fn visible(scene: &Scene) -> VisibilityBuffer {
    let window = scene.camera.resolution().window();
    let preset = BuildPreset::Medium;
    let seen =
        see(scene, VisibilityPath::Cast, preset, window, Counting::Nearest, &Unwatched).buffer;
    assert!(seen.covered_pixels() > 0, "nothing is visible");
    seen
}

#[track_caller]
fn shaded(scene: &Scene) -> Shaded {
    shade::shade(scene, &visible(scene), Effects::of(scene), &|| ())
}

/// One pixel whose ray goes from `eye` along `direction`.
fn view(eye: V3, direction: V3) -> String {
    // Two steps that span the plane across the largest component, a power of two long.
    let largest = direction.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
    let along = direction.iter().position(|c| c.abs() == largest).unwrap();
    let step = 2.0_f64.powi(largest.log2().floor() as i32 - 2);
    let axis = |k: usize| -> V3 { std::array::from_fn(|i| if i == k % 3 { step } else { 0.0 }) };
    let (dx, dy) = (axis(along + 1), axis(along + 2));
    let d0: V3 = std::array::from_fn(|k| direction[k] - 0.5 * dx[k] - 0.5 * dy[k]);
    format!(
        "width = 1\nheight = 1\n[camera.exact]\neye = {eye:?}\nd0 = {d0:?}\ndx = {dx:?}\n\
         dy = {dy:?}\n"
    )
}

/// The view against `to_eye` from 8 lengths away, through the origin.
fn view_from(to_eye: V3) -> String {
    view(to_eye.map(|c| 8.0 * c), to_eye.map(|c| -8.0 * c))
}

/// A triangle in z = 0 with the origin inside, the same normal at each corner.
fn plate([x, y, z]: V3) -> String {
    format!("v -6 -5 0\nv 6 -5 0\nv 0 7 0\nvn {x:?} {y:?} {z:?}\nf 1//1 2//1 3//1\n")
}

fn directional(to_light: V3) -> String {
    let aim = to_light.map(|c| -c);
    format!("type = \"directional\"\naim = {aim:?}\nintensity = [1, 1, 1]\n")
}

fn point(position: V3, attenuation: V3) -> String {
    format!(
        "type = \"point\"\nposition = {position:?}\nattenuation = {attenuation:?}\n\
         intensity = [1, 1, 1]\n"
    )
}

/// A direction in the plane y = 0 at an angle from z, radians.
fn tilted(angle: f64) -> V3 {
    [angle.sin(), 0.0, angle.cos()]
}

#[track_caller]
fn assert_near(value: f64, right: f64, tolerance: f64) {
    let is_near = (value - right).abs() <= tolerance * right.abs();
    assert!(is_near, "{value:e} instead of {right:e}: off by {:e}", (value / right - 1.0).abs());
}

#[test]
fn every_name_has_its_test() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/it/stable");
    let mut text = String::new();
    for entry in fs::read_dir(folder).unwrap() {
        text += &fs::read_to_string(entry.unwrap().path()).unwrap();
    }
    for number in 1..=35 {
        let start = format!("#[test]\nfn s{number:02}_");
        assert_eq!(text.matches(&start).count(), 1, "S{number:02}");
    }
}
