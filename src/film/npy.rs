//! Triangle ids as a NumPy array. The other planes go to EXR.

use npyz::WriterBuilder;

use super::check::check_film;
use super::{Film, FilmError, Samples};

/// The plane `id.prim` as the bytes of an NPY file: shape (height, width) of the film's window,
/// little-endian u32, rows from the top; 0xFFFF_FFFF where nothing is visible.
///
/// # Errors
///
/// [`FilmError::Plane`] without such a plane, [`FilmError::Inconsistent`] for a broken film.
pub fn encode_npy_ids(film: &Film) -> Result<Vec<u8>, FilmError> {
    check_film(film)?;
    let Some(Samples::Uint(ids)) = film.plane("id.prim") else {
        let wanted = "unsigned integers";
        return Err(FilmError::Plane { format: "NPY", plane: "id.prim", wanted });
    };
    let shape = [u64::from(film.window.height()), u64::from(film.window.width())];
    write_array(&shape, ids)
        .map_err(|error| FilmError::Encode { format: "NPY", reason: error.to_string() })
}

/// A C-ordered little-endian u32 array. The type string is spelt out, so that the bytes do not
/// depend on the machine's own order.
fn write_array(shape: &[u64], values: &[u32]) -> std::io::Result<Vec<u8>> {
    let little_endian: npyz::TypeStr = "<u4".parse().map_err(std::io::Error::other)?;
    let mut bytes = Vec::with_capacity(values.len() * 4 + 128);
    let mut writer = npyz::WriteOptions::<u32>::new()
        .dtype(npyz::DType::Plain(little_endian))
        .shape(shape)
        .writer(&mut bytes)
        .begin_nd()?;
    writer.extend(values.iter().copied())?;
    writer.finish()?;
    Ok(bytes)
}
