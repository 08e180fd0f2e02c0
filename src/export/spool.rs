//! A file of the bundle before it has a name: written to an unnamed temporary file, copied later.
//!
//! An unnamed file vanishes with the program, whatever ends it, so hours of casting can be
//! interrupted without leaving anything. Its price is one copy of every byte.

use super::folder::{Failing, parent_of};
use crate::film::FilmError;
use npyz::WriterBuilder as _;
use std::fs::File;
use std::io::{self, BufWriter, Seek as _, Write};
use std::path::Path;

/// One file of the bundle.
#[derive(Debug)]
pub(super) struct Spool {
    name: &'static str,
    writer: BufWriter<File>,
}

/// An array that is being written.
pub(super) type Array<'a, T> = npyz::NpyWriter<T, &'a mut BufWriter<File>>;

impl Spool {
    /// An empty file, on the disk on which `folder` will be.
    pub(super) fn create(name: &'static str, folder: &Path) -> Result<Self, FilmError> {
        let failing = Failing::new(folder);
        let file = tempfile::tempfile_in(parent_of(&failing.target()?))
            .map_err(|error| failing.because(&error))?;
        Ok(Self { name, writer: BufWriter::new(file) })
    }

    /// The file's name in the bundle.
    pub(super) fn name(&self) -> &'static str {
        self.name
    }

    /// Where its bytes go.
    pub(super) fn file(&mut self) -> &mut impl Write {
        &mut self.writer
    }

    /// Begins an NPY array in C order. `layout` is its little-endian type string.
    pub(super) fn begin_array<T: npyz::Serialize>(
        &mut self,
        shape: &[u64],
        layout: &str,
    ) -> io::Result<Array<'_, T>> {
        let layout: npyz::TypeStr = layout.parse().map_err(io::Error::other)?;
        npyz::WriteOptions::<T>::new()
            .dtype(npyz::DType::Plain(layout))
            .shape(shape)
            .writer(&mut self.writer)
            .begin_nd()
    }

    /// Writes a whole NPY array.
    pub(super) fn write_array<T: npyz::Serialize>(
        &mut self,
        shape: &[u64],
        layout: &str,
        fill: impl FnOnce(&mut Array<'_, T>) -> io::Result<()>,
    ) -> io::Result<()> {
        let mut array = self.begin_array(shape, layout)?;
        fill(&mut array)?;
        array.finish()
    }

    /// Copies it to a named file and hands back its length.
    pub(super) fn copy_to(mut self, path: &Path) -> io::Result<u64> {
        self.writer.flush()?;
        let mut file = self.writer.into_inner().map_err(|error| error.into_error())?;
        file.rewind()?;
        io::copy(&mut file, &mut File::create_new(path)?)
    }
}
