//! `truecast render`: scene in, pictures out.

use super::arguments::{AccuracyWord, PathWord, RenderArguments};
use super::failure::Failure;
use super::output::{self, Writing};
use super::progress::Bar;
use super::{OK, on_threads};
use serde_json::json;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use truecast::film::{
    ClipCount, Film, FilmError, Format, encode_exr, encode_npy_ids, encode_png, format_of,
};
use truecast::pixel::{Resolution, Window};
use truecast::render::visible::{Listing, SubsampleGrid, to_csv};
use truecast::render::{
    Accuracy, Frame, PlaneGroup, PlaneGroups, RenderOptions, VisibilityPath, render,
};
use truecast::scene::{Overrides, Scene};
use truecast::shade::Notes;

/// The scene that is rendered when none is named.
const DEFAULT_SCENE: &str = include_str!("../../scenes/default.toml");

/// One written file.
struct Written {
    path: PathBuf,
    bytes: usize,
    clipped: Option<ClipCount>,
}

pub(super) fn run(arguments: &RenderArguments, writing: &Writing) -> Result<u8, Failure> {
    let accuracy = accuracy(arguments)?;
    let targets = targets(arguments)?;
    let planes = planes(arguments, &targets)?;
    if let Some(list) = &arguments.visible {
        output::check_target(list)?;
    }
    let bar = Bar::new(arguments.quiet);
    let started = Instant::now();
    let scene = load(arguments)?;
    let load_time = started.elapsed();
    if !arguments.quiet {
        output::print_warnings(&scene.warnings);
    }
    let options = RenderOptions {
        path: match arguments.path {
            PathWord::Cast => VisibilityPath::Cast,
            PathWord::Raster => VisibilityPath::Raster,
        },
        accuracy,
        window: window(arguments, scene.camera.resolution())?,
        planes,
        listing: arguments
            .visible
            .as_ref()
            .map(|_| arguments.subpixel.map_or(Listing::Centres, Listing::Subsamples)),
        ..RenderOptions::default()
    };
    let (frame, written, write_time) = on_threads(arguments.threads, || {
        let frame = render(&scene, &options, &bar);
        bar.finish();
        let started = Instant::now();
        let mut written = write_all(&frame, &targets, writing)?;
        if let (Some(path), Some(list)) = (&arguments.visible, &frame.visible) {
            let text = to_csv(&scene, list);
            output::save(writing, path, text.as_bytes())?;
            written.push(Written { path: path.clone(), bytes: text.len(), clipped: None });
        }
        Ok::<_, Failure>((frame, written, started.elapsed()))
    })??;
    let total = started.elapsed();
    if arguments.json {
        let times = [("load", load_time), ("write", write_time), ("total", total)];
        output::print_json(&document(arguments, &options, &scene, &frame, &written, &times));
    } else if !arguments.quiet {
        output::print(&summary(arguments.subpixel, &scene, &frame, &written, total));
    }
    Ok(OK)
}

fn load(arguments: &RenderArguments) -> Result<Scene, Failure> {
    let overrides = Overrides { resolution: arguments.size };
    Ok(match &arguments.scene {
        Some(path) => Scene::load(path, &overrides)?,
        None => {
            Scene::from_toml(DEFAULT_SCENE, Path::new("default.toml"), Path::new("."), &overrides)?
        }
    })
}

/// How visibility is decided; refuses what the path does not have.
fn accuracy(arguments: &RenderArguments) -> Result<Accuracy, Failure> {
    match (arguments.accuracy, arguments.path, arguments.subpixel_bits) {
        (AccuracyWord::Exact, _, None) => Ok(Accuracy::Exact),
        (AccuracyWord::Exact, _, Some(_)) => Err(Failure::usage(
            "--subpixel-bits belongs to --accuracy watertight; the exact answer snaps nothing"
                .to_owned(),
        )),
        (AccuracyWord::Watertight, PathWord::Raster, bits) => {
            Ok(Accuracy::Watertight { subpixel_bits: bits.unwrap_or_default() })
        }
        (AccuracyWord::Watertight, PathWord::Cast, _) => Err(Failure::usage(
            "--accuracy watertight exists on --path raster, not on --path cast".to_owned(),
        )),
    }
}

/// The output files, each with its format, refused early when they cannot be written.
fn targets(arguments: &RenderArguments) -> Result<Vec<(PathBuf, Format)>, Failure> {
    let mut paths = arguments.output.clone();
    if paths.is_empty() {
        let stem = arguments.scene.as_deref().and_then(Path::file_stem);
        let stem = stem.unwrap_or("truecast".as_ref());
        for extension in [".png", ".exr"] {
            let mut name = stem.to_os_string();
            name.push(extension);
            paths.push(PathBuf::from(name));
        }
    }
    paths
        .into_iter()
        .map(|path| {
            let format = format_of(&path).map_err(|error| Failure::usage(error.to_string()))?;
            output::check_target(&path)?;
            Ok((path, format))
        })
        .collect()
}

/// What the film must hold: what the EXR is asked for, colour for PNG, ids for NPY.
fn planes(
    arguments: &RenderArguments,
    targets: &[(PathBuf, Format)],
) -> Result<PlaneGroups, Failure> {
    let has = |wanted| targets.iter().any(|&(_, format)| format == wanted);
    let mut planes = match &arguments.aov {
        Some(list) => {
            PlaneGroups::parse(list).map_err(|error| Failure::usage(error.to_string()))?
        }
        None if has(Format::Exr) => PlaneGroups::standard(),
        None => PlaneGroups::default(),
    };
    if has(Format::Png) {
        planes = planes.with(PlaneGroup::Color);
    }
    if has(Format::Npy) {
        planes = planes.with(PlaneGroup::Identity);
    }
    Ok(planes)
}

fn window(arguments: &RenderArguments, frame: Resolution) -> Result<Option<Window>, Failure> {
    let Some([x0, y0, x1, y1]) = arguments.crop else { return Ok(None) };
    Window::new(frame, x0, y0, x1, y1).map(Some).ok_or_else(|| {
        Failure::usage(format!(
            "--crop {x0},{y0},{x1},{y1} is empty or reaches outside the {}x{} frame",
            frame.width(),
            frame.height()
        ))
    })
}

fn write_all(
    frame: &Frame,
    targets: &[(PathBuf, Format)],
    writing: &Writing,
) -> Result<Vec<Written>, Failure> {
    targets
        .iter()
        .map(|(path, format)| {
            let (bytes, clipped) = encode(&frame.film, *format)?;
            output::save(writing, path, &bytes)?;
            Ok(Written { path: path.clone(), bytes: bytes.len(), clipped })
        })
        .collect()
}

/// The film in a format; for PNG also how much was clipped.
fn encode(film: &Film, format: Format) -> Result<(Vec<u8>, Option<ClipCount>), FilmError> {
    Ok(match format {
        Format::Exr => (encode_exr(film)?, None),
        Format::Npy => (encode_npy_ids(film)?, None),
        Format::Png => {
            let (bytes, clipped) = encode_png(film)?;
            (bytes, Some(clipped))
        }
    })
}

/// The numbers of the list of visible triangles: how many pixel centres see, how many only
/// sub-samples do.
fn count_visible(frame: &Frame) -> Option<(usize, usize)> {
    let list = frame.visible.as_ref()?;
    let at_centres = list.iter().filter(|seen| seen.pixels > 0).count();
    Some((at_centres, list.len() - at_centres))
}

/// What shading has to report: count, key, words.
fn notes(notes: &Notes) -> [(u64, &'static str, &'static str); 6] {
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
        (notes.non_finite, "non_finite", "pixels whose radiance left the range of f64"),
    ]
}

fn milliseconds(time: Duration) -> f64 {
    (time.as_secs_f64() * 1e6).round() / 1e3
}

fn summary(
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
    text
}

fn document(
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
            Accuracy::Watertight { subpixel_bits } => Some(subpixel_bits.get()),
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
        "warnings": scene.warnings,
        "files": files,
        "times_ms": times_ms,
    })
}
