//! A drawing as pixels: lines and areas anti-aliased by tiny-skia, texts in the bitmap font.

use super::{Anchor, Drawing, Ink, Mark, Point, glyphs};
use image::RgbImage;
use tiny_skia::{
    Color, ColorU8, FillRule, LineCap, LineJoin, Paint, Path, PathBuilder, Pixmap, Stroke,
    Transform,
};

impl Drawing {
    /// The drawing with `scale` pixels per page unit. `None` when that is 0 or the picture does not
    /// fit the memory.
    pub fn to_picture(&self, scale: u16) -> Option<RgbImage> {
        let [width, height] =
            [self.width, self.height].map(|side| u32::from(side) * u32::from(scale));
        let mut pixmap = Pixmap::new(width, height)?;
        pixmap.fill(Color::WHITE);
        let transform = Transform::from_scale(f32::from(scale), f32::from(scale));
        for mark in &self.marks {
            match mark {
                Mark::Polyline { points, ink, width } => {
                    let stroke = Stroke {
                        width: *width as f32,
                        line_cap: LineCap::Round,
                        line_join: LineJoin::Round,
                        ..Stroke::default()
                    };
                    if let Some(path) = path(points, false) {
                        pixmap.stroke_path(&path, &paint(*ink), &stroke, transform, None);
                    }
                }
                Mark::Polygon { points, ink } => {
                    if let Some(path) = path(points, true) {
                        pixmap.fill_path(&path, &paint(*ink), FillRule::Winding, transform, None);
                    }
                }
                Mark::Dot { center: [x, y], radius, ink } => {
                    let disc = PathBuilder::from_circle(*x as f32, *y as f32, *radius as f32);
                    if let Some(path) = disc {
                        pixmap.fill_path(&path, &paint(*ink), FillRule::Winding, transform, None);
                    }
                }
                Mark::Text { at, anchor, ink, text } => {
                    draw_text(&mut pixmap, (*at, *anchor), *ink, text, u32::from(scale));
                }
            }
        }
        // The page is opaque, so premultiplied colours are the colours.
        let codes = pixmap.pixels().iter().flat_map(|p| [p.red(), p.green(), p.blue()]).collect();
        RgbImage::from_raw(width, height, codes)
    }
}

fn paint(ink: Ink) -> Paint<'static> {
    let mut paint = Paint { anti_alias: true, ..Paint::default() };
    paint.set_color_rgba8(ink[0], ink[1], ink[2], 255);
    paint
}

fn path(points: &[Point], closed: bool) -> Option<Path> {
    let mut builder = PathBuilder::new();
    for (index, [x, y]) in points.iter().enumerate() {
        match index {
            0 => builder.move_to(*x as f32, *y as f32),
            _ => builder.line_to(*x as f32, *y as f32),
        }
    }
    if closed {
        builder.close();
    }
    builder.finish()
}

/// Sets the pixels of a text, in its place among the marks; what lies outside is cut off.
fn draw_text(pixmap: &mut Pixmap, at: (Point, Anchor), ink: Ink, text: &str, scale: u32) {
    let ([x, y], anchor) = at;
    let width = f64::from(glyphs::text_width(text, 1));
    let left = match anchor {
        Anchor::Start => x,
        Anchor::Middle => x - 0.5 * width,
        Anchor::End => x - width,
    };
    let pixel = |units: f64| (units * f64::from(scale)).round() as i64;
    let (left, top) = (pixel(left), pixel(y - 0.5 * f64::from(glyphs::HEIGHT)));
    let (columns, rows) = (i64::from(pixmap.width()), i64::from(pixmap.height()));
    let color = ColorU8::from_rgba(ink[0], ink[1], ink[2], 255).premultiply();
    let pixels = pixmap.pixels_mut();
    glyphs::for_each_pixel(text, scale, |x, y| {
        let (x, y) = (left + i64::from(x), top + i64::from(y));
        if (0..columns).contains(&x) && (0..rows).contains(&y) {
            pixels[(y * columns + x) as usize] = color;
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::Rgb;

    #[test]
    fn marks_land_where_they_are_drawn() {
        let mut drawing = Drawing::new(40, 30);
        drawing.line(vec![[5.0, 10.0], [35.0, 10.0]], [200, 0, 0], 2.0);
        drawing.dot([20.0, 20.0], 4.0, [0, 0, 200]);
        let picture = drawing.to_picture(2).unwrap();
        assert_eq!(picture.dimensions(), (80, 60));
        assert_eq!(picture.get_pixel(40, 20), &Rgb([200, 0, 0]));
        assert_eq!(picture.get_pixel(40, 40), &Rgb([0, 0, 200]));
        assert_eq!(picture.get_pixel(2, 2), &Rgb([255; 3]));
        // The rim of the disc is anti-aliased: some pixel is neither paper nor ink.
        assert!(picture.pixels().any(|p| p[0] > 0 && p[0] < 255 && p[2] > 200));
        assert!(drawing.to_picture(0).is_none());
    }
}
