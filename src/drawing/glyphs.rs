//! Text in pixels: an 8×8 bitmap font, twice as high as wide, enlarged by whole factors.
//!
//! The font was drawn for pixels that are higher than wide: its upright strokes are two pixels
//! wide, its level ones a single pixel high. Every row counts twice here, which makes both alike.
//! ASCII, Latin-1 and Greek; any other character is shown as a box, never left out. Every character
//! is equally wide. No kerning, no combining characters. Source of the font: crate `font8x8`.

use font8x8::{BASIC_FONTS, GREEK_FONTS, LATIN_FONTS, UnicodeFonts};
use image::{Rgb, RgbImage};

/// Width of a character at scale 1, pixels.
pub const WIDTH: u32 = 8;

/// Height of a character at scale 1, pixels.
pub const HEIGHT: u32 = 16;

/// What stands for a character that the font lacks.
const BOX: [u8; 8] = [0x7F, 0x41, 0x41, 0x41, 0x41, 0x41, 0x7F, 0x00];

/// The rows of a character from the top; the lowest bit is the leftmost pixel.
pub fn glyph(character: char) -> [u8; 8] {
    [&BASIC_FONTS as &dyn UnicodeFonts, &LATIN_FONTS, &GREEK_FONTS]
        .iter()
        .find_map(|fonts| fonts.get(character))
        .filter(|_| !character.is_control())
        .unwrap_or(BOX)
}

/// Width of a line of text, pixels.
pub fn text_width(text: &str, scale: u32) -> u32 {
    text.chars().count() as u32 * WIDTH * scale
}

/// Calls `pixel` with column and row of every pixel of a line of text whose top left corner is
/// (0, 0).
pub fn for_each_pixel(text: &str, scale: u32, mut pixel: impl FnMut(u32, u32)) {
    for (index, character) in text.chars().enumerate() {
        let rows = glyph(character);
        for y in 0..HEIGHT * scale {
            for x in 0..WIDTH * scale {
                if is_inked(&rows, x, y, scale) {
                    pixel(index as u32 * WIDTH * scale + x, y);
                }
            }
        }
    }
}

/// Draws a line of text with its top left corner at (`left`, `top`); what lies outside the picture
/// is cut off.
pub fn draw_text(
    picture: &mut RgbImage,
    (left, top): (u32, u32),
    text: &str,
    scale: u32,
    ink: [u8; 3],
) {
    for_each_pixel(text, scale, |x, y| {
        if let Some(pixel) = picture.get_pixel_mut_checked(left + x, top + y) {
            *pixel = Rgb(ink);
        }
    });
}

/// Breaks a text at its spaces into lines of at most `columns` characters; a word that is longer
/// is broken too. At least one line.
pub fn wrap(text: &str, columns: usize) -> Vec<String> {
    let columns = columns.max(1);
    let mut lines = vec![String::new()];
    let mut length = 0;
    for word in text.split_whitespace() {
        let letters: Vec<char> = word.chars().collect();
        for (part, piece) in letters.chunks(columns).enumerate() {
            let gap = usize::from(length > 0 && part == 0);
            if length + gap + piece.len() > columns || part > 0 {
                lines.push(String::new());
                length = 0;
            } else if gap > 0 {
                lines.last_mut().into_iter().for_each(|line| line.push(' '));
                length += gap;
            }
            lines.last_mut().into_iter().for_each(|line| line.extend(piece));
            length += piece.len();
        }
    }
    lines
}

/// Whether an enlarged glyph has ink at a pixel. At scale 1 it is the font's bit. At even scales the
/// corners of its steps are cut by the rule of Scale2x (Mazzoleni, 2001), so that slants are no
/// stairs of large squares.
fn is_inked(rows: &[u8; 8], x: u32, y: u32, scale: u32) -> bool {
    let bit = |column: i64, row: i64| {
        let is_inside = (0..8).contains(&column) && (0..16).contains(&row);
        is_inside && rows[row as usize / 2] >> column & 1 == 1
    };
    let (column, row) = (i64::from(x / scale), i64::from(y / scale));
    let own = bit(column, row);
    if scale % 2 == 1 {
        return own;
    }
    let half = scale / 2;
    let side = if x % scale < half { -1 } else { 1 };
    let end = if y % scale < half { -1 } else { 1 };
    let (near_x, far_x) = (bit(column + side, row), bit(column - side, row));
    let (near_y, far_y) = (bit(column, row + end), bit(column, row - end));
    if near_x == near_y && near_x != far_y && near_y != far_x { near_x } else { own }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn characters_that_the_font_lacks_are_boxes() {
        for character in ['漢', '\u{1F600}', '\u{7}', '\n'] {
            assert_eq!(glyph(character), BOX, "{character:?}");
        }
        for character in ['A', 'z', '~', '°', '·', 'θ'] {
            assert!(glyph(character) != BOX && glyph(character) != [0; 8], "{character:?}");
        }
        assert_eq!(glyph(' '), [0; 8]);
    }

    #[test]
    fn an_enlarged_text_covers_what_the_small_one_does() {
        let mut small = vec![];
        for_each_pixel("|H", 1, |x, y| small.push((x, y)));
        let mut large = 0;
        for_each_pixel("|H", 3, |x, y| {
            large += 1;
            assert!(x < 48 && y < 48);
        });
        // Odd scales cut no corners.
        assert_eq!(large, 9 * small.len());
    }

    #[test]
    fn lines_break_at_spaces_and_long_words_anywhere() {
        assert_eq!(wrap("ns 10, ks 0.5", 20), ["ns 10, ks 0.5"]);
        assert_eq!(wrap("ns 10, ks 0.5", 7), ["ns 10,", "ks 0.5"]);
        assert_eq!(wrap("abcdefgh ij", 3), ["abc", "def", "gh", "ij"]);
        assert_eq!(wrap("a abcd", 3), ["a", "abc", "d"]);
        assert_eq!(wrap("", 3), [""]);
        assert_eq!(wrap("ab", 0), ["a", "b"]);
    }
}
