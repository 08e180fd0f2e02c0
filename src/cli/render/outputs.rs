//! The files of a render, encoded band by band while it goes on.
//!
//! Bands are encoded side by side and taken from the top down. EXR files grow as they come; PNG and
//! NPY wait for the last, and no file shows before all are whole.

use super::Written;
use crate::cli::failure::Failure;
use crate::cli::output::{self, Writing};
use std::fs::File;
use std::path::PathBuf;
use std::sync::OnceLock;
use std::time::{Duration, Instant};
use truecast::film::{
    AtomicFile, ClipCount, ExrLayout, ExrRows, ExrWriter, Film, FilmError, Format, Plane, Samples,
    append_codes, encode_npy_ids, encode_picture,
};
use truecast::pixel::{Resolution, Window};
use truecast::render::PlaneGroup;

/// What is asked for, and what the bands of a picture share.
pub(super) struct Encoder<'a> {
    targets: &'a [(PathBuf, Format)],
    resolution: Resolution,
    window: Window,
    /// As the first band shows it.
    exr: OnceLock<ExrLayout>,
}

/// A band as the files hold it, and what was counted.
pub(super) struct EncodedBand {
    exr: Option<ExrRows>,
    codes: Vec<u8>,
    clipped: ClipCount,
    ids: Vec<u32>,
    infinite: usize,
    invalid: Option<usize>,
    time: Duration,
}

impl<'a> Encoder<'a> {
    pub(super) const fn new(
        targets: &'a [(PathBuf, Format)],
        resolution: Resolution,
        window: Window,
    ) -> Self {
        Self { targets, resolution, window, exr: OnceLock::new() }
    }

    fn has(&self, wanted: Format) -> bool {
        self.targets.iter().any(|&(_, format)| format == wanted)
    }

    /// Encodes a band of the window.
    pub(super) fn encode(&self, band: &Film) -> Result<EncodedBand, FilmError> {
        let started = Instant::now();
        let exr = match self.has(Format::Exr) {
            true => Some(self.exr_layout(band)?.compress(band)?),
            false => None,
        };
        let mut codes = Vec::new();
        let clipped = match self.has(Format::Png) {
            true => append_codes(band, &mut codes)?,
            false => ClipCount::default(),
        };
        let ids = match band.plane("id.prim") {
            Some(Samples::Uint(ids)) if self.has(Format::Npy) => ids.clone(),
            _ => Vec::new(),
        };
        let invalid = match band.plane(PlaneGroup::Invalid.name()) {
            Some(Samples::Uint(bits)) => Some(bits.iter().filter(|&&bits| bits != 0).count()),
            _ => None,
        };
        let infinite = band.infinite_pixels();
        Ok(EncodedBand { exr, codes, clipped, ids, infinite, invalid, time: started.elapsed() })
    }

    fn exr_layout(&self, band: &Film) -> Result<&ExrLayout, FilmError> {
        if let Some(layout) = self.exr.get() {
            return Ok(layout);
        }
        let layout = ExrLayout::new(band, self.window)?;
        Ok(self.exr.get_or_init(|| layout))
    }
}

/// A path, the file that will stand there, and who writes it.
type OpenExr = (PathBuf, AtomicFile, ExrWriter<File>);

/// Completes and shows files.
fn show(writing: &Writing, files: Vec<OpenExr>) -> Result<Vec<Written>, FilmError> {
    let finish = |(path, mut file, writer): OpenExr| {
        let length = file.with(|_| writer.finish())?;
        output::finish(writing, file)?;
        Ok(Written { path, bytes: usize::try_from(length).unwrap_or(usize::MAX), clipped: None })
    };
    files.into_iter().map(finish).collect()
}

/// The files so far, and what was counted.
pub(super) struct Outputs<'a> {
    encoder: &'a Encoder<'a>,
    writing: &'a Writing,
    /// Each EXR file with its path.
    exr: Vec<OpenExr>,
    codes: Vec<u8>,
    clipped: ClipCount,
    ids: Vec<u32>,
    /// How many pixels are brighter than f32 can hold.
    pub(super) infinite: usize,
    /// How many pixels have a bit in the plane `invalid`, if it was asked for.
    pub(super) invalid: Option<usize>,
    /// Time that was spent on encoding: that of bands over the number of threads, then that of the rest.
    pub(super) encoding: Duration,
    /// Time that was spent on writing, likewise.
    pub(super) writing_time: Duration,
}

impl<'a> Outputs<'a> {
    pub(super) const fn new(encoder: &'a Encoder<'a>, writing: &'a Writing) -> Self {
        Self {
            encoder,
            writing,
            exr: Vec::new(),
            codes: Vec::new(),
            clipped: ClipCount { above: 0, below: 0 },
            ids: Vec::new(),
            infinite: 0,
            invalid: None,
            encoding: Duration::ZERO,
            writing_time: Duration::ZERO,
        }
    }

    /// Takes the next band of the window.
    pub(super) fn append(&mut self, band: EncodedBand) -> Result<(), FilmError> {
        let started = Instant::now();
        if let (Some(rows), Some(layout)) = (&band.exr, self.encoder.exr.get()) {
            if self.exr.is_empty() {
                self.begin_exr(layout)?;
            }
            for (_, file, writer) in &mut self.exr {
                file.with(|_| writer.append(rows))?;
            }
        }
        if self.codes.is_empty() && !band.codes.is_empty() {
            self.codes.reserve_exact(3 * self.encoder.window.len());
        }
        self.codes.extend_from_slice(&band.codes);
        self.ids.extend(band.ids);
        self.clipped.add(band.clipped);
        self.infinite += band.infinite;
        if let Some(count) = band.invalid {
            self.invalid = Some(self.invalid.unwrap_or(0) + count);
        }
        let threads = u32::try_from(rayon::current_num_threads()).unwrap_or(1);
        self.encoding += band.time / threads;
        self.writing_time += started.elapsed() / threads;
        Ok(())
    }

    fn begin_exr(&mut self, layout: &ExrLayout) -> Result<(), FilmError> {
        for (path, format) in self.encoder.targets {
            if *format == Format::Exr {
                let mut file = output::begin(self.writing, path)?;
                let writer = file.with(|file| ExrWriter::new(layout, file.try_clone()?))?;
                self.exr.push((path.clone(), file, writer));
            }
        }
        Ok(())
    }

    /// Writes what is left, and shows all files. The last band may be the first to show a film that
    /// cannot be encoded, so none is shown before.
    pub(super) fn write(&mut self) -> Result<Vec<Written>, Failure> {
        let started = Instant::now();
        let codes = std::mem::take(&mut self.codes);
        let npy = match self.encoder.has(Format::Npy) {
            false => Vec::new(),
            true => self.encode_ids()?,
        };
        // To show a file in place of another may take as long as encoding a PNG: file systems bring the
        // new one to the disk first.
        let exr = std::mem::take(&mut self.exr);
        let writing = self.writing;
        let (exr, png) = rayon::join(|| show(writing, exr), || self.encode_png(codes));
        let (mut exr, png) = (exr?.into_iter(), png?);
        let encoded = Instant::now();
        self.encoding += encoded - started;
        let mut written = Vec::new();
        for (path, format) in self.encoder.targets {
            let (bytes, clipped) = match format {
                Format::Exr => {
                    written.extend(exr.next());
                    continue;
                }
                Format::Png => (&png, Some(self.clipped)),
                Format::Npy => (&npy, None),
            };
            output::save(self.writing, path, bytes)?;
            written.push(Written { path: path.clone(), bytes: bytes.len(), clipped });
        }
        self.writing_time += encoded.elapsed();
        Ok(written)
    }

    fn encode_png(&self, codes: Vec<u8>) -> Result<Vec<u8>, FilmError> {
        if !self.encoder.has(Format::Png) {
            return Ok(Vec::new());
        }
        let (width, height) = (self.encoder.window.width(), self.encoder.window.height());
        let picture = image::RgbImage::from_raw(width, height, codes);
        let misfit = "rows are missing".to_owned();
        encode_picture(&picture.ok_or(FilmError::Inconsistent { reason: misfit })?)
    }

    fn encode_ids(&mut self) -> Result<Vec<u8>, FilmError> {
        let samples = Samples::Uint(std::mem::take(&mut self.ids));
        encode_npy_ids(&Film {
            resolution: self.encoder.resolution,
            window: self.encoder.window,
            planes: vec![Plane { name: "id.prim".to_owned(), samples }],
            description: String::new(),
        })
    }
}
