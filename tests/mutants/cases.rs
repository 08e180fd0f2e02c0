//! The cases by name: golden scenes, and scenes built here.
//!
//! Right answers come from the arbiter, which is asked before anything is planted, and are held
//! against the golden images where there are some.

use crate::golden;
use crate::judge::Bench;
use crate::scenes::{Triangle, rectangle, standard_camera, standard_scene};
use truecast::exact::Arbiter;
use truecast::pixel::{Pixel, Resolution};
use truecast::scene::Scene;
use truecast::scene::camera::PinholeCamera;
use truecast::scene::light_point::LightPoint;

const UPPER: Triangle = [[-4.0, -4.0, 8.0], [4.0, -4.0, 8.0], [-4.0, 4.0, 8.0]];

/// The case of that name, which shows something somewhere unless it is about showing nothing.
pub(crate) fn bench(name: &str) -> Bench {
    if let Some(scene) = name.strip_prefix("shadow ") {
        return shadow_bench(scene);
    }
    let (hard_case, rest) = name.split_once(' ').expect("a hard case and its scene");
    let scenes = match rest {
        "aimed rays" => aimed_rays(),
        "eye 2^-60 beside an edge" => vec![eye_beside_an_edge()],
        "eye inside" => vec![eye_inside()],
        "behind the eye" => {
            vec![standard_scene(&[[[-90.0, -90.0, -8.0], [90.0, -90.0, -8.0], [0.0, 90.0, -8.0]]])]
        }
        "mirrored camera" => vec![mirrored_camera()],
        "slanted one ulp apart" => slanted_one_ulp_apart(),
        "long coplanar" => vec![long_coplanar()],
        "fold" => vec![fold()],
        "near after a tie" => vec![near_after_a_tie(1.0), near_after_a_tie(-1.0)],
        "corner rays" => corner_rays(),
        "box beside the ray" => vec![box_beside_the_ray()],
        "ray in a box face" => vec![ray_in_a_box_face()],
        "coplanar leaves" => coplanar_leaves(),
        "one corner at 1e8" => {
            let wide = [[1e8, 0.0, 8.0], [-3.0, -3.0, 8.0], [-3.0, 3.0, 8.0]];
            vec![standard_scene(&with_bystanders(&[wide]))]
        }
        "reversed copies" => {
            let [a, b, c] = UPPER;
            vec![standard_scene(&[UPPER, [b, c, a], [a, c, b], [c, b, a]])]
        }
        "square between samples" => {
            vec![standard_scene(&rectangle([-4.5, -4.5], [4.5, 4.5], 8.0))]
        }
        golden => return golden_bench(golden),
    };
    let bench = Bench::new(scenes);
    let shows_nothing = ["H46", "H47"].contains(&hard_case);
    assert_eq!(bench.covered() == 0, shows_nothing, "{name}");
    bench
}

/// A case about shadows: a scene with lights, some of whose pixels are lit and some not.
fn shadow_bench(name: &str) -> Bench {
    let wall = rectangle([-9.0, -9.0], [9.0, 9.0], 8.0);
    let blade = |z: f32| [[-2.0, -2.0, z], [2.0, -2.0, z], [0.0, 3.0, z]];
    let (triangles, light): (Vec<Triangle>, _) = match name {
        "slanted wall" => {
            let wall = [[-9.1, -9.2, 7.3], [9.3, -9.7, 8.9], [0.3, 17.0, 11.7]];
            (vec![blade(4.0), wall], [3.3, 0.4, 1.7])
        }
        // The blade is 1/512 before the wall, the light 4: its shadow falls 3 beside it.
        "blade on a wall" => {
            let mut triangles = wall.to_vec();
            triangles.push(blade(8.0 - 1.0 / 512.0));
            (triangles, [6000.0, 0.5, 4.0])
        }
        // The light between two blades: one casts a shadow on the wall.
        "light before a blade" => {
            let mut triangles = wall.to_vec();
            triangles.extend([blade(5.0), blade(7.0)]);
            (triangles, [1.25, 0.5, 6.0])
        }
        // The wall's triangles share a plane, and its samples are on their edges.
        "grid_exact" => {
            let grid = golden::scene("grid_exact").scene;
            let mut triangles: Vec<Triangle> =
                grid.mesh.ids().map(|id| grid.mesh.triangle(id)).collect();
            triangles.push([[-1.0, -1.5, 2.0], [0.5, -1.0, 2.0], [0.0, 1.0, 2.5]]);
            (triangles, [2.3, 0.7, 0.3])
        }
        // From the light, the inner edges of the four squares fall on pixel centres of the wall; the
        // light is off the eye's axis, so that the wall is seen there.
        "grid over a wall" => {
            let mut triangles = rectangle([-16.0, -16.0], [16.0, 16.0], 16.0).to_vec();
            for [x, y] in [[0.0, 0.0], [2.0, 0.0], [0.0, 2.0], [2.0, 2.0]] {
                triangles.extend(rectangle([x, y], [x + 2.0, y + 2.0], 4.0));
            }
            (triangles, [4.0, 2.0, 0.0])
        }
        _ => unreachable!("no case of shadows is called {name}"),
    };
    let light = LightPoint::Position(light);
    let bench = Bench::with_light(standard_scene(&triangles), light);
    let [lit, dark] = bench.lit_and_dark();
    assert!(lit > 5 && dark > 5, "{name}: {lit} lit, {dark} dark");
    bench
}

/// A golden scene; the arbiter must give its images.
fn golden_bench(name: &str) -> Bench {
    let golden = golden::scene(name);
    let bench = Bench::new(vec![golden.scene]);
    for (index, answer) in bench.answers().iter().enumerate() {
        assert_eq!(answer.visible.map(|s| s.triangle.get()), golden.ids[index], "{name}");
        assert_eq!(answer.cover.crossed, golden.cover[index], "{name}");
        assert_eq!(answer.cover.signed, golden.signed[index], "{name}");
    }
    bench
}

/// A fixed sequence of multiples of 2^-24 in [0, 1).
struct Sequence(u64);

impl Sequence {
    fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 40) as f64 / f64::from(1 << 24)
    }

    fn point(&mut self) -> [f64; 3] {
        std::array::from_fn(|_| self.next())
    }
}

/// A camera of one pixel that looks exactly along `direction`; `None` where the lattice moves it.
fn one_pixel(eye: [f64; 3], direction: [f64; 3], [dx, dy]: [[f64; 3]; 2]) -> Option<PinholeCamera> {
    let d0 = std::array::from_fn(|k| direction[k] - 0.5 * dx[k] - 0.5 * dy[k]);
    let camera = PinholeCamera::exact(Resolution::new(1, 1)?, eye, d0, dx, dy).ok()?;
    let kept =
        std::array::from_fn(|k| camera.d0()[k] + 0.5 * camera.dx()[k] + 0.5 * camera.dy()[k]);
    (kept == direction).then_some(camera)
}

/// Steps of a pixel along x and y, a small power of two.
const PIXEL_STEPS: [[f64; 3]; 2] = [[1.0 / 64.0, 0.0, 0.0], [0.0, 1.0 / 64.0, 0.0]];

/// Triangles far to the side, so that the tree has inner nodes.
fn with_bystanders(triangles: &[Triangle]) -> Vec<Triangle> {
    let bystanders = (0..8).flat_map(|k| {
        let away = 1000.0 + 30.0 * k as f32;
        rectangle([away, away], [away + 1.0, away + 2.0], 70.0 + away)
    });
    triangles.iter().copied().chain(bystanders).collect()
}

/// H16: rays from inside a closed sphere at points of its edges, beside them by rounding only:
/// the direction has 53 bits, so that an edge function in f64 is noise.
fn aimed_rays() -> Vec<Scene> {
    let (rings, segments) = (6, 12);
    let vertex = |ring: u32, segment: u32| -> [f32; 3] {
        let polar = std::f64::consts::PI * f64::from(ring) / f64::from(rings);
        let around = std::f64::consts::TAU * f64::from(segment % segments) / f64::from(segments);
        let radius = if ring == 0 || ring == rings { 0.0 } else { 2.0 * polar.sin() };
        [radius * around.cos(), radius * around.sin(), 2.0 * polar.cos()].map(|c| c as f32)
    };
    let mut sphere = Vec::new();
    for (ring, segment) in (0..rings).flat_map(|ring| (0..segments).map(move |s| (ring, s))) {
        let [a, b] = [vertex(ring, segment), vertex(ring, segment + 1)];
        let [c, d] = [vertex(ring + 1, segment), vertex(ring + 1, segment + 1)];
        if ring > 0 {
            sphere.push([a, c, b]);
        }
        if ring + 1 < rings {
            sphere.push([b, c, d]);
        }
    }
    let mut random = Sequence(5);
    let scene = |number: usize| {
        let triangle = sphere[number * 7 % sphere.len()];
        let [p, q] = [0, 1].map(|k| triangle[(number + k) % 3].map(f64::from));
        let along = random.next();
        let eye = random.point().map(|c| c - 0.5);
        // Rounded to the lattice's unit, 2^-50 for directions of this size.
        let unit = 2.0_f64.powi(-50);
        let direction = std::array::from_fn(|k| {
            let target = p[k] + (q[k] - p[k]) * along;
            ((target - eye[k]) / unit).round() * unit
        });
        let camera = one_pixel(eye, direction, PIXEL_STEPS)?;
        Some(Scene::from_triangles(camera, &sphere))
    };
    (0..400).filter_map(scene).collect()
}

/// Two rectangles that meet in x = 1, seen from x = -2^-60: the ray towards (1, y, 8) passes the
/// edge at 1 - 2^-60, on the left; with v - e rounded to f64 it is on the edge.
fn eye_beside_an_edge() -> Scene {
    let camera = standard_camera(8.0);
    let eye = [-(2.0_f64.powi(-60)), 0.0, 0.0];
    let camera =
        PinholeCamera::exact(camera.resolution(), eye, camera.d0(), camera.dx(), camera.dy())
            .expect("the standard camera moved");
    let left = rectangle([-4.0, -4.0], [1.0, 4.0], 8.0);
    let right = rectangle([1.0, -4.0], [5.0, 4.0], 8.0);
    Scene::from_triangles(camera, &[left, right].concat())
}

/// The eye inside a triangle, both ways round; the plane y = -z/16 holds no sample's direction
/// (i, j, 8), j an integer.
fn eye_inside() -> Scene {
    let [a, b, c] = [[-16.0, 1.0, -16.0], [16.0, 1.0, -16.0], [0.0, -1.0, 16.0]];
    standard_scene(&[[a, b, c], [a, c, b]])
}

/// Pixels run from right to left: det(P) < 0.
fn mirrored_camera() -> Scene {
    let frame = Resolution::new(17, 17).expect("a frame");
    let camera =
        PinholeCamera::exact(frame, [0.0; 3], [8.5, -8.5, 8.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
    Scene::from_triangles(camera.expect("a mirrored camera"), &[UPPER])
}

/// Slanted triangles, each with another whose corners are one ulp nearer, the far one first;
/// coordinates of 24 bits, because products of short ones are exact in f32 too. V is one number per
/// triangle, so that one pair may be in order by luck.
fn slanted_one_ulp_apart() -> Vec<Scene> {
    let mut random = Sequence(3);
    let scene = |_| {
        let corners = [[-4000.0, -4000.0], [4000.0, -4000.0], [0.0, 5000.0]];
        let far: Triangle = corners.map(|[x, y]: [f64; 2]| {
            [x + 90.0 * random.next(), y + 90.0 * random.next(), 700.0 + 600.0 * random.next()]
                .map(|c| c as f32)
        });
        let near = far.map(|[x, y, z]| [x, y, z.next_down()]);
        standard_scene(&[far, near])
    };
    (0..8).map(scene).collect()
}

/// Triangles of the plane x + 2y + 3z = 3·2^22 with corners of 22 bits: V has some 70 bits, so that
/// equal depths come out unequal when rounded.
fn long_coplanar() -> Scene {
    let mut random = Sequence(9);
    let mut corner = || -> [f32; 3] {
        let mut coordinate = || (random.next() * f64::from(1 << 23)) as i64 - (1 << 22);
        let (x, y) = (coordinate(), coordinate());
        let plane = 3 * (1 << 22);
        // Moved by at most 2 to make z an integer.
        let x = x + (plane - x - 2 * y).rem_euclid(3);
        [x, y, (plane - x - 2 * y) / 3].map(|c| c as f32)
    };
    let triangles: Vec<Triangle> = (0..24).map(|_| [corner(), corner(), corner()]).collect();
    standard_scene(&triangles)
}

/// Two leaves to the right of one edge that runs down the samples of column 8; the nearer has the
/// higher id.
fn fold() -> Scene {
    let (top, bottom) = ([0.0, -9.0, 8.0], [0.0, 9.0, 8.0]);
    standard_scene(&[[top, bottom, [6.0, 0.0, 9.0]], [top, bottom, [6.0, 0.0, 7.0]]])
}

/// Two triangles in one plane, and one before them; seen along an axis or against it, it comes later
/// in space.
fn near_after_a_tie(forwards: f32) -> Scene {
    let at = |z: f32, corners: [[f32; 2]; 3]| corners.map(|[x, y]| [x, y, forwards * z]);
    let resolution = Resolution::new(17, 17).unwrap();
    let camera = PinholeCamera::exact(
        resolution,
        [0.0; 3],
        [-8.5, -8.5, f64::from(8.0 * forwards)],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
    )
    .unwrap();
    Scene::from_triangles(
        camera,
        &[
            at(8.0, [[-6.25, -6.25], [6.25, -6.25], [-6.25, 6.25]]),
            at(8.0, [[-6.25, -6.25], [6.5, -6.25], [-6.25, 6.75]]),
            at(4.0, [[-2.25, -2.25], [3.25, -2.25], [-2.25, 3.25]]),
        ],
    )
}

/// H56: rays that meet a triangle in a corner, which is all that they meet of its box: they leave
/// the box in x where they enter it in y. DX points into the triangle, so that it is seen.
fn corner_rays() -> Vec<Scene> {
    let mut random = Sequence(1);
    let scene = |_| {
        let eye = random.point().map(|c| c - 0.5);
        let corner = random.point().map(|c| 2.0 * c - 1.0);
        let direction: [f64; 3] = std::array::from_fn(|k| corner[k] - eye[k]);
        let [x, y, z] = corner.map(|c| c as f32);
        let beside_x = [x - (direction[0] as f32).signum(), y, z - 1.0];
        let beside_y = [x, y + (direction[1] as f32).signum(), z + 1.0];
        let triangle = [[x, y, z], beside_x, beside_y];
        let into: [f64; 3] = std::array::from_fn(|k| {
            let middle = (f64::from(beside_x[k]) + f64::from(beside_y[k])) * 0.5;
            (middle - corner[k]) / 64.0
        });
        let camera = one_pixel(eye, direction, [into, [0.0, 1.0 / 64.0, 0.0]])?;
        let scene = Scene::from_triangles(camera, &with_bystanders(&[triangle]));
        let seen = Arbiter::new(&scene).answer(Pixel { x: 0, y: 0 }).visible.is_some();
        seen.then_some(scene)
    };
    (0..200).filter_map(scene).collect()
}

/// H51: the left square ends 1e-6 beside a ray along z.
fn box_beside_the_ray() -> Scene {
    let camera = one_pixel([0.0, 0.25, 0.0], [0.0, 0.0, 1.0], PIXEL_STEPS).expect("along z");
    let left = rectangle([-1.0, -1.0], [1e-6, 1.0], 50.0);
    let right = rectangle([1e-6, -1.0], [1.0, 1.0], 50.0);
    Scene::from_triangles(camera, &with_bystanders(&[left, right].concat()))
}

/// H50: a ray in the plane of a square's right side, which with pixels from right to left belongs
/// to the square.
fn ray_in_a_box_face() -> Scene {
    let [[step, ..], dy] = PIXEL_STEPS;
    let steps = [[-step, 0.0, 0.0], dy];
    let camera = one_pixel([0.0, 0.25, 0.0], [0.0, 0.0, 1.0], steps).expect("along z");
    Scene::from_triangles(camera, &with_bystanders(&rectangle([-1.0, -1.0], [0.0, 1.0], 5.0)))
}

/// H63: overlapping triangles of one plane in leaves of their own, in both orders of ids.
fn coplanar_leaves() -> Vec<Scene> {
    let wide = [[-8.0, -4.0, 8.0], [8.0, -4.0, 8.0], [0.0, 7.0, 8.0]];
    [[UPPER, wide], [wide, UPPER]]
        .map(|triangles| standard_scene(&with_bystanders(&triangles)))
        .into()
}
