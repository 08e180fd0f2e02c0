//! H58, H59 and H63 to H65: meshes that a build does not survive, and answers that hang on the tree.

use crate::scale::{cover, ids};
use crate::support::configurations::{Breadth, FULL, NARROW, agreed, agreed_within};
use crate::support::rays::Random;
use crate::support::scenes::{Triangle, rectangle, standard_scene};
use crate::support::sizes;
use std::time::Instant;
use truecast::accel::{Accelerator, BuildPreset};
use truecast::cast::cast;
use truecast::pixel::Resolution;
use truecast::raster::rasterize;
use truecast::scene::Scene;
use truecast::scene::camera::PinholeCamera;
use truecast::visibility::{Counting, VisibilityBuffer};

/// 10⁴ and 10⁶ copies of one triangle: one answer, one test per ray, no quadratic build.
#[test]
fn h58_identical_triangles() {
    let triangle = [[-4.0, -4.0, 8.0], [4.0, -4.0, 8.0], [-4.0, 4.0, 8.0]];
    let presets = [&[BuildPreset::Medium][..], &BuildPreset::ALL][usize::from(sizes::is_full())];
    assert_eq!(presets.len(), sizes::H58.running());
    for count in [10_000, 1_000_000] {
        let scene = standard_scene(&vec![triangle; count]);
        let window = scene.camera.resolution().window();
        let raster = rasterize(&scene, window, Counting::All, &|| ());
        assert_copies(&raster, count);
        for &preset in presets {
            let started = Instant::now();
            let accelerator = Accelerator::build(&scene.mesh, preset);
            // About 0.3 s on an idle machine; clustering them one by one would take hours.
            assert!(started.elapsed().as_secs_f64() < 10.0, "{:?}", started.elapsed());
            assert!(accelerator.depth() <= 64, "{}", accelerator.depth());
            let answer = cast(&scene, &accelerator, window, Counting::All, &|| ());
            assert_copies(&answer, count);
            assert_eq!(answer.cover, raster.cover);
        }
    }
}

/// What `count` copies of the triangle of 36 pixels show.
fn assert_copies(buffer: &VisibilityBuffer, count: usize) {
    assert_eq!(buffer.covered_pixels(), 36);
    for (index, visible) in buffer.visible.iter().enumerate() {
        let Some(visible) = visible else { continue };
        assert_eq!((visible.triangle.get(), visible.tie), (0, true));
        assert_eq!(cover(buffer, index).crossed as usize, count);
        assert_eq!(cover(buffer, index).signed.unsigned_abs() as usize, count);
    }
}

/// 4 000 nested triangles with one centroid, in one plane: the lowest id wherever it reaches.
#[test]
fn h59_concentric() {
    let triangles: Vec<Triangle> = (1..=4000)
        .map(|i| {
            let s = i as f32 / 256.0;
            [[-s, -s, 8.0], [2.0 * s, -s, 8.0], [-s, 2.0 * s, 8.0]]
        })
        .collect();
    let scene = standard_scene(&triangles);
    for preset in BuildPreset::ALL {
        let depth = Accelerator::build(&scene.mesh, preset).depth();
        assert!(depth <= 64, "{preset:?}: depth {depth}");
    }
    let breadth = Breadth { audited_pixels: 4, ..NARROW };
    let buffer = agreed_within(&scene, &breadth, "concentric");
    assert_eq!(ids(&buffer)[8 * 17 + 8], Some(0));
    // The hypotenuse x + y = s passes the sample (1, 1) at s = 512/256, where it is exclusive, so
    // the next triangle, with the id 512, is the first that covers it.
    assert_eq!(ids(&buffer)[9 * 17 + 9], Some(512));
}

/// Of triangles at the same depth in leaves far apart, the lowest id is seen, whatever the tree
/// and the order.
#[test]
fn h63_equal_t() {
    // Twelve large triangles in the plane z = 8 with centroids far from each other, which all
    // cover the middle of the frame, and bystanders at other depths between them.
    let mut triangles: Vec<Triangle> = (0..12)
        .map(|k| {
            let (x, y): (f32, f32) =
                ([40.0, -40.0, 300.0, -300.0][k % 4], [500.0, -500.0, 60.0][k % 3]);
            [[-9.0 * x.signum(), -9.0, 8.0], [x, y, 8.0], [-x / 40.0, -y / 10.0, 8.0]]
        })
        .collect();
    let plane = triangles.len();
    for k in 0..30 {
        let at = [(k % 6) as f32 * 20.0 - 60.0, (k / 6) as f32 * 20.0 - 50.0];
        triangles.push(rectangle(at, [at[0] + 5.0, at[1] + 5.0], 9.0 + k as f32)[0]);
    }
    let mut order: Vec<usize> = (0..triangles.len()).collect();
    let mut random = Random(63);
    let mut contested = 0;
    for shuffle in 0..100 {
        random.shuffle(&mut order);
        let shuffled: Vec<Triangle> = order.iter().map(|&k| triangles[k]).collect();
        let breadth = Breadth {
            tile_sides: if sizes::is_full() { FULL.tile_sides } else { &[32] },
            audited_pixels: if shuffle == 0 { 289 } else { sizes::H63.running() },
            ..FULL
        };
        let buffer = agreed_within(&standard_scene(&shuffled), &breadth, "shuffled");
        // The lowest new id among those of the plane that cover the sample, each asked alone.
        let first = (0..order.len()).filter(|&id| order[id] < plane);
        for (index, visible) in buffer.visible.iter().enumerate() {
            let Some(visible) = visible else { continue };
            let id = visible.triangle.index();
            if order[id] < plane && cover(&buffer, index).crossed > 1 {
                contested += 1;
            }
        }
        if shuffle % 25 == 0 {
            let mut alone = vec![None; 289];
            for id in first {
                let mask = agreed_within(&standard_scene(&[shuffled[id]]), &NARROW, "alone");
                for (index, visible) in mask.visible.iter().enumerate() {
                    if visible.is_some() && alone[index].is_none() {
                        alone[index] = Some(id as u32);
                    }
                }
            }
            for (seen, lowest) in ids(&buffer).iter().zip(&alone) {
                assert!(lowest.is_none() || seen == lowest, "{seen:?} {lowest:?}");
            }
        }
    }
    assert!(contested > 5000, "{contested}");
}

/// 10⁴ random triangles and 10⁴ rays: all crossings by tree, by scan and by rasterizer.
#[test]
fn h64_all_hits() {
    let mut random = Random(64);
    let mut triangles: Vec<Triangle> = (0..8000)
        .map(|_| {
            let size = 4.0 * random.unit().powi(6) + 0.05;
            let center = [0.0, 0.0, 2.0].map(|c| c + 12.0 * random.unit() - 6.0);
            [0; 3].map(|_| center.map(|c| (c + size * (random.unit() - 0.5)) as f32))
        })
        .collect();
    // On small integers too, so that ties abound.
    triangles.extend((0..2000).map(|_| [0; 3].map(|_| [0; 3].map(|_| random.integer(3)))));
    let camera = PinholeCamera::exact(
        Resolution::new(100, 100).unwrap(),
        [0.25, -0.5, -8.5],
        [-0.78125, -0.78125, 1.0],
        [1.0 / 64.0, 0.0, 0.0],
        [0.0, 1.0 / 64.0, 0.0],
    )
    .unwrap();
    let breadth = Breadth {
        presets: &[BuildPreset::Medium, BuildPreset::Fastest],
        tile_sides: &[32],
        audited_pixels: sizes::H64.running(),
        linear: true,
    };
    let scene = Scene::from_triangles(camera, &triangles);
    let buffer = agreed_within(&scene, &breadth, "10⁴ triangles");
    let crossings: u64 = (0..10_000).map(|index| u64::from(cover(&buffer, index).crossed)).sum();
    assert!(crossings > 100_000, "{crossings}");
    assert!(buffer.visible.iter().flatten().filter(|v| v.tie).count() > 20);
}

/// Sizes 2^-k: a tree as deep as the chain is long, were it kept.
#[test]
fn h65_deep_stack() {
    let chain: Vec<Triangle> = (-140..=120)
        .map(|k| {
            let s = 2.0_f64.powi(k) as f32;
            [[-s, -s, 2.0 * s], [s, -s, 2.0 * s], [-s, s, 3.0 * s]]
        })
        .collect();
    let scene = standard_scene(&chain);
    for preset in BuildPreset::ALL {
        let depth = Accelerator::build(&scene.mesh, preset).depth();
        assert!((1..=96).contains(&depth), "{preset:?}: depth {depth}");
    }
    let buffer = agreed(&scene);
    // The sample looks a quarter to the left; the smallest is nearest, and all are crossed.
    assert_eq!(ids(&buffer)[8 * 17 + 6], Some(0), "the smallest is nearest");
    assert_eq!(cover(&buffer, 8 * 17 + 6).crossed, 261);
}
