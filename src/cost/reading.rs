//! What figures say, in words: a sentence computed from them, never written for them.

use super::Setting;
use super::levels::EXACT;

/// The reading of accuracy: what the fastest level that is not exact saves, and what it loses.
pub(super) fn levels(settings: &[Setting], covered_pixels: usize) -> String {
    let fastest = |settings: Vec<&Setting>| {
        settings.into_iter().min_by(|a, b| a.times.median.total_cmp(&b.times.median)).cloned()
    };
    let (exact, lower): (Vec<&Setting>, Vec<&Setting>) =
        settings.iter().partition(|setting| setting.family == EXACT);
    let Some(exact) = fastest(exact) else { return "Nothing here is exact.".to_owned() };
    let mut text = match exact.errors.wrong_pixels {
        0 => format!("The fastest exact answer is {}, which {}", exact.name, milliseconds(&exact)),
        wrong => format!("{} is wrong at {wrong} pixels, which is an error", exact.name),
    };
    let Some(lower) = fastest(lower) else { return text + "; there is no other level." };
    let wrong = lower.errors.wrong_pixels;
    let share = 100.0 * wrong as f64 / covered_pixels.max(1) as f64;
    let is_wrong = match wrong {
        0 => "is right at every pixel here, by luck and not by promise".to_owned(),
        _ => format!("is wrong at {wrong} pixels, {share:.3} % of those covered"),
    };
    let saved = 1e3 * (exact.times.median - lower.times.median);
    let noise = 1e3 * (exact.times.deviation + lower.times.deviation);
    let price = match saved {
        saved if saved.abs() <= 3.0 * noise => {
            "their times differ by no more than noise".to_owned()
        }
        saved if saved > 0.0 => format!("exactness costs {saved:.2} ms a frame"),
        saved => format!("exactness costs nothing: it is faster by {:.2} ms a frame", -saved),
    };
    text += &format!(
        "; the fastest other level, {}, {} and {is_wrong}",
        lower.name,
        milliseconds(&lower)
    );
    text + &format!(": {price}.")
}

/// The reading of tessellation: which Phong shading replaces the finest flat one, and how errors
/// fall.
pub(super) fn tessellation(settings: &[Setting]) -> String {
    let family = |family: &'static str| settings.iter().filter(move |s| s.family == family);
    let rms = |setting: &Setting| setting.errors.radiance_rms;
    let best_flat = family("flat").min_by(|a, b| rms(a).total_cmp(&rms(b)));
    let mut text = String::new();
    if let Some(flat) = best_flat {
        let as_good = family("phong")
            .filter(|phong| rms(phong) <= rms(flat))
            .min_by_key(|phong| phong.triangles);
        text += &match as_good {
            Some(phong) => format!(
                "Phong shading of {} triangles errs no more than flat shading of {} ({:.2e} against \
                 {:.2e} RMS), in {:.2} of its time",
                phong.triangles,
                flat.triangles,
                rms(phong),
                rms(flat),
                phong.times.median / flat.times.median,
            ),
            None => "No Phong shading here errs as little as the finest flat one".to_owned(),
        };
    }
    let falls: Vec<String> = ["flat", "gouraud", "phong"]
        .into_iter()
        .filter_map(|name| {
            let mut finest: Vec<&Setting> = family(name).collect();
            finest.sort_by_key(|setting| std::cmp::Reverse(setting.triangles));
            let [fine, coarse, ..] = finest[..] else { return None };
            (rms(fine) > 0.0).then(|| format!("{:.1} times ({name})", rms(coarse) / rms(fine)))
        })
        .collect();
    if !falls.is_empty() {
        text +=
            &format!("; from the second finest to the finest, errors fall {}", falls.join(", "));
    }
    text + "."
}

fn milliseconds(setting: &Setting) -> String {
    format!("takes {:.2} ms", 1e3 * setting.times.median)
}
