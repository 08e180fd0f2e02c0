//! The files of a render, encoded band by band while it goes on.

use super::Written;
use crate::cli::failure::Failure;
use crate::cli::output::{self, Writing};
use std::io::Cursor;
use std::path::PathBuf;
use std::time::{Duration, Instant};
use truecast::film::{
    ClipCount, ExrFilm, Film, FilmError, Format, Plane, Samples, append_codes, encode_npy_ids,
    encode_picture,
};
use truecast::pixel::{Resolution, Window};
use truecast::render::PlaneGroup;

/// What has been encoded so far, for each format that is asked for, and what was counted.
pub(super) struct Outputs<'a> {
    targets: &'a [(PathBuf, Format)],
    resolution: Resolution,
    window: Window,
    exr: Option<ExrFilm>,
    codes: Vec<u8>,
    clipped: ClipCount,
    ids: Vec<u32>,
    /// How many pixels are brighter than f32 can hold.
    pub(super) infinite: usize,
    /// How many pixels have a bit in the plane `invalid`, if it was asked for.
    pub(super) invalid: Option<usize>,
    /// Time spent here, but not in writing files.
    pub(super) encoding: Duration,
}

impl<'a> Outputs<'a> {
    pub(super) fn new(
        targets: &'a [(PathBuf, Format)],
        resolution: Resolution,
        window: Window,
    ) -> Self {
        Self {
            targets,
            resolution,
            window,
            exr: None,
            codes: Vec::new(),
            clipped: ClipCount::default(),
            ids: Vec::new(),
            infinite: 0,
            invalid: None,
            encoding: Duration::ZERO,
        }
    }

    fn count_of(&self, wanted: Format) -> usize {
        self.targets.iter().filter(|&&(_, format)| format == wanted).count()
    }

    /// Takes the next band of the window.
    pub(super) fn append(&mut self, band: &Film) -> Result<(), FilmError> {
        let started = Instant::now();
        if self.count_of(Format::Exr) > 0 {
            let exr = match self.exr.take() {
                Some(exr) => exr,
                None => ExrFilm::new(band, self.window)?,
            };
            self.exr.insert(exr).append(band)?;
        }
        if self.count_of(Format::Png) > 0 {
            self.clipped.add(append_codes(band, &mut self.codes)?);
        }
        if let (true, Some(Samples::Uint(ids))) =
            (self.count_of(Format::Npy) > 0, band.plane("id.prim"))
        {
            self.ids.extend(ids);
        }
        self.infinite += band.infinite_pixels();
        if let Some(Samples::Uint(bits)) = band.plane(PlaneGroup::Invalid.name()) {
            let count = bits.iter().filter(|&&bits| bits != 0).count();
            self.invalid = Some(self.invalid.unwrap_or(0) + count);
        }
        self.encoding += started.elapsed();
        Ok(())
    }

    /// Writes all files; the last band may be the first to show a film that cannot be encoded, so
    /// none is written before.
    pub(super) fn write(&mut self, writing: &Writing) -> Result<Vec<Written>, Failure> {
        let started = Instant::now();
        let (width, height) = (self.window.width(), self.window.height());
        let png = match self.count_of(Format::Png) {
            0 => Vec::new(),
            _ => {
                let codes = std::mem::take(&mut self.codes);
                let picture = image::RgbImage::from_raw(width, height, codes);
                let misfit = "rows are missing".to_owned();
                encode_picture(&picture.ok_or(FilmError::Inconsistent { reason: misfit })?)?
            }
        };
        let npy = match self.count_of(Format::Npy) {
            0 => Vec::new(),
            _ => self.encode_ids()?,
        };
        // One EXR file goes to the disk as it stands; of several, the bytes are put together once.
        let mut exr = self.exr.take();
        let mut exr_bytes = Cursor::new(Vec::new());
        if self.count_of(Format::Exr) > 1
            && let Some(exr) = exr.take()
        {
            exr.write(&mut exr_bytes).map_err(|error| {
                let reason = error.to_string();
                FilmError::Encode { format: "EXR", reason }
            })?;
        }
        self.encoding += started.elapsed();
        let mut written = Vec::new();
        for (path, format) in self.targets {
            let (bytes, clipped) = match format {
                Format::Png => (&png, Some(self.clipped)),
                Format::Npy => (&npy, None),
                Format::Exr => (exr_bytes.get_ref(), None),
            };
            let length = match (format, exr.take_if(|_| *format == Format::Exr)) {
                (Format::Exr, Some(exr)) => {
                    output::save_with(writing, path, |file| exr.write(file))?
                }
                _ => {
                    output::save(writing, path, bytes)?;
                    bytes.len()
                }
            };
            written.push(Written { path: path.clone(), bytes: length, clipped });
        }
        Ok(written)
    }

    fn encode_ids(&mut self) -> Result<Vec<u8>, FilmError> {
        let samples = Samples::Uint(std::mem::take(&mut self.ids));
        encode_npy_ids(&Film {
            resolution: self.resolution,
            window: self.window,
            planes: vec![Plane { name: "id.prim".to_owned(), samples }],
            description: String::new(),
        })
    }
}
