//! EXR back to a film: ours, and what others write as one flat part of scan lines.
//!
//! Planes grow with the rows that were really decoded, so a short file that claims a huge picture
//! is refused before memory is spent on it. Tiles, deep samples, subsampled channels and several
//! parts are refused by name.

use std::io::Cursor;

use ::exr::block::UncompressedBlock;
use ::exr::block::chunk::{Chunk, CompressedBlock};
use ::exr::meta::attribute::{AttributeValue, IntegerBounds, SampleType};
use ::exr::meta::header::Header;
use ::exr::meta::{BlockDescription, MetaData};
use ::exr::prelude::f16;
use rayon::prelude::*;

use super::super::{Film, FilmError, Plane, Samples};
use super::DESCRIPTION;
use crate::pixel::{Resolution, Window};

/// Blocks that are decompressed at a time: enough to keep the threads of a desktop busy, few enough
/// that their bytes (3 MB each for 25 planes of 1920 columns) are small beside the picture's.
const BATCH: usize = 16;

/// The film that an EXR file holds. FLOAT and UINT samples keep their bits, HALF samples become f32
/// (exactly); planes come in the file's order, by name. The description is empty where the file has
/// no string attribute `truecast`.
///
/// # Errors
///
/// [`FilmError::Decode`] when the bytes are no EXR file, are damaged or cut short, or hold what a
/// film cannot: several parts, deep samples, tiles, subsampled channels, a display window that does
/// not start at (0, 0) or does not contain the data window, or a side above 65 536.
pub fn decode_exr(bytes: &[u8]) -> Result<Film, FilmError> {
    let strict = false;
    let reader = ::exr::block::read(Cursor::new(bytes), strict).map_err(damaged)?;
    let meta = reader.meta_data().clone();
    let header = match meta.headers.as_slice() {
        [header] => header,
        _ => return Err(refused("it has several parts; write the wanted part alone")),
    };
    let (resolution, window) = check_header(header)?;

    let mut chunks: Vec<(i32, Chunk)> = Vec::new();
    for chunk in reader.all_chunks(strict).map_err(damaged)? {
        let chunk = chunk.map_err(damaged)?;
        match &chunk.compressed_block {
            CompressedBlock::ScanLine(block) => chunks.push((block.y_coordinate, chunk)),
            _ => return Err(refused("a block is of another kind than the header says")),
        }
    }
    check_blocks(header, window, &mut chunks)?;

    let mut planes = empty_planes(header)?;
    while !chunks.is_empty() {
        let batch: Vec<_> = chunks.drain(..BATCH.min(chunks.len())).collect();
        append_blocks(&meta, batch, &mut planes)?;
    }
    let description = match header.own_attributes.other.get(DESCRIPTION.as_bytes()) {
        Some(AttributeValue::Text(text)) => String::from_utf8_lossy(text.as_slice()).into_owned(),
        _ => String::new(),
    };
    Ok(Film { resolution, window, planes, description })
}

fn refused(reason: &str) -> FilmError {
    FilmError::Decode { reason: reason.to_owned() }
}

fn damaged(error: ::exr::error::Error) -> FilmError {
    FilmError::Decode { reason: error.to_string() }
}

/// The frame and the window, where the header describes something that a film can hold.
fn check_header(header: &Header) -> Result<(Resolution, Window), FilmError> {
    if header.deep {
        return Err(refused("it has deep samples; flatten it first"));
    }
    if header.blocks != BlockDescription::ScanLines {
        return Err(refused("it is tiled; convert it to scan lines first"));
    }
    if header.channels.list.iter().any(|channel| channel.sampling.area() != 1) {
        return Err(refused("a channel is subsampled; convert it to full resolution first"));
    }
    let frame = corners(header.shared_attributes.display_window)
        .filter(|&[x0, y0, _, _]| x0 == 0 && y0 == 0)
        .and_then(|[_, _, x1, y1]| Resolution::new(x1, y1))
        .ok_or_else(|| refused("its display window is not (0, 0) to at most (65536, 65536)"))?;
    let window = corners(header.data_window())
        .and_then(|[x0, y0, x1, y1]| Window::new(frame, x0, y0, x1, y1))
        .ok_or_else(|| refused("its data window is not inside its display window"))?;
    Ok((frame, window))
}

/// `[x0, y0, x1, y1]`, half open; `None` when a coordinate is negative or does not fit.
fn corners(bounds: IntegerBounds) -> Option<[u32; 4]> {
    let x0 = u32::try_from(bounds.position.x()).ok()?;
    let y0 = u32::try_from(bounds.position.y()).ok()?;
    let x1 = x0.checked_add(u32::try_from(bounds.size.x()).ok()?)?;
    let y1 = y0.checked_add(u32::try_from(bounds.size.y()).ok()?)?;
    Some([x0, y0, x1, y1])
}

/// Sorts the blocks from the top down and checks that they tile the window's rows exactly once.
fn check_blocks(
    header: &Header,
    window: Window,
    chunks: &mut [(i32, Chunk)],
) -> Result<(), FilmError> {
    chunks.sort_by_key(|&(row, _)| row);
    let rows_per_block = header.compression.scan_lines_per_block();
    let expected = (window.y0()..window.y1()).step_by(rows_per_block).map(i64::from);
    if chunks.iter().map(|&(row, _)| i64::from(row)).eq(expected) {
        return Ok(());
    }
    Err(refused("rows are missing or there twice"))
}

fn empty_planes(header: &Header) -> Result<Vec<Plane>, FilmError> {
    let mut planes: Vec<Plane> = Vec::with_capacity(header.channels.list.len());
    for channel in &header.channels.list {
        let name = std::str::from_utf8(channel.name.as_slice())
            .map_err(|_| refused("a channel's name is not UTF-8"))?;
        if planes.iter().any(|plane| plane.name == name) {
            return Err(FilmError::Decode { reason: format!("two channels are named `{name}`") });
        }
        let samples = match channel.sample_type {
            SampleType::F16 | SampleType::F32 => Samples::Float(Vec::new()),
            SampleType::U32 => Samples::Uint(Vec::new()),
        };
        planes.push(Plane { name: name.to_owned(), samples });
    }
    Ok(planes)
}

/// Decompresses consecutive blocks in parallel and appends their rows to the planes.
fn append_blocks(
    meta: &MetaData,
    batch: Vec<(i32, Chunk)>,
    planes: &mut [Plane],
) -> Result<(), FilmError> {
    let blocks: Vec<UncompressedBlock> = batch
        .into_par_iter()
        .map(|(_, chunk)| UncompressedBlock::decompress_chunk(chunk, meta, false))
        .collect::<Result<_, _>>()
        .map_err(damaged)?;
    let channels = &meta.headers[0].channels;
    for block in &blocks {
        for line in block.lines(channels) {
            let channel = line.location.channel;
            match (&mut planes[channel].samples, channels.list[channel].sample_type) {
                (Samples::Float(values), SampleType::F16) => {
                    let (halves, _) = line.value.as_chunks();
                    values.extend(halves.iter().map(|&half| f16::from_ne_bytes(half).to_f32()));
                }
                (Samples::Float(values), _) => {
                    let (floats, _) = line.value.as_chunks();
                    values.extend(floats.iter().map(|&float| f32::from_ne_bytes(float)));
                }
                (Samples::Uint(values), _) => {
                    let (integers, _) = line.value.as_chunks();
                    values.extend(integers.iter().map(|&integer| u32::from_ne_bytes(integer)));
                }
            }
        }
    }
    Ok(())
}
