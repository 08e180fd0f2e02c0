//! Kernels over rows of pixels, compiled from one body for sets of effects, and the table that
//! picks one.
//!
//! The body of the equation is in `equation`; only the loop and the set-up of surfaces are here.

use super::coefficients::{self, Coefficients};
use super::corners::{self, Memo};
use super::effects::Effects;
use super::equation::{Geometry, KernelEffects, Lighting, Mixture, radiance_of};
use super::lights::{self, Origin, PreparedLight, is_black};
use super::method::Method;
use super::reach::{self, Bounds, RUN};
use super::surface;
use super::watch::{Note, Watch};
use super::weights::{mix_colors, weights};
use crate::color::LinearRgb;
use crate::pixel::{Pixel, Window};
use crate::scene::Scene;
use crate::scene::switches::Rules;
use crate::visibility::Visible;
use std::cell::RefCell;

/// Says whether an opaque surface hides the light at a position of the scene's list from the point
/// of a triangle that is visible at a pixel.
pub type Asker<'a> = Box<dyn FnMut(Pixel, &Visible, usize) -> bool + 'a>;

/// Makes an [`Asker`] for each row that is shaded, on the thread that shades it.
pub type Occlusion<'a> = &'a (dyn Fn() -> Asker<'a> + Sync);

/// The asker of a row, if anything casts shadows.
pub(super) type RowAsker<'a> = Option<RefCell<Asker<'a>>>;

/// What is the same at every pixel.
pub(super) struct Frame<'a> {
    pub(super) scene: &'a Scene,
    pub(super) rules: &'a Rules,
    pub(super) effects: Effects,
    pub(super) lights: Vec<PreparedLight>,
    pub(super) methods: Vec<Method>,
    /// Whether any light has a direction: without one no surface is set up.
    directed: bool,
    /// Whether any light casts shadows.
    pub(super) shadowed: bool,
    /// Whether it is worth asking which lights reach a run of pixels.
    selects_lights: bool,
    occlusion: Option<Occlusion<'a>>,
}

impl<'a> Frame<'a> {
    pub(super) fn new(
        scene: &'a Scene,
        effects: Effects,
        occlusion: Option<Occlusion<'a>>,
    ) -> Self {
        let rules = scene.switches.rules();
        // Without anybody to ask, nothing casts a shadow.
        let effects = match occlusion {
            Some(_) => effects,
            None => effects.without(Effects::SHADOWS),
        };
        let lights = lights::prepare(&scene.lights, rules, effects);
        let directed = lights.iter().any(|light| !matches!(light.origin, Origin::Nowhere));
        let shadowed = lights.iter().any(|light| light.shadows);
        let methods = Method::of_objects(scene);
        let has_cone = |light: &PreparedLight| match &light.origin {
            Origin::Position(at) => at.cone.as_ref().is_some_and(|cone| cone.cutoff.is_some()),
            _ => false,
        };
        // One cone is tested as quickly as a run's bounds are found; and directions that are mixed
        // from the corners are tested before the cone.
        let cones = lights.iter().filter(|light| has_cone(light)).count();
        let selects_lights = cones > 1 && !rules.interpolate_vectors;
        Self {
            scene,
            rules,
            effects,
            lights,
            methods,
            directed,
            shadowed,
            selects_lights,
            occlusion,
        }
    }

    /// Whoever answers for shadows while a row is shaded.
    pub(super) fn asker(&self) -> RowAsker<'a> {
        self.occlusion.filter(|_| self.shadowed).map(|make| RefCell::new(make()))
    }

    /// A frame for [`Watch::UNGATED`]: every surface is set up, every light is asked everywhere.
    pub(super) fn ungated(scene: &'a Scene) -> Self {
        let lights = lights::prepare_ungated(&scene.lights, scene.switches.rules());
        Self {
            lights,
            directed: true,
            selects_lights: false,
            ..Self::new(scene, Effects::ALL, None)
        }
    }
}

/// Shades one row of a window: `visible` and `radiance` hold its pixels.
pub(super) type RowKernel<W> =
    fn(&Frame<'_>, Window, u32, &[Option<Visible>], &mut [LinearRgb], &mut W);

/// The kernel for a set of effects: entry n of the table is compiled for set n.
pub(super) fn row_kernel<W: Watch>(effects: Effects) -> RowKernel<W> {
    let table: [RowKernel<W>; 16] = [
        shade_row::<0, W>,
        shade_row::<1, W>,
        shade_row::<2, W>,
        shade_row::<3, W>,
        shade_row::<4, W>,
        shade_row::<5, W>,
        shade_row::<6, W>,
        shade_row::<7, W>,
        shade_row::<8, W>,
        shade_row::<9, W>,
        shade_row::<10, W>,
        shade_row::<11, W>,
        shade_row::<12, W>,
        shade_row::<13, W>,
        shade_row::<14, W>,
        shade_row::<15, W>,
    ];
    table[KernelEffects::of(effects).index()]
}

fn shade_row<const E: u8, W: Watch>(
    frame: &Frame<'_>,
    window: Window,
    y: u32,
    visible: &[Option<Visible>],
    radiance: &mut [LinearRgb],
    watch: &mut W,
) {
    let mut memo = Memo::default();
    let asker = frame.asker();
    let mut reaches = vec![true; if frame.selects_lights { frame.lights.len() } else { 0 }];
    let mut positions = [None; RUN];
    let runs = visible.chunks(RUN).zip(radiance.chunks_mut(RUN));
    for (first, (visible, radiance)) in (window.x0()..).step_by(RUN).zip(runs) {
        if frame.selects_lights {
            let bounds = bounds(frame, first, y, visible, &mut positions);
            reach::mark(&frame.lights, &bounds, &mut reaches);
        }
        let pixels = (first..).zip(&positions).zip(visible).zip(radiance);
        for (((x, position), visible), out) in pixels {
            *out = match visible {
                Some(visible) => {
                    let pixel = Pixel { x, y };
                    let seen = Seen { pixel, visible, position: *position };
                    shade_pixel::<E, W>(frame, &seen, (&reaches, &asker), &mut memo, watch)
                }
                None => frame.scene.background,
            };
            if !out.iter().all(|value| value.is_finite()) {
                watch.note(Note::NonFinite);
            }
        }
    }
}

/// Whether a light is hidden from the surface at a pixel.
pub(super) fn is_hidden(
    asker: &RowAsker<'_>,
    pixel: Pixel,
    visible: &Visible,
    light: usize,
) -> bool {
    asker.as_ref().is_some_and(|asker| (*asker.borrow_mut())(pixel, visible, light))
}

/// A box around every point of a run at which the equation may be evaluated, and the world
/// positions that were found on the way. Colours that are shared by the pixels of a triangle are
/// evaluated at its corners and its centroid.
fn bounds(
    frame: &Frame<'_>,
    first: u32,
    y: u32,
    run: &[Option<Visible>],
    positions: &mut [Option<[f64; 3]>; RUN],
) -> Bounds {
    let scene = frame.scene;
    let mut bounds = Bounds::EMPTY;
    for ((x, visible), known) in (first..).zip(run).zip(positions) {
        *known = None;
        let Some(visible) = visible else { continue };
        match frame.methods[scene.object_of(visible.triangle).0] {
            Method::SmoothPixel | Method::FlatPixel => {
                let position = surface::position(scene, Pixel { x, y }, visible);
                bounds.add(position);
                *known = Some(position);
            }
            Method::SmoothCorners | Method::FlatCorners | Method::Centroid | Method::LastCorner => {
                let corners = scene.mesh.triangle(visible.triangle);
                corners.iter().for_each(|corner| bounds.add(corner.map(f64::from)));
            }
            Method::VertexColors => {}
        }
    }
    bounds
}

/// What is visible at a pixel.
pub(super) struct Seen<'a> {
    pub(super) pixel: Pixel,
    pub(super) visible: &'a Visible,
    /// Its world position, where it is known already.
    pub(super) position: Option<[f64; 3]>,
}

fn shade_pixel<const E: u8, W: Watch>(
    frame: &Frame<'_>,
    seen: &Seen<'_>,
    (reaches, asker): (&[bool], &RowAsker<'_>),
    memo: &mut Memo,
    watch: &mut W,
) -> LinearRgb {
    let effects = const { KernelEffects(E) };
    let (scene, pixel, visible) = (frame.scene, seen.pixel, seen.visible);
    let (object, _) = scene.object_of(visible.triangle);
    let (_, material) = scene.material_of(visible.triangle);
    let coefficients = coefficients::at_pixel(frame, pixel, visible, material, watch);
    let depends_on_pixel = frame.shadowed || coefficients.textured;
    let is_hidden = |light| is_hidden(asker, pixel, visible, light);
    let lighting = Lighting { reaches, is_hidden: &is_hidden };
    if let Some(color) = unlit_color(frame, visible, &coefficients, watch) {
        return color;
    }
    match frame.methods[object] {
        method @ (Method::SmoothPixel | Method::FlatPixel) => {
            let geometry = geometry_at_pixel::<E, W>(
                frame,
                seen,
                method == Method::SmoothPixel,
                &coefficients,
                watch,
            );
            radiance_of::<E, W>(frame, &coefficients, geometry.as_ref(), lighting, watch)
        }
        method @ (Method::SmoothCorners | Method::FlatCorners) => {
            let is_smooth = method == Method::SmoothCorners && effects.has(KernelEffects::NORMALS);
            let colors = memo.colors(visible, depends_on_pixel, || {
                [0, 1, 2].map(|corner| {
                    let sees = frame.sees::<W>(&coefficients, effects);
                    let point =
                        sees.then(|| corners::at_corner(frame, visible, corner, is_smooth, watch));
                    radiance_of::<E, W>(frame, &coefficients, point.as_ref(), lighting, watch)
                })
            });
            mix_colors(weights(scene, visible, watch), colors)
        }
        method @ (Method::Centroid | Method::LastCorner) => {
            memo.colors(visible, depends_on_pixel, || {
                let is_smooth = effects.has(KernelEffects::NORMALS);
                let point = frame.sees::<W>(&coefficients, effects).then(|| match method {
                    Method::Centroid => corners::at_centroid(frame, visible, watch),
                    _ => corners::at_corner(frame, visible, 2, is_smooth, watch),
                });
                [radiance_of::<E, W>(frame, &coefficients, point.as_ref(), lighting, watch); 3]
            })[0]
        }
        Method::VertexColors => [0.0; 3],
    }
}

/// The colour of a surface that no light changes: kd of an unlit material, or the interpolated
/// colours of the vertices (white where the mesh has none).
pub(super) fn unlit_color<W: Watch>(
    frame: &Frame<'_>,
    visible: &Visible,
    coefficients: &Coefficients,
    watch: &mut W,
) -> Option<LinearRgb> {
    let scene = frame.scene;
    let (object, _) = scene.object_of(visible.triangle);
    if frame.methods[object] == Method::VertexColors {
        let colors = scene.mesh.colors_of(visible.triangle).unwrap_or([[1.0; 3]; 3]);
        return Some(mix_colors(weights(scene, visible, watch), colors));
    }
    scene.material_of(visible.triangle).1.unlit.then_some(coefficients.diffuse)
}

/// The point that is visible at a pixel as lights see it; `None` where none has a direction.
pub(super) fn geometry_at_pixel<const E: u8, W: Watch>(
    frame: &Frame<'_>,
    seen: &Seen<'_>,
    is_smooth: bool,
    coefficients: &Coefficients,
    watch: &mut W,
) -> Option<Geometry> {
    let effects = const { KernelEffects(E) };
    let (scene, rules, pixel, visible) = (frame.scene, frame.rules, seen.pixel, seen.visible);
    if !frame.sees::<W>(coefficients, effects) {
        return None;
    }
    let is_smooth = is_smooth && effects.has(KernelEffects::NORMALS);
    let weights = if is_smooth || rules.interpolate_vectors {
        weights(scene, visible, watch)
    } else {
        [0.0; 3]
    };
    let normal = surface::shading_normal(scene, visible, weights, is_smooth, watch);
    let mixture = rules.interpolate_vectors.then(|| Mixture {
        corners: scene.mesh.triangle(visible.triangle).map(|corner| corner.map(f64::from)),
        weights,
    });
    Some(Geometry {
        position: if effects.has(KernelEffects::POSITIONAL) {
            seen.position.unwrap_or_else(|| surface::position(scene, pixel, visible))
        } else {
            [0.0; 3]
        },
        to_eye: match &mixture {
            _ if !effects.has(KernelEffects::SPECULAR) => [0.0; 3],
            Some(mixture) if !rules.distant_viewer => {
                mixture.direction_to(scene.camera.eye()).unwrap_or_default()
            }
            _ => surface::to_eye(scene, pixel),
        },
        normal: normal.unit,
        normal_length: normal.length,
        mixture,
    })
}

impl Frame<'_> {
    /// Whether some light's direction matters to a surface with these coefficients.
    fn sees<W: Watch>(&self, coefficients: &Coefficients, effects: KernelEffects) -> bool {
        let reflects = W::UNGATED
            || !is_black(coefficients.diffuse)
            || effects.has(KernelEffects::SPECULAR) && !is_black(coefficients.specular)
            || self.rules.attenuate_ambient && !is_black(coefficients.ambient);
        self.directed && reflects
    }
}
