//! A sheet file as written, with the place of every value. Only the form is checked, and the counts
//! of labels; scenes are read by `cells`.

use super::MAX_CELLS;
use crate::pixel::{MAX_SIDE, Resolution};
use crate::scene::error::{Place, SceneError};
use crate::scene::file::suggestion;
use crate::scene::file::text::{Faults, Span};
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

/// A table that is being read, as messages call it.
struct Table<'a, 't> {
    table: &'a DeTable<'t>,
    title: &'static str,
}

impl<'a, 't> Table<'a, 't> {
    /// Reports every key that is not among `known`.
    fn new(
        table: &'a DeTable<'t>,
        title: &'static str,
        known: &[&str],
        faults: &mut Faults<'_>,
    ) -> Self {
        for key in table.keys().filter(|key| !known.contains(&key.get_ref().as_ref())) {
            let message = format!("unknown key `{}` in {title}", key.get_ref());
            faults.at_with_help(&key.span(), message, suggestion(key.get_ref(), known));
        }
        Self { table, title }
    }

    /// A value read by `reader`; `None` when it is absent or, which is reported, not `wanted`.
    fn read<T>(
        &self,
        name: &str,
        wanted: &str,
        reader: impl Fn(&'a DeValue<'t>) -> Option<T>,
        faults: &mut Faults<'_>,
    ) -> Option<Spanned<T>> {
        let value = self.table.get(name)?;
        let read = reader(value.get_ref());
        if read.is_none() {
            let found = value.get_ref().type_str();
            let message = format!("`{name}` in {} must be {wanted} (it is a {found})", self.title);
            faults.at(&value.span(), message);
        }
        read.map(|read| Spanned::new(value.span(), read))
    }

    fn text(&self, name: &str, faults: &mut Faults<'_>) -> Option<Spanned<String>> {
        self.read(name, "a text", |value| value.as_str().map(str::to_owned), faults)
    }

    fn texts(&self, name: &str, faults: &mut Faults<'_>) -> Option<Spanned<Vec<String>>> {
        let text = |value: &Spanned<DeValue<'_>>| value.get_ref().as_str().map(str::to_owned);
        self.read(name, "a list of texts", |v| v.as_array()?.iter().map(text).collect(), faults)
    }

    fn whole(
        &self,
        name: &str,
        (least, most): (i64, i64),
        faults: &mut Faults<'_>,
    ) -> Option<Spanned<i64>> {
        let wanted = format!("a whole number from {least} to {most}");
        let in_range = |number: &i64| (least..=most).contains(number);
        self.read(name, &wanted, |value| whole(value).filter(in_range), faults)
    }
}

fn whole(value: &DeValue<'_>) -> Option<i64> {
    let digits = value.as_integer()?;
    i64::from_str_radix(digits.as_str(), digits.radix()).ok()
}

const KEYS: [&str; 8] =
    ["version", "scene", "columns", "title", "row_labels", "column_labels", "size", "cell"];

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
        let table = Table::new(document.get_ref(), "the sheet file", &KEYS, faults);
        for (name, form) in [("version", "version = 1"), ("cell", "[[cell]]")] {
            if !table.table.contains_key(name) {
                let message = format!("the sheet file lacks `{form}`");
                faults.errors.push(SceneError::scene(Place::file(faults.file), message));
            }
        }
        table.whole("version", (VERSION, VERSION), faults);
        let tables = table.read("cell", "a list of tables: write [[cell]]", tables, faults);
        let cells: Vec<_> = tables
            .map(Spanned::into_inner)
            .into_iter()
            .flatten()
            .map(|(cell, span)| CellFile::read(cell, span, faults))
            .collect();
        let columns = table.whole("columns", (1, MAX_CELLS as i64), faults);
        let row_labels = table.texts("row_labels", faults);
        let column_labels = table.texts("column_labels", faults);
        let mut file = Self {
            scene: table.text("scene", faults),
            title: table.text("title", faults).map(Spanned::into_inner),
            columns: match (&columns, &column_labels) {
                (Some(columns), _) => *columns.get_ref() as usize,
                (None, Some(labels)) => labels.get_ref().len().max(1),
                (None, None) => 0,
            },
            size: table
                .read("size", "a table: write [size]", DeValue::as_table, faults)
                .and_then(|size| read_size(size, faults)),
            cells,
            ..Self::default()
        };
        if file.columns == 0 && !table.table.contains_key("columns") {
            let message = "the sheet file lacks `columns` (or `column_labels`)";
            faults.errors.push(SceneError::scene(Place::file(faults.file), message));
        }
        file.columns = file.columns.max(1);
        if file.cells.is_empty() && table.table.contains_key("cell") {
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

/// The tables of a list of tables, with their places.
fn tables<'a, 't>(value: &'a DeValue<'t>) -> Option<Vec<(&'a DeTable<'t>, Span)>> {
    let tables = value.as_array()?.iter();
    tables.map(|element| Some((element.get_ref().as_table()?, element.span()))).collect()
}

fn read_size(size: Spanned<&DeTable<'_>>, faults: &mut Faults<'_>) -> Option<Resolution> {
    let span = size.span();
    let table = Table::new(size.get_ref(), "[size]", &["width", "height"], faults);
    let mut side = |name: &str| {
        if !table.table.contains_key(name) {
            faults.at(&span, format!("[size] lacks `{name}`"));
        }
        table.whole(name, (1, i64::from(MAX_SIDE)), faults).map(|side| *side.get_ref() as u32)
    };
    let (width, height) = (side("width"), side("height"));
    Resolution::new(width?, height?)
}

impl CellFile {
    fn read(table: &DeTable<'_>, span: Span, faults: &mut Faults<'_>) -> Self {
        let table = Table::new(table, "[[cell]]", &["label", "scene", "set"], faults);
        let set = table.read("set", "a table of paths and values", DeValue::as_table, faults);
        let mut set: Vec<_> = set
            .map(Spanned::into_inner)
            .into_iter()
            .flat_map(|set| set.iter())
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
        Self {
            label: table.text("label", faults).map(Spanned::into_inner),
            scene: table.text("scene", faults),
            set,
            span,
        }
    }
}
