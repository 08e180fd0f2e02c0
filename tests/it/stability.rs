//! The stability mask against answers for moved samples and moved vertices.
//!
//! The camera's lattice holds every sample on the 1/256 pixel grid exactly, so that a camera whose
//! D0 is moved by a·DX/256 + b·DY/256 asks about exactly that sample of the same scene.

use super::support::closed::integer_chaos;
use super::support::golden;
use super::support::scenes::{
    Triangle, fan, grid_camera, pixel_grid, rectangle, scaled, standard_scene,
};
use std::path::Path;
use truecast::accel::{Accelerator, BuildPreset};
use truecast::mesh::TriangleId;
use truecast::pixel::Resolution;
use truecast::raster::{STANDARD_HALF_WIDTH, rasterize, stability, stability_in_tiles};
use truecast::scene::camera::PinholeCamera;
use truecast::scene::{Overrides, Scene};
use truecast::visibility::{Counting, VisibilityBuffer};

/// Asked of the other path: the mask belongs to the rasterizer.
fn seen(scene: &Scene) -> VisibilityBuffer {
    let accelerator = Accelerator::build(&scene.mesh, BuildPreset::Medium);
    let window = scene.camera.resolution().window();
    truecast::cast::cast(scene, &accelerator, window, Counting::Nearest, &|| ())
}

pub(super) fn ids(buffer: &VisibilityBuffer) -> Vec<Option<TriangleId>> {
    buffer.visible.iter().map(|visible| visible.map(|visible| visible.triangle)).collect()
}

fn mask(scene: &Scene, buffer: &VisibilityBuffer, half_width: f64) -> Vec<bool> {
    stability(scene, buffer, half_width, &|| ())
}

/// The scene seen at samples moved by (a, b)/256 of a pixel.
fn moved(scene: &Scene, [a, b]: [i32; 2]) -> Scene {
    let camera = &scene.camera;
    let (x, y) = (f64::from(a) / 256.0, f64::from(b) / 256.0);
    let d0: [f64; 3] =
        std::array::from_fn(|k| camera.d0()[k] + x * camera.dx()[k] + y * camera.dy()[k]);
    let (dx, dy) = (camera.dx(), camera.dy());
    let moved = PinholeCamera::exact(camera.resolution(), camera.eye(), d0, dx, dy).unwrap();
    assert_eq!((moved.d0(), moved.dx(), moved.dy()), (d0, dx, dy), "stays on the lattice");
    Scene { camera: moved, ..scene.clone() }
}

/// Demands the buffer's ids at every stable pixel for samples moved to the corners and the edges'
/// middles of the box; gives the number of stable pixels and of changed ids.
fn assert_holds(name: &str, scene: &Scene, steps: i32) -> [usize; 2] {
    let buffer = seen(scene);
    let stable = mask(scene, &buffer, f64::from(steps) / 256.0);
    let expected = ids(&buffer);
    let mut changed = 0;
    for a in [-steps, 0, steps] {
        for b in [-steps, 0, steps] {
            let answer = ids(&seen(&moved(scene, [a, b])));
            for (index, (now, before)) in answer.iter().zip(&expected).enumerate() {
                let pixel = buffer.window.pixel(index);
                changed += usize::from(now != before);
                assert!(now == before || !stable[index], "{name} moved by {a}, {b}: {pixel:?}");
            }
        }
    }
    [stable.iter().filter(|&&stable| stable).count(), changed]
}

/// Scenes with many samples on, or next to, edges, corners and equal depths.
fn structured() -> Vec<(String, Scene)> {
    let mut scenes: Vec<(String, Scene)> =
        golden::scenes().into_iter().map(|golden| (golden.name, golden.scene)).collect();
    let mut add = |name: &str, triangles: &[Triangle]| {
        scenes.push((name.to_owned(), standard_scene(triangles)));
    };
    add("fan of 8", &fan(8));
    add("fan of 1000", &fan(1000));
    for seed in 0..12 {
        // Half as large, before the eye.
        let chaos: Vec<Triangle> = scaled(&integer_chaos(seed), 0.5)
            .iter()
            .map(|t| t.map(|[x, y, z]| [x, y, z + 2.0]))
            .collect();
        add(&format!("chaos {seed}"), &chaos);
        // Around the eye: triangles through its plane.
        let around: Vec<Triangle> = integer_chaos(seed)
            .iter()
            .map(|t| t.map(|[x, y, z]| [x + 0.25, y - 0.125, z + 0.375]))
            .collect();
        add(&format!("chaos around the eye {seed}"), &around);
    }
    // Edges exactly one step, and nearly one step, beside samples.
    let step = 1.0 / 256.0;
    for beside in [0.0, step, -step, step * 0.999, step * 1.001] {
        add("beside", &rectangle([-3.0 + beside, -4.0], [5.0, 2.0 - beside], 8.0));
    }
    // Interpenetration: the crossing line runs along a column of samples, and beside it.
    for beside in [0.0_f32, 0.004, 0.5] {
        let mut crossing = rectangle([-9.0, -9.0], [9.0, 9.0], 8.0).to_vec();
        let tilted = rectangle([-9.0, -9.0], [9.0, 9.0], 8.0);
        crossing.extend(tilted.map(|t| t.map(|[x, y, z]| [x, y, z + (x - beside) * 0.25])));
        add("interpenetration", &crossing);
    }
    scenes
}

#[test]
fn stable_pixels_hold_for_every_moved_sample() {
    let mut total = [0; 2];
    for (name, scene) in structured() {
        for steps in [1, 3, 128] {
            let [stable, changed] = assert_holds(&name, &scene, steps);
            total = [total[0] + stable, total[1] + changed];
        }
    }
    assert!(total[0] > 10_000 && total[1] > 2000, "{total:?}");
}

#[test]
fn a_grid_on_pixel_centres_is_stable_nowhere_on_its_lines() {
    let scene = Scene::from_triangles(grid_camera(33, 8.0), &pixel_grid(33, 8, 8.0));
    let buffer = seen(&scene);
    let stable = mask(&scene, &buffer, STANDARD_HALF_WIDTH);
    for (index, pixel) in buffer.window.pixels().enumerate() {
        let (x, y) = (pixel.x % 8, pixel.y % 8);
        assert_eq!(stable[index], x != 0 && y != 0 && x + y != 8, "{pixel:?}");
    }
    assert_holds("grid", &scene, 1);
}

/// Copies and coplanar triangles: the lowest id is stable before all others, and no other is.
#[test]
fn the_same_plane_is_decided_exactly() {
    let near = rectangle([-6.0, -6.0], [6.0, 6.0], 8.0);
    let turned = near.map(|[a, b, c]| [a, c, b]);
    let other_size = rectangle([-9.0, -9.0], [4.0, 4.0], 8.0);
    let triangles = [&near[..], &near, &turned, &other_size].concat();
    let scene = standard_scene(&triangles);
    let buffer = seen(&scene);
    let stable = mask(&scene, &buffer, STANDARD_HALF_WIDTH);
    // Pixel (6, 6) lies inside triangle 0 and all of its copies.
    let inside = buffer.window.index(truecast::pixel::Pixel { x: 6, y: 6 });
    assert_eq!(buffer.visible[inside].map(|v| v.triangle.get()), Some(0));
    assert!(stable[inside]);
    assert_holds("copies", &scene, 1);
    // A buffer that shows a copy of higher id is not the answer, and never stable.
    let mut wrong = buffer.clone();
    for visible in wrong.visible.iter_mut().flatten() {
        if visible.triangle.get() < 2 {
            visible.triangle = TriangleId::new(visible.triangle.get() + 2);
        }
    }
    let stable = mask(&scene, &wrong, STANDARD_HALF_WIDTH);
    for (index, (a, b)) in ids(&wrong).iter().zip(ids(&buffer)).enumerate() {
        assert!(!stable[index] || *a == b, "{index}");
    }
}

/// A wrong buffer is never stable where it is wrong, whatever is wrong with it.
#[test]
fn a_damaged_buffer_is_not_stable_where_it_is_damaged() {
    let mut damages = 0;
    for (name, scene) in structured() {
        let buffer = seen(&scene);
        let count = scene.mesh.len() as u32;
        for damage in 0..3 {
            let mut damaged = buffer.clone();
            for index in (damage..damaged.visible.len()).step_by(3) {
                let visible = &mut damaged.visible[index];
                match (damage, *visible) {
                    (0, _) => *visible = None,
                    (_, Some(v)) => {
                        let id = (v.triangle.get() + damage as u32) % count;
                        *visible = Some(truecast::visibility::Visible {
                            triangle: TriangleId::new(id),
                            ..v
                        });
                    }
                    (_, None) => *visible = buffer.visible.iter().flatten().next().copied(),
                }
            }
            let stable = mask(&scene, &damaged, 0.0);
            for (index, (a, b)) in ids(&damaged).iter().zip(ids(&buffer)).enumerate() {
                assert!(!stable[index] || *a == b, "{name}, damage {damage}, {index}");
                damages += usize::from(*a != b);
            }
        }
    }
    assert!(damages > 5000, "{damages}");
}

#[test]
fn tiles_crops_and_senseless_widths() {
    for (name, scene) in structured() {
        let frame = scene.camera.resolution();
        let buffer = rasterize(&scene, frame.window(), Counting::Nearest, &|| ());
        let whole = mask(&scene, &buffer, STANDARD_HALF_WIDTH);
        for side in [1, 5, 16] {
            let tiled = stability_in_tiles(&scene, &buffer, STANDARD_HALF_WIDTH, side, &|| ());
            assert_eq!(tiled, whole, "{name} in tiles of {side}");
        }
        let window = truecast::pixel::Window::new(frame, 2, 3, 15, 9).unwrap();
        let crop = rasterize(&scene, window, Counting::Nearest, &|| ());
        let part = mask(&scene, &crop, STANDARD_HALF_WIDTH);
        for (index, pixel) in window.pixels().enumerate() {
            assert_eq!(part[index], whole[buffer.window.index(pixel)], "{name} {pixel:?}");
        }
        for width in [-0.1, f64::NAN, f64::INFINITY, 65_537.0] {
            assert!(!mask(&scene, &buffer, width).contains(&true));
        }
    }
}

/// On a real picture nearly everything is stable.
#[test]
fn most_of_a_generic_picture_is_stable() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/default.toml");
    let overrides = Overrides { resolution: Resolution::new(320, 180), ..Overrides::default() };
    let scene = Scene::load(&path, &overrides).unwrap();
    let buffer = seen(&scene);
    let stable = mask(&scene, &buffer, STANDARD_HALF_WIDTH);
    let covered = buffer.covered_pixels();
    let held = (0..stable.len()).filter(|&k| stable[k] && buffer.visible[k].is_some()).count();
    assert!(covered > 10_000 && held * 100 >= covered * 95, "{held} of {covered}");
    assert!(held < covered, "edges are not stable");
}

/// Triangles of a 2-D scene: corners (x, y) in pixels from the frame's centre, in layers of depth
/// 64·2^k, so that every corner on the 1/256 pixel grid is an f32.
fn flat_scene(corners: &[([[f64; 2]; 3], u32)]) -> Scene {
    let triangles: Vec<Triangle> = corners
        .iter()
        .map(|(corners, layer)| {
            let scale = f64::from(1_u32 << layer);
            corners.map(|[x, y]| [x * scale, y * scale, 64.0 * scale].map(|c| c as f32))
        })
        .collect();
    Scene::from_triangles(grid_camera(65, 64.0), &triangles)
}

/// H8A: every vertex of a 2-D scene snapped to 1/256 pixel, that is moved by up to 1/512: ids are
/// the same on stable pixels, and on others some are not.
#[test]
fn h8a_stability_mask() {
    let mut state = 0x9E37_79B9_7F4A_7C15_u64;
    let mut random = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let (mut changed, mut stable_pixels) = (0, 0);
    for _ in 0..12 {
        let corners: Vec<([[f64; 2]; 3], u32)> = (0..400)
            .map(|k| {
                let (x, y) = (random() * 64.0 - 32.0, random() * 64.0 - 32.0);
                let size = if k % 4 == 0 { 20.0 } else { 4.0 };
                let mut corner = || [x + size * random(), y + size * random()];
                ([corner(), corner(), corner()], k % 5)
            })
            .collect();
        let snap = |c: f64| (c * 256.0).round_ties_even() / 256.0;
        let snapped: Vec<_> = corners.iter().map(|(t, l)| (t.map(|v| v.map(snap)), *l)).collect();
        let (scene, snapped) = (flat_scene(&corners), flat_scene(&snapped));
        let buffer = seen(&scene);
        let stable = mask(&scene, &buffer, STANDARD_HALF_WIDTH);
        for (index, (a, b)) in ids(&buffer).iter().zip(ids(&seen(&snapped))).enumerate() {
            assert!(!stable[index] || *a == b, "{:?}", buffer.window.pixel(index));
            changed += usize::from(*a != b);
            stable_pixels += usize::from(stable[index]);
        }
    }
    assert!(changed > 20, "{changed}");
    assert!(stable_pixels > 12 * 65 * 65 * 9 / 10, "{stable_pixels}");
}
