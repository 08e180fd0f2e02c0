//! `truecast check`: scenes in, verdict out.

use super::arguments::CheckArguments;
use super::failure::Failure;
use super::output::{self, Writing};
use super::progress::Bar;
use super::{DIFFERENCE, OK, SCENE, audit, on_threads};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use truecast::check::csv::to_csv;
use truecast::check::picture::difference_picture;
use truecast::check::{Blame, BothAnswers, CheckOptions, Judged, Kind, Outcome, Report, check};
use truecast::film::encode_picture;
use truecast::mesh::TriangleId;
use truecast::pixel::Window;
use truecast::scene::sampling::SampleGrid;
use truecast::scene::{Overrides, Scene};

/// Differences that the summary names one by one, each with its way to look closer.
const NAMED_DIFFERENCES: usize = 10;

/// One checked scene.
struct Checked<'a> {
    path: &'a Path,
    scene: Scene,
    report: Report,
    answers: BothAnswers,
    time: Duration,
}

pub(super) fn run(arguments: &CheckArguments, writing: &Writing) -> Result<u8, Failure> {
    if arguments.foreign.ids.is_some() || arguments.foreign.depth.is_some() {
        return audit::run(arguments, writing);
    }
    for path in arguments.diff.iter().chain(&arguments.csv) {
        output::check_target(path)?;
    }
    let mut documents = Vec::new();
    let mut status = OK;
    for path in &arguments.scenes {
        let checked = check_one(arguments, path)?;
        if let Some(diff) = &arguments.diff {
            let picture = difference_picture(&checked.report.differences, &checked.answers);
            let target = target_for(diff, path, arguments.scenes.len());
            output::save(writing, &target, &encode_picture(&picture)?)?;
        }
        if let Some(csv) = &arguments.csv {
            let target = target_for(csv, path, arguments.scenes.len());
            let text = to_csv(&checked.scene, &checked.report.differences, &checked.answers);
            output::save(writing, &target, text.as_bytes())?;
        }
        if arguments.json {
            documents.push(document(&checked));
        } else if !arguments.quiet {
            output::print(&summary(&checked));
            if arguments.pixel.is_some() {
                output::print(&pixel_lines(&checked));
            }
        }
        status = worse(status, outcome_status(checked.report.outcome()));
    }
    if arguments.json {
        output::print_json(&json!({ "schema": "truecast/check/1", "scenes": documents }));
    }
    Ok(status)
}

fn check_one<'a>(arguments: &CheckArguments, path: &'a Path) -> Result<Checked<'a>, Failure> {
    let scene = Scene::load(
        path,
        &Overrides {
            resolution: arguments.size,
            samples: arguments.samples,
            skip_bad: arguments.skip_bad,
            ..Overrides::default()
        },
    )?;
    if !arguments.quiet {
        output::print_warnings(&scene.warnings);
    }
    let frame = scene.camera.resolution();
    let window = match arguments.pixel {
        None => None,
        Some([x, y]) => {
            Some(Window::new(frame, x, y, x.saturating_add(1), y.saturating_add(1)).ok_or_else(
                || {
                    Failure::usage(format!(
                        "--pixel {x},{y} is outside the {}x{} frame",
                        frame.width(),
                        frame.height()
                    ))
                },
            )?)
        }
    };
    let options =
        CheckOptions { window, audited_pixels: arguments.audit, ..CheckOptions::default() };
    let bar = Bar::new(arguments.quiet);
    let started = Instant::now();
    let (report, answers) = on_threads(arguments.threads, || check(&scene, &options, &bar))?;
    bar.finish();
    Ok(Checked { path, scene, report, answers, time: started.elapsed() })
}

/// With several scenes, each gets a file of its own: the scene's name goes before the extension.
fn target_for(file: &Path, scene: &Path, scenes: usize) -> PathBuf {
    if scenes == 1 {
        return file.to_owned();
    }
    let part = |text: Option<&std::ffi::OsStr>| {
        text.map(|text| text.to_string_lossy().into_owned()).unwrap_or_default()
    };
    let name = format!(
        "{}-{}.{}",
        part(file.file_stem()),
        part(scene.file_stem()),
        part(file.extension())
    );
    file.with_file_name(name)
}

fn outcome_status(outcome: Outcome) -> u8 {
    match outcome {
        Outcome::Agreement => OK,
        Outcome::Differences => DIFFERENCE,
        Outcome::NothingToCheck => SCENE,
    }
}

/// Of several scenes: a difference outranks nothing to check, which outranks agreement.
fn worse(a: u8, b: u8) -> u8 {
    let rank = |status| [OK, SCENE, DIFFERENCE].iter().position(|&s| s == status);
    if rank(b) > rank(a) { b } else { a }
}

fn summary(checked: &Checked<'_>) -> String {
    let report = &checked.report;
    let [cast, raster] = report.levels;
    let verdict = match report.outcome() {
        Outcome::Agreement => "0 differences".to_owned(),
        Outcome::Differences => format!("{} differences", report.differences.len()),
        Outcome::NothingToCheck => "nothing to check: no pixel is covered".to_owned(),
    };
    let mut text = format!("{}: {verdict}\n", checked.path.display());
    text += &format!(
        "  {}x{} pixels, {} triangles, {} pixels covered, {} decided by the tie rule\n",
        report.window.width(),
        report.window.height(),
        report.triangles,
        report.covered_pixels,
        report.tied_pixels,
    );
    text += &format!(
        "  compared: id, facing, cover count, signed count, tie, depth, weights, radiance; \
         {} agreeing pixels audited in exact arithmetic\n",
        report.audited_pixels,
    );
    if checked.scene.samples != SampleGrid::CENTRE {
        let side = checked.scene.samples.side();
        text += &format!("  radiance and alpha are means over {side}x{side} samples per pixel\n");
    }
    if report.layered_pixels > 0 {
        text += &format!(
            "  {} pixels see through a surface; compared there: every surface in its order; {} of \
             them audited\n",
            report.layered_pixels, report.audited_layered_pixels,
        );
    }
    if report.terminator_pixels > 0 {
        text += &format!(
            "  {} pixels lie on a light's terminator (|N·L| < 1e-13), where rounding decides: their \
             radiance differs and may\n",
            report.terminator_pixels,
        );
    }
    text += &format!(
        "  decisions f32/f64/exact: caster {}/{}/{}, rasterizer {}/{}/{}; \
         largest radiance difference {:.1e}; {:.2} s\n",
        cast.single,
        cast.double,
        cast.exact,
        raster.single,
        raster.double,
        raster.exact,
        report.largest_tolerated_radiance,
        checked.time.as_secs_f64(),
    );
    if report.outcome() == Outcome::Differences {
        text += &differences_by_kind(report);
        for judged in report.differences.iter().take(NAMED_DIFFERENCES) {
            text += &one_line(checked, judged);
        }
        let more = report.differences.len().saturating_sub(NAMED_DIFFERENCES);
        if more > 0 {
            text += &format!("  and {more} more; --csv FILE lists all\n");
        }
    }
    text
}

fn differences_by_kind(report: &Report) -> String {
    let kinds: Vec<_> = Kind::ALL
        .iter()
        .filter(|&&kind| report.count(kind) > 0)
        .map(|&kind| format!("{} {}", report.count(kind), kind.name()))
        .collect();
    let blames: Vec<_> = Blame::ALL
        .iter()
        .filter(|&&blame| report.blamed(blame) > 0)
        .map(|&blame| format!("{} {}", blame.name(), report.blamed(blame)))
        .collect();
    format!("  by kind: {}; to blame: {}\n", kinds.join(", "), blames.join(", "))
}

fn one_line(checked: &Checked<'_>, judged: &Judged) -> String {
    let pixel = judged.difference.pixel;
    let seen = |path: usize| checked.answers[path].buffer.at(pixel).map(|visible| visible.triangle);
    let exact = judged.exact.visible.as_ref().map(|surface| surface.triangle);
    let name = |id: Option<TriangleId>| match id {
        None => "none".to_owned(),
        Some(id) => format!("{} ({})", id.get(), checked.scene.describe_source(id)),
    };
    format!(
        "  ({}, {}) {}: cast {}, raster {}, exact {}; wrong: {}; see: truecast check {} --pixel {},{}\n",
        pixel.x,
        pixel.y,
        judged.difference.kind.name(),
        name(seen(0)),
        name(seen(1)),
        name(exact),
        judged.blame.name(),
        checked.path.display(),
        pixel.x,
        pixel.y,
    )
}

/// Both paths' answers at the one pixel of the window; the audit has seen it too.
fn pixel_lines(checked: &Checked<'_>) -> String {
    let mut text = String::new();
    for (name, answered) in ["cast", "raster"].iter().zip(&checked.answers) {
        let cover = answered.buffer.cover.as_ref().map_or((0, 0), |c| (c[0].crossed, c[0].signed));
        let seen = match &answered.buffer.visible[0] {
            None => "nothing visible".to_owned(),
            Some(visible) => format!(
                "triangle {} ({}), facing {:+}, t {:?} in [{:?}, {:?}], weights {:?}, tie {}",
                visible.triangle.get(),
                checked.scene.describe_source(visible.triangle),
                visible.facing.sign(),
                visible.t(),
                visible.t_lo,
                visible.t_hi,
                visible.barycentric.0,
                visible.tie,
            ),
        };
        text += &format!(
            "  {name}: {seen}; cover {}, signed {}; {}radiance {:?}\n",
            cover.0,
            cover.1,
            match answered.layers.of(0).len() {
                0 => String::new(),
                count => format!("{count} surfaces behind it, alpha {:?}; ", answered.alpha[0]),
            },
            answered.radiance[0]
        );
    }
    text
}

fn document(checked: &Checked<'_>) -> Value {
    let report = &checked.report;
    let levels = report
        .levels
        .map(|levels| json!({ "f32": levels.single, "f64": levels.double, "exact": levels.exact }));
    let by_kind: serde_json::Map<String, Value> =
        Kind::ALL.iter().map(|&k| (k.name().to_owned(), json!(report.count(k)))).collect();
    let by_blame: serde_json::Map<String, Value> =
        Blame::ALL.iter().map(|&b| (b.name().to_owned(), json!(report.blamed(b)))).collect();
    json!({
        "scene": checked.path.display().to_string(),
        "outcome": match report.outcome() {
            Outcome::Agreement => "agreement",
            Outcome::Differences => "differences",
            Outcome::NothingToCheck => "nothing to check",
        },
        "width": report.window.width(),
        "height": report.window.height(),
        "triangles": report.triangles,
        "covered_pixels": report.covered_pixels,
        "tied_pixels": report.tied_pixels,
        "audited_pixels": report.audited_pixels,
        "layered_pixels": report.layered_pixels,
        "audited_layered_pixels": report.audited_layered_pixels,
        "samples": checked.scene.samples.side(),
        "differences": report.differences.len(),
        "by_kind": by_kind,
        "by_blame": by_blame,
        "pixels": report.differences.iter().take(1000).map(|judged| json!({
            "x": judged.difference.pixel.x,
            "y": judged.difference.pixel.y,
            "kind": judged.difference.kind.name(),
            "blame": judged.blame.name(),
            "found_by_audit": judged.found_by_audit,
        })).collect::<Vec<_>>(),
        "largest_tolerated_radiance": report.largest_tolerated_radiance,
        "terminator_pixels": report.terminator_pixels,
        "decisions": { "cast": levels[0], "raster": levels[1] },
        "time_s": checked.time.as_secs_f64(),
    })
}
