//! Prices as CSV: one line per scene, knob and setting.

use crate::cost::Report;
use crate::render::visible::csv_field;
use std::fmt::Write;

const HEADER: &str = "scene,width,height,threads,knob,name,triangles,n,median_ms,mad_ms,min_ms,max_ms,\
baseline,ratio,wrong_pixels,max_depth_error,max_radiance_error,rms_radiance_error,frontier";

/// A header, and one line per setting. Depths and radiances are in the scene's units.
pub fn to_csv(report: &Report) -> String {
    let mut text = format!("{HEADER}\n");
    for prices in &report.scenes {
        for knob in &prices.knobs {
            for setting in &knob.settings {
                let (times, errors) = (&setting.times, &setting.errors);
                // Writing to a String cannot fail.
                let _ = writeln!(
                    text,
                    "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}",
                    csv_field(&prices.scene),
                    prices.resolution.width(),
                    prices.resolution.height(),
                    report.threads,
                    knob.name,
                    csv_field(&setting.name),
                    setting.triangles,
                    times.n,
                    1e3 * times.median,
                    1e3 * times.deviation,
                    1e3 * times.least,
                    1e3 * times.most,
                    csv_field(&setting.baseline),
                    setting.ratio,
                    errors.wrong_pixels,
                    errors.depth_max,
                    errors.radiance_max,
                    errors.radiance_rms,
                    setting.is_on_frontier,
                );
            }
        }
    }
    text
}
