//! Hard cases by name, against pixel counts and depths worked out by hand.

use super::{answers, covered, ids};
use crate::support::scenes::{
    T_JUNCTION, T_SLIVER, T_VERTEX, Triangle, fan, rectangle, scaled, scaled_camera,
    single_ray_camera, standard_camera, standard_scene,
};
use truecast::exact::{Answer, Arbiter};
use truecast::pixel::Pixel;
use truecast::scene::Scene;
use truecast::scene::camera::PinholeCamera;
use truecast::visibility::Facing;

const CENTRE: Pixel = Pixel { x: 8, y: 8 };
const UPPER: Triangle = [[-4.0, -4.0, 8.0], [4.0, -4.0, 8.0], [-4.0, 4.0, 8.0]];
const LOWER: Triangle = [[4.0, -4.0, 8.0], [4.0, 4.0, 8.0], [-4.0, 4.0, 8.0]];

fn standard_answers(triangles: &[Triangle]) -> Vec<Answer> {
    answers(&standard_scene(triangles))
}

fn single(triangles: &[Triangle], direction: [f64; 3]) -> Answer {
    let scene = Scene::from_triangles(single_ray_camera([0.0; 3], direction), triangles);
    Arbiter::new(&scene).answer(Pixel { x: 0, y: 0 })
}

fn nothing(answers: &[Answer]) -> bool {
    answers.iter().all(|answer| answer.visible.is_none() && answer.cover.crossed == 0)
}

#[test]
fn h01_needle_fans_are_covered_exactly_once() {
    for (count, pixels) in [(8, 177), (64, 193), (1000, 193)] {
        let answers = standard_answers(&fan(count));
        assert_eq!(covered(&answers), pixels, "fan of {count}");
        assert!(answers.iter().all(|answer| answer.cover.crossed <= 1), "fan of {count}");
        // The hub's sample lies on two edges of every triangle, and one owns it.
        assert_eq!(answers[8 * 17 + 8].visible.map(|surface| surface.tie), Some(true));
    }
}

#[test]
fn h06_left_and_top_edges_belong_to_a_triangle() {
    assert_eq!(covered(&standard_answers(&[UPPER])), 36);
    assert_eq!(covered(&standard_answers(&[LOWER])), 28);
    let both = standard_answers(&[UPPER, LOWER]);
    assert_eq!(covered(&both), 64);
    assert!(both.iter().all(|answer| answer.cover.crossed <= 1));
    // Seen with y downwards these corners run clockwise on the screen: V > 0, the back.
    assert!(both.iter().filter_map(|a| a.visible).all(|s| s.facing == Facing::Back));
}

#[test]
fn h06_holds_at_the_ends_of_the_range_of_numbers() {
    let expected = ids(&standard_answers(&[UPPER, LOWER]));
    for power in [-149 + 2, -140, -60, 60, 110, 123] {
        // Powers of two in two steps, because 2^-147 alone is a subnormal f32 factor.
        let half = 2.0_f32.powi(power / 2);
        let rest = 2.0_f32.powi(power - power / 2);
        let triangles = scaled(&scaled(&[UPPER, LOWER], half), rest);
        for camera_power in [-300, 0, 295] {
            let camera = scaled_camera(8.0, 2.0_f64.powi(camera_power));
            let answers = answers(&Scene::from_triangles(camera, &triangles));
            assert_eq!(ids(&answers), expected, "2^{power}, camera 2^{camera_power}");
            let t = 2.0_f64.powi(power - camera_power);
            for surface in answers.iter().filter_map(|answer| answer.visible) {
                assert_eq!((surface.t_lo, surface.t_hi), (t, t), "2^{power}");
            }
        }
    }
}

#[test]
fn h07_right_and_bottom_edges_do_not() {
    let square = rectangle([-4.0, -4.0], [4.0, 4.0], 8.0);
    let answers = standard_answers(&square);
    for (index, answer) in answers.iter().enumerate() {
        let (x, y) = (index as i32 % 17 - 8, index as i32 / 17 - 8);
        let inside = (-4..4).contains(&x) && (-4..4).contains(&y);
        assert_eq!(answer.visible.is_some(), inside, "sample ({x}, {y})");
        // A tie exactly where the sample lies on an edge of the triangle it hits.
        let on_edge = x == -4 || y == -4 || x + y == 0;
        assert_eq!(answer.visible.is_some_and(|surface| surface.tie), inside && on_edge);
    }
}

#[test]
fn h10_a_gap_at_a_t_junction_is_a_gap() {
    let (x, y) = (f64::from(T_VERTEX[0]), f64::from(T_VERTEX[1]));
    assert_eq!(single(&T_JUNCTION, [x, y + 2.73e-9, 1.0]).visible, None);
    for offset in [-1e-3, 1e-3] {
        let answer = single(&T_JUNCTION, [x, y + offset, 1.0]);
        assert_eq!(answer.cover.crossed, 1, "{offset}");
        assert_eq!(answer.visible.unwrap().triangle.get() == 0, offset > 0.0);
    }
}

#[test]
fn h13_the_sliver_in_the_gap_is_seen() {
    let mut bridged = T_JUNCTION.to_vec();
    bridged.push(T_SLIVER);
    let (x, y) = (f64::from(T_VERTEX[0]), f64::from(T_VERTEX[1]));
    let answer = single(&bridged, [x, y + 2.73e-9, 1.0]);
    assert_eq!(answer.visible.map(|surface| surface.triangle.get()), Some(3));
    assert_eq!(answer.cover.crossed, 1);
}

#[test]
fn h12_an_edge_that_contraction_would_crack_is_hit_once() {
    let ulp = f32::EPSILON;
    let (x, y) = (1.0 + ulp, 1.0 + 3.0 * ulp);
    let (b, c) = ([x, y, 1.0], [-x, -y, 1.0]);
    let scene = standard_scene(&[[[-3.0, 1.0, 1.0], b, c], [[3.0, -1.0, 1.0], c, b]]);
    let answer = Arbiter::new(&scene).answer(CENTRE);
    assert_eq!(answer.cover.crossed, 1);
    assert!(answer.visible.unwrap().tie);
}

#[test]
fn h20_of_equal_triangles_the_lowest_id_is_seen() {
    let [a, b, c] = UPPER;
    let answers = standard_answers(&[UPPER, [b, c, a], [a, c, b]]);
    for surface in answers.iter().filter_map(|answer| answer.visible) {
        assert_eq!((surface.triangle.get(), surface.tie), (0, true));
    }
    assert_eq!(answers[5 * 17 + 5].cover.crossed, 3);
    assert_eq!(answers[5 * 17 + 5].cover.signed, 1);
}

#[test]
fn h24_one_ulp_nearer_is_nearer() {
    let far = rectangle([-2000.0, -2000.0], [2000.0, 2000.0], 1000.0_f32.next_up());
    let near = rectangle([-2000.0, -2000.0], [2000.0, 2000.0], 1000.0);
    let answers = standard_answers(&[far[0], far[1], near[0], near[1]]);
    assert_eq!(covered(&answers), 289);
    for (answer, surface) in answers.iter().map(|answer| (answer, answer.visible.unwrap())) {
        assert!(surface.triangle.get() >= 2);
        assert_eq!(answer.cover.crossed, 2);
        assert_eq!((surface.t_lo, surface.t_hi), (125.0, 125.0));
    }
}

#[test]
fn h27_on_a_fold_the_leaf_nearer_beside_it_is_seen_not_the_lower_id() {
    // Two leaves to the right of one edge that runs down the samples of column 8.
    let (top, bottom) = ([0.0, -9.0, 8.0], [0.0, 9.0, 8.0]);
    let far_leaf = [top, bottom, [6.0, 0.0, 9.0]];
    let near_leaf = [top, bottom, [6.0, 0.0, 7.0]];
    for (triangles, near) in [([far_leaf, near_leaf], 1), ([near_leaf, far_leaf], 0)] {
        let answers = standard_answers(&triangles);
        for row in 0..17 {
            let answer = answers[row * 17 + 8];
            let surface = answer.visible.unwrap();
            assert_eq!(surface.triangle.get(), near);
            assert!(surface.tie);
            assert_eq!((surface.t_lo, surface.t_hi, answer.cover.crossed), (1.0, 1.0, 2));
        }
    }
}

#[test]
fn h26_planes_that_cross_on_samples_are_ordered_beside_them() {
    // Depths 1000 ± x/4000: at column 8 both are exactly 1000, to the right the second is nearer.
    let leaning = |left: f32, right: f32| {
        let (near, far) = (-2000.0, 2000.0);
        [
            [[near, near, left], [far, near, right], [near, far, left]],
            [[far, near, right], [far, far, right], [near, far, left]],
        ]
    };
    let (low, high) = (999.5, 1000.5);
    let [a, b] = leaning(low, high);
    let [c, d] = leaning(high, low);
    let answers = standard_answers(&[a, b, c, d]);
    for (index, answer) in answers.iter().enumerate() {
        let (surface, column) = (answer.visible.unwrap(), index % 17);
        assert_eq!(surface.triangle.get() >= 2, column >= 8, "column {column}");
        if column == 8 {
            assert!(surface.tie);
            assert_eq!((surface.t_lo, surface.t_hi), (125.0, 125.0));
        }
    }
}

#[test]
fn h43_to_h46_a_triangle_whose_plane_holds_the_eye_is_never_seen() {
    let cases: [(&str, Triangle); 5] = [
        ("H43 eye in the plane", [[0.0, -3.0, 2.0], [0.0, 5.0, 3.0], [0.0, 1.0, 9.0]]),
        ("H44 eye at a vertex", [[0.0; 3], [5.0, -5.0, 8.0], [5.0, 5.0, 8.0]]),
        ("H45 eye on an edge", [[0.0, 0.0, -4.0], [0.0, 0.0, 4.0], [5.0, 5.0, 8.0]]),
        ("H46 eye inside", [[-5.0, -5.0, 0.0], [5.0, -5.0, 0.0], [0.0, 5.0, 0.0]]),
        ("H46 eye inside, in view", [[0.0, -5.0, -5.0], [0.0, -5.0, 9.0], [0.0, 5.0, 9.0]]),
    ];
    for (name, triangle) in cases {
        let scene = standard_scene(&[triangle]);
        assert!(nothing(&answers(&scene)), "{name}");
        // Not even a candidate: it has no side.
        assert!(Arbiter::new(&scene).candidates(CENTRE).is_empty(), "{name}");
    }
}

#[test]
fn h47_what_lies_behind_the_eye_is_not_mirrored_into_view() {
    assert!(nothing(&standard_answers(&rectangle([-90.0, -90.0], [90.0, 90.0], -8.0))));
}

#[test]
fn h4a_a_grazed_floor_is_seen_at_a_finite_depth() {
    let (below, side) = (2.0_f32.powi(-20), 1e8);
    let corner = |x: f32, z: f32| [x, below, z];
    let floor = [
        [corner(-side, -side), corner(side, -side), corner(side, side)],
        [corner(-side, -side), corner(side, side), corner(-side, side)],
    ];
    let answers = standard_answers(&floor);
    for (index, answer) in answers.iter().enumerate() {
        let row = index / 17;
        assert_eq!(answer.visible.is_some(), row > 8, "row {row}");
        let Some(surface) = answer.visible else { continue };
        // d_y is row − 8, so t = 2^-20/(row − 8), the quotient rounded both ways.
        let t = f64::from(below) / (row - 8) as f64;
        assert!(surface.t_lo <= t && t <= surface.t_hi);
        assert_eq!(surface.t_lo == surface.t_hi, (row - 8).is_power_of_two());
    }
}

#[test]
fn weights_are_the_exact_ones() {
    // The sample of G(8)'s centre sees the point (0, 0): weights ¼, ¼ and ½ by symmetry.
    let scene = standard_scene(&[[[-4.0, -4.0, 8.0], [4.0, -4.0, 8.0], [0.0, 4.0, 8.0]]]);
    let surface = Arbiter::new(&scene).answer(CENTRE).visible.unwrap();
    assert_eq!(surface.barycentric.0, [0.25, 0.25, 0.5]);
    // A corner at depth 100 of an edge from depth 1 weighs 1/101 half way across the screen.
    let (near, far) = ([-1.0, 0.0, 8.0], [100.0, 0.0, 800.0]);
    let scene = standard_scene(&[[near, far, [0.0, -400.0, 8.0]]]);
    let answer = Arbiter::new(&scene).candidates(CENTRE);
    assert_eq!(answer[0].barycentric.0, [100.0 / 101.0, 1.0 / 101.0, 0.0]);
}

#[test]
fn a_translated_camera_sees_the_translated_scene() {
    // H72: an integer translation by 2^22 rounds nothing.
    let shift = 4_194_304.0_f32;
    let moved = fan(8).iter().map(|t| t.map(|v| v.map(|c| c.round() + shift))).collect::<Vec<_>>();
    let still = fan(8).iter().map(|t| t.map(|v| v.map(f32::round))).collect::<Vec<_>>();
    let camera = standard_camera(8.0);
    let eye = [f64::from(shift); 3];
    let camera =
        PinholeCamera::exact(camera.resolution(), eye, camera.d0(), camera.dx(), camera.dy())
            .unwrap();
    let expected = standard_answers(&still);
    assert_eq!(answers(&Scene::from_triangles(camera, &moved)), expected);
    assert!(covered(&expected) > 100);
}
