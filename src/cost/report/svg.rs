//! Prices as points: error upwards against time, both by powers of ten, a plot per knob.
//!
//! An error of 0 has no logarithm and stands on a line of its own below the plot. Settings on the
//! frontier are filled, the others are rings. Every point has a number, and the list below the plot
//! says what it is.

use crate::cost::{Knob, Measure, Report, Setting};
use crate::drawing::axis::Axis;
use crate::drawing::page::{FAINT, GRID, MARGIN, TEXT, WIDTH};
use crate::drawing::{Anchor, Drawing, Ink, Point, glyphs};

const LINE: f64 = 20.0;

/// The plot's left, right and height, page units.
const LEFT: f64 = 96.0;
const RIGHT: f64 = 920.0;
const PLOT_HEIGHT: f64 = 280.0;
/// From the plot's lower end to the line of errors that are 0, and to the axis of time.
const ZERO_BELOW: f64 = 28.0;
const AXIS_BELOW: f64 = 44.0;

const PAPER: Ink = [255, 255, 255];
/// One per family, in order of first appearance.
const FAMILIES: [Ink; 4] = [[9, 105, 218], [207, 34, 46], [26, 127, 55], [130, 80, 223]];

/// The drawing of every knob of every scene, one below the other. What does not fit the largest page
/// is left out.
pub fn to_drawing(report: &Report) -> Drawing {
    let knobs =
        || report.scenes.iter().flat_map(|scene| scene.knobs.iter().map(move |k| (scene, k)));
    let height: f64 = knobs().map(|(_, knob)| height_of(knob)).sum::<f64>() + 2.0 * MARGIN;
    let mut drawing = Drawing::new(WIDTH, height.min(f64::from(u16::MAX)) as u16);
    let mut top = MARGIN;
    for (scene, knob) in knobs() {
        let title = format!(
            "{}, {}x{}: {}, threads: {}",
            scene.scene,
            scene.resolution.width(),
            scene.resolution.height(),
            knob.name,
            report.threads
        );
        plot(&mut drawing, knob, &title, top);
        top += height_of(knob);
    }
    drawing
}

fn height_of(knob: &Knob) -> f64 {
    let list = LINE * (knob.settings.len() + reading(knob).len()) as f64;
    4.0 * LINE + PLOT_HEIGHT + AXIS_BELOW + list + 2.0 * LINE
}

/// The reading, in lines of the page's width.
fn reading(knob: &Knob) -> Vec<String> {
    let columns = (f64::from(WIDTH) - 2.0 * MARGIN) / f64::from(glyphs::WIDTH);
    glyphs::wrap(&knob.reading, columns as usize)
}

fn plot(drawing: &mut Drawing, knob: &Knob, title: &str, top: f64) {
    drawing.text_cut([MARGIN, top + 0.5 * LINE], TEXT, title);
    let label = match knob.measure {
        Measure::WrongPixels => "wrong pixels".to_owned(),
        Measure::Radiance => "RMS radiance error, scene units".to_owned(),
    };
    drawing.text_cut([MARGIN, top + 1.7 * LINE], FAINT, &label);
    let (upper, lower) = (top + 3.0 * LINE, top + 3.0 * LINE + PLOT_HEIGHT);
    let errors = knob.settings.iter().map(|setting| knob.measure.of(&setting.errors));
    let error_axis = Axis::around(errors, lower, upper);
    let times = knob.settings.iter().map(|setting| 1e3 * setting.times.median);
    let time_axis = Axis::around(times, LEFT, RIGHT);
    for mark in &error_axis.marks {
        let y = error_axis.at(mark.value());
        drawing.line(vec![[LEFT, y], [RIGHT, y]], GRID, 1.0);
        drawing.text([LEFT - 8.0, y], Anchor::End, FAINT, mark.label());
    }
    for mark in &time_axis.marks {
        let x = time_axis.at(mark.value());
        drawing.line(vec![[x, upper], [x, lower + ZERO_BELOW]], GRID, 1.0);
        let label = format!("{} ms", mark.label());
        drawing.text([x, lower + AXIS_BELOW], Anchor::Middle, FAINT, label);
    }
    let zero = lower + ZERO_BELOW;
    drawing.line(vec![[LEFT, zero], [RIGHT, zero]], FAINT, 1.0);
    drawing.text([LEFT - 8.0, zero], Anchor::End, FAINT, "0");

    let mut families: Vec<&str> = Vec::new();
    let mut y = lower + AXIS_BELOW + LINE;
    for (number, setting) in (1..).zip(&knob.settings) {
        if !families.contains(&setting.family) {
            families.push(setting.family);
        }
        let family = families.iter().position(|family| *family == setting.family).unwrap_or(0);
        let ink = FAMILIES[family % FAMILIES.len()];
        let value = knob.measure.of(&setting.errors);
        let height = if value > 0.0 { error_axis.at(value) } else { zero };
        let place = [time_axis.at(1e3 * setting.times.median), height];
        point(drawing, place, ink, setting.is_on_frontier);
        drawing.text([place[0] + 9.0, place[1]], Anchor::Start, ink, number.to_string());
        y += LINE;
        point(drawing, [MARGIN + 8.0, y], ink, setting.is_on_frontier);
        drawing.text_cut([MARGIN + 24.0, y], TEXT, &entry(number, setting, knob.measure));
    }
    for line in reading(knob) {
        y += LINE;
        drawing.text_cut([MARGIN, y], FAINT, &line);
    }
}

fn entry(number: usize, setting: &Setting, measure: Measure) -> String {
    let value = match measure.of(&setting.errors) {
        value if value == 0.0 || value >= 1.0 => format!("{value:.0}"),
        value => format!("{value:.2e}"),
    };
    format!(
        "{number:>2} {}: {:.3} ms ± {:.3}, {} {value}",
        setting.name,
        1e3 * setting.times.median,
        1e3 * setting.times.deviation,
        measure.name(),
    )
}

fn point(drawing: &mut Drawing, place: Point, ink: Ink, is_filled: bool) {
    drawing.dot(place, 5.0, ink);
    if !is_filled {
        drawing.dot(place, 3.0, PAPER);
    }
}
