//! The surface area heuristic of a finished tree: what a random ray is expected to test.
//!
//! J. Goldsmith and J. Salmon, "Automatic creation of object hierarchies for ray tracing" (1987):
//! a line that meets a convex box meets one inside it with the ratio of their areas. Testing the
//! 16 boxes of a node counts 1, testing a group of 8 triangles counts 1.

use super::wide::{GROUP, Link, Linked, WideNode, WideTree};

impl WideTree {
    /// Expected tests of a line that meets the root's box; `None` for a tree without nodes or area.
    pub(super) fn surface_area_cost(&self) -> Option<f64> {
        let root = self.nodes.first()?;
        let whole = half_area(root, 0..root.count as usize);
        let tests = |link: u32| match Link(link).target() {
            Linked::Node(_) => 1.0,
            Linked::Leaf(leaf) => (leaf.count / GROUP) as f64,
        };
        let expected: f64 = self
            .nodes
            .iter()
            .flat_map(|node| (0..node.count as usize).map(move |child| (node, child)))
            .map(|(node, child)| {
                half_area(node, child..child + 1) / whole * tests(node.children[child])
            })
            .sum();
        (whole > 0.0).then_some(1.0 + expected)
    }
}

/// Half the area of the box around these children of a node.
fn half_area(node: &WideNode, children: std::ops::Range<usize>) -> f64 {
    let side = |axis: usize| {
        let of = |face: usize| children.clone().map(move |c| f64::from(node.planes[face][axis][c]));
        of(1).fold(f64::NEG_INFINITY, f64::max) - of(0).fold(f64::INFINITY, f64::min)
    };
    let [x, y, z] = [side(0), side(1), side(2)];
    x * y + y * z + z * x
}

#[cfg(test)]
mod tests {
    use crate::accel::{Accelerator, BuildPreset};
    use crate::mesh::TriangleMesh;

    /// Triangles with the boxes [x, x+1] × [0, 1]².
    fn row(places: &[f32]) -> TriangleMesh {
        let corners = |&x: &f32| [[x, 0.0, 0.0], [x + 1.0, 0.0, 0.0], [x, 1.0, 1.0]];
        TriangleMesh {
            positions: places.iter().flat_map(corners).collect(),
            corners: (0..places.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
            ..TriangleMesh::default()
        }
    }

    #[test]
    fn two_clusters_by_hand() {
        // 20 times the same box at 0 and at 3, of triangles that differ: two leaves of three groups.
        let mut mesh = row(&[0.0, 3.0].repeat(20));
        for (triangle, corners) in mesh.positions.chunks_mut(3).enumerate() {
            let inside = corners[0][0] + (triangle + 1) as f32 / 64.0;
            corners[1][2] = (triangle + 1) as f32 / 64.0;
            corners[2][0] = inside;
        }
        let tree = Accelerator::build(&mesh, BuildPreset::Medium);
        assert_eq!((tree.node_count(), tree.depth()), (1, 2));
        // The root is 4 × 1 × 1, half area 9; each leaf is a unit cube, half area 3.
        let expected = 1.0 + 3.0 * 3.0 / 9.0 + 3.0 * 3.0 / 9.0;
        let cost = tree.surface_area_cost().unwrap();
        // Four roundings of numbers below 4.
        assert!((cost - expected).abs() < 8.0 * f64::EPSILON, "{cost}");
    }

    #[test]
    fn a_tree_without_nodes_has_none() {
        let tree = Accelerator::build(&row(&[0.0]), BuildPreset::Medium);
        assert_eq!(tree.surface_area_cost(), None);
    }
}
