//! A sheet file as written, with the place of every value. Only the form is checked, and the counts
//! of labels; scenes are read by `cells`.

use super::MAX_CELLS;
use crate::pixel::{MAX_SIDE, Resolution};
use crate::scene::error::{Place, SceneError};
use crate::scene::file::keys::Keys;
use crate::scene::file::text::{Faults, Span};
use crate::scene::file::values::{Misread, Value, kind, text, whole};
use serde::Deserialize as _;
use toml::Spanned;
use toml::de::{DeTable, DeValue, ValueDeserializer};

/// The one version of the format.
const VERSION: i64 = 1;

/// A sheet as written.
#[derive(Default)]
pub(super) struct SheetFile {
    pub(super) scene: Option<Spanned<String>>,
    pub(super) title: Option<String>,
    pub(super) columns: usize,
    pub(super) row_labels: Vec<String>,
    pub(super) column_labels: Vec<String>,
    pub(super) size: Option<Resolution>,
    pub(super) cells: Vec<CellFile>,
}

/// A `[[cell]]` as written.
pub(super) struct CellFile {
    pub(super) label: Option<String>,
    pub(super) scene: Option<Spanned<String>>,
    pub(super) set: Vec<Override>,
    pub(super) span: Span,
}

/// One entry of `set`.
pub(super) struct Override {
    pub(super) path: String,
    pub(super) value: toml::Value,
    pub(super) span: Span,
}

impl SheetFile {
    /// Reads what the text says and reports what is wrong with its form.
    pub(super) fn read(faults: &mut Faults<'_>) -> Self {
        let document = match DeTable::parse(faults.text) {
            Ok(document) => document,
            Err(error) => {
                let span = error.span().unwrap_or(0..0);
                faults.at(&span, format!("not TOML: {}", error.message()));
                return Self::default();
            }
        };
        let table = document.get_ref();
        for (name, form) in [("version", "version = 1"), ("cell", "[[cell]]")] {
            if !table.contains_key(name) {
                let message = format!("the sheet file lacks `{form}`");
                faults.errors.push(SceneError::scene(Place::file(faults.file), message));
            }
        }
        let mut keys = Keys::new(table, 0..0, "the sheet file");
        let version = keys.read("version", whole, faults);
        within(&version, "version", (VERSION, VERSION), faults);
        let tables = keys.tables("cell", "[[cell]]", faults);
        let cells: Vec<_> = tables.into_iter().map(|keys| CellFile::read(keys, faults)).collect();
        let columns = keys.read("columns", whole, faults);
        let columns = within(&columns, "columns", (1, MAX_CELLS as i64), faults);
        let row_labels = keys.read("row_labels", texts, faults);
        let column_labels = keys.read("column_labels", texts, faults);
        let size = keys.table("size", "[size]", faults);
        let mut file = Self {
            scene: keys.read("scene", text, faults),
            title: keys.read("title", text, faults).map(Spanned::into_inner),
            columns: match (&columns, &column_labels) {
                (Some(columns), _) => *columns as usize,
                (None, Some(labels)) => labels.get_ref().len().max(1),
                (None, None) => 0,
            },
            size: size.and_then(|size| read_size(size, faults)),
            cells,
            ..Self::default()
        };
        keys.close(faults);
        if file.columns == 0 && !table.contains_key("columns") {
            let message = "the sheet file lacks `columns` (or `column_labels`)";
            faults.errors.push(SceneError::scene(Place::file(faults.file), message));
        }
        file.columns = file.columns.max(1);
        if file.cells.is_empty() && table.contains_key("cell") {
            let message = "the sheet file has no cell";
            faults.errors.push(SceneError::scene(Place::file(faults.file), message));
        }
        if file.cells.len() > MAX_CELLS {
            let message = format!("{} cells; a sheet has at most {MAX_CELLS}", file.cells.len());
            faults.at(&file.cells[MAX_CELLS].span, message);
        }
        let rows = file.cells.len().div_ceil(file.columns);
        let labels =
            [("row_labels", &row_labels, rows), ("column_labels", &column_labels, file.columns)];
        for (name, labels, wanted) in labels {
            if let Some(labels) = labels.as_ref().filter(|labels| labels.get_ref().len() != wanted)
            {
                let found = labels.get_ref().len();
                let message = format!(
                    "`{name}` has {found} texts, but {} cells in {} columns make {rows} rows",
                    file.cells.len(),
                    file.columns
                );
                faults.at_with_help(&labels.span(), message, format!("give {wanted} texts"));
            }
        }
        file.row_labels = row_labels.map(Spanned::into_inner).unwrap_or_default();
        file.column_labels = column_labels.map(Spanned::into_inner).unwrap_or_default();
        file
    }
}

/// A list of strings.
fn texts(value: &Value<'_>) -> Result<Vec<String>, Misread> {
    match value.get_ref() {
        DeValue::Array(elements) => elements.iter().map(text).collect(),
        other => Err(Misread {
            span: value.span(),
            expected: "a list of strings".to_owned(),
            found: kind(other).to_owned(),
        }),
    }
}

/// A whole number in a range; one outside is reported.
fn within(
    value: &Option<Spanned<i64>>,
    name: &str,
    (least, most): (i64, i64),
    faults: &mut Faults<'_>,
) -> Option<i64> {
    let value = value.as_ref()?;
    let number = *value.get_ref();
    if !(least..=most).contains(&number) {
        let message = match least == most {
            true => format!("`{name}` must be {least}, not {number}"),
            false => format!("`{name}` must be from {least} to {most}, not {number}"),
        };
        faults.at(&value.span(), message);
        return None;
    }
    Some(number)
}

fn read_size(mut keys: Keys<'_, '_>, faults: &mut Faults<'_>) -> Option<Resolution> {
    let (width, height) =
        (keys.require("width", whole, faults), keys.require("height", whole, faults));
    let range = (1, i64::from(MAX_SIDE));
    let (width, height) =
        (within(&width, "width", range, faults), within(&height, "height", range, faults));
    keys.close(faults);
    Resolution::new(width? as u32, height? as u32)
}

impl CellFile {
    fn read(mut keys: Keys<'_, '_>, faults: &mut Faults<'_>) -> Self {
        let label = keys.read("label", text, faults).map(Spanned::into_inner);
        let scene = keys.read("scene", text, faults);
        let entries: Vec<_> = match keys.ask("set").map(|set| (set.span(), set.get_ref())) {
            None => Vec::new(),
            Some((_, DeValue::Table(set))) => set.iter().collect(),
            Some((span, other)) => {
                let found = kind(other);
                let message = format!("`set` must be a table of paths and values, not {found}");
                keys.fault(&span, message, faults);
                Vec::new()
            }
        };
        let mut set: Vec<_> = entries
            .into_iter()
            .filter_map(|(key, value)| {
                let owned = toml::Value::deserialize(ValueDeserializer::from(value.clone()));
                match owned {
                    Ok(owned) => {
                        let path = key.get_ref().to_string();
                        Some(Override { path, value: owned, span: key.span() })
                    }
                    Err(error) => {
                        let span = error.span().unwrap_or_else(|| value.span());
                        faults.at(&span, error.message());
                        None
                    }
                }
            })
            .collect();
        set.sort_by_key(|entry| entry.span.start);
        let span = keys.header.clone();
        keys.close(faults);
        Self { label, scene, set, span }
    }
}
