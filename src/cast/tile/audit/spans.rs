//! The cull's rectangles, hunted: no sample that a triangle covers lies outside its own.

use super::{Random, aimed, camera};
use crate::accel::{Accelerator, LeafTriangle, Linked, NO_TRIANGLE};
use crate::cast::coverage;
use crate::cast::single::ShearedRay;
use crate::cast::tile::cull::{self, Cull, Live};
use crate::cast::tile::frame::{Frame, Lattice, SIDE};
use crate::mesh::TriangleId;
use crate::pixel::Pixel;
use crate::scene::Scene;
use crate::simd::SimdLevel;
use fearless_simd::{Simd, dispatch};

/// What the hunt saw.
#[derive(Default, Debug)]
struct Seen {
    /// Samples covered, and triangles that no sample of the tile lies in.
    covered: usize,
    absent: usize,
    /// Triangles with a rectangle of at most 2 × 2 samples.
    small: usize,
}

#[inline(always)]
fn survivors<S: Simd>(simd: S, frame: &Frame<'_>, cull: &Cull, live: &mut Live) {
    for root in &frame.tree.roots {
        let Linked::Leaf(leaf) = root.target() else { panic!("a line of leaves has no nodes") };
        cull::survivors(simd, cull, frame.tree, leaf, f32::INFINITY, live);
    }
}

fn hunt(scene: &Scene, level: SimdLevel, seen: &mut Seen) {
    let accelerator = Accelerator::linear(&scene.mesh);
    let frame = Frame::new(scene, &accelerator);
    let lattice = Lattice::new(&frame, scene.camera.resolution().window());
    let cull = Cull::new(&frame, &lattice);
    let mut live = Live::EMPTY;
    dispatch!(level.dispatched(), simd => survivors(simd, &frame, &cull, &mut live));
    let place = |id: TriangleId| live.ids[..live.count].iter().position(|own| *own == id.get());
    for id in scene.mesh.ids() {
        let spans = place(id).map(|lane| live.spans.map(|row| row[lane]));
        seen.absent += usize::from(spans.is_none());
        let is_small = |s: [f32; 4]| s[1] - s[0] <= 1.0 && s[3] - s[2] <= 1.0;
        seen.small += usize::from(spans.is_some_and(is_small));
        let triangle = LeafTriangle { vertices: scene.mesh.triangle(id), id, copies: 1 };
        for y in 0..SIDE {
            for x in 0..SIDE {
                let ray = frame.view.ray(Pixel { x: x as u32, y: y as u32 });
                if coverage::decide(&ray, &ShearedRay::new(&ray), &triangle).0.is_none() {
                    continue;
                }
                seen.covered += 1;
                let within = spans.is_some_and(|[left, right, top, bottom]| {
                    (left..=right).contains(&(x as f32)) && (top..=bottom).contains(&(y as f32))
                });
                assert!(within, "{id:?} covers ({x}, {y}), and its rectangle is {spans:?}");
            }
        }
    }
}

#[test]
fn triangles_cover_no_sample_outside_their_rectangles() {
    let mut random = Random(2);
    let mut seen = Seen::default();
    assert_eq!(Live::EMPTY.ids[0], NO_TRIANGLE);
    let eyes = [[0.0; 3], [0.1, -0.7, 1e-9], [1e4 + 0.3, -3e3, 7e5 + 1.0 / 3.0]];
    for eye in eyes {
        for tilt in [0.0, 0.37] {
            let camera = camera(eye, tilt);
            for round in 0..3 {
                // As many as a leaf has room for. Corners lie on samples and a step of f32 beside.
                let triangles: Vec<_> = (0..96)
                    .map(|i| {
                        let spread = [2.0, 3.0, 8.0, 400.0][i % 4];
                        [0; 3].map(|_| aimed(&mut random, &camera, spread))
                    })
                    .collect();
                let scene = Scene::from_triangles(camera.clone(), &triangles);
                let levels = SimdLevel::available();
                hunt(&scene, levels[round % levels.len()], &mut seen);
            }
        }
    }
    assert!(seen.covered > 10_000 && seen.small > 100 && seen.absent > 20, "{seen:?}");
}
