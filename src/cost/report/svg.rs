//! Prices as points: error upwards against time, both by powers of ten, a plot per knob.
//!
//! An error of 0 has no logarithm and stands on a line of its own below the plot. Settings on the
//! frontier are filled, the others are rings. Every point has a number, and the list below the plot
//! says what it is.

use crate::cost::{Knob, Measure, Report, Setting};
use crate::drawing::{Anchor, Drawing, Ink, Point, glyphs};

const WIDTH: u16 = 960;
const LINE: f64 = 20.0;
const MARGIN: f64 = 16.0;

/// The plot's left, right and height, page units.
const LEFT: f64 = 96.0;
const RIGHT: f64 = 920.0;
const PLOT_HEIGHT: f64 = 280.0;
/// From the plot's lower end to the line of errors that are 0, and to the axis of time.
const ZERO_BELOW: f64 = 28.0;
const AXIS_BELOW: f64 = 44.0;

const TEXT: Ink = [36, 41, 47];
const FAINT: Ink = [110, 118, 126];
const GRID: Ink = [222, 226, 230];
const PAPER: Ink = [255, 255, 255];
/// One per family, in order of first appearance.
const FAMILIES: [Ink; 4] = [[9, 105, 218], [207, 34, 46], [26, 127, 55], [130, 80, 223]];

/// One logarithmic axis, from a round number to another, over a stretch of the page.
#[derive(Clone, Debug)]
struct Axis {
    /// Round numbers, ascending, at least two.
    marks: Vec<Round>,
    start: f64,
    end: f64,
}

/// 1, 2 or 5 times a power of ten.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Round {
    factor: u32,
    power: i32,
}

impl Round {
    fn value(self) -> f64 {
        f64::from(self.factor) * libm::pow(10.0, f64::from(self.power))
    }

    fn next(self) -> Self {
        match self.factor {
            1 => Self { factor: 2, ..self },
            2 => Self { factor: 5, ..self },
            _ => Self { factor: 1, power: self.power + 1 },
        }
    }

    /// In full where that is short.
    fn label(self) -> String {
        let Self { factor, power } = self;
        match power {
            -2..=-1 => format!("{:.*}", power.unsigned_abs() as usize, self.value()),
            0..=3 => format!("{}", factor * 10_u32.pow(power.unsigned_abs())),
            _ => format!("{factor}e{power}"),
        }
    }
}

impl Axis {
    /// Around values above 0, or about 1 if there is none. Over more than two powers of ten only these
    /// are marked.
    fn around(values: impl Iterator<Item = f64>, start: f64, end: f64) -> Self {
        let (mut least, mut most) = (f64::INFINITY, 0.0_f64);
        for value in values.filter(|value| *value > 0.0 && value.is_finite()) {
            (least, most) = (least.min(value), most.max(value));
        }
        if least > most {
            (least, most) = (1.0, 1.0);
        }
        let power = libm::log10(least).floor() as i32;
        let mut mark = Round { factor: 1, power };
        while mark.next().value() <= least {
            mark = mark.next();
        }
        let mut marks = vec![mark];
        while marks.len() < 2 || mark.value() < most {
            mark = mark.next();
            marks.push(mark);
        }
        if marks.last().is_some_and(|last| last.value() > 100.0 * marks[0].value()) {
            marks[0].factor = 1;
            while mark.factor != 1 {
                mark = mark.next();
                marks.push(mark);
            }
            marks.retain(|mark| mark.factor == 1);
        }
        Self { marks, start, end }
    }

    fn at(&self, value: f64) -> f64 {
        let [low, high] = [self.marks.first(), self.marks.last()]
            .map(|mark| mark.map_or(0.0, |mark| libm::log10(mark.value())));
        let share = (libm::log10(value) - low) / (high - low);
        self.start + share * (self.end - self.start)
    }
}

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
    text(drawing, [MARGIN, top + 0.5 * LINE], TEXT, title);
    let label = match knob.measure {
        Measure::WrongPixels => "wrong pixels".to_owned(),
        Measure::Radiance => "RMS radiance error, scene units".to_owned(),
    };
    text(drawing, [MARGIN, top + 1.7 * LINE], FAINT, &label);
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
        text(drawing, [MARGIN + 24.0, y], TEXT, &entry(number, setting, knob.measure));
    }
    for line in reading(knob) {
        y += LINE;
        text(drawing, [MARGIN, y], FAINT, &line);
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

/// A text from its left end on, cut where the page ends.
fn text(drawing: &mut Drawing, at: Point, ink: Ink, text: &str) {
    let room = ((f64::from(WIDTH) - at[0]) / f64::from(glyphs::WIDTH)) as usize;
    let text: String = text.chars().take(room).collect();
    drawing.text(at, Anchor::Start, ink, text);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(values: &[f64]) -> Vec<String> {
        let axis = Axis::around(values.iter().copied(), 0.0, 1.0);
        axis.marks.iter().map(|mark| mark.label()).collect()
    }

    #[test]
    fn axes_begin_and_end_at_round_numbers() {
        assert_eq!(labels(&[13.0, 71.0, 0.0]), ["10", "20", "50", "100"]);
        assert_eq!(labels(&[0.02, 0.03]), ["0.02", "0.05"]);
        assert_eq!(labels(&[3.0, 800.0]), ["1", "10", "100", "1000"]);
        assert_eq!(labels(&[7e-5, 0.02]), ["1e-5", "1e-4", "1e-3", "0.01", "0.1"]);
        assert_eq!(labels(&[]), ["1", "2"]);
        let axis = Axis::around([10.0, 1000.0].into_iter(), 40.0, 20.0);
        assert_eq!([10.0, 100.0, 1000.0].map(|value| axis.at(value)), [40.0, 30.0, 20.0]);
    }
}
