//! A diagnosis in words: what it is, and what to do about it.

use super::super::ids::{Convention, NOT_FINITE};
use super::{Layout, Numbering};
use crate::scene::Scene;

/// What it is, and what to do about it.
pub(super) fn sentence(
    layout: Layout,
    numbering: &Numbering,
    assumed: Convention,
    scene: &Scene,
) -> String {
    let mut parts = Vec::new();
    match layout {
        Layout::Same => {}
        Layout::FlippedRows => {
            parts.push("their rows run from the bottom up: pass --flip-y".to_owned());
        }
        Layout::FlippedColumns => {
            parts.push("their columns run from right to left: mirror the picture".to_owned());
        }
        Layout::Turned => parts.push(
            "their picture is turned by half a turn: mirror its columns and pass --flip-y"
                .to_owned(),
        ),
        Layout::Transposed => {
            parts.push("their rows and columns are exchanged: transpose the picture".to_owned());
        }
        Layout::Shifted(shift) => {
            let [x, y] = shift.map(|halves| 0.5 * f64::from(halves));
            parts.push(format!(
                "their picture looks shifted by ({x}, {y}) px: their sample of pixel (i, j) lies at \
                 ({}, {}) and belongs at (i + 0.5, j + 0.5)",
                place("i", x + 0.5),
                place("j", y + 0.5)
            ));
        }
    }
    let Convention { base, background } = numbering.convention;
    if base != assumed.base {
        let difference = base - assumed.base;
        let (sign, size) = (if difference > 0 { "plus" } else { "minus" }, difference.abs());
        parts.push(format!("their ids are ours {sign} {size}: pass --id-base {base}"));
    }
    if let Some(background) = background.filter(|_| background != assumed.background) {
        let name = match background {
            NOT_FINITE => "nan".to_owned(),
            number => number.to_string(),
        };
        parts.push(format!("their mark of nothing is {name}: pass --background {name}"));
    }
    if let Some(object) = first_moved(scene, numbering) {
        let (index, offset) = object;
        parts.push(format!(
            "their ids are counted in another order of meshes, or per mesh: those of mesh {} ({}) \
             are ours {offset:+}; write the number of the triangle over all meshes, in file order",
            index + 1,
            scene.objects[index].name
        ));
    }
    parts.join("; and ")
}

/// `i + 0.5`, `i - 1.5`, or `i`.
fn place(index: &str, offset: f64) -> String {
    if offset == 0.0 {
        return index.to_owned();
    }
    format!("{index} {} {}", if offset > 0.0 { '+' } else { '-' }, offset.abs())
}

/// The first mesh whose ids are moved, and by how much.
fn first_moved(scene: &Scene, numbering: &Numbering) -> Option<(usize, i64)> {
    let offsets = numbering.mesh_offsets.iter().copied().enumerate();
    offsets
        .filter(|&(index, _)| !scene.objects[index].triangles.is_empty())
        .find(|&(_, offset)| offset != 0)
}
