//! Transforms of meshes, and the materials that mesh files bring along.

use super::*;

/// The corners of a plane under a transform.
fn plane_positions(transform: &str) -> Vec<[f32; 3]> {
    let scene = load(&format!("{HEAD}[[mesh]]\nshape = {{ plane = {{}} }}\n{transform}"));
    scene.mesh.positions
}

#[test]
fn transforms() {
    let plain = plane_positions("");
    assert!(plain.contains(&[1.0, 0.0, -1.0]));
    // (1, 0, −1) scaled: (2, 0, −4); x by 90°: (2, 4, 0); y by 90°: (0, 4, −2);
    // z by 90°: (−4, 0, −2); moved by (10, 20, 30).
    let steps =
        plane_positions("scale = [2, 3, 4]\nrotate_deg = [90, 90, 90]\ntranslate = [10, 20, 30]\n");
    let index = plain.iter().position(|p| *p == [1.0, 0.0, -1.0]).unwrap();
    assert_eq!(steps[index], [6.0, 20.0, 28.0]);
    // The same as a matrix: columns are where the axes go.
    let rows = "matrix = [[0, 0, 4, 10], [0, 3, 0, 20], [-2, 0, 0, 30], [0, 0, 0, 1]]\n";
    let by_matrix = plane_positions(rows);
    assert_eq!(by_matrix[index], [6.0, 20.0, 28.0]);
    assert_eq!(
        by_matrix,
        plane_positions(&rows.replace("], [", ", ").replace("[[", "[").replace("]]", "]"))
    );
    assert_eq!(plane_positions("scale = 2\n")[index], [2.0, 0.0, -2.0]);
}

#[test]
fn a_mirrored_mesh_still_faces_outwards() {
    let faces = |transform: &str| {
        let scene = load(&format!(
            "{HEAD}[[mesh]]\nshape = {{ icosphere = {{ level = 1 }} }}\n{transform}"
        ));
        for id in scene.mesh.ids() {
            let face = scene.mesh.face_normal(id);
            let inner = |v: [f64; 3]| face[0] * v[0] + face[1] * v[1] + face[2] * v[2];
            let corner = scene.mesh.triangle(id)[0].map(f64::from);
            assert!(inner(corner) > 0.0, "triangle {id:?} faces inwards");
            for normal in scene.mesh.normals_of(id).expect("a sphere has normals") {
                assert!(inner(normal) > 0.0, "a normal of {id:?} points inwards");
            }
        }
    };
    faces("");
    faces("scale = [-1, 2, 3]\n");
    faces("scale = -0.5\nrotate_deg = [10, 20, 30]\n");
    faces("matrix = [[0, 1, 0, 0], [1, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]\n");
}

#[test]
fn a_flattening_transform_is_a_warning() {
    let text = format!("{HEAD}[[mesh]]\nshape = {{ plane = {{}} }}\nscale = [1, 0, 1]\n");
    let scene = load(&text);
    assert_eq!(scene.warnings, ["test.toml:10:1: the transform flattens this mesh"]);
    // The plane lies in the plane that is kept, so its normals stay.
    assert_eq!(scene.mesh.normals_of(TriangleId::new(0)), Some([[0.0, 1.0, 0.0]; 3]));
    let edge_on = load(&text.replace("[1, 0, 1]", "[1, 1, 0]"));
    assert_eq!(edge_on.mesh.normals_of(TriangleId::new(0)), None);
}

#[test]
fn materials_of_obj_files() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    write("a.mtl", "newmtl red\nKd 1 0 0\n");
    write("b.mtl", "newmtl red\nKd 0.5 0 0\n");
    let face = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nusemtl red\nf 1 2 3\n";
    write("a.obj", &format!("mtllib a.mtl\n{face}"));
    write("b.obj", &format!("mtllib b.mtl\n{face}"));
    let text = format!(
        "{HEAD}[[material]]\nname = \"red\"\nkd = [0.25, 0, 0]\n\
         [[mesh]]\nfile = \"a.obj\"\n[[mesh]]\nfile = \"b.obj\"\n\
         [[mesh]]\nfile = \"a.obj\"\nmaterial = \"red\"\n[[mesh]]\nfile = \"a.obj\"\n"
    );
    let scene = load_in(folder.path(), &text);
    let kd: Vec<_> = scene.mesh.ids().map(|id| scene.material_of(id).1.kd[0]).collect();
    // Its own "red" for each file, none for its first face; the scene's where the mesh says so.
    assert_eq!(kd, [0.8, 1.0, 0.8, 0.5, 0.25, 0.25, 0.8, 1.0]);
    assert_eq!(scene.materials.len(), 4, "{:?}", scene.materials);
    let path = folder.path().join("b.obj");
    assert_eq!(scene.describe_source(TriangleId::new(3)), format!("{}:7", path.display()));
    assert_eq!(scene.objects[1].name, "b.obj");

    // A position out of range is placed at the face that uses it.
    let far = text.replace("file = \"b.obj\"\n", "file = \"b.obj\"\nscale = 1e39\n");
    let overrides = Overrides::default();
    let errors = Scene::from_toml(&far, Path::new("far.toml"), folder.path(), &overrides);
    let error = &errors.unwrap_err().0[0];
    assert_eq!((error.place.file.as_path(), error.place.line), (path.as_path(), 5));
    assert_eq!(error.help.as_deref(), Some("the mesh stands at far.toml:15:1"));
}

/// A concave polygon, its reflex corner opposite the first: cut by ears it is covered once, as a
/// fan twice beside it. One file may be read in both ways in one scene.
#[test]
fn polygons_by_ears_or_as_a_fan() {
    let folder = tempfile::tempdir().unwrap();
    let obj = "v 0 0 0\nv 4 0 0\nv 1 1 0\nv 0 4 0\nv 3 4 0\nf 2 3 4 1\nf 1 2 5 4\nf 1 2 3\n";
    std::fs::write(folder.path().join("a.obj"), obj).unwrap();
    let mesh = |keys: &str| format!("[[mesh]]\nfile = \"a.obj\"\n{keys}");
    let triangles = |text: &str| -> Vec<[[f32; 3]; 3]> {
        let scene = load_in(folder.path(), &format!("{HEAD}{text}"));
        scene.mesh.ids().map(|id| scene.mesh.triangle(id)).collect()
    };
    let ears = triangles(&mesh(""));
    assert_eq!(triangles(&mesh("polygons = \"ears\"\n")), ears);
    let fan = triangles(&mesh("polygons = \"fan\"\n"));
    let [a, b, c, d] = [[0.0; 3], [4.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 4.0, 0.0]];
    assert_eq!(fan[..2], [[b, c, d], [b, d, a]]);
    // Convex polygons and triangles are the same; the dart is not.
    assert_ne!(ears[..2], fan[..2]);
    assert_eq!(ears[2..], fan[2..]);
    let twice_the_area = |triangles: &[[[f32; 3]; 3]]| -> f32 {
        let area = |[p, q, r]: &[[f32; 3]; 3]| {
            (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
        };
        triangles.iter().map(|t| area(t).abs()).sum()
    };
    assert_eq!((twice_the_area(&ears[..2]), twice_the_area(&fan[..2])), (8.0, 24.0));
    let both = triangles(&(mesh("polygons = \"fan\"\n") + &mesh("")));
    assert_eq!(both, [fan, ears].concat());
}
