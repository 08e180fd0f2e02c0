//! The levels without proof, on both paths: right where scenes are easy, wrong where they must be, and
//! told from the exact answer by name.

mod program;

use super::support::closed::sphere;
use super::support::scenes::{Triangle, standard_scene};
use truecast::accel::{Accelerator, BuildPreset};
use truecast::cast::{self, cast_unproven, surfaces};
use truecast::pixel::Resolution;
use truecast::raster::{
    DepthBuffer, DepthFormat, RasterOptions, SubpixelBits, Unproven, rasterize_nearest,
    rasterize_unproven, rasterize_unproven_into,
};
use truecast::scene::Scene;
use truecast::scene::camera::PinholeCamera;
use truecast::simd::SimdLevel;
use truecast::visibility::{Counting, Level, LevelCounts, NearestBuffer, VisibilityBuffer};

const FAST: Unproven = Unproven::Fast { depth_buffer: None };

fn rasterized(scene: &Scene, unproven: Unproven, simd: SimdLevel) -> NearestBuffer {
    let window = scene.camera.resolution().window();
    let levels = LevelCounts::default();
    let mut buffer = NearestBuffer { window, ids: Vec::new(), t: Vec::new(), levels };
    rasterize_unproven_into(scene, unproven, simd, &mut buffer);
    buffer
}

fn casted(scene: &Scene, unproven: cast::Unproven) -> NearestBuffer {
    let tree = Accelerator::build(&scene.mesh, BuildPreset::Medium);
    let window = scene.camera.resolution().window();
    cast_unproven(scene, &tree, window, unproven, SimdLevel::best(), &|| ())
}

fn exact(scene: &Scene) -> NearestBuffer {
    let window = scene.camera.resolution().window();
    rasterize_nearest(scene, window, RasterOptions::default(), &|| ())
}

fn whole(scene: &Scene, unproven: Unproven) -> VisibilityBuffer {
    let window = scene.camera.resolution().window();
    let best = SimdLevel::best();
    rasterize_unproven(scene, window, unproven, best, Counting::Nearest, &|| ())
}

fn wrong(found: &NearestBuffer, right: &NearestBuffer) -> usize {
    assert_eq!(found.ids.len(), right.ids.len());
    found.ids.iter().zip(&right.ids).filter(|(a, b)| a != b).count()
}

/// Two spheres, one before the other, on no grid.
fn spheres() -> Scene {
    let frame = Resolution::new(203, 131).unwrap();
    let camera =
        PinholeCamera::look_at(frame, [0.1, 0.2, -1.0], [0.0, 0.1, 9.0], [0.0, 1.0, 0.0], 58.0);
    let mut triangles = sphere(20, 40, 3.0, [0.3, 0.2, 9.0]);
    triangles.extend(sphere(12, 24, 1.0, [-1.3, 0.7, 4.0]));
    Scene::from_triangles(camera.unwrap(), &triangles)
}

/// A triangle that fills the frame of [`ahead`] in the plane z = 8 + x/16 + `behind`: corners are f32
/// without any rounding for multiples of 2^-20.
fn slanted(behind: f32) -> Triangle {
    [[-64.0, -64.0], [64.0, -64.0], [0.0, 96.0]].map(|[x, y]| [x, y, 8.0 + x / 16.0 + behind])
}

/// The same plane as `slanted(0.0)`, by other corners.
fn turned() -> Triangle {
    [[-80.0, 60.0], [80.0, 68.0], [4.0, -112.0]].map(|[x, y]| [x, y, 8.0 + x / 16.0])
}

/// A camera on no grid that looks along z, before triangles.
fn ahead(triangles: &[Triangle]) -> Scene {
    let (eye, target) = ([0.3, 0.2, -0.7], [0.1, 0.05, 8.0]);
    let frame = Resolution::new(100, 83).unwrap();
    let camera = PinholeCamera::look_at(frame, eye, target, [0.1, 1.0, 0.0], 50.0).unwrap();
    Scene::from_triangles(camera, triangles)
}

#[test]
fn easy_scenes_are_right_at_every_level() {
    let scene = spheres();
    let right = exact(&scene);
    assert!(right.ids.iter().filter(|&&id| id != u32::MAX).count() > 3_000);
    for unproven in [Unproven::Double, FAST] {
        let found = rasterized(&scene, unproven, SimdLevel::best());
        assert_eq!(wrong(&found, &right), 0, "{unproven:?}");
        // f32 rows leave t to a few of f32's ulps.
        for (found, right) in found.t.iter().zip(&right.t).filter(|(_, t)| t.is_finite()) {
            let error = (found / right - 1.0).abs();
            assert!(error < 32.0 * f32::EPSILON, "{unproven:?}: {found} for {right}");
        }
    }
    for unproven in [cast::Unproven::Double, cast::Unproven::Watertight, cast::Unproven::Fast] {
        assert_eq!(wrong(&casted(&scene, unproven), &right), 0, "{unproven:?}");
    }
    // Snapped vertices move an outline over a few samples, and over no more.
    let snapped =
        Unproven::Watertight { subpixel_bits: SubpixelBits::STANDARD, depth_buffer: None };
    let found = wrong(&rasterized(&scene, snapped, SimdLevel::best()), &right);
    assert!((1..200).contains(&found), "{found}");
}

/// Where the exact answer is the lowest id of one plane, and where it takes more digits than f32 has.
#[test]
fn hard_scenes_are_wrong_where_they_must_be() {
    let watertight =
        Unproven::Watertight { subpixel_bits: SubpixelBits::STANDARD, depth_buffer: None };
    let by_raster = |scene: &Scene, right: &NearestBuffer| {
        [Unproven::Double, watertight, FAST]
            .map(|unproven| wrong(&rasterized(scene, unproven, SimdLevel::best()), right))
    };
    let by_rays = |scene: &Scene, right: &NearestBuffer| {
        [cast::Unproven::Double, cast::Unproven::Watertight, cast::Unproven::Fast]
            .map(|unproven| wrong(&casted(scene, unproven), right))
    };
    // Two triangles in one plane: the lowest id, everywhere. f64 rounds their depths apart, rows
    // that are rounded to f32 mostly are the same.
    let shared = ahead(&[slanted(0.0), turned()]);
    let right = exact(&shared);
    assert!(right.ids.iter().all(|&id| id == 0));
    let (raster, rays) = (by_raster(&shared, &right), by_rays(&shared, &right));
    assert!(raster[..2].iter().chain(&rays[..2]).all(|&wrong| wrong > 20), "{raster:?} {rays:?}");
    // Two sheets that are two of f32's ulps apart: f64 tells them, f32 from end to end does not.
    let near = ahead(&[slanted(2.0_f32.powi(-20)), slanted(0.0)]);
    let right = exact(&near);
    assert!(right.ids.iter().all(|&id| id == 1));
    let (raster, rays) = (by_raster(&near, &right), by_rays(&near, &right));
    assert_eq!((raster[0], rays[0]), (0, 0));
    assert!(raster[1] > 20 && rays[1] > 20, "{raster:?} {rays:?}");
    // The same from so far away that they are 2^-30 of their depth apart: to f32 they are one, and
    // whichever comes first is wrong in one of both orders.
    let mut fast = [0; 2];
    for (gaps, id) in [([2.0_f32.powi(-20), 0.0], 1), ([0.0, 2.0_f32.powi(-20)], 0)] {
        let (eye, target) = ([0.3, 0.2, -1000.0], [0.1, 0.05, 8.0]);
        let frame = Resolution::new(40, 33).unwrap();
        let camera = PinholeCamera::look_at(frame, eye, target, [0.1, 1.0, 0.0], 1.5).unwrap();
        let scene = Scene::from_triangles(camera, &gaps.map(slanted));
        let right = exact(&scene);
        assert!(right.ids.iter().all(|&found| found == id));
        let (raster, rays) = (by_raster(&scene, &right), by_rays(&scene, &right));
        assert_eq!((raster[0], rays[0]), (0, 0));
        fast = [fast[0] + raster[2], fast[1] + rays[2]];
    }
    assert!(fast.iter().all(|&wrong| wrong > 20), "{fast:?}");
}

/// Edge-on and zero-area triangles are never visible, at any level.
#[test]
fn what_the_eye_sees_edge_on_stays_invisible() {
    let edge_on = [[0.0, -8.0, 4.0], [0.0, 8.0, 4.0], [0.0, 0.0, 16.0]];
    let needle = [[-4.0, -4.0, 8.0], [0.0, 0.0, 8.0], [4.0, 4.0, 8.0]];
    let behind = slanted(0.0).map(|[x, y, z]| [x, y, -z]);
    let scene = standard_scene(&[edge_on, needle, behind]);
    for unproven in Unproven::ALL {
        let found = rasterized(&scene, unproven, SimdLevel::best());
        assert!(found.ids.iter().all(|&id| id == u32::MAX), "{unproven:?}");
        assert!(found.t.iter().all(|&t| t == f32::INFINITY), "{unproven:?}");
    }
    for unproven in cast::Unproven::ALL {
        assert!(casted(&scene, unproven).ids.iter().all(|&id| id == u32::MAX), "{unproven:?}");
    }
}

#[test]
fn no_bit_of_the_rasterizer_depends_on_instructions_or_threads() {
    let depth_buffer = DepthBuffer::new(DepthFormat::D16, 0.1, 1000.0);
    let levels = [Unproven::Double, FAST, Unproven::Fast { depth_buffer }];
    for scene in [spheres(), ahead(&[slanted(0.0), turned()])] {
        for unproven in levels {
            let first = rasterized(&scene, unproven, SimdLevel::best());
            for simd in SimdLevel::available() {
                assert_eq!(rasterized(&scene, unproven, simd), first, "{unproven:?} {simd}");
            }
            let pool = rayon::ThreadPoolBuilder::new().num_threads(3).build().unwrap();
            let threads = pool.install(|| rasterized(&scene, unproven, SimdLevel::best()));
            assert_eq!(threads, first, "{unproven:?}");
            // Surfaces are those of the ids, with the same t.
            for (index, visible) in whole(&scene, unproven).visible.iter().enumerate() {
                let id = visible.map_or(u32::MAX, |v| v.triangle.get());
                let t = visible.map_or(f32::INFINITY, |v| v.t() as f32);
                assert_eq!((id, t), (first.ids[index], first.t[index]), "{unproven:?} {index}");
            }
        }
    }
}

#[test]
fn surfaces_are_those_of_the_exact_answer_nearly() {
    let scene = spheres();
    let window = scene.camera.resolution().window();
    let right = truecast::raster::rasterize(&scene, window, Counting::Nearest, &|| ());
    let tree = Accelerator::build(&scene.mesh, BuildPreset::Medium);
    let by_rays = |unproven: cast::Unproven| {
        let best = SimdLevel::best();
        let nearest = cast_unproven(&scene, &tree, window, unproven, best, &|| ());
        surfaces(&scene, &nearest, unproven.level())
    };
    for (found, level) in [
        (whole(&scene, Unproven::Double), Level::Double),
        (whole(&scene, FAST), Level::Single),
        (by_rays(cast::Unproven::Double), Level::Double),
        (by_rays(cast::Unproven::Fast), Level::Single),
    ] {
        assert!(found.covered_pixels() > 3_000);
        for (found, right) in found.visible.iter().zip(&right.visible) {
            let (Some(found), Some(right)) = (found, right) else {
                assert_eq!(found.is_some(), right.is_some());
                continue;
            };
            let same = (found.triangle, found.facing, found.tie);
            assert_eq!(same, (right.triangle, right.facing, false));
            assert_eq!(found.level, level);
            for (found, right) in found.barycentric.0.iter().zip(right.barycentric.0) {
                assert!((found - right).abs() < 1e-9, "{found} for {right}");
            }
        }
    }
}

/// Sheets that fill the frame of G(8), and which depth buffers from 0.1 to 1000 cannot tell apart; as
/// for the watertight rasterizer (H29).
#[test]
fn depth_buffers_of_few_bits_tie_and_show_the_first() {
    use DepthFormat::{D16, D24, D32};
    let sheet = |z: f32| [[-4e3, -4e3, z], [4e3, -4e3, z], [0.0, 4e3, z]];
    let cases: [(f32, f32, &[DepthFormat], &[DepthFormat]); 4] = [
        (500.1, 500.2, &[D16, D24, D32], &[]),
        (500.0, 500.05, &[D16, D24, D32], &[]),
        (500.0, 500.1, &[D16], &[D24, D32]),
        (500.0, 501.0, &[D16], &[D24, D32]),
    ];
    for (near, far, ties, orders) in cases {
        for ([first, second], nearer) in [([near, far], 0), ([far, near], 1)] {
            let scene = standard_scene(&[sheet(first), sheet(second)]);
            let formats = ties.iter().map(|f| (f, 0, true));
            for (&format, id, tie) in formats.chain(orders.iter().map(|f| (f, nearer, false))) {
                let depth_buffer = DepthBuffer::new(format, 0.1, 1000.0);
                for visible in whole(&scene, Unproven::Fast { depth_buffer }).visible {
                    let visible = visible.unwrap();
                    let said = (visible.triangle.get(), visible.tie);
                    assert_eq!(said, (id, tie), "{first} and {second} in {format:?}");
                    let t = f64::from([first, second][id as usize]) / 8.0;
                    assert!((visible.t() / t - 1.0).abs() < 1e-6, "{visible:?}");
                }
            }
            for visible in whole(&scene, FAST).visible {
                assert_eq!(visible.unwrap().triangle.get(), nearer, "{first} and {second}");
            }
        }
    }
}
