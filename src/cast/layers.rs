//! All surfaces along a ray, where the nearest is see-through.
//!
//! The walk is that of `cast`, with another reach: it ends behind the first opaque surface, not at
//! the first surface. Their order is [`Candidate::precedes`], a strict order of the triangles that
//! cover a sample. Triangles that a leaf holds folded count one by one: they may wear different
//! materials.

use super::candidate::Candidate;
use super::memo::{PicturePairs, SamePlane};
use super::ray::{Ray, View};
use super::single::ShearedRay;
use super::{TILE_SIDE, coverage, visible};
use crate::accel::{Accelerator, LeafTriangle, Pending, Slabs};
use crate::mesh::{TriangleId, TriangleMesh};
use crate::pixel::{Pixel, for_each_tile};
use crate::scene::Scene;
use crate::visibility::{Layers, VisibilityBuffer, Visible};
use std::cmp::Ordering;

/// The surfaces behind the nearest at every pixel of `nearest` (the caster's answer) whose nearest
/// is not `opaque`, with `accelerator` built over the scene's mesh. `done` is called once per
/// finished tile of `nearest.window.tiles(TILE_SIDE)`, from any thread.
pub fn cast_layers(
    scene: &Scene,
    accelerator: &Accelerator,
    nearest: &VisibilityBuffer,
    opaque: &(dyn Fn(TriangleId) -> bool + Sync),
    done: &(dyn Fn() + Sync),
) -> Layers {
    let view = View::new(&scene.camera);
    let pairs = PicturePairs::default();
    let tiles = for_each_tile(&nearest.window.tiles(TILE_SIDE), done, |tile| {
        let mut caster = LayerCaster {
            view,
            accelerator,
            mesh: &scene.mesh,
            opaque,
            pending: Pending::default(),
            same_plane: SamePlane::new(&pairs),
        };
        let is_see_through =
            |pixel| nearest.at(pixel).is_some_and(|visible| !opaque(visible.triangle));
        let lists = tile.pixels().map(|pixel| match is_see_through(pixel) {
            true => caster.behind_nearest(pixel),
            false => Vec::new(),
        });
        (tile, lists.collect())
    });
    Layers::from_tiles(nearest.window, &tiles)
}

/// One tile's work and its memory between pixels.
struct LayerCaster<'a> {
    view: View,
    accelerator: &'a Accelerator,
    mesh: &'a TriangleMesh,
    opaque: &'a (dyn Fn(TriangleId) -> bool + Sync),
    pending: Pending,
    same_plane: SamePlane<'a>,
}

impl LayerCaster<'_> {
    /// The surfaces behind the nearest at a pixel, up to and including the first opaque one.
    fn behind_nearest(&mut self, pixel: Pixel) -> Vec<Visible> {
        let ray = self.view.ray(pixel);
        let mut candidates = self.candidates(&ray);
        let order = self.order(&mut candidates, &ray);
        let opaque = |&index: &usize| (self.opaque)(candidates[index].triangle.id);
        let end = order.iter().position(opaque).map_or(order.len(), |first| first + 1);
        let behind = order.iter().take(end).skip(1);
        behind.map(|&index| visible(&self.view, &ray, &mut candidates[index])).collect()
    }

    /// Every covering triangle that does not certainly lie behind an opaque one. All that share the
    /// t of a surface in front of the first opaque one are among them, because the walk leaves out
    /// nothing at its reach: `tie` is theirs as if nothing was left out.
    fn candidates(&mut self, ray: &Ray) -> Vec<Candidate> {
        let Self { accelerator, mesh, opaque, pending, .. } = self;
        let sheared = ShearedRay::new(ray);
        let mut found: Vec<Candidate> = Vec::new();
        let mut reach = f64::INFINITY;
        accelerator.traverse(&Slabs::new(ray.eye, ray.direction()), pending, |triangles| {
            for leaf in triangles {
                if coverage::decide(ray, &sheared, leaf).0.is_none() {
                    continue;
                }
                // Each copy by its own corners: their order is that of the weights.
                for &id in std::iter::once(&leaf.id).chain(accelerator.copies_of(leaf.id)) {
                    let copy = LeafTriangle { vertices: mesh.triangle(id), id, ..*leaf };
                    let Some(covering) = coverage::decide(ray, &sheared, &copy).0 else { continue };
                    let candidate = Candidate::new(ray, &copy, covering);
                    if opaque(id) {
                        reach = reach.min(candidate.reach());
                    }
                    found.push(candidate);
                }
            }
            reach
        });
        found.retain(|candidate| candidate.nearest_t() <= reach);
        found
    }

    /// Positions of the candidates in depth order, nearest first. A sort compares every two that
    /// end up as neighbours, so all that share a depth are marked.
    fn order(&mut self, candidates: &mut [Candidate], ray: &Ray) -> Vec<usize> {
        let mut order: Vec<usize> = (0..candidates.len()).collect();
        order.sort_by(|&a, &b| {
            let Ok([first, second]) = candidates.get_disjoint_mut([a, b]) else {
                return Ordering::Equal;
            };
            match first.precedes(second, ray, &mut self.same_plane).0 {
                true => Ordering::Less,
                false => Ordering::Greater,
            }
        });
        order
    }
}
