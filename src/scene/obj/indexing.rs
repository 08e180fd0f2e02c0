//! Hands the scanned text to tobj, which reads the numbers and joins equal indices, and holds
//! the outcome against the scan: nothing that tobj leaves out, adds or shifts passes.
//!
//! tobj repeats the previous index where a corner has no normal, so every such corner is written
//! with an index of its own, one past the last, and taken out again.

use crate::mesh::NO_ATTRIBUTE;
use crate::scene::obj::corner::Kind;
use crate::scene::obj::scanned::Scan;
use std::fmt::Write;

/// Attributes that faces use, each once, and the corners' indices into them.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Indexed {
    /// Positions, in order of first use.
    pub(super) positions: Vec<[f64; 3]>,
    /// Per corner of the scan.
    pub(super) corner_positions: Vec<u32>,
    /// Texture coordinates, in order of first use.
    pub(super) uvs: Vec<[f64; 2]>,
    /// Per corner, or `NO_ATTRIBUTE`; empty when no corner has any.
    pub(super) corner_uvs: Vec<u32>,
    /// Normals as written, in order of first use.
    pub(super) normals: Vec<[f64; 3]>,
    /// Per corner, or `NO_ATTRIBUTE`; empty when no corner has any.
    pub(super) corner_normals: Vec<u32>,
}

/// Reads the numbers of a scan without faults.
///
/// # Errors
/// A sentence, when tobj refuses or misreads what the scan accepted; a fault of this program.
pub(super) fn index(scan: &mut Scan) -> Result<Indexed, String> {
    let uses = Kind::ALL.map(|kind| Use::of(scan, kind));
    let text = write_normalised(scan, uses);
    let options =
        tobj::LoadOptions { triangulate: false, single_index: false, ..Default::default() };
    let no_library = |_: &std::path::Path| Err(tobj::LoadError::OpenFileFailed);
    let (models, _) = tobj::load_obj_buf(&mut text.as_bytes(), &options, no_library)
        .map_err(|error| format!("tobj refuses the file: {error}"))?;
    drop(text);
    let [model] = models.as_slice() else {
        return Err(format!("tobj reads {} models out of one", models.len()));
    };
    check_arities(scan, &model.mesh.face_arities)?;
    collect(scan, uses, &model.mesh)
}

/// How the corners use one kind of attribute.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Use {
    Never,
    Sometimes,
    Always,
}

impl Use {
    fn of(scan: &Scan, kind: Kind) -> Self {
        let missing = scan.corners.iter().filter(|c| c[kind as usize] == NO_ATTRIBUTE).count();
        match missing {
            0 => Self::Always,
            all if all == scan.corners.len() => Self::Never,
            _ => Self::Sometimes,
        }
    }
}

/// 0-based index that the normalised text gives a corner; `count` stands for "none".
fn written_index(index: u32, count: u32) -> u32 {
    index.min(count)
}

/// The plainest OBJ text that says the same: no comments, names or groups, absolute indices.
fn write_normalised(scan: &mut Scan, uses: [Use; 3]) -> String {
    let mut text = std::mem::take(&mut scan.attributes);
    if uses[Kind::Uv as usize] == Use::Sometimes {
        text.push_str("vt 0 0\n");
    }
    if uses[Kind::Normal as usize] == Use::Sometimes {
        text.push_str("vn 0 0 0\n");
    }
    let [has_uv, has_normal] = [Kind::Uv, Kind::Normal].map(|k| uses[k as usize] != Use::Never);
    // About 8 characters per index.
    text.reserve(scan.corners.len() * 8 * (1 + usize::from(has_uv) + usize::from(has_normal)));
    for (_, corners) in scan.faces_with_corners() {
        text.push('f');
        for corner in corners {
            let [v, vt, vn] =
                [0, 1, 2].map(|k| u64::from(written_index(corner[k], scan.counts[k])) + 1);
            // Writing into a string cannot fail.
            let _ = match (has_uv, has_normal) {
                (false, false) => write!(text, " {v}"),
                (true, false) => write!(text, " {v}/{vt}"),
                (false, true) => write!(text, " {v}//{vn}"),
                (true, true) => write!(text, " {v}/{vt}/{vn}"),
            };
        }
        text.push('\n');
    }
    text
}

/// tobj leaves the list empty when every face is a triangle.
fn check_arities(scan: &Scan, arities: &[u32]) -> Result<(), String> {
    if !arities.is_empty() && arities.len() != scan.faces.len() {
        let (theirs, ours) = (arities.len(), scan.faces.len());
        return Err(format!("tobj reads {theirs} faces where the scan finds {ours}"));
    }
    for (position, (face, corners)) in scan.faces_with_corners().enumerate() {
        let theirs = arities.get(position).map_or(3, |&arity| arity as usize);
        if theirs != corners.len() {
            let ours = corners.len();
            let line = face.line;
            return Err(format!("tobj reads {theirs} corners on line {line}, which has {ours}"));
        }
    }
    Ok(())
}

fn collect(scan: &Scan, uses: [Use; 3], mesh: &tobj::Mesh) -> Result<Indexed, String> {
    let (positions, corner_positions) =
        collect_kind(scan, Kind::Position, uses[0], &mesh.positions, &mesh.indices)?;
    let (uvs, corner_uvs) =
        collect_kind(scan, Kind::Uv, uses[1], &mesh.texcoords, &mesh.texcoord_indices)?;
    let (normals, corner_normals) =
        collect_kind(scan, Kind::Normal, uses[2], &mesh.normals, &mesh.normal_indices)?;
    Ok(Indexed { positions, corner_positions, uvs, corner_uvs, normals, corner_normals })
}

/// One kind of attribute: checks that tobj numbered it by first use over exactly our corners,
/// and takes the stand-in for missing ones out.
fn collect_kind<const N: usize>(
    scan: &Scan,
    kind: Kind,
    used: Use,
    numbers: &[f64],
    indices: &[u32],
) -> Result<(Vec<[f64; N]>, Vec<u32>), String> {
    if used == Use::Never {
        return Ok((Vec::new(), Vec::new()));
    }
    let differ = |what: &str| Err(format!("tobj and the scan differ in the {what} of {kind:?}"));
    let (values, rest) = numbers.as_chunks::<N>();
    if indices.len() != scan.corners.len() || !rest.is_empty() {
        return differ("number");
    }
    let count = scan.counts[kind as usize];
    // Per written index its number by first use in tobj, and that number without the stand-in.
    let mut first_use = vec![NO_ATTRIBUTE; count as usize + 1];
    let mut kept = Vec::with_capacity(values.len());
    let mut seen = 0;
    let mut corner_indices = Vec::with_capacity(indices.len());
    for (corner, &theirs) in scan.corners.iter().zip(indices) {
        let written = written_index(corner[kind as usize], count);
        let slot = &mut first_use[written as usize];
        if *slot == NO_ATTRIBUTE {
            *slot = seen;
            seen += 1;
            if let (true, Some(&value)) = (written < count, values.get(theirs as usize)) {
                kept.push(value);
            }
        }
        if *slot != theirs {
            return differ("order");
        }
        corner_indices.push(if written < count { theirs } else { NO_ATTRIBUTE });
    }
    if seen as usize != values.len() {
        return differ("number");
    }
    // Numbers after the stand-in move down by one.
    let stand_in = first_use[count as usize];
    for index in &mut corner_indices {
        if *index != NO_ATTRIBUTE && *index > stand_in {
            *index -= 1;
        }
    }
    Ok((kept, corner_indices))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::obj::report::Report;
    use crate::scene::obj::scan;
    use std::path::Path;

    fn scanned(text: &str) -> Scan {
        let mut report = Report::default();
        let scan = scan::scan(text, Path::new("t.obj"), false, &mut report);
        assert!(!report.has_errors(), "{:?}", report.into_errors());
        scan
    }

    const MIXED: &str = "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvn 0 0 2\nvn 0 3 0\n\
                         f 2//1 3 4//2\nf 3 5//1 4\n";

    #[test]
    fn missing_normals_stay_missing_and_unused_positions_go() {
        let indexed = index(&mut scanned(MIXED)).unwrap();
        assert_eq!(indexed.positions.len(), 4);
        assert_eq!(indexed.positions[0], [0.0; 3]);
        assert_eq!(indexed.corner_positions, [0, 1, 2, 1, 3, 2]);
        assert_eq!(indexed.normals, [[0.0, 0.0, 2.0], [0.0, 3.0, 0.0]]);
        let none = NO_ATTRIBUTE;
        assert_eq!(indexed.corner_normals, [0, none, 1, none, 0, none]);
        assert!(indexed.corner_uvs.is_empty());
    }

    /// A mesh as tobj gives it for `MIXED`, for the tests to damage.
    fn mixed_mesh(scan: &mut Scan) -> ([Use; 3], tobj::Mesh) {
        let uses = Kind::ALL.map(|kind| Use::of(scan, kind));
        let text = write_normalised(scan, uses);
        let options = tobj::LoadOptions::default();
        let none = |_: &Path| Err(tobj::LoadError::OpenFileFailed);
        let (mut models, _) = tobj::load_obj_buf(&mut text.as_bytes(), &options, none).unwrap();
        (uses, models.remove(0).mesh)
    }

    #[test]
    fn every_damage_to_the_outcome_is_found() {
        let mut scan = scanned(MIXED);
        let (uses, mesh) = mixed_mesh(&mut scan);
        assert!(collect(&scan, uses, &mesh).is_ok());
        let damages: [fn(&mut tobj::Mesh); 6] = [
            |mesh| mesh.indices.swap(0, 1),
            |mesh| mesh.indices.truncate(3),
            |mesh| mesh.positions.truncate(9),
            |mesh| mesh.positions.push(0.0),
            |mesh| mesh.normal_indices[1] = 0,
            |mesh| mesh.normals.extend([0.0; 3]),
        ];
        for (number, damage) in damages.iter().enumerate() {
            let mut damaged = mesh.clone();
            damage(&mut damaged);
            assert!(collect(&scan, uses, &damaged).is_err(), "damage {number}");
        }
        assert!(check_arities(&scan, &[]).is_ok());
        assert!(check_arities(&scan, &[3, 3]).is_ok());
        assert!(check_arities(&scan, &[3]).is_err());
        assert!(check_arities(&scan, &[3, 4]).is_err());
    }
}
