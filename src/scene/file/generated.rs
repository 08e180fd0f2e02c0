//! `shape = { NAME = { … } }` as written: serde reads it, and its complaints are put into our words.

use super::keys::suggestion;
use super::shape::ShapeFile;
use super::text::{Faults, Span};
use super::values::{Value, kind, number};
use serde::Deserialize;
use toml::Spanned;
use toml::de::{DeValue, Error, ValueDeserializer};

/// A generated mesh.
#[derive(Clone, Debug)]
pub struct GeneratedFile {
    /// The shape and its parameters.
    pub shape: Spanned<ShapeFile>,
    /// The parameters that are written, and where their values stand.
    pub parameters: Vec<Spanned<String>>,
}

impl GeneratedFile {
    pub(super) fn read(value: &Value<'_>, faults: &mut Faults<'_>) -> Option<Self> {
        let DeValue::Table(table) = value.get_ref() else {
            let message = format!("`shape` must be a table, not {}", kind(value.get_ref()));
            faults.at_with_help(&value.span(), message, "write `shape = { NAME = { … } }`");
            return None;
        };
        let mut shapes = table.iter();
        let (Some((name, written)), None) = (shapes.next(), shapes.next()) else {
            let message = format!("`shape` must name one shape, not {}", table.len());
            faults.at(&value.span(), message);
            return None;
        };
        let DeValue::Table(table) = written.get_ref() else {
            let (name, found) = (name.get_ref(), kind(written.get_ref()));
            let message = format!("`{name}` must be a table of its parameters, not {found}");
            faults.at(&written.span(), message);
            return None;
        };
        let before = faults.errors.len();
        for (key, value) in table {
            refuse_non_finite(key.get_ref(), value, faults);
        }
        if faults.errors.len() > before {
            return None;
        }
        let parameters = table
            .iter()
            .map(|(key, value)| Spanned::new(value.span(), key.get_ref().to_string()))
            .collect();
        match ShapeFile::deserialize(ValueDeserializer::from(value.clone())) {
            Ok(shape) => Some(Self { shape: Spanned::new(value.span(), shape), parameters }),
            Err(error) => {
                report(&error, name.get_ref(), &parameters, &value.span(), faults);
                None
            }
        }
    }
}

/// Refuses NaN and infinities where each has a place.
fn refuse_non_finite(key: &str, value: &Value<'_>, faults: &mut Faults<'_>) {
    match value.get_ref() {
        DeValue::Array(elements) => {
            elements.iter().for_each(|element| refuse_non_finite(key, element, faults));
        }
        DeValue::Float(_) => {
            if let Err(wrong) = number(value) {
                let message = format!("`{key}` must be {}, not {}", wrong.expected, wrong.found);
                faults.at(&wrong.span, message);
            }
        }
        _ => {}
    }
}

/// Says in our words what serde says of a shape.
fn report(
    error: &Error,
    shape: &str,
    parameters: &[Spanned<String>],
    whole: &Span,
    faults: &mut Faults<'_>,
) {
    let span = error.span().unwrap_or_else(|| whole.clone());
    let message = error.message();
    // Names stand in backticks: the offender first, then those that are known.
    let quoted: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
    match (&quoted[..], message.split_once(", expected ")) {
        ([offender, known @ ..], _) if message.starts_with("unknown field") => faults.at_with_help(
            &span,
            format!("unknown key `{offender}` in shape `{shape}`"),
            suggestion(offender, known),
        ),
        ([offender, known @ ..], _) if message.starts_with("unknown variant") => {
            let help = suggestion(offender, known);
            faults.at_with_help(&span, format!("there is no shape `{offender}`"), help);
        }
        ([lacking, ..], _) if message.starts_with("missing field") => {
            faults.at(&span, format!("shape `{shape}` lacks `{lacking}`"));
        }
        (_, Some((found, expected))) => {
            let key = parameters.iter().find(|parameter| parameter.span() == span);
            let name = key.map_or(shape, |key| key.get_ref());
            let expected = match expected {
                "f64" => "a number",
                "u32" | "u64" | "usize" => "a whole number, 0 or more",
                "a boolean" => "true or false",
                other => other,
            };
            // "invalid type: floating point `1.5`" and the like: only the value is of interest.
            let found = match (&quoted[..], found.rsplit_once(": ")) {
                ([value, ..], _) if found.contains('`') => value,
                (_, Some((_, found))) => found,
                _ => found,
            };
            faults.at(&span, format!("`{name}` must be {expected}, not {found}"));
        }
        _ => {
            let key = parameters.iter().find(|parameter| parameter.span() == span);
            let name = key.map_or(shape, |key| key.get_ref());
            faults.at(&span, format!("`{name}`: {message}"));
        }
    }
}
