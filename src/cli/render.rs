//! `truecast render`: scene in, pictures out.

mod outputs;
mod report;

use super::arguments::{AccuracyWord, PathWord, RenderArguments};
use super::failure::Failure;
use super::output::{self, Writing};
use super::progress::Bar;
use super::{OK, on_threads};
use outputs::{Encoder, Outputs};
use report::Report;
use std::path::{Path, PathBuf};
use std::time::Instant;
use truecast::accel::BuildPreset;
use truecast::cast;
use truecast::film::{ClipCount, Film, Format, format_of};
use truecast::pixel::{Resolution, Window};
use truecast::raster::{self, DepthBuffer};
use truecast::render::visible::{Listing, to_csv};
use truecast::render::{
    Accuracy, PlaneGroup, PlaneGroups, Prediction, RenderOptions, VisibilityPath, predict,
    render_bands,
};
use truecast::scene::{Overrides, Scene};
use truecast::shade::Effects;

/// The scene that is rendered when none is named.
pub(super) const DEFAULT_SCENE: &str = include_str!("../../scenes/default.toml");

/// One written file.
struct Written {
    path: PathBuf,
    bytes: usize,
    clipped: Option<ClipCount>,
}

pub(super) fn run(arguments: &RenderArguments, writing: &Writing) -> Result<u8, Failure> {
    on_threads(arguments.threads, || run_here(arguments, writing))?
}

/// From the scene to the files, on the threads of the pool that this runs in.
fn run_here(arguments: &RenderArguments, writing: &Writing) -> Result<u8, Failure> {
    let accuracy = accuracy(arguments)?;
    let targets = targets(arguments)?;
    let planes = planes(arguments, &targets)?;
    refuse_planes(arguments, accuracy, &planes)?;
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
    refuse_effects(accuracy, &scene)?;
    let window = window(arguments, scene.camera.resolution())?;
    let predictions = predict(&scene, window.unwrap_or(scene.camera.resolution().window()));
    let (path, preset) = choose(arguments, accuracy, &predictions);
    let options = RenderOptions {
        path,
        preset,
        bvh_cache: arguments.bvh_cache.clone(),
        accuracy,
        shading: arguments.shading.precision(),
        window,
        planes,
        listing: arguments
            .visible
            .as_ref()
            .map(|_| arguments.subpixel.map_or(Listing::Centres, Listing::Subsamples)),
    };
    let frame = scene.camera.resolution();
    let encoder = Encoder::new(&targets, frame, options.window.unwrap_or(frame.window()));
    let mut outputs = Outputs::new(&encoder, writing);
    let encode = |band: &Film| encoder.encode(band);
    let account = render_bands(&scene, &options, &bar, encode, |band| outputs.append(band))?;
    bar.finish();
    if let (Some(remark), false) = (&account.tree_remark, arguments.quiet) {
        output::print_warnings(std::slice::from_ref(remark));
    }
    let mut written = outputs.write()?;
    if let (Some(path), Some(list)) = (&arguments.visible, &account.visible) {
        let text = to_csv(&scene, list);
        output::save(writing, path, text.as_bytes())?;
        written.push(Written { path: path.clone(), bytes: text.len(), clipped: None });
    }
    let total = started.elapsed();
    let report = Report {
        arguments,
        options: &options,
        predictions: &predictions,
        scene: &scene,
        account: &account,
        outputs: &outputs,
        written: &written,
    };
    if arguments.json {
        let times = [("load", load_time), ("write", outputs.writing_time), ("total", total)];
        output::print_json(&report.document(&times));
    } else if !arguments.quiet {
        output::print(&report.summary(total));
    }
    Ok(OK)
}

fn load(arguments: &RenderArguments) -> Result<Scene, Failure> {
    let overrides = Overrides {
        resolution: arguments.size,
        samples: arguments.samples,
        only_lights: arguments.light.clone(),
        ambient_only: arguments.ambient_only,
        skip_bad: arguments.skip_bad,
    };
    Ok(match &arguments.scene {
        Some(path) => Scene::load(path, &overrides)?,
        None => {
            Scene::from_toml(DEFAULT_SCENE, Path::new("default.toml"), Path::new("."), &overrides)?
        }
    })
}

/// The path that is asked for, or the quickest, and how its tree is built.
fn choose(
    arguments: &RenderArguments,
    accuracy: Accuracy,
    predictions: &[Prediction],
) -> (VisibilityPath, BuildPreset) {
    let asked = accuracy.path().or(arguments.path.map(|word| match word {
        PathWord::Cast => VisibilityPath::Cast,
        PathWord::Raster => VisibilityPath::Raster,
    }));
    let ways = predictions.iter().filter(|way| asked.is_none_or(|path| way.path == path));
    // Who keeps trees means to use them more than once: building one does not count.
    let time = |way: &&Prediction| match &arguments.bvh_cache {
        Some(_) => way.rays,
        None => way.total(),
    };
    let quickest = ways.min_by(|a, b| time(a).total_cmp(&time(b)));
    let path = quickest.map_or(VisibilityPath::default(), |way| way.path);
    (path, quickest.and_then(|way| way.preset).unwrap_or_default())
}

/// How visibility is decided; refuses options of what was not asked for.
fn accuracy(arguments: &RenderArguments) -> Result<Accuracy, Failure> {
    let word = arguments.accuracy;
    // Without proof the paths differ; the rasterizer's bits depend on no machine and no tree.
    let is_cast = arguments.path == Some(PathWord::Cast);
    let has_grid = word == AccuracyWord::Watertight && !is_cast;
    let has_buffer = has_grid || (word == AccuracyWord::Fast && !is_cast);
    let belongs = |option: &str, to: &str, why: &str| {
        Err(Failure::usage(format!("{option} belongs to {to}: {why}")))
    };
    if arguments.subpixel_bits.is_some() && !has_grid {
        let to = "--accuracy watertight on --path raster";
        return belongs("--subpixel-bits", to, "nothing else snaps vertices");
    }
    if arguments.depth_bits.is_some() && !has_buffer {
        let to = "--accuracy watertight or fast on --path raster";
        return belongs("--depth-bits", to, "nothing else rounds depths to a depth buffer's bits");
    }
    let buffer = |format| {
        DepthBuffer::new(format, arguments.near, arguments.far).ok_or_else(|| {
            Failure::usage(format!(
                "--near {} --far {}: expected 0 < near < far, both finite",
                arguments.near, arguments.far
            ))
        })
    };
    let depth_buffer = arguments.depth_bits.map(buffer).transpose()?;
    let subpixel_bits = arguments.subpixel_bits.unwrap_or_default();
    Ok(match (word, is_cast) {
        (AccuracyWord::Exact, _) => Accuracy::Exact,
        (AccuracyWord::Double, true) => Accuracy::Cast(cast::Unproven::Double),
        (AccuracyWord::Watertight, true) => Accuracy::Cast(cast::Unproven::Watertight),
        (AccuracyWord::Fast, true) => Accuracy::Cast(cast::Unproven::Fast),
        (AccuracyWord::Double, false) => Accuracy::Raster(raster::Unproven::Double),
        (AccuracyWord::Watertight, false) => {
            Accuracy::Raster(raster::Unproven::Watertight { subpixel_bits, depth_buffer })
        }
        (AccuracyWord::Fast, false) => Accuracy::Raster(raster::Unproven::Fast { depth_buffer }),
    })
}

/// Without proof there is no order behind the nearest surface and no certain surface point: nothing
/// see-through is drawn and no shadows.
fn refuse_effects(accuracy: Accuracy, scene: &Scene) -> Result<(), Failure> {
    if accuracy == Accuracy::Exact {
        return Ok(());
    }
    let effects = Effects::of(scene);
    let refused = [
        (Effects::OPACITY, "this scene has materials with `opacity` below 1"),
        (Effects::SHADOWS, "this scene has lights that cast shadows"),
    ];
    match refused.iter().find(|(effect, _)| effects.has(*effect)) {
        None => Ok(()),
        Some((_, why)) => Err(Failure::usage(format!(
            "--accuracy {} finds only the nearest surface, and {why}: use --accuracy exact",
            accuracy.name()
        ))),
    }
}

/// Refuses planes that the level cannot fill; `all` just goes without them.
fn refuse_planes(
    arguments: &RenderArguments,
    accuracy: Accuracy,
    planes: &PlaneGroups,
) -> Result<(), Failure> {
    let is_all = |list: &String| list.split(',').any(|name| name.trim() == "all");
    let is_named = !arguments.aov.as_ref().is_some_and(is_all);
    if planes.has(PlaneGroup::Cover) && is_named && !accuracy.counts_cover() {
        return Err(Failure::usage(format!(
            "--accuracy {} finds only the nearest triangle and counts no others for the plane \
             `cover`: use --accuracy exact, or watertight on --path raster",
            accuracy.name()
        )));
    }
    Ok(())
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
