//! The caster as others build it: without bounds, to be compared with the exact one.
//!
//! - `Fast`: the kernel of the tiles, f32 rows and all, with nothing that makes it certain.
//! - `Double`: T. Möller, B. Trumbore, *Fast, minimum storage ray-triangle intersection*, 1997, in
//!   f64, ray by ray.
//! - `Watertight`: S. Woop, C. Benthin, I. Wald, *Watertight ray/triangle intersection*, 2013: f32,
//!   with f64 where an edge function is 0, ray by ray.
//!
//! None promises anything: edges are inclusive, and of equal depths the first that is met wins. The
//! walk through the tree is the conservative one, so that what is missed, a triangle test missed.

use super::memo::{PicturePairs, SamePlane};
use super::nearest;
use super::ray::{Ray, View};
use super::strips::{STRIPS_AT_ONCE, strips};
use super::tile::{self, Frame, Memory, NOTHING, SIDE, Work};
use crate::accel::{Accelerator, Pending, Slabs};
use crate::pixel::{Pixel, Window};
use crate::scene::Scene;
use crate::simd::SimdLevel;
use crate::visibility::{Level, LevelCounts, NearestBuffer};
use rayon::prelude::*;

/// A caster without proof.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unproven {
    /// f64 without bounds.
    Double,
    /// f32 without holes between neighbours.
    Watertight,
    /// f32 without bounds, tile by tile.
    Fast,
}

impl Unproven {
    /// All of them, the slowest first.
    pub const ALL: [Self; 3] = [Self::Double, Self::Watertight, Self::Fast];

    /// The name: `double`, `watertight` or `fast`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Double => "double",
            Self::Watertight => "watertight",
            Self::Fast => "fast",
        }
    }

    /// The arithmetic that decides nearly all samples.
    pub const fn level(self) -> Level {
        match self {
            Self::Double => Level::Double,
            Self::Watertight | Self::Fast => Level::Single,
        }
    }
}

/// What an unproven caster takes for the nearest triangle at every pixel of a window, with
/// `accelerator` built over the scene's mesh. Nothing is promised of ids or t: at samples that f32
/// leaves in doubt they may depend on the tree, the tiles and the instruction set. `done` is called
/// once per finished tile of 32 × 32 pixels, from any thread.
pub fn cast_unproven(
    scene: &Scene,
    accelerator: &Accelerator,
    window: Window,
    unproven: Unproven,
    simd: SimdLevel,
    done: &(dyn Fn() + Sync),
) -> NearestBuffer {
    let mut buffer = NearestBuffer {
        window,
        ids: vec![NOTHING; window.len()],
        t: vec![f32::INFINITY; window.len()],
        levels: LevelCounts::default(),
    };
    cast_unproven_into(scene, accelerator, unproven, simd, &mut buffer, done);
    buffer
}

/// As [`cast_unproven`], into a buffer that there is already: all of it is written.
pub fn cast_unproven_into(
    scene: &Scene,
    accelerator: &Accelerator,
    unproven: Unproven,
    simd: SimdLevel,
    buffer: &mut NearestBuffer,
    done: &(dyn Fn() + Sync),
) {
    let frame = Frame::new(scene, accelerator);
    let pairs = PicturePairs::default();
    let ids = strips(buffer.window, &mut buffer.ids);
    let t = strips(buffer.window, &mut buffer.t);
    ids.into_par_iter().zip(t).with_max_len(STRIPS_AT_ONCE).for_each_init(
        Work::new,
        |work, ((strip, mut ids), (_, mut t))| {
            if unproven == Unproven::Fast {
                let mut memory =
                    Memory { same_plane: SamePlane::new(&pairs), levels: LevelCounts::default() };
                for window in strip.tiles(SIDE as u32) {
                    let samples = tile::cast_tile::<false>(&frame, window, simd, work, &mut memory);
                    nearest::write(window, strip, samples, &mut ids, &mut t);
                    done();
                }
                return;
            }
            let mut pending = Pending::new(simd);
            for (y, (ids, t)) in ids.into_iter().zip(t).enumerate() {
                for (x, (id, t)) in ids.iter_mut().zip(t).enumerate() {
                    let pixel = Pixel { x: strip.x0() + x as u32, y: strip.y0() + y as u32 };
                    (*id, *t) = cast_ray(&frame.view, accelerator, &mut pending, pixel, unproven);
                }
            }
            strip.tiles(SIDE as u32).iter().for_each(|_| done());
        },
    );
    buffer.levels = LevelCounts::default();
}

/// One ray's nearest hit: id and the camera's t.
fn cast_ray(
    view: &View,
    accelerator: &Accelerator,
    pending: &mut Pending,
    pixel: Pixel,
    unproven: Unproven,
) -> (u32, f32) {
    let ray = view.ray(pixel);
    let woop = Woop::new(&ray);
    let mut nearest = (NOTHING, f64::INFINITY);
    accelerator.traverse(&Slabs::new(ray.eye, ray.direction()), pending, |triangles| {
        for triangle in triangles {
            let t = match unproven {
                Unproven::Watertight => woop.meet(&triangle.vertices),
                _ => moeller_trumbore(&ray, &triangle.vertices),
            };
            if let Some(t) = t.filter(|&t| t < nearest.1) {
                nearest = (triangle.id.get(), t);
            }
        }
        nearest.1
    });
    (nearest.0, view.camera_t(nearest.1) as f32)
}

/// t of a hit, in f64.
fn moeller_trumbore(ray: &Ray, vertices: &[[f32; 3]; 3]) -> Option<f64> {
    let [v0, v1, v2] = vertices.map(|v| v.map(f64::from));
    let (e1, e2) = (minus(v1, v0), minus(v2, v0));
    let p = cross(ray.direction(), e2);
    let determinant = dot(e1, p);
    let s = minus(ray.eye, v0);
    let u = dot(s, p) / determinant;
    let q = cross(s, e1);
    let v = dot(ray.direction(), q) / determinant;
    let t = dot(e2, q) / determinant;
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0).then_some(t)
}

/// A ray sheared so that it runs along an axis, in f32.
struct Woop {
    axes: [usize; 3],
    eye: [f32; 3],
    shear: [f32; 3],
}

impl Woop {
    fn new(ray: &Ray) -> Self {
        let d = ray.direction().map(|c| c as f32);
        let mut z = if d[1].abs() > d[0].abs() { 1 } else { 0 };
        if d[2].abs() > d[z].abs() {
            z = 2;
        }
        let axes = [(z + 1) % 3, (z + 2) % 3, z];
        let shear = [d[axes[0]] / d[z], d[axes[1]] / d[z], 1.0 / d[z]];
        Self { axes, eye: ray.eye.map(|c| c as f32), shear }
    }

    /// t of a hit.
    fn meet(&self, vertices: &[[f32; 3]; 3]) -> Option<f64> {
        let [kx, ky, kz] = self.axes;
        let a = vertices.map(|v| -> [f32; 3] { std::array::from_fn(|k| v[k] - self.eye[k]) });
        let x = a.map(|v| v[kx] - self.shear[0] * v[kz]);
        let y = a.map(|v| v[ky] - self.shear[1] * v[kz]);
        let mut w: [f32; 3] = std::array::from_fn(|i| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            x[k] * y[j] - y[k] * x[j]
        });
        if w.contains(&0.0) {
            w = std::array::from_fn(|i| {
                let (j, k) = ((i + 1) % 3, (i + 2) % 3);
                let product = |a: f32, b: f32| f64::from(a) * f64::from(b);
                (product(x[k], y[j]) - product(y[k], x[j])) as f32
            });
        }
        if w.iter().any(|&w| w < 0.0) && w.iter().any(|&w| w > 0.0) {
            return None;
        }
        let determinant = w[0] + w[1] + w[2];
        let t = (w[0] * a[0][kz] + w[1] * a[1][kz] + w[2] * a[2][kz]) * self.shear[2] / determinant;
        (determinant != 0.0 && t > 0.0).then_some(f64::from(t))
    }
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| a[k] - b[k])
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2]
}
