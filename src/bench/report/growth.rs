//! How times grow with the mesh: each variant's time per ray (pixel, triangle) over the number of
//! triangles of the scenes, both by powers of ten, beside what log n would give.
//!
//! It takes a report of several scenes with different numbers of triangles, best of one kind; what
//! else differs between them is the reader's to judge.

use crate::bench::Report;
use crate::bench::workload::{Unit, Work};
use crate::drawing::axis::Axis;
use crate::drawing::page::{FAINT, GRID, MARGIN, TEXT, WIDTH};
use crate::drawing::{Anchor, Drawing, Ink};

const LINE: f64 = 20.0;

/// The plot's left, right and height, page units.
const LEFT: f64 = 96.0;
const RIGHT: f64 = 920.0;
const PLOT_HEIGHT: f64 = 360.0;

/// One per variant, in order of first appearance.
const VARIANTS: [Ink; 8] = [
    [9, 105, 218],
    [207, 34, 46],
    [26, 127, 55],
    [130, 80, 223],
    [188, 76, 0],
    [27, 124, 131],
    [191, 57, 137],
    [87, 96, 106],
];

/// A variant on meshes of different sizes.
#[derive(Clone, Debug, PartialEq)]
pub struct Growth {
    /// The variant, and its threads and instruction set where the report has several.
    pub name: String,
    /// What its times are divided by.
    pub unit: Unit,
    /// Triangles, and the median time and its deviation per unit, in seconds; ascending.
    pub points: Vec<GrowthPoint>,
}

/// A variant on one mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GrowthPoint {
    /// Triangles of the mesh.
    pub triangles: usize,
    /// Median time per unit, in seconds.
    pub median: f64,
    /// Its median absolute deviation, in seconds.
    pub deviation: f64,
}

impl Growth {
    /// How many times longer a unit takes on the largest mesh than on the smallest.
    pub fn of_time(&self) -> f64 {
        self.ends().map_or(1.0, |[first, last]| last.median / first.median)
    }

    /// How many times longer it would take if time were as the logarithm of the triangles.
    pub fn of_logarithm(&self) -> f64 {
        self.ends().map_or(1.0, |[first, last]| logarithm(last) / logarithm(first))
    }

    fn ends(&self) -> Option<[&GrowthPoint; 2]> {
        Some([self.points.first()?, self.points.last()?])
    }
}

/// The logarithm of a point's triangles; of two at least, so that it is above 0.
fn logarithm(point: &GrowthPoint) -> f64 {
    libm::log2(point.triangles.max(2) as f64)
}

/// Every variant that has times on two meshes of different sizes at least.
pub fn growths(report: &Report) -> Vec<Growth> {
    let subjects = || report.scenes.iter().map(|scene| &scene.subject);
    let threads = subjects().any(|subject| subject.threads != report.scenes[0].subject.threads);
    let levels = subjects().any(|subject| subject.simd != report.scenes[0].subject.simd);
    let mut growths: Vec<Growth> = Vec::new();
    for scene in &report.scenes {
        for row in &scene.rows {
            let Some(times) = row.times.filter(|_| row.amount.count > 0) else { continue };
            let mut name = row.name.clone();
            if row.work != Work::Closest {
                name = format!("{}: {name}", row.work.name());
            }
            if threads {
                name += &format!(", threads: {}", scene.subject.threads);
            }
            if levels {
                name += &format!(", {}", scene.subject.simd);
            }
            let count = row.amount.count as f64;
            let point = GrowthPoint {
                triangles: scene.triangles,
                median: times.median / count,
                deviation: times.deviation / count,
            };
            match growths.iter_mut().find(|growth| growth.name == name) {
                Some(growth) => growth.points.push(point),
                None => growths.push(Growth { name, unit: row.amount.unit, points: vec![point] }),
            }
        }
    }
    for growth in &mut growths {
        growth.points.sort_by_key(|point| point.triangles);
    }
    growths.retain(|growth| growth.points.windows(2).any(|p| p[0].triangles < p[1].triangles));
    growths
}

/// What the growths say, a line for each.
pub fn reading(growths: &[Growth]) -> Vec<String> {
    growths
        .iter()
        .filter_map(|growth| {
            let [first, last] = growth.ends()?;
            let [time, log] = [growth.of_time(), growth.of_logarithm()];
            Some(format!(
                "{}: {:.1} -> {:.1} ns per {}, {time:.2} times (log n: {log:.2}), {} -> {} triangles",
                growth.name,
                1e9 * first.median,
                1e9 * last.median,
                growth.unit.name(),
                first.triangles,
                last.triangles,
            ))
        })
        .collect()
}

/// The growths as lines, with the logarithm from each line's first point as a thin line.
pub fn growth_drawing(growths: &[Growth]) -> Drawing {
    let lines = reading(growths);
    let height = 3.0 * LINE + PLOT_HEIGHT + 3.0 * LINE + LINE * lines.len() as f64 + 2.0 * MARGIN;
    let mut drawing = Drawing::new(WIDTH, height.min(f64::from(u16::MAX)) as u16);
    drawing.text_cut(
        [MARGIN, MARGIN + 0.5 * LINE],
        TEXT,
        "time per ray, pixel or triangle over the triangles of the mesh; thin: as log n would grow",
    );
    let (upper, lower) = (MARGIN + 2.0 * LINE, MARGIN + 2.0 * LINE + PLOT_HEIGHT);
    let points = || growths.iter().flat_map(|growth| &growth.points);
    let across = Axis::around(points().map(|point| point.triangles as f64), LEFT, RIGHT);
    let up = Axis::around(points().map(|point| 1e9 * point.median), lower, upper);
    for mark in &up.marks {
        let y = up.at(mark.value());
        drawing.line(vec![[LEFT, y], [RIGHT, y]], GRID, 1.0);
        drawing.text([LEFT - 8.0, y], Anchor::End, FAINT, format!("{} ns", mark.label()));
    }
    for mark in &across.marks {
        let x = across.at(mark.value());
        drawing.line(vec![[x, upper], [x, lower]], GRID, 1.0);
        drawing.text([x, lower + LINE], Anchor::Middle, FAINT, mark.label());
    }
    let mut y = lower + 2.0 * LINE;
    for ((growth, ink), line) in growths.iter().zip(VARIANTS.iter().cycle()).zip(lines) {
        let at = |point: &GrowthPoint, time: f64| {
            [across.at(point.triangles as f64), up.at(1e9 * time).clamp(upper, lower)]
        };
        if let Some(first) = growth.points.first() {
            let scale = first.median / logarithm(first);
            let log = growth.points.iter().map(|point| at(point, scale * logarithm(point)));
            drawing.line(log.collect(), FAINT, 1.0);
        }
        let times = growth.points.iter().map(|point| at(point, point.median));
        drawing.line(times.clone().collect(), *ink, 2.0);
        for place in times {
            drawing.dot(place, 4.0, *ink);
        }
        y += LINE;
        drawing.dot([MARGIN + 8.0, y], 5.0, *ink);
        drawing.text_cut([MARGIN + 24.0, y], TEXT, &line);
    }
    drawing
}
