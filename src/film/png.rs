//! 8-bit sRGB PNG: the picture as a screen shows it.
//!
//! Others' id pictures are read here too. Clamps to [0, 1] and counts what it clamped; no tone mapping, no alpha, no dithering.

mod compress;

use ::png::{BitDepth, ColorType};
use rayon::prelude::*;

use super::check::check_film;
use super::read::full_plane;
use super::{Film, FilmError, NumberPlane, Numbers, PackedOrder, Samples};
use crate::color::srgb_code_of_single;

/// How many pixels the clamp to [0, 1] changed. A pixel may count in both.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ClipCount {
    /// Pixels with a channel above 1.
    pub above: u64,
    /// Pixels with a channel below 0.
    pub below: u64,
}

impl ClipCount {
    /// Adds another part of the picture.
    pub fn add(&mut self, other: Self) {
        self.above += other.above;
        self.below += other.below;
    }
}

/// The window's pixels as the bytes of an 8-bit RGB PNG with an sRGB chunk, from the linear planes
/// `R`, `G` and `B`; every other plane is ignored. With it, how much was clipped.
///
/// # Errors
///
/// [`FilmError::Plane`] without those planes, [`FilmError::NotFinite`] for the first infinite or
/// NaN value by rows, [`FilmError::Inconsistent`] for a broken film.
pub fn encode_png(film: &Film) -> Result<(Vec<u8>, ClipCount), FilmError> {
    let (picture, clipped) = srgb_picture(film)?;
    Ok((encode_picture(&picture)?, clipped))
}

/// The picture that [`encode_png`] encodes.
///
/// # Errors
///
/// As [`encode_png`].
pub fn srgb_picture(film: &Film) -> Result<(image::RgbImage, ClipCount), FilmError> {
    let mut codes = Vec::new();
    let clipped = append_codes(film, &mut codes)?;
    let picture = image::RgbImage::from_raw(film.window.width(), film.window.height(), codes);
    let misfit = || FilmError::Encode { format: "PNG", reason: "it has no pixels".to_owned() };
    Ok((picture.ok_or_else(misfit)?, clipped))
}

/// Appends the sRGB codes of a film's pixels by rows, three each, and counts what was clipped.
///
/// # Errors
///
/// As [`encode_png`].
pub fn append_codes(film: &Film, codes: &mut Vec<u8>) -> Result<ClipCount, FilmError> {
    check_film(film)?;
    let planes = [float_plane(film, "R")?, float_plane(film, "G")?, float_plane(film, "B")?];
    let width = film.window.width() as usize;

    // Encode by rows; the counts come back in row order, so the first fault is the topmost one.
    let before = codes.len();
    codes.resize(before + film.window.len() * 3, 0);
    let rows: Vec<Result<ClipCount, Unencodable>> = codes[before..]
        .par_chunks_mut(width * 3)
        .enumerate()
        .map(|(row, codes)| {
            let range = row * width..(row + 1) * width;
            encode_row(planes.map(|plane| &plane[range.clone()]), codes)
        })
        .collect();

    let mut clipped = ClipCount::default();
    for (row, counted) in (film.window.y0()..).zip(rows) {
        let counted = counted.map_err(|fault| FilmError::NotFinite {
            plane: ["R", "G", "B"][fault.channel],
            x: film.window.x0() + fault.column as u32,
            y: row,
            value: fault.value,
        })?;
        clipped.add(counted);
    }
    Ok(clipped)
}

/// An 8-bit sRGB picture, as it is, as the bytes of a PNG with an sRGB chunk.
///
/// # Errors
///
/// [`FilmError::Encode`] for an empty picture.
pub fn encode_picture(picture: &image::RgbImage) -> Result<Vec<u8>, FilmError> {
    compress::encode(picture.width(), picture.height(), picture.as_raw())
        .map_err(|reason| FilmError::Encode { format: "PNG", reason })
}

fn float_plane<'film>(film: &'film Film, name: &'static str) -> Result<&'film [f32], FilmError> {
    match film.plane(name) {
        Some(Samples::Float(values)) => Ok(values),
        _ => Err(FilmError::Plane { format: "PNG", plane: name, wanted: "floats" }),
    }
}

/// A value without a code, by its place in the row.
struct Unencodable {
    column: usize,
    channel: usize,
    value: f32,
}

fn encode_row(planes: [&[f32]; 3], codes: &mut [u8]) -> Result<ClipCount, Unencodable> {
    // Each question is asked of the whole row, which compilers answer many pixels at a time.
    if let Some(fault) = first_fault(planes) {
        return Err(fault);
    }
    for (channel, plane) in planes.into_iter().enumerate() {
        for (pixel, &value) in codes.as_chunks_mut::<3>().0.iter_mut().zip(plane) {
            pixel[channel] = srgb_code_of_single(value);
        }
    }
    let [r, g, b] = planes;
    let pixels = || r.iter().zip(g).zip(b);
    let above = pixels().map(|((&r, &g), &b)| u32::from((r > 1.0) | (g > 1.0) | (b > 1.0))).sum();
    let below = pixels().map(|((&r, &g), &b)| u32::from((r < 0.0) | (g < 0.0) | (b < 0.0))).sum();
    let [above, below]: [u32; 2] = [above, below];
    Ok(ClipCount { above: above.into(), below: below.into() })
}

/// The first value of a row without a code, by columns.
fn first_fault(planes: [&[f32]; 3]) -> Option<Unencodable> {
    let all = planes.map(|plane| plane.iter().fold(true, |all, value| all & value.is_finite()));
    if all == [true; 3] {
        return None;
    }
    (0..planes[0].len()).find_map(|column| {
        let channel = planes.iter().position(|plane| !plane[column].is_finite())?;
        Some(Unencodable { column, channel, value: planes[channel][column] })
    })
}

/// No byte of a deflate stream stands for more bytes (zlib's documentation gives 1032).
const DEFLATE_AT_MOST: usize = 1032;

/// Ids from a PNG: 8-bit RGB packed to 24 bits (alpha is ignored), or 8- or 16-bit grey as it is.
pub(super) fn decode_png_ids(bytes: &[u8], order: PackedOrder) -> Result<NumberPlane, String> {
    let decoder = ::png::Decoder::new(std::io::Cursor::new(bytes));
    let mut reader = decoder.read_info().map_err(|error| error.to_string())?;
    let size = reader.output_buffer_size().ok_or("its size does not fit the memory")?;
    if size / DEFLATE_AT_MOST > bytes.len() {
        return Err("it is cut short".to_owned());
    }
    let mut codes = vec![0; size];
    let frame = reader.next_frame(&mut codes).map_err(|error| error.to_string())?;
    codes.truncate(frame.buffer_size());
    let packed = |pixel: &[u8]| {
        let [r, g, b] = [pixel[0], pixel[1], pixel[2]].map(i64::from);
        match order {
            PackedOrder::RedFirst => r << 16 | g << 8 | b,
            PackedOrder::BlueFirst => b << 16 | g << 8 | r,
        }
    };
    let ids = match (frame.color_type, frame.bit_depth) {
        (ColorType::Rgb, BitDepth::Eight) => codes.chunks_exact(3).map(packed).collect(),
        (ColorType::Rgba, BitDepth::Eight) => codes.chunks_exact(4).map(packed).collect(),
        (ColorType::Grayscale, BitDepth::Eight) => codes.iter().map(|&c| i64::from(c)).collect(),
        (ColorType::Grayscale, BitDepth::Sixteen) => {
            codes.chunks_exact(2).map(|c| i64::from(c[0]) << 8 | i64::from(c[1])).collect()
        }
        (kind, depth) => {
            let found = format!("{kind:?} of {depth:?} bits");
            return Err(format!("it is {found}; ids are 8-bit RGB, or 8- or 16-bit grey"));
        }
    };
    full_plane(u64::from(frame.width), u64::from(frame.height), Numbers::Whole(ids))
}
