//! obvhs: its own traversal of its own trees, with its own triangle test.
//!
//! The same crate builds the topology of our tree; here it also walks and decides, as its examples
//! do: f32 Möller–Trumbore, triangles copied in the order of the leaves.

use super::rays::Rays;
use crate::bench::workload::{Answer, Variant, Work};
use crate::mesh::TriangleMesh;
use glam::Vec3A;
use obvhs::BvhBuildParams;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2_from_tris;
use obvhs::cwbvh::CwBvh;
use obvhs::cwbvh::builder::build_cwbvh_from_tris;
use obvhs::ray::{Ray, RayHit};
use obvhs::rt_triangle::RtTriangle;
use obvhs::triangle::Triangle;
use std::time::Duration;

/// The names of its variants.
pub(super) const NAMES: [&str; 2] = ["obvhs BVH2", "obvhs CWBVH"];

/// Both kinds of tree, with the preset that is our standard.
pub(super) struct Trees {
    binary: (Bvh2, Vec<RtTriangle>),
    wide: (CwBvh, Vec<RtTriangle>),
}

/// The triangles as obvhs speaks of them.
pub(super) fn triangles(mesh: &TriangleMesh) -> Vec<Triangle> {
    let corner = |[v0, v1, v2]: [Vec3A; 3]| Triangle { v0, v1, v2 };
    mesh.ids().map(|id| corner(mesh.triangle(id).map(Vec3A::from))).collect()
}

/// A ray from 0 to as far as f32 reaches.
#[inline(always)]
pub(super) fn ray(origin: [f32; 3], direction: [f32; 3]) -> Ray {
    Ray::new(origin.into(), direction.into(), 0.0, f32::MAX)
}

/// The triangle test's form of each triangle, in the order of the leaves.
fn in_order(triangles: &[Triangle], order: &[u32]) -> Vec<RtTriangle> {
    order.iter().map(|&index| RtTriangle::from(&triangles[index as usize])).collect()
}

impl Trees {
    pub(super) fn new(mesh: &TriangleMesh) -> Self {
        let triangles = triangles(mesh);
        let parameters = BvhBuildParams::medium_build;
        let binary = build_bvh2_from_tris(&triangles, parameters(), &mut Duration::default());
        let wide = build_cwbvh_from_tris(&triangles, parameters(), &mut Duration::default());
        let [of_binary, of_wide] = [&binary.primitive_indices, &wide.primitive_indices]
            .map(|order| in_order(&triangles, order));
        Self { binary: (binary, of_binary), wide: (wide, of_wide) }
    }

    pub(super) fn variants<'a>(&'a self, rays: &'a Rays) -> [Variant<'a>; 2] {
        let hits = rays.hits();
        let (tree, triangles) = &self.binary;
        let binary = move || {
            rays.cast_each(&hits, |direction| {
                let mut hit = RayHit::none();
                let ray = ray(rays.origin, direction);
                tree.ray_traverse(ray, &mut hit, |ray, index| triangles[index].intersect(ray))
                    .then(|| (tree.primitive_indices[hit.primitive_id as usize], hit.t))
            });
            Answer::Hits(hits.clone())
        };
        let hits = rays.hits();
        let (tree, triangles) = &self.wide;
        let wide = move || {
            rays.cast_each(&hits, |direction| {
                let mut hit = RayHit::none();
                let ray = ray(rays.origin, direction);
                tree.ray_traverse(ray, &mut hit, |ray, index| triangles[index].intersect(ray))
                    .then(|| (tree.primitive_indices[hit.primitive_id as usize], hit.t))
            });
            Answer::Hits(hits.clone())
        };
        [
            Variant::new(NAMES[0], Work::Closest, rays.len(), binary).of("obvhs 0.4"),
            Variant::new(NAMES[1], Work::Closest, rays.len(), wide).of("obvhs 0.4"),
        ]
    }
}
