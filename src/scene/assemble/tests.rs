//! Parts put together: rounding once, mirrored corners, materials, the limit of 2^126.

use super::*;

fn triangle() -> MeshPart {
    MeshPart {
        positions: vec![[1.0, 0.0, 0.0], [3.0, 0.0, 0.0], [1.0, 2.0, 0.0]],
        corners: vec![[0, 1, 2]],
        ..MeshPart::default()
    }
}

fn triangle_with_attributes() -> MeshPart {
    MeshPart {
        normals: vec![[0.0, 0.0, 1.0], [1.0, 0.0, 0.0]],
        corner_normals: vec![[0, 1, NO_ATTRIBUTE]],
        uvs: vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]],
        corner_uvs: vec![[0, 1, 2]],
        ..triangle()
    }
}

fn piece(part: &MeshPart, transform: Transform) -> Piece<'_> {
    Piece {
        part,
        transform,
        name: "part".to_owned(),
        sides: Sides::Single,
        shading: Shading::Phong,
        naive_normals: false,
        source: Source::Shape("part".to_owned()),
        materials: vec![0; part.corners.len()],
    }
}

fn scaled(scale: [f64; 3]) -> Transform {
    Transform::from_steps(scale, [0.0; 3], [0.0; 3])
}

#[test]
fn parts_follow_each_other_and_lists_have_one_entry_per_triangle() {
    let (bare, full) = (triangle(), triangle_with_attributes());
    let mut assembly = Assembly::default();
    for part in [&bare, &full, &bare, &full] {
        assembly.append(piece(part, Transform::default())).unwrap();
    }
    assembly.append(piece(&bare, Transform::default())).unwrap();
    let Assembly { mesh, objects, triangle_materials } = assembly.finish();
    let ranges: Vec<_> = objects.iter().map(|o| o.triangles.clone()).collect();
    assert_eq!(ranges, [0..1, 1..2, 2..3, 3..4, 4..5]);
    assert_eq!(triangle_materials.len(), 5);
    assert_eq!(mesh.corners[3], [9, 10, 11]);
    let none = [NO_ATTRIBUTE; 3];
    let (first, second) = ([0, 1, NO_ATTRIBUTE], [2, 3, NO_ATTRIBUTE]);
    assert_eq!(mesh.corner_normals, [none, first, none, second, none]);
    assert_eq!(mesh.corner_uvs, [none, [0, 1, 2], none, [3, 4, 5], none]);
    assert_eq!(mesh.uvs.len(), 6);
}

#[test]
fn without_attributes_the_lists_stay_empty() {
    let part = triangle();
    let mut assembly = Assembly::default();
    assembly.append(piece(&part, Transform::default())).unwrap();
    let mesh = assembly.finish().mesh;
    assert!(mesh.corner_normals.is_empty() && mesh.corner_uvs.is_empty());
}

#[test]
fn a_mirror_exchanges_corners_one_and_two_of_everything() {
    let part = triangle_with_attributes();
    let mut assembly = Assembly::default();
    assembly.append(piece(&part, scaled([-1.0, 1.0, 1.0]))).unwrap();
    let mesh = assembly.finish().mesh;
    assert_eq!(mesh.corners, [[0, 2, 1]]);
    assert_eq!(mesh.corner_normals, [[0, NO_ATTRIBUTE, 1]]);
    assert_eq!(mesh.corner_uvs, [[0, 2, 1]]);
    assert_eq!(mesh.normals, [[0.0, 0.0, 1.0], [-1.0, 0.0, 0.0]]);
    // The winding still points along +z.
    assert_eq!(mesh.face_normal(TriangleId::new(0)), [0.0, 0.0, 1.0]);
}

#[test]
fn a_flattened_normal_becomes_none() {
    let part = triangle_with_attributes();
    let mut assembly = Assembly::default();
    assembly.append(piece(&part, scaled([1.0, 1.0, 0.0]))).unwrap();
    let mesh = assembly.finish().mesh;
    assert_eq!(mesh.corner_normals, [[0, NO_ATTRIBUTE, NO_ATTRIBUTE]]);
    assert_eq!(mesh.normals, [[0.0, 0.0, 1.0]]);
}

#[test]
fn positions_are_rounded_once_after_the_transform() {
    // 0.1 + 0.2 in f64, then to f32; the sum of the rounded numbers is another one.
    let part = MeshPart { positions: vec![[0.1, 16_777_217.0, 0.0]], ..MeshPart::default() };
    let transform = Transform::from_steps([1.0; 3], [0.0; 3], [0.2, 1.0, 0.0]);
    let mut assembly = Assembly::default();
    assembly.append(piece(&part, transform)).unwrap();
    assert_eq!(assembly.mesh.positions, [[(0.1 + 0.2) as f32, 16_777_218.0, 0.0]]);
}

#[test]
fn positions_up_to_two_to_the_126_are_kept_and_larger_ones_refused() {
    let part = triangle();
    let limit = 2.0_f64.powi(126);
    let mut assembly = Assembly::default();
    assembly.append(piece(&part, scaled([limit / 4.0, 1.0, 1.0]))).unwrap();
    let fault = assembly.append(piece(&part, scaled([limit / 2.0, 1.0, 1.0]))).unwrap_err();
    let position = [1.5 * limit, 0.0, 0.0];
    assert_eq!(fault, AssemblyFault::Position { position, triangle: Some(0) });
    // Nothing of the faulty piece stays.
    assert_eq!(assembly.mesh.positions.len(), 3);
    for scale in [1e300, f64::MAX] {
        let faulty = assembly.append(piece(&part, scaled([scale, scale, 1.0])));
        assert!(matches!(faulty, Err(AssemblyFault::Position { .. })));
    }
}
