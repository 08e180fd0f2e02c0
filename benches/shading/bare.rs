//! What the machine can do: the equation under four spotlights as a bare loop over 16 lanes of f32.
//!
//! Attributes are interpolated (position and normal are linear over the image of a triangle that
//! stands square to the view), every light has a cone, a falloff with an exponent, attenuation by
//! distance and a Blinn-Phong highlight of a general exponent. Fused operations, powers good to f32,
//! no branch, nothing read but the lights, three planes of f32 written. None of the program's care
//! is here, so its values drift from the right ones by f32's rounding times the exponents.

use fearless_simd::prelude::*;
use fearless_simd::{dispatch, f32x16, i32x16, mask32x16};
use std::path::Path;
use truecast::mesh::TriangleMesh;
use truecast::pixel::Resolution;
use truecast::scene::light::Light;
use truecast::scene::{Overrides, Scene};
use truecast::simd::SimdLevel;

/// Largest difference of radiance that is rounding: values of about 1, of some 30 operations of
/// 2^-24 each, in powers of up to 27.9 (C2 of a cosine near 1), under four lights: 30·28·4·2^-24.
pub(crate) const ERROR: f64 = 2e-4;

const HEAD: &str = "version = 1\n[image]\nwidth = 16\nheight = 9\n\
    [camera]\neye = [0, 0, 4]\ntarget = [0, 0, 0]\nup = [0, 1, 0]\nfov_y_deg = 45\n\
    [[material]]\nname = \"m\"\nka = [0.2, 0.1, 0.05]\nkd = [0.62, 0.42, 0.1]\nks = [0.95, 0.86, 0.66]\n\
    ns = 27.9\n";

const LIGHTS: [&str; 4] = [
    "position = [2.5, 1.5, 4.5]\nintensity = [0.5, 0.45, 0.4]\nexponent = 6.5",
    "position = [-2.5, 1.5, 4.0]\nintensity = [0.3, 0.35, 0.5]\nexponent = 3.25",
    "position = [2.0, -1.5, 5.0]\nintensity = [0.4, 0.2, 0.3]\nexponent = 11.5",
    "position = [-1.5, -1.0, 3.5]\nintensity = [0.25, 0.3, 0.25]\nexponent = 2.75",
];

fn scene(meshes: &str, width: u32, height: u32) -> Scene {
    let lights: String = LIGHTS
        .iter()
        .map(|light| {
            format!(
                "[[light]]\ntype = \"spot\"\ntarget = [0, 0, 0]\ncutoff_deg = 70\n\
                 attenuation = [0.5, 0.1, 0.02]\n{light}\n"
            )
        })
        .collect();
    let text = format!("{HEAD}{meshes}{lights}");
    let overrides =
        Overrides { resolution: Resolution::new(width, height), ..Overrides::default() };
    Scene::from_toml(&text, Path::new("bench"), Path::new("."), &overrides)
        .unwrap_or_else(|errors| panic!("{errors}"))
}

/// One triangle that fills the picture, with a normal of its own at each corner.
pub(crate) fn one_triangle(width: u32, height: u32) -> Scene {
    let mut one = scene("[[mesh]]\nshape = { plane = {} }\nmaterial = \"m\"\n", width, height);
    one.mesh = TriangleMesh {
        positions: vec![[-12.0, -6.0, 0.0], [12.0, -6.0, 0.0], [0.0, 12.0, 0.0]],
        corners: vec![[0, 1, 2]],
        normals: vec![unit([-0.5, -0.3, 1.0]), unit([0.5, -0.3, 1.0]), unit([0.0, 0.6, 1.0])],
        corner_normals: vec![[0, 1, 2]],
        ..TriangleMesh::default()
    };
    one.triangle_materials.truncate(1);
    one.objects[0].triangles = 0..1;
    one
}

/// A torus of 40 000 triangles in front of the eye.
pub(crate) fn torus(width: u32, height: u32) -> Scene {
    let shape = "torus = { major = 1.1, minor = 0.5, around = 200, across = 100 }";
    let mesh = format!(
        "[[mesh]]\nshape = {{ {shape} }}\nmaterial = \"m\"\nrotate_deg = [65, 0, 0]\nscale = 1.2\n"
    );
    scene(&mesh, width, height)
}

/// A spotlight in f32.
struct Spot {
    position: [f32; 3],
    axis: [f32; 3],
    cosine: f32,
    exponent: f32,
    attenuation: [f32; 3],
    diffuse: [f32; 3],
    specular: [f32; 3],
}

/// Position and normal at the image point (0, 0), and their steps per column and per row.
struct Attributes {
    position: [[f32; 3]; 3],
    normal: [[f32; 3]; 3],
}

/// The radiance of the scene of [`one_triangle`], plane by plane.
pub(crate) fn shade(scene: &Scene, level: SimdLevel, planes: &mut [Vec<f32>; 3]) {
    let material = &scene.materials[0];
    let narrow = |v: [f64; 3]| v.map(|c| c as f32);
    let product = |a: [f64; 3], b: [f64; 3]| narrow([a[0] * b[0], a[1] * b[1], a[2] * b[2]]);
    let spots: Vec<Spot> = scene
        .lights
        .iter()
        .filter_map(|light| match light {
            Light::Spot(spot) => Some(Spot {
                position: narrow(spot.position),
                axis: narrow(spot.aim.map(|c| -c)),
                cosine: spot.cutoff_deg.to_radians().cos() as f32,
                exponent: spot.exponent as f32,
                attenuation: narrow(spot.attenuation),
                diffuse: product(material.kd, spot.colors.diffuse),
                specular: product(material.ks, spot.colors.specular),
            }),
            _ => None,
        })
        .collect();
    let attributes = attributes(scene);
    let eye = narrow(scene.camera.eye());
    let size = scene.camera.resolution();
    let width = size.width() as usize;
    let exponent = material.ns as f32;
    dispatch!(level.dispatched(), simd =>
        fill(simd, (&spots, &attributes, eye, exponent), width, planes));
}

fn attributes(scene: &Scene) -> Attributes {
    let camera = &scene.camera;
    let (eye, d0, dx, dy) = (camera.eye(), camera.d0(), camera.dx(), camera.dy());
    let t = -eye[2] / d0[2];
    let point = |x: f64, y: f64| [0, 1, 2].map(|k| eye[k] + t * (d0[k] + x * dx[k] + y * dy[k]));
    let [a, b, c] = [0, 1, 2].map(|i| scene.mesh.positions[i].map(f64::from));
    let across = |u: [f64; 3], v: [f64; 3], p: [f64; 3]| {
        (v[0] - u[0]) * (p[1] - u[1]) - (v[1] - u[1]) * (p[0] - u[0])
    };
    let normal = |p: [f64; 3]| {
        let weights = [across(b, c, p), across(c, a, p), across(a, b, p)];
        let sum: f64 = weights.iter().sum();
        [0, 1, 2].map(|k| {
            let parts = weights.iter().zip(&scene.mesh.normals).map(|(w, n)| w / sum * n[k]);
            parts.sum::<f64>()
        })
    };
    let steps = |of: &dyn Fn(f64, f64) -> [f64; 3]| {
        let (here, right, down) = (of(0.0, 0.0), of(1e3, 0.0), of(0.0, 1e3));
        let step = |to: [f64; 3]| [0, 1, 2].map(|k| ((to[k] - here[k]) * 1e-3) as f32);
        [here.map(|c| c as f32), step(right), step(down)]
    };
    Attributes { position: steps(&point), normal: steps(&|x, y| normal(point(x, y))) }
}

#[inline(always)]
fn fill<S: Simd>(
    simd: S,
    (spots, attributes, eye, exponent): (&[Spot], &Attributes, [f32; 3], f32),
    width: usize,
    planes: &mut [Vec<f32>; 3],
) {
    let rows = planes[0].len() / width;
    let lane: [f32; 16] = std::array::from_fn(|lane| lane as f32 + 0.5);
    let lane = f32x16::load_array(simd, lane);
    for row in 0..rows {
        let y = row as f32 + 0.5;
        let base = |[at, _, down]: &[[f32; 3]; 3]| [0, 1, 2].map(|k| at[k] + y * down[k]);
        let (position, normal) = (base(&attributes.position), base(&attributes.normal));
        for column in (0..width).step_by(16) {
            let x = lane + column as f32;
            let p = along(simd, position, attributes.position[1], x);
            let n = normalized(simd, along(simd, normal, attributes.normal[1], x));
            let eye = [base_of(simd, eye[0]), base_of(simd, eye[1]), base_of(simd, eye[2])];
            let v = normalized(simd, [eye[0] - p[0], eye[1] - p[1], eye[2] - p[2]]);
            let mut rgb = [base_of(simd, 0.0); 3];
            for spot in spots {
                add_spot(simd, spot, exponent, [p, n, v], &mut rgb);
            }
            let at = row * width + column;
            for (plane, value) in planes.iter_mut().zip(rgb) {
                value.store_slice(&mut plane[at..at + 16]);
            }
        }
    }
}

type Lanes<S> = f32x16<S>;

#[inline(always)]
fn along<S: Simd>(simd: S, base: [f32; 3], right: [f32; 3], x: Lanes<S>) -> [Lanes<S>; 3] {
    let of = |value: f32| base_of(simd, value);
    [
        x.mul_add(of(right[0]), of(base[0])),
        x.mul_add(of(right[1]), of(base[1])),
        x.mul_add(of(right[2]), of(base[2])),
    ]
}

#[inline(always)]
fn base_of<S: Simd>(simd: S, value: f32) -> Lanes<S> {
    f32x16::splat(simd, value)
}

#[inline(always)]
fn dot<S: Simd>(a: [Lanes<S>; 3], b: [Lanes<S>; 3]) -> Lanes<S> {
    a[0].mul_add(b[0], a[1].mul_add(b[1], a[2] * b[2]))
}

#[inline(always)]
fn normalized<S: Simd>(simd: S, a: [Lanes<S>; 3]) -> [Lanes<S>; 3] {
    let inverse = base_of(simd, 1.0) / dot(a, a).sqrt();
    [a[0] * inverse, a[1] * inverse, a[2] * inverse]
}

#[inline(always)]
fn add_spot<S: Simd>(
    simd: S,
    spot: &Spot,
    exponent: f32,
    [p, n, v]: [[Lanes<S>; 3]; 3],
    rgb: &mut [Lanes<S>; 3],
) {
    let of = |value: f32| base_of(simd, value);
    let way =
        [of(spot.position[0]) - p[0], of(spot.position[1]) - p[1], of(spot.position[2]) - p[2]];
    let squared = dot(way, way);
    let inverse = of(1.0) / squared.sqrt();
    let distance = squared * inverse;
    let l = [way[0] * inverse, way[1] * inverse, way[2] * inverse];
    let n_dot_l = dot(n, l);
    let l_dot_s = dot(l, [of(spot.axis[0]), of(spot.axis[1]), of(spot.axis[2])]);
    let lit: mask32x16<S> = n_dot_l.simd_gt(0.0) & l_dot_s.simd_ge(spot.cosine);
    let [a, b, c] = spot.attenuation;
    let (a, b, c) = (of(a), of(b), of(c));
    let denominator = distance.mul_add(distance.mul_add(c, b), a);
    let factor = power(simd, l_dot_s, spot.exponent) / denominator;
    let factor = lit.select(factor, of(0.0));
    let h = normalized(simd, [l[0] + v[0], l[1] + v[1], l[2] + v[2]]);
    let highlight = power(simd, dot(n, h), exponent) * factor;
    let matte = n_dot_l * factor;
    let [dr, dg, db] = spot.diffuse;
    let [sr, sg, sb] = spot.specular;
    *rgb = [
        highlight.mul_add(of(sr), matte.mul_add(of(dr), rgb[0])),
        highlight.mul_add(of(sg), matte.mul_add(of(dg), rgb[1])),
        highlight.mul_add(of(sb), matte.mul_add(of(db), rgb[2])),
    ];
}

/// log2(1 + f)/f on √½ … √2, and 2^r on −½ … ½, each to 2·10^-7.
const LOGARITHM: [f32; 8] = [
    std::f32::consts::LOG2_E,
    -0.721_352_9,
    0.480_916_7,
    -0.360_225_2,
    0.287_288_9,
    -0.249_271_8,
    0.232_652_6,
    -0.142_759_7,
];
const POWER: [f32; 6] =
    [1.0, std::f32::consts::LN_2, 0.240_223_5, 0.055_503_8, 0.009_666_39, 0.001_338_132];

/// x^e for x in 0…1, good to about e·2^-22.
#[inline(always)]
fn power<S: Simd>(simd: S, x: Lanes<S>, e: f32) -> Lanes<S> {
    let of = |value: f32| base_of(simd, value);
    let x = x.max(of(f32::MIN_POSITIVE));
    let bits: i32x16<S> = x.bitcast();
    let above = (bits - i32x16::splat(simd, 0x3f35_04f3)) >> 23_u32;
    let f: Lanes<S> = (bits - (above << 23_u32)).bitcast();
    let f = f - 1.0;
    let whole: Lanes<S> = above.to_float();
    let [c0, c1, c2, c3, c4, c5, c6, c7] = LOGARITHM;
    let log = f.mul_add(of(c7), of(c6)).mul_add(f, of(c5)).mul_add(f, of(c4)).mul_add(f, of(c3));
    let log = log.mul_add(f, of(c2)).mul_add(f, of(c1)).mul_add(f, of(c0));
    let t = (log.mul_add(f, whole) * e).max(of(-126.0));
    let rounded = t.round_ties_even();
    let r = t - rounded;
    let [c0, c1, c2, c3, c4, c5] = POWER;
    let fraction = r.mul_add(of(c5), of(c4)).mul_add(r, of(c3)).mul_add(r, of(c2));
    let fraction = fraction.mul_add(r, of(c1)).mul_add(r, of(c0));
    let bits: i32x16<S> = fraction.bitcast();
    let whole: i32x16<S> = rounded.to_int();
    (bits + (whole << 23_u32)).bitcast()
}

fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    v.map(|c| c / length)
}
