//! Shadows by brute force: every triangle against the segment from the surface point to a light.
//!
//! S is the visible triangle, n its normal, V and D = n·d as in [`super::contact`]; the surface
//! point is x = e + (V/D)·d. For the plane with normal N through p,
//! N·(x − p)·D = g·d with g = (N·(e − p))·n + V·N, so the side of x, moved with the sample by
//! (+ε, +ε²) inside the plane of S, is the first nonzero sign of g·d, g·DX, g·DY, times sgn V. A
//! triangle other than S occludes iff
//! - the light is on a side τ ≠ 0 of its plane: n_T·(l − v_0), or n_T·l for a direction l;
//! - the surface point is on side −τ of its plane;
//! - and on side −τ of the plane through the light and each edge (v_j, v_k), of normal
//!   (v_j − l) × (v_k − l), or (v_k − v_j) × l for a direction.
//!
//! The only shortcut is again an interval test that throws out what is certain not to occlude
//! (`discard`); [`Shadows::occluders_among`] goes without it.

mod discard;

use super::Arbiter;
use super::contact::Ray;
use super::rational::{Vector, add, bounds_f64, cross, dot, exact_vector, scale, sign, subtract};
use crate::mesh::TriangleId;
use crate::pixel::Pixel;
use crate::scene::Scene;
use crate::scene::light_point::LightPoint;
use dashu_ratio::Relaxed;
use discard::Screens;

/// Answers exactly which triangles stand between surface points and one light.
pub struct Shadows<'a> {
    scene: &'a Scene,
    light: Light,
    screens: Screens,
}

/// A light in rationals.
struct Light {
    point: Vector,
    is_position: bool,
}

/// The surface point of a visible triangle at a sample.
struct SurfacePoint {
    ray: Ray,
    normal: Vector,
    volume: Relaxed,
    /// x.
    position: Vector,
}

impl<'a> Shadows<'a> {
    /// Prepares the interval test for a light: about 2 µs and 216 bytes per triangle. Triangles in
    /// whose plane the light lies are dropped here; they cast no shadow.
    pub fn new(scene: &'a Scene, light: LightPoint) -> Self {
        Self { scene, light: Light::new(light), screens: Screens::of(&scene.mesh, light) }
    }

    /// All triangles that cross the open segment from the surface point of `visible` at the sample
    /// of `pixel` to the light and for which `opaque` holds, in the order of ids.
    ///
    /// # Panics
    /// When `visible` is seen edge-on: it is never visible.
    pub fn occluders(
        &self,
        pixel: Pixel,
        visible: TriangleId,
        opaque: impl Fn(TriangleId) -> bool,
    ) -> Vec<TriangleId> {
        let at = SurfacePoint::new(self.scene, pixel, visible);
        let bounds = at.position.each_ref().map(bounds_f64);
        self.filtered(&at, visible, self.screens.near(bounds).into_iter(), opaque)
    }

    /// As [`Self::occluders`], of these triangles only; every one is evaluated exactly.
    pub fn occluders_among(
        &self,
        triangles: &[TriangleId],
        pixel: Pixel,
        visible: TriangleId,
        opaque: impl Fn(TriangleId) -> bool,
    ) -> Vec<TriangleId> {
        let at = SurfacePoint::new(self.scene, pixel, visible);
        self.filtered(&at, visible, triangles.iter().copied(), opaque)
    }

    fn filtered(
        &self,
        at: &SurfacePoint,
        visible: TriangleId,
        triangles: impl Iterator<Item = TriangleId>,
        opaque: impl Fn(TriangleId) -> bool,
    ) -> Vec<TriangleId> {
        triangles.filter(|&id| id != visible && opaque(id) && self.crosses(at, id)).collect()
    }

    /// Whether a triangle crosses the segment, straight from the definition.
    fn crosses(&self, at: &SurfacePoint, id: TriangleId) -> bool {
        let v = self.scene.mesh.triangle(id).map(|v| exact_vector(v.map(f64::from)));
        let n = cross(&subtract(&v[1], &v[0]), &subtract(&v[2], &v[0]));
        let tau = self.light.side(&n, &v[0]);
        tau != 0
            && at.side(&n, &v[0]) == -tau
            && [(0, 1), (1, 2), (2, 0)]
                .iter()
                .all(|&(j, k)| at.side(&self.light.edge_plane(&v[j], &v[k]), &v[j]) == -tau)
    }
}

impl Arbiter<'_> {
    /// Whether an opaque triangle stands between what is visible at a pixel and the light; `None`
    /// where nothing is visible. Every triangle of the scene is evaluated exactly: for single pixels.
    pub fn is_shadowed(
        &self,
        pixel: Pixel,
        light: LightPoint,
        opaque: impl Fn(TriangleId) -> bool,
    ) -> Option<bool> {
        let visible = self.answer(pixel).visible?.triangle;
        let at = SurfacePoint::new(self.scene, pixel, visible);
        let shadows =
            Shadows { scene: self.scene, light: Light::new(light), screens: Screens::default() };
        Some(
            self.scene.mesh.ids().any(|id| id != visible && opaque(id) && shadows.crosses(&at, id)),
        )
    }
}

impl Light {
    fn new(light: LightPoint) -> Self {
        match light {
            LightPoint::Position(l) => Self { point: exact_vector(l), is_position: true },
            LightPoint::Direction(l) => Self { point: exact_vector(l), is_position: false },
        }
    }

    /// The side of the light against the plane of normal `n` through `p`.
    fn side(&self, n: &Vector, p: &Vector) -> i8 {
        if self.is_position {
            sign(&dot(n, &subtract(&self.point, p)))
        } else {
            sign(&dot(n, &self.point))
        }
    }

    /// The normal of the plane through the light and the edge from `a` to `b`.
    fn edge_plane(&self, a: &Vector, b: &Vector) -> Vector {
        if self.is_position {
            cross(&subtract(a, &self.point), &subtract(b, &self.point))
        } else {
            cross(&subtract(b, a), &self.point)
        }
    }
}

impl SurfacePoint {
    fn new(scene: &Scene, pixel: Pixel, visible: TriangleId) -> Self {
        let ray = Ray::through(&scene.camera, pixel.sample());
        let v = scene.mesh.triangle(visible).map(|v| exact_vector(v.map(f64::from)));
        let normal = cross(&subtract(&v[1], &v[0]), &subtract(&v[2], &v[0]));
        let volume = dot(&normal, &subtract(&v[0], ray.eye()));
        let speed = dot(&normal, ray.direction());
        assert!(sign(&speed) != 0, "triangle {} is seen edge-on", visible.get());
        let t = &volume / speed;
        let position = add(ray.eye(), &scale(ray.direction(), &t));
        Self { ray, normal, volume, position }
    }

    /// The side of the moved surface point against the plane of normal `n` through `p`.
    fn side(&self, n: &Vector, p: &Vector) -> i8 {
        let height = dot(n, &subtract(self.ray.eye(), p));
        let g = add(&scale(&self.normal, &height), &scale(n, &self.volume));
        self.ray.moved_sign(&g) * sign(&self.volume)
    }
}
