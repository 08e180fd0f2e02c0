//! Lays visibility, radiance and alpha out as the named planes of a film.
//!
//! Where nothing is visible at a pixel's centre, ids are 0xFFFF_FFFF and every plane but colour
//! is 0 (no surface lies at depth 0), except `stable`, which speaks of nothing as of a triangle, and
//! `invalid`, which speaks of the background's colour too. Values are rounded to f32 once, here.

use super::surface_planes::SurfacePlanes;
use super::{Accuracy, PlaneGroup, PlaneGroups, describe};
use crate::color::LinearRgb;
use crate::film::{Film, Plane, Samples};
use crate::pixel::for_each_row;
use crate::raster::{STANDARD_HALF_WIDTH, stability};
use crate::scene::Scene;
use crate::shade::{Effects, doubt, doubts};
use crate::visibility::{VisibilityBuffer, Visible};

/// "Nothing is visible" in id planes.
const NOTHING: u32 = u32::MAX;

/// Fills the planes that are asked for. `radiance` and `alpha` have one value per pixel of the
/// buffer, and `accuracy` says how the buffer was found.
/// Texture coordinates are left out of a scene that has none, unless only they are asked for.
pub fn develop(
    scene: &Scene,
    buffer: &VisibilityBuffer,
    radiance: &[LinearRgb],
    alpha: &[f64],
    groups: &PlaneGroups,
    accuracy: Accuracy,
) -> Film {
    let mut planes = Vec::new();
    let mut surfaces = SurfacePlanes::new(scene, buffer, groups);
    for group in groups.iter() {
        let is_absent = group == PlaneGroup::TextureCoordinates
            && scene.mesh.uvs.is_empty()
            && groups.iter().count() > 1;
        if !is_absent {
            let samples = fill(scene, buffer, (radiance, alpha), &mut surfaces, group);
            for (name, samples) in group.planes().iter().zip(samples) {
                planes.push(Plane { name: (*name).to_owned(), samples });
            }
        }
    }
    Film {
        resolution: scene.camera.resolution(),
        window: buffer.window,
        planes,
        description: describe(scene, accuracy).to_string(),
    }
}

/// The planes of one group, in the order of [`PlaneGroup::planes`].
fn fill(
    scene: &Scene,
    buffer: &VisibilityBuffer,
    (radiance, alpha): (&[LinearRgb], &[f64]),
    surfaces: &mut SurfacePlanes,
    group: PlaneGroup,
) -> Vec<Samples> {
    match group {
        PlaneGroup::Color => {
            let channel =
                |k: usize| Samples::Float(radiance.iter().map(|rgb| rgb[k] as f32).collect());
            let alpha = Samples::Float(alpha.iter().map(|&share| share as f32).collect());
            vec![channel(0), channel(1), channel(2), alpha]
        }
        PlaneGroup::Depth => floats(buffer, |visible| [visible.t() * scene.camera.z_per_t()]),
        PlaneGroup::RayParameter => floats(buffer, |visible| [visible.t()]),
        PlaneGroup::Position
        | PlaneGroup::FaceNormal
        | PlaneGroup::ShadingNormal
        | PlaneGroup::TextureCoordinates => surfaces.take(group),
        PlaneGroup::Barycentric => {
            floats(buffer, |visible| [visible.barycentric.0[1], visible.barycentric.0[2]])
        }
        PlaneGroup::Identity => uints(buffer, NOTHING, |visible| {
            let id = visible.triangle;
            [id.get(), scene.object_of(id).0 as u32, scene.material_of(id).0 as u32]
        }),
        PlaneGroup::Facing => floats(buffer, |visible| [f64::from(visible.facing.sign())]),
        PlaneGroup::Cover => {
            let crossed = buffer.cover.iter().flatten().map(|cover| cover.crossed);
            vec![Samples::Uint(crossed.collect())]
        }
        PlaneGroup::Verdict => {
            uints(buffer, 0, |visible| [visible.level as u32, u32::from(visible.tie)])
        }
        PlaneGroup::Stable => {
            let stable = stability(scene, buffer, STANDARD_HALF_WIDTH, &|| ());
            vec![Samples::Uint(stable.into_iter().map(u32::from).collect())]
        }
        PlaneGroup::Invalid => {
            // What the file holds decides about its range, not the centre's sample in f64.
            let mut bits = doubts(scene, buffer, Effects::of(scene));
            for (bits, rgb) in bits.iter_mut().zip(radiance) {
                *bits &= !doubt::BEYOND_RANGE;
                if rgb.iter().any(|&value| !(value as f32).is_finite()) {
                    *bits |= doubt::BEYOND_RANGE;
                }
            }
            vec![Samples::Uint(bits)]
        }
    }
}

/// `N` float planes; 0 where nothing is visible.
fn floats<const N: usize>(
    buffer: &VisibilityBuffer,
    value: impl Fn(&Visible) -> [f64; N] + Sync,
) -> Vec<Samples> {
    let width = buffer.window.width() as usize;
    let mut pixels = vec![[0.0_f32; N]; buffer.window.len()];
    for_each_row(&mut pixels, width, &|| (), |row, pixels| {
        for (column, pixel) in pixels.iter_mut().enumerate() {
            if let Some(visible) = &buffer.visible[row * width + column] {
                *pixel = value(visible).map(|v| v as f32);
            }
        }
    });
    (0..N).map(|k| Samples::Float(pixels.iter().map(|pixel| pixel[k]).collect())).collect()
}

/// `N` integer planes; `nothing` where nothing is visible.
fn uints<const N: usize>(
    buffer: &VisibilityBuffer,
    nothing: u32,
    value: impl Fn(&Visible) -> [u32; N] + Sync,
) -> Vec<Samples> {
    let width = buffer.window.width() as usize;
    let mut pixels = vec![[nothing; N]; buffer.window.len()];
    for_each_row(&mut pixels, width, &|| (), |row, pixels| {
        for (column, pixel) in pixels.iter_mut().enumerate() {
            if let Some(visible) = &buffer.visible[row * width + column] {
                *pixel = value(visible);
            }
        }
    });
    (0..N).map(|k| Samples::Uint(pixels.iter().map(|pixel| pixel[k]).collect())).collect()
}
