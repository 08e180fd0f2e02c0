//! Attributes that faces use, each kept once and numbered by first use.

use crate::mesh::NO_ATTRIBUTE;
use crate::scene::obj::corner::Kind;
use crate::scene::obj::scanned::Scan;

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

/// Numbers the attributes of a scan without faults.
pub(super) fn index(scan: &Scan) -> Indexed {
    let ((positions, corner_positions), ((uvs, corner_uvs), (normals, corner_normals))) =
        rayon::join(
            || index_kind(scan, Kind::Position, &scan.positions),
            || {
                rayon::join(
                    || index_kind(scan, Kind::Uv, &scan.uvs),
                    || index_kind(scan, Kind::Normal, &scan.normals),
                )
            },
        );
    Indexed { positions, corner_positions, uvs, corner_uvs, normals, corner_normals }
}

/// The used values of one kind, and per corner the number of its value.
fn index_kind<T: Copy>(scan: &Scan, kind: Kind, values: &[T]) -> (Vec<T>, Vec<u32>) {
    let mut numbers = vec![NO_ATTRIBUTE; values.len()];
    let mut used = Vec::new();
    let number = |corner: &[u32; 3]| {
        let written = corner[kind as usize] as usize;
        // A corner without the attribute has an index that no value has.
        let (Some(number), Some(&value)) = (numbers.get_mut(written), values.get(written)) else {
            return NO_ATTRIBUTE;
        };
        if *number == NO_ATTRIBUTE {
            *number = used.len() as u32;
            used.push(value);
        }
        *number
    };
    let corners: Vec<u32> = scan.corners.iter().map(number).collect();
    if used.is_empty() { (used, Vec::new()) } else { (used, corners) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::obj::report::Report;
    use crate::scene::obj::scan;
    use std::path::Path;

    fn indexed(text: &str) -> Indexed {
        let mut report = Report::default();
        let scan = scan::scan(text, Path::new("t.obj"), false, &mut report);
        assert!(!report.has_errors(), "{:?}", report.into_errors());
        index(&scan)
    }

    #[test]
    fn missing_normals_stay_missing_and_unused_positions_go() {
        let indexed = indexed(
            "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvn 0 0 2\nvn 0 3 0\n\
             f 2//1 3 4//2\nf 3 5//1 4\n",
        );
        assert_eq!(indexed.positions.len(), 4);
        assert_eq!(indexed.positions[0], [0.0; 3]);
        assert_eq!(indexed.corner_positions, [0, 1, 2, 1, 3, 2]);
        assert_eq!(indexed.normals, [[0.0, 0.0, 2.0], [0.0, 3.0, 0.0]]);
        let none = NO_ATTRIBUTE;
        assert_eq!(indexed.corner_normals, [0, none, 1, none, 0, none]);
        assert!(indexed.corner_uvs.is_empty());
    }

    #[test]
    fn tobj_reads_the_same() {
        // Numbers of every length, indices in every order, everything used somewhere.
        let mut text = String::new();
        for i in 0..200_u32 {
            let x = f64::from(i * i) * 1.234_567_890_123e-3;
            text += &format!("v {x} {:.3} {:e}\nvt {:.6} 0.{i:05}\n", -x, x * 1e-7, x / 50.0);
            text += &format!("vn {x:.2} 1 -{i}.5\n");
        }
        for i in 0..200_u32 {
            let corner = |k: u32| {
                let [v, vt, vn] = [17, 29, 31].map(|step| (i * step + 7 * k) % 200 + 1);
                format!(" {v}/{vt}/{vn}")
            };
            text += &format!("f{}{}{}\n", corner(0), corner(1), corner(2));
        }
        let ours = indexed(&text);
        let options = tobj::LoadOptions::default();
        let none = |_: &Path| Err(tobj::LoadError::OpenFileFailed);
        let (models, _) = tobj::load_obj_buf(&mut text.as_bytes(), &options, none).unwrap();
        let mesh = &models[0].mesh;
        assert_eq!(ours.positions.as_flattened(), mesh.positions);
        assert_eq!(ours.uvs.as_flattened(), mesh.texcoords);
        assert_eq!(ours.normals.as_flattened(), mesh.normals);
        assert_eq!(ours.corner_positions, mesh.indices);
        assert_eq!(ours.corner_uvs, mesh.texcoord_indices);
        assert_eq!(ours.corner_normals, mesh.normal_indices);
    }
}
