//! The picture of an audit: expected | class | theirs, side by side.

use super::{Class, ForeignReport, Theirs};
use crate::check::picture::{GAP, GAP_COLOR, id_color};
use image::{Rgb, RgbImage};
use std::collections::HashMap;

/// An id that no triangle has.
const UNKNOWN_COLOR: Rgb<u8> = Rgb([255, 255, 255]);

/// The colour in which a pixel of that class is marked; agreeing pixels are not.
pub const fn class_color(class: Class) -> [u8; 3] {
    match class {
        Class::Wrong => [255, 64, 64],
        Class::Missing => [255, 0, 255],
        Class::Extra => [255, 208, 0],
        Class::DepthOff => [0, 224, 255],
        Class::Unstable => [64, 96, 255],
        Class::AllowedTie => [64, 200, 64],
        Class::Agree => [0, 0, 0],
    }
}

/// Draws the three panels. The middle one shows the exact picture darkened, with every finding in
/// the colour of its class. Where they gave no ids, the third repeats the first.
pub fn class_picture(report: &ForeignReport) -> RgbImage {
    let window = report.window;
    let (width, height) = (window.width(), window.height());
    let classes: HashMap<_, _> =
        report.findings.iter().map(|finding| (finding.pixel, finding.class)).collect();
    let mut picture = RgbImage::from_pixel(3 * width + 2 * GAP, height, GAP_COLOR);
    for (index, pixel) in window.pixels().enumerate() {
        let expected = id_color(report.reference.visible[index].map(|visible| visible.triangle));
        let actual = match report.theirs.get(index) {
            None => expected,
            Some(Theirs::Nothing) => id_color(None),
            Some(&Theirs::Triangle(id)) => id_color(Some(id)),
            Some(Theirs::Unknown(_)) => UNKNOWN_COLOR,
        };
        let middle = match classes.get(&pixel) {
            Some(&class) => Rgb(class_color(class)),
            None => Rgb(expected.0.map(|code| code / 4)),
        };
        let (x, y) = (pixel.x - window.x0(), pixel.y - window.y0());
        picture.put_pixel(x, y, expected);
        picture.put_pixel(width + GAP + x, y, middle);
        picture.put_pixel(2 * (width + GAP) + x, y, actual);
    }
    picture
}
