//! parry3d: its tree and its traversal, with obvhs' triangle test, which is faster than its own.

use super::obvhs::ray;
use super::rays::Rays;
use crate::bench::workload::{Answer, Variant, Work};
use crate::mesh::TriangleMesh;
use obvhs::rt_triangle::RtTriangle;
use parry3d::bounding_volume::Aabb;
use parry3d::math::Vector;
use parry3d::partitioning::{Bvh, BvhBuildStrategy};
use parry3d::query::Ray;

/// The name of its variant.
pub(super) const NAME: &str = "parry3d";

/// A tree and its triangles by id.
pub(super) struct Tree {
    tree: Bvh,
    triangles: Vec<RtTriangle>,
}

fn vector([x, y, z]: [f32; 3]) -> Vector {
    Vector::new(x, y, z)
}

impl Tree {
    pub(super) fn new(mesh: &TriangleMesh) -> Self {
        let bounds = |id| Aabb::from_points(mesh.triangle(id).map(vector));
        let boxes = mesh.ids().map(|id| (id.index(), bounds(id)));
        let tree = Bvh::from_iter(BvhBuildStrategy::Binned, boxes);
        let test = |[a, b, c]: [[f32; 3]; 3]| RtTriangle::new(a.into(), b.into(), c.into());
        Self { tree, triangles: mesh.ids().map(|id| test(mesh.triangle(id))).collect() }
    }

    pub(super) fn variant<'a>(&'a self, rays: &'a Rays) -> Variant<'a> {
        let hits = rays.hits();
        let closest = move || {
            rays.cast_each(&hits, |direction| {
                let boxes = Ray::new(vector(rays.origin), vector(direction));
                let ray = ray(rays.origin, direction);
                let test = |id: u32, _| Some(self.triangles[id as usize].intersect(&ray));
                self.tree.cast_ray(&boxes, f32::MAX, test).filter(|&(_, t)| t < f32::MAX)
            });
            Answer::Hits(hits.clone())
        };
        Variant::new(NAME, Work::Closest, rays.len(), closest).of("parry3d 0.31")
    }
}
