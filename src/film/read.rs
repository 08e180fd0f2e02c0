//! Pictures of numbers that others wrote, read as they are: ids and depths as NPY, PNG or EXR.
//!
//! Values keep their meaning to whoever wrote them: nothing is scaled, and what "nothing is there"
//! looks like is the reader's question.

use super::{Film, FilmError, Samples, load_exr};
use crate::pixel::{Resolution, Window};
use std::path::Path;

/// One number per pixel, row by row from the top.
#[derive(Clone, Debug, PartialEq)]
pub enum Numbers {
    /// Whole numbers; u64 above i64 by its bits, so that 2^64 − 1 is −1.
    Whole(Vec<i64>),
    /// Floats.
    Float(Vec<f64>),
}

/// A plane of numbers from a file.
#[derive(Clone, Debug, PartialEq)]
pub struct NumberPlane {
    /// The channel's name; empty where the format has none.
    pub name: String,
    /// The full frame.
    pub frame: Resolution,
    /// The pixels at hand.
    pub window: Window,
    /// One number per pixel of the window.
    pub numbers: Numbers,
}

/// How three bytes of a PNG pixel make an id.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum PackedOrder {
    /// 65536·R + 256·G + B.
    #[default]
    RedFirst,
    /// 65536·B + 256·G + R.
    BlueFirst,
}

/// Reads a plane by the file's extension: `.npy`, `.png` (8-bit RGB packed to 24 bits, or grey) or
/// `.exr`, where `choose` picks the channel by name from the film.
///
/// # Errors
///
/// [`FilmError::Read`], which names the file and says what is wrong with it.
pub fn load_numbers(
    path: &Path,
    order: PackedOrder,
    choose: impl FnOnce(&Film) -> Result<String, String>,
) -> Result<NumberPlane, FilmError> {
    let unreadable = |reason: String| FilmError::Read { path: path.to_owned(), reason };
    let bytes = || std::fs::read(path).map_err(|error| unreadable(error.to_string()));
    let extension = path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase);
    match extension.as_deref() {
        Some("npy") => super::npy::decode_npy(&bytes()?).map_err(unreadable),
        Some("png") => super::png::decode_png_ids(&bytes()?, order).map_err(unreadable),
        Some("exr") => {
            let film = load_exr(path)?;
            let name = choose(&film).map_err(unreadable)?;
            channel(film, &name).map_err(unreadable)
        }
        _ => Err(unreadable("the name must end in .npy, .png or .exr".to_owned())),
    }
}

/// One channel of a film as numbers.
fn channel(film: Film, name: &str) -> Result<NumberPlane, String> {
    let names: Vec<&str> = film.planes.iter().map(|plane| plane.name.as_str()).collect();
    let missing = || format!("it has no channel `{name}`; it has {}", names.join(", "));
    let numbers = match film.plane(name).ok_or_else(missing)? {
        Samples::Uint(values) => Numbers::Whole(values.iter().map(|&v| i64::from(v)).collect()),
        Samples::Float(values) => Numbers::Float(values.iter().map(|&v| f64::from(v)).collect()),
    };
    let (frame, window) = (film.resolution, film.window);
    Ok(NumberPlane { name: name.to_owned(), frame, window, numbers })
}

/// A plane that fills a frame of this size.
pub(super) fn full_plane(width: u64, height: u64, numbers: Numbers) -> Result<NumberPlane, String> {
    let side = |side: u64| u32::try_from(side).unwrap_or(u32::MAX);
    let frame = Resolution::new(side(width), side(height))
        .ok_or_else(|| format!("it is {width}x{height}; each side must be 1 to 65536"))?;
    let found = match &numbers {
        Numbers::Whole(values) => values.len(),
        Numbers::Float(values) => values.len(),
    };
    if found != frame.window().len() {
        return Err(format!("it holds {found} numbers for {width}x{height} pixels"));
    }
    Ok(NumberPlane { name: String::new(), frame, window: frame.window(), numbers })
}
