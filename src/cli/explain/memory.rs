//! How much memory a scene's triangles take, and the tree that `render` would build.

use serde_json::{Value, json};
use truecast::accel::Accelerator;
use truecast::render::predict;
use truecast::scene::Scene;

/// Bytes of the mesh and of the tree of the quickest way that has one, which is built to be weighed.
fn weigh(scene: &Scene) -> (usize, Option<usize>) {
    let ways = predict(scene, scene.camera.resolution().window());
    let preset = ways.iter().find_map(|way| way.preset);
    let tree = preset.map(|preset| Accelerator::build(&scene.mesh, preset).bytes());
    (scene.mesh.bytes(), tree)
}

fn per_triangle(bytes: usize, scene: &Scene) -> f64 {
    bytes as f64 / scene.mesh.len().max(1) as f64
}

/// The line of the text.
pub(super) fn line(scene: &Scene) -> String {
    let (mesh, tree) = weigh(scene);
    let mut line = format!("memory     mesh {:.1} bytes per triangle", per_triangle(mesh, scene));
    if let Some(tree) = tree {
        line += &format!(", BVH {:.1}", per_triangle(tree, scene));
    }
    line + "\n"
}

/// The numbers of the document.
pub(super) fn document(scene: &Scene) -> Value {
    let (mesh, tree) = weigh(scene);
    json!({
        "mesh_bytes": mesh,
        "bvh_bytes": tree,
        "mesh_bytes_per_triangle": per_triangle(mesh, scene),
        "bvh_bytes_per_triangle": tree.map(|tree| per_triangle(tree, scene)),
    })
}
