//! From a sheet file to a sheet: each cell's scene, with what the cell sets, through the scene
//! parser; or everything that is wrong with them.

use super::file::{CellFile, SheetFile};
use super::layout::Layout;
use super::{Cell, MAX_PIXELS, Sheet, overrides, trace};
use crate::scene::error::{Fault, Place, SceneError};
use crate::scene::file::text::{Faults, line_and_column};
use crate::scene::{Overrides, Scene, SceneErrors};
use std::collections::{HashMap, HashSet};
use std::path::{Path, PathBuf};
use toml::Value;

impl Sheet {
    /// Reads a sheet file and the scenes that it names.
    ///
    /// # Errors
    /// Everything that is wrong with the sheet, its scenes or their meshes.
    pub fn load(path: &Path) -> Result<Self, SceneErrors> {
        let text = read_text(path).map_err(|(fault, why)| {
            let message = format!("the sheet file cannot be read: {why}");
            let reading = SceneError::reading(Place::file(path), message);
            SceneErrors(vec![SceneError { fault, ..reading }])
        })?;
        let mut faults = Faults::new(path, &text);
        let file = SheetFile::read(&mut faults);
        let mut shared = Shared::default();
        let mut cells = Vec::new();
        if faults.errors.is_empty() {
            for (cell, number) in file.cells.iter().zip(1..) {
                let shared = &mut shared;
                let reader = Reader { sheet: &file, cell, number, faults: &mut faults, shared };
                if let Some(scene) = reader.read() {
                    cells.push(Cell { label: cell.label.clone(), scene });
                }
            }
        }
        let sheet = Self {
            title: file.title,
            columns: file.columns,
            row_labels: file.row_labels,
            column_labels: file.column_labels,
            cells,
            warnings: std::mem::take(&mut faults.warnings),
        };
        if faults.errors.is_empty() {
            let [width, height] = Layout::of(&sheet).size.map(u64::from);
            if width * height > MAX_PIXELS {
                let message = format!(
                    "the sheet would have {width}x{height} pixels, more than {MAX_PIXELS}: \
                     give it a smaller [size]"
                );
                faults.errors.push(SceneError::scene(Place::file(path), message));
            }
        }
        if faults.errors.is_empty() { Ok(sheet) } else { Err(SceneErrors(faults.errors)) }
    }
}

/// What the cells of a sheet share: a scene's text is read once, and what is wrong with it is said
/// once, with the first of its cells.
#[derive(Default)]
struct Shared {
    texts: HashMap<PathBuf, Result<String, (Fault, String)>>,
    reported: HashSet<String>,
}

/// The text of a file, or whose fault it is that there is none, and why.
fn read_text(path: &Path) -> Result<String, (Fault, String)> {
    std::fs::read_to_string(path).map_err(|error| match error.kind() {
        std::io::ErrorKind::InvalidData => (Fault::Scene, "it is not UTF-8".to_owned()),
        _ => (Fault::Reading, error.to_string()),
    })
}

/// One cell that is being read.
struct Reader<'a, 'f, 't> {
    sheet: &'a SheetFile,
    cell: &'a CellFile,
    /// Counted from 1.
    number: usize,
    faults: &'f mut Faults<'t>,
    shared: &'f mut Shared,
}

impl Reader<'_, '_, '_> {
    /// The cell's scene; `None` when it has faults, which are reported.
    fn read(mut self) -> Option<Scene> {
        let Some(named) = self.cell.scene.as_ref().or(self.sheet.scene.as_ref()) else {
            let place = self.faults.place(&self.cell.span);
            self.report(SceneError::scene(place, "neither the cell nor the sheet has a `scene`"));
            return None;
        };
        let folder = self.faults.file.parent().unwrap_or(Path::new(""));
        let path = folder.join(named.get_ref());
        let read = self.shared.texts.entry(path.clone()).or_insert_with(|| read_text(&path));
        let text = match read.clone() {
            Ok(text) => text,
            Err((fault, why)) => {
                let place = self.faults.place(&named.span());
                let message = format!("the scene file `{}` cannot be read: {why}", path.display());
                self.report(SceneError { fault, ..SceneError::reading(place, message) });
                return None;
            }
        };
        let changed =
            if self.cell.set.is_empty() { None } else { Some(self.change(&path, &text)?) };
        let base = path.parent().unwrap_or(Path::new(""));
        let overrides = Overrides { resolution: self.sheet.size, ..Overrides::default() };
        let scene = Scene::from_toml(changed.as_deref().unwrap_or(&text), &path, base, &overrides);
        let traced = |reader: &Self, place: Place| match &changed {
            Some(changed) => reader.trace(&path, &text, changed, place),
            None => place,
        };
        match scene {
            Ok(mut scene) => {
                for warning in std::mem::take(&mut scene.warnings) {
                    let warning = match placed(&warning, &path) {
                        Some((place, message)) => format!("{}: {message}", traced(&self, place)),
                        None => warning,
                    };
                    if self.shared.reported.insert(warning.clone()) {
                        self.faults.warnings.push(warning);
                    }
                }
                Some(scene)
            }
            Err(errors) => {
                for error in errors.0 {
                    let place = traced(&self, error.place.clone());
                    self.report(SceneError { place, ..error });
                }
                None
            }
        }
    }

    /// The cell as messages call it.
    fn title(&self) -> String {
        let label = self.cell.label.as_ref().map(|label| format!(" ({label})")).unwrap_or_default();
        format!("cell {}{label} of {}", self.number, self.faults.file.display())
    }

    /// Reports a fault, with the name of the cell.
    fn report(&mut self, error: SceneError) {
        if self.shared.reported.insert(error.to_string()) {
            let message = format!("{} (in {})", error.message, self.title());
            self.faults.errors.push(SceneError { message, ..error });
        }
    }

    /// The scene's text with what the cell sets; `None` when that cannot be, which is reported.
    fn change(&mut self, path: &Path, text: &str) -> Option<String> {
        let mut root = match text.parse::<toml::Table>() {
            Ok(table) => Value::Table(table),
            Err(error) => {
                let (line, column) = line_and_column(text, error.span().map_or(0, |s| s.start));
                let message = format!("not TOML: {}", error.message());
                self.report(SceneError::scene(Place::at(path, line, column), message));
                return None;
            }
        };
        let before = self.faults.errors.len();
        for entry in &self.cell.set {
            if let Err(misled) = overrides::set(&mut root, &entry.path, entry.value.clone()) {
                let place = self.faults.place(&entry.span);
                let error = SceneError::scene(place, misled.message);
                self.report(SceneError { help: misled.help, ..error });
            }
        }
        if self.faults.errors.len() > before {
            return None;
        }
        match toml::to_string(&root) {
            Ok(text) => Some(text),
            Err(error) => {
                let place = self.faults.place(&self.cell.span);
                self.report(SceneError::scene(place, error.to_string()));
                None
            }
        }
    }

    /// Where a place of the changed text was written: in the cell's `set`, or in the scene file.
    fn trace(&self, path: &Path, text: &str, changed: &str, place: Place) -> Place {
        if place.file != path || place.line == 0 {
            return place;
        }
        let offset = trace::offset(changed, place.line, place.column);
        let Some(faulty) = offset.and_then(|offset| trace::path_at(changed, offset)) else {
            return Place::file(path);
        };
        let set = self.cell.set.iter().rev();
        if let Some(entry) = set.into_iter().find(|entry| trace::is_within(&faulty, &entry.path)) {
            return self.faults.place(&entry.span);
        }
        match trace::span_of(text, &faulty) {
            Some(span) => {
                let (line, column) = line_and_column(text, span.start);
                Place::at(path, line, column)
            }
            None => Place::file(path),
        }
    }
}

/// A warning that begins with `FILE:LINE:COLUMN: ` of that file, taken apart.
fn placed(warning: &str, path: &Path) -> Option<(Place, String)> {
    let rest = warning.strip_prefix(&format!("{}:", path.display()))?;
    let (line, rest) = rest.split_once(':')?;
    let (column, message) = rest.split_once(": ")?;
    Some((Place::at(path, line.parse().ok()?, column.parse().ok()?), message.to_owned()))
}
