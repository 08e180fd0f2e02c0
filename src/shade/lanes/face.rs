//! A visible triangle's part in its pixels: what `surface` and `geometry` need of it, found once for
//! all neighbouring pixels that see it.

use crate::scene::Sides;
use crate::shade::effects::Effects;
use crate::shade::frame::Frame;
use crate::shade::method::Method;
use crate::shade::vector;
use crate::visibility::{Facing, Visible};

/// A triangle as its pixels see it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Face {
    /// Corner 0, and the edges from it.
    pub(super) origin: [f64; 3],
    pub(super) edges: [[f64; 3]; 2],
    /// Bound of the error of a point made of them; see `surface::position`.
    pub(super) corner_error: f64,
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
    /// `None` where the equation is not evaluated at the pixel, or where something is to be noted.
    pub(super) fn of(frame: &Frame<'_>, visible: &Visible) -> Option<Self> {
        let (scene, id) = (frame.scene, visible.triangle);
        let (index, object) = scene.object_of(id);
        let (material_index, material) = scene.material_of(id);
        let is_smooth = match frame.methods[index] {
            Method::SmoothPixel => frame.effects.has(Effects::INTERPOLATED_NORMALS),
            Method::FlatPixel => false,
            _ => return None,
        };
        if material.unlit {
            return None;
        }
        let mut face = Self {
            origin: [0.0; 3],
            edges: [[0.0; 3]; 2],
            corner_error: 0.0,
            normals: [[0.0; 3]; 3],
            is_smooth: false,
            turns: object.sides == Sides::Double && visible.facing == Facing::Back,
            material: material_index as u32,
            is_textured: frame.effects.has(Effects::TEXTURES)
                && (material.kd_map.is_some() || material.ks_map.is_some()),
        };
        if !frame.directed {
            return Some(face);
        }
        match scene.mesh.normals_of(id).filter(|_| is_smooth) {
            Some(normals) => (face.normals, face.is_smooth) = (normals, true),
            None => {
                let normal = scene.mesh.face_normal(id);
                if normal == [0.0; 3] {
                    return None;
                }
                face.normals = [normal; 3];
            }
        }
        let [v0, v1, v2] = scene.mesh.triangle(id).map(|v| v.map(f64::from));
        face.origin = v0;
        face.edges = [vector::sub(v1, v0), vector::sub(v2, v0)];
        let [e1, e2] = face.edges.map(vector::largest_component);
        face.corner_error =
            f64::EPSILON * vector::largest_component(v0) + 16.0 * f64::EPSILON * e1.max(e2);
        Some(face)
    }
}
