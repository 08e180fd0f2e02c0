//! The ray caster against golden images, against a linear scan, and against its own settings.

use truecast::accel::{Accelerator, BuildPreset};
use truecast::cast::{cast, cast_with_tiles};
use truecast::pixel::{Resolution, Window};
use truecast::scene::Scene;
use truecast::scene::camera::PinholeCamera;
use truecast::visibility::{Counting, Level, VisibilityBuffer, Visible};

type Triangle = [[f32; 3]; 3];

/// A scene whose answers a program in rational arithmetic computed.
#[derive(serde::Deserialize)]
struct Golden {
    name: String,
    width: u32,
    height: u32,
    camera: Vectors,
    /// Exact doubles of f32 values in the file; read as f32, because serde_json may miss the
    /// last bit of a double, which rounding to f32 undoes.
    triangles: Vec<Triangle>,
    ids: Vec<i64>,
    cover_count: Vec<u32>,
    signed_count: Vec<i32>,
}

#[derive(serde::Deserialize)]
struct Vectors {
    eye: [f64; 3],
    d0: [f64; 3],
    dx: [f64; 3],
    dy: [f64; 3],
}

fn goldens() -> Vec<Golden> {
    serde_json::from_str(include_str!("golden/visibility.json")).unwrap()
}

impl Golden {
    fn scene(&self) -> Scene {
        let Vectors { eye, d0, dx, dy } = self.camera;
        let resolution = Resolution::new(self.width, self.height).unwrap();
        let camera = PinholeCamera::exact(resolution, eye, d0, dx, dy).unwrap();
        Scene::from_triangles(camera, &self.triangles)
    }
}

/// The standard camera G(f): 17 × 17 pixels, pixel (8, 8) looks along (0, 0, f).
fn standard_camera(f: f64) -> PinholeCamera {
    let resolution = Resolution::new(17, 17).unwrap();
    PinholeCamera::exact(resolution, [0.0; 3], [-8.5, -8.5, f], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0])
        .unwrap()
}

/// A camera of one pixel whose sample looks from `eye` along `direction`, exactly.
fn single_ray(eye: [f64; 3], direction: [f64; 3]) -> PinholeCamera {
    let largest = direction.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
    let step = 2.0_f64.powi(largest.log2().floor() as i32 - 2);
    // The steps span the plane across the largest component.
    let along = (0..3).find(|&k| direction[k].abs() == largest).unwrap();
    let axis = |k: usize| std::array::from_fn(|i| if i == k % 3 { step } else { 0.0 });
    let (dx, dy): ([f64; 3], [f64; 3]) = (axis(along + 1), axis(along + 2));
    let d0 = std::array::from_fn(|k| direction[k] - 0.5 * dx[k] - 0.5 * dy[k]);
    let camera = PinholeCamera::exact(Resolution::new(1, 1).unwrap(), eye, d0, dx, dy).unwrap();
    let exact: [f64; 3] =
        std::array::from_fn(|k| camera.d0()[k] + 0.5 * camera.dx()[k] + 0.5 * camera.dy()[k]);
    assert_eq!(exact, direction, "the camera keeps the direction");
    camera
}

fn all(scene: &Scene, accelerator: &Accelerator) -> VisibilityBuffer {
    cast(scene, accelerator, scene.camera.resolution().window(), Counting::All, &|| ())
}

fn nearest(scene: &Scene, accelerator: &Accelerator) -> VisibilityBuffer {
    cast(scene, accelerator, scene.camera.resolution().window(), Counting::Nearest, &|| ())
}

/// The answer of the linear scan, after every preset gave the same, bit for bit, in both modes.
fn agreed(scene: &Scene) -> VisibilityBuffer {
    let reference = all(scene, &Accelerator::linear(&scene.mesh));
    for preset in BuildPreset::ALL {
        let accelerator = Accelerator::build(&scene.mesh, preset);
        let counted = all(scene, &accelerator);
        assert_same(&reference, &counted);
        assert_eq!(reference.cover, counted.cover, "{preset:?}");
        assert_same(&reference, &nearest(scene, &accelerator));
    }
    reference
}

fn bits(visible: &Visible) -> [u64; 5] {
    let [b0, b1, b2] = visible.barycentric.0;
    [b0, b1, b2, visible.t_lo, visible.t_hi].map(f64::to_bits)
}

/// Same answers, bit for bit; levels of work may differ.
fn assert_same(a: &VisibilityBuffer, b: &VisibilityBuffer) {
    for (index, (left, right)) in a.visible.iter().zip(&b.visible).enumerate() {
        assert_eq!(left, right, "pixel {index}");
        assert_eq!(left.as_ref().map(bits), right.as_ref().map(bits), "pixel {index}");
    }
    assert_eq!(a.visible.len(), b.visible.len());
}

fn ids(buffer: &VisibilityBuffer) -> Vec<i64> {
    buffer.visible.iter().map(|v| v.map_or(-1, |v| i64::from(v.triangle.get()))).collect()
}

fn covered(buffer: &VisibilityBuffer) -> usize {
    buffer.covered_pixels()
}

/// Finite, ordered bounds of t with a relative width of at most 2^-40, weights that sum to 1.
fn assert_finite(buffer: &VisibilityBuffer) {
    for visible in buffer.visible.iter().flatten() {
        assert!(visible.t_lo > 0.0 && visible.t_hi.is_finite());
        assert!(visible.t_lo <= visible.t_hi);
        assert!(visible.t_hi - visible.t_lo <= visible.t_hi * 2.0_f64.powi(-40), "{visible:?}");
        let sum: f64 = visible.barycentric.0.iter().sum();
        // Each weight is good to 2^-49, so is their sum.
        assert!((sum - 1.0).abs() <= 2.0_f64.powi(-49), "{visible:?}");
        assert!(visible.barycentric.0.iter().all(|b| b.is_sign_positive()));
        assert!(!visible.tie || visible.level == Level::Exact);
    }
}

#[test]
fn golden_scenes_for_every_preset_and_tile_size() {
    let goldens = goldens();
    assert_eq!(goldens.len(), 26);
    for golden in &goldens {
        let scene = golden.scene();
        let buffer = agreed(&scene);
        assert_eq!(ids(&buffer), golden.ids, "{}", golden.name);
        let cover = buffer.cover.as_ref().unwrap();
        let crossed: Vec<u32> = cover.iter().map(|c| c.crossed).collect();
        let signed: Vec<i32> = cover.iter().map(|c| c.signed).collect();
        assert_eq!(crossed, golden.cover_count, "{}", golden.name);
        assert_eq!(signed, golden.signed_count, "{}", golden.name);
        assert_finite(&buffer);
        let accelerator = Accelerator::build(&scene.mesh, BuildPreset::Medium);
        let window = scene.camera.resolution().window();
        for side in [1, 3, 16, 64] {
            let tiled = cast_with_tiles(&scene, &accelerator, window, Counting::All, &|| (), side);
            assert_same(&buffer, &tiled);
            assert_eq!(buffer.cover, tiled.cover);
        }
    }
}

#[test]
fn a_crop_is_a_part_of_its_frame() {
    let golden = &goldens()[5];
    let scene = golden.scene();
    let accelerator = Accelerator::build(&scene.mesh, BuildPreset::Fast);
    let whole = nearest(&scene, &accelerator);
    let window = Window::new(scene.camera.resolution(), 3, 5, 14, 11).unwrap();
    let crop = cast(&scene, &accelerator, window, Counting::Nearest, &|| ());
    for pixel in window.pixels() {
        assert_eq!(whole.at(pixel), crop.at(pixel));
    }
    assert!(crop.cover.is_none());
}

/// A UV sphere about `center`, closed, counter-clockwise from outside.
fn sphere(rings: u32, segments: u32, radius: f64, center: [f64; 3]) -> Vec<Triangle> {
    let vertex = |ring: u32, segment: u32| -> [f32; 3] {
        let polar = std::f64::consts::PI * f64::from(ring) / f64::from(rings);
        let around = std::f64::consts::TAU * f64::from(segment % segments) / f64::from(segments);
        let direction = if ring == 0 || ring == rings {
            [0.0, 0.0, if ring == 0 { 1.0 } else { -1.0 }]
        } else {
            [polar.sin() * around.cos(), polar.sin() * around.sin(), polar.cos()]
        };
        // On multiples of 2^-24, so that differences keep a camera's lattice.
        let grid = f64::from(1 << 24);
        std::array::from_fn(|k| {
            (((center[k] + radius * direction[k]) * grid).round() / grid) as f32
        })
    };
    let mut triangles = Vec::new();
    for ring in 0..rings {
        for segment in 0..segments {
            let [a, b] = [vertex(ring, segment), vertex(ring, segment + 1)];
            let [c, d] = [vertex(ring + 1, segment), vertex(ring + 1, segment + 1)];
            if ring > 0 {
                triangles.push([a, c, b]);
            }
            if ring + 1 < rings {
                triangles.push([b, c, d]);
            }
        }
    }
    triangles
}

/// A small pseudo-random sequence in [0, 1).
struct Sequence(u64);

impl Sequence {
    fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A multiple of 2^-22.
    fn step(&mut self) -> f64 {
        (self.next() * f64::from(1 << 22)).floor() / f64::from(1 << 22)
    }
}

/// H15, H16: rays from inside a closed mesh at its vertices and edge midpoints. Each crosses the
/// mesh exactly once net (the eye's winding number), at every offset; and the tree gives what the
/// linear scan gives.
#[test]
fn h15_rays_at_vertices_and_edges_of_a_closed_sphere() {
    for center in [[0.0; 3], [148_376.0, 1234.0, -223_423.0]] {
        let triangles = sphere(16, 32, 2.0, center);
        let mut scene = Scene::from_triangles(standard_camera(8.0), &triangles);
        let accelerator = Accelerator::build(&scene.mesh, BuildPreset::Medium);
        let linear = Accelerator::linear(&scene.mesh);
        let mut random = Sequence(7);
        let mut ties = 0;
        for number in 0..6000 {
            let triangle = triangles[number % triangles.len()];
            let eye: [f64; 3] =
                std::array::from_fn(|k| f64::from((center[k] + random.step() - 0.5) as f32));
            let target: [f64; 3] = if number % 3 == 0 {
                std::array::from_fn(|k| {
                    (f64::from(triangle[0][k]) + f64::from(triangle[1][k])) * 0.5
                })
            } else {
                triangle[number % 3].map(f64::from)
            };
            // Exact through the vertex or midpoint, or rounded to f32: beside it by an ulp.
            let exact = number % 2 == 0;
            let direction = std::array::from_fn(|k| {
                let d = target[k] - eye[k];
                if exact { d } else { f64::from(d as f32) }
            });
            scene.camera = single_ray(eye, direction);
            let buffer = all(&scene, &accelerator);
            let cover = buffer.cover.as_ref().unwrap()[0];
            assert_eq!(cover.signed.abs(), 1, "ray {number} from {eye:?} along {direction:?}");
            let winner = buffer.visible[0].expect("a closed mesh has no hole");
            ties += usize::from(winner.tie);
            assert_same(&buffer, &nearest(&scene, &accelerator));
            let scanned = all(&scene, &linear);
            assert_same(&scanned, &buffer);
            assert_eq!(scanned.cover, buffer.cover);
        }
        assert!(ties > 2000, "exactly aimed rays hit edges exactly: {ties}");
    }
}

/// A large sphere through the tree only: no hole, one crossing.
#[test]
fn h57_aimed_rays_leave_no_hole_in_a_large_sphere() {
    let triangles = sphere(100, 200, 2.0, [0.0; 3]);
    let mut scene = Scene::from_triangles(standard_camera(8.0), &triangles);
    let accelerator = Accelerator::build(&scene.mesh, BuildPreset::Fastest);
    let mut random = Sequence(11);
    for number in 0..30_000 {
        let target = triangles[(number * 7919) % triangles.len()][number % 3].map(f64::from);
        let eye: [f64; 3] = std::array::from_fn(|_| random.step() - 0.5);
        let direction = std::array::from_fn(|k| f64::from((target[k] - eye[k]) as f32));
        scene.camera = single_ray(eye, direction);
        let buffer = all(&scene, &accelerator);
        assert_eq!(buffer.cover.as_ref().unwrap()[0].signed, 1, "ray {number}");
        assert!(buffer.visible[0].is_some());
    }
}

fn quad(x: [f32; 2], y: [f32; 2], z: f32) -> [Triangle; 2] {
    let corner = |i: usize, j: usize| [x[i], y[j], z];
    [[corner(0, 0), corner(1, 0), corner(1, 1)], [corner(0, 0), corner(1, 1), corner(0, 1)]]
}

/// A scene of quads seen by one ray from (0, 0.25, 0), with enough bystanders for a tree.
fn quads_and_ray(quads: &[[Triangle; 2]], direction: [f64; 3]) -> Scene {
    let mut triangles = quads.concat();
    for k in 0..40 {
        let away = 100.0 + 3.0 * k as f32;
        triangles.extend(quad([away, away + 1.0], [away, away + 2.0], 70.0 + away));
    }
    Scene::from_triangles(single_ray([0.0, 0.25, 0.0], direction), &triangles)
}

#[test]
fn h50_a_ray_in_the_plane_of_a_box_face() {
    let ahead = [0.0, 0.0, 1.0];
    // x = 0 is the right edge of the left quad: exclusive; of the right quad it is the left edge.
    let left = [quad([-1.0, 0.0], [-1.0, 1.0], 5.0), quad([-9.0, -8.0], [-1.0, 1.0], 50.0)];
    let right = [quad([0.0, 1.0], [-1.0, 1.0], 5.0), quad([8.0, 9.0], [-1.0, 1.0], 50.0)];
    for direction in [ahead, [-0.0, 0.0, 1.0], [-0.0, -0.0, 1.0]] {
        let none = agreed(&quads_and_ray(&left, direction));
        let some = agreed(&quads_and_ray(&right, direction));
        assert_eq!(covered(&none), 0);
        assert_eq!(covered(&some), 1);
        assert!(some.visible[0].unwrap().tie);
        assert!(some.visible[0].unwrap().t_lo <= 5.0 && some.visible[0].unwrap().t_hi >= 5.0);
    }
}

#[test]
fn h51_h52_boxes_that_end_just_beside_an_axis_parallel_ray() {
    let quads = [quad([-1.0, 1e-6], [-1.0, 1.0], 50.0), quad([1e-6, 1.0], [-1.0, 1.0], 50.0)];
    for x in [0.0, 1e-9, -1e-9, f64::from(f32::from_bits(1))] {
        // The camera's lattice keeps multiples of 2^-53 only: 1e-9 as such, 2^-149 as 0.
        let x = (x * 2.0_f64.powi(50)).round() * 2.0_f64.powi(-50);
        let buffer = agreed(&quads_and_ray(&quads, [x, 0.0, 1.0]));
        let expected = i64::from(x < 0.0);
        let id = ids(&buffer)[0];
        assert!(id == 0 || id == 1, "the left quad, not {id}; {expected}");
    }
}

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
    let mut scene = Scene::from_triangles(single_ray([0.0, 0.25, 0.0], [0.0, 0.0, 1.0]), &quads);
    assert_eq!(covered(&agreed(&scene)), 0);
    // From the left of it by 2^-40, leaning to it by 2^-42 per unit: crosses plane 0 at t = 4…6.
    let lean = 2.0_f64.powi(-42);
    scene.camera = single_ray([-5.0 * lean, 0.25, 0.0], [lean, 0.0, 1.0]);
    let buffer = agreed(&scene);
    assert_eq!(covered(&buffer), 1);
    assert!(ids(&buffer)[0] < 2);
    let visible = buffer.visible[0].unwrap();
    assert!(visible.t_lo <= 5.0 && 5.0 <= visible.t_hi);
    assert_eq!(buffer.cover.unwrap()[0].crossed, 1);
}

#[test]
fn h58_many_identical_triangles_are_one_answer() {
    let triangle = [[-4.0, -4.0, 8.0], [4.0, -4.0, 8.0], [-4.0, 4.0, 8.0]];
    let count = 100_000;
    let scene = Scene::from_triangles(standard_camera(8.0), &vec![triangle; count]);
    let buffer = all(&scene, &Accelerator::build(&scene.mesh, BuildPreset::Medium));
    assert_eq!(covered(&buffer), 36);
    for (visible, cover) in buffer.visible.iter().zip(buffer.cover.as_ref().unwrap()) {
        let Some(visible) = visible else { continue };
        assert_eq!(visible.triangle.get(), 0);
        assert!(visible.tie);
        assert_eq!(cover.crossed as usize, count);
        assert_eq!(cover.signed.unsigned_abs() as usize, count);
    }
}

#[test]
fn h59_h65_nested_and_chained_triangles() {
    let concentric: Vec<Triangle> = (1..=600)
        .map(|i| {
            let s = i as f32 / 64.0;
            [[-s, -s, 8.0], [2.0 * s, -s, 8.0], [-s, 2.0 * s, 8.0]]
        })
        .collect();
    let scene = Scene::from_triangles(standard_camera(8.0), &concentric);
    // One plane: the lowest id wherever it reaches.
    let buffer = agreed(&scene);
    assert_eq!(ids(&buffer)[8 * 17 + 8], 0);
    let chain: Vec<Triangle> = (-140..=120)
        .map(|k| {
            let s = 2.0_f64.powi(k) as f32;
            [[-s, -s, 2.0 * s], [s, -s, 2.0 * s], [-s, s, 3.0 * s]]
        })
        .collect();
    let scene = Scene::from_triangles(standard_camera(8.0), &chain);
    let buffer = agreed(&scene);
    assert_eq!(ids(&buffer)[8 * 17 + 6], 0, "the smallest is nearest");
    assert_finite(&buffer);
}

/// H61, H70, H77: a scene at every power of two, down to multiples of the least f32, is the same
/// scene.
#[test]
fn h61_h70_scales_by_powers_of_two_change_nothing() {
    let golden = goldens().into_iter().find(|golden| golden.name == "grid_exact").unwrap();
    let reference = agreed(&golden.scene());
    for k in [-148, -147, -126, -100, -60, 60, 100, 110, 122] {
        let scaled = |c: f32| (f64::from(c) * 2.0_f64.powi(k)) as f32;
        let triangles: Vec<Triangle> =
            golden.triangles.iter().map(|t| t.map(|v| v.map(scaled))).collect();
        let scene = Scene::from_triangles(standard_camera(8.0), &triangles);
        let buffer = agreed(&scene);
        assert_finite(&buffer);
        assert_eq!(ids(&reference), ids(&buffer), "2^{k}");
        assert_eq!(reference.cover, buffer.cover, "2^{k}");
        for (a, b) in reference.visible.iter().zip(&buffer.visible) {
            let (Some(a), Some(b)) = (a, b) else { continue };
            assert_eq!(a.barycentric, b.barycentric);
            assert_eq!(a.t_lo * 2.0_f64.powi(k), b.t_lo);
            assert_eq!(a.t_hi * 2.0_f64.powi(k), b.t_hi);
        }
    }
}

/// H53: the camera's own scale changes t only.
#[test]
fn h53_short_and_long_directions() {
    let golden = goldens().into_iter().find(|golden| golden.name == "grid_exact").unwrap();
    let reference = agreed(&golden.scene());
    for k in [-290, -27, 20, 290] {
        let factor = 2.0_f64.powi(k);
        let scaled = |v: [f64; 3]| v.map(|c| c * factor);
        let Vectors { eye, d0, dx, dy } = golden.camera;
        let mut scene = golden.scene();
        let resolution = scene.camera.resolution();
        scene.camera =
            PinholeCamera::exact(resolution, eye, scaled(d0), scaled(dx), scaled(dy)).unwrap();
        let buffer = agreed(&scene);
        for (a, b) in reference.visible.iter().zip(&buffer.visible) {
            let (Some(a), Some(b)) = (a, b) else { continue };
            assert_eq!((a.triangle, a.barycentric), (b.triangle, b.barycentric));
            assert_eq!(a.t_lo / factor, b.t_lo);
        }
        assert_finite(&buffer);
    }
}

/// H64: random triangles of all sizes, several thousand rays, counts by tree and by scan.
#[test]
fn h64_all_hits_by_tree_and_by_scan() {
    let mut random = Sequence(3);
    let mut triangles: Vec<Triangle> = (0..1500)
        .map(|_| {
            let size = 4.0 * random.next().powi(6) + 0.05;
            let center: [f64; 3] = [
                12.0 * random.next() - 6.0,
                12.0 * random.next() - 6.0,
                12.0 * random.next() - 2.0,
            ];
            std::array::from_fn(|_| {
                std::array::from_fn(|k| (center[k] + size * (random.next() - 0.5)) as f32)
            })
        })
        .collect();
    // On small integers too, so that ties abound.
    for _ in 0..500 {
        triangles.push(std::array::from_fn(|_| {
            std::array::from_fn(|_| (random.next() * 7.0).floor() as f32 - 3.0)
        }));
    }
    let resolution = Resolution::new(40, 40).unwrap();
    let camera = PinholeCamera::exact(
        resolution,
        [0.25, -0.5, -8.5],
        [-0.625, -0.625, 1.0],
        [1.0 / 32.0, 0.0, 0.0],
        [0.0, 1.0 / 32.0, 0.0],
    )
    .unwrap();
    let scene = Scene::from_triangles(camera, &triangles);
    let buffer = agreed(&scene);
    assert_finite(&buffer);
    assert!(buffer.visible.iter().flatten().filter(|v| v.tie).count() > 10);
    // H63, H30: a permuted order of triangles is the same picture, ids apart, where no two
    // triangles share a plane.
    let mut reversed = triangles.clone();
    reversed.reverse();
    let other = agreed(&Scene::from_triangles(scene.camera.clone(), &reversed));
    assert_eq!(buffer.cover, other.cover);
    for (a, b) in buffer.visible.iter().zip(&other.visible) {
        assert_eq!(a.map(|v| bits(&v)[3]), b.map(|v| bits(&v)[3]), "t does not depend on order");
        assert_eq!(a.map(|v| v.tie), b.map(|v| v.tie));
    }
}

#[test]
fn threads_do_not_change_a_bit() {
    let triangles = sphere(24, 48, 3.0, [0.0, 0.0, 9.0]);
    let camera = PinholeCamera::look_at(
        Resolution::new(160, 120).unwrap(),
        [0.1, 0.2, 0.0],
        [0.0, 0.0, 9.0],
        [0.0, 1.0, 0.0],
        50.0,
    )
    .unwrap();
    let scene = Scene::from_triangles(camera, &triangles);
    let with_threads = |count: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build().unwrap();
        pool.install(|| {
            let accelerator = Accelerator::build(&scene.mesh, BuildPreset::Slow);
            all(&scene, &accelerator)
        })
    };
    let (one, two) = (with_threads(1), with_threads(2));
    assert_same(&one, &two);
    assert_eq!(one.cover, two.cover);
    assert!(covered(&one) > 5000);
    // A closed sphere seen from outside: two crossings, net zero.
    assert!(one.cover.unwrap().iter().all(|c| c.signed == 0 && c.crossed % 2 == 0));
}

/// H24, H25: planes one ulp apart, the far one first in the file; the filter decides.
#[test]
fn h24_planes_one_step_apart_are_ordered() {
    let near = 1000.0_f32;
    let far = f32::from_bits(near.to_bits() + 1);
    let plane = |z: f32| quad([-2000.0, 2000.0], [-2000.0, 2000.0], z);
    let scene = Scene::from_triangles(standard_camera(8.0), &[plane(far), plane(near)].concat());
    let buffer = agreed(&scene);
    assert!(buffer.visible.iter().all(|v| v.unwrap().triangle.get() >= 2));
}
