//! Another program's ids and depths: our own answers, damaged on purpose, and what the audit makes of
//! them.

mod command;
mod files;

use crate::support::scenes::{Triangle, grid_camera, pixel_grid};
use truecast::check::foreign::diagnosis::Layout;
use truecast::check::foreign::{
    Class, Convention, DepthKind, DepthPlane, Foreign, ForeignOptions, ForeignOutcome,
    ForeignReport, IdPlane, audit_foreign,
};
use truecast::mesh::TriangleId;
use truecast::pixel::Pixel;
use truecast::render::{Unwatched, VisibilityPath, see};
use truecast::scene::Scene;
use truecast::scene::camera::PinholeCamera;
use truecast::visibility::{Counting, VisibilityBuffer};

const NOTHING: i64 = u32::MAX as i64;
const SIDE: u32 = 65;

/// A sheet of 12 × 12 crooked cells before the middle of the frame, vertices on no sample.
fn sheet() -> Vec<Triangle> {
    let corner = |i: i32, j: i32| {
        let wobble = |k: i32| ((i * 37 + j * 91 + k * 53) % 17) as f32 / 40.0;
        let [x, y] = [i, j].map(|c| (c - 6) as f32 * 4.13);
        [x + wobble(1), y + wobble(2), 64.0 + 3.0 * wobble(3) + 0.1 * x]
    };
    (0..144)
        .flat_map(|cell| {
            let (i, j) = (cell % 12, cell / 12);
            let [a, b] = [corner(i, j), corner(i + 1, j)];
            let [c, d] = [corner(i, j + 1), corner(i + 1, j + 1)];
            [[a, b, c], [b, d, c]]
        })
        .collect()
}

fn scene() -> Scene {
    Scene::from_triangles(grid_camera(SIDE, 64.0), &sheet())
}

/// Cells whose vertices lie on samples, one triangle twice: full of ties.
fn tied_scene() -> Scene {
    let mut triangles = pixel_grid(33, 4, 16.0);
    triangles.truncate(40);
    triangles.push(triangles[20]);
    Scene::from_triangles(grid_camera(33, 16.0), &triangles)
}

fn answer(scene: &Scene) -> VisibilityBuffer {
    let window = scene.camera.resolution().window();
    let path = VisibilityPath::Raster;
    see(scene, path, Default::default(), window, Counting::Nearest, &Unwatched).buffer
}

fn words(buffer: &VisibilityBuffer) -> Vec<i64> {
    let word = |id: TriangleId| i64::from(id.get());
    buffer.visible.iter().map(|v| v.as_ref().map_or(NOTHING, |v| word(v.triangle))).collect()
}

fn audit_with(scene: &Scene, words: Vec<i64>, convention: Convention) -> ForeignReport {
    let foreign = Foreign {
        window: scene.camera.resolution().window(),
        ids: Some(IdPlane { words, may_be_rounded: false }),
        depth: None,
    };
    let options = ForeignOptions { convention, ..ForeignOptions::default() };
    audit_foreign(scene, &foreign, &options, &Unwatched)
}

fn audit(scene: &Scene, words: Vec<i64>) -> ForeignReport {
    audit_with(scene, words, Convention::default())
}

/// The scene seen with its samples moved by (x, y) pixels.
fn shifted(scene: &Scene, x: f64, y: f64) -> Scene {
    let camera = &scene.camera;
    let d0 = [0, 1, 2].map(|k| camera.d0()[k] + x * camera.dx()[k] + y * camera.dy()[k]);
    let mut moved = scene.clone();
    moved.camera =
        PinholeCamera::exact(camera.resolution(), camera.eye(), d0, camera.dx(), camera.dy())
            .unwrap();
    moved
}

#[test]
fn a_copy_agrees_everywhere() {
    for scene in [scene(), tied_scene()] {
        let report = audit(&scene, words(&answer(&scene)));
        assert_eq!(report.outcome(), ForeignOutcome::Agreement);
        assert_eq!(report.count(Class::Agree), report.window.len());
        assert!(report.diagnosis.is_none());
    }
}

#[test]
fn wrong_missing_extra_and_unknown_ids_are_told_apart() {
    let scene = scene();
    let right = words(&answer(&scene));
    let at = |x: u32, y: u32| (y * SIDE + x) as usize;
    let mut damaged = right.clone();
    assert!(right[at(32, 32)] != NOTHING && right[at(30, 20)] != NOTHING);
    assert!(right[at(40, 30)] != NOTHING && right[at(0, 0)] == NOTHING);
    damaged[at(32, 32)] = 0;
    damaged[at(30, 20)] = NOTHING;
    damaged[at(40, 30)] = 288;
    damaged[at(0, 0)] = 5;
    let report = audit(&scene, damaged);
    let found: Vec<_> = report.findings.iter().map(|f| (f.class, f.pixel)).collect();
    let pixel = |x, y| Pixel { x, y };
    assert_eq!(
        found,
        [
            (Class::Wrong, pixel(32, 32)),
            (Class::Wrong, pixel(40, 30)),
            (Class::Missing, pixel(30, 20)),
            (Class::Extra, pixel(0, 0)),
        ]
    );
    assert_eq!(report.outcome(), ForeignOutcome::Errors);
}

#[test]
fn answers_of_other_tie_rules_are_allowed() {
    let scene = tied_scene();
    let right = answer(&scene);
    // The rule (−ε, −ε²): samples moved up and left by next to nothing (all edges lie at multiples
    // of 1, the nearest other at more than 2^-20).
    let other = words(&answer(&shifted(&scene, -(2.0_f64.powi(-20)), -(2.0_f64.powi(-21)))));
    let differing = other.iter().zip(words(&right)).filter(|(a, b)| **a != *b).count();
    assert!(differing > 40, "the scene has ties: {differing}");
    let report = audit(&scene, other);
    assert_eq!(report.count(Class::AllowedTie), differing);
    assert_eq!(report.outcome(), ForeignOutcome::Agreement);
    // The other of two equal triangles.
    let twin = i64::from(scene.mesh.len() as u32 - 1);
    let twins: Vec<i64> =
        words(&right).iter().map(|&word| if word == 20 { twin } else { word }).collect();
    let report = audit(&scene, twins);
    assert!(report.count(Class::AllowedTie) > 0);
    assert_eq!(report.count(Class::AllowedTie) + report.count(Class::Agree), report.window.len());
}

#[test]
fn a_crack_on_an_inner_edge_is_no_tie() {
    let scene = tied_scene();
    let right = answer(&scene);
    let window = right.window;
    let nothing = |x: u32, y: u32| right.at(Pixel { x, y }).is_none();
    let mut cracked = words(&right);
    let mut expected = [0, 0];
    for pixel in window.pixels() {
        let index = window.index(pixel);
        let Pixel { x, y } = pixel;
        if right.visible[index].is_some_and(|visible| visible.tie) {
            cracked[index] = NOTHING;
            let inner = (1..SIDE / 2).contains(&x)
                && (1..32).contains(&y)
                && (x - 1..=x + 1).all(|x| (y - 1..=y + 1).all(|y| !nothing(x, y)));
            expected[usize::from(inner)] += 1;
        }
    }
    let report = audit(&scene, cracked);
    assert!(expected[0] > 0 && expected[1] > 0, "both kinds occur: {expected:?}");
    // On the rim of the mesh nothing may be seen, inside it must not.
    assert!(report.count(Class::Missing) >= expected[1]);
    assert!(report.count(Class::AllowedTie) > 0);
    for finding in report.findings.iter().filter(|f| f.class == Class::AllowedTie) {
        let Pixel { x, y } = finding.pixel;
        let at_frame = x == 0 || y == 0 || x == 32 || y == 32;
        let beside = |dx: u32, dy: u32| nothing(x + dx - 1, y + dy - 1);
        let at_rim = at_frame || (0..3).any(|dx| (0..3).any(|dy| beside(dx, dy)));
        assert!(at_rim, "({x}, {y}) is inside the mesh");
    }
}

#[test]
fn a_vertex_moved_by_one_step_is_unstable_not_wrong() {
    let scene = scene();
    let mut moved = scene.clone();
    for position in &mut moved.mesh.positions {
        *position = position.map(f32::next_up);
    }
    // One ulp here is 2^-18 px at most and may change no pixel at all; a move by 1/512 px does.
    let report = audit(&scene, words(&answer(&moved)));
    assert_eq!(report.outcome(), ForeignOutcome::Agreement);
    let report = audit(&scene, words(&answer(&shifted(&scene, 1.0 / 256.0, -1.0 / 256.0))));
    assert!(report.count(Class::Unstable) > 0);
    assert_eq!(report.outcome(), ForeignOutcome::Agreement);
    let report = audit(&scene, words(&answer(&shifted(&scene, 3.0 / 256.0, 3.0 / 256.0))));
    assert_eq!(report.outcome(), ForeignOutcome::Errors, "thrice as far is too far");
}

#[test]
fn a_twin_seen_beside_the_centre_is_unstable_too() {
    // Every triangle twice: the twins with the higher ids are never visible, and never wrong.
    let scene = Scene::from_triangles(grid_camera(SIDE, 64.0), &[sheet(), sheet()].concat());
    let moved = words(&answer(&shifted(&scene, 1.0 / 256.0, -1.0 / 256.0)));
    let twins = moved.iter().map(|&word| if word == NOTHING { word } else { word + 288 });
    let report = audit(&scene, twins.collect());
    assert!(report.count(Class::Unstable) > 0 && report.count(Class::AllowedTie) > 1000);
    assert_eq!(report.outcome(), ForeignOutcome::Agreement);
}

#[test]
fn a_sliver_inside_the_box_is_found() {
    // Two halves of a square with a sliver of width 1/1024 px between them, near the middle sample
    // but on none of the points that the rim of the box holds.
    let [left, right] = [1.0 / 1024.0, 2.0 / 1024.0];
    let quad = |x0: f32, x1: f32| {
        [
            [[x0, -4.0, 8.0], [x1, -4.0, 8.0], [x0, 4.0, 8.0]],
            [[x1, -4.0, 8.0], [x1, 4.0, 8.0], [x0, 4.0, 8.0]],
        ]
    };
    let triangles: Vec<Triangle> = [quad(-4.0, left), quad(left, right), quad(right, 4.0)].concat();
    let scene = Scene::from_triangles(grid_camera(17, 8.0), &triangles);
    let mut theirs = words(&answer(&scene));
    let middle = 8 * 17 + 8;
    assert!(theirs[middle] < 2);
    theirs[middle] = if theirs[middle - 17] == 0 { 3 } else { 2 };
    let report = audit(&scene, theirs.clone());
    theirs[middle] = 5 - theirs[middle];
    let other = audit(&scene, theirs);
    let unstable = report.count(Class::Unstable) + other.count(Class::Unstable);
    assert!(unstable > 0, "at least one half of the sliver reaches into the box");
}

/// The diagnosis of damaged ids: its layout, base, background, and whether the sentence says so.
fn assert_diagnosed(theirs: Vec<i64>, layout: Layout, convention: Convention, words: &[&str]) {
    let report = audit(&scene(), theirs);
    assert_eq!(report.outcome(), ForeignOutcome::Errors, "a diagnosis accepts nothing");
    let diagnosis = report.diagnosis.expect("diagnosed");
    assert_eq!(diagnosis.layout, layout, "{}", diagnosis.sentence);
    assert_eq!(diagnosis.numbering.convention, convention, "{}", diagnosis.sentence);
    for word in words {
        assert!(diagnosis.sentence.contains(word), "no {word} in {}", diagnosis.sentence);
    }
    assert!(diagnosis.remaining * 10 <= diagnosis.differing);
}

#[test]
fn conventions_are_named() {
    let scene = scene();
    let right = words(&answer(&scene));
    let as_is = Convention::default();
    let side = SIDE as usize;
    let renamed = |from: i64, to: i64| -> Vec<i64> {
        right.iter().map(|&word| if word == from { to } else { word }).collect()
    };
    // Numbering.
    let plus_one: Vec<i64> =
        right.iter().map(|&word| if word == NOTHING { 0 } else { word + 1 }).collect();
    let base_1 = Convention { base: 1, background: None };
    assert_diagnosed(plus_one.clone(), Layout::Same, base_1, &["plus 1", "--id-base 1"]);
    let report = audit_with(&scene, plus_one, base_1);
    assert_eq!(report.count(Class::Agree), report.window.len());
    for (mark, name) in [(0, "0"), (-1, "-1"), ((1 << 24) - 1, "16777215"), (i64::MIN, "nan")] {
        let convention = Convention { base: 0, background: Some(mark) };
        let option = format!("--background {name}");
        assert_diagnosed(renamed(NOTHING, mark), Layout::Same, convention, &[&option]);
    }
    // Layout.
    let flip_y: Vec<i64> = right.chunks(side).rev().flatten().copied().collect();
    assert_diagnosed(flip_y, Layout::FlippedRows, as_is, &["--flip-y"]);
    let flip_x: Vec<i64> = right.chunks(side).flat_map(|row| row.iter().rev()).copied().collect();
    assert_diagnosed(flip_x, Layout::FlippedColumns, as_is, &["mirror"]);
    let transposed: Vec<i64> =
        (0..side * side).map(|i| right[(i % side) * side + i / side]).collect();
    assert_diagnosed(transposed, Layout::Transposed, as_is, &["transpose"]);
    for [x, y] in [[1, 1], [-1, 0], [0, 2], [4, -3]] {
        let moved = shifted(&scene, 0.5 * f64::from(x), 0.5 * f64::from(y));
        let named = format!("({}, {})", 0.5 * f64::from(x), 0.5 * f64::from(y));
        let theirs = words(&answer(&moved));
        assert_diagnosed(theirs, Layout::Shifted([x, y]), as_is, &[&named, "px"]);
    }
}

#[test]
fn ids_counted_per_mesh_are_named() {
    let mut scene = scene();
    let mut second = scene.objects[0].clone();
    scene.objects[0].triangles.end = 100;
    second.triangles.start = 100;
    second.name = "second".to_owned();
    scene.objects.push(second);
    let right = words(&answer(&scene));
    let local = |word: &i64| if (100..288).contains(word) { word - 100 } else { *word };
    let report = audit(&scene, right.iter().map(local).collect());
    let diagnosis = report.diagnosis.expect("diagnosed");
    assert_eq!(diagnosis.numbering.mesh_offsets, [0, -100]);
    assert!(diagnosis.sentence.contains("mesh 2 (second)"), "{}", diagnosis.sentence);
}

#[test]
fn scrambled_ids_have_no_diagnosis() {
    let scene = scene();
    let right = words(&answer(&scene));
    let scrambled: Vec<i64> =
        right.iter().map(|&word| if word == NOTHING { word } else { (word * 89) % 288 }).collect();
    let report = audit(&scene, scrambled);
    assert_eq!(report.outcome(), ForeignOutcome::Errors);
    assert!(report.diagnosis.is_none(), "{:?}", report.diagnosis);
}

#[test]
fn nothing_on_both_sides_is_not_a_pass() {
    let behind = [[-1.0, -1.0, -8.0], [1.0, -1.0, -8.0], [0.0, 1.0, -8.0]];
    let scene = Scene::from_triangles(grid_camera(17, 8.0), &[behind]);
    let report = audit(&scene, vec![NOTHING; 289]);
    assert_eq!(report.outcome(), ForeignOutcome::NothingToCheck);
    let report = audit(&scene, vec![0; 289]);
    assert_eq!((report.outcome(), report.count(Class::Extra)), (ForeignOutcome::Errors, 289));
}

#[test]
fn depths_are_held_against_the_exact_ones() {
    let scene = scene();
    let buffer = answer(&scene);
    for (kind, per_t) in [(DepthKind::Z, scene.camera.z_per_t()), (DepthKind::RayParameter, 1.0)] {
        let audit = |factor: f64, with_ids: bool| {
            let depth = |v: &truecast::visibility::Visible| f64::from((v.t() * per_t) as f32);
            let values: Vec<f64> = buffer
                .visible
                .iter()
                .map(|v| v.as_ref().map_or(f64::INFINITY, |v| depth(v) * factor))
                .collect();
            let ids = IdPlane { words: words(&buffer), may_be_rounded: false };
            let foreign = Foreign {
                window: buffer.window,
                ids: with_ids.then_some(ids),
                depth: Some(DepthPlane { kind, values }),
            };
            audit_foreign(&scene, &foreign, &ForeignOptions::default(), &Unwatched)
        };
        for with_ids in [true, false] {
            assert_eq!(audit(1.0, with_ids).outcome(), ForeignOutcome::Agreement);
            assert_eq!(audit(1.0 + 1e-7, with_ids).findings, [], "within 2^-20");
            let report = audit(1.0 + 1e-3, with_ids);
            assert_eq!(report.count(Class::DepthOff), buffer.covered_pixels());
            let worst = report.findings[0].depth.unwrap();
            assert!((worst.relative - 1e-3).abs() < 1e-6);
            // A millionth is just above the tolerance; steep places may have it within the box.
            let report = audit(1.0 + 1e-6, with_ids);
            let seen = report.count(Class::DepthOff) + report.count(Class::Unstable);
            assert!(seen > buffer.covered_pixels() / 2);
        }
    }
}
