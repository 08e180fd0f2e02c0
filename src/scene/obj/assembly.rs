//! Scan and numbers into a mesh part: triangles, unit normals, generated normals, lines.

use crate::color::LinearRgb;
use crate::mesh::{NO_ATTRIBUTE, TriangleId};
use crate::scene::error::{Place, SceneError};
use crate::scene::obj::corner::Kind;
use crate::scene::obj::indexing::Indexed;
use crate::scene::obj::polygon::{
    MAX_CONCAVE_CORNERS, Outcome, Polygons, append_fan, scale_corners, triangulate, vector_area,
};
use crate::scene::obj::report::Report;
use crate::scene::obj::scanned::{Face, Scan};
use crate::scene::obj::smooth;
use crate::scene::part::MeshPart;
use std::ops::Range;
use std::path::Path;

/// Makes the part. Faults go to the report.
pub(super) fn assemble(
    scan: &Scan,
    indexed: Indexed,
    polygons: Polygons,
    file: &Path,
    report: &mut Report,
) -> MeshPart {
    let corner_count = scan.corners.len();
    let colors = used_colors(scan, &indexed);
    let (mut normals, mut corner_normals) =
        make_unit(&indexed.normals, indexed.corner_normals, corner_count);
    if corner_normals.contains(&NO_ATTRIBUTE) {
        smooth::generate(
            &scan.faces,
            &indexed.positions,
            &indexed.corner_positions,
            &mut normals,
            &mut corner_normals,
        );
    }
    let mut part = MeshPart {
        colors,
        positions: indexed.positions,
        normals,
        uvs: indexed.uvs,
        material_names: scan.materials.iter().map(|name| name.text.clone()).collect(),
        ..MeshPart::default()
    };
    // An empty list says that no triangle has the attribute.
    if part.normals.is_empty() {
        corner_normals.clear();
    }
    let corners = Corners {
        positions: &indexed.corner_positions,
        normals: &corner_normals,
        uvs: &indexed.corner_uvs,
    };
    append_triangles(scan, corners, polygons, &mut part, file, report);
    part
}

/// The colours of the positions that faces use.
fn used_colors(scan: &Scan, indexed: &Indexed) -> Vec<LinearRgb> {
    if scan.colors.is_empty() {
        return Vec::new();
    }
    let mut colors = vec![[0.0; 3]; indexed.positions.len()];
    for (corner, &position) in scan.corners.iter().zip(&indexed.corner_positions) {
        colors[position as usize] = scan.colors[corner[Kind::Position as usize] as usize];
    }
    colors
}

/// Unit normals, and the corners' indices into them; a normal of length 0 counts as missing.
fn make_unit(
    written: &[[f64; 3]],
    mut corner_normals: Vec<u32>,
    corner_count: usize,
) -> (Vec<[f64; 3]>, Vec<u32>) {
    let mut normals = Vec::with_capacity(written.len());
    let mut renumbered = Vec::with_capacity(written.len());
    for normal in written {
        let largest = normal.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
        if largest == 0.0 {
            renumbered.push(NO_ATTRIBUTE);
            continue;
        }
        renumbered.push(normals.len() as u32);
        // Divided by the largest component first: no length under- or overflows.
        let scaled = normal.map(|c| c / largest);
        let length = scaled.iter().map(|c| c * c).sum::<f64>().sqrt();
        normals.push(scaled.map(|c| c / length));
    }
    corner_normals.resize(corner_count, NO_ATTRIBUTE);
    for index in &mut corner_normals {
        *index = renumbered.get(*index as usize).copied().unwrap_or(NO_ATTRIBUTE);
    }
    (normals, corner_normals)
}

/// Per corner of the scan, indices into the part's lists.
#[derive(Clone, Copy)]
struct Corners<'a> {
    positions: &'a [u32],
    normals: &'a [u32],
    uvs: &'a [u32],
}

fn append_triangles(
    scan: &Scan,
    corners: Corners<'_>,
    polygons: Polygons,
    part: &mut MeshPart,
    file: &Path,
    report: &mut Report,
) {
    let mut scaled = Vec::new();
    let mut triangles = Vec::new();
    let mut start = 0;
    // Two corners of a polygon are in no triangle of their own.
    let most = scan.corners.len().saturating_sub(2 * scan.faces.len());
    reserve(part, most, corners);
    for (number, face) in (0..).zip(&scan.faces) {
        let range = start..face.corners_end;
        start = face.corners_end;
        triangles.clear();
        let positions = corners.positions[range.clone()].iter();
        scale_corners(positions.map(|&p| part.positions[p as usize]), &mut scaled);
        if range.len() == 3 {
            triangles.push([0, 1, 2]);
        } else if polygons == Polygons::Fan {
            append_fan(range.len(), &mut triangles);
        } else {
            match triangulate(&scaled, &mut triangles) {
                Outcome::Covered => {}
                Outcome::NotSimple => {
                    let sentence = "a polygon crosses itself; it is cut into a fan";
                    report.warn(file, face.line, sentence);
                }
                Outcome::TooLarge => report.error(too_large(face, range.len(), file)),
            }
        }
        for triangle in &triangles {
            if vector_area(&triangle.map(|corner| scaled[corner as usize])) == [0.0; 3] {
                let sentence = "a triangle has no area (repeated corners or corners on a line); \
                                it is never visible";
                report.warn(file, face.line, sentence);
            }
        }
        append_face((number, face), range, corners, &triangles, part);
        if part.corners.len() > TriangleId::MAX_COUNT {
            report.error(SceneError::scene(Place::file(file), "too many triangles"));
            return;
        }
    }
    if part.material_names.is_empty() {
        part.triangle_materials.clear();
    }
    // Both lists go where they say what an empty one says.
    if part.polygons.len() == scan.faces.len() {
        part.polygons = Vec::new();
    }
    if part.smoothing_groups.iter().all(|&group| group == 1) {
        part.smoothing_groups = Vec::new();
    }
}

/// Makes room for triangles.
fn reserve(part: &mut MeshPart, count: usize, corners: Corners<'_>) {
    part.corners.reserve_exact(count);
    part.corner_normals.reserve_exact(if corners.normals.is_empty() { 0 } else { count });
    part.corner_uvs.reserve_exact(if corners.uvs.is_empty() { 0 } else { count });
    let lists = [
        &mut part.triangle_materials,
        &mut part.lines,
        &mut part.polygons,
        &mut part.smoothing_groups,
    ];
    lists.into_iter().for_each(|list| list.reserve_exact(count));
}

fn append_face(
    (number, face): (u32, &Face),
    range: Range<usize>,
    corners: Corners<'_>,
    triangles: &[[u32; 3]],
    part: &mut MeshPart,
) {
    for triangle in triangles {
        let pick = |list: &[u32]| triangle.map(|corner| list[range.start + corner as usize]);
        part.corners.push(pick(corners.positions));
        if !corners.normals.is_empty() {
            part.corner_normals.push(pick(corners.normals));
        }
        if !corners.uvs.is_empty() {
            part.corner_uvs.push(pick(corners.uvs));
        }
        part.triangle_materials.push(face.material);
        part.lines.push(face.line);
        part.polygons.push(number);
        part.smoothing_groups.push(face.group);
    }
}

fn too_large(face: &Face, corners: usize, file: &Path) -> SceneError {
    let message = format!("a concave polygon of {corners} corners");
    SceneError::scene(Place::at(file, face.line, 0), message).with_help(format!(
        "split it: at most {MAX_CONCAVE_CORNERS} corners are cut into triangles"
    ))
}
