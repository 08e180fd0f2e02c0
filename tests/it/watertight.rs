//! The rasterizer as graphics processors have it: every sample exactly once, and different from the
//! exact answer only where the stability mask or the depth's stated error allow it.

mod differences;

use super::stability::ids;
use super::support::closed::integer_chaos;
use super::support::scenes::{
    Triangle, fan, grid_camera, pixel_grid, rectangle, scaled, standard_camera,
};
use assert_cmd::Command;
use truecast::accel::{Accelerator, BuildPreset};
use truecast::pixel::Resolution;
use truecast::raster::{SubpixelBits, rasterize, rasterize_watertight, stability};
use truecast::scene::Scene;
use truecast::scene::camera::PinholeCamera;
use truecast::visibility::{Counting, Level, VisibilityBuffer};

const BITS: [u32; 4] = [0, 4, 8, 12];

fn snapped(scene: &Scene, bits: u32) -> VisibilityBuffer {
    let window = scene.camera.resolution().window();
    let bits = SubpixelBits::new(bits).unwrap();
    rasterize_watertight(scene, window, bits, None, Counting::All, &|| ())
}

/// A camera whose pixels are on no grid, looking at the origin from distance 3.
fn generic_camera(side: u32) -> PinholeCamera {
    let frame = Resolution::new(side, side).unwrap();
    PinholeCamera::look_at(frame, [1.1, 0.7, 2.7], [0.0; 3], [0.1, 1.0, 0.0], 31.0).unwrap()
}

/// A closed sphere of `2·bands²` four-sided cells around `centre`.
fn sphere(bands: u32, radius: f64, centre: [f64; 3]) -> Vec<Triangle> {
    let corner = |i: u32, j: u32| {
        let (a, b) = (
            std::f64::consts::PI * f64::from(i) / f64::from(bands),
            std::f64::consts::PI * f64::from(j % (2 * bands)) / f64::from(bands),
        );
        // Both poles are one vertex each.
        let ring = if i == 0 || i == bands { 0.0 } else { a.sin() };
        let unit = [ring * b.cos(), ring * b.sin(), a.cos()];
        std::array::from_fn(|k| (centre[k] + radius * unit[k]) as f32)
    };
    (0..bands)
        .flat_map(|i| (0..2 * bands).map(move |j| (i, j)))
        .flat_map(|(i, j)| {
            let [a, b, c, d] =
                [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
            [[a, b, c], [a, c, d]]
        })
        .collect()
}

/// The fill-rule test: with every covered triangle counted, no sample has none and none has two.
#[test]
fn grids_and_fans_cover_every_sample_exactly_once() {
    let turned = |angle: f64, grid: &[Triangle]| -> Vec<Triangle> {
        let (s, c) = angle.sin_cos();
        let turn = |[x, y, z]: [f32; 3]| {
            let (x, y) = (f64::from(x), f64::from(y));
            [(c * x - s * y) as f32, (s * x + c * y) as f32, z]
        };
        grid.iter().map(|triangle| triangle.map(turn)).collect()
    };
    for bits in BITS {
        // Cells of 4 pixels: at 0 bits a corner moves by at most ½ pixel, and no cell turns over.
        for step in 0..12 {
            let grid = turned(f64::from(step) * 0.131, &pixel_grid(129, 4, 8.0));
            let scene = Scene::from_triangles(grid_camera(65, 8.0), &grid);
            let cover = snapped(&scene, bits).cover.unwrap();
            assert!(cover.iter().all(|cover| cover.crossed == 1), "{bits} bits, turn {step}");
        }
        // Cells of 1 pixel whose corners lie on the samples.
        let scene = Scene::from_triangles(grid_camera(33, 8.0), &pixel_grid(65, 1, 8.0));
        let cover = snapped(&scene, bits).cover.unwrap();
        assert!(cover.iter().all(|cover| cover.crossed == 1), "{bits} bits, aligned");
        // A tilted plane, in perspective.
        let tilted: Vec<Triangle> = pixel_grid(33, 2, 0.0)
            .iter()
            .map(|t| t.map(|[x, y, _]| [x * 0.2, y * 0.2, x * 0.02 - y * 0.03]))
            .collect();
        let scene = Scene::from_triangles(generic_camera(70), &tilted);
        let cover = snapped(&scene, bits).cover.unwrap();
        assert!(cover.iter().all(|cover| cover.crossed == 1), "{bits} bits, tilted");
        // A fan, its hub on a sample and beside it; rim far outside the frame.
        for (count, offset) in [(8, 0.0), (12, 0.3), (12, 0.0)] {
            let fan: Vec<Triangle> = scaled(&fan(count), 64.0)
                .iter()
                .map(|t| t.map(|[x, y, z]| [x + offset, y - offset, z / 32.0]))
                .collect();
            let scene = Scene::from_triangles(standard_camera(8.0), &fan);
            let cover = snapped(&scene, bits).cover.unwrap();
            assert!(cover.iter().all(|cover| cover.crossed == 1), "{bits} bits, fan of {count}");
        }
    }
}

/// Needles may turn over when they are snapped, and then cover a sample three times, but the
/// signed count cannot change: closed meshes, in front of the eye and around it.
#[test]
fn closed_meshes_have_one_signed_count() {
    for bits in BITS {
        for bands in [6, 40] {
            let scene = Scene::from_triangles(generic_camera(129), &sphere(bands, 1.0, [0.0; 3]));
            let cover = snapped(&scene, bits).cover.unwrap();
            assert!(cover.iter().all(|cover| cover.signed == 0), "{bits} bits, {bands} bands");
            assert!(cover.iter().filter(|cover| cover.crossed == 2).count() > 3000);
            // Around the eye: triangles behind it and through its plane are clipped, and no hole
            // or double shows.
            let eye = scene.camera.eye();
            let around: Vec<Triangle> = sphere(bands, 5.0, eye.map(|c| c + 0.3));
            let scene = Scene::from_triangles(generic_camera(129), &around);
            let cover = snapped(&scene, bits).cover.unwrap();
            let first = cover[0].signed;
            assert_eq!(first.abs(), 1);
            assert!(cover.iter().all(|cover| cover.signed == first), "{bits} bits, around");
            if bits >= 4 {
                assert!(cover.iter().all(|cover| cover.crossed == 1), "{bits} bits, {bands}");
            }
        }
        for seed in 0..40 {
            let chaos: Vec<Triangle> =
                integer_chaos(seed).iter().map(|t| t.map(|[x, y, z]| [x, y, z + 4.0])).collect();
            let scene = Scene::from_triangles(grid_camera(33, 16.0), &chaos);
            let cover = snapped(&scene, bits).cover.unwrap();
            assert!(cover.iter().all(|cover| cover.signed == 0), "{bits} bits, chaos {seed}");
        }
    }
}

/// Where all vertices lie on the grid nothing is moved: the tie rule is the same.
#[test]
fn vertices_on_the_grid_give_the_exact_answer() {
    for bits in BITS {
        // Half a pixel is on the grid only from 1 bit on; samples lie at halves.
        let offset = if bits == 0 { 0.5 } else { 0.0 };
        let grid: Vec<Triangle> = pixel_grid(33, 4, 8.0)
            .iter()
            .map(|t| t.map(|[x, y, z]| [x + offset, y + offset, z]))
            .collect();
        let mut triangles = grid.clone();
        triangles.extend(rectangle([-30.5, -20.5], [10.5, 30.5], 16.0));
        triangles.extend(scaled(&grid, 0.5));
        let scene = Scene::from_triangles(grid_camera(33, 8.0), &triangles);
        let window = scene.camera.resolution().window();
        let exact = rasterize(&scene, window, Counting::All, &|| ());
        let answer = snapped(&scene, bits);
        // `scaled` by half and as deep as half: the same image, nearer.
        assert_eq!(ids(&answer), ids(&exact), "{bits} bits");
        assert_eq!(answer.cover, exact.cover, "{bits} bits");
        for (a, b) in answer.visible.iter().flatten().zip(exact.visible.iter().flatten()) {
            assert_eq!((a.facing, a.level, a.tie), (b.facing, Level::Single, false));
            let error = (a.t() / b.t() - 1.0).abs();
            assert!(error <= truecast::raster::DEPTH_ERROR, "{error:e}");
            for (a, b) in a.barycentric.0.iter().zip(b.barycentric.0) {
                assert!((a - b).abs() < 1e-6, "{a} {b}");
            }
        }
    }
}

/// Triangles through the eye's plane, behind it, and far beyond the guard band.
#[test]
fn clipped_triangles_show_what_the_exact_ones_show() {
    let floor = |height: f32, size: f32| {
        vec![
            [[-size, height, -size], [size, height, -size], [size, height, size]],
            [[-size, height, -size], [size, height, size], [-size, height, size]],
        ]
    };
    let cases: Vec<(&str, Vec<Triangle>, usize)> = vec![
        ("crossing", vec![[[-4.0, -3.0, -6.0], [5.0, -3.0, 2.0], [1.0, 6.0, 12.0]]], 182),
        ("two behind", vec![[[-4.0, -3.0, -6.0], [5.0, -3.0, -2.0], [1.0, 6.0, 12.0]]], 196),
        ("all behind", vec![[[-4.0, -3.0, -6.0], [5.0, -3.0, -2.0], [1.0, 6.0, -12.0]]], 0),
        ("w = 0", vec![[[-4.0, -3.0, 0.0], [5.0, -3.0, 0.0], [1.0, 6.0, 12.0]]], 163),
        ("floor", floor(1.3, 1e3), 136),
        ("a floor close below the eye", floor(1e-3, 1e6), 136),
        ("huge", vec![[[-1e9, -1e9, 8.0], [2e9, -1e9, 8.0], [-1e9, 2e9, 8.0]]], 289),
        ("eye in the plane", vec![[[0.0, -3.0, 2.0], [0.0, 5.0, 3.0], [0.0, 1.0, 9.0]]], 0),
    ];
    for (name, triangles, covered) in cases {
        let scene = Scene::from_triangles(standard_camera(8.0), &triangles);
        let window = scene.camera.resolution().window();
        let exact = rasterize(&scene, window, Counting::All, &|| ());
        assert_eq!(exact.covered_pixels(), covered, "{name}");
        let answer = snapped(&scene, 12);
        let stable = stability(&scene, &exact, 0.5_f64.powi(12), &|| ());
        let held = stable.iter().filter(|&&stable| stable).count();
        assert!(held > 250, "{name}: {held}");
        for (index, pixel) in window.pixels().enumerate() {
            let [a, b] = [&answer, &exact].map(|buffer| buffer.visible[index]);
            assert!(a.is_some() == b.is_some() || !stable[index], "{name} {pixel:?}");
            if let (Some(a), Some(b)) = (a, b) {
                // Depth changes quickly along a floor: 1 % of it for a sixteenth of a step.
                assert!((a.t() / b.t() - 1.0).abs() < 0.01, "{name} {pixel:?}");
                let sum: f64 = a.barycentric.0.iter().sum();
                assert!((sum - 1.0).abs() < 1e-6 && a.facing == b.facing, "{name} {pixel:?}");
            }
        }
    }
}

#[test]
fn the_first_drawn_of_equal_depths_stays_and_threads_do_not_show() {
    let twice = [rectangle([-9.0, -9.0], [9.0, 9.0], 8.0); 2].concat();
    let scene = Scene::from_triangles(standard_camera(8.0), &twice);
    let answer = snapped(&scene, 8);
    assert!(answer.visible.iter().flatten().all(|visible| visible.triangle.get() < 2));
    assert_eq!(answer.covered_pixels(), 289);
    let scene = Scene::from_triangles(generic_camera(200), &sphere(20, 1.0, [0.0; 3]));
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| snapped(&scene, 8))
    };
    assert_eq!(run(1), run(3));
    // The caster knows nothing of all this, and sees nearly the same.
    let accelerator = Accelerator::build(&scene.mesh, BuildPreset::Medium);
    let window = scene.camera.resolution().window();
    let cast = truecast::cast::cast(&scene, &accelerator, window, Counting::Nearest, &|| ());
    let same = ids(&cast).iter().zip(ids(&run(2))).filter(|(a, b)| *a == b).count();
    assert!(same > 40_000 * 99 / 100, "{same}");
}

/// How many pixels a film's plane of ties marks.
fn tied_pixels(film: &truecast::film::Film) -> usize {
    use truecast::film::Samples;
    match film.plane("verdict.tie").unwrap() {
        Samples::Uint(ties) => ties.iter().filter(|&&tie| tie != 0).count(),
        other => panic!("ties are whole numbers: {other:?}"),
    }
}

#[test]
fn the_command_line_renders_it_and_says_what_belongs_to_it() {
    let folder = tempfile::TempDir::new().unwrap();
    let truecast = |arguments: &[&str]| {
        let binary = env!("CARGO_BIN_EXE_truecast");
        let output = Command::new(binary)
            .current_dir(folder.path())
            .args(["render", "--size", "64x36", "--quiet"])
            .args(arguments)
            .output()
            .unwrap();
        (output.status.code(), String::from_utf8(output.stderr).unwrap())
    };
    for (arguments, word) in [
        (&["--subpixel-bits", "4"][..], "--accuracy watertight"),
        (&["--subpixel-bits", "4", "--path", "raster"], "--accuracy watertight"),
        (&["--accuracy", "watertight", "--path", "raster", "--subpixel-bits", "13"], "12"),
        (&["--accuracy", "watertight", "--path", "raster", "--subpixel-bits", "x"], "12"),
        (&["--depth-bits", "24"], "--accuracy watertight"),
        (&["--near", "1"], "--depth-bits"),
        (&["--accuracy", "watertight", "--path", "raster", "--depth-bits", "8"], "16, 24 or 32"),
        (
            &["--accuracy", "watertight", "--path", "raster", "--depth-bits", "16", "--near", "0"],
            "0 < near < far",
        ),
        (
            &["--accuracy", "watertight", "--path", "raster", "--depth-bits", "16", "--far", "nan"],
            "0 < near < far",
        ),
    ] {
        let (status, message) = truecast(arguments);
        assert_eq!(status, Some(2), "{arguments:?}: {message}");
        assert!(message.contains(word), "{arguments:?}: {message}");
    }
    let watertight = ["--accuracy", "watertight", "--path", "raster", "--aov", "all"];
    let (status, message) = truecast(&[&watertight[..], &["-o", "eight.exr"]].concat());
    assert_eq!(status, Some(0), "{message}");
    let four = [&watertight[..], &["--subpixel-bits", "0", "-o", "none.exr"]].concat();
    assert_eq!(truecast(&four).0, Some(0));
    let films = ["eight.exr", "none.exr"]
        .map(|name| truecast::film::load_exr(&folder.path().join(name)).unwrap());
    let descriptions = films
        .each_ref()
        .map(|film| serde_json::from_str::<serde_json::Value>(&film.description).unwrap());
    assert_eq!(descriptions[0]["accuracy"], "watertight");
    assert_eq!(descriptions.map(|d| d["subpixel_bits"].as_u64()), [Some(8), Some(0)]);
    let plane = |film: usize, name: &str| films[film].plane(name).unwrap().clone();
    assert_ne!(plane(0, "id.prim"), plane(1, "id.prim"));
    assert!(films[0].plane("stable").is_some());
    // A depth buffer is in the description and shows its ties; without it nothing ties.
    let coarse = ["--depth-bits", "16", "--near", "1e-3", "-o", "coarse.exr"];
    assert_eq!(truecast(&[&watertight[..], &coarse].concat()).0, Some(0));
    let film = truecast::film::load_exr(&folder.path().join("coarse.exr")).unwrap();
    let description: serde_json::Value = serde_json::from_str(&film.description).unwrap();
    let expected = serde_json::json!({ "bits": 16, "near": 1e-3, "far": 1000.0 });
    assert_eq!(description["depth_buffer"], expected);
    assert_eq!(tied_pixels(&films[0]), 0);
    assert!(tied_pixels(&film) > 100, "{}", tied_pixels(&film));
}
