//! A report as bars: median times from 0 on, each kind of work on a scale of its own.
//!
//! The thin line over a bar's end spans the median absolute deviation on both sides. A variant
//! without a time has no bar but says why. A bar in red is of a variant that
//! promises nothing and has wrong answers.

use crate::bench::rounds::Row;
use crate::bench::workload::Work;
use crate::bench::{Measured, Report};
use crate::drawing::page::{FAINT, MARGIN, TEXT, WIDTH};
use crate::drawing::{Anchor, Drawing, Ink};

/// Height of a line of the page, page units.
const LINE: f64 = 22.0;

/// Where names end and bars begin, and the length of the longest bar, page units.
const BAR_START: f64 = 256.0;
const BAR_LENGTH: f64 = 400.0;
const BAR_HEIGHT: f64 = 12.0;

const OURS: Ink = [9, 105, 218];
const THEIRS: Ink = [140, 149, 159];
const WRONG: Ink = [207, 34, 46];

/// The drawing of every scene, one below the other. What does not fit the largest page is left out,
/// and the last line says so.
pub fn to_drawing(report: &Report) -> Drawing {
    let lines = report.scenes.iter().map(|scene| 2 + lines_of(scene)).sum::<usize>() + 1;
    let height = (LINE * lines as f64 + 2.0 * MARGIN).min(f64::from(u16::MAX));
    let mut drawing = Drawing::new(WIDTH, height as u16);
    let mut y = MARGIN + 0.5 * LINE;
    let machine = &report.machine;
    let head = format!(
        "truecast {} on {}: median times, thin lines ± median absolute deviation",
        machine.version,
        machine.cpu.as_deref().unwrap_or("an unknown processor")
    );
    drawing.text_cut([MARGIN, y], FAINT, &head);
    for measured in &report.scenes {
        y += 2.0 * LINE;
        scene(&mut drawing, measured, &mut y);
    }
    if y > height {
        let at = [MARGIN, height - 0.5 * LINE];
        drawing.text_cut(at, WRONG, "the page ends here; write fewer scenes");
    }
    drawing
}

fn lines_of(measured: &Measured) -> usize {
    let works = Work::ALL.iter().filter(|&&work| measured.rows.iter().any(|r| r.work == work));
    measured.rows.len() + works.count()
}

fn scene(drawing: &mut Drawing, measured: &Measured, y: &mut f64) {
    let subject = &measured.subject;
    let title = format!(
        "{}, {}x{}, {} triangles, threads: {}, SIMD: {}",
        subject.name,
        subject.resolution.width(),
        subject.resolution.height(),
        measured.triangles,
        subject.threads,
        subject.simd
    );
    drawing.text_cut([MARGIN, *y], TEXT, &title);
    for work in Work::ALL {
        let rows: Vec<&Row> = measured.rows.iter().filter(|row| row.work == work).collect();
        if rows.is_empty() {
            continue;
        }
        *y += LINE;
        drawing.text_cut([MARGIN, *y], FAINT, work.name());
        let medians = rows.iter().filter_map(|row| row.times).map(|times| times.median);
        let longest = medians.fold(0.0, f64::max);
        for row in rows {
            *y += LINE;
            bar(drawing, row, longest, *y);
        }
    }
}

fn bar(drawing: &mut Drawing, row: &Row, longest: f64, y: f64) {
    drawing.text([BAR_START - 8.0, y], Anchor::End, TEXT, row.name.as_str());
    let wrong = row.wrong_pixels.unwrap_or(0);
    let Some(times) = row.times.filter(|_| longest > 0.0) else {
        let why = if wrong > 0 { format!("no time: {wrong} wrong pixels") } else { "-".to_owned() };
        drawing.text_cut([BAR_START, y], WRONG, &why);
        return;
    };
    let x = |time: f64| BAR_START + BAR_LENGTH * (time / longest).clamp(0.0, 1.25);
    let ink = match row.program {
        _ if wrong > 0 => WRONG,
        None => OURS,
        Some(_) => THEIRS,
    };
    let end = x(times.median).max(BAR_START + 1.0);
    let (top, bottom) = (y - 0.5 * BAR_HEIGHT, y + 0.5 * BAR_HEIGHT);
    let corners = [[BAR_START, top], [end, top], [end, bottom], [BAR_START, bottom]];
    drawing.marks.push(crate::drawing::Mark::Polygon { points: corners.into(), ink });
    let (low, high) = (x(times.median - times.deviation), x(times.median + times.deviation));
    drawing.line(vec![[low, y], [high, y]], TEXT, 1.0);
    let mut label = format!("{:.3} ms", 1e3 * times.median);
    if let Some(rate) = times.millions_per_second(row.amount.count) {
        label += &format!(", {rate:.1} {}", row.amount.unit.rate());
    }
    if wrong > 0 {
        label += &format!(", {wrong} wrong");
    }
    drawing.text_cut([end.max(high) + 8.0, y], FAINT, &label);
}
