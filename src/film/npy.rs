//! NumPy arrays: our triangle ids written, others' numbers read. Our other planes go to EXR.

use npyz::WriterBuilder;

use super::check::check_film;
use super::read::full_plane;
use super::{Film, FilmError, NumberPlane, Numbers, Samples};

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

/// A two-dimensional array of shape (height, width), u8 to u64, i8 to i64, f32 or f64, in either
/// byte order, by rows or by columns; a third axis of length 1 is dropped.
pub(super) fn decode_npy(bytes: &[u8]) -> Result<NumberPlane, String> {
    let file = npyz::NpyFile::new(bytes).map_err(|error| error.to_string())?;
    let (height, width) = match *file.shape() {
        [height, width] | [height, width, 1] => (height, width),
        ref other => {
            return Err(format!("its shape is {other:?}; it must be (height, width)"));
        }
    };
    let promised = width.checked_mul(height).and_then(|count| usize::try_from(count).ok());
    if promised.is_none_or(|count| count > bytes.len()) {
        return Err(format!("it is shorter than {width}x{height} numbers"));
    }
    let by_columns = file.order() == npyz::Order::Fortran;
    let numbers = read_numbers(file)?;
    let plane = full_plane(width, height, numbers)?;
    Ok(if by_columns { NumberPlane { numbers: transposed(&plane), ..plane } } else { plane })
}

/// The numbers in the order of the file.
fn read_numbers(file: npyz::NpyFile<&[u8]>) -> Result<Numbers, String> {
    use npyz::TypeChar::{Bool, Float, Int, Uint};
    fn all<T: npyz::Deserialize>(file: npyz::NpyFile<&[u8]>) -> Result<Vec<T>, String> {
        file.into_vec().map_err(|error| error.to_string())
    }
    fn whole<T: npyz::Deserialize + Into<i64>>(
        file: npyz::NpyFile<&[u8]>,
    ) -> Result<Numbers, String> {
        Ok(Numbers::Whole(all::<T>(file)?.into_iter().map(Into::into).collect()))
    }
    let dtype = file.dtype();
    let kind = match &dtype {
        npyz::DType::Plain(kind) => Some((kind.type_char(), kind.size_field())),
        _ => None,
    };
    match kind {
        Some((Bool, _)) => whole::<bool>(file),
        Some((Uint, 1)) => whole::<u8>(file),
        Some((Uint, 2)) => whole::<u16>(file),
        Some((Uint, 4)) => whole::<u32>(file),
        Some((Uint, 8)) => {
            Ok(Numbers::Whole(all::<u64>(file)?.into_iter().map(|v| v as i64).collect()))
        }
        Some((Int, 1)) => whole::<i8>(file),
        Some((Int, 2)) => whole::<i16>(file),
        Some((Int, 4)) => whole::<i32>(file),
        Some((Int, 8)) => whole::<i64>(file),
        Some((Float, 4)) => {
            Ok(Numbers::Float(all::<f32>(file)?.into_iter().map(f64::from).collect()))
        }
        Some((Float, 8)) => Ok(Numbers::Float(all::<f64>(file)?)),
        _ => Err(format!(
            "its numbers are {}; they must be whole numbers or 32- or 64-bit floats",
            dtype.descr()
        )),
    }
}

/// Columns after columns as rows after rows.
fn transposed(plane: &NumberPlane) -> Numbers {
    fn turn<T: Copy>(values: &[T], width: usize, height: usize) -> Vec<T> {
        (0..width * height).map(|i| values[(i % width) * height + i / width]).collect()
    }
    let (width, height) = (plane.frame.width() as usize, plane.frame.height() as usize);
    match &plane.numbers {
        Numbers::Whole(values) => Numbers::Whole(turn(values, width, height)),
        Numbers::Float(values) => Numbers::Float(turn(values, width, height)),
    }
}
