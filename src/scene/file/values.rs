//! One value of the text, read as what its key asks for, or a reason in plain words.

use super::text::Span;
use toml::Spanned;
use toml::de::DeValue;

/// A value of the text.
pub(crate) type Value<'t> = Spanned<DeValue<'t>>;

/// Why a value is not what its key asks for: "must be EXPECTED, not FOUND".
pub(crate) struct Misread {
    pub(crate) span: Span,
    pub(crate) expected: String,
    pub(crate) found: String,
}

fn misread<T>(value: &Value<'_>, expected: &str, found: impl Into<String>) -> Result<T, Misread> {
    Err(Misread { span: value.span(), expected: expected.to_owned(), found: found.into() })
}

/// What a value is, in plain words.
pub(crate) fn kind(value: &DeValue<'_>) -> &'static str {
    match value {
        DeValue::String(_) => "a string",
        DeValue::Integer(_) => "a whole number",
        DeValue::Float(_) => "a number with a fraction",
        DeValue::Boolean(_) => "true or false",
        DeValue::Datetime(_) => "a date",
        DeValue::Array(_) => "a list",
        DeValue::Table(_) => "a table",
    }
}

/// A text.
pub(crate) fn text(value: &Value<'_>) -> Result<String, Misread> {
    match value.get_ref() {
        DeValue::String(text) => Ok(text.to_string()),
        other => misread(value, "a string", kind(other)),
    }
}

/// True or false.
pub(crate) fn boolean(value: &Value<'_>) -> Result<bool, Misread> {
    match value.get_ref() {
        DeValue::Boolean(boolean) => Ok(*boolean),
        other => misread(value, "true or false", kind(other)),
    }
}

/// A whole number.
pub(crate) fn whole(value: &Value<'_>) -> Result<i64, Misread> {
    match value.get_ref() {
        DeValue::Integer(digits) => match i64::from_str_radix(digits.as_str(), digits.radix()) {
            Ok(number) => Ok(number),
            Err(_) => misread(value, "a whole number of at most 64 bits", digits.to_string()),
        },
        other => misread(value, "a whole number", kind(other)),
    }
}

/// A finite number; whole numbers are numbers too.
pub(crate) fn number(value: &Value<'_>) -> Result<f64, Misread> {
    match value.get_ref() {
        DeValue::Integer(_) => whole(value).map(|number| number as f64),
        DeValue::Float(digits) => match digits.as_str().parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(number),
            _ => misread(value, "a finite number", digits.as_str()),
        },
        other => misread(value, "a number", kind(other)),
    }
}

/// N numbers in a list.
pub(crate) fn numbers<const N: usize>(value: &Value<'_>) -> Result<[f64; N], Misread> {
    let expected = format!("a list of {N} numbers");
    let DeValue::Array(elements) = value.get_ref() else {
        return misread(value, &expected, kind(value.get_ref()));
    };
    if elements.len() != N {
        return misread(value, &expected, format!("a list of {}", elements.len()));
    }
    let mut list = [0.0; N];
    for (slot, element) in list.iter_mut().zip(elements.iter()) {
        *slot = number(element).map_err(|wrong| Misread {
            expected: format!("{expected}, each {}", wrong.expected),
            ..wrong
        })?;
    }
    Ok(list)
}

/// One number for all three axes, or three.
pub(crate) fn one_or_three(value: &Value<'_>) -> Result<[f64; 3], Misread> {
    match value.get_ref() {
        DeValue::Array(_) => numbers(value),
        DeValue::Integer(_) | DeValue::Float(_) => number(value).map(|number| [number; 3]),
        other => misread(value, "a number or a list of 3 numbers", kind(other)),
    }
}

/// N rows of N numbers, or the same numbers in one list, row by row.
pub(crate) fn matrix<const N: usize>(value: &Value<'_>) -> Result<[[f64; N]; N], Misread> {
    let expected = format!("{N} lists of {N} numbers (or the {} numbers, row by row)", N * N);
    let DeValue::Array(elements) = value.get_ref() else {
        return misread(value, &expected, kind(value.get_ref()));
    };
    let mut rows = [[0.0; N]; N];
    let of_rows = elements.iter().any(|element| element.get_ref().is_array());
    if elements.len() == N && of_rows {
        for (row, element) in rows.iter_mut().zip(elements.iter()) {
            *row = numbers(element)?;
        }
    } else if elements.len() == N * N {
        for (index, element) in elements.iter().enumerate() {
            rows[index / N][index % N] = number(element)?;
        }
    } else {
        return misread(value, &expected, format!("a list of {}", elements.len()));
    }
    Ok(rows)
}
