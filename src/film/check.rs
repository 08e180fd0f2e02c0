//! The rules a film must keep before it can be encoded.

use super::{Film, FilmError};

/// Longest channel name, in bytes, that EXR allows.
const MAX_NAME_BYTES: usize = 255;

/// Checks that every plane has one sample per pixel and that the names are usable and unique.
///
/// # Errors
///
/// [`FilmError::Inconsistent`] that names the rule and the plane.
pub(super) fn check_film(film: &Film) -> Result<(), FilmError> {
    let broken = |reason: String| Err(FilmError::Inconsistent { reason });
    if film.planes.is_empty() {
        return broken("it has no plane".to_owned());
    }
    let frame = film.resolution.window();
    if film.window.x1() > frame.x1() || film.window.y1() > frame.y1() {
        return broken(format!("{:?} reaches outside {:?}", film.window, film.resolution));
    }
    let pixels = film.window.len();
    for plane in &film.planes {
        let name = &plane.name;
        if name.is_empty() || name.len() > MAX_NAME_BYTES || name.contains('\0') {
            return broken(format!("{name:?} cannot name a plane"));
        }
        if plane.samples.len() != pixels {
            let found = plane.samples.len();
            return broken(format!("the plane `{name}` has {found} samples for {pixels} pixels"));
        }
    }
    let mut names: Vec<&str> = film.planes.iter().map(|plane| plane.name.as_str()).collect();
    names.sort_unstable();
    match names.windows(2).find(|pair| pair[0] == pair[1]) {
        Some(pair) => broken(format!("two planes are named `{}`", pair[0])),
        None => Ok(()),
    }
}
