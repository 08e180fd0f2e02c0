//! Lays visibility, radiance and alpha out as the named planes of a film.
//!
//! Where nothing is visible at a pixel's centre, ids are 0xFFFF_FFFF and every plane but colour
//! is 0 (no surface lies at depth 0), except `stable`, which speaks of nothing as of a triangle, and
//! `invalid`, which speaks of the background's colour too. Values are rounded to f32 once, here.
//! All planes of a row are filled at once, while what is visible there is at hand.

use super::expose::Exposure;
use super::plane_rows::{PlaneRow, cut, cut_rows, no_samples, resize};
use super::surface_planes::SurfaceRow;
use super::{Accuracy, PlaneGroup, PlaneGroups, describe};
use crate::color::LinearRgb;
use crate::film::{Film, Plane, Samples};
use crate::pixel::Window;
use crate::raster::{STANDARD_HALF_WIDTH, stability};
use crate::scene::Scene;
use crate::shade::{Effects, doubt, doubts};
use crate::visibility::{VisibilityBuffer, Visible};
use rayon::prelude::*;

/// "Nothing is visible" in id planes.
const NOTHING: u32 = u32::MAX;

/// Fills the planes that are asked for. `radiance` and `alpha` have one value per pixel of the
/// buffer, and `accuracy` says how the buffer was found.
/// Texture coordinates are left out of a scene that has none, unless only they are asked for; the cover
/// is left out where it was not counted.
pub fn develop(
    scene: &Scene,
    buffer: &VisibilityBuffer,
    radiance: &[LinearRgb],
    alpha: &[f64],
    groups: &PlaneGroups,
    accuracy: Accuracy,
) -> Film {
    let description = describe(scene, accuracy).to_string();
    let mut film = blank(scene, groups, buffer.cover.is_some(), description);
    turn_to(&mut film, buffer.window);
    lay_out(scene, buffer, (radiance, alpha), groups, &mut film);
    film
}

/// A film with the planes that are asked for, without any sample; that of cover where it is counted.
pub(super) fn blank(
    scene: &Scene,
    groups: &PlaneGroups,
    is_counted: bool,
    description: String,
) -> Film {
    let resolution = scene.camera.resolution();
    let named = asked(scene, groups, is_counted).into_iter().flat_map(|group| {
        let named = group.planes().iter();
        named.map(move |name| Plane { name: (*name).to_owned(), samples: no_samples(group) })
    });
    Film { resolution, window: resolution.window(), planes: named.collect(), description }
}

/// Gives a film another window and room for its samples; its memory is kept, and what it holds until
/// the whole window is developed.
pub(super) fn turn_to(film: &mut Film, window: Window) {
    film.window = window;
    film.planes.iter_mut().for_each(|plane| resize(&mut plane.samples, window.len()));
}

/// [`develop`] into a film with the same planes, of which `buffer` is a piece.
pub(super) fn develop_into(
    scene: &Scene,
    buffer: &VisibilityBuffer,
    exposure: &Exposure,
    groups: &PlaneGroups,
    film: &mut Film,
) {
    lay_out(scene, buffer, (&exposure.radiance, &exposure.alpha), groups, film);
}

fn asked(scene: &Scene, groups: &PlaneGroups, is_counted: bool) -> Vec<PlaneGroup> {
    let is_asked = |group: &PlaneGroup| match group {
        PlaneGroup::TextureCoordinates => !scene.mesh.uvs.is_empty() || groups.iter().count() == 1,
        PlaneGroup::Cover => is_counted,
        _ => true,
    };
    groups.iter().filter(is_asked).collect()
}

fn lay_out(
    scene: &Scene,
    buffer: &VisibilityBuffer,
    (radiance, alpha): (&[LinearRgb], &[f64]),
    groups: &PlaneGroups,
    film: &mut Film,
) {
    let asked = asked(scene, groups, buffer.cover.is_some());
    let width = buffer.window.width() as usize;
    let rows = cut_rows(&asked, &mut film.planes, film.window, buffer.window);
    rows.into_par_iter().enumerate().for_each(|(row, planes)| {
        let range = row * width..(row + 1) * width;
        let seen = Row {
            scene,
            y: buffer.window.y0() + row as u32,
            x0: buffer.window.x0(),
            visible: &buffer.visible[range.clone()],
            radiance: &radiance[range.clone()],
            alpha: &alpha[range.clone()],
            crossed: buffer.cover.as_ref().map(|cover| &cover[range]),
        };
        seen.fill(planes);
    });
    for plane in &mut film.planes {
        let Samples::Uint(values) = &mut plane.samples else { continue };
        let found: Vec<u32> = if plane.name == PlaneGroup::Stable.name() {
            let stable = stability(scene, buffer, STANDARD_HALF_WIDTH, &|| ());
            stable.into_iter().map(u32::from).collect()
        } else if plane.name == PlaneGroup::Invalid.name() {
            invalid(scene, buffer, radiance)
        } else {
            continue;
        };
        let rows = cut(values, film.window, buffer.window).zip(found.chunks(width));
        rows.for_each(|(row, found)| row.copy_from_slice(found));
    }
}

/// What the file holds decides about its range, not the centre's sample in f64.
fn invalid(scene: &Scene, buffer: &VisibilityBuffer, radiance: &[LinearRgb]) -> Vec<u32> {
    let mut bits = doubts(scene, buffer, Effects::of(scene));
    for (bits, rgb) in bits.iter_mut().zip(radiance) {
        *bits &= !doubt::BEYOND_RANGE;
        if rgb.iter().any(|&value| !(value as f32).is_finite()) {
            *bits |= doubt::BEYOND_RANGE;
        }
    }
    bits
}

/// What is known of a row of pixels.
struct Row<'a> {
    scene: &'a Scene,
    y: u32,
    x0: u32,
    visible: &'a [Option<Visible>],
    radiance: &'a [LinearRgb],
    alpha: &'a [f64],
    crossed: Option<&'a [crate::visibility::Cover]>,
}

impl Row<'_> {
    /// Fills the row in all planes but those that take a pass of their own.
    fn fill(&self, planes: Vec<(PlaneGroup, PlaneRow<'_>)>) {
        let scene = self.scene;
        let mut surfaces = SurfaceRow::default();
        for (group, mut plane) in planes {
            match group {
                PlaneGroup::Color => {
                    let pixels = self.radiance.iter().zip(self.alpha);
                    plane.floats(pixels.map(|(&[r, g, b], &alpha)| [r, g, b, alpha]));
                }
                PlaneGroup::Depth => {
                    self.floats(&mut plane, |visible| [visible.t() * scene.camera.z_per_t()]);
                }
                PlaneGroup::RayParameter => self.floats(&mut plane, |visible| [visible.t()]),
                PlaneGroup::Position
                | PlaneGroup::FaceNormal
                | PlaneGroup::ShadingNormal
                | PlaneGroup::TextureCoordinates => {
                    surfaces.set_up(scene, (self.x0, self.y), self.visible);
                    surfaces.lay_out(group, &mut plane);
                }
                PlaneGroup::Barycentric => self.floats(&mut plane, |visible| {
                    [visible.barycentric.0[1], visible.barycentric.0[2]]
                }),
                PlaneGroup::Identity => self.identify(&mut plane),
                PlaneGroup::Facing => {
                    self.floats(&mut plane, |visible| [f64::from(visible.facing.sign())]);
                }
                PlaneGroup::Cover => {
                    let crossed = self.crossed.unwrap_or_default().iter();
                    plane.uints(crossed.map(|cover| [cover.crossed]));
                }
                PlaneGroup::Verdict => plane.uints(self.visible.iter().map(|visible| {
                    let verdict = |v: &Visible| [v.level as u32, u32::from(v.tie)];
                    visible.as_ref().map_or([0; 2], verdict)
                })),
                PlaneGroup::Stable | PlaneGroup::Invalid => {}
            }
        }
    }

    /// Floats of what is visible; 0 where nothing is.
    fn floats<const N: usize>(
        &self,
        plane: &mut PlaneRow<'_>,
        value: impl Fn(&Visible) -> [f64; N],
    ) {
        plane.floats(self.visible.iter().map(|visible| visible.as_ref().map_or([0.0; N], &value)));
    }

    /// Ids of triangle, mesh and material. Neighbours mostly see the same triangle.
    fn identify(&self, plane: &mut PlaneRow<'_>) {
        let mut last = None;
        plane.uints(self.visible.iter().map(|visible| {
            let Some(id) = visible.as_ref().map(|visible| visible.triangle) else {
                return [NOTHING; 3];
            };
            match last {
                Some((triangle, ids)) if triangle == id => ids,
                _ => {
                    let object = self.scene.object_of(id).0 as u32;
                    let ids = [id.get(), object, self.scene.material_of(id).0 as u32];
                    last = Some((id, ids));
                    ids
                }
            }
        }));
    }
}
