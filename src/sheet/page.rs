//! A sheet's pixels: the cells as they are, texts around them, on a dark grey that stands out from
//! light and dark pages alike and from the black of most backgrounds.

use super::layout::{LABEL_GAP, Layout, MARGIN, Texts};
use super::{RenderedCell, Sheet};
use crate::drawing::glyphs;
use image::{Rgb, RgbImage, imageops};

/// Paper.
const PAPER: [u8; 3] = [40, 44, 52];
/// Title.
const TITLE: [u8; 3] = [255, 255, 255];
/// Labels.
const LABEL: [u8; 3] = [208, 214, 222];

/// How a line stands in its room.
#[derive(Clone, Copy)]
enum Align {
    Left,
    Middle,
    Right,
}

/// Lays the rendered cells of a sheet out.
pub fn compose(sheet: &Sheet, cells: &[RenderedCell]) -> RgbImage {
    let layout = Layout::of(sheet);
    let [width, height] = layout.size;
    let mut page = RgbImage::from_pixel(width, height, Rgb(PAPER));
    for text in 0..layout.title.lines.len() {
        let room = [MARGIN, width - 2 * MARGIN];
        draw(&mut page, &layout.title, text, room, MARGIN, Align::Left, TITLE);
    }
    let [place_width, place_height] = layout.place;
    for (column, &left) in layout.lefts.iter().enumerate().take(sheet.column_labels.len()) {
        let room = [left, place_width];
        // Labels of fewer lines stand next to the cells, not next to the title.
        let missing = layout.tops.first().map_or(0, |top| {
            let lines = layout.column_labels.lines[column].len();
            (top - LABEL_GAP)
                .saturating_sub(layout.column_labels_top + layout.column_labels.height(lines))
        });
        let top = layout.column_labels_top + missing;
        draw(&mut page, &layout.column_labels, column, room, top, Align::Middle, LABEL);
    }
    for (row, &top) in layout.tops.iter().enumerate().take(sheet.row_labels.len()) {
        let left = layout.lefts.first().copied().unwrap_or(MARGIN);
        let room = [MARGIN, left.saturating_sub(MARGIN + super::layout::GAP)];
        let height = layout.row_labels.height(layout.row_labels.lines[row].len());
        let top = top + place_height.saturating_sub(height) / 2;
        draw(&mut page, &layout.row_labels, row, room, top, Align::Right, LABEL);
    }
    for (index, cell) in cells.iter().enumerate() {
        let (left, top) = (layout.lefts[index % sheet.columns], layout.tops[index / sheet.columns]);
        let x = left + (place_width - cell.picture.width().min(place_width)) / 2;
        let y = top + (place_height - cell.picture.height().min(place_height)) / 2;
        imageops::replace(&mut page, &cell.picture, i64::from(x), i64::from(y));
        let below = top + place_height + LABEL_GAP;
        draw(
            &mut page,
            &layout.cell_labels,
            index,
            [left, place_width],
            below,
            Align::Middle,
            LABEL,
        );
    }
    page
}

/// Draws the lines of one text from `top` downwards in a room given by its left edge and width.
fn draw(
    page: &mut RgbImage,
    texts: &Texts,
    text: usize,
    [left, width]: [u32; 2],
    top: u32,
    align: Align,
    ink: [u8; 3],
) {
    for (number, line) in texts.lines[text].iter().enumerate() {
        let spare = width.saturating_sub(glyphs::text_width(line, texts.scale));
        let x = left
            + match align {
                Align::Left => 0,
                Align::Middle => spare / 2,
                Align::Right => spare,
            };
        let y = top + number as u32 * texts.line_height();
        glyphs::draw_text(page, (x, y), line, texts.scale, ink);
    }
}
