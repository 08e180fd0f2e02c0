//! `truecast sheet`: several renders in one labelled picture.

use super::arguments::SheetArguments;
use super::failure::Failure;
use super::output::{self, Writing};
use super::progress::Bar;
use super::{OK, on_threads};
use serde_json::json;
use std::path::{Path, PathBuf};
use std::time::Instant;
use truecast::film::{Format, encode_picture, format_of};
use truecast::sheet::{RenderedCell, Sheet, compose};

pub(super) fn run(arguments: &SheetArguments, writing: &Writing) -> Result<u8, Failure> {
    let target = target(arguments)?;
    let started = Instant::now();
    let sheet = Sheet::load(&arguments.sheet)?;
    if !arguments.quiet {
        output::print_warnings(&sheet.warnings);
    }
    let bar = Bar::new(arguments.quiet);
    let rendered = on_threads(arguments.threads, || sheet.render(&bar))?;
    bar.finish();
    let cells = rendered.map_err(|error| Failure::Input(error.to_string()))?;
    let page = compose(&sheet, &cells);
    let bytes = encode_picture(&page)?;
    output::save(writing, &target, &bytes)?;
    if arguments.json {
        output::print_json(&json!({
            "schema": "truecast/sheet/1",
            "sheet": arguments.sheet.display().to_string(),
            "file": target.display().to_string(),
            "bytes": bytes.len(),
            "width": page.width(),
            "height": page.height(),
            "cells": cell_documents(&sheet, &cells),
            "warnings": sheet.warnings,
            "seconds": started.elapsed().as_secs_f64(),
        }));
    } else if !arguments.quiet {
        let clipped = cells.iter().filter(|cell| cell.clipped.above > 0).count();
        let clipped = match clipped {
            0 => String::new(),
            count => format!("; {count} cells hold pixels brighter than white, which were clipped"),
        };
        output::print(&format!(
            "wrote {} ({} bytes{clipped})\n{} cells, {}x{} pixels; {:.2} s\n",
            target.display(),
            bytes.len(),
            cells.len(),
            page.width(),
            page.height(),
            started.elapsed().as_secs_f64(),
        ));
    }
    Ok(OK)
}

/// The picture's name, refused early when it cannot be written.
fn target(arguments: &SheetArguments) -> Result<PathBuf, Failure> {
    let target = match &arguments.output {
        Some(path) => path.clone(),
        None => {
            let mut name = arguments.sheet.file_stem().unwrap_or("sheet".as_ref()).to_os_string();
            name.push(".png");
            PathBuf::from(name)
        }
    };
    check_is_png(&target)?;
    output::check_target(&target)?;
    Ok(target)
}

fn check_is_png(path: &Path) -> Result<(), Failure> {
    match format_of(path) {
        Ok(Format::Png) => Ok(()),
        _ => Err(Failure::usage(format!(
            "{}: a sheet is written as PNG; end its name in .png",
            path.display()
        ))),
    }
}

fn cell_documents(sheet: &Sheet, cells: &[RenderedCell]) -> Vec<serde_json::Value> {
    let labelled = sheet.cells.iter().zip(cells).enumerate();
    labelled
        .map(|(index, (cell, rendered))| {
            json!({
                "label": cell.label,
                "row": index / sheet.columns,
                "column": index % sheet.columns,
                "width": rendered.picture.width(),
                "height": rendered.picture.height(),
                "covered_pixels": rendered.covered_pixels,
                "mean_radiance": rendered.mean_radiance,
                "max_radiance": rendered.max_radiance,
                "clipped_pixels": rendered.clipped.above + rendered.clipped.below,
                "seconds": rendered.time.as_secs_f64(),
            })
        })
        .collect()
}
