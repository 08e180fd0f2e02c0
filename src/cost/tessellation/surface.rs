//! The right picture: curved surfaces without triangles, everything else with its own.
//!
//! Shading takes triangles, so each pixel of a curved surface gets one of its own: in the tangent
//! plane, with the surface's normal at all three corners. The equation then sees the point, the
//! normal and the direction to the eye as they are on the surface.

use super::rewriting::Rewriting;
use crate::accel::BuildPreset;
use crate::cost::analytic::{Contact, cross};
use crate::cost::errors::{Picture, Seen};
use crate::mesh::{Barycentric, NO_ATTRIBUTE, TriangleId};
use crate::pixel::Pixel;
use crate::render::{Answerer, Unwatched, VisibilityPath};
use crate::scene::{Object, Scene, Shading, Source};
use crate::shade::{Effects, shade};
use crate::visibility::{Counting, Facing, Level, Visible};
use rayon::prelude::*;

/// Half the side of a tangent triangle as a share of the distance to the eye: large enough that
/// rounding its corners to f32 turns its face by less than 1e-4, small enough that it stays near.
const TANGENT_SIZE: f64 = 1e-2;

/// What is seen of `scene` if its curved meshes are what they stand for; `others` is the scene
/// without them.
pub(super) fn picture(scene: &Scene, others: &Scene, rewriting: &Rewriting) -> Picture {
    let window = scene.camera.resolution().window();
    let preset = BuildPreset::default();
    let caster = Answerer::new(others, VisibilityPath::Cast, preset, &Unwatched);
    let mut buffer = caster.answer(others, window, Counting::Nearest, &|| ());
    let other_meshes = rewriting.others();
    let z_per_t = scene.camera.z_per_t();
    let mut seen: Vec<Option<Seen>> = buffer
        .visible
        .iter()
        .map(|visible| {
            visible.map(|v| Seen {
                id: other_meshes[others.object_of(v.triangle).0] as u32,
                depth: z_per_t * v.t(),
            })
        })
        .collect();

    // The nearest curved surface of each pixel, where it lies before all others.
    let nearest: Vec<Option<(usize, Contact)>> = (0..window.len())
        .into_par_iter()
        .map(|index| {
            let direction = direction(scene, window.pixel(index));
            let contacts = rewriting.curved().iter().enumerate().filter_map(|(which, curved)| {
                Some((which, curved.1.first_contact(scene.camera.eye(), direction)?))
            });
            let first = contacts.min_by(|(_, a), (_, b)| a.t.total_cmp(&b.t))?;
            let is_hidden = buffer.visible[index].is_some_and(|other| other.t() < first.1.t);
            (!is_hidden).then_some(first)
        })
        .collect();

    let mut lit = others.clone();
    let materials = lit.materials.len() as u32;
    lit.materials.extend(scene.materials.iter().cloned());
    lit.mesh.corner_normals.resize(lit.mesh.len(), [NO_ATTRIBUTE; 3]);
    for (which, (mesh, _)) in rewriting.curved().iter().enumerate() {
        let object = &scene.objects[*mesh];
        let material = materials + scene.triangle_materials[object.triangles.start as usize];
        let first = lit.mesh.len() as u32;
        for (index, contact) in nearest.iter().enumerate() {
            let Some((_, contact)) = contact.filter(|(own, _)| *own == which) else { continue };
            let visible = tangent(&mut lit, window.pixel(index), contact);
            lit.triangle_materials.push(material);
            buffer.visible[index] = Some(visible);
            seen[index] = Some(Seen { id: *mesh as u32, depth: z_per_t * contact.t });
        }
        lit.objects.push(Object {
            name: object.name.clone(),
            triangles: first..lit.mesh.len() as u32,
            shading: Shading::Phong,
            sides: object.sides,
            source: Source::Shape(object.name.clone()),
        });
    }
    if !lit.mesh.corner_uvs.is_empty() {
        lit.mesh.corner_uvs.resize(lit.mesh.len(), [NO_ATTRIBUTE; 3]);
    }
    if !lit.mesh.colors.is_empty() {
        lit.mesh.colors.resize(lit.mesh.positions.len(), [1.0; 3]);
    }
    let radiance = shade(&lit, &buffer, Effects::of(&lit), &|| ()).radiance;
    Picture { seen, radiance }
}

/// The direction of a pixel's ray: exact in f64 on the camera's lattice.
fn direction(scene: &Scene, pixel: Pixel) -> [f64; 3] {
    let (camera, [x, y]) = (&scene.camera, pixel.sample());
    let (d0, dx, dy) = (camera.d0(), camera.dx(), camera.dy());
    std::array::from_fn(|k| d0[k] + x * dx[k] + y * dy[k])
}

/// Appends a triangle about the point of contact, and says how it is seen.
fn tangent(scene: &mut Scene, pixel: Pixel, contact: Contact) -> Visible {
    let (eye, d, n) = (scene.camera.eye(), direction(scene, pixel), contact.normal);
    let along: [f64; 3] = d.map(|c| contact.t * c);
    let distance = (along[0] * along[0] + along[1] * along[1] + along[2] * along[2]).sqrt();
    let size = TANGENT_SIZE * distance;
    // Any direction that is not near the normal spans the plane with it.
    let least = (0..3).min_by(|&a, &b| n[a].abs().total_cmp(&n[b].abs())).unwrap_or(0);
    let u = cross(n, std::array::from_fn(|k| if k == least { size } else { 0.0 }));
    let v = cross(n, u);
    // Corners at u, and at −u/2 ± v/2: their mean is the point, and they run counter-clockwise
    // about n.
    let corner = |a: f64, b: f64| -> [f32; 3] {
        std::array::from_fn(|k| (eye[k] + along[k] + a * u[k] + b * v[k]) as f32)
    };
    let mesh = &mut scene.mesh;
    let first = mesh.positions.len() as u32;
    mesh.positions.extend([corner(1.0, 0.0), corner(-0.5, 0.5), corner(-0.5, -0.5)]);
    mesh.corners.push([first, first + 1, first + 2]);
    mesh.corner_normals.push([mesh.normals.len() as u32; 3]);
    mesh.normals.push(n);
    let is_front = d[0] * n[0] + d[1] * n[1] + d[2] * n[2] < 0.0;
    Visible {
        triangle: TriangleId::new(mesh.len() as u32 - 1),
        facing: if is_front { Facing::Front } else { Facing::Back },
        level: Level::Double,
        tie: false,
        barycentric: Barycentric([1.0 / 3.0; 3]),
        t_lo: contact.t,
        t_hi: contact.t,
    }
}
