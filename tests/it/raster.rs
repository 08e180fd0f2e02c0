//! The rasterizer against golden pictures, the definition, and itself in other circumstances.

mod brute;
mod chaos;
mod golden;
mod levels;

use brute::Brute;
use dashu_ratio::RBig;
use golden::goldens;
use truecast::pixel::{Resolution, Window};
use truecast::raster::{rasterize, rasterize_in_tiles};
use truecast::scene::Scene;
use truecast::scene::camera::PinholeCamera;
use truecast::visibility::{Counting, Level, VisibilityBuffer, Visible};

type Triangles = Vec<[[f32; 3]; 3]>;

/// The camera of the hard cases: 17 × 17 pixels, pixel (8, 8) looks along (0, 0, focal).
fn grid_camera(eye: [f64; 3], focal: f64) -> PinholeCamera {
    let frame = Resolution::new(17, 17).unwrap();
    PinholeCamera::exact(frame, eye, [-8.5, -8.5, focal], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]).unwrap()
}

fn seen_by(camera: PinholeCamera, triangles: &[[[f32; 3]; 3]]) -> VisibilityBuffer {
    let scene = Scene::from_triangles(camera, triangles);
    rasterize(&scene, scene.camera.resolution().window(), Counting::All, &|| {})
}

fn ids(buffer: &VisibilityBuffer) -> Vec<i64> {
    let id = |v: &Option<Visible>| v.map_or(-1, |v| i64::from(v.triangle.get()));
    buffer.visible.iter().map(id).collect()
}

#[test]
fn golden_pictures_at_every_tile_size() {
    let goldens = goldens();
    assert_eq!(goldens.len(), 26);
    for golden in &goldens {
        let window = golden.scene.camera.resolution().window();
        for side in [1, 3, 8, 17, 64] {
            let buffer = rasterize_in_tiles(&golden.scene, window, Counting::All, side, &|| {});
            let name = format!("{} in tiles of {side}", golden.name);
            assert_eq!(ids(&buffer), golden.ids, "{name}");
            let cover = buffer.cover.as_ref().unwrap();
            assert!(cover.iter().map(|c| i64::from(c.crossed)).eq(golden.cover.clone()), "{name}");
            assert!(cover.iter().map(|c| i64::from(c.signed)).eq(golden.signed.clone()), "{name}");
            let nearest =
                rasterize_in_tiles(&golden.scene, window, Counting::Nearest, side, &|| {});
            assert_eq!(nearest.visible, buffer.visible, "{name}");
            assert_eq!(nearest.cover, None);
        }
    }
}

#[test]
fn golden_scenes_agree_with_the_definition_in_every_field() {
    for golden in goldens() {
        assert_is_the_definition(&golden.scene, &golden.name);
    }
}

#[test]
fn a_crop_is_the_part_of_the_picture_and_threads_do_not_show() {
    for golden in goldens() {
        let frame = golden.scene.camera.resolution();
        let run = |threads: usize, window: Window| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| rasterize_in_tiles(&golden.scene, window, Counting::All, 4, &|| {}))
        };
        let whole = run(1, frame.window());
        assert_eq!(run(2, frame.window()), whole, "{}", golden.name);
        let crop = run(2, Window::new(frame, 3, 5, 16, 11).unwrap());
        for pixel in crop.window.pixels() {
            assert_eq!(crop.at(pixel), whole.at(pixel), "{} {pixel:?}", golden.name);
            let cover = |b: &VisibilityBuffer| b.cover.as_ref().unwrap()[b.window.index(pixel)];
            assert_eq!(cover(&crop), cover(&whole));
        }
    }
}

/// Compares ids, counts, facing, ties, depth and weights with the definition at every pixel.
fn assert_is_the_definition(scene: &Scene, name: &str) -> VisibilityBuffer {
    let brute = Brute::new(scene);
    let window = scene.camera.resolution().window();
    let buffer = rasterize(scene, window, Counting::All, &|| {});
    for (index, pixel) in window.pixels().enumerate() {
        let answer = brute.at(pixel);
        let place = format!("{name} at {pixel:?}");
        let cover = buffer.cover.as_ref().unwrap()[index];
        assert_eq!((cover.crossed, cover.signed), (answer.crossed, answer.signed), "{place}");
        let visible = buffer.visible[index];
        assert_eq!(visible.map(|v| v.triangle.get()), answer.id, "{place}");
        let (Some(visible), Some(nearest)) = (visible, answer.nearest) else { continue };
        assert_eq!(i32::from(visible.facing.sign()), -nearest.volume_sign, "{place}");
        assert_eq!(visible.tie, nearest.tie, "{place}");
        assert!(!visible.tie || visible.level == Level::Exact, "{place}");
        let exact = |value: f64| RBig::try_from(value).unwrap();
        assert!(exact(visible.t_lo) <= nearest.t && nearest.t <= exact(visible.t_hi), "{place}");
        // Relative width of the depth interval: 2^-40 is the contract.
        assert!(visible.t_hi - visible.t_lo <= visible.t_lo * 2.0_f64.powi(-40), "{place}");
        // Relative error of a weight: 2^-50, derived in the rasterizer's integer stage.
        let bound = exact(2.0_f64.powi(-50));
        for (weight, truth) in visible.barycentric.0.iter().zip(&nearest.weights) {
            let error = exact(*weight) - truth;
            let limit = truth * &bound;
            assert!(error <= limit && -error <= limit, "{place}: {weight}");
        }
    }
    buffer
}

/// H40–H4B and H47: triangles at, through and behind the eye's plane.
#[test]
fn triangles_around_the_eye() {
    let cases: [(&str, [[f32; 3]; 3], usize); 9] = [
        ("crossing the eye's plane", [[-4.0, -3.0, -6.0], [5.0, -3.0, 2.0], [1.0, 6.0, 12.0]], 182),
        ("two behind", [[-4.0, -3.0, -6.0], [5.0, -3.0, -2.0], [1.0, 6.0, 12.0]], 196),
        ("all behind", [[-4.0, -3.0, -6.0], [5.0, -3.0, -2.0], [1.0, 6.0, -12.0]], 0),
        ("an edge with w = 0", [[-4.0, -3.0, 0.0], [5.0, -3.0, 0.0], [1.0, 6.0, 12.0]], 163),
        ("eye in the plane", [[0.0, -3.0, 2.0], [0.0, 5.0, 3.0], [0.0, 1.0, 9.0]], 0),
        ("eye at a vertex", [[0.0, 0.0, 0.0], [5.0, -5.0, 8.0], [5.0, 5.0, 8.0]], 0),
        ("eye on an edge", [[0.0, 0.0, -4.0], [0.0, 0.0, 4.0], [5.0, 5.0, 8.0]], 0),
        ("eye inside", [[-5.0, -5.0, 0.0], [5.0, -5.0, 0.0], [0.0, 5.0, 0.0]], 0),
        ("mirror ghost", [[-60.0, -60.0, -8.0], [90.0, -60.0, -8.0], [0.0, 90.0, -8.0]], 0),
    ];
    for (name, triangle, expected) in cases {
        let scene = Scene::from_triangles(grid_camera([0.0; 3], 8.0), &[triangle]);
        let buffer = assert_is_the_definition(&scene, name);
        assert_eq!(buffer.covered_pixels(), expected, "{name}");
    }
    // One vertex in the eye's plane, in each of the three places.
    let mut triangle = [[-4.0, -3.0, 0.0], [5.0, -3.0, 2.0], [1.0, 6.0, 12.0]];
    for turn in 0..3 {
        triangle.rotate_left(1);
        let scene = Scene::from_triangles(grid_camera([0.0; 3], 8.0), &[triangle]);
        let buffer = assert_is_the_definition(&scene, "a vertex with w = 0");
        assert!(buffer.covered_pixels() > 0, "turn {turn}");
    }
    // H4A: a floor 2^-20 below the eye, 10^8 wide.
    let y = 2.0_f32.powi(-20);
    let floor = [
        [[-1e8, y, -1e8], [1e8, y, -1e8], [1e8, y, 1e8]],
        [[-1e8, y, -1e8], [1e8, y, 1e8], [-1e8, y, 1e8]],
    ];
    let scene = Scene::from_triangles(grid_camera([0.0; 3], 8.0), &floor);
    let buffer = assert_is_the_definition(&scene, "grazing floor");
    assert_eq!(buffer.covered_pixels(), 8 * 17);
}

/// H70 and H72: powers of two and exact translations change nothing.
#[test]
fn scaling_and_translating_exactly_change_nothing() {
    let goldens = goldens();
    let grid = goldens.iter().find(|g| g.name == "grid_exact").unwrap();
    for k in (-120..=110).step_by(5) {
        let scale = 2.0_f32.powi(k);
        let triangles: Triangles =
            grid.triangles.iter().map(|t| t.map(|v| v.map(|c| c * scale))).collect();
        assert_eq!(ids(&seen_by(grid_camera([0.0; 3], 8.0), &triangles)), grid.ids, "2^{k}");
    }
    let far = 2.0_f32.powi(22);
    let triangles: Triangles =
        grid.triangles.iter().map(|t| t.map(|v| v.map(|c| c + far))).collect();
    let eye = [f64::from(far); 3];
    assert_eq!(ids(&seen_by(grid_camera(eye, 8.0), &triangles)), grid.ids);
}

/// The camera's own scale changes t and nothing else.
#[test]
fn camera_exponents_from_minus_300_to_300() {
    let goldens = goldens();
    let golden = goldens.iter().find(|g| g.name == "interpenetrating_2^-20").unwrap();
    let whole = golden.scene.camera.resolution();
    let plain = seen_by(golden.scene.camera.clone(), &golden.triangles);
    for k in [-295, -100, 100, 290] {
        let s = 2.0_f64.powi(k);
        let camera = PinholeCamera::exact(
            whole,
            [0.0; 3],
            [-8.5 * s, -8.5 * s, 8.0 * s],
            [s, 0.0, 0.0],
            [0.0, s, 0.0],
        )
        .unwrap();
        let scaled = seen_by(camera, &golden.triangles);
        for (a, b) in plain.visible.iter().zip(&scaled.visible) {
            let (a, b) = (a.unwrap(), b.unwrap());
            assert_eq!((a.t_lo, a.t_hi), (b.t_lo * s, b.t_hi * s), "2^{k}");
            assert_eq!(Visible { t_lo: a.t_lo, t_hi: a.t_hi, ..b }, a);
        }
    }
}

/// H01, H02: a fan whose hub lies on the sample of pixel (8, 8).
#[test]
fn needle_fans_cover_their_hub_once() {
    for (count, expected) in [(8, 177), (1000, 193), (100_000, 195)] {
        let angle = |i: u32| 2.0 * std::f64::consts::PI * f64::from(i % count) / f64::from(count);
        let rim = |i: u32| [(4.0 * angle(i).cos()) as f32, (4.0 * angle(i).sin()) as f32, 4.0];
        let fan: Triangles = (0..count).map(|i| [[0.0, 0.0, 4.0], rim(i), rim(i + 1)]).collect();
        let buffer = seen_by(grid_camera([0.0; 3], 8.0), &fan);
        assert_eq!(buffer.covered_pixels(), expected, "{count}");
        assert!(buffer.cover.as_ref().unwrap().iter().all(|c| c.crossed <= 1));
    }
}

/// H20, H58: copies are one triangle, and a tile of many copies is not quadratic.
#[test]
fn ten_thousand_copies_show_the_first() {
    let triangle = [[-9.0, -9.0, 8.0], [27.0, -9.0, 8.0], [-9.0, 27.0, 8.0]];
    let buffer = seen_by(grid_camera([0.0; 3], 8.0), &vec![triangle; 10_000]);
    assert!(ids(&buffer).iter().all(|&id| id == 0));
    assert!(buffer.visible.iter().flatten().all(|v| v.tie));
    assert!(buffer.cover.unwrap().iter().all(|c| c.crossed == 10_000));
}
