//! OpenEXR: one part, scan lines, ZIP in blocks of 16 rows, every plane bit for bit.
//!
//! The same film gives the same bytes for any number of threads: blocks are compressed in parallel,
//! each from its own rows alone, and written from the top down. For the same reason there is no
//! date and exactly one attribute of our own: the `exr` crate writes such attributes in the order of
//! a hash map, which differs between runs. Tiles, deep samples and several parts are not written.
//!
//! Compression is our own (`deflate`), for the crate's takes 7 times as long: a frame of 1920 × 1080
//! costs 0.27 core seconds with 25 planes, half of it in the encoder.

mod block;
mod decode;

pub use decode::decode_exr;

use std::io::{Cursor, Seek, Write};

use ::exr::block::chunk::{Chunk, CompressedBlock, CompressedScanLineBlock};
use ::exr::block::writer::ChunksWriter;
use ::exr::compression::Compression;
use ::exr::error::Error;
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

/// A film as an EXR file holds it, as far as its rows have come: everything but the table of blocks.
#[derive(Debug)]
pub struct ExrFilm {
    header: Header,
    /// Type and name of each plane, in the file's order.
    planes: Vec<(String, SampleType)>,
    /// Blocks from the top down.
    chunks: Vec<Chunk>,
    /// Rows that have come.
    rows: usize,
}

impl ExrFilm {
    /// An empty picture of `window` with the planes and description of `band`, which is a part of
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
        Ok(Self { header, planes: names, chunks: Vec::new(), rows: 0 })
    }

    /// Compresses the next rows of the picture, in parallel. All bands but the last have a multiple
    /// of 16 rows.
    ///
    /// # Errors
    ///
    /// [`FilmError::Inconsistent`] for a broken film, or a band that does not continue the picture.
    pub fn append(&mut self, band: &Film) -> Result<(), FilmError> {
        check_film(band)?;
        let planes = in_order(band);
        let names = planes.iter().map(|plane| (plane.name.as_str(), sample_type(plane)));
        let (width, height) = (band.window.width() as usize, band.window.height() as usize);
        let top = self.header.own_attributes.layer_position.y() as usize + self.rows;
        let fits = names.eq(self.planes.iter().map(|(name, kind)| (name.as_str(), *kind)))
            && width == self.header.layer_size.width()
            && band.window.y0() as usize == top
            && self.rows.is_multiple_of(BLOCK_ROWS);
        if !fits {
            let reason = format!("{:?} does not continue the picture", band.window);
            return Err(FilmError::Inconsistent { reason });
        }
        let blocks: Vec<usize> = (0..height).step_by(BLOCK_ROWS).collect();
        self.chunks.par_extend(blocks.into_par_iter().map(|first| {
            let rows = first..height.min(first + BLOCK_ROWS);
            let block = CompressedScanLineBlock {
                // A row is at most MAX_SIDE, far inside an i32.
                y_coordinate: (top + first) as i32,
                compressed_pixels_le: block::compress(&planes, width, rows),
            };
            Chunk { layer_index: 0, compressed_block: CompressedBlock::ScanLine(block) }
        }));
        self.rows += height;
        Ok(())
    }

    /// Writes the file.
    ///
    /// # Errors
    ///
    /// The writer's, or an incomplete picture.
    pub fn write(self, out: impl Write + Seek) -> std::io::Result<()> {
        let validate = true;
        let headers = [self.header].into_iter().collect();
        ::exr::block::write(out, headers, validate, |_, writer| {
            for (position, chunk) in self.chunks.into_iter().enumerate() {
                writer.write_chunk(position, chunk)?;
            }
            Ok(())
        })
        .map_err(|error| match error {
            Error::Io(error) => error,
            other => std::io::Error::other(other.to_string()),
        })
    }
}

/// The film as the bytes of an EXR file, as [`ExrFilm`] has it.
///
/// # Errors
///
/// [`FilmError::Inconsistent`] for a broken film.
pub fn encode_exr(film: &Film) -> Result<Vec<u8>, FilmError> {
    let mut picture = ExrFilm::new(film, film.window)?;
    picture.append(film)?;
    let mut bytes = Cursor::new(Vec::new());
    picture
        .write(&mut bytes)
        .map_err(|error| FilmError::Encode { format: "EXR", reason: error.to_string() })?;
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
