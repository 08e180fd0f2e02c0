//! From a scene file to a scene, or to everything that is wrong with it.

use super::Scene;
use super::error::{Fault, Place, SceneError};
use super::file::SceneFile;
use super::file::text::{Faults, line_and_column};
use super::resolve;
use super::sampling::SampleGrid;
use crate::pixel::Resolution;
use std::fmt;
use std::path::Path;

/// What a program sets in place of what the scene file says.
#[derive(Clone, Debug, Default)]
pub struct Overrides {
    /// Another size of the frame. A look-at or OpenGL camera fills it; the numbers of the other two
    /// forms belong to their size, and another one is refused.
    pub resolution: Option<Resolution>,
    /// Names of lights, or their numbers from 0 on in file order: only these stay. Empty: all do.
    pub only_lights: Vec<String>,
    /// Whether all lights keep only their ambient parts.
    pub ambient_only: bool,
    /// Another number of samples per pixel.
    pub samples: Option<SampleGrid>,
    /// Leave out the faces of a mesh file with a position that is not finite or out of range, with
    /// a warning, instead of refusing the file. Ids count the triangles that remain. Generated
    /// normals beside a finite face that is out of range still count it.
    pub skip_bad: bool,
}

/// All faults of a scene and its meshes; at least one. Displayed one a line, advice below.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneErrors(pub Vec<SceneError>);

impl SceneErrors {
    /// Whose fault: the files' system where every error is of reading, else the scene's.
    pub fn fault(&self) -> Fault {
        match self.0.iter().all(|error| error.fault == Fault::Reading) {
            true => Fault::Reading,
            false => Fault::Scene,
        }
    }
}

impl fmt::Display for SceneErrors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, error) in self.0.iter().enumerate() {
            if index > 0 {
                writeln!(f)?;
            }
            write!(f, "{error}")?;
            if let Some(help) = &error.help {
                write!(f, "\n  {help}")?;
            }
        }
        Ok(())
    }
}

impl std::error::Error for SceneErrors {}

impl Scene {
    /// Reads a scene file and the meshes that it names.
    ///
    /// # Errors
    /// Everything that is wrong with the scene or its meshes, in the order of the scene file.
    pub fn load(path: &Path, overrides: &Overrides) -> Result<Self, SceneErrors> {
        let bytes = std::fs::read(path).map_err(|error| {
            let message = format!("the scene file cannot be read: {error}");
            SceneErrors(vec![SceneError::reading(Place::file(path), message)])
        })?;
        let text = String::from_utf8(bytes).map_err(|error| {
            let valid = error.utf8_error().valid_up_to();
            let text = String::from_utf8_lossy(&error.as_bytes()[..valid]);
            let (line, column) = line_and_column(&text, valid);
            let place = Place::at(path, line, column);
            SceneErrors(vec![SceneError::scene(place, "the scene file must be UTF-8 here")])
        })?;
        Self::from_toml(&text, path, path.parent().unwrap_or(Path::new("")), overrides)
    }

    /// Makes a scene of the text of a scene file. `name` stands for the file in messages; paths
    /// that the text names are relative to `base`.
    ///
    /// # Errors
    /// As for [`Self::load`].
    pub fn from_toml(
        text: &str,
        name: &Path,
        base: &Path,
        overrides: &Overrides,
    ) -> Result<Self, SceneErrors> {
        let mut faults = Faults::new(name, text);
        let file = SceneFile::read(&mut faults);
        let scene = resolve::scene(&file, base, overrides, &mut faults);
        match scene {
            Some(scene) if faults.errors.is_empty() => {
                Ok(Self { warnings: faults.warnings, ..scene })
            }
            _ => Err(SceneErrors(in_order(faults.errors, name))),
        }
    }
}

/// Faults of the scene file by place, then those of other files as they came.
fn in_order(mut errors: Vec<SceneError>, name: &Path) -> Vec<SceneError> {
    debug_assert!(!errors.is_empty(), "a scene that cannot be made has a fault");
    errors.sort_by_key(|error| match error.place.file == name {
        true => (0, error.place.line, error.place.column),
        false => (1, 0, 0),
    });
    errors
}
