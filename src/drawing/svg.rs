//! A drawing as SVG text.
//!
//! Fonts differ between machines; `textLength` holds every text to the width that it has in the
//! pixel version.

use super::{Anchor, Drawing, Ink, Mark, Point, glyphs};
use std::fmt::Write as _;

/// Font size, page units, whose monospaced advance (0.6 of it) is about [`glyphs::WIDTH`].
const FONT_SIZE: f64 = 14.0;

/// From the vertical middle of a text to its base line: half a capital's height.
const BASE_LINE: f64 = 0.35 * FONT_SIZE;

impl Drawing {
    /// The drawing as an SVG document.
    pub fn to_svg(&self) -> String {
        let (width, height) = (self.width, self.height);
        let mut svg = format!(
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
             <svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" font-family=\"monospace\" \
             font-size=\"{FONT_SIZE}\">\n\
             <rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n"
        );
        for mark in &self.marks {
            svg += &element(mark);
            svg.push('\n');
        }
        svg += "</svg>\n";
        svg
    }
}

fn element(mark: &Mark) -> String {
    match mark {
        Mark::Polyline { points, ink, width } => format!(
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{width}\" \
             stroke-linejoin=\"round\" stroke-linecap=\"round\"/>",
            list(points),
            color(*ink)
        ),
        Mark::Polygon { points, ink } => {
            format!("<polygon points=\"{}\" fill=\"{}\"/>", list(points), color(*ink))
        }
        Mark::Dot { center: [x, y], radius, ink } => {
            format!("<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{radius}\" fill=\"{}\"/>", color(*ink))
        }
        Mark::Text { at: [x, y], anchor, ink, text } => {
            let anchor = match anchor {
                Anchor::Start => "start",
                Anchor::Middle => "middle",
                Anchor::End => "end",
            };
            format!(
                "<text x=\"{x:.2}\" y=\"{:.2}\" text-anchor=\"{anchor}\" fill=\"{}\" \
                 textLength=\"{}\" lengthAdjust=\"spacingAndGlyphs\">{}</text>",
                y + BASE_LINE,
                color(*ink),
                glyphs::text_width(text, 1),
                escaped(text)
            )
        }
    }
}

fn color([r, g, b]: Ink) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

fn list(points: &[Point]) -> String {
    let mut text = String::new();
    for [x, y] in points {
        let _ = write!(text, "{x:.2},{y:.2} ");
    }
    text.truncate(text.trim_end().len());
    text
}

/// The text with XML's own characters replaced; characters that XML cannot hold become U+FFFD.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => escaped += "&amp;",
            '<' => escaped += "&lt;",
            '>' => escaped += "&gt;",
            '"' => escaped += "&quot;",
            '\u{FFFE}' | '\u{FFFF}' => escaped.push('\u{FFFD}'),
            other if other.is_control() => escaped.push('\u{FFFD}'),
            other => escaped.push(other),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_cannot_break_the_document() {
        assert_eq!(escaped("a<b> & \"c\"\u{0}"), "a&lt;b&gt; &amp; &quot;c&quot;\u{FFFD}");
    }

    #[test]
    fn every_mark_is_one_element() {
        let mut drawing = Drawing::new(40, 30);
        drawing.arrow([1.0, 2.0], [11.0, 2.0], [255, 0, 16], 1.0);
        drawing.dot([3.0, 4.0], 2.5, [0; 3]);
        drawing.text([5.0, 6.0], Anchor::End, [0; 3], "n&m");
        let svg = drawing.to_svg();
        assert!(svg.contains("points=\"1.00,2.00 6.00,2.00\" fill=\"none\" stroke=\"#ff0010\""));
        assert!(svg.contains("<polygon points=\"11.00,2.00 6.00,4.20 6.00,-0.20\""));
        assert!(svg.contains("<circle cx=\"3.00\" cy=\"4.00\" r=\"2.5\""));
        assert!(svg.contains("textLength=\"24\" lengthAdjust=\"spacingAndGlyphs\">n&amp;m</text>"));
    }
}
