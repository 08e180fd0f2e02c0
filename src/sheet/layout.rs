//! Where everything of a sheet stands, pixels, y downwards.
//!
//! Columns are as wide as the widest cell, rows as high as the highest one plus the labels below;
//! smaller cells stand in the middle of their place. Texts that are too long are broken into lines.
//! The title is twice as large as the labels if it then fits one line.

use super::Sheet;
use crate::drawing::glyphs::{self, HEIGHT, WIDTH};

/// Around everything.
pub const MARGIN: u32 = 16;
/// Between two columns, and between two rows.
pub const GAP: u32 = 12;
/// Between a cell and its labels.
pub const LABEL_GAP: u32 = 8;
/// Below the title.
pub const TITLE_GAP: u32 = 16;
/// Between two lines of a text.
pub const LEADING: u32 = 4;
/// Largest width of the labels of rows.
pub const ROW_LABEL_WIDTH: u32 = 176;

/// Texts of one kind, broken into lines.
#[derive(Clone, Debug, PartialEq)]
pub struct Texts {
    /// Enlargement of the font.
    pub scale: u32,
    /// The lines of each text; none for an empty text.
    pub lines: Vec<Vec<String>>,
}

impl Texts {
    /// Texts broken to fit `width` pixels.
    fn fit<'t>(texts: impl Iterator<Item = &'t str>, width: u32, scale: u32) -> Self {
        let columns = (width / (WIDTH * scale)) as usize;
        let lines = |text: &str| match text.trim() {
            "" => Vec::new(),
            text => glyphs::wrap(text, columns),
        };
        Self { scale, lines: texts.map(lines).collect() }
    }

    /// From the top of a line to the top of the next.
    pub fn line_height(&self) -> u32 {
        HEIGHT * self.scale + LEADING
    }

    /// Height of so many lines.
    pub fn height(&self, lines: usize) -> u32 {
        (lines as u32 * self.line_height()).saturating_sub(LEADING)
    }

    /// Number of lines of the longest of some texts.
    fn most_lines(texts: &[Vec<String>]) -> usize {
        texts.iter().map(Vec::len).max().unwrap_or(0)
    }

    /// Width of the widest line.
    fn width(&self) -> u32 {
        let lines = self.lines.iter().flatten();
        lines.map(|line| glyphs::text_width(line, self.scale)).max().unwrap_or(0)
    }
}

/// Places and sizes of everything on a sheet.
#[derive(Clone, Debug, PartialEq)]
pub struct Layout {
    /// Width and height of the whole.
    pub size: [u32; 2],
    /// Width and height of a cell's place, without its label.
    pub place: [u32; 2],
    /// Left edges of the columns.
    pub lefts: Vec<u32>,
    /// Top edges of the rows.
    pub tops: Vec<u32>,
    /// The title, one text.
    pub title: Texts,
    /// Labels of columns.
    pub column_labels: Texts,
    /// Top edge of the labels of columns.
    pub column_labels_top: u32,
    /// Labels of rows.
    pub row_labels: Texts,
    /// Labels of cells.
    pub cell_labels: Texts,
}

impl Layout {
    /// Lays a sheet out.
    pub fn of(sheet: &Sheet) -> Self {
        let sizes = sheet.cells.iter().map(|cell| cell.scene.camera.resolution());
        let place = sizes.fold([1, 1], |[width, height], size| {
            [size.width().max(width), size.height().max(height)]
        });
        let texts =
            |list: &'_ [String], width| Texts::fit(list.iter().map(String::as_str), width, 1);
        let row_labels = texts(&sheet.row_labels, ROW_LABEL_WIDTH);
        let column_labels = texts(&sheet.column_labels, place[0]);
        let labels = sheet.cells.iter().map(|cell| cell.label.as_deref().unwrap_or_default());
        let cell_labels = Texts::fit(labels, place[0], 1);

        // Columns from the left.
        let mut x = MARGIN;
        if row_labels.width() > 0 {
            x += row_labels.width() + GAP;
        }
        let lefts: Vec<u32> =
            (0..sheet.columns as u32).map(|column| x + column * (place[0] + GAP)).collect();
        let width = x + sheet.columns as u32 * (place[0] + GAP) - GAP + MARGIN;
        let (title, room) = (sheet.title.as_deref(), width - 2 * MARGIN);
        let scale = if title.is_some_and(|t| glyphs::text_width(t, 2) <= room) { 2 } else { 1 };
        let title = Texts::fit(title.into_iter(), room, scale);

        // Rows from the top; a row without labels of cells leaves no room for them.
        let mut y = MARGIN;
        let title_height = title.height(Texts::most_lines(&title.lines));
        if title_height > 0 {
            y += title_height + TITLE_GAP;
        }
        let column_labels_top = y;
        let labels_height = column_labels.height(Texts::most_lines(&column_labels.lines));
        if labels_height > 0 {
            y += labels_height + LABEL_GAP;
        }
        let mut tops = Vec::new();
        for row in cell_labels.lines.chunks(sheet.columns) {
            tops.push(y);
            y += place[1] + GAP;
            let height = cell_labels.height(Texts::most_lines(row));
            if height > 0 {
                y += LABEL_GAP + height;
            }
        }
        let height = y - GAP + MARGIN;
        Self {
            size: [width, height],
            place,
            lefts,
            tops,
            title,
            column_labels,
            column_labels_top,
            row_labels,
            cell_labels,
        }
    }
}
