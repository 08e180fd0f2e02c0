//! H50–H65: rays and scenes that a traversal loses, and that a build does not survive.

use super::{Breadth, FULL, NARROW, agreed, agreed_within, assert_same, cover, ids};
use crate::support::closed::sphere;
use crate::support::golden;
use crate::support::rays::{Random, on_lattice};
use crate::support::scenes::{
    Triangle, pixel_grid, rectangle, scaled, scaled_camera, single_ray, standard_camera,
    standard_scene,
};
use std::path::Path;
use std::time::Instant;
use truecast::accel::{Accelerator, BuildPreset};
use truecast::cast::cast;
use truecast::mesh::TriangleId;
use truecast::pixel::Resolution;
use truecast::raster::rasterize;
use truecast::scene::camera::PinholeCamera;
use truecast::scene::{Overrides, Scene, SceneErrors};
use truecast::visibility::Counting;

/// Quads seen by one ray from (0, ¼, 0), with enough bystanders for a tree.
fn quads_and_ray(quads: &[[Triangle; 2]], direction: [f64; 3]) -> Scene {
    let mut triangles = quads.concat();
    for k in 0..40 {
        let away = 100.0 + 3.0 * k as f32;
        triangles.extend(rectangle([away; 2], [away + 1.0, away + 2.0], 70.0 + away));
    }
    Scene::from_triangles(single_ray([0.0, 0.25, 0.0], direction), &triangles)
}

/// A ray in the plane of a box's face. Four layouts: the quad to the left of the ray or to its
/// right, and +0 or −0 in the direction. x = 0 is the right edge of the left quad, which is
/// exclusive, and the left edge of the right quad, which is not. That the box is met in all four
/// is the accelerator's own test of the same number.
#[test]
fn h50_box_face_ray() {
    let left =
        [rectangle([-1.0, -1.0], [0.0, 1.0], 5.0), rectangle([-9.0, -1.0], [-8.0, 1.0], 50.0)];
    let right = [rectangle([0.0, -1.0], [1.0, 1.0], 5.0), rectangle([8.0, -1.0], [9.0, 1.0], 50.0)];
    for direction in [[0.0, 0.0, 1.0], [-0.0, 0.0, 1.0], [-0.0, -0.0, 1.0], [0.0, -0.0, 1.0]] {
        let none = agreed(&quads_and_ray(&left, direction));
        assert_eq!((none.visible[0], cover(&none, 0).crossed), (None, 0));
        let some = agreed(&quads_and_ray(&right, direction));
        let visible = some.visible[0].expect("the left edge is inclusive");
        assert_eq!((visible.tie, cover(&some, 0).crossed), (true, 1));
        assert!(visible.t_lo <= 5.0 && 5.0 <= visible.t_hi);
    }
}

const MICRO: f32 = 1e-6;

/// Two quads whose common edge passes 10⁻⁶ beside the ray, at depth 50.
fn quads_beside_the_axis() -> [[Triangle; 2]; 2] {
    [rectangle([-1.0, -1.0], [MICRO, 1.0], 50.0), rectangle([MICRO, -1.0], [1.0, 1.0], 50.0)]
}

#[test]
fn h51_clamped_reciprocal() {
    let buffer = agreed(&quads_and_ray(&quads_beside_the_axis(), [0.0, 0.0, 1.0]));
    assert!(ids(&buffer)[0].is_some_and(|id| id < 2), "the left quad");
}

#[test]
fn h52_clamped_reciprocal_of_a_tiny_component() {
    // The edge is at x = 10⁻⁶, the ray at 50·10⁻⁹ there; with 10⁻⁷ it is at 5·10⁻⁶, beyond it.
    for (x, is_left) in [(1e-9, true), (-1e-9, true), (1e-7, false)] {
        let direction = [on_lattice(x), 0.0, 1.0];
        let buffer = agreed(&quads_and_ray(&quads_beside_the_axis(), direction));
        assert_eq!(ids(&buffer)[0].map(|id| id < 2), Some(is_left), "x = {x:e}");
    }
}

/// The camera's own scale changes t and nothing else.
#[test]
fn h53_short_and_long_d() {
    for name in ["grid_exact", "interpenetrating_2^-20", "fan64"] {
        let mut scene = golden::scene(name).scene;
        let reference = agreed(&scene);
        // 2^-27 is the |d| = 10⁻⁸ and 2^20 the 10⁶ at which others render nothing.
        for k in [-290, -27, 20, 290] {
            let factor = 2.0_f64.powi(k);
            scene.camera = scaled_camera(8.0, factor);
            let buffer = agreed(&scene);
            assert_eq!(ids(&reference), ids(&buffer), "{name}, 2^{k}");
            assert_eq!(reference.cover, buffer.cover, "{name}, 2^{k}");
            for (a, b) in reference.visible.iter().flatten().zip(buffer.visible.iter().flatten()) {
                assert_eq!(a.barycentric, b.barycentric, "{name}, 2^{k}");
                assert_eq!((a.t_lo / factor, a.t_hi / factor), (b.t_lo, b.t_hi), "{name}, 2^{k}");
            }
        }
    }
}

/// 10³ quads, each in a plane x = k/2 of its own: boxes without thickness.
#[test]
fn h54_flat_boxes() {
    let quads: Vec<Triangle> = (0..1000)
        .flat_map(|k| {
            let x = k as f32 * 0.5;
            let corner = |y: f32, z: f32| [x, y, z];
            [
                [corner(-1.0, 4.0), corner(1.0, 4.0), corner(1.0, 6.0)],
                [corner(-1.0, 4.0), corner(1.0, 6.0), corner(-1.0, 6.0)],
            ]
        })
        .collect();
    // In the plane of quad 0: edge-on, never visible.
    let ahead = single_ray([0.0, 0.25, 0.0], [0.0, 0.0, 1.0]);
    let mut scene = Scene::from_triangles(ahead, &quads);
    assert_eq!(ids(&agreed(&scene)), [None]);
    // From 5 leans to its left, leaning to it: plane 0 is crossed at t = 5. The least lean that
    // the lattice of a camera of size 1 holds is 2^-52 or so; 2^-149 is not a direction.
    for lean in [2.0_f64.powi(-42), 2.0_f64.powi(-48)] {
        scene.camera = single_ray([-5.0 * lean, 0.25, 0.0], [lean, 0.0, 1.0]);
        let buffer = agreed(&scene);
        assert!(ids(&buffer)[0].is_some_and(|id| id < 2));
        assert_eq!(cover(&buffer, 0).crossed, 1);
        let visible = buffer.visible[0].unwrap();
        assert!(visible.t_lo <= 5.0 && 5.0 <= visible.t_hi);
    }
}

/// A scene of 10⁻⁵ is a scene, in powers of two and of ten.
#[test]
fn h55_small_scene() {
    let golden = golden::scene("grid_exact");
    let triangles = super::triangles_of(&golden.scene);
    assert_eq!(ids(&agreed(&standard_scene(&scaled(&triangles, 2.0_f32.powi(-17))))), golden.ids);
    let decimal = agreed(&standard_scene(&scaled(&triangles, 1e-5)));
    assert!(decimal.covered_pixels() > 200);
    super::assert_covered_once(&decimal);
}

/// Two triangles on either side of the segment x = `at[0]`, y = `at[1]`, z = −1…1, that meet the
/// ray nowhere else: one box ends in x and begins in y there, the other the other way round.
/// `lean` is the sign of d_x·d_y: the boxes lie in the quadrants that the ray does not visit.
fn leaves_of_an_edge(at: [f32; 2], lean: f32) -> [Triangle; 2] {
    let [x, y] = at;
    let (low, high) = ([x, y, -1.0], [x, y, 1.0]);
    [[low, high, [x - 1.0, y + lean, 0.25]], [high, low, [x + 1.0, y - lean, 0.25]]]
}

/// Rays exactly through an edge of two boxes: the computed near and far bounds cross by roundings
/// unless they are padded. Exactly one triangle owns the sample, so one of the boxes must be met.
#[test]
fn h56_two_ulp_padding() {
    let bystanders: Vec<Triangle> =
        (0..6).flat_map(|k| rectangle([50.0 + k as f32; 2], [60.0; 2], 40.0)).collect();
    let mut random = Random(56);
    let mut seen = 0;
    for number in 0..3000 {
        let eye = [0; 3].map(|_| random.step() - 0.5);
        let at = [0; 2].map(|_| (random.step() * 2.0 - 1.0) as f32);
        let to = [f64::from(at[0]) - eye[0], f64::from(at[1]) - eye[1]];
        if to.iter().any(|c| c.abs() < 0.01) {
            continue;
        }
        // An odd multiple, so that reciprocals are of all kinds; t at the edge is its inverse.
        let times = f64::from(2 * random.below(60) as u32 + 1);
        let rise = (random.step() - 0.5) * 0.25;
        let direction = [to[0] * times, to[1] * times, rise * times];
        let lean = if (to[0] < 0.0) == (to[1] < 0.0) { 1.0 } else { -1.0 };
        let mut triangles = leaves_of_an_edge(at, lean).to_vec();
        triangles.extend(&bystanders);
        let scene = Scene::from_triangles(single_ray(eye, direction), &triangles);
        let breadth = Breadth { presets: &[BuildPreset::Fastest], ..NARROW };
        let buffer = agreed_within(&scene, &breadth, &format!("ray {number}"));
        assert_eq!(cover(&buffer, 0).crossed, 1, "ray {number}");
        assert!(buffer.visible[0].unwrap().tie);
        seen += 1;
    }
    assert!(seen > 2500, "{seen} rays");
    // The measured slab that is lost with a padding of 2 ulp in f32: exactly t_near < t_far.
    // e and d as printed, with a triangle that reaches the ray between the two bounds only.
    let scaled = |digits: i32, power: i32| f64::from(digits) * 2.0_f64.powi(power);
    let eye = [scaled(-0x0016_a66c, -20), scaled(-0x0102_3876, -26), 0.0];
    let direction = [scaled(0x01fb_6b58, -24), scaled(0x0169_212e, -26), scaled(1, -10)];
    let (lo_x, hi_y) = (scaled(0x01af_ad2a, -34) as f32, scaled(0x01db_846c, -51) as f32);
    // In the box x ≥ lo_x, y ≤ hi_y, along the diagonal that the ray crosses in its corner.
    let slab = [[lo_x, hi_y, -1.0], [lo_x, hi_y, 1.0], [lo_x + 1.0, hi_y - 1.0, 0.0]];
    let mut triangles = vec![slab];
    triangles.extend(&bystanders);
    let buffer = agreed(&Scene::from_triangles(single_ray(eye, direction), &triangles));
    assert_eq!(ids(&buffer), [Some(0)]);
}

/// Rays from inside a sphere of 39 600 triangles at its vertices, through every kind of tree: no
/// hole, one crossing, the ids of the linear scan.
#[test]
fn h57_aimed_sphere() {
    let triangles = sphere(100, 200, 2.0, [0.0; 3]);
    let mut scene = Scene::from_triangles(standard_camera(8.0), &triangles);
    let window = Resolution::new(1, 1).unwrap().window();
    let trees = [BuildPreset::Fastest, BuildPreset::Medium]
        .map(|preset| Accelerator::build(&scene.mesh, preset));
    let linear = Accelerator::linear(&scene.mesh);
    let mut random = Random(57);
    for number in 0..30_000 {
        let target = triangles[(number * 7919) % triangles.len()][number % 3].map(f64::from);
        let eye: [f64; 3] = std::array::from_fn(|_| random.step() - 0.5);
        let direction = std::array::from_fn(|k| f64::from((target[k] - eye[k]) as f32));
        scene.camera = single_ray(eye, direction);
        let ask = |tree: &Accelerator| cast(&scene, tree, window, Counting::All, &|| ());
        let answers = [ask(&trees[0]), ask(&trees[1])];
        assert_eq!(cover(&answers[0], 0).signed, 1, "ray {number}");
        assert!(answers[0].visible[0].is_some(), "ray {number}");
        assert_eq!(answers[0].cover, answers[1].cover, "ray {number}");
        assert_same(&answers[0], &answers[1], "trees");
        if number % 300 == 0 {
            assert_same(&answers[0], &ask(&linear), "the linear scan");
            let raster = rasterize(&scene, window, Counting::All, &|| ());
            assert_eq!((ids(&raster), &raster.cover), (ids(&answers[0]), &answers[0].cover));
        }
    }
}

/// 10⁴ and 10⁶ copies of one triangle: one answer, one test per ray, no quadratic build.
#[test]
fn h58_identical_triangles() {
    let triangle = [[-4.0, -4.0, 8.0], [4.0, -4.0, 8.0], [-4.0, 4.0, 8.0]];
    for count in [10_000, 1_000_000] {
        let scene = standard_scene(&vec![triangle; count]);
        let window = scene.camera.resolution().window();
        let started = Instant::now();
        let accelerator = Accelerator::build(&scene.mesh, BuildPreset::Medium);
        // About 0.3 s on an idle machine; clustering them one by one would take hours.
        assert!(started.elapsed().as_secs_f64() < 10.0, "{:?}", started.elapsed());
        assert!(accelerator.depth() <= 64, "{}", accelerator.depth());
        let answers = [
            cast(&scene, &accelerator, window, Counting::All, &|| ()),
            rasterize(&scene, window, Counting::All, &|| ()),
        ];
        for buffer in &answers {
            assert_eq!(buffer.covered_pixels(), 36);
            for (index, visible) in buffer.visible.iter().enumerate() {
                let Some(visible) = visible else { continue };
                assert_eq!((visible.triangle.get(), visible.tie), (0, true));
                assert_eq!(cover(buffer, index).crossed as usize, count);
                assert_eq!(cover(buffer, index).signed.unsigned_abs() as usize, count);
            }
        }
        assert_eq!(answers[0].cover, answers[1].cover);
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

/// A scene over the text of a mesh file `bad.obj`, with its folder.
fn scene_of_obj(obj: &str, skip_bad: bool) -> Result<Scene, SceneErrors> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("bad.obj"), obj).unwrap();
    let text = "version = 1\n[image]\nwidth = 17\nheight = 17\n[camera]\neye = [0, 0, 5]\n\
        target = [0.2, 0.3, 0]\nup = [0, 1, 0]\nfov_y_deg = 45\n[[mesh]]\nfile = \"bad.obj\"\n\
        scale = 2\n";
    let overrides = Overrides { skip_bad, ..Overrides::default() };
    Scene::from_toml(text, Path::new("t.toml"), folder.path(), &overrides)
}

/// Coordinates that no triangle may have; the last three are numbers, but out of range.
const BAD_COORDINATES: [&str; 10] =
    ["nan", "NaN", "inf", "-inf", "infinity", "1e999", "-1e400", "1e39", "-1e300", "8e37"];

/// A vertex that is no number or out of range is a fault of its line, or of the face that uses it.
#[test]
fn h60_nan_vertex() {
    let obj = |corner: &str| format!("v 0 0 0\nv 1 0 0\nv {corner}\nv 0 1 0\nf 1 2 4\nf 1 2 3\n");
    assert!(scene_of_obj(&obj("0 1 0"), false).is_ok());
    for word in BAD_COORDINATES {
        for corner in [format!("{word} 1 0"), format!("0 {word} 0"), format!("0 1 {word}")] {
            let errors = scene_of_obj(&obj(&corner), false).expect_err(&corner).0;
            let place = &errors[0].place;
            assert!(place.file.ends_with("bad.obj"), "{corner}: {place}");
            let line = if word.parse::<f64>().unwrap().is_finite() { 6 } else { 3 };
            assert_eq!(place.line, line, "{corner}: {}", errors[0]);
        }
    }
}

/// With bad triangles skipped the others keep their picture, whatever the bad ones are, wherever
/// they stand, and whether they share corners with the good ones.
#[test]
fn h60_skipped_vertices_leave_the_others_as_they_are() {
    // Vertices 1 to 4 are bad or not; the faces 11, 13, 15 and 16 use them, the others do not.
    let obj = |bad: [&str; 3], with_bad: bool| {
        let [a, b, c] = bad;
        let face = |text: &'static str| if with_bad { text } else { "" };
        format!(
            "v {a} 0.5 0\nv 0.5 {b} 0\nv 0.25 0.25 {c}\nv 9 9 9\nv -1 -1 0\nv 1 -1 0\nv 1 1 0.5\n\
             v -1 1 0\nv 0 0 1\nf 5 6 9\n{}f 6 7 9\n{}f 7 8 9\n{}{}f 8 5 9\nf 5 6 7 8\n",
            face("f 1 5 6\n"),
            face("f 5 2 6 7\n"),
            face("f 3 3 3\n"),
            face("f 6 7 8 9 3\n"),
        )
    };
    let good = scene_of_obj(&obj(["1"; 3], false), false).unwrap();
    let reference = agreed(&good);
    assert!(reference.covered_pixels() > 100, "{}", reference.covered_pixels());
    for word in BAD_COORDINATES {
        let scene = scene_of_obj(&obj([word; 3], true), true).expect(word);
        let buffer = agreed(&scene);
        assert_same(&reference, &buffer, word);
        assert_eq!(reference.cover, buffer.cover, "{word}");
        assert_eq!(scene.mesh.len(), good.mesh.len(), "{word}");
        assert!(scene.mesh.positions.iter().flatten().all(|c| c.abs() < 100.0), "{word}");
        // The warning counts the faces and names the first; what remains still knows its lines.
        let [warning] = scene.warnings.as_slice() else { panic!("{word}: {:?}", scene.warnings) };
        let sentence = "is left out (4 times; this is the first)";
        assert!(
            warning.contains("bad.obj:11: a face ") && warning.ends_with(sentence),
            "{warning}"
        );
        let line = |id: u32| scene.describe_source(TriangleId::new(id));
        assert!(line(0).ends_with("bad.obj:10") && line(1).ends_with("bad.obj:12"), "{}", line(1));
    }
    // A position that no face uses is no fault; a mesh of nothing but bad faces is one.
    assert!(scene_of_obj("v nan 0 0\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 2 3 4\n", true).is_ok());
    let errors = scene_of_obj("v nan 0 0\nv 0 0 0\nv 1 0 0\nf 1 2 3\n", true).unwrap_err();
    assert!(errors.to_string().contains("no faces with finite corners"), "{errors}");
    // What is no number at all is a fault as before, and so is a normal that is not finite.
    assert!(scene_of_obj("v x 0 0\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 2 3 4\n", true).is_err());
    assert!(scene_of_obj("vn nan 0 0\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", true).is_err());
}

/// Every magnitude up to the largest position, 2^126, is built and seen; beyond it is a fault.
#[test]
fn h61_1e19_to_3e38() {
    for scale in [1e18, 1e19, 1e25, 1e30, 1e37, 2.0_f32.powi(122)] {
        let triangles: Vec<Triangle> = pixel_grid(17, 4, 8.0);
        let buffer = agreed(&standard_scene(&scaled(&triangles, scale)));
        assert!(buffer.covered_pixels() > 200, "{scale:e}");
        super::assert_covered_once(&buffer);
    }
    let scene = |corner: &str| {
        let folder = tempfile::tempdir().unwrap();
        let obj = format!("v 0 0 0\nv 1 0 0\nv 0 {corner} 0\nf 1 2 3\n");
        std::fs::write(folder.path().join("big.obj"), obj).unwrap();
        let text = "version = 1\n[image]\nwidth = 2\nheight = 2\n[camera]\neye = [0, 0, 5]\n\
            target = [0, 0, 0]\nup = [0, 1, 0]\nfov_y_deg = 45\n[[mesh]]\nfile = \"big.obj\"\n";
        Scene::from_toml(text, Path::new("t.toml"), folder.path(), &Overrides::default())
    };
    assert!(scene("85070591730234615865843651857942052864").is_ok(), "2^126");
    for beyond in ["8.51e37", "1e38", "3.4028235e38", "3e38", "-3e38", "1e39", "1e300"] {
        let errors = scene(beyond).expect_err(beyond).0;
        assert!(errors[0].to_string().contains("big.obj:"), "{beyond}: {}", errors[0]);
    }
}

/// A box from a vertex and rounded edges would begin at x = 0 or at 8: the ray at x = 1…2 tells.
#[test]
fn h62_box_from_edges() {
    let triangles = [
        [[1e8, 0.0, 8.0], [1.0, 0.0, 8.0], [1e8, 1e8, 8.0]],
        [[1e8, -1e8, 8.0], [1.0, 0.0, 8.0], [1e8, 0.0, 8.0]],
        [[-1e8, -1e8, 9.0], [-1e7, -1e8, 9.0], [-1e8, -1e7, 9.0]],
    ];
    let buffer = agreed(&standard_scene(&triangles));
    // From the corner (1, 0) on, every column to the right is covered between the diagonals.
    let row = &ids(&buffer)[8 * 17..9 * 17];
    assert!(row[..9].iter().all(Option::is_none));
    assert!(row[10..].iter().all(|id| *id == Some(0)), "{row:?}");
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
            tile_sides: &[32],
            audited_pixels: if shuffle == 0 { 289 } else { 2 },
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
        audited_pixels: 100,
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
