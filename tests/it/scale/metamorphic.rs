//! H80–H89: changes of the scene or of the way of asking that must not change the answer, or must
//! change it in a known way. No reference answer is needed.

use super::{Breadth, FULL, NARROW, agreed, agreed_within, assert_same, cover, ids, triangles_of};
use crate::support::closed::{integer_chaos, sphere};
use crate::support::golden;
use crate::support::rays::{Random, closed_box, torus};
use crate::support::scenes::{
    Triangle, fan, grid_camera, pixel_grid, rectangle, standard_camera, standard_scene,
};
use std::collections::HashMap;
use truecast::accel::{Accelerator, BuildPreset};
use truecast::cast::{cast, cast_with_tiles};
use truecast::check::{self, Answered, Blame, CheckOptions, Outcome};
use truecast::pixel::{Pixel, Resolution, Window};
use truecast::raster::{rasterize, rasterize_in_tiles};
use truecast::render::Unwatched;
use truecast::scene::Scene;
use truecast::scene::camera::PinholeCamera;
use truecast::shade::{Effects, shade};
use truecast::visibility::{Counting, Facing, Layers, VisibilityBuffer, Visible};

/// Scenes full of ties, in front of G(8) with the eye at the origin: name and triangles.
pub(super) fn scenes_with_ties() -> Vec<(String, Vec<Triangle>)> {
    let mut scenes: Vec<(String, Vec<Triangle>)> =
        ["grid_exact", "interpenetrating_2^-20", "box_inside", "tiny_in_front_of_huge"]
            .map(|name| (name.to_owned(), triangles_of(&golden::scene(name).scene)))
            .to_vec();
    scenes.push(("needles".to_owned(), fan(64)));
    for seed in 0..8 {
        let away = integer_chaos(seed).iter().map(|t| t.map(|[x, y, z]| [x, y, z + 5.0])).collect();
        scenes.push((format!("chaos {seed}"), away));
    }
    scenes
}

/// A visible triangle without its number.
fn place(visible: &Visible) -> ([u64; 2], bool) {
    ([visible.t_lo.to_bits(), visible.t_hi.to_bits()], visible.tie)
}

/// No two triangles of the scene lie in one plane seen from the origin, so the order in the file
/// does not decide.
fn has_no_shared_planes(triangles: &[Triangle]) -> bool {
    let buffer = agreed_within(&standard_scene(triangles), &NARROW, "planes");
    let mut reversed = triangles.to_vec();
    reversed.reverse();
    let other = agreed_within(&standard_scene(&reversed), &NARROW, "planes");
    let last = triangles.len() as u32 - 1;
    ids(&buffer).iter().zip(ids(&other)).all(|(a, b)| *a == b.map(|id| last - id))
}

/// The order of triangles, the order of corners and the sharing of vertices.
#[test]
fn h80_order_and_welding() {
    let mut random = Random(80);
    let mut without_shared_planes = 0;
    for (name, triangles) in scenes_with_ties() {
        let scene = standard_scene(&triangles);
        let reference = agreed(&scene);
        // Corners: cyclic orders keep everything, a swap turns the facing.
        for turn in 1..3 {
            let turned: Vec<Triangle> =
                triangles.iter().map(|t| [t[turn], t[(turn + 1) % 3], t[(turn + 2) % 3]]).collect();
            let buffer = agreed_within(&standard_scene(&turned), &NARROW, &name);
            assert_eq!(ids(&reference), ids(&buffer), "{name}");
            assert_eq!(reference.cover, buffer.cover, "{name}");
            for (a, b) in reference.visible.iter().flatten().zip(buffer.visible.iter().flatten()) {
                assert_eq!((a.facing, a.tie), (b.facing, b.tie), "{name}");
            }
        }
        let swapped: Vec<Triangle> = triangles.iter().map(|&[a, b, c]| [a, c, b]).collect();
        let buffer = agreed_within(&standard_scene(&swapped), &NARROW, &name);
        assert_eq!(ids(&reference), ids(&buffer), "{name}");
        for (a, b) in reference.visible.iter().flatten().zip(buffer.visible.iter().flatten()) {
            assert_eq!((a.facing.sign(), a.tie), (-b.facing.sign(), b.tie), "{name}");
        }
        // Welding: the same positions by fewer numbers.
        let mut welded = scene.clone();
        let mut numbers: HashMap<[u32; 3], u32> = HashMap::new();
        let mut positions = Vec::new();
        for corner in welded.mesh.corners.iter_mut().flatten() {
            let position = scene.mesh.positions[*corner as usize];
            *corner = *numbers.entry(position.map(f32::to_bits)).or_insert_with(|| {
                positions.push(position);
                positions.len() as u32 - 1
            });
        }
        welded.mesh.positions = positions;
        assert_same(&reference, &agreed_within(&welded, &NARROW, &name), &name);
        // Triangles: counts and depths stay, and so do the triangles where no plane is shared.
        let exact_ids = has_no_shared_planes(&triangles);
        without_shared_planes += usize::from(exact_ids);
        let mut order: Vec<usize> = (0..triangles.len()).collect();
        for _ in 0..4 {
            random.shuffle(&mut order);
            let shuffled: Vec<Triangle> = order.iter().map(|&k| triangles[k]).collect();
            let buffer = agreed_within(&standard_scene(&shuffled), &NARROW, &name);
            assert_eq!(reference.cover, buffer.cover, "{name}");
            for (a, b) in reference.visible.iter().zip(&buffer.visible) {
                assert_eq!(a.is_some(), b.is_some(), "{name}");
                let (Some(a), Some(b)) = (a, b) else { continue };
                if exact_ids {
                    assert_eq!(a.triangle.index(), order[b.triangle.index()], "{name}");
                    assert_eq!((place(a), a.barycentric), (place(b), b.barycentric), "{name}");
                } else {
                    assert!(a.t_lo <= b.t_hi && b.t_lo <= a.t_hi, "{name}: {a:?} {b:?}");
                }
            }
        }
    }
    assert!(without_shared_planes >= 4, "{without_shared_planes}");
}

/// Each triangle cut into four at the exact midpoints of its edges: the same picture.
#[test]
fn h81_subdivision() {
    for (name, triangles) in scenes_with_ties() {
        let middle = |a: [f32; 3], b: [f32; 3]| std::array::from_fn(|k| (a[k] + b[k]) * 0.5);
        let is_exact = triangles.iter().all(|t| {
            (0..3).all(|i| {
                let (a, b) = (t[i], t[(i + 1) % 3]);
                (0..3).all(|k| {
                    f64::from((a[k] + b[k]) * 0.5) == (f64::from(a[k]) + f64::from(b[k])) * 0.5
                })
            })
        });
        if !is_exact {
            continue;
        }
        let quartered: Vec<Triangle> = triangles
            .iter()
            .flat_map(|&[a, b, c]| {
                let [p, q, r] = [middle(a, b), middle(b, c), middle(c, a)];
                [[a, p, r], [p, b, q], [r, q, c], [p, q, r]]
            })
            .collect();
        let whole = agreed(&standard_scene(&triangles));
        let parts = agreed(&standard_scene(&quartered));
        assert_eq!(whole.cover, parts.cover, "{name}");
        for (a, b) in whole.visible.iter().zip(&parts.visible) {
            assert_eq!(a.is_some(), b.is_some(), "{name}");
            let (Some(a), Some(b)) = (a, b) else { continue };
            assert_eq!(a.triangle.get(), b.triangle.get() / 4, "{name}");
            assert_eq!(a.facing, b.facing, "{name}");
            assert!(b.tie || !a.tie, "{name}: cutting adds edges, it takes none away");
            assert!(a.t_lo <= b.t_hi && b.t_lo <= a.t_hi, "{name}: {a:?} {b:?}");
        }
    }
}

/// `buffer` is `reference` with its pixels moved, but for samples on which a tie rule that knows
/// right and down decides. Facing is multiplied by `turn`. Returns how many differ.
#[track_caller]
fn assert_moved(
    reference: &VisibilityBuffer,
    buffer: &VisibilityBuffer,
    from: impl Fn(Pixel) -> Pixel,
    turn: i8,
    name: &str,
) -> usize {
    let mut differing = 0;
    for pixel in buffer.window.pixels() {
        let (a, b) = (reference.at(from(pixel)), buffer.at(pixel));
        let key = |v: Option<&Visible>, turn: i8| v.map(|v| (v.triangle, v.facing.sign() * turn));
        if key(a, turn) != key(b, 1) {
            differing += 1;
            assert!(a.is_some_and(|v| v.tie) || b.is_some_and(|v| v.tie), "{name} at {pixel:?}");
        } else if let (Some(a), Some(b)) = (a, b) {
            assert!(a.t_lo <= b.t_hi && b.t_lo <= a.t_hi, "{name} at {pixel:?}");
        }
    }
    differing
}

/// The scene turned by 90° about the view axis, by exact exchange of coordinates.
#[test]
fn h82_quarter_turns() {
    let mut differing = 0;
    for (name, triangles) in scenes_with_ties() {
        let reference = agreed_within(&standard_scene(&triangles), &NARROW, &name);
        let mut turned = triangles;
        for turn in 1..4 {
            turned = turned.iter().map(|t| t.map(|[x, y, z]| [-y, x, z])).collect();
            let buffer = agreed_within(&standard_scene(&turned), &NARROW, &name);
            // (x, y) → (−y, x) each time: where it came from, by as many turns back.
            let back = |mut pixel: Pixel| {
                for _ in 0..turn {
                    pixel = Pixel { x: pixel.y, y: 16 - pixel.x };
                }
                pixel
            };
            differing += assert_moved(&reference, &buffer, back, 1, &name);
        }
    }
    assert!(differing > 50, "ties are in the scenes: {differing}");
    // Away from ties nothing may differ: the same scenes a quarter of a pixel aside.
    for (name, triangles) in scenes_with_ties() {
        let buffer = agreed_within(&aside(&triangles), &NARROW, &name);
        let turned: Vec<Triangle> =
            triangles.iter().map(|t| t.map(|[x, y, z]| [-y, x, z])).collect();
        let frame = Resolution::new(16, 16).unwrap();
        // The frame of `aside` turned with its scene: columns go where rows went.
        let camera = PinholeCamera::exact(
            frame,
            [0.0; 3],
            [8.1875, -8.3125, 8.0],
            [0.0, 1.0, 0.0],
            [-1.0, 0.0, 0.0],
        )
        .unwrap();
        let other = agreed_within(&Scene::from_triangles(camera, &turned), &NARROW, &name);
        // The tie rule turns with the frame, so here not even ties may differ.
        assert_eq!(ids(&buffer), ids(&other), "{name}");
        assert_eq!(buffer.cover, other.cover, "{name}");
    }
}

/// The scene seen on samples 5/16 and 3/16 of a pixel beside the grid of its vertices.
fn aside(triangles: &[Triangle]) -> Scene {
    let frame = Resolution::new(16, 16).unwrap();
    let d0 = [-8.3125, -8.1875, 8.0];
    let camera =
        PinholeCamera::exact(frame, [0.0; 3], d0, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]).unwrap();
    Scene::from_triangles(camera, triangles)
}

/// The scene mirrored in x, in y, and in both.
#[test]
fn h83_mirror() {
    let mut differing = 0;
    for (name, triangles) in scenes_with_ties() {
        let reference = agreed_within(&standard_scene(&triangles), &NARROW, &name);
        for (mx, my) in [(true, false), (false, true), (true, true)] {
            let flip = |c: f32, flips: bool| if flips { -c } else { c };
            let mirrored: Vec<Triangle> = triangles
                .iter()
                .map(|t| t.map(|[x, y, z]| [flip(x, mx), flip(y, my), z]))
                .collect();
            let buffer = agreed_within(&standard_scene(&mirrored), &NARROW, &name);
            let from = |pixel: Pixel| Pixel {
                x: if mx { 16 - pixel.x } else { pixel.x },
                y: if my { 16 - pixel.y } else { pixel.y },
            };
            let turn = if mx == my { 1 } else { -1 };
            differing += assert_moved(&reference, &buffer, from, turn, &name);
        }
        // In depth: seen by a camera that looks the other way.
        let behind: Vec<Triangle> =
            triangles.iter().map(|t| t.map(|[x, y, z]| [x, y, -z])).collect();
        let base = standard_camera(-8.0);
        let buffer = agreed_within(&Scene::from_triangles(base, &behind), &NARROW, &name);
        assert_eq!(assert_moved(&reference, &buffer, |pixel| pixel, -1, &name), 0, "{name}");
    }
    assert!(differing > 50, "ties are in the scenes: {differing}");
}

/// Tile sides, threads and build presets, on a frame of many tiles. (Both paths are scalar or
/// choose no instruction set by a switch, so there is no SIMD width to vary.)
#[test]
fn h84_settings() {
    let mut triangles = pixel_grid(101, 4, 8.0);
    triangles.extend(sphere(24, 48, 30.0, [0.0, 0.0, 40.0]).iter().map(|t| {
        // Seen in front of and through the grid.
        t.map(|v| v.map(|c| c * 0.2))
    }));
    let scene = Scene::from_triangles(grid_camera(101, 8.0), &triangles);
    let breadth = Breadth { tile_sides: &[1, 2, 3, 8, 16, 31, 32, 33, 64, 200], ..FULL };
    let breadth = Breadth { audited_pixels: 300, ..breadth };
    let buffer = agreed_within(&scene, &breadth, "grid and sphere");
    assert_eq!(buffer.covered_pixels(), 100 * 100);
    assert!(buffer.visible.iter().flatten().filter(|v| v.tie).count() > 2000);
}

/// Every crop is the part of its frame, by both paths and at odd tile sizes.
#[test]
fn h85_crops() {
    for (name, triangles) in scenes_with_ties() {
        let scene = standard_scene(&triangles);
        let whole = agreed_within(&scene, &NARROW, &name);
        let raster = rasterize(&scene, whole.window, Counting::All, &|| ());
        let tree = Accelerator::build(&scene.mesh, BuildPreset::Fast);
        let frame = scene.camera.resolution();
        for [x0, y0, x1, y1] in
            [[3, 5, 14, 11], [0, 0, 1, 1], [16, 16, 17, 17], [8, 0, 9, 17], [0, 8, 17, 9]]
        {
            let window = Window::new(frame, x0, y0, x1, y1).unwrap();
            for side in [4, 32] {
                let crops = [
                    (&whole, cast_with_tiles(&scene, &tree, window, Counting::All, &|| (), side)),
                    (&raster, rasterize_in_tiles(&scene, window, Counting::All, side, &|| ())),
                ];
                for (whole, crop) in crops {
                    for (index, pixel) in window.pixels().enumerate() {
                        assert_eq!(whole.at(pixel), crop.at(pixel), "{name} {pixel:?}");
                        let all = cover(whole, whole.window.index(pixel));
                        assert_eq!(all, cover(&crop, index), "{name} {pixel:?}");
                    }
                }
            }
        }
    }
}

/// One more triangle brings nothing farther; one less brings nothing nearer; where the winner is
/// another, nothing changes.
#[test]
fn h87_one_more_one_less() {
    let mut random = Random(87);
    for (name, triangles) in scenes_with_ties() {
        let before = agreed_within(&standard_scene(&triangles), &NARROW, &name);
        for _ in 0..3 {
            // One more, with the highest id.
            let mut more = triangles.clone();
            more.push(
                [0; 3].map(|_| [random.integer(6), random.integer(6), 1.0 + random.integer(6)]),
            );
            let added = more.len() as u32 - 1;
            let after = agreed_within(&standard_scene(&more), &NARROW, &name);
            for (a, b) in before.visible.iter().zip(&after.visible) {
                match (a, b) {
                    (_, Some(b)) if b.triangle.get() == added => {
                        assert!(a.is_none_or(|a| b.t_lo <= a.t_hi), "{name}: {a:?} {b:?}");
                    }
                    (a, b) => assert_eq!(a.map(|a| same_place(&a)), b.map(|b| same_place(&b))),
                }
            }
            // One less: the winner of some pixel.
            let winners: Vec<u32> = ids(&before).into_iter().flatten().collect();
            let removed = winners[random.below(winners.len())];
            let mut less = triangles.clone();
            less.remove(removed as usize);
            let after = agreed_within(&standard_scene(&less), &NARROW, &name);
            for (a, b) in before.visible.iter().zip(&after.visible) {
                match (a, b) {
                    (Some(a), b) if a.triangle.get() == removed => {
                        assert!(b.is_none_or(|b| a.t_lo <= b.t_hi), "{name}: {a:?} {b:?}");
                    }
                    (a, b) => {
                        let renumbered = b.map(|b| {
                            let (id, rest) = same_place(&b);
                            (id + u32::from(id >= removed), rest)
                        });
                        assert_eq!(a.map(|a| same_place(&a)), renumbered, "{name}");
                    }
                }
            }
        }
    }
}

/// Everything about a visible triangle that does not depend on the triangles behind it.
fn same_place(visible: &Visible) -> (u32, ([u64; 2], Facing)) {
    let t = [visible.t_lo.to_bits(), visible.t_hi.to_bits()];
    (visible.triangle.get(), (t, visible.facing))
}

/// det(a_0, a_1, a_2) of corners that are multiples of ¼, times 64, seen from the origin.
fn volume(triangle: &Triangle) -> i64 {
    let [a, b, c] = triangle.map(|v| v.map(|c| (4.0 * c) as i64));
    a[0] * (b[1] * c[2] - b[2] * c[1])
        + a[1] * (b[2] * c[0] - b[0] * c[2])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
}

/// Facing is −sgn V, by whole numbers; what a culling renderer shows is the picture of the front
/// faces alone, and the nearer of front and back is the whole picture. (There is no culling to
/// switch on: visibility does not depend on facing.)
#[test]
fn h88_facing() {
    for seed in 0..20 {
        let triangles: Vec<Triangle> = integer_chaos(seed)
            .iter()
            .map(|t| t.map(|[x, y, z]| [x, y, z + 2.0 + (seed % 4) as f32]))
            .collect();
        let name = format!("chaos {seed}");
        let whole = agreed_within(&standard_scene(&triangles), &NARROW, &name);
        for visible in whole.visible.iter().flatten() {
            let v = volume(&triangles[visible.triangle.index()]);
            assert_eq!(i64::from(visible.facing.sign()), -v.signum(), "{name}");
        }
        // Triangles out of the way keep the numbers of the others.
        let only = |side: i64| -> Vec<Triangle> {
            let away = [[0.0, 0.0, -1.0]; 3];
            triangles.iter().map(|t| if volume(t).signum() == side { *t } else { away }).collect()
        };
        let [front, back] =
            [-1, 1].map(|side| agreed_within(&standard_scene(&only(side)), &NARROW, &name));
        assert!(front.visible.iter().flatten().all(|v| v.facing == Facing::Front), "{name}");
        assert!(back.visible.iter().flatten().all(|v| v.facing == Facing::Back), "{name}");
        for (index, visible) in whole.visible.iter().enumerate() {
            let halves = [front.visible[index], back.visible[index]];
            let counts = [&front, &back].map(|half| cover(half, index));
            let all = cover(&whole, index);
            assert_eq!(all.crossed, counts[0].crossed + counts[1].crossed, "{name}");
            assert_eq!(all.signed, counts[1].crossed as i32 - counts[0].crossed as i32, "{name}");
            match visible {
                None => assert_eq!(halves, [None, None], "{name}"),
                Some(v) => {
                    let [same, other] = match v.facing {
                        Facing::Front => halves,
                        Facing::Back => [halves[1], halves[0]],
                    };
                    assert_eq!(same.as_ref().map(same_place), Some(same_place(v)), "{name}");
                    assert!(other.is_none_or(|other| v.t_lo <= other.t_hi), "{name}");
                }
            }
        }
    }
}

/// An eye and the winding number of a closed mesh about it.
type Winding = ([f64; 3], i32);

/// The signed count of a closed mesh is the winding number of the eye, at every sample.
#[test]
fn h88_signed_count_of_closed_meshes() {
    let look = |eye: [f64; 3], target: [f64; 3]| {
        let frame = Resolution::new(41, 31).unwrap();
        PinholeCamera::look_at(frame, eye, target, [0.1, 0.2, 1.0], 100.0).unwrap()
    };
    let twice = |mut triangles: Vec<Triangle>| {
        // A second sheet inside the first, both outwards: an eye inside both winds twice.
        let inner: Vec<Triangle> =
            triangles.iter().map(|t| t.map(|v| v.map(|c| c * 0.5))).collect();
        triangles.extend(inner);
        triangles
    };
    let meshes: [(&str, Vec<Triangle>, Vec<Winding>); 5] = [
        (
            "sphere",
            sphere(16, 32, 2.0, [0.0; 3]),
            vec![([0.3, 0.1, -0.2], 1), ([0.0, 0.0, 1.5], 1), ([3.0, 1.0, 0.5], 0)],
        ),
        (
            "torus",
            torus(32, 16, 3.0, 1.0),
            vec![
                ([3.0, 0.0, 0.25], 1),
                ([0.0; 3], 0),
                ([0.5, -0.5, 4.0], 0),
                ([0.0, -7.0, 0.0], 0),
            ],
        ),
        (
            "box",
            closed_box([-1.0, -2.0, -1.5], [1.0, 2.0, 1.5]),
            vec![([0.0; 3], 1), ([0.5, -1.5, 1.0], 1), ([3.0, 0.0, 0.0], 0), ([1.0, 5.0, 1.5], 0)],
        ),
        (
            "two boxes",
            twice(closed_box([-2.0; 3], [2.0; 3])),
            vec![([0.0; 3], 2), ([1.5, 0.0, 0.0], 1), ([4.0, 1.0, 1.0], 0)],
        ),
        (
            "two spheres",
            twice(sphere(12, 24, 2.0, [0.0; 3])),
            vec![([0.1, 0.0, 0.0], 2), ([0.0, 1.5, 0.0], 1), ([0.0, 0.0, 4.0], 0)],
        ),
    ];
    for (name, triangles, eyes) in meshes {
        for (eye, winding) in eyes {
            // Towards a face, an edge and a vertex of the mesh, and along the axes.
            let corner = triangles[triangles.len() / 3][0].map(f64::from);
            for target in [corner, [0.0, 0.0, 9.0], [9.0, 0.5, 0.0], [-4.0, -5.0, -6.0]] {
                let scene = Scene::from_triangles(look(eye, target), &triangles);
                let breadth = Breadth { audited_pixels: 20, ..NARROW };
                let buffer = agreed_within(&scene, &breadth, name);
                let counts = buffer.cover.as_ref().unwrap();
                assert!(counts.iter().all(|c| c.signed == winding), "{name} from {eye:?}");
                assert!(winding == 0 || buffer.covered_pixels() == counts.len(), "no hole");
            }
        }
    }
}

/// The comparison itself has no favourite: the paths exchanged give the same verdict, and a damaged
/// answer is blamed on whoever gave it.
#[test]
fn h89_exchanged_paths() {
    for (name, triangles) in scenes_with_ties() {
        let scene = standard_scene(&triangles);
        let window = scene.camera.resolution().window();
        let tree = Accelerator::build(&scene.mesh, BuildPreset::Medium);
        let shaded = |buffer: VisibilityBuffer| {
            let radiance = shade(&scene, &buffer, Effects::of(&scene), &|| ()).radiance;
            let seen = |visible: &Option<_>| f64::from(u8::from(visible.is_some()));
            let alpha = buffer.visible.iter().map(seen).collect();
            Answered { buffer, layers: Layers::none(window), radiance, alpha }
        };
        let cast = shaded(cast(&scene, &tree, window, Counting::All, &|| ()));
        let raster = shaded(rasterize(&scene, window, Counting::All, &|| ()));
        let options = CheckOptions { audited_pixels: 40, ..CheckOptions::default() };
        let judge = |answers: &[Answered; 2]| check::judge(&scene, answers, &options, &Unwatched);
        let [plain, exchanged] =
            [judge(&[cast.clone(), raster.clone()]), judge(&[raster.clone(), cast.clone()])];
        assert_eq!(plain.outcome(), Outcome::Agreement, "{name}");
        assert_eq!(exchanged.outcome(), Outcome::Agreement, "{name}");
        assert_eq!(plain.tied_pixels, exchanged.tied_pixels, "{name}");
        assert_eq!(plain.covered_pixels, exchanged.covered_pixels, "{name}");
        // Take one winner away from either.
        let lost = cast.buffer.visible.iter().position(Option::is_some).unwrap();
        let damaged = |answer: &Answered| {
            let mut answer = answer.clone();
            answer.buffer.visible[lost] = None;
            answer
        };
        let blames = [
            (Blame::Cast, [damaged(&cast), raster.clone()]),
            (Blame::Raster, [cast.clone(), damaged(&raster)]),
            (Blame::Cast, [damaged(&raster), cast.clone()]),
            (Blame::Raster, [raster.clone(), damaged(&cast)]),
        ];
        for (blame, answers) in blames {
            let report = judge(&answers);
            assert_eq!(report.differences.len(), 1, "{name}");
            assert_eq!(report.blamed(blame), 1, "{name}");
        }
    }
}

/// A rectangle in front of another hides it whatever their order: the least transformation.
#[test]
fn h80_the_nearer_of_two_whatever_the_order() {
    let [near, far] = [4.0, 8.0].map(|z| rectangle([-9.0, -9.0], [9.0, 9.0], z));
    for (triangles, nearest) in [([near, far].concat(), 0..2), ([far, near].concat(), 2..4)] {
        let buffer = agreed(&standard_scene(&triangles));
        assert!(ids(&buffer).iter().all(|id| id.is_some_and(|id| nearest.contains(&id))));
    }
}
