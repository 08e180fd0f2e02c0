//! From a place in a scene's text with overrides, which nobody wrote, back to where it was written:
//! an entry of the cell's `set`, or the scene file.

use crate::scene::file::text::Span;
use toml::de::{DeTable, DeValue};

/// The byte at a line and a column, both 1-based, columns in characters; column 0 is the line's
/// first.
pub(super) fn offset(text: &str, line: u32, column: u32) -> Option<usize> {
    let lines = text.split_inclusive('\n');
    let start: usize = lines.take(line.checked_sub(1)? as usize).map(str::len).sum();
    let before = text.get(start..)?.chars().take(column.saturating_sub(1) as usize);
    Some(start + before.map(char::len_utf8).sum::<usize>())
}

/// The dotted path of the smallest key or value of a document that holds the byte at `offset`.
pub(super) fn path_at(text: &str, offset: usize) -> Option<String> {
    let mut best: Option<(usize, String)> = None;
    let document = DeTable::parse(text).ok()?;
    walk_table(document.get_ref(), "", &mut |span, path| {
        let is_smaller = best.as_ref().is_none_or(|(length, _)| span.len() < *length);
        if span.contains(&offset) && is_smaller {
            best = Some((span.len(), path.to_owned()));
        }
    });
    best.map(|(_, path)| path)
}

/// Where a path is written in a document; of what is not there, where its nearest parent is.
pub(super) fn span_of(text: &str, path: &str) -> Option<Span> {
    let mut best: Option<(usize, Span)> = None;
    let document = DeTable::parse(text).ok()?;
    walk_table(document.get_ref(), "", &mut |span, known| {
        let is_nearer = best.as_ref().is_none_or(|(length, _)| known.len() >= *length);
        if is_within(path, known) && is_nearer {
            best = Some((known.len(), span));
        }
    });
    best.map(|(_, span)| span)
}

/// Whether `path` is `parent` or leads through it.
pub(super) fn is_within(path: &str, parent: &str) -> bool {
    path.strip_prefix(parent).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
}

/// Visits every key and value with its path; a key before its value.
fn walk_table(table: &DeTable<'_>, path: &str, visit: &mut dyn FnMut(Span, &str)) {
    for (key, value) in table {
        let path = match path {
            "" => key.get_ref().to_string(),
            parent => format!("{parent}.{}", key.get_ref()),
        };
        visit(key.span(), &path);
        visit(value.span(), &path);
        walk(value.get_ref(), &path, visit);
    }
}

fn walk(value: &DeValue<'_>, path: &str, visit: &mut dyn FnMut(Span, &str)) {
    match value {
        DeValue::Table(table) => walk_table(table, path, visit),
        DeValue::Array(elements) => {
            for (index, element) in elements.iter().enumerate() {
                let path = format!("{path}.{index}");
                visit(element.span(), &path);
                walk(element.get_ref(), &path, visit);
            }
        }
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "version = 1\n[image]\nwidth = 0\n[[light]]\ntype = \"spot\"\n[[light]]\n\
                        intensity = [1.0, -2.0, 3.0]\n";

    #[test]
    fn places_become_paths_and_paths_become_places() {
        let at = |line, column| path_at(TEXT, offset(TEXT, line, column).unwrap());
        assert_eq!(at(3, 9).as_deref(), Some("image.width"));
        assert_eq!(at(3, 1).as_deref(), Some("image.width"));
        assert_eq!(at(5, 8).as_deref(), Some("light.0.type"));
        assert_eq!(at(6, 1).as_deref(), Some("light.1"));
        assert_eq!(at(7, 19).as_deref(), Some("light.1.intensity.1"));
        let text_of = |path| &TEXT[span_of(TEXT, path).unwrap()];
        assert_eq!(text_of("image.width"), "0");
        assert_eq!(text_of("light.1.intensity.1"), "-2.0");
        assert_eq!(text_of("light.0.exponent"), "[[light]]");
        assert_eq!(span_of(TEXT, "camera.eye"), None);
    }

    #[test]
    fn a_longer_name_is_not_within_a_shorter_one() {
        assert!(is_within("mesh.1.file", "mesh.1") && is_within("mesh.1", "mesh.1"));
        assert!(!is_within("mesh.10", "mesh.1") && !is_within("mesh", "mesh.1"));
    }
}
