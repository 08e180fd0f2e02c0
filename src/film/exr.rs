//! OpenEXR: one part, scan lines, ZIP in blocks of 16 rows, every plane bit for bit.
//!
//! The same film gives the same bytes for any number of threads: blocks are compressed in parallel,
//! each from its own rows alone, and written from the top down. For the same reason there is no
//! date and exactly one attribute of our own: the `exr` crate writes such attributes in the order of
//! a hash map, which differs between runs. Tiles, deep samples and several parts are not written.
//!
//! Compression is our own (`deflate`), for the crate's takes 7 times as long.

mod block;
mod decode;
mod writer;

pub use decode::decode_exr;
pub use writer::ExrWriter;

use std::io::Cursor;
use std::sync::Mutex;

use ::exr::compression::Compression;
use ::exr::math::Vec2;
use ::exr::meta::BlockDescription;
use ::exr::meta::attribute::{
    AttributeValue, ChannelDescription, Chromaticities, IntegerBounds, LineOrder, SampleType, Text,
};
use ::exr::meta::header::{Header, ImageAttributes, LayerAttributes};
use rayon::prelude::*;

use super::check::check_film;
use super::{Film, FilmError, Plane, Samples};
use crate::pixel::Window;

/// Name of the one attribute of our own; it holds the film's description.
const DESCRIPTION: &str = "truecast";

/// Chromaticities of Rec. ITU-R BT.709 primaries and its white point D65, CIE 1931 (x, y).
const REC_709: Chromaticities = Chromaticities {
    red: Vec2(0.64, 0.33),
    green: Vec2(0.30, 0.60),
    blue: Vec2(0.15, 0.06),
    white: Vec2(0.3127, 0.3290),
};

/// Rows of a block.
pub(super) const BLOCK_ROWS: usize = 16;

/// How the pictures of one window lie in a file.
#[derive(Debug)]
pub struct ExrLayout {
    header: Header,
    window: Window,
    /// Type and name of each plane, in the file's order.
    planes: Vec<(String, SampleType)>,
    /// What was used to compress a block and waits for the next.
    rooms: Mutex<Vec<block::Room>>,
}

/// Rows of a picture, compressed: blocks as they stand in the file.
#[derive(Debug)]
pub struct ExrRows {
    first: u32,
    blocks: Vec<Vec<u8>>,
}

impl ExrLayout {
    /// A picture of `window` with the planes and description of `band`, which is a part of
    /// it: display window = full frame, data window = `window`, one FLOAT or UINT channel per plane,
    /// the description as the string attribute `truecast`.
    ///
    /// # Errors
    ///
    /// [`FilmError::Inconsistent`] for a broken film.
    pub fn new(band: &Film, window: Window) -> Result<Self, FilmError> {
        check_film(band)?;
        let planes = in_order(band);
        let names = planes.iter().map(|plane| (plane.name.clone(), sample_type(plane))).collect();
        let header = describe(band, &planes, window);
        Ok(Self { header, window, planes: names, rooms: Mutex::default() })
    }

    /// Compresses some rows of the picture, in parallel. They begin a multiple of 16 rows below its
    /// top, and all but the last have a multiple of 16 rows.
    ///
    /// # Errors
    ///
    /// [`FilmError::Inconsistent`] for a broken film, or one that is no such part.
    pub fn compress(&self, band: &Film) -> Result<ExrRows, FilmError> {
        check_film(band)?;
        let planes = in_order(band);
        let names = planes.iter().map(|plane| (plane.name.as_str(), sample_type(plane)));
        let (whole, part) = (self.window, band.window);
        let whole_blocks = |rows: u32| (rows as usize).is_multiple_of(BLOCK_ROWS);
        let fits = names.eq(self.planes.iter().map(|(name, kind)| (name.as_str(), *kind)))
            && (part.x0(), part.x1()) == (whole.x0(), whole.x1())
            && (whole.y0()..whole.y1()).contains(&part.y0())
            && whole_blocks(part.y0() - whole.y0())
            && (part.y1() == whole.y1() || part.y1() < whole.y1() && whole_blocks(part.height()));
        if !fits {
            return Err(misfit(part));
        }
        let (width, height) = (part.width() as usize, part.height() as usize);
        let first_rows: Vec<usize> = (0..height).step_by(BLOCK_ROWS).collect();
        let block = |first: usize| {
            let mut room = self.rooms().pop().unwrap_or_default();
            // Of a block stand its first row and its length before it.
            let mut bytes = Vec::new();
            bytes.extend((part.y0() + first as u32).to_le_bytes());
            bytes.extend([0; 4]);
            let before = bytes.len();
            let rows = first..height.min(first + BLOCK_ROWS);
            block::compress(&planes, width, rows, &mut room, &mut bytes);
            let length = (bytes.len() - before) as u32;
            bytes[before - 4..before].copy_from_slice(&length.to_le_bytes());
            self.rooms().push(room);
            bytes
        };
        Ok(ExrRows { first: part.y0(), blocks: first_rows.into_par_iter().map(block).collect() })
    }

    /// No work is done while the lock is held, so that none can be poisoned.
    fn rooms(&self) -> std::sync::MutexGuard<'_, Vec<block::Room>> {
        self.rooms.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
    }
}

fn misfit(window: Window) -> FilmError {
    FilmError::Inconsistent { reason: format!("{window:?} does not continue the picture") }
}

/// The film as the bytes of an EXR file: its planes over its window.
///
/// # Errors
///
/// [`FilmError::Inconsistent`] for a broken film.
pub fn encode_exr(film: &Film) -> Result<Vec<u8>, FilmError> {
    let layout = ExrLayout::new(film, film.window)?;
    let rows = layout.compress(film)?;
    let mut bytes = Cursor::new(Vec::new());
    let failed = |error: std::io::Error| {
        let reason = error.to_string();
        FilmError::Encode { format: "EXR", reason }
    };
    let mut writer = ExrWriter::new(&layout, &mut bytes).map_err(failed)?;
    writer.append(&rows).map_err(failed)?;
    writer.finish().map_err(failed)?;
    Ok(bytes.into_inner())
}

/// EXR orders channels by the bytes of their names.
fn in_order(film: &Film) -> Vec<&Plane> {
    let mut planes: Vec<&Plane> = film.planes.iter().collect();
    planes.sort_unstable_by(|a, b| a.name.as_bytes().cmp(b.name.as_bytes()));
    planes
}

fn sample_type(plane: &Plane) -> SampleType {
    match plane.samples {
        Samples::Float(_) => SampleType::F32,
        Samples::Uint(_) => SampleType::U32,
    }
}

/// The header: channels, windows, compression and attributes.
fn describe(film: &Film, planes: &[&Plane], window: Window) -> Header {
    let channels = planes.iter().map(|plane| ChannelDescription {
        name: utf8(&plane.name),
        sample_type: sample_type(plane),
        quantize_linearly: false,
        sampling: Vec2(1, 1),
    });
    let frame = Vec2(film.resolution.width() as usize, film.resolution.height() as usize);
    let size = Vec2(window.width() as usize, window.height() as usize);
    // A pixel coordinate is at most MAX_SIDE, far inside an i32.
    let position = Vec2(window.x0() as i32, window.y0() as i32);
    let description = AttributeValue::Text(utf8(&film.description));

    let mut image = ImageAttributes::new(IntegerBounds::new(Vec2(0, 0), frame));
    image.chromaticities = Some(REC_709);
    let layer = LayerAttributes {
        layer_position: position,
        other: [(utf8(DESCRIPTION), description)].into(),
        ..LayerAttributes::default()
    };
    Header::new(utf8(""), size, channels.collect())
        .with_encoding(Compression::ZIP16, BlockDescription::ScanLines, LineOrder::Increasing)
        .with_shared_attributes(image)
        .with_attributes(layer)
}

/// Text as its UTF-8 bytes; the crate's own conversion would turn them to Latin-1 or panic.
fn utf8(text: &str) -> Text {
    Text::from_slice_unchecked(text.as_bytes())
}
