//! The goniometric diagram: surface, normal, light and the polar curves of the reflectance.
//!
//! Curves show the mean of the three channels: one curve per term stays readable, and for grey
//! coefficients it is the value itself. A value of 1 is half as long as the normal, as in the CS315
//! laboratory, so that kd + ks = 2 still fits; larger sums halve the scale again.

use super::{Lobe, Reflectance, direction};
use crate::color::LinearRgb;
use crate::drawing::{Anchor, Drawing, Ink, Point};

const WIDTH: u16 = 640;
const HEIGHT: u16 = 492;

/// Where the surface is hit, page units.
const ORIGIN: Point = [320.0, 352.0];

/// Length of the normal, page units.
const UNIT: f64 = 256.0;

/// Viewing angles between two points of a curve, degrees; the peak has points of its own.
const STEP_DEG: f64 = 0.5;

/// Points on each side of the peak, and their distance as a share of its half width.
const PEAK_POINTS: i32 = 24;
const PEAK_STEP: f64 = 0.25;

const TEXT: Ink = [36, 41, 47];
const GRID: Ink = [222, 226, 230];
const FAINT: Ink = [110, 118, 126];
const SURFACE: Ink = [36, 41, 47];
const LIGHT: Ink = [191, 135, 0];
const DIFFUSE: Ink = [9, 105, 218];
const SPECULAR: Ink = [207, 34, 46];
const SUM: Ink = [130, 80, 223];

/// Draws the diagram under a title.
pub fn diagram(reflectance: &Reflectance, light_deg: f64, title: &str) -> Drawing {
    let mut drawing = Drawing::new(WIDTH, HEIGHT);
    let angles = angles(reflectance, light_deg);
    let curve = |term: fn(&super::Sample) -> LinearRgb| -> Vec<[f64; 2]> {
        let values = angles.iter().map(|&angle| (angle, reflectance.at(light_deg, angle)));
        values.map(|(angle, sample)| [angle, mean(term(&sample))]).collect()
    };
    let sum = curve(|sample| sample.sum());
    let scale = scale(sum.iter().map(|[_, value]| *value).fold(0.0, f64::max));

    grid(&mut drawing, scale);
    // The sum lies lowest and widest: where a term vanishes, it still shows beside the other.
    for (points, ink, width) in [
        (&sum, SUM, 4.5),
        (&curve(|sample| sample.diffuse), DIFFUSE, 2.0),
        (&curve(|sample| sample.specular), SPECULAR, 2.0),
    ] {
        let points = points.iter().map(|&[angle, value]| at(angle, value * scale * UNIT));
        drawing.line(points.collect(), ink, width);
    }
    directions(&mut drawing, light_deg);
    captions(&mut drawing, reflectance, light_deg, title, scale);
    drawing
}

/// The point of the page at an angle and a distance from the origin.
fn at(degrees: f64, length: f64) -> Point {
    let [x, y, _] = direction(degrees);
    [ORIGIN[0] + length * x, ORIGIN[1] - length * y]
}

fn mean(color: LinearRgb) -> f64 {
    color.iter().map(|channel| channel / 3.0).sum()
}

/// The length of the value 1, in lengths of the normal: ½, or the next smaller power of ½ at which
/// `largest` is no longer than the normal.
fn scale(largest: f64) -> f64 {
    let mut scale = 0.5;
    while largest * scale > 1.0 {
        scale *= 0.5;
    }
    scale
}

/// Viewing angles of a curve's points, ascending: even steps, and close ones around the peak.
fn angles(reflectance: &Reflectance, light_deg: f64) -> Vec<f64> {
    let steps = (180.0 / STEP_DEG) as i32;
    let mut angles: Vec<f64> = (0..=steps).map(|step| -90.0 + STEP_DEG * f64::from(step)).collect();
    if let Some(peak) = reflectance.peak(light_deg)
        && let Some(width) = peak.half_width_deg.iter().flatten().copied().reduce(f64::min)
    {
        let close = -PEAK_POINTS..=PEAK_POINTS;
        angles.extend(close.map(|step| peak.view_deg + PEAK_STEP * width * f64::from(step)));
    }
    angles.retain(|angle| (-90.0..=90.0).contains(angle));
    angles.sort_by(f64::total_cmp);
    angles
}

/// Half circles at four values, rays every 30°, and what they stand for.
fn grid(drawing: &mut Drawing, scale: f64) {
    for quarter in 1..=4 {
        let radius = UNIT * f64::from(quarter) / 4.0;
        let circle = (-90..=90).map(|degree| at(f64::from(degree), radius));
        drawing.line(circle.collect(), GRID, 1.0);
        let value = f64::from(quarter) / (4.0 * scale);
        drawing.text(
            [ORIGIN[0] + radius, ORIGIN[1] + 14.0],
            Anchor::Middle,
            FAINT,
            format!("{value}"),
        );
    }
    for degree in (-90_i32..=90).step_by(30) {
        let degrees = f64::from(degree);
        drawing.line(vec![ORIGIN, at(degrees, UNIT)], GRID, 1.0);
        let text = format!("{degree}°");
        let [x, y] = at(degrees, UNIT + 24.0);
        // Those of the surface itself stand above its line.
        let lift = if degree.abs() == 90 { 12.0 } else { 0.0 };
        drawing.text([x, y - lift], Anchor::Middle, FAINT, text);
    }
}

/// Surface, normal, light and mirror direction.
fn directions(drawing: &mut Drawing, light_deg: f64) {
    let [x, y] = ORIGIN;
    drawing.line(vec![[x - UNIT - 40.0, y], [x + UNIT + 40.0, y]], SURFACE, 2.0);
    drawing.arrow(ORIGIN, at(0.0, UNIT), SURFACE, 2.0);
    drawing.arrow(ORIGIN, at(-light_deg, UNIT), LIGHT, 2.0);
    drawing.line(vec![ORIGIN, at(light_deg, UNIT)], LIGHT, 1.0);
    drawing.dot(ORIGIN, 4.0, SURFACE);
    // Names stand beside their tips, on the side away from the normal.
    let beside = |degrees: f64, side: f64| {
        let [tip_x, tip_y] = at(degrees, UNIT - 14.0);
        [tip_x + side * 14.0, tip_y]
    };
    let side = if light_deg < 0.0 { 1.0 } else { -1.0 };
    drawing.text(beside(0.0, -side), Anchor::Middle, TEXT, "N");
    drawing.text(beside(-light_deg, side), Anchor::Middle, LIGHT, "L");
    drawing.text(beside(light_deg, -side), Anchor::Middle, LIGHT, "R");
}

/// Title above, legend below.
fn captions(
    drawing: &mut Drawing,
    reflectance: &Reflectance,
    light_deg: f64,
    title: &str,
    scale: f64,
) {
    drawing.text([16.0, 20.0], Anchor::Start, TEXT, title);
    let lobe = match reflectance.lobe {
        Lobe::Blinn => "(N·H)^ns",
        Lobe::Phong => "(R·V)^ns",
    };
    let cosine = if reflectance.specular_cosine { " (N·L)" } else { "" };
    let (kd, ks) = (mean(reflectance.kd), mean(reflectance.ks));
    let lines = [
        (DIFFUSE, format!("Lambert   kd (N·L),  kd = {}", short(kd))),
        (
            SPECULAR,
            format!(
                "specular  ks {lobe}{cosine},  ks = {}, ns = {}",
                short(ks),
                short(reflectance.ns)
            ),
        ),
        (SUM, "sum".to_owned()),
    ];
    for (line, (ink, text)) in lines.into_iter().enumerate() {
        let y = 394.0 + 20.0 * line as f64;
        drawing.line(vec![[20.0, y], [44.0, y]], ink, if ink == SUM { 4.5 } else { 2.0 });
        drawing.text([56.0, y], Anchor::Start, TEXT, text);
    }
    let y = 398.0 + 20.0 * 3.0;
    drawing.text(
        [16.0, y],
        Anchor::Start,
        FAINT,
        format!("Light L at {}° from the normal N, mirror direction R opposite.", short(light_deg)),
    );
    drawing.text(
        [16.0, y + 20.0],
        Anchor::Start,
        FAINT,
        format!(
            "A value of 1 is {} of the normal's length; mean of the three channels.",
            fraction(scale)
        ),
    );
}

/// A number with at most four digits after the point.
fn short(number: f64) -> String {
    let rounded = (number * 1e4).round() / 1e4;
    format!("{}", if rounded.is_finite() { rounded } else { number })
}

fn fraction(scale: f64) -> String {
    format!("1/{}", 1.0 / scale)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curves_never_leave_the_normals_length() {
        for (largest, expected) in [(0.0, 0.5), (1.0, 0.5), (2.0, 0.5), (2.1, 0.25), (9.0, 0.0625)]
        {
            assert_eq!(scale(largest), expected, "{largest}");
        }
    }

    // ns = 1e8 has a half width of 0.01°, which steps of half a degree would jump over.
    #[test]
    fn a_needle_is_drawn_to_its_tip() {
        let reflectance = Reflectance {
            kd: [0.0; 3],
            ks: [1.0; 3],
            ns: 1e8,
            lobe: Lobe::Blinn,
            specular_cosine: false,
        };
        let values = angles(&reflectance, 40.3).into_iter().map(|a| reflectance.at(40.3, a));
        let high = values.filter(|sample| sample.specular[0] > 0.5).count();
        assert!(high >= 8, "{high} points above half of the peak");
        assert!(angles(&reflectance, 40.3).contains(&40.3));
    }
}
