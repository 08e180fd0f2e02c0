//! The keys of one table of the scene file.
//!
//! Whoever reads a table asks for each key that it knows; what was written and never asked for is
//! an unknown key. So the parser's list of keys is what the parser reads, and cannot drift from it.

use super::refused;
use super::text::{Faults, Span};
use super::values::{Misread, Value, kind};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Similarity (Jaro-Winkler, 0…1) from which a known key is offered for an unknown one: finds
/// "fov" → "fov_y_deg" (0.84) and "widht" → "width", and leaves "ke" → "kd" (0.70) alone.
const SIMILAR: f64 = 0.8;

/// A table that is being read.
pub(crate) struct Keys<'a, 't> {
    table: &'a DeTable<'t>,
    /// The table as messages call it, such as `[[light]]`.
    title: &'static str,
    /// Where the table begins.
    pub(crate) header: Span,
    asked: Vec<&'static str>,
    /// Required keys that are not there.
    missing: Vec<&'static str>,
    clean: bool,
}

impl<'a, 't> Keys<'a, 't> {
    pub(crate) fn new(table: &'a DeTable<'t>, header: Span, title: &'static str) -> Self {
        Self { table, title, header, asked: Vec::new(), missing: Vec::new(), clean: true }
    }

    /// The value of a key, as it is written.
    pub(crate) fn ask(&mut self, name: &'static str) -> Option<&'a Value<'t>> {
        self.asked.push(name);
        self.table.get(name)
    }

    /// The value of a key; `None` when it is absent or faulty, and the fault is reported.
    pub(crate) fn read<T>(
        &mut self,
        name: &'static str,
        reader: fn(&Value<'_>) -> Result<T, Misread>,
        faults: &mut Faults<'_>,
    ) -> Option<Spanned<T>> {
        let value = self.ask(name)?;
        match reader(value) {
            Ok(read) => Some(Spanned::new(value.span(), read)),
            Err(Misread { span, expected, found }) => {
                self.fault(&span, format!("`{name}` must be {expected}, not {found}"), faults);
                None
            }
        }
    }

    /// The value of a key that must be there.
    pub(crate) fn require<T>(
        &mut self,
        name: &'static str,
        reader: fn(&Value<'_>) -> Result<T, Misread>,
        faults: &mut Faults<'_>,
    ) -> Option<Spanned<T>> {
        let read = self.read(name, reader, faults);
        if !self.table.contains_key(name) {
            self.missing.push(name);
            self.clean = false;
        }
        read
    }

    /// The table under a key.
    pub(crate) fn table(
        &mut self,
        name: &'static str,
        title: &'static str,
        faults: &mut Faults<'_>,
    ) -> Option<Keys<'a, 't>> {
        let value = self.ask(name)?;
        let DeValue::Table(table) = value.get_ref() else {
            let found = kind(value.get_ref());
            let message = format!("`{name}` must be a table, not {found}: write `{title}`");
            self.fault(&value.span(), message, faults);
            return None;
        };
        Some(Keys::new(table, value.span(), title))
    }

    /// The list of tables under a key; each as it comes, in file order.
    pub(crate) fn tables(
        &mut self,
        name: &'static str,
        title: &'static str,
        faults: &mut Faults<'_>,
    ) -> Vec<Keys<'a, 't>> {
        let Some(value) = self.ask(name) else { return Vec::new() };
        let DeValue::Array(elements) = value.get_ref() else {
            let message =
                format!("`{name}` must be a list of tables, not {}", kind(value.get_ref()));
            faults.at_with_help(&value.span(), message, format!("write `{title}`"));
            self.clean = false;
            return Vec::new();
        };
        let mut tables = Vec::new();
        for element in elements.iter() {
            match element.get_ref() {
                DeValue::Table(table) => tables.push(Keys::new(table, element.span(), title)),
                other => {
                    let message = format!("a `{name}` must be a table, not {}", kind(other));
                    self.fault(&element.span(), message, faults);
                }
            }
        }
        tables
    }

    /// The keys that are written, with their places, in file order.
    pub(crate) fn written(&self) -> Vec<Spanned<String>> {
        let mut keys: Vec<_> = self
            .table
            .keys()
            .map(|key| Spanned::new(key.span(), key.get_ref().to_string()))
            .collect();
        keys.sort_by_key(|key| key.span().start);
        keys
    }

    /// Reports a fault of this table.
    pub(crate) fn fault(
        &mut self,
        span: &Span,
        message: impl Into<String>,
        faults: &mut Faults<'_>,
    ) {
        self.clean = false;
        faults.at(span, message);
    }

    /// Reports every key that is missing and every key that nobody asked for; a missing key that
    /// an unknown one was meant to be is not reported twice. Whether the table had no fault at all.
    pub(crate) fn close(self, faults: &mut Faults<'_>) -> bool {
        let unknown: Vec<_> = self
            .written()
            .into_iter()
            .filter(|key| !self.asked.contains(&key.get_ref().as_str()))
            .collect();
        for missing in &self.missing {
            let is_misspelt =
                |key: &Spanned<String>| most_similar(key.get_ref(), &self.asked) == Some(*missing);
            if !unknown.iter().any(is_misspelt) {
                faults.at(&self.header, format!("{} lacks `{missing}`", self.title));
            }
        }
        let clean = self.clean && unknown.is_empty();
        for key in &unknown {
            let name = key.get_ref().as_str();
            match refused::effect_of_key(name) {
                Some(effect) => faults.at(&key.span(), format!("`{name}`: {effect}")),
                None => faults.at_with_help(
                    &key.span(),
                    format!("unknown key `{name}` in {}", self.title),
                    suggestion(name, &self.asked),
                ),
            }
        }
        clean
    }
}

/// "did you mean …?" where a known word is similar, else all known words.
pub(crate) fn suggestion(written: &str, known: &[&str]) -> String {
    match most_similar(written, known) {
        Some(word) => format!("did you mean `{word}`?"),
        None => format!("known here: {}", known.join(", ")),
    }
}

/// The known word that is most similar, if any is similar enough.
fn most_similar<'k>(written: &str, known: &[&'k str]) -> Option<&'k str> {
    let similarity = |word: &str| strsim::jaro_winkler(&written.to_lowercase(), word);
    known
        .iter()
        .map(|&word| (similarity(word), word))
        .max_by(|(a, _), (b, _)| a.total_cmp(b))
        .filter(|(similarity, _)| *similarity >= SIMILAR)
        .map(|(_, word)| word)
}
