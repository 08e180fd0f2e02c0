//! Another program's files, read and laid into the scene's frame.

use super::super::arguments::{CheckArguments, PackedWord};
use super::super::failure::Failure;
use std::path::Path;
use truecast::check::foreign::{DepthKind, DepthPlane, Foreign, IdPlane};
use truecast::film::{Film, NumberPlane, Numbers, PackedOrder, Samples, load_numbers};
use truecast::pixel::Window;
use truecast::scene::Scene;

/// Channels that hold depth, in the order of preference.
const DEPTH_CHANNELS: [&str; 3] = ["Z", "t", "depth"];

/// What was read, and what is to be said about it.
pub(super) struct Input {
    pub(super) foreign: Foreign,
    pub(super) warnings: Vec<String>,
}

/// Reads the files that the command line names; at least one.
pub(super) fn foreign(arguments: &CheckArguments, scene: &Scene) -> Result<Input, Failure> {
    let wanted = &arguments.foreign;
    let order = match wanted.png_order {
        PackedWord::Rgb => PackedOrder::RedFirst,
        PackedWord::Bgr => PackedOrder::BlueFirst,
    };
    let mut warnings = Vec::new();
    let mut windows = Vec::new();
    let mut ids = None;
    if let Some(path) = &wanted.ids {
        let plane = load_numbers(path, order, |film| id_channel(film, &wanted.ids_channel))?;
        let plane = in_frame(path, plane, scene, wanted.flip_y)?;
        let words = IdPlane::of(&plane)
            .map_err(|reason| Failure::Input(format!("{}: {reason}", path.display())))?;
        if words.may_be_rounded {
            warnings.push(format!(
                "{}: its ids are floats, and some are above 2^24, where 32-bit floats do not hold \
                 every whole number: neighbouring ids may have become one",
                path.display()
            ));
        }
        windows.push(plane.window);
        ids = Some(words);
    }
    let mut depth = None;
    if let Some(path) = &wanted.depth {
        if path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("png")) {
            return Err(Failure::usage("--depth takes .exr or .npy; PNG holds no depths"));
        }
        let plane = load_numbers(path, order, |film| depth_channel(film, &wanted.depth_channel))?;
        let plane = in_frame(path, plane, scene, wanted.flip_y)?;
        let kind = if plane.name == "t" { DepthKind::RayParameter } else { DepthKind::Z };
        let values = match plane.numbers {
            Numbers::Whole(values) => values.iter().map(|&value| value as f64).collect(),
            Numbers::Float(values) => values,
        };
        windows.push(plane.window);
        depth = Some(DepthPlane { kind, values });
    }
    let window = same_window(&windows)?;
    Ok(Input { foreign: Foreign { window, ids, depth }, warnings })
}

fn same_window(windows: &[Window]) -> Result<Window, Failure> {
    match *windows {
        [window] => Ok(window),
        [ids, depth] if ids == depth => Ok(ids),
        _ => Err(Failure::Input(
            "ids and depths are of different parts of the frame; give the same part".to_owned(),
        )),
    }
}

/// The channel of the ids: the one asked for, ours, or the only one of whole numbers.
fn id_channel(film: &Film, wanted: &Option<String>) -> Result<String, String> {
    if let Some(name) = wanted {
        return Ok(name.clone());
    }
    if film.plane("id.prim").is_some() {
        return Ok("id.prim".to_owned());
    }
    let whole: Vec<&str> = film
        .planes
        .iter()
        .filter(|plane| matches!(plane.samples, Samples::Uint(_)))
        .map(|plane| plane.name.as_str())
        .collect();
    match (whole.as_slice(), film.planes.as_slice()) {
        (&[name], _) => Ok(name.to_owned()),
        ([], [only]) => Ok(only.name.clone()),
        _ => Err(format!(
            "which channel holds the ids? Name it with --ids-channel; it has {}",
            names(film)
        )),
    }
}

/// The channel of the depths: the one asked for, or the first that has a usual name, or the only
/// one.
fn depth_channel(film: &Film, wanted: &Option<String>) -> Result<String, String> {
    if let Some(name) = wanted {
        return Ok(name.clone());
    }
    if let Some(name) = DEPTH_CHANNELS.into_iter().find(|name| film.plane(name).is_some()) {
        return Ok(name.to_owned());
    }
    match film.planes.as_slice() {
        [only] => Ok(only.name.clone()),
        _ => Err(format!(
            "which channel holds the depths? Name it with --depth-channel; it has {}",
            names(film)
        )),
    }
}

fn names(film: &Film) -> String {
    film.planes.iter().map(|plane| plane.name.as_str()).collect::<Vec<_>>().join(", ")
}

/// The plane in the scene's frame, with its rows from the top.
fn in_frame(
    path: &Path,
    plane: NumberPlane,
    scene: &Scene,
    flip_y: bool,
) -> Result<NumberPlane, Failure> {
    let frame = scene.camera.resolution();
    if plane.frame != frame {
        let (theirs, ours) =
            ((plane.frame.width(), plane.frame.height()), (frame.width(), frame.height()));
        let remedy = if theirs == (ours.1, ours.0) {
            "width and height are exchanged: transpose it".to_owned()
        } else {
            format!("make it at the scene's size, or pass --size {}x{}", theirs.0, theirs.1)
        };
        return Err(Failure::Input(format!(
            "{} is {}x{} pixels and the scene {}x{}; {remedy}",
            path.display(),
            theirs.0,
            theirs.1,
            ours.0,
            ours.1
        )));
    }
    if !flip_y {
        return Ok(plane);
    }
    if plane.window != frame.window() {
        return Err(Failure::Input(format!(
            "{} is a part of the frame; --flip-y needs all of it",
            path.display()
        )));
    }
    let width = frame.width() as usize;
    let numbers = match &plane.numbers {
        Numbers::Whole(values) => Numbers::Whole(flipped(values, width)),
        Numbers::Float(values) => Numbers::Float(flipped(values, width)),
    };
    Ok(NumberPlane { numbers, ..plane })
}

fn flipped<T: Copy>(values: &[T], width: usize) -> Vec<T> {
    values.chunks(width).rev().flatten().copied().collect()
}
