//! How far a picture is from the right one.

use crate::color::LinearRgb;

/// What is seen at one pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Seen {
    /// Which thing: what must be equal for the pixel to be right.
    pub(super) id: u32,
    /// Depth along the view axis.
    pub(super) depth: f64,
}

/// A picture to be compared, row by row.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Picture {
    /// `None` where nothing is visible.
    pub(super) seen: Vec<Option<Seen>>,
    pub(super) radiance: Vec<LinearRgb>,
}

/// Which pixels count towards the errors of depth and radiance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Counted {
    /// Depth where both see something, radiance everywhere: what a user of the picture gets.
    All,
    /// Only where both see the same thing: outlines are counted by themselves, as wrong pixels.
    SameThing,
}

/// Errors of a picture against the right one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Errors {
    /// Pixels at which it shows another thing than the right one, or nothing, or something where
    /// nothing is.
    pub wrong_pixels: usize,
    /// Largest error of depth along the view axis, in the scene's units of length.
    pub depth_max: f64,
    /// Largest error of a channel of radiance, in the scene's units of radiance.
    pub radiance_max: f64,
    /// Root of the mean square error of radiance over counted pixels and channels, likewise.
    pub radiance_rms: f64,
}

impl Errors {
    pub(super) fn of(found: &Picture, right: &Picture, counted: Counted) -> Self {
        let mut errors = Self::default();
        let (mut squares, mut count) = (0.0, 0_usize);
        let pixels = found.seen.iter().zip(&right.seen);
        let colors = found.radiance.iter().zip(&right.radiance);
        for ((found, right), (color, right_color)) in pixels.zip(colors) {
            let is_same = found.map(|seen| seen.id) == right.map(|seen| seen.id);
            errors.wrong_pixels += usize::from(!is_same);
            if counted == Counted::SameThing && !(is_same && right.is_some()) {
                continue;
            }
            if let Some((found, right)) = found.zip(*right) {
                errors.depth_max = errors.depth_max.max((found.depth - right.depth).abs());
            }
            for (channel, right) in color.iter().zip(right_color) {
                let error = (channel - right).abs();
                errors.radiance_max = errors.radiance_max.max(error);
                squares += error * error;
            }
            count += color.len();
        }
        if count > 0 {
            errors.radiance_rms = (squares / count as f64).sqrt();
        }
        errors
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(pixels: &[(Option<(u32, f64)>, f64)]) -> Picture {
        Picture {
            seen: pixels.iter().map(|p| p.0.map(|(id, depth)| Seen { id, depth })).collect(),
            radiance: pixels.iter().map(|p| [p.1; 3]).collect(),
        }
    }

    #[test]
    fn errors_are_those_of_the_pixels_that_count() {
        let right = picture(&[
            (Some((1, 2.0)), 0.5),
            (Some((1, 2.0)), 0.5),
            (Some((2, 3.0)), 0.25),
            (None, 0.0),
        ]);
        let found =
            picture(&[(Some((1, 2.25)), 0.75), (Some((3, 5.0)), 1.5), (None, 0.0), (None, 0.0)]);
        let all = Errors::of(&found, &right, Counted::All);
        assert_eq!((all.wrong_pixels, all.depth_max, all.radiance_max), (2, 3.0, 1.0));
        // Squares 1/16, 1, 1/16 and 0 over four pixels.
        assert_eq!(all.radiance_rms, (1.125_f64 / 4.0).sqrt());
        let same = Errors::of(&found, &right, Counted::SameThing);
        assert_eq!((same.wrong_pixels, same.depth_max), (2, 0.25));
        assert_eq!((same.radiance_max, same.radiance_rms), (0.25, 0.25));
        assert_eq!(Errors::of(&right, &right, Counted::All), Errors::default());
    }
}
