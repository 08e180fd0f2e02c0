//! The ranges of shapes' parameters and the error that names a parameter outside its range.

/// Most triangles that one shape may have. Positions, normals, texture coordinates and three index
/// lists of that many triangles take about 3 GB.
pub const MAX_TRIANGLES: u32 = 40_000_000;

/// Smallest length of a shape, in object units. With it and [`MAX_LENGTH`], products of three
/// lengths stay within 10^±54, far inside f64, and positions inside the range of f32.
pub const MIN_LENGTH: f64 = 1e-18;

/// Largest length of a shape, in object units.
pub const MAX_LENGTH: f64 = 1e18;

/// A parameter of a shape is outside its range.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{shape}: {parameter} is {value}, but must be {range}")]
pub struct ShapeError {
    /// Name of the shape in scene files.
    pub shape: &'static str,
    /// Name of the parameter in scene files.
    pub parameter: &'static str,
    /// The value given.
    pub value: String,
    /// The values that are possible, in words.
    pub range: String,
}

/// Checks a length: a number within [`MIN_LENGTH`]`..=`[`MAX_LENGTH`].
pub(super) fn check_length(
    shape: &'static str,
    parameter: &'static str,
    value: f64,
) -> Result<(), ShapeError> {
    if (MIN_LENGTH..=MAX_LENGTH).contains(&value) {
        return Ok(());
    }
    let range = format!("a length from {MIN_LENGTH:e} to {MAX_LENGTH:e}");
    Err(ShapeError { shape, parameter, value: value.to_string(), range })
}

/// Checks that a count is at least `least`.
pub(super) fn check_count(
    shape: &'static str,
    parameter: &'static str,
    value: u32,
    least: u32,
) -> Result<(), ShapeError> {
    if value >= least {
        return Ok(());
    }
    let range = format!("a whole number of at least {least}");
    Err(ShapeError { shape, parameter, value: value.to_string(), range })
}

/// Checks that a count is within `least..=most`.
pub(super) fn check_count_within(
    shape: &'static str,
    parameter: &'static str,
    value: u32,
    least: u32,
    most: u32,
) -> Result<(), ShapeError> {
    if (least..=most).contains(&value) {
        return Ok(());
    }
    let range = format!("a whole number from {least} to {most}");
    Err(ShapeError { shape, parameter, value: value.to_string(), range })
}

/// Checks a number of triangles. The caller forms it in u128: 16 · (2^32)² fits.
pub(super) fn check_triangles(
    shape: &'static str,
    parameter: &'static str,
    value: impl ToString,
    triangles: u128,
) -> Result<(), ShapeError> {
    if triangles <= u128::from(MAX_TRIANGLES) {
        return Ok(());
    }
    let range =
        format!("small enough for {MAX_TRIANGLES} triangles; this would make {triangles} of them");
    Err(ShapeError { shape, parameter, value: value.to_string(), range })
}
