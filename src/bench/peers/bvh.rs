//! The crate bvh: its tree and its traversal, with obvhs' triangle test, which is faster than its
//! own and does not drop back faces.
//!
//! Its plain iterator does not know the nearest hit so far, so every box that a ray crosses is
//! visited; the one in order of distance can stop at the first box behind it, but sorts.

use super::obvhs::ray;
use super::rays::Rays;
use crate::bench::workload::{Answer, Variant, Work};
use crate::mesh::TriangleMesh;
use ::bvh::aabb::{Aabb, Bounded};
use ::bvh::bounding_hierarchy::{BHShape, BoundingHierarchy};
use ::bvh::bvh::Bvh;
use ::bvh::ray::Ray;
use obvhs::rt_triangle::RtTriangle;

/// The name of its variant.
pub(super) const NAME: &str = "bvh";

/// A tree and its triangles.
pub(super) struct Tree {
    tree: Bvh<f32, 3>,
    triangles: Vec<Boxed>,
}

/// A triangle as the crate wants it.
struct Boxed {
    triangle: RtTriangle,
    bounds: Aabb<f32, 3>,
    id: u32,
    node: usize,
}

impl Bounded<f32, 3> for Boxed {
    fn aabb(&self) -> Aabb<f32, 3> {
        self.bounds
    }
}

impl BHShape<f32, 3> for Boxed {
    fn set_bh_node_index(&mut self, node: usize) {
        self.node = node;
    }

    fn bh_node_index(&self) -> usize {
        self.node
    }
}

impl Tree {
    pub(super) fn new(mesh: &TriangleMesh) -> Self {
        let boxed = |id: crate::mesh::TriangleId| {
            let [a, b, c] = mesh.triangle(id);
            let low: [f32; 3] = std::array::from_fn(|k| a[k].min(b[k]).min(c[k]));
            let high: [f32; 3] = std::array::from_fn(|k| a[k].max(b[k]).max(c[k]));
            Boxed {
                triangle: RtTriangle::new(a.into(), b.into(), c.into()),
                bounds: Aabb::with_bounds(low.into(), high.into()),
                id: id.get(),
                node: 0,
            }
        };
        let mut triangles: Vec<Boxed> = mesh.ids().map(boxed).collect();
        let tree = Bvh::build_par(&mut triangles);
        Self { tree, triangles }
    }

    pub(super) fn variant<'a>(&'a self, rays: &'a Rays) -> Variant<'a> {
        let hits = rays.hits();
        let closest = move || {
            rays.cast_each(&hits, |direction| {
                let boxes = Ray::new(rays.origin.into(), direction.into());
                let ray = ray(rays.origin, direction);
                let mut nearest: Option<(u32, f32)> = None;
                for found in self.tree.traverse_iterator(&boxes, &self.triangles) {
                    let t = found.triangle.intersect(&ray);
                    if t < nearest.map_or(f32::INFINITY, |(_, t)| t) {
                        nearest = Some((found.id, t));
                    }
                }
                nearest
            });
            Answer::Hits(hits.clone())
        };
        Variant::new(NAME, Work::Closest, rays.len(), closest).of("bvh 0.13")
    }
}
