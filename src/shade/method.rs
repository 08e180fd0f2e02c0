//! How the triangles of a mesh are shaded: where the equation is evaluated, and what is
//! interpolated.
//!
//! The word of the mesh and the switch `flat` decide; nothing is evaluated here. Sources: Curless,
//! "Shading"; Angel, "Lighting and Shading"; IIT, "Flat, Gouraud, Phong Surface Rendering"; CS315.

use crate::scene::switches::{FlatMeaning, Rules};
use crate::scene::{Scene, Shading};

/// Where the equation is evaluated, and with which normal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Method {
    /// At every pixel, with the corner normals interpolated.
    SmoothPixel,
    /// At every pixel, with the face normal.
    FlatPixel,
    /// At the corners with their own normals; colours are interpolated.
    SmoothCorners,
    /// At the corners with the face normal; colours are interpolated.
    FlatCorners,
    /// At the centroid with the face normal; one colour.
    Centroid,
    /// At the last corner with its own normal; one colour.
    LastCorner,
    /// Nowhere: the vertices' own colours are interpolated.
    VertexColors,
}

impl Method {
    pub(super) fn of(shading: Shading, rules: &Rules) -> Self {
        match (shading, rules.flat) {
            (Shading::Phong, _) => Self::SmoothPixel,
            (Shading::Gouraud, _) => Self::SmoothCorners,
            (Shading::VertexColor, _) => Self::VertexColors,
            (Shading::Flat, FlatMeaning::FaceNormal) => Self::FlatPixel,
            (Shading::Flat, FlatMeaning::OnePoint) => Self::Centroid,
            (Shading::Flat, FlatMeaning::VertexFaceNormal) => Self::FlatCorners,
            (Shading::Flat, FlatMeaning::Provoking) => Self::LastCorner,
        }
    }

    /// The method of every object of a scene, in order.
    pub(super) fn of_objects(scene: &Scene) -> Vec<Self> {
        let rules = scene.switches.rules();
        scene.objects.iter().map(|object| Self::of(object.shading, rules)).collect()
    }

    /// Whether corner normals have a part in it.
    pub(super) const fn uses_corner_normals(self) -> bool {
        matches!(self, Self::SmoothPixel | Self::SmoothCorners | Self::LastCorner)
    }

    /// Whether the light meets the surface at all.
    pub(super) const fn is_lit(self) -> bool {
        !matches!(self, Self::VertexColors)
    }
}
