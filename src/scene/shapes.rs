//! Generated meshes: spheres, torus, plane, box, cylinder, cone and the Utah teapot; and for scenes
//! of many triangles terrain, a soup of triangles, a hall of columns and a field of teapots.
//!
//! Every shape is in object space, y up, in f64, with unit normals (analytic, but for terrain and
//! hall, where they are those of neighbouring samples) and texture coordinates; triangles run counter-clockwise seen from outside. Points that belong together
//! have the same bits, so closed shapes are closed. Sines and cosines come from `libm`, square
//! roots are exact in IEEE 754: a shape has the same bits on every platform.
//! No transform, no rounding to f32 and no file keys here.

mod angle;
mod bezier;
mod cone;
mod cuboid;
mod cylinder;
mod disc;
mod grid;
mod hall;
mod icosphere;
mod limits;
mod plane;
mod smooth;
mod soup;
mod splitmix;
mod teapot;
mod teapot_field;
mod teapot_patches;
mod terrain;
#[cfg(test)]
mod topology;
mod torus;
mod uv_sphere;
mod vector;

pub use cone::Cone;
pub use cuboid::Cuboid;
pub use cylinder::Cylinder;
pub use hall::Hall;
pub use icosphere::Icosphere;
pub use limits::{MAX_LENGTH, MAX_TRIANGLES, MIN_LENGTH, ShapeError};
pub use plane::Plane;
pub use soup::Soup;
pub use teapot::Teapot;
pub use teapot_field::TeapotField;
pub use terrain::Terrain;
pub use torus::Torus;
pub use uv_sphere::UvSphere;

use crate::scene::part::MeshPart;

/// A shape and its parameters.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Sphere of latitude rings.
    UvSphere(UvSphere),
    /// Sphere of a subdivided icosahedron.
    Icosphere(Icosphere),
    /// Ring torus about the y axis.
    Torus(Torus),
    /// Rectangle in the xz plane, facing up.
    Plane(Plane),
    /// Box about the origin.
    Box(Cuboid),
    /// Cylinder that stands on y = 0.
    Cylinder(Cylinder),
    /// Cone that stands on y = 0.
    Cone(Cone),
    /// The Utah teapot, standing on y = 0.
    Teapot(Teapot),
    /// Square of hills.
    Terrain(Terrain),
    /// Triangles strewn through a cube.
    Soup(Soup),
    /// Hall with two rows of columns, seen from inside.
    Hall(Hall),
    /// Rows of Utah teapots, standing on y = 0.
    TeapotField(TeapotField),
}

impl Shape {
    /// The name in scene files, such as `uv_sphere`.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::UvSphere(_) => uv_sphere::NAME,
            Self::Icosphere(_) => icosphere::NAME,
            Self::Torus(_) => torus::NAME,
            Self::Plane(_) => plane::NAME,
            Self::Box(_) => cuboid::NAME,
            Self::Cylinder(_) => cylinder::NAME,
            Self::Cone(_) => cone::NAME,
            Self::Teapot(_) => teapot::NAME,
            Self::Terrain(_) => terrain::NAME,
            Self::Soup(_) => soup::NAME,
            Self::Hall(_) => hall::NAME,
            Self::TeapotField(_) => teapot_field::NAME,
        }
    }
}

/// Makes the mesh of a shape, in object space. Triangles, positions, normals and texture
/// coordinates are always present; no material is named.
///
/// # Errors
/// When a parameter is outside its range or there would be more than [`MAX_TRIANGLES`] triangles.
pub fn build(shape: &Shape) -> Result<MeshPart, ShapeError> {
    match shape {
        Shape::UvSphere(sphere) => sphere.build(),
        Shape::Icosphere(sphere) => sphere.build(),
        Shape::Torus(torus) => torus.build(),
        Shape::Plane(plane) => plane.build(),
        Shape::Box(cuboid) => cuboid.build(),
        Shape::Cylinder(cylinder) => cylinder.build(),
        Shape::Cone(cone) => cone.build(),
        Shape::Teapot(teapot) => teapot.build(),
        Shape::Terrain(terrain) => terrain.build(),
        Shape::Soup(soup) => soup.build(),
        Shape::Hall(hall) => hall.build(),
        Shape::TeapotField(field) => field.build(),
    }
}

#[cfg(test)]
mod tests;
