//! A sheet: several renders of one scene, or of several, laid out in one labelled picture.
//!
//! A sheet file names scenes and what each cell changes in its scene; every cell is rendered
//! exactly, as `truecast render` does, and its pixels are copied as they are. Nothing is scaled,
//! compared or judged here. A cell's scene is made of text by the scene parser, so that a sheet may
//! set whatever a scene file may say.
//!
//! # Every key
//!
//! Paths of files are relative to the sheet file.
//!
//! | key | default | meaning |
//! |---|---|---|
//! | `version` | must | 1 |
//! | `scene` | each cell's own | the scene of cells that name none |
//! | `columns` | as many as `column_labels` | number of columns; cells fill rows from the left |
//! | `title` | none | text on top |
//! | `row_labels` | none | list of texts, one per row, on the left |
//! | `column_labels` | none | list of texts, one per column, on top |
//! | `size` | each scene's own | table: another size of each cell's image |
//! | `size.width` | must | columns, 1…65536 |
//! | `size.height` | must | rows, 1…65536 |
//! | `cell` | must | list of tables: the cells |
//! | `cell.label` | none | text below the cell |
//! | `cell.scene` | the sheet's `scene` | scene file of this cell |
//! | `cell.set` | none | table: values by the dotted, quoted path of where they stand in the scene, such as `"mesh.0.material" = "brass"`; lists count from 0 |
//!
//! What is set replaces what the scene says or stands where it says nothing, in the order of the
//! file. The table that a path leads into must be there; only one that stands directly in the scene
//! file, such as `switches`, is made where it is missing.

mod cells;
mod file;
pub mod layout;
mod overrides;
mod page;
mod trace;

pub use page::compose;

use crate::color::LinearRgb;
use crate::film::{ClipCount, FilmError, Samples, srgb_picture};
use crate::render::{PlaneGroup, PlaneGroups, Progress, RenderOptions, render};
use crate::scene::Scene;
use image::RgbImage;
use std::time::{Duration, Instant};

/// Largest number of cells.
pub const MAX_CELLS: usize = 1024;

/// Largest number of pixels of a whole sheet: 400 MB of colours.
pub const MAX_PIXELS: u64 = 1 << 27;

/// A sheet, checked, with all its scenes. It has at least one cell and one column; there are as
/// many labels of rows and columns as rows and columns, or none.
#[derive(Clone, Debug)]
pub struct Sheet {
    /// Text on top.
    pub title: Option<String>,
    /// Number of columns.
    pub columns: usize,
    /// Texts on the left.
    pub row_labels: Vec<String>,
    /// Texts above.
    pub column_labels: Vec<String>,
    /// The cells, row by row.
    pub cells: Vec<Cell>,
    /// Things a user should know that are no errors.
    pub warnings: Vec<String>,
}

/// One cell of a sheet.
#[derive(Clone, Debug)]
pub struct Cell {
    /// Text below.
    pub label: Option<String>,
    /// Its scene, with what the cell sets.
    pub scene: Scene,
}

/// A cell's picture and what is to be said about it.
#[derive(Clone, Debug)]
pub struct RenderedCell {
    /// Its pixels, 8-bit sRGB.
    pub picture: RgbImage,
    /// Pixels at which a triangle is visible.
    pub covered_pixels: usize,
    /// Mean radiance over the covered pixels, per channel; `None` when none is covered.
    pub mean_radiance: Option<LinearRgb>,
    /// Largest radiance over the covered pixels, per channel.
    pub max_radiance: Option<LinearRgb>,
    /// How much the PNG's range clipped.
    pub clipped: ClipCount,
    /// Time to render it.
    pub time: Duration,
}

/// A cell whose picture has no 8-bit colours.
#[derive(Debug, thiserror::Error)]
#[error("cell {number}{}: {error}", .label.as_ref().map(|l| format!(" ({l})")).unwrap_or_default())]
pub struct CellError {
    /// The cell, counted from 1.
    pub number: usize,
    /// Its label.
    pub label: Option<String>,
    /// What is wrong.
    pub error: FilmError,
}

/// Announces a cell's stages with the cell's number.
struct CellProgress<'p> {
    progress: &'p dyn Progress,
    number: usize,
    of: usize,
}

impl Progress for CellProgress<'_> {
    fn begin(&self, stage: &str, steps: usize) {
        self.progress.begin(&format!("{}/{} {stage}", self.number, self.of), steps);
    }

    fn step(&self) {
        self.progress.step();
    }
}

impl Sheet {
    /// Renders all cells, one after the other.
    ///
    /// # Errors
    /// [`CellError`] for the first cell with a radiance that is not finite in f32.
    pub fn render(&self, progress: &dyn Progress) -> Result<Vec<RenderedCell>, CellError> {
        let of = self.cells.len();
        let cells = self.cells.iter().zip(1..);
        cells
            .map(|(cell, number)| {
                render_cell(&cell.scene, &CellProgress { progress, number, of })
                    .map_err(|error| CellError { number, label: cell.label.clone(), error })
            })
            .collect()
    }
}

fn render_cell(scene: &Scene, progress: &dyn Progress) -> Result<RenderedCell, FilmError> {
    let started = Instant::now();
    let planes = PlaneGroups::default().with(PlaneGroup::Color);
    let frame = render(scene, &RenderOptions { planes, ..RenderOptions::default() }, progress);
    let (picture, clipped) = srgb_picture(&frame.film)?;
    let floats = |name: &str| match frame.film.plane(name) {
        Some(Samples::Float(values)) => values.as_slice(),
        _ => &[],
    };
    // Sum in row order, so that the mean is the same for any number of threads.
    let covered = floats("A");
    let over_covered = |name: &str, start: f64, fold: fn(f64, f64) -> f64| {
        let values = floats(name).iter().zip(covered).filter(|(_, alpha)| **alpha == 1.0);
        values.fold(start, |so_far, (&value, _)| fold(so_far, f64::from(value)))
    };
    let count = frame.account.covered_pixels;
    let per_channel = |start: f64, fold| {
        (count > 0).then(|| ["R", "G", "B"].map(|name| over_covered(name, start, fold)))
    };
    Ok(RenderedCell {
        picture,
        covered_pixels: count,
        mean_radiance: per_channel(0.0, |sum, value| sum + value)
            .map(|sums| sums.map(|sum| sum / count as f64)),
        max_radiance: per_channel(f64::NEG_INFINITY, f64::max),
        clipped,
        time: started.elapsed(),
    })
}
