//! What `truecast render` says when it is done: a summary for people, a document for programs.

use super::Written;
use super::outputs::Outputs;
use crate::cli::arguments::RenderArguments;
use crate::cli::prediction::{path_name, predictions_document, preset_name};
use serde_json::json;
use std::time::Duration;
use truecast::pixel::Window;
use truecast::raster::Unproven;
use truecast::render::visible::SubsampleGrid;
use truecast::render::{Account, Accuracy, Prediction, RenderOptions, TreeSource};
use truecast::scene::Scene;
use truecast::shade::{Notes, Precision};

/// All that the report is made of.
pub(super) struct Report<'a> {
    pub(super) arguments: &'a RenderArguments,
    pub(super) options: &'a RenderOptions,
    pub(super) predictions: &'a [Prediction],
    pub(super) scene: &'a Scene,
    pub(super) account: &'a Account,
    pub(super) outputs: &'a Outputs<'a>,
    pub(super) written: &'a [Written],
}

/// The numbers of the list of visible triangles: how many pixel centres see, how many only
/// sub-samples do.
fn count_visible(account: &Account) -> Option<(usize, usize)> {
    let list = account.visible.as_ref()?;
    let at_centres = list.iter().filter(|seen| seen.pixels > 0).count();
    Some((at_centres, list.len() - at_centres))
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

fn per_triangle(bytes: usize, scene: &Scene) -> f64 {
    (10.0 * bytes as f64 / scene.mesh.len().max(1) as f64).round() / 10.0
}

/// Of mesh and tree.
fn bytes_per_triangle(account: &Account, scene: &Scene) -> f64 {
    per_triangle(account.mesh_bytes + account.tree_bytes.unwrap_or(0), scene)
}

fn milliseconds(time: Duration) -> f64 {
    (time.as_secs_f64() * 1e6).round() / 1e3
}

impl Report<'_> {
    fn window(&self) -> Window {
        self.options.window.unwrap_or(self.scene.camera.resolution().window())
    }

    /// What a person reads after a render.
    pub(super) fn summary(&self, total: Duration) -> String {
        let Self { scene, account, outputs, written, .. } = *self;
        let mut text = String::new();
        let window = self.window();
        for file in written {
            text += &format!("wrote {} ({} bytes", file.path.display(), file.bytes);
            if let Some(clipped) = file.clipped.filter(|clipped| clipped.above > 0) {
                text += &format!("; {} pixels brighter than white were clipped", clipped.above);
            }
            text += ")\n";
        }
        text += &format!(
            "{}x{} pixels, {} triangles, {} pixels covered ({:.1} %), {:.0} ms\n",
            window.width(),
            window.height(),
            scene.mesh.len(),
            account.covered_pixels,
            100.0 * account.covered_pixels as f64 / window.len() as f64,
            milliseconds(total),
        );
        if let Some((at_centres, missed)) = count_visible(account) {
            text += &format!("{at_centres} triangles are seen by pixel centres");
            text += &match self.arguments.subpixel {
                None => "\n".to_owned(),
                Some(grid) => format!(
                    "; at least {missed} more are missed by them and seen by {n}x{n} sub-samples\n",
                    n = grid.side()
                ),
            };
        }
        for (count, _, what) in notes(&account.notes) {
            if count > 0 {
                text += &format!("{count} {what}\n");
            }
        }
        let infinite = outputs.infinite;
        if infinite > 0 {
            text +=
                &format!("{infinite} pixels are brighter than f32 can hold: infinite in the EXR\n");
        }
        if let Some(invalid) = outputs.invalid {
            text += &format!("{invalid} pixels have a bit in the plane invalid\n");
        }
        text
    }

    /// The `--json` document.
    pub(super) fn document(&self, times: &[(&str, Duration)]) -> serde_json::Value {
        let Self { arguments, options, predictions, scene, account, outputs, written } = *self;
        let (accuracy, window) = (options.accuracy, self.window());
        let frame = scene.camera.resolution();
        let stages = [
            ("build", account.times.build),
            ("describe", account.times.describing),
            ("visibility", account.times.visibility),
            ("shade", account.times.shading),
            ("develop", account.times.developing),
            ("list", account.times.listing),
            ("encode", outputs.encoding),
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
        let notes: serde_json::Map<String, serde_json::Value> = notes(&account.notes)
            .iter()
            .map(|&(count, key, _)| (key.to_owned(), json!(count)))
            .collect();
        json!({
            "schema": "truecast/render/1",
            "scene": arguments.scene.as_ref().map(|path| path.display().to_string()),
            "path": path_name(options.path),
            "path_chosen_by": match (arguments.path, accuracy.path()) {
                (Some(_), _) => "user",
                (None, Some(_)) => "accuracy",
                (None, None) => "prediction",
            },
            "preset": account.tree_bytes.map(|_| preset_name(options.preset)),
            "bvh_source": account.tree_source.map(|source| match source {
                TreeSource::Built => "built",
                TreeSource::Kept => "built and kept",
                TreeSource::Loaded => "loaded",
            }),
            "bvh_remark": account.tree_remark,
            "predictions": predictions_document(predictions),
            "memory": {
                "mesh_bytes": account.mesh_bytes,
                "bvh_bytes": account.tree_bytes,
                "bytes_per_triangle": bytes_per_triangle(account, scene),
                "bvh_bytes_per_triangle": account.tree_bytes.map(|bytes| per_triangle(bytes, scene)),
            },
            "accuracy": accuracy.name(),
            "shading": match options.shading {
                Precision::Double => "double",
                Precision::Single => "single",
            },
            "subpixel_bits": match accuracy {
                Accuracy::Raster(Unproven::Watertight { subpixel_bits, .. }) => {
                    Some(subpixel_bits.get())
                }
                _ => None,
            },
            "width": frame.width(),
            "height": frame.height(),
            "window": [window.x0(), window.y0(), window.x1(), window.y1()],
            "triangles": scene.mesh.len(),
            "covered_pixels": account.covered_pixels,
            "visible": count_visible(account).map(|(at_centres, missed)| json!({
                "triangles": at_centres,
                "subpixel": arguments.subpixel.map(SubsampleGrid::side),
                "missed_by_centres": arguments.subpixel.map(|_| missed),
            })),
            "decisions": {
                "f32": account.levels.single,
                "f64": account.levels.double,
                "exact": account.levels.exact,
                "pixels_f32": account.levels.pixels_single,
                "pixels_f64": account.levels.pixels_double,
                "pixels_exact": account.levels.pixels_exact,
            },
            "picture": serde_json::from_str::<serde_json::Value>(&account.description)
                .unwrap_or_default(),
            "notes": notes,
            "infinite_pixels": outputs.infinite,
            "invalid_pixels": outputs.invalid,
            "warnings": scene.warnings,
            "files": files,
            "times_ms": times_ms,
        })
    }
}
