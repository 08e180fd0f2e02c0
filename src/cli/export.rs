//! `truecast export`: scene in, oracle bundle out.

use super::arguments::ExportArguments;
use super::failure::Failure;
use super::output::{self, Writing};
use super::progress::Bar;
use super::{OK, on_threads};
use serde_json::json;
use std::time::Instant;
use truecast::export::{FILES, assemble, check_folder};
use truecast::scene::{Overrides, Scene};

pub(super) fn run(arguments: &ExportArguments, writing: &Writing) -> Result<u8, Failure> {
    let folder = &arguments.output;
    check_folder(folder)?;
    let started = Instant::now();
    let scene = Scene::load(
        &arguments.scene,
        &Overrides {
            resolution: arguments.size,
            skip_bad: arguments.skip_bad,
            ..Overrides::default()
        },
    )?;
    if !arguments.quiet {
        output::print_warnings(&scene.warnings);
    }
    let bar = Bar::new(arguments.quiet);
    let bundle = on_threads(arguments.threads, || assemble(&scene, folder, &bar))?;
    bar.finish();
    let bundle = bundle?;
    let counts = bundle.counts;
    let bytes = {
        let _held = writing.lock();
        bundle.place(folder)?
    };
    let time_s = started.elapsed().as_secs_f64();
    let frame = scene.camera.resolution();
    if arguments.json {
        output::print_json(&json!({
            "schema": "truecast/export/1",
            "scene": arguments.scene.display().to_string(),
            "folder": folder.display().to_string(),
            "files": FILES,
            "bytes": bytes,
            "width": frame.width(),
            "height": frame.height(),
            "triangles": scene.mesh.len(),
            "covered_pixels": counts.covered,
            "tied_pixels": counts.tied,
            "unstable_pixels": counts.unstable,
            "time_s": time_s,
        }));
    } else if !arguments.quiet {
        output::print(&format!(
            "wrote {} ({} files, {bytes} bytes)\n\
             {}x{} pixels, {} triangles, {} pixels covered, {} decided by the tie rule, \
             {} change within 1/256 pixel; {time_s:.2} s\n",
            folder.display(),
            FILES.len(),
            frame.width(),
            frame.height(),
            scene.mesh.len(),
            counts.covered,
            counts.tied,
            counts.unstable,
        ));
    }
    Ok(OK)
}
