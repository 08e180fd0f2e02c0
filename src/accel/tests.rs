//! The tree's own promises: every triangle once, in exact boxes, in bounded depth.

use super::bounds::Bounds;
use super::*;
use std::time::Instant;

fn mesh_of(triangles: &[[[f32; 3]; 3]]) -> TriangleMesh {
    TriangleMesh {
        positions: triangles.iter().flatten().copied().collect(),
        corners: (0..triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
        ..TriangleMesh::default()
    }
}

/// Walks the tree: boxes are the union of what they hold, and every triangle is in one leaf.
pub(super) fn check(accelerator: &Accelerator) {
    let tree = &accelerator.tree;
    let mut seen = HashMap::new();
    for &root in &tree.roots {
        bounds_below(tree, root, &mut seen);
    }
    assert!(seen.values().all(|&count| count == 1));
    assert_eq!(seen.len(), held(accelerator).len());
}

/// The box around everything below, after checking that the boxes say the same.
fn bounds_below(tree: &WideTree, link: Link, seen: &mut HashMap<u32, u32>) -> Bounds {
    match link.target() {
        Linked::Leaf(leaf) => {
            let triangles = (0..leaf.count).filter_map(|lane| tree.triangle(leaf, lane));
            triangles.fold(Bounds::EMPTY, |bounds, (id, vertices)| {
                *seen.entry(id.get()).or_default() += 1;
                bounds.union(Bounds::of_triangle(&vertices))
            })
        }
        Linked::Node(index) => {
            let node = &tree.nodes[index];
            let children = 0..node.count as usize;
            children.fold(Bounds::EMPTY, |all, child| {
                let below = bounds_below(tree, Link(node.children[child]), seen);
                let stored = Bounds {
                    lo: std::array::from_fn(|axis| node.planes[0][axis][child]),
                    hi: std::array::from_fn(|axis| node.planes[1][axis][child]),
                };
                assert_eq!(stored, below);
                all.union(below)
            })
        }
    }
}

/// The ids in the leaves.
fn held(accelerator: &Accelerator) -> Vec<u32> {
    let ids = accelerator.tree.ids.iter().copied();
    ids.filter(|&id| id != NO_TRIANGLE).collect()
}

/// How many triangles of the mesh the leaves stand for.
fn represented(accelerator: &Accelerator) -> usize {
    let copies = accelerator.copies.values().map(Vec::len).sum::<usize>();
    held(accelerator).len() + copies
}

fn build_all(triangles: &[[[f32; 3]; 3]], deepest: usize) {
    let mesh = mesh_of(triangles);
    for preset in BuildPreset::ALL {
        let accelerator = Accelerator::build(&mesh, preset);
        check(&accelerator);
        assert_eq!(represented(&accelerator), triangles.len(), "{preset:?}");
        assert!(accelerator.depth() <= deepest, "{preset:?}: depth {}", accelerator.depth());
    }
}

/// 2^k, also below the normal range.
fn power_of_two(k: i32) -> f32 {
    2.0_f64.powi(k) as f32
}

/// A triangle of size `s` whose first corner is `p`.
fn corner_at(p: [f32; 3], s: f32) -> [[f32; 3]; 3] {
    [p, [p[0] + s, p[1], p[2] + s], [p[0], p[1] + s, p[2]]]
}

#[test]
fn h58_identical_triangles_build_fast_and_flat() {
    let triangles = vec![corner_at([1.0, 2.0, 3.0], 1.0); 1_000_000];
    let mesh = mesh_of(&triangles);
    let start = Instant::now();
    let accelerator = Accelerator::build(&mesh, BuildPreset::Medium);
    // About 0.3 s on an idle machine; clustering them one by one would take hours.
    assert!(start.elapsed().as_secs_f64() < 10.0, "{:?}", start.elapsed());
    assert!(accelerator.depth() <= 64);
    assert_eq!(held(&accelerator), [0], "one test per ray");
    assert_eq!(represented(&accelerator), 1_000_000);
}

#[test]
fn h59_concentric_triangles_build_flat() {
    // Homothetic about the centroid, in three orientations of the offset between the centroid and
    // the box's centre.
    for signs in [[1.0, 1.0], [1.0, -1.0], [-1.0, -1.0_f32]] {
        let triangles: Vec<_> = (1..=4000)
            .map(|i| {
                let s = i as f32;
                [[-s, -s], [2.0 * s, -s], [-s, 2.0 * s]]
                    .map(|[x, y]| [x * signs[0], y * signs[1], x])
            })
            .collect();
        build_all(&triangles, 64);
    }
}

#[test]
fn h65_chains_of_sizes_stay_flat() {
    let powers: Vec<_> = (-140..120).map(|k| corner_at([0.0; 3], power_of_two(k))).collect();
    build_all(&powers, DEEPEST);
    let apart: Vec<_> = (-60..60)
        .map(|k| corner_at([power_of_two(k + 2), 0.0, -(power_of_two(k + 2))], power_of_two(k)))
        .collect();
    build_all(&apart, DEEPEST);
}

/// Ties of every union cost: strips and grids of equal cells on integers, near and far.
#[test]
fn regular_grids_are_not_quadratic() {
    for offset in [0.0, 4_194_304.0_f32] {
        let strip: Vec<_> =
            (0..60_000).map(|i| corner_at([offset + i as f32, 0.0, 0.0], 1.0)).collect();
        let grid: Vec<_> = (0..60_000)
            .map(|i| corner_at([offset + (i % 245) as f32, (i / 245) as f32, 0.0], 1.0))
            .collect();
        for triangles in [strip, grid] {
            let mesh = mesh_of(&triangles);
            let start = Instant::now();
            let accelerator = Accelerator::build(&mesh, BuildPreset::Medium);
            // 60 000 passes over 60 000 boxes would take minutes; a build takes about 0.1 s.
            assert!(start.elapsed().as_secs_f64() < 10.0, "{:?}", start.elapsed());
            assert!(accelerator.depth() <= 64, "depth {}", accelerator.depth());
            check(&accelerator);
        }
    }
}

/// Sizes over 200 powers of two, all in one cell of the scene's curve: 100 000 build in a blink, and
/// a tree that parts them by place, not only by size, makes a ray meet few.
#[test]
fn mixed_scales_are_neither_quadratic_nor_unordered() {
    let mut number = 0;
    let mut random = || {
        number += 1;
        (number as f64 * 0.618_033_988_749_894_9).fract()
    };
    let triangles: Vec<_> = (0..100_000)
        .map(|_| {
            let size = 2.0_f64.powi((random() * 201.0) as i32 - 100);
            let at = [random() * 40.0 - 20.0, random() * 24.0 - 12.0, 8.0];
            [0; 3].map(|_| at.map(|c| ((c + 0.1 * random() - 0.05) * size) as f32))
        })
        .collect();
    let mesh = mesh_of(&triangles);
    let started = Instant::now();
    let accelerator = Accelerator::build(&mesh, BuildPreset::Medium);
    // About 0.1 s on an idle machine; minutes where their clustering is quadratic.
    assert!(started.elapsed().as_secs_f64() < 20.0, "{:?}", started.elapsed());
    assert!(accelerator.depth() <= 64, "depth {}", accelerator.depth());
}

#[test]
fn h61_every_magnitude_builds() {
    let largest = power_of_two(126);
    for scale in [1e-45_f32, 1e-40, power_of_two(-100), 1e19, power_of_two(100), largest / 16.0] {
        let triangles: Vec<_> = (0..200)
            .map(|i| {
                let f = |n: u32| ((i * n % 17) as f32 - 8.0) * scale;
                [[f(3), f(5), f(7)], [f(11), f(13), f(2)], [f(9) + scale, f(4), f(6)]]
            })
            .collect();
        build_all_visible(&triangles);
    }
    // All magnitudes in one scene.
    let mixed: Vec<_> = (0..400)
        .map(|i| {
            let s = power_of_two(i * 267 / 400 - 143);
            corner_at([s, -s, s * (i % 3) as f32], s)
        })
        .collect();
    build_all(&mixed, DEEPEST);
}

/// As `build_all` for random triangles, some of which may have no area.
fn build_all_visible(triangles: &[[[f32; 3]; 3]]) {
    for preset in BuildPreset::ALL {
        let accelerator = Accelerator::build(&mesh_of(triangles), preset);
        check(&accelerator);
        assert!(accelerator.depth() <= DEEPEST);
    }
}

#[test]
fn h62_boxes_come_from_vertices() {
    let accelerator = Accelerator::build(
        &mesh_of(&[[[1e8, 0.0, 0.0], [1.0, 0.0, 1.0], [1e8, 1.0, 0.0]]]),
        BuildPreset::Medium,
    );
    let root = accelerator.tree.roots[0];
    let bounds = bounds_below(&accelerator.tree, root, &mut HashMap::new());
    assert_eq!((bounds.lo, bounds.hi), ([1.0, 0.0, 0.0], [1e8, 1.0, 1.0]));
}

#[test]
fn nothing_builds_to_nothing() {
    let accelerator = Accelerator::build(&mesh_of(&[]), BuildPreset::Medium);
    assert_eq!((accelerator.depth(), accelerator.node_count(), accelerator.bytes()), (0, 0, 0));
    let point = [[1.0, 2.0, 3.0]; 3];
    assert_eq!(Accelerator::build(&mesh_of(&[point]), BuildPreset::Medium).depth(), 0);
}

/// κ: the slab of Ize's kind where near and far bounds cross by rounding; a ray through the very
/// corner of a box meets the box.
#[test]
fn h56_corner_rays_meet_their_box() {
    let mut state = 1_u64;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (state >> 40) as f32 / 16_777_216.0
    };
    let mut met = 0;
    for _ in 0..100_000 {
        let eye: [f64; 3] = std::array::from_fn(|_| f64::from(random()) - 0.5);
        // A corner in f32, and a direction that is exact in f64 up to 2^-29: the ray passes the
        // corner at t = 1 exactly where the difference is exact.
        let corner: [f32; 3] = std::array::from_fn(|_| random() * 2.0 - 1.0);
        let direction: [f64; 3] = std::array::from_fn(|k| f64::from(corner[k]) - eye[k]);
        let scaled = direction.map(|c| c / 4.0);
        // The box touches the ray in that corner only: x below, y above.
        let (x, y) = (corner[0], corner[1]);
        let outwards = |value: f32, d: f64| if d > 0.0 { value + 1.0 } else { value - 1.0 };
        let other = [outwards(x, -direction[0]), outwards(y, direction[1])];
        let mut triangle = [[x, y, corner[2]]; 3];
        triangle[1][0] = other[0];
        triangle[2][1] = other[1];
        triangle[1][2] = corner[2] - 1.0;
        triangle[2][2] = corner[2] + 1.0;
        let far = corner_at([50.0, 50.0, 50.0], 1.0);
        let accelerator = Accelerator::build(
            &mesh_of(&[
                triangle,
                far,
                far.map(|p| p.map(|c| -c)),
                corner_at([90.0; 3], 2.0),
                corner_at([-90.0; 3], 2.0),
            ]),
            BuildPreset::Fastest,
        );
        let mut visited = false;
        accelerator.traverse(&Slabs::new(eye, scaled), &mut Pending::default(), |triangles| {
            visited |= triangles.iter().any(|t| t.vertices == triangle);
            f64::INFINITY
        });
        met += u32::from(visited);
    }
    assert_eq!(met, 100_000);
}

/// H50: a ray in the plane of a box's face meets the box, whichever face and whichever zero.
#[test]
fn h50_slabs_are_closed() {
    for (x, zero) in [(-1.0, 0.0), (-1.0, -0.0), (0.0, 0.0), (0.0, -0.0_f64)] {
        let beside = corner_at([x, 0.0, 5.0], 1.0);
        let accelerator = Accelerator::build(
            &mesh_of(&[beside, corner_at([7.0, 0.0, 5.0], 1.0), corner_at([x, 9.0, 5.0], 1.0)]),
            BuildPreset::Fastest,
        );
        let mut met = Vec::new();
        accelerator.traverse(
            &Slabs::new([0.0, 0.25, 0.0], [zero, zero, 1.0]),
            &mut Pending::default(),
            |triangles| {
                met.extend(triangles.iter().map(|t| t.id.get()));
                f64::INFINITY
            },
        );
        assert_eq!(met, [0], "face at x = 0, direction {zero:?}");
    }
}
