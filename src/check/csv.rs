//! The differences of a check as CSV: one line per pixel, with all three answers.

use super::blame::{Judged, visible_of};
use super::compare::{Answered, cover_at};
use crate::render::visible::csv_field;
use crate::scene::Scene;
use crate::visibility::{Cover, Visible};
use std::fmt::Write;

/// Column names, in order. Ids are empty where nothing is visible; a source is `file.obj:line`.
const HEADER: &str = "x,y,kind,blame,found_by,cast_id,raster_id,exact_id,\
cast_source,raster_source,exact_source,cast_facing,raster_facing,\
exact_facing,cast_cover,raster_cover,exact_cover,cast_signed,raster_signed,exact_signed,cast_t,\
raster_t,exact_t,cast_r,cast_g,cast_b,raster_r,raster_g,raster_b";

/// Writes a header and one line per difference.
pub fn to_csv(scene: &Scene, differences: &[Judged], answers: &[Answered; 2]) -> String {
    let mut text = String::from(HEADER);
    text.push('\n');
    for judged in differences {
        let pixel = judged.difference.pixel;
        let index = answers[0].buffer.window.index(pixel);
        let (exact, exact_cover) = visible_of(&judged.exact);
        let visible = [answers[0].buffer.visible[index], answers[1].buffer.visible[index], exact];
        let cover: [Cover; 3] =
            [cover_at(&answers[0].buffer, index), cover_at(&answers[1].buffer, index), exact_cover];
        let found_by = if judged.found_by_audit { "audit" } else { "comparison" };
        // Writing to a String cannot fail.
        let _ = write!(
            text,
            "{},{},{},{},{found_by}",
            pixel.x,
            pixel.y,
            judged.difference.kind.name(),
            judged.blame.name()
        );
        columns(&mut text, &visible, |visible| visible.triangle.get().to_string());
        columns(&mut text, &visible, |visible| {
            csv_field(&scene.describe_source(visible.triangle)).into_owned()
        });
        columns(&mut text, &visible, |visible| visible.facing.sign().to_string());
        cover.iter().for_each(|cover| text.push_str(&format!(",{}", cover.crossed)));
        cover.iter().for_each(|cover| text.push_str(&format!(",{}", cover.signed)));
        columns(&mut text, &visible, |visible| format!("{:e}", visible.t()));
        for answered in answers {
            for channel in answered.radiance[index] {
                let _ = write!(text, ",{channel:e}");
            }
        }
        text.push('\n');
    }
    text
}

/// One column per answer; empty where nothing is visible.
fn columns(text: &mut String, visible: &[Option<Visible>; 3], value: impl Fn(&Visible) -> String) {
    for answer in visible {
        text.push(',');
        text.push_str(&answer.as_ref().map_or_else(String::new, &value));
    }
}
