//! The colour of a vertex: the last three numbers of `v x y z r g b` and `v x y z w r g b`.
//!
//! No part of the format's description, but what most programs write. The numbers are taken as
//! linear RGB.

use crate::color::LinearRgb;
use crate::scene::error::SceneError;
use crate::scene::obj::report::{Report, quote};
use crate::scene::obj::statement::{Statements, Token};
use std::path::Path;

/// Colour of a vertex without one in a file that has some.
pub(super) const WHITE: LinearRgb = [1.0; 3];

/// Three numbers as a colour.
///
/// # Errors
/// One that is no finite number of at least 0, with its place.
pub(super) fn read(
    walk: &Statements<'_>,
    values: &[Token<'_>],
    file: &Path,
    report: &mut Report,
) -> Result<LinearRgb, SceneError> {
    let mut color = [0.0; 3];
    for (channel, token) in color.iter_mut().zip(values) {
        // Turns -0 into 0.
        *channel = walk.number(token)? + 0.0;
        if *channel < 0.0 {
            let message = format!("a vertex colour is negative: {}", quote(token.text));
            return Err(SceneError::scene(walk.place(token), message)
                .with_help("colours are linear RGB, each channel at least 0"));
        }
    }
    if color.iter().any(|&channel| channel > 1.0) {
        let sentence = "a vertex colour exceeds 1; it is used as written";
        report.warn(file, walk.keyword().line, sentence);
    }
    Ok(color)
}
