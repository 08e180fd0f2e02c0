//! A75: the lab's five exercises. Each sentence "In testing, you should see …" is a test.

use super::stage::{Picture, V3, changed, dot, halfway, minus, sheet, unit};
use truecast::scene::Scene;
use truecast::scene::light::Light;

/// Objects, in the order of the scene files.
const SPHERE: usize = 3;
const FIGURE: usize = 4;
const BALL: usize = 5;

const BALL_AT: &str = "translate = [0.35, 2.1, 1.5]";
const LOW_SPHERE: &str = "around = 48, rings = 24";
const HIGH_SPHERE: &str = "around = 192, rings = 96";

/// A scene of the lab with the ball elsewhere.
fn with_ball(name: &str, at: V3, more: &[(&str, &str)]) -> Scene {
    let ball = format!("translate = {at:?}");
    let changes: Vec<_> =
        [(BALL_AT, ball.as_str())].into_iter().chain(more.iter().copied()).collect();
    changed(&format!("lab5/{name}.toml"), &changes)
}

/// Where on a picture a pixel is.
fn place(picture: &Picture, pixel: usize) -> [f64; 2] {
    [(pixel % picture.width) as f64, (pixel / picture.width) as f64]
}

/// The first of the pixels with the largest value.
fn brightest(pixels: impl Iterator<Item = usize>, value: impl Fn(usize) -> f64) -> usize {
    pixels.max_by(|&a, &b| value(a).total_cmp(&value(b))).unwrap()
}

/// Along the ray of a pixel to the lab's plastic sphere: its outward normal there, the point, and
/// the way back to the eye.
fn on_sphere(scene: &Scene, [x, y]: [f64; 2]) -> Option<(V3, V3, V3)> {
    let (centre, radius) = ([1.55, 0.85, 0.0], 0.85);
    let camera = &scene.camera;
    let d = unit(std::array::from_fn(|k| {
        camera.d0()[k] + (x + 0.5) * camera.dx()[k] + (y + 0.5) * camera.dy()[k]
    }));
    let out = minus(camera.eye(), centre);
    let root = dot(out, d).powi(2) - dot(out, out) + radius * radius;
    let t = -dot(out, d) - root.max(0.0).sqrt();
    let point: V3 = std::array::from_fn(|k| camera.eye()[k] + t * d[k]);
    (root > 0.0).then(|| (unit(minus(point, centre)), point, d.map(|c| -c)))
}

/// Exercise 1: "you should see a white highlight that follows your glowing ball, especially on the
/// sphere if you increase Sphere Rez".
#[test]
fn a75_exercise_1_a_white_highlight_follows_the_glowing_ball() {
    // Vertices of the fine sphere lie 0.7 pixels apart where it faces the eye, and the peak of a
    // smooth lobe lies anywhere between them and the pixels.
    const HIGHLIGHT_TOLERANCE_PIXELS: f64 = 2.0;
    let mut columns = Vec::new();
    let balls: [V3; 5] =
        [[-1.0, 2.1, 2.5], [0.35, 2.1, 1.5], [0.9, 3.2, 2.0], [1.8, 2.6, 2.2], [3.2, 1.6, 2.4]];
    for at in balls {
        let scene = with_ball("ex1", at, &[(LOW_SPHERE, HIGH_SPHERE)]);
        let picture = Picture::of(&scene);
        // Green, of which red plastic reflects hardly any but in its highlight.
        let found = brightest(picture.pixels_of(SPHERE), |pixel| picture.rgb[pixel][1]);
        let expected = brightest(picture.pixels_of(SPHERE), |pixel| {
            let Some((n, point, v)) = on_sphere(&scene, place(&picture, pixel)) else { return 0.0 };
            dot(n, halfway(unit(minus(at, point)), v))
        });
        let [a, b] = [found, expected].map(|pixel| place(&picture, pixel));
        let apart = (a[0] - b[0]).hypot(a[1] - b[1]);
        assert!(apart <= HIGHLIGHT_TOLERANCE_PIXELS, "{at:?}: {a:?}, not {b:?}");
        let [_, g, b] = picture.rgb[found];
        assert!(g > 0.2 && (g - b).abs() < 1e-6, "a white highlight on red");
        columns.push(a[0]);
    }
    assert!(columns.windows(2).all(|w| w[0] < w[1]), "to the right with the ball: {columns:?}");
    assert!(columns[4] - columns[0] > 15.0);
}

/// Exercise 2: "lighting changes a lot more as you move the glowing ball. The scene should get
/// noticeably darker as the light moves away from your objects".
#[test]
fn a75_exercise_2_the_scene_gets_darker_as_the_light_moves_away() {
    let mean = |name, at| {
        let picture = Picture::of(&with_ball(name, at, &[]));
        picture.mean([SPHERE, FIGURE].into_iter().flat_map(|object| picture.pixels_of(object)))
    };
    // On one line away from the middle of the objects, none of them within the ball's reach.
    let away = |times: f64| [0.5 - 0.05 * times, 0.9 + 0.4 * times, 0.1 + 0.45 * times];
    let ways = [3.0, 6.0, 12.0, 24.0].map(away);
    let with = ways.map(|at| mean("ex2", at));
    let without = ways.map(|at| mean("ex1", at));
    assert!(with.windows(2).all(|w| w[1] < 0.7 * w[0]), "{with:?}");
    assert!(with[3] < 0.1 * with[0], "{with:?}");
    let range = without
        .iter()
        .fold([f64::INFINITY, 0.0], |[low, high]: [f64; 2], &mean| [low.min(mean), high.max(mean)]);
    assert!(range[0] > 0.7 * range[1], "hardly any change without attenuation: {without:?}");
}

/// Exercise 3: "a subtle light coming from the direction of the lamp post regardless of the position
/// of the floating ball"; and it "automatically follows the lamp post if you change its location".
#[test]
fn a75_exercise_3_the_lamp_gives_a_subtle_light_wherever_the_ball_is() {
    let part = |post: &str, at: V3| {
        let moved = [("translate = [-2.1, 0.0, -0.6]", post)];
        let [one, both] = ["ex2", "ex3"].map(|name| Picture::of(&with_ball(name, at, &moved)));
        let part: Vec<V3> = (0..one.rgb.len()).map(|p| minus(both.rgb[p], one.rgb[p])).collect();
        (part, both)
    };
    let post = "translate = [-2.1, 0.0, -0.6]";
    let (lamp, seen) = part(post, [0.35, 2.1, 1.5]);
    for at in [[-3.0, 1.0, 2.0], [0.0, 9.0, 3.0], [3.0, 2.0, -1.0]] {
        let (other, other_seen) = part(post, at);
        for (pixel, (lamp, other)) in lamp.iter().zip(&other).enumerate() {
            let ball = |picture: &Picture| picture.objects[pixel] == Some(BALL);
            if ball(&seen) || ball(&other_seen) {
                continue;
            }
            // Differences of f32 sums below 2.
            let same = (0..3).all(|k| (lamp[k] - other[k]).abs() < 5e-7);
            assert!(same, "{at:?}: {lamp:?} {other:?}");
        }
    }
    // Subtle, and warm.
    let part_of = |object: usize| {
        let pixels: Vec<usize> = seen.pixels_of(object).collect();
        let lamps = pixels.iter().map(|&pixel| lamp[pixel][0]).sum::<f64>() / pixels.len() as f64;
        lamps / (seen.mean(pixels.into_iter()))
    };
    for object in [0, SPHERE, FIGURE] {
        assert!((0.05..0.6).contains(&part_of(object)), "{object}: {}", part_of(object));
    }
    // From the lamp's direction: on the figure, the left side.
    let columns: Vec<usize> = seen.pixels_of(FIGURE).map(|pixel| pixel % seen.width).collect();
    let middle = (columns.iter().min().unwrap() + columns.iter().max().unwrap()) / 2;
    let side = |is_left: bool| -> f64 {
        let pixels =
            seen.pixels_of(FIGURE).filter(|pixel| (pixel % seen.width < middle) == is_left);
        pixels.map(|pixel| lamp[pixel][0]).sum()
    };
    assert!(side(true) > 1.5 * side(false), "{} {}", side(true), side(false));
    // The post takes its light along.
    let moved = with_ball("ex3", [0.0, 9.0, 3.0], &[(post, "translate = [2.4, 0.0, -0.5]")]);
    let [.., Light::Point(light)] = &moved.lights[..] else { panic!("the lamp comes last") };
    assert_eq!(light.position, [2.4, 2.72, -0.5]);
}

/// Exercise 4: "very smooth highlights on the red plastic sphere at all resolutions".
#[test]
fn a75_exercise_4_highlights_are_smooth_at_all_resolutions_under_phong_shading() {
    let pictures: Vec<_> =
        sheet("lab5-resolutions").cells.iter().map(|cell| Picture::of(&cell.scene)).collect();
    let (gouraud, phong) = pictures.split_at(4);
    for level in 0..3 {
        // Against the finest Phong sphere.
        let error = |picture: &Picture| picture.difference(&phong[3], Some(SPHERE));
        let [coarse, smooth] = [&gouraud[level], &phong[level]].map(error);
        assert!(2.5 * smooth < coarse, "level {level}: {smooth} {coarse}");
    }
    let peak = |picture: &Picture| {
        picture.pixels_of(SPHERE).map(|pixel| picture.rgb[pixel][1]).fold(0.0, f64::max)
    };
    for picture in phong {
        assert!((peak(picture) / peak(&phong[3]) - 1.0).abs() < 0.1, "{}", peak(picture));
    }
    assert!(peak(&gouraud[0]) < 0.5 * peak(&phong[3]), "eight by four miss the highlight");
}

/// Exercise 5: "you should see your material on Batman or other OBJ of your choice".
#[test]
fn a75_exercise_5_the_figure_wears_a_material_of_its_own() {
    let scene = changed("lab5/ex5.toml", &[]);
    let clay = changed("lab5/ex4.toml", &[("around = 16, rings = 8", LOW_SPHERE)]);
    let [picture, before] = [&scene, &clay].map(Picture::of);
    assert_eq!(picture.objects, before.objects);
    let mut figure = 0;
    for pixel in 0..picture.rgb.len() {
        if picture.objects[pixel] != Some(FIGURE) {
            assert_eq!(picture.rgb[pixel], before.rgb[pixel], "nothing else changes");
            continue;
        }
        figure += 1;
        let [new, old] = [&picture, &before]
            .map(|picture| picture.rgb[pixel][2] / picture.rgb[pixel].iter().sum::<f64>());
        assert!(new > 1.2 * old, "more violet than clay: {new} {old}");
    }
    assert!(figure > 1000);
    let worn = scene.objects[FIGURE].triangles.clone();
    let worn = &scene.triangle_materials[worn.start as usize..worn.end as usize];
    assert!(worn.iter().all(|&material| scene.materials[material as usize].name == "violet glaze"));
    // A glaze shines, clay does not: green, of which both reflect a little, has a sharp peak.
    let peak = |picture: &Picture| {
        let most = picture.pixels_of(FIGURE).map(|pixel| picture.rgb[pixel][1]).fold(0.0, f64::max);
        let count = picture.pixels_of(FIGURE).count() as f64;
        most / (picture.pixels_of(FIGURE).map(|pixel| picture.rgb[pixel][1]).sum::<f64>() / count)
    };
    assert!(peak(&picture) > 2.0 * peak(&before), "{} {}", peak(&picture), peak(&before));
}
