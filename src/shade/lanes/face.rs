//! A visible triangle's part in its pixels: what `surface` and `geometry` need of it, found once for
//! all neighbouring pixels that see it.

use crate::mesh::TriangleId;
use crate::scene::{Scene, Sides};
use crate::shade::effects::Effects;
use crate::shade::frame::Frame;
use crate::shade::method::Method;
use crate::shade::vector;
use crate::visibility::{Facing, Visible};

/// A triangle as its pixels see it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Face {
    /// The corner normals; all three the face normal where it is flat.
    pub(super) normals: [[f64; 3]; 3],
    pub(super) is_smooth: bool,
    /// Whether its normal turns.
    pub(super) turns: bool,
    /// Position of its material in the scene.
    pub(super) material: u32,
    /// Whether its coefficients may vary from pixel to pixel.
    pub(super) is_textured: bool,
}

impl Face {
    /// Becomes the face that is visible; false where the equation is not evaluated at the pixel, or
    /// where something is to be noted. (In place: a face is too large to be handed around for few
    /// pixels.)
    pub(super) fn become_seen(&mut self, frame: &Frame<'_>, visible: &Visible) -> bool {
        let (scene, id) = (frame.scene, visible.triangle);
        let (index, object) = scene.object_of(id);
        let (material_index, material) = scene.material_of(id);
        let is_smooth = match frame.methods[index] {
            Method::SmoothPixel => frame.effects.has(Effects::INTERPOLATED_NORMALS),
            Method::FlatPixel => false,
            _ => return false,
        };
        if material.unlit {
            return false;
        }
        self.is_smooth = false;
        self.turns = object.sides == Sides::Double && visible.facing == Facing::Back;
        self.material = material_index as u32;
        self.is_textured = frame.effects.has(Effects::TEXTURES)
            && (material.kd_map.is_some() || material.ks_map.is_some());
        if !frame.directed {
            return true;
        }
        match scene.mesh.normals_of(id).filter(|_| is_smooth) {
            Some(normals) => (self.normals, self.is_smooth) = (normals, true),
            None => {
                let normal = scene.mesh.face_normal(id);
                if normal == [0.0; 3] {
                    return false;
                }
                self.normals = [normal; 3];
            }
        }
        true
    }
}

/// Where a triangle lies.
pub(super) struct Plane {
    /// Corner 0, and the edges from it.
    pub(super) origin: [f64; 3],
    pub(super) edges: [[f64; 3]; 2],
    /// Bound of the error of a point made of them; see `surface::position`.
    pub(super) corner_error: f64,
}

impl Plane {
    pub(super) fn of(scene: &Scene, id: TriangleId) -> Self {
        let [v0, v1, v2] = scene.mesh.triangle(id).map(|v| v.map(f64::from));
        let edges = [vector::sub(v1, v0), vector::sub(v2, v0)];
        let [e1, e2] = edges.map(vector::largest_component);
        let corner_error =
            f64::EPSILON * vector::largest_component(v0) + 16.0 * f64::EPSILON * e1.max(e2);
        Self { origin: v0, edges, corner_error }
    }
}
