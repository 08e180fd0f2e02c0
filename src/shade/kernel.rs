//! Kernels over rows of pixels, compiled from one body for sets of effects, and the table that
//! picks one.
//!
//! The body of the equation is in `equation`; only the loop and the set-up of surfaces are here.

use super::coefficients::{self, Coefficients};
use super::corners::{self, Memo};
use super::effects::Effects;
use super::equation::{Lighting, radiance_of};
use super::frame::{Frame, RowAsker, is_hidden};
use super::geometry::{Seen, geometry_at_pixel};
use super::kernel_effects::KernelEffects;
use super::lanes::{self, Run, Stretch};
use super::method::Method;
use super::reach::{Bounds, RUN};
use super::surface;
use super::watch::{Note, Watch};
use super::weights::{mix_colors, weights};
use crate::color::LinearRgb;
use crate::pixel::{Pixel, Window};
use crate::simd::prefetch;
use crate::visibility::Visible;

/// Shades one row of a window: `visible` and `radiance` hold its pixels.
pub(super) type RowKernel<W> =
    fn(&Frame<'_>, Window, u32, &[Option<Visible>], &mut [LinearRgb], &mut W);

/// Cache lines of what is visible in a run.
const RUN_LINES: usize = RUN * size_of::<Option<Visible>>() / 64;

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
    let reaching = if frame.selects_lights { frame.lights.len() } else { 0 };
    let mut reaches = vec![true; reaching];
    let mut positions = [None; RUN];
    let in_lanes = frame.lanes.as_ref().filter(|_| W::KNOWS_LANES);
    let mut run = in_lanes.map(|lanes| (lanes, Run::new(frame)));
    let row = visible;
    let runs = visible.chunks(RUN).zip(radiance.chunks_mut(RUN));
    for (first, (visible, radiance)) in (window.x0()..).step_by(RUN).zip(runs) {
        // The run after the next: what is visible there comes from memory.
        let ahead = (first - window.x0()) as usize + 2 * RUN;
        prefetch(row.get(ahead..).unwrap_or_default(), RUN_LINES);
        // Shade at once what can be, and leave the rest to the scalar kernel.
        let done = run.as_mut().map_or(0, |(lanes, run)| {
            let stretch = Stretch { first: Pixel { x: first, y }, visible };
            lanes::shade_run(frame, lanes, &stretch, run, &asker, radiance)
        });
        if u64::from(done) + 1 == 1 << visible.len() {
            continue;
        }
        // Lights are chosen for whole runs only: for what lanes left over, all are asked.
        let mut chosen: &[bool] = &[];
        let is_untouched = || {
            let mut pixels = visible.iter().enumerate();
            pixels.all(|(index, seen)| seen.is_none() || done >> index & 1 == 0)
        };
        if frame.selects_lights && is_untouched() {
            let bounds = bounds(frame, first, y, visible, &mut positions);
            frame.cones.mark(frame.level, &bounds, &mut reaches);
            chosen = &reaches;
        } else {
            positions = [None; RUN];
        }
        let pixels = (first..).zip(&positions).zip(visible).zip(radiance);
        for (index, (((x, position), visible), out)) in pixels.enumerate() {
            if done >> index & 1 != 0 {
                continue;
            }
            *out = match visible {
                Some(visible) => {
                    let pixel = Pixel { x, y };
                    let seen = Seen { pixel, visible, position: *position };
                    shade_pixel::<E, W>(frame, &seen, (chosen, &asker), &mut memo, watch)
                }
                None => frame.scene.background,
            };
            if !out.iter().all(|value| value.is_finite()) {
                watch.note(Note::NonFinite);
            }
        }
    }
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
