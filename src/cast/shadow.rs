//! Hard shadows as a predicate: does an opaque triangle cross the open segment from the surface
//! point to a light? No colour, no cone, no distance: that is shading.
//!
//! # The definition
//!
//! S is the visible triangle at the sample, n = (v_1 − v_0) × (v_2 − v_0) its normal, V and D = n·d
//! as in `lib.rs`. The surface point is the exact rational point x = e + (V/D)·d. For a plane with
//! normal N through a point p, D·N·(x − p) = g·d with g = (N·(e − p))·n + V·N, linear in d, so the
//! side of x is `sgn*(g·d)`·sgn V: the sample moved by (+ε, +ε²) moves x inside the plane of S. A
//! triangle T ≠ S crosses the segment to the light iff, with τ the side of the light, n_T·(l − v_0)
//! for a position and n_T·l for a direction towards it,
//!
//! - τ ≠ 0: a triangle edge-on to the light casts no shadow;
//! - x is strictly on the other side of T's plane: side −τ of n_T through v_0;
//! - x is on side −τ of the plane through the light and each edge (v_j, v_k):
//!   N = (v_j − l) × (v_k − l), or (v_k − v_j) × l for a direction, through v_j.
//!
//! Why this is the crossing: let a_i = v_i − l and M = det(a_0, a_1, a_2) = −n_T·(l − v_0), whose sign
//! is −τ. All three edge sides equal to sgn M mean x − l = Σ λ_i·a_i with every λ_i > 0: x lies in
//! the cone that the light spans through T. Then n_T·(x − v_0) = (Σλ_i − 1)·M, so the side of T's
//! plane says Σλ_i > 1: T is between the two, and the crossing is at the fraction 1/Σλ_i of the way
//! from l. A direction is the limit of a light that moves away.
//!
//! # Exactly once, and no epsilon
//!
//! All sides are those of one moved point x*. The plane of an edge is antisymmetric in the edge's
//! direction, so two triangles on either side of an edge get opposite sides and exactly one of them
//! accepts, at a vertex as in a fan. A side is 0 only where g = 0: N vanishes, or the plane is that of
//! S. So the segment from x* crosses a closed mesh as often as its ends' winding numbers demand,
//! unless the light lies in the plane of S (where nothing it sends reaches S but grazing). S itself
//! has g = 0 by its own formula, as every triangle in its plane has: neither occludes, and nothing has
//! to be moved off the surface. A neighbour of S across an edge is met by x* only where it
//! rises towards the light. On a closed convex mesh a face that faces the light is therefore never
//! occluded and one that faces away from an outside light always is, at samples on edges too. Where the
//! light lies on a triangle or at x, these formulas stand as they are: that triangle has τ = 0.
//!
//! # How it is decided
//!
//! The f64 filter knows x as a cube (`filter`); a walk through the accelerator that allows for
//! the cube visits every triangle that may cross; what the filter leaves open goes to integers
//! (`exact`), which have no range: a light may be at any finite position.

mod exact;
mod filter;

use super::ray::View;
use crate::accel::{Accelerator, LeafTriangle, Pending};
use crate::mesh::{TriangleId, TriangleMesh};
use crate::mutant::{self, Mutant};
use crate::pixel::Pixel;
use crate::scene::Scene;
use crate::scene::light_point::LightPoint;
use crate::visibility::Visible;
use filter::{ShadowRay, Side};
use std::collections::HashMap;

/// Answers shadow questions for one scene, one thread at a time: cheap to make, one per row will do.
pub struct ShadowCaster<'a> {
    view: View,
    mesh: &'a TriangleMesh,
    accelerator: &'a Accelerator,
    pending: Pending,
    copies: HashMap<TriangleId, Vec<TriangleId>>,
    counts: ShadowCounts,
}

/// The work of a [`ShadowCaster`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ShadowCounts {
    /// Shadow rays asked for.
    pub rays: u64,
    /// Those for which some triangle took arithmetic beyond f64.
    pub exact: u64,
}

impl ShadowCounts {
    /// Adds another caster's counts.
    pub fn add(&mut self, other: Self) {
        self.rays += other.rays;
        self.exact += other.exact;
    }
}

impl<'a> ShadowCaster<'a> {
    /// With `accelerator` built over the scene's mesh.
    pub fn new(scene: &'a Scene, accelerator: &'a Accelerator) -> Self {
        Self {
            view: View::new(&scene.camera),
            mesh: &scene.mesh,
            accelerator,
            pending: Pending::default(),
            copies: HashMap::new(),
            counts: ShadowCounts::default(),
        }
    }

    /// A triangle for which `opaque` holds and which crosses the open segment from the surface point
    /// of `visible` at the sample of `pixel` to the light; `None` where the light reaches it.
    ///
    /// Whether there is one is exact. Which of several is returned is not defined. `visible` must
    /// cover the sample; of it the id counts, and the bounds of t, which must hold.
    pub fn occluder(
        &mut self,
        pixel: Pixel,
        visible: &Visible,
        light: LightPoint,
        opaque: impl Fn(TriangleId) -> bool,
    ) -> Option<TriangleId> {
        let Self { view, mesh, accelerator, pending, copies, counts } = self;
        let ray = view.ray(pixel);
        let t = [visible.t_lo, visible.t_hi].map(|t| view.scaled_t(t));
        let shadow_ray = ShadowRay::new(&ray, t, light);
        let surface = mesh.triangle(visible.triangle);
        let mut occluder = None;
        let mut went_exact = false;
        accelerator.search(&shadow_ray.segment(), pending, |triangles| {
            for triangle in triangles {
                // By the definition S is not one of its own occluders; in f64 that is not certain.
                if triangle.id == visible.triangle && !mutant::is(Mutant::ShadowAcne) {
                    continue;
                }
                let side = shadow_ray.side(triangle);
                if side == Side::Beside {
                    continue;
                }
                let Some(id) = opaque_copy(mesh, copies, triangle, &opaque) else { continue };
                let crosses = side == Side::Crossed || {
                    went_exact = true;
                    exact::crosses(&ray, &surface, &triangle.vertices, shadow_ray.light())
                };
                if crosses {
                    occluder = Some(id);
                    return true;
                }
            }
            false
        });
        counts.rays += 1;
        counts.exact += u64::from(went_exact);
        occluder
    }

    /// The work so far.
    pub fn counts(&self) -> ShadowCounts {
        self.counts
    }
}

/// The triangle, or one of the copies that the accelerator folded into it, that is opaque: copies
/// may have materials of their own.
fn opaque_copy(
    mesh: &TriangleMesh,
    copies: &mut HashMap<TriangleId, Vec<TriangleId>>,
    triangle: &LeafTriangle,
    opaque: &impl Fn(TriangleId) -> bool,
) -> Option<TriangleId> {
    if opaque(triangle.id) {
        return Some(triangle.id);
    }
    if triangle.copies == 1 {
        return None;
    }
    let all = copies.entry(triangle.id).or_insert_with(|| {
        let [a, b, c] = triangle.vertices;
        let turns = [[a, b, c], [b, c, a], [c, a, b]];
        mesh.ids().filter(|&id| turns.contains(&mesh.triangle(id))).collect()
    });
    all.iter().copied().find(|&id| opaque(id))
}
