//! `vertex_normals` and `crease_deg` of a mesh: which normals are made anew, and how.

use crate::scene::file::text::Faults;
use crate::scene::file::{MeshFile, suggestion};
use crate::scene::part::MeshPart;
use crate::scene::vertex_normals::{self, MAX_CREASED, Together, TooCrowded, Weight};

const WORDS: [&str; 4] = ["file", "uniform", "area", "angle"];

/// How normals are made anew.
#[derive(Clone, Copy)]
pub(super) struct Rule {
    weight: Weight,
    together: Together,
}

/// What the mesh asks for; `None` where it keeps the normals that it comes with.
pub(super) fn rule(mesh: &MeshFile, faults: &mut Faults<'_>) -> Option<Rule> {
    let crease = mesh.crease_deg.as_ref().map(|written| {
        let degrees = *written.get_ref();
        if !(0.0..=180.0).contains(&degrees) {
            let message = format!("`crease_deg` must be from 0 to 180, not {degrees}");
            faults.at(&written.span(), message);
        }
        degrees
    });
    let word = mesh.vertex_normals.as_ref().map(|written| (written.get_ref().as_str(), written));
    let weight = match word {
        None | Some(("file", _)) if crease.is_none() => return None,
        None | Some(("file" | "uniform", _)) => Weight::Uniform,
        Some(("area", _)) => Weight::Area,
        Some(("angle", _)) => Weight::Angle,
        Some((other, written)) => {
            let message = format!("there are no vertex normals \"{other}\"");
            faults.at_with_help(&written.span(), message, suggestion(other, &WORDS));
            return None;
        }
    };
    Some(Rule { weight, together: crease.map_or(Together::Groups, Together::Crease) })
}

/// The part with its normals made anew; `None` where that fails, and the fault is reported.
pub(super) fn remake(
    part: &MeshPart,
    rule: Rule,
    mesh: &MeshFile,
    faults: &mut Faults<'_>,
) -> Option<MeshPart> {
    let mut remade = part.clone();
    match vertex_normals::remake(&mut remade, rule.weight, rule.together) {
        Ok(0) => {}
        Ok(corners) => {
            let message = format!(
                "{corners} corners get no vertex normal: the normals of the faces around them \
                 cancel out; the face normal is used there"
            );
            faults.warn(&mesh.span, &message);
        }
        Err(TooCrowded(count)) => {
            let span = mesh.crease_deg.as_ref().map_or(mesh.span.clone(), |key| key.span());
            let message = format!("{count} faces meet in one vertex of this mesh");
            let help = format!(
                "`crease_deg` compares every two of them, and takes at most {MAX_CREASED}; leave \
                 it out"
            );
            faults.at_with_help(&span, message, help);
            return None;
        }
    }
    Some(remade)
}
