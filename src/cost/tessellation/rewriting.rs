//! A scene file written anew: its curved shapes finer or coarser, in another shading, or left out.

use crate::cost::Written;
use crate::cost::analytic::Curved;
use crate::scene::file::text::Faults;
use crate::scene::file::{MeshFile, SceneFile, SourceFile};
use crate::scene::shapes::Shape;
use crate::scene::transform::Transform;
use toml::{Table, Value};

/// A scene file and its curved meshes.
pub(super) struct Rewriting {
    document: Table,
    /// Number of meshes in the file.
    meshes: usize,
    /// Position in the file, and the surface.
    curved: Vec<(usize, Curved)>,
    shapes: Vec<Shape>,
}

impl Rewriting {
    /// Finds the curved meshes of a scene that has been read before.
    pub(super) fn of(written: &Written) -> Result<Self, String> {
        let document: Table = written.text.parse().map_err(|error| format!("{error}"))?;
        let mut faults = Faults::new(&written.name, &written.text);
        let file = SceneFile::read(&mut faults);
        let (mut curved, mut shapes) = (Vec::new(), Vec::new());
        for (index, mesh) in file.meshes.iter().enumerate() {
            let SourceFile::Shape(generated) = &mesh.source else { continue };
            let shape = generated.shape.get_ref().to_shape();
            if let Some(surface) = Curved::new(&shape, transform(mesh)) {
                curved.push((index, surface));
                shapes.push(shape);
            }
        }
        if curved.is_empty() {
            return Err("no mesh of the scene is a `torus`, `uv_sphere` or `icosphere`".to_owned());
        }
        Ok(Self { document, meshes: file.meshes.len(), curved, shapes })
    }

    /// The curved meshes by their position in the file.
    pub(super) fn curved(&self) -> &[(usize, Curved)] {
        &self.curved
    }

    /// Positions in the file of the meshes that are not curved.
    pub(super) fn others(&self) -> Vec<usize> {
        let is_other = |index: &usize| self.curved.iter().all(|(curved, _)| curved != index);
        (0..self.meshes).filter(is_other).collect()
    }

    /// The text without the curved meshes.
    pub(super) fn without_curved(&self) -> Result<String, String> {
        let mut document = self.document.clone();
        if let Some(Value::Array(meshes)) = document.get_mut("mesh") {
            let mut index = 0;
            meshes.retain(|_| {
                index += 1;
                self.curved.iter().all(|(curved, _)| curved + 1 != index)
            });
            if meshes.is_empty() {
                document.remove("mesh");
            }
        }
        written(&document)
    }

    /// The text with the curved meshes 2^`power` times as fine along each side, in a shading.
    pub(super) fn with(&self, power: i32, shading: &str) -> Result<String, String> {
        let mut document = self.document.clone();
        for ((index, _), shape) in self.curved.iter().zip(&self.shapes) {
            let mesh = document
                .get_mut("mesh")
                .and_then(|meshes| meshes.get_mut(*index))
                .and_then(Value::as_table_mut)
                .ok_or("the meshes are not a list of tables")?;
            mesh.insert("shading".to_owned(), Value::from(shading));
            let parameters = mesh
                .get_mut("shape")
                .and_then(|named| named.get_mut(shape.name()))
                .and_then(Value::as_table_mut)
                .ok_or("a shape is not a table")?;
            for (key, count) in counts(shape, power) {
                parameters.insert(key.to_owned(), Value::from(i64::from(count)));
            }
        }
        written(&document)
    }
}

/// The counts of a shape at another fineness, none below what the shape allows.
fn counts(shape: &Shape, power: i32) -> Vec<(&'static str, u32)> {
    let scaled = |count: u32, least: u32| {
        let count = u64::from(count);
        let scaled = if power < 0 { count >> -power } else { count << power };
        u32::try_from(scaled).unwrap_or(u32::MAX).max(least)
    };
    match shape {
        Shape::Torus(torus) => {
            vec![("around", scaled(torus.around, 3)), ("across", scaled(torus.across, 3))]
        }
        Shape::UvSphere(sphere) => {
            vec![("around", scaled(sphere.around, 3)), ("rings", scaled(sphere.rings, 2))]
        }
        // Each level halves the edges.
        Shape::Icosphere(sphere) => vec![("level", sphere.level.saturating_add_signed(power))],
        _ => Vec::new(),
    }
}

fn transform(mesh: &MeshFile) -> Transform {
    if let Some(matrix) = &mesh.matrix {
        return Transform::from_matrix(*matrix.get_ref());
    }
    let step = |step: &Option<toml::Spanned<[f64; 3]>>, neutral| {
        step.as_ref().map_or(neutral, |step| *step.get_ref())
    };
    Transform::from_steps(
        step(&mesh.scale, [1.0; 3]),
        step(&mesh.rotate_deg, [0.0; 3]),
        step(&mesh.translate, [0.0; 3]),
    )
}

fn written(document: &Table) -> Result<String, String> {
    toml::to_string(document).map_err(|error| error.to_string())
}
