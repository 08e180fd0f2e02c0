//! An EXR file, written as its rows come.
//!
//! What stands before the blocks is what the `exr` crate writes; blocks follow from the top down,
//! and the table of their places is filled in at the end. Nothing is held of what was written.

use std::io::{Cursor, Error, Seek, SeekFrom, Write};

use ::exr::block::chunk::{Chunk, CompressedBlock, CompressedScanLineBlock};
use ::exr::block::writer::ChunksWriter;

use super::{BLOCK_ROWS, ExrLayout, ExrRows, misfit};
use crate::pixel::Window;

/// Bytes of an entry of the table of blocks.
const ENTRY: usize = size_of::<u64>();

/// Writes a picture from the top down.
#[derive(Debug)]
pub struct ExrWriter<W> {
    out: W,
    window: Window,
    /// The row that comes next.
    next_row: u32,
    /// Where the table of blocks stands, and what it will say.
    table_at: u64,
    table: Vec<u64>,
    /// Where the next block will stand.
    at: u64,
}

impl<W: Write + Seek> ExrWriter<W> {
    /// Begins a file at the start of `out`.
    ///
    /// # Errors
    ///
    /// The output's.
    pub fn new(layout: &ExrLayout, mut out: W) -> std::io::Result<Self> {
        let head = head(layout)?;
        out.write_all(&head)?;
        let window = layout.window;
        let blocks = (window.height() as usize).div_ceil(BLOCK_ROWS);
        Ok(Self {
            out,
            window,
            next_row: window.y0(),
            table_at: (head.len() - blocks * ENTRY) as u64,
            table: Vec::with_capacity(blocks),
            at: head.len() as u64,
        })
    }

    /// Writes the next rows.
    ///
    /// # Errors
    ///
    /// The output's, or rows that are not the next.
    pub fn append(&mut self, rows: &ExrRows) -> std::io::Result<()> {
        if rows.first != self.next_row {
            return Err(Error::other(format!("row {} is not the next", rows.first)));
        }
        for block in &rows.blocks {
            self.out.write_all(block)?;
            self.table.push(self.at);
            self.at += block.len() as u64;
            let rows = (BLOCK_ROWS as u32).min(self.window.y1() - self.next_row);
            self.next_row += rows;
        }
        Ok(())
    }

    /// Writes the table of blocks; says how many bytes the file has.
    ///
    /// # Errors
    ///
    /// The output's, or an incomplete picture.
    pub fn finish(mut self) -> std::io::Result<u64> {
        if self.next_row != self.window.y1() {
            return Err(Error::other(misfit(self.window)));
        }
        self.out.seek(SeekFrom::Start(self.table_at))?;
        let table: Vec<u8> = self.table.iter().flat_map(|place| place.to_le_bytes()).collect();
        self.out.write_all(&table)?;
        self.out.flush()?;
        Ok(self.at)
    }
}

/// All that stands before the blocks, up to the end of their table. The crate writes it only with the
/// blocks behind it: these are empty here, and cut off again.
fn head(layout: &ExrLayout) -> std::io::Result<Vec<u8>> {
    let mut file = Cursor::new(Vec::new());
    let mut blocks = 0;
    let validate = true;
    let headers = [layout.header.clone()].into_iter().collect();
    ::exr::block::write(&mut file, headers, validate, |_, writer| {
        blocks = writer.total_chunks_count();
        for block in 0..blocks {
            let nothing =
                CompressedScanLineBlock { y_coordinate: 0, compressed_pixels_le: Vec::new() };
            let chunk =
                Chunk { layer_index: 0, compressed_block: CompressedBlock::ScanLine(nothing) };
            writer.write_chunk(block, chunk)?;
        }
        Ok(())
    })
    .map_err(|error| Error::other(error.to_string()))?;
    let mut head = file.into_inner();
    // An empty block is its row and its length, two numbers of four bytes.
    head.truncate(head.len() - blocks * 8);
    Ok(head)
}
