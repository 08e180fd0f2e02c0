//! What `truecast render` says when it is done: a summary for people, a document for programs.

use super::Written;
use crate::cli::arguments::{PathWord, RenderArguments};
use serde_json::json;
use std::time::Duration;
use truecast::film::Samples;
use truecast::render::visible::SubsampleGrid;
use truecast::render::{Accuracy, Frame, PlaneGroup, RenderOptions};
use truecast::scene::Scene;
use truecast::shade::Notes;

/// The numbers of the list of visible triangles: how many pixel centres see, how many only
/// sub-samples do.
fn count_visible(frame: &Frame) -> Option<(usize, usize)> {
    let list = frame.visible.as_ref()?;
    let at_centres = list.iter().filter(|seen| seen.pixels > 0).count();
    Some((at_centres, list.len() - at_centres))
}

/// How many pixels have a bit in the plane `invalid`, if it was asked for.
fn count_invalid(frame: &Frame) -> Option<usize> {
    match frame.film.plane(PlaneGroup::Invalid.name())? {
        Samples::Uint(bits) => Some(bits.iter().filter(|&&bits| bits != 0).count()),
        Samples::Float(_) => None,
    }
}

/// What shading has to report: count, key, words.
fn notes(notes: &Notes) -> [(u64, &'static str, &'static str); 8] {
    [
        (
            notes.lights_at_surface,
            "lights_at_surface",
            "times a light lay at the surface point and gave its ambient part only",
        ),
        (
            notes.near_terminator,
            "near_terminator",
            "times |N·L| was below 1e-13: rounding decides on which side of the terminator it is",
        ),
        (
            notes.opposite_view,
            "opposite_view",
            "times light and eye were exactly opposite: no highlight",
        ),
        (
            notes.cancelled_normals,
            "cancelled_normals",
            "pixels where interpolated normals cancelled and the face normal was used",
        ),
        (notes.missing_normals, "missing_normals", "pixels on faces too thin to have a normal"),
        (
            notes.cancelled_vectors,
            "cancelled_vectors",
            "times directions interpolated from the corners cancelled: ambient part only",
        ),
        (
            notes.perspective_kept,
            "perspective_kept",
            "times a corner at or behind the eye plane kept weights perspective-correct",
        ),
        (notes.non_finite, "non_finite", "pixels whose radiance left the range of f64"),
    ]
}

fn milliseconds(time: Duration) -> f64 {
    (time.as_secs_f64() * 1e6).round() / 1e3
}

/// What a person reads after a render.
pub(super) fn summary(
    subpixel: Option<SubsampleGrid>,
    scene: &Scene,
    frame: &Frame,
    written: &[Written],
    total: Duration,
) -> String {
    let mut text = String::new();
    let pixels = frame.film.window.len();
    for file in written {
        text += &format!("wrote {} ({} bytes", file.path.display(), file.bytes);
        if let Some(clipped) = file.clipped.filter(|clipped| clipped.above > 0) {
            text += &format!("; {} pixels brighter than white were clipped", clipped.above);
        }
        text += ")\n";
    }
    text += &format!(
        "{}x{} pixels, {} triangles, {} pixels covered ({:.1} %), {:.0} ms\n",
        frame.film.window.width(),
        frame.film.window.height(),
        scene.mesh.len(),
        frame.covered_pixels,
        100.0 * frame.covered_pixels as f64 / pixels as f64,
        milliseconds(total),
    );
    if let Some((at_centres, missed)) = count_visible(frame) {
        text += &format!("{at_centres} triangles are seen by pixel centres");
        text += &match subpixel {
            None => "\n".to_owned(),
            Some(grid) => format!(
                "; at least {missed} more are missed by them and seen by {n}x{n} sub-samples\n",
                n = grid.side()
            ),
        };
    }
    for (count, _, what) in notes(&frame.notes) {
        if count > 0 {
            text += &format!("{count} {what}\n");
        }
    }
    let infinite = frame.film.infinite_pixels();
    if infinite > 0 {
        text += &format!("{infinite} pixels are brighter than f32 can hold: infinite in the EXR\n");
    }
    if let Some(invalid) = count_invalid(frame) {
        text += &format!("{invalid} pixels have a bit in the plane invalid\n");
    }
    text
}

/// The `--json` document.
pub(super) fn document(
    arguments: &RenderArguments,
    options: &RenderOptions,
    scene: &Scene,
    frame: &Frame,
    written: &[Written],
    times: &[(&str, Duration)],
) -> serde_json::Value {
    let (accuracy, window) = (options.accuracy, frame.film.window);
    let stages = [
        ("build", frame.times.build),
        ("visibility", frame.times.visibility),
        ("shade", frame.times.shading),
        ("develop", frame.times.developing),
    ];
    let times_ms: serde_json::Map<String, serde_json::Value> = times
        .iter()
        .chain(&stages)
        .map(|&(name, time)| (name.to_owned(), json!(milliseconds(time))))
        .collect();
    let files: Vec<_> = written
        .iter()
        .map(|file| {
            json!({
                "path": file.path.display().to_string(),
                "bytes": file.bytes,
                "clipped_pixels": file.clipped.map(|clipped| clipped.above + clipped.below),
            })
        })
        .collect();
    let notes: serde_json::Map<String, serde_json::Value> =
        notes(&frame.notes).iter().map(|&(count, key, _)| (key.to_owned(), json!(count))).collect();
    json!({
        "schema": "truecast/render/1",
        "scene": arguments.scene.as_ref().map(|path| path.display().to_string()),
        "path": match arguments.path { PathWord::Cast => "cast", PathWord::Raster => "raster" },
        "accuracy": accuracy.name(),
        "subpixel_bits": match accuracy {
            Accuracy::Exact => None,
            Accuracy::Watertight { subpixel_bits, .. } => Some(subpixel_bits.get()),
        },
        "width": frame.film.resolution.width(),
        "height": frame.film.resolution.height(),
        "window": [window.x0(), window.y0(), window.x1(), window.y1()],
        "triangles": scene.mesh.len(),
        "covered_pixels": frame.covered_pixels,
        "visible": count_visible(frame).map(|(at_centres, missed)| json!({
            "triangles": at_centres,
            "subpixel": arguments.subpixel.map(SubsampleGrid::side),
            "missed_by_centres": arguments.subpixel.map(|_| missed),
        })),
        "decisions": {
            "f32": frame.levels.single,
            "f64": frame.levels.double,
            "exact": frame.levels.exact,
            "pixels_f32": frame.levels.pixels_single,
            "pixels_f64": frame.levels.pixels_double,
            "pixels_exact": frame.levels.pixels_exact,
        },
        "picture": serde_json::from_str::<serde_json::Value>(&frame.film.description)
            .unwrap_or_default(),
        "notes": notes,
        "infinite_pixels": frame.film.infinite_pixels(),
        "invalid_pixels": count_invalid(frame),
        "warnings": scene.warnings,
        "files": files,
        "times_ms": times_ms,
    })
}
